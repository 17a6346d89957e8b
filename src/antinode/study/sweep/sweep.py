"""Sweeps: every case of a study into a Dataset, in memory or through a store on disk.

    import antinode as an
    dataset = an.sweep(an.load_study("study.toml"))

The store holds what is needed to go on after any interruption; see `store.py`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arguments import wanted
from antinode.errors import InputError
from antinode.study.cases.chunks import Arrays
from antinode.study.cases.reasons import failed
from antinode.study.design.file import Study
from antinode.study.design.points import Points, points_of

from .cluster import close, connect, run_on_dask
from .contents import (
    SWAPPED,
    UNLIKE,
    attributes,
    coordinates_of,
    final_attributes,
    labelled,
    outputs_of,
    tracking_points,
)
from .executors import refuse_second_script, run_here, run_in_pool
from .folder import create, import_store, open_store, remove, resume
from .lock import locked
from .store import Store
from .tracking import neighbours, track
from .work import Done, Plan, joined

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], None]
"""Called with the number of cases that are done, and of all."""
MOST_IN_MEMORY = 2_000_000
MOST_TRACKED = 200_000


def sweep(
    study: Study,
    store: str | Path | None = None,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Compute every case of a study.

    Parameters
    ----------
    study : Study
    store : str or Path, optional
        A folder for the result, such as ``"sweep.zarr"``. If it is there already and belongs to
        this study, only what is missing is computed. Without it the result is kept in memory.
    workers : int
        Processes; 1 computes in this one.
    scheduler : str, optional
        Address of a Dask scheduler, such as ``"tcp://host:8786"``, in place of processes here.
    overwrite : bool
        Replace a store of another study.
    progress : callable, optional
        Called with the number of cases that are done, and of all.

    Returns
    -------
    xarray.Dataset
        Over cases and modes; inputs are coordinates. `reason` is 0 where a case was solved.

    Raises
    ------
    InputError
        If the study, the store or the scheduler is not as it must be.
    ComputationError
        If the disk is full, or the workers fail.
    """
    refuse_second_script()
    wanted("the study", study, Study, "load_study('study.toml')")
    points = points_of(study)
    check_size(points, in_memory=store is None)
    import_store()
    if workers < 1:
        raise InputError(f"workers is {workers}; take 1 or more")
    with _executor(workers, scheduler) as run:
        if store is None:
            return _in_memory(points, run, progress)
        return _into_store(points, Path(store), run, progress, overwrite=overwrite)


def check_size(points: Points, *, in_memory: bool) -> None:
    """Refuse what cannot be held or tracked, before any work is done."""
    if points.tracked and points.cases > MOST_TRACKED:
        raise InputError(
            f"tracking.track: {points.cases} cases; at most {MOST_TRACKED} can be tracked"
        )
    if points.tracked and points.study.design.kind not in ("grid", "zip"):
        raise InputError(
            "tracking.track: samples have no order to track modes along; take a grid or a table"
        )
    if in_memory and points.cases > MOST_IN_MEMORY:
        raise InputError(
            f"{points.cases} cases are too many for memory; name a store for them, "
            "e.g. -o sweep.zarr"
        )


Run = Callable[[Plan, list[int]], Iterator[Done]]
"""Computes some blocks of a plan."""


@contextmanager
def _executor(workers: int, scheduler: str | None) -> Iterator[Run]:
    """Return what computes blocks."""
    if scheduler is not None:
        client = connect(scheduler)
        try:
            yield lambda plan, blocks: run_on_dask(plan, blocks, client)
        finally:
            close(client)
    elif workers > 1:
        yield lambda plan, blocks: run_in_pool(plan, blocks, min(workers, len(blocks)))
    else:
        yield run_here


def _in_memory(points: Points, run: Run, progress: Progress | None) -> xarray.Dataset:
    import xarray

    plan = Plan(points, min(points.study.run_table.chunk, points.cases))
    found: dict[int, Arrays] = {}
    told = _Told(progress, plan)
    for done in run(plan, list(range(plan.blocks))):
        assert done.arrays is not None
        found[done.block] = done.arrays
        told.add(done.block)
    arrays = joined(found[block] for block in range(plan.blocks))
    arrays |= tracked(points, arrays)
    about = outputs_of(points)
    data: dict[str, Any] = {
        name: (about[name].dims, arrays[name], about[name].attrs) for name in about
    }
    data.update(coordinates_of(points))
    everything = attributes(points) | final_attributes(
        points, [arrays["reason"]], [arrays["warned"]], arrays.get("tracked_doubtful")
    )
    return labelled(xarray.Dataset(data, attrs=everything))


def _into_store(
    points: Points, path: Path, run: Run, progress: Progress | None, *, overwrite: bool
) -> xarray.Dataset:
    _check_folder(path)
    with locked(path):
        if path.exists() and overwrite:
            remove(path)
        store = resume(path, points) if path.exists() else create(path, points)
        left = store.left()
        told = _Told(progress, store.plan, left)
        if left or not store.finished:
            with store.run():
                for done in run(store.plan, left) if left else ():
                    store.take(done)
                    told.add(done.block)
                _finish(store)
    return open_store(path)


def _finish(store: Store) -> None:
    """Write what is known after all blocks."""
    points, blocks = store.points, store.blocks
    about, tracks = outputs_of(points), {}
    if points.tracked:
        wanted = ("reason", "shape", "frequency_hz")
        tracks = tracked(points, {name: store.read(name) for name in wanted if name in about})
    store.finish(
        tracks,
        final_attributes(
            points, blocks.each("reason"), blocks.each("warned"), tracks.get("tracked_doubtful")
        ),
    )


class _Told:
    """Tells how many cases are done."""

    def __init__(
        self, progress: Progress | None, plan: Plan, left: list[int] | None = None
    ) -> None:
        self._progress, self._plan = progress, plan
        self._done = plan.points.cases
        self._done -= sum(map(plan.cases, range(plan.blocks) if left is None else left))
        if left is not None:
            self._tell()

    def add(self, block: int) -> None:
        """Count a block."""
        self._done += self._plan.cases(block)
        self._tell()

    def _tell(self) -> None:
        if self._progress is not None:
            self._progress(self._done, self._plan.points.cases)


def _check_folder(path: Path) -> None:
    """Refuse a store that cannot be made."""
    if not path.parent.is_dir():
        raise InputError(f"{path}: there is no folder {path.parent}; make it, or name another")
    if path.exists() and not path.is_dir():
        raise InputError(f"{path}: this is a file; name a folder for the store")
    if not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"{path} cannot be written (Permission denied); name another folder")


def tracked(points: Points, arrays: Arrays) -> Arrays:
    """Follow the modes through all cases, if the study wants it."""
    if not points.tracked:
        return {}
    study = points.study
    x = tracking_points(study)
    hz = arrays["frequency_hz"] if "frequency_hz" in arrays else np.zeros(arrays["shape"].shape[:2])
    shapes = np.where(failed(arrays["reason"])[:, None, None], np.nan, arrays["shape"])
    found = track(shapes, hz, neighbours(points.shape), study.subject.mass_at(x), study.solve.modes)
    doubt = np.where(
        found.mac < study.tracking.doubtful, UNLIKE, np.where(found.swapped, SWAPPED, 0)
    )
    own = np.take_along_axis(hz, np.maximum(found.mode, 0), axis=1)
    return {
        "tracked_mode": found.mode.astype(np.int16),
        "tracked_mac": found.mac,
        "tracked_doubtful": doubt.astype(np.int8),
        "tracked_frequency_hz": np.where(found.mode >= 0, own, np.nan),
    }
