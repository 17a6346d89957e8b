"""Dask clusters: workers of another build, killed schedulers, stores that workers write."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
import xarray

import antinode as an
from antinode.study.sweep.build import Build, this_build
from antinode.study.sweep.cluster import _checked
from antinode.study.sweep.contents import TIMESTAMPS
from antinode.study.sweep.ledger import Ledger
from antinode.study.sweep.sweep import sweep
from cli_run import run
from study_text import study

pytest.importorskip("distributed")

TEXT = """
inputs = [{ key = "speed", low = 60, high = 90 }, { key = "thrust", low = 0, high = 1e5 }]
design = { kind = "sobol", number = NUMBER }
run.chunk = 64
solve.modes = 3
"""
OTHER = "import antinode.version as v; v.__version__ = '9.9.9'; "
WORKER = "from distributed.cli.dask_worker import main; main()"


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starter")
    run("init", folder)
    return an.load_case(folder / "case.toml")


@contextlib.contextmanager
def cluster(*workers):
    """A scheduler and workers on loopback, each a program; they end by themselves."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    local = ["--host", "127.0.0.1", "--no-dashboard"]
    commands = [[sys.executable, "-m", "dask", "scheduler", *local, "--port", str(port)]]
    commands += [
        [sys.executable, "-c", text + WORKER, address, *local, "--no-nanny", "--nthreads", "1"]
        for text in workers
    ]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    servers = [subprocess.Popen(["timeout", "600", *command], **quiet) for command in commands]
    try:
        yield address, servers
    finally:
        for server in servers:
            server.terminate()
            server.wait(timeout=120)


def identical(one, two):
    found = [an.open_store(path).load() for path in (one, two)]
    for dataset in found:
        for name in TIMESTAMPS:
            dataset.attrs.pop(name)
    xarray.testing.assert_identical(*found)


def test_workers_write_the_store_and_the_run_keeps_the_ledger(case, tmp_path):
    made = study(case, TEXT.replace("NUMBER", "640"))
    with cluster("") as (address, _):
        sweep(made, tmp_path / "s.zarr", scheduler=address)
    sweep(made, tmp_path / "whole.zarr")
    identical(tmp_path / "s.zarr", tmp_path / "whole.zarr")
    found = Ledger(tmp_path / "s.zarr").records
    assert sorted(found) == list(range(10))
    assert len({record.kernel for record in found.values()}) == 1


def test_a_worker_of_another_version_is_refused(case, tmp_path):
    made = study(case, TEXT.replace("NUMBER", "640"))
    words = rf"has antinode 9\.9\.9, this is {an.__version__}; nothing of it was taken"
    with cluster(OTHER) as (address, _), pytest.raises(an.ComputationError, match=words):
        sweep(made, tmp_path / "s.zarr", scheduler=address)
    assert not Ledger(tmp_path / "s.zarr").records
    assert not (tmp_path / "s.zarr" / "reason" / "c").exists()


@pytest.mark.parametrize("field", Build._fields)
def test_each_part_of_a_build_counts(field):
    own = this_build()
    other = own._replace(**{field: "other"})
    assert own.difference(own) == ""
    with pytest.raises(an.ComputationError, match="another build"):
        _checked(other)
    with pytest.raises(an.ComputationError, match="does not say which"):
        _checked({"reason": [0]})


def test_a_killed_scheduler_is_a_sentence_and_the_store_goes_on(case, tmp_path):
    made = study(case, TEXT.replace("NUMBER", "60000"))
    path, seen, killed = tmp_path / "s.zarr", [], []

    def progress(done, _):
        seen.append(done)
        if len(seen) == 3:
            os.kill(child_of(servers[0].pid), signal.SIGKILL)
            killed.append(time.monotonic())

    with cluster("") as (address, servers):
        with pytest.raises(an.ComputationError, match=r"Dask .*run the same command again"):
            sweep(made, path, scheduler=address, progress=progress)
        assert time.monotonic() - killed[0] < 120
    assert 0 < len(Ledger(path).records) < 900
    told = []
    with contextlib.suppress(StoppedError):
        sweep(made, path, progress=lambda done, _: told.append(done) or stop(told))
    assert told[0] >= seen[-1]


class StoppedError(Exception):
    pass


def stop(told):
    if len(told) > 1:
        raise StoppedError


def child_of(pid):
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError):
                if int((entry / "stat").read_text().rpartition(")")[2].split()[1]) == pid:
                    return int(entry.name)
    raise AssertionError(pid)
