"""Pools of processes: none outlives its parent, and a script without a guard says so."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cli_run import python, run

UNGUARDED = """
from pathlib import Path
import antinode as an
with Path("runs").open("a") as runs:
    runs.write("x")
try:
    an.sweep(an.load_study("samples.toml", ["design.number=64", "run.chunk=16"]), workers=2)
except an.InputError as error:
    print(error)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    run("init", "--example", "sweep", folder)
    return folder


def test_a_script_without_a_guard_gets_a_sentence(folder):
    (folder / "script.py").write_text(UNGUARDED)
    ended = subprocess.run(
        [sys.executable, "script.py"], cwd=folder, capture_output=True, text=True, check=False
    )
    assert "put it under 'if __name__ == \"__main__\":'" in ended.stdout
    assert ended.stderr == ""
    assert len((folder / "runs").read_text()) <= 4


def group(leader):
    """Processes of a group that are alive."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(fields[2]) == leader and fields[0] != "Z":
                found.append(int(entry.name))
    return found


@pytest.mark.skipif(not Path("/proc").exists(), reason="needs /proc")
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_no_worker_outlives_its_parent(folder, tmp_path, how):
    command = python(
        "sweep", folder / "samples.toml", "-o", tmp_path / "s.zarr", "--workers", "2",
        "--set", "design.number=400000", "--set", "run.chunk=500",
    )  # fmt: skip
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, start_new_session=True, **quiet) as process:
        ledger, start = tmp_path / "s.zarr" / "reason" / ".antinode" / "ledger", time.monotonic()
        while time.monotonic() - start < 300:
            if ledger.exists() and ledger.stat().st_size > 500:
                break
            time.sleep(0.05)
        assert len(group(process.pid)) > 2
        os.kill(process.pid, how)
        process.wait(timeout=120)
        start = time.monotonic()
        while group(process.pid) and time.monotonic() - start < 10:
            time.sleep(0.05)
        left = group(process.pid)
        for pid in left:
            os.kill(pid, signal.SIGKILL)
    assert not left
