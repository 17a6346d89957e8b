"""Power cuts: a disk that forgets whatever was not brought onto it."""

import os
from pathlib import Path

import numpy as np
import pytest
import xarray

import antinode as an
from antinode.study.design.points import points_of
from antinode.study.sweep.contents import TIMESTAMPS
from antinode.study.sweep.folder import resume
from antinode.study.sweep.sweep import sweep
from study_text import study

TEXT = """
inputs = [{ key = "speed", low = 60, high = 90 }, { key = "thrust", low = 0, high = 1e5 }]
design = { kind = "sobol", number = 24 }
run.chunk = 8
solve.modes = 2
"""
HISTORY = """
inputs = [{ key = "time", values = [0, 1, 2] }, { key = "speed", values = [60, 70, 80] }]
design.kind = "zip"
run.chunk = 2
solve.modes = 2
"""


class PowerCut(BaseException):
    pass


class Disk:
    """What is on a disk: contents of files and names in folders when they were last synced.

    Parameters
    ----------
    syncs : int
        How many there are before the power is cut.
    """

    def __init__(self, syncs):
        self.left, self.contents, self.names = syncs, {}, {}
        self.fsync = os.fsync

    def __call__(self, handle):
        if not self.left:
            raise PowerCut
        self.left -= 1
        place = Path(os.readlink(f"/proc/self/fd/{handle}"))
        node = os.fstat(handle).st_ino
        if place.is_dir():
            self.names[node] = {p.name: (p.stat().st_ino, p.is_dir()) for p in place.iterdir()}
        else:
            self.contents[node] = place.read_bytes()
        self.fsync(handle)

    def restore(self, folder, target, *, torn):
        """Write what would be there after the cut, or half of what was added since besides."""
        now = {p.stat().st_ino: p for p in folder.rglob("*") if p.is_file()} if torn else {}
        self._restore(folder.stat().st_ino, target, now)

    def _restore(self, folder, target, now):
        target.mkdir()
        for name, (node, is_folder) in self.names.get(folder, {}).items():
            if is_folder:
                self._restore(node, target / name, now)
                continue
            data = self.contents.get(node, b"")
            more = now[node].read_bytes()[len(data) :] if node in now else b""
            (target / name).write_bytes(data + more[: -(-len(more) // 2)])


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    from cli_run import run

    folder = tmp_path_factory.mktemp("starter")
    run("init", folder)
    return an.load_case(folder / "case.toml")


def count_syncs(made, path, monkeypatch):
    disk = Disk(10**9)
    monkeypatch.setattr(os, "fsync", disk)
    sweep(made, path)
    monkeypatch.undo()
    return 10**9 - disk.left


def identical(one, two):
    found = [an.open_store(path).load() for path in (one, two)]
    for dataset in found:
        for name in TIMESTAMPS:
            dataset.attrs.pop(name)
    xarray.testing.assert_identical(*found)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="needs /proc")
@pytest.mark.parametrize(("text", "torn"), [(TEXT, False), (TEXT, True), (HISTORY, False)])
def test_what_was_told_as_done_outlives_a_power_cut(case, tmp_path, monkeypatch, text, torn):
    made = study(case, text)
    whole = tmp_path / "whole.zarr"
    syncs = count_syncs(made, whole, monkeypatch)
    assert syncs > 60
    rng = np.random.default_rng(5)
    for cut in sorted({1, syncs - 1, *rng.integers(1, syncs, 14).tolist()}):
        folder, after = tmp_path / f"before {cut}", tmp_path / f"after {cut}"
        folder.mkdir()
        told, disk = [], Disk(cut)
        monkeypatch.setattr(os, "fsync", disk)
        with pytest.raises(PowerCut):
            sweep(made, folder / "s.zarr", progress=lambda done, _, told=told: told.append(done))
        monkeypatch.undo()
        disk.restore(folder, after, torn=torn)
        path = after / "s.zarr"
        if path.exists():
            store = resume(path, points_of(made))
            kept = made.design.number or 3
            kept -= sum(map(store.plan.cases, store.left()))
            assert kept >= (told or [0])[-1]
        sweep(made, path)
        identical(path, whole)
