"""Options of the tests, and what a run makes once for all its workers."""

import os
from pathlib import Path
from typing import NamedTuple

import pytest

from installed import SOLVE, install, run, shared

for _library in ("OMP", "OPENBLAS", "MKL"):
    # Workers share the processors out among themselves: further threads, for matrices of some
    # hundred rows, wait for each other at full speed, and took two thirds of the time of all.
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")


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


@pytest.fixture(scope="session")
def installed(tmp_path_factory):
    """The archives that are released, and an environment with the wheel."""
    pytest.importorskip("hatchling")
    with shared(tmp_path_factory, "installed") as folder:
        return install(folder)


class Cold(NamedTuple):
    """Folder of code that was compiled anew, and what the process that had it made found."""

    cache: Path
    found: str


@pytest.fixture(scope="session")
def cold(tmp_path_factory, installed):
    """Code compiled anew, by the installed wheel; of a run that is the only time."""
    with shared(tmp_path_factory, "installed") as folder:
        said = folder / "found.txt"
        if not said.exists():
            found = run(installed.python, "-c", SOLVE, "nothing", where=folder)
            said.write_text(found)
        return Cold(installed.cache, said.read_text())
