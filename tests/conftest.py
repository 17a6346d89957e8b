"""Options of the tests."""

import os

import pytest


def pytest_addoption(parser):
    parser.addoption(
        "--compiled", action="store_true", help="load the compiled kernel first: all solves use it"
    )


def pytest_configure(config):
    if config.getoption("--compiled"):
        from antinode.kernel import kernel

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
