"""Options of the tests."""

import os

import pytest


def pytest_addoption(parser):
    parser.addoption(
        "--numpy", action="store_true", help="let numpy solve where no backend is asked for"
    )


def pytest_configure(config):
    """Have the compiled code made before any worker starts, so that no test waits for it."""
    from antinode.modes import backends

    if not hasattr(config, "workerinput"):
        backends.choose("numba")
    if config.getoption("--numpy"):
        backends.AUTO = "numpy"


def pytest_sessionfinish(session):
    """With ANTINODE_NO_SKIPS in the environment, skipped tests fail the run."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    skipped = reporter.stats.get("skipped", []) if reporter else []
    if skipped and os.environ.get("ANTINODE_NO_SKIPS"):
        reporter.write_line("")
        for report in skipped:
            reporter.write_line(f"skipped, and no test may be: {report.nodeid}", red=True)
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
