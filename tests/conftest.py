"""Options of the tests."""

import os
import subprocess
import sys

import pytest


def pytest_addoption(parser):
    parser.addoption(
        "--compiled", action="store_true", help="load the compiled kernel first: all solves use it"
    )


def pytest_configure(config):
    """Have the kernel compiled once, by a process of its own, before any worker starts.

    Numba's code from memory and from its cache differ in the last digits of what they compute;
    tests that compare processes to the bit need the same one everywhere.
    """
    if not hasattr(config, "workerinput"):
        code = "from antinode.modes.kernel import kernel; kernel()"
        subprocess.run([sys.executable, "-c", code], check=True)
    if config.getoption("--compiled"):
        from antinode.modes.kernel import kernel

        kernel()


def pytest_sessionfinish(session):
    """With ANTINODE_NO_SKIPS in the environment, skipped tests fail the run."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    skipped = reporter.stats.get("skipped", []) if reporter else []
    if skipped and os.environ.get("ANTINODE_NO_SKIPS"):
        reporter.write_line("")
        for report in skipped:
            reporter.write_line(f"skipped, and no test may be: {report.nodeid}", red=True)
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
