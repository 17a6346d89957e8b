"""The store of a sweep: it goes on, it notices damage, and it refuses what is not its own."""

import errno
import json
import os
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
import xarray

import antinode as an
from antinode.study.sweep import blocks
from antinode.study.sweep import folder as folder_module
from antinode.study.sweep.contents import TIMESTAMPS
from antinode.study.sweep.ledger import ledger_of
from antinode.study.sweep.lock import locked
from antinode.study.sweep.sweep import sweep
from cli_run import contents, python, refused, run

SMALL = ("--set", "design.number=96", "--set", "run.chunk=16")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    run("init", "--example", "sweep", folder)
    return folder


@pytest.fixture(scope="module")
def study(folder):
    return an.load_study(folder / "samples.toml", SMALL[1::2])


@pytest.fixture(scope="module")
def whole(study, tmp_path_factory):
    """An undisturbed store."""
    path = tmp_path_factory.mktemp("whole") / "s.zarr"
    sweep(study, path)
    return path


def same(path, other):
    """Assert that two stores hold the same, timestamps apart."""
    one, two = (an.open_store(p).load() for p in (path, other))
    for name in TIMESTAMPS:
        for dataset in (one, two):
            dataset.attrs.pop(name)
    xarray.testing.assert_identical(one, two)


class StoppedError(Exception):
    pass


def stop_after(number):
    seen = []

    def progress(done, cases):
        seen.append(done)
        if len(seen) > number:
            raise StoppedError

    return progress


def test_the_store_holds_what_memory_would(study, whole):
    here = sweep(study)
    there = an.open_store(whole).load()
    xarray.testing.assert_identical(here.drop_attrs(deep=False), there.drop_attrs(deep=False))
    same_attrs = {k: v for k, v in here.attrs.items() if k not in TIMESTAMPS}
    assert same_attrs == {k: v for k, v in there.attrs.items() if k not in TIMESTAMPS}


def test_any_reader_of_zarr_reads_it(whole):
    for options in ({}, {"consolidated": False, "chunks": None}):
        with xarray.open_zarr(whole, **options) as plain:
            assert plain.frequency_hz.dims == ("case", "mode")
            assert plain.frequency_hz.attrs["units"] == "Hz"
            assert list(plain.mode.values) == [f"bending {k}" for k in range(1, 7)]
            assert {"speed", "thrust"} < set(plain.coords)


def test_a_run_goes_on_where_it_was_stopped(study, whole, tmp_path):
    path = tmp_path / "s.zarr"
    with pytest.raises(StoppedError):
        sweep(study, path, progress=stop_after(3))
    told = []
    sweep(study, path, progress=lambda done, _: told.append(done))
    assert told == [48, 64, 80, 96]
    same(path, whole)


def test_a_finished_store_is_left_alone(study, whole, tmp_path):
    path = tmp_path / "s.zarr"
    shutil.copytree(whole, path)
    before = contents(path)
    sweep(study, path)
    assert contents(path) == before


@pytest.mark.parametrize("how", ["flipped", "cut", "lost", "empty", "swapped"])
def test_a_corrupted_chunk_is_computed_again(study, whole, tmp_path, how):
    path = tmp_path / "s.zarr"
    shutil.copytree(whole, path)
    chunk = path / "frequency_hz" / "c" / "2" / "0"
    data = chunk.read_bytes()
    if how == "flipped":
        middle = len(data) // 2
        chunk.write_bytes(data[:middle] + bytes([data[middle] ^ 1]) + data[middle + 1 :])
    elif how == "cut":
        chunk.write_bytes(data[:-7])
    elif how == "lost":
        chunk.unlink()
    elif how == "empty":
        chunk.write_bytes(b"")
    else:
        chunk.write_bytes((path / "frequency_hz" / "c" / "3" / "0").read_bytes())
    told = []
    sweep(study, path, progress=lambda done, _: told.append(done))
    assert told == [80, 96]
    same(path, whole)


def test_tracked_modes_are_written_again_if_they_are_damaged(folder, tmp_path):
    study = an.load_study(folder / "history.toml", ["run.chunk=16"])
    path, other = tmp_path / "a.zarr", tmp_path / "b.zarr"
    sweep(study, path)
    shutil.copytree(path, other)
    (other / "tracked_mode" / "c" / "1" / "0").unlink()
    ledger = ledger_of(other)
    first, second, *rest = ledger.read_bytes().splitlines(keepends=True)
    ledger.write_bytes(first + second.replace(b"1", b"2", 1) + b"".join(rest)[:-9])
    (other / "point" / "c" / "0").unlink()
    sweep(study, other)
    same(path, other)


def test_a_store_that_is_damaged_beyond_repair_says_so(study, whole, tmp_path):
    path = tmp_path / "s.zarr"
    shutil.copytree(whole, path)
    (path / "a_X" / "zarr.json").write_text("{")
    with pytest.raises(an.InputError, match="a_X is damaged beyond repair"):
        sweep(study, path)
    sweep(study, path, overwrite=True)
    same(path, whole)


OTHERS = {
    "study": (("design.number=96", "run.chunk=16", "solve.modes=5"), "another study"),
    "fewer": (("design.number=95", "run.chunk=16"), "holds 96 cases, design.number asks for 95"),
    "chunk": (("design.number=96", "run.chunk=24"), "another study"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_a_store_of_another_study_is_refused(folder, whole, name):
    assignments, words = OTHERS[name]
    before = contents(whole)
    with pytest.raises(an.InputError, match=words):
        sweep(an.load_study(folder / "samples.toml", assignments), whole)
    assert contents(whole) == before


def test_a_store_of_another_case_or_version_is_refused(folder, whole, study, tmp_path, monkeypatch):
    shutil.copytree(folder, tmp_path / "other")
    file = tmp_path / "other" / "case.toml"
    file.write_text(file.read_text().replace("80 mm", "81 mm"))
    other = an.load_study(tmp_path / "other" / "samples.toml", SMALL[1::2])
    with pytest.raises(an.InputError, match="another case"):
        sweep(other, whole)
    monkeypatch.setattr("antinode.study.sweep.contents.__version__", "9.9.9")
    with pytest.raises(an.InputError, match=r"another version .* \(0.1.0, this is 9.9.9\)"):
        sweep(study, whole)


def test_what_is_no_store_is_kept(study, tmp_path):
    (tmp_path / "letters").mkdir()
    (tmp_path / "letters" / "a.txt").write_text("dear")
    for overwrite in (False, True):
        with pytest.raises(an.InputError, match="no store of a sweep"):
            sweep(study, tmp_path / "letters", overwrite=overwrite)
    (tmp_path / "file").write_text("dear")
    with pytest.raises(an.InputError, match="this is a file"):
        sweep(study, tmp_path / "file")
    assert (tmp_path / "letters" / "a.txt").read_text() == "dear"
    with pytest.raises(an.InputError, match="no store of a sweep"):
        an.open_store(tmp_path / "letters")


def test_a_second_run_on_a_store_is_refused(study, tmp_path):
    path = tmp_path / "s.zarr"
    with locked(path), pytest.raises(an.InputError, match="another run works on this store"):
        sweep(study, path)
    sweep(study, path)
    assert not list(tmp_path.glob("*.lock"))


def test_a_folder_that_cannot_be_written_is_refused(study, tmp_path, monkeypatch):
    with pytest.raises(an.InputError, match="there is no folder"):
        sweep(study, tmp_path / "none" / "s.zarr")
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(an.InputError, match="Permission denied"):
        sweep(study, tmp_path / "s.zarr")
    assert contents(tmp_path) == {}


def test_a_full_disk_says_so_and_goes_on_later(study, whole, tmp_path, monkeypatch):
    path, write = tmp_path / "s.zarr", blocks.write_lasting

    def full(store, file, data):
        if file.match("reason/c/2"):
            raise OSError(errno.ENOSPC, "No space left on device")
        write(store, file, data)

    monkeypatch.setattr(blocks, "write_lasting", full)
    with pytest.raises(an.ComputationError, match="no space is left on the disk; 2 of 6 chunks"):
        sweep(study, path)
    monkeypatch.undo()
    sweep(study, path)
    same(path, whole)


def test_a_broken_writer_leaves_no_half_made_store(study, tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("antinode.study.sweep.folder.write_lasting", full)
    with pytest.raises(an.InputError, match="cannot be written"):
        sweep(study, tmp_path / "s.zarr")
    assert contents(tmp_path) == {}


def test_a_clock_that_goes_backwards_changes_nothing(study, whole, tmp_path, monkeypatch):
    monkeypatch.setattr("antinode.study.sweep.contents._now", lambda: "1970-01-01T00:00:00+00:00")
    path = tmp_path / "s.zarr"
    with pytest.raises(StoppedError):
        sweep(study, path, progress=stop_after(2))
    monkeypatch.undo()
    sweep(study, path)
    same(path, whole)


def test_killed_at_random_it_equals_an_undisturbed_run(folder, whole, tmp_path):
    rng, path = np.random.default_rng(1), tmp_path / "s.zarr"
    command = python("sweep", folder / "samples.toml", "-o", path, "--json", *SMALL)
    for _ in range(3):
        with subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        ) as process:
            time.sleep(rng.uniform(0.8, 2.2))
            os.killpg(process.pid, signal.SIGKILL)
    ended = run("sweep", folder / "samples.toml", "-o", path, "--json", *SMALL)
    assert json.loads(ended.out)["failed"] == 0
    same(path, whole)


def test_the_command_refuses_another_study(folder, whole):
    refused(run("sweep", folder / "history.toml", "-o", whole), "another study", "--overwrite")


# --- designs that grow ---


@pytest.mark.parametrize("kind", ["sobol", "random", "latin_hypercube"])
def test_a_grown_design_equals_a_fresh_one(folder, tmp_path, kind):
    def made(number):
        design = (f"design.kind={kind}", f"design.number={number}", "run.chunk=16")
        return an.load_study(folder / "samples.toml", design)

    grown, fresh, told = tmp_path / "grown.zarr", tmp_path / "fresh.zarr", []
    sweep(made(40), grown)
    sweep(made(80), grown, progress=lambda done, _: told.append(done))
    sweep(made(80), fresh)
    same(grown, fresh)
    assert told[0] == 32  # two whole chunks were there
    with pytest.raises(an.InputError, match="never shrinks"):
        sweep(made(40), grown)


def test_a_latin_hypercube_grows_by_doubling(folder, tmp_path):
    def made(number):
        design = ("design.kind=latin_hypercube", f"design.number={number}")
        return an.load_study(folder / "samples.toml", design)

    sweep(made(12), tmp_path / "s.zarr")
    with pytest.raises(an.InputError, match="grows by doubling: take 24, 48"):
        sweep(made(18), tmp_path / "s.zarr")


def test_growing_goes_on_after_a_kill(folder, tmp_path, monkeypatch):
    def made(number):
        design = (f"design.number={number}", "run.chunk=16")
        return an.load_study(folder / "samples.toml", design)

    path, write, seen = tmp_path / "s.zarr", folder_module.write_lasting, []
    sweep(made(20), path)

    def killed(store, file, data):
        seen.append(file)
        if len(seen) == 4:
            raise StoppedError
        write(store, file, data)

    monkeypatch.setattr(folder_module, "write_lasting", killed)
    with pytest.raises(StoppedError):
        sweep(made(40), path)
    monkeypatch.undo()
    sweep(made(20), path)
    sweep(made(20), tmp_path / "twenty.zarr")
    same(path, tmp_path / "twenty.zarr")
    sweep(made(40), path)
    sweep(made(40), tmp_path / "forty.zarr")
    same(path, tmp_path / "forty.zarr")


# --- what others do to a store ---


@pytest.mark.parametrize("key", ["mode_names", "chunk", "families", "store_format"])
def test_spoilt_attributes_are_refused_before_anything_is_computed(study, whole, tmp_path, key):
    path = tmp_path / "s.zarr"
    shutil.copytree(whole, path)
    document = json.loads((path / "zarr.json").read_text())
    document["attributes"][key] = ["longitudinal 1"]
    (path / "zarr.json").write_text(json.dumps(document))
    words = "another version" if key == "store_format" else rf"\({key}\) is damaged beyond repair"
    with pytest.raises(an.InputError, match=words):
        sweep(study, path)
    del document["attributes"][key]
    (path / "zarr.json").write_text(json.dumps(document))
    with pytest.raises(an.InputError, match="damaged beyond repair"):
        sweep(study, path)
    (path / "zarr.json").write_text("{")
    with pytest.raises(an.InputError, match="damaged beyond repair; add --overwrite"):
        sweep(study, path)
    sweep(study, path, overwrite=True)
    same(path, whole)


def test_a_store_that_is_moved_while_it_is_written_says_so(study, whole, tmp_path):
    path, other = tmp_path / "s.zarr", tmp_path / "moved.zarr"

    def progress(done, _):
        if done == 48:
            path.rename(other)

    with pytest.raises(an.ComputationError, match="moved, removed or replaced while the sweep ran"):
        sweep(study, path, progress=progress)
    assert not path.exists()
    sweep(study, other)
    same(other, whole)


def test_a_store_of_other_sources_is_refused(study, whole, monkeypatch):
    monkeypatch.setattr("antinode.study.sweep.contents.sources_hash", lambda: "other")
    with pytest.raises(an.InputError, match="another build of antinode"):
        sweep(study, whole)


def test_blocks_of_several_chunks_hold_the_same(study, whole, tmp_path, monkeypatch):
    monkeypatch.setattr(folder_module, "rows_of_blocks", lambda _: 64)
    sweep(study, tmp_path / "s.zarr")
    assert not (tmp_path / "s.zarr" / "reason" / "c" / "2").exists()
    same(tmp_path / "s.zarr", whole)
    monkeypatch.undo()
    sweep(study, tmp_path / "s.zarr")
