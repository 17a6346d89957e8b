"""Sweeps: every case of a study into a Dataset, in memory or through a store on disk.

    import antinode as an
    dataset = an.sweep(an.load_study("study.toml"))

The store holds what is needed to go on after any interruption; see `store.py`.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from antinode import __version__
from antinode.errors import InputError
from antinode.vehicle.case import Case

from .chunks import WHY, failed, mode_names
from .design import Points, points_of
from .executors import Arrays, Done, connect, joined, run_here, run_in_pool, run_on_dask
from .file import LOAD_OUTPUTS, MODE_OUTPUTS, Study
from .store import (
    FORMAT,
    Store,
    Variable,
    check_same,
    create,
    import_store,
    labelled,
    locked,
    open_store,
    remove,
)
from .tracking import neighbours, track

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], None]
"""Called with the number of cases that are done, and of all."""
MOST_IN_MEMORY = 2_000_000
MOST_TRACKED = 200_000
_TRACKED = ("tracked_mode", "tracked_mac", "tracked_frequency_hz")


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
    points = points_of(study)
    check_size(points, in_memory=store is None)
    import_store()
    if workers < 1:
        raise InputError(f"workers is {workers}; take 1 or more")
    with _executor(points, workers, scheduler) as run:
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


@contextmanager
def _executor(
    points: Points, workers: int, scheduler: str | None
) -> Iterator[Callable[[list[int]], Done]]:
    """Return what computes chunks."""
    if scheduler is not None:
        client = connect(scheduler)
        try:
            yield lambda chunks: run_on_dask(points, chunks, client)
        finally:
            client.close(timeout=5)
    elif workers > 1:
        yield lambda chunks: run_in_pool(points, chunks, min(workers, len(chunks)))
    else:
        yield lambda chunks: run_here(points, chunks)


def _in_memory(
    points: Points, run: Callable[[list[int]], Done], progress: Progress | None
) -> xarray.Dataset:
    import xarray

    found: dict[int, Arrays] = {}
    for chunk, arrays in run(list(range(points.chunks))):
        found[chunk] = arrays
        _tell(progress, points, found)
    arrays = joined(found[chunk] for chunk in range(points.chunks))
    arrays |= tracked(points, arrays)
    about = variables(points)
    data: dict[str, Any] = {
        name: (about[name].dims, arrays[name], about[name].attrs) for name in about
    }
    data.update(_fixed(points))
    everything = attributes(points) | _final(arrays["reason"])
    return labelled(xarray.Dataset(data, attrs=everything))


def _into_store(
    points: Points,
    path: Path,
    run: Callable[[list[int]], Done],
    progress: Progress | None,
    *,
    overwrite: bool,
) -> xarray.Dataset:
    attrs = attributes(points)
    about = variables(points)
    _check_folder(path)
    with locked(path):
        if path.exists() and overwrite:
            remove(path, attrs)
        if path.exists():
            check_same(path, attrs)
        else:
            create(path, about, _fixed(points), attrs, points.study.run.chunk)
        store = Store(path, points.study.run.chunk, points.cases)
        names = tuple(name for name in about if name not in _TRACKED)
        after = tuple(name for name in about if name in _TRACKED)
        missing = store.unfinished(names, after)
        for name, (_, values, _) in _fixed(points).items():
            store.mend(name, values)
        left = [c for c in missing if c < points.chunks]
        done = set(range(points.chunks)) - set(left)
        _tell(progress, points, done)
        for chunk, arrays in run(left) if left else ():
            store.write(chunk, arrays)
            done.add(chunk)
            _tell(progress, points, done)
        if missing:
            wanted = ("reason", "shape", "frequency_hz") if after else ("reason",)
            whole = {name: store.read(name) for name in wanted if name in about}
            store.finish(tracked(points, whole), _final(whole["reason"]))
    return open_store(path)


def _check_folder(path: Path) -> None:
    """Refuse a store that cannot be made."""
    if not path.parent.is_dir():
        raise InputError(f"{path}: there is no folder {path.parent}; make it, or name another")
    if path.exists() and not path.is_dir():
        raise InputError(f"{path}: this is a file; name a folder for the store")
    if not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"{path} cannot be written (Permission denied); name another folder")


def _tell(progress: Progress | None, points: Points, done: Any) -> None:
    if progress is not None:
        cases = sum(points.bounds(c)[1] - points.bounds(c)[0] for c in done)
        progress(cases, points.cases)


# --- what the result holds ---


def variables(points: Points) -> dict[str, Variable]:
    """Return every variable over cases, with units and meaning."""
    study, n = points.study, points.cases
    modes = len(mode_names(study))
    found = {
        v.name: Variable(("case",), (n,), "float64", {"units": v.unit, "long_name": _long_name(v)})
        for v in points.variables
    }
    found["reason"] = Variable(("case",), (n,), "int16", _reason_attrs())
    for name in study.outputs:
        each = name in MODE_OUTPUTS
        unit, text = (MODE_OUTPUTS if each else LOAD_OUTPUTS)[name]
        attrs = {"units": unit, "long_name": text}
        dims, shape = (("case", "mode"), (n, modes)) if each else (("case",), (n,))
        found[name] = Variable(dims, shape, "float64", attrs)
    if points.tracked:
        found |= _tracked_variables(study, n, modes)
    return found


def _long_name(variable: Any) -> str:
    if variable.kind == "time":
        return "time"
    return (
        f"factor on {variable.key}"
        if variable.unit == "1" and (variable.kind == "column" or variable.given.factor)
        else variable.key
    )


def _reason_attrs() -> dict[str, Any]:
    return {
        "long_name": "0 where a case was solved, else why it was not; 6 has an answer",
        "flag_values": list(WHY),
        "flag_meanings": list(WHY.values()),
    }


def _tracked_variables(study: Study, n: int, modes: int) -> dict[str, Variable]:
    points = study.tracking.points
    dims, shape = ("case", "track"), (n, modes)
    hz = {"units": "Hz", "long_name": "frequency of each tracked mode"}
    mac = {"units": "1", "long_name": "likeness with the neighbouring case (MAC)"}
    mode = {"long_name": "index of the mode that a track is; -1 where the case failed"}
    form = {"units": "1", "long_name": "shape of each mode, of unit norm"}
    return {
        "shape": Variable(("case", "mode", "point"), (n, modes, points), "float64", form),
        "tracked_mode": Variable(dims, shape, "int16", mode),
        "tracked_mac": Variable(dims, shape, "float64", mac),
        "tracked_frequency_hz": Variable(dims, shape, "float64", hz),
    }


def _fixed(points: Points) -> dict[str, tuple[str, npt.NDArray[Any], dict[str, Any]]]:
    """Return the coordinates that are known beforehand."""
    if not points.tracked:
        return {}
    x = np.linspace(0, points.study.case.vehicle.length, points.study.tracking.points)
    return {"point": ("point", x, {"units": "m", "long_name": "position from the nose"})}


def tracked(points: Points, arrays: Arrays) -> Arrays:
    """Follow the modes through all cases, if the study wants it."""
    if not points.tracked:
        return {}
    study = points.study
    mass = study.case.vehicle.mass_distribution(study.case.condition.burn_fraction)
    x = np.linspace(0, study.case.vehicle.length, study.tracking.points)
    hz = arrays["frequency_hz"] if "frequency_hz" in arrays else np.zeros(arrays["shape"].shape[:2])
    shapes = np.where(failed(arrays["reason"])[:, None, None], np.nan, arrays["shape"])
    found = track(shapes, hz, neighbours(points.shape), mass.at(x), study.solve.modes)
    own = np.take_along_axis(hz, np.maximum(found.mode, 0), axis=1)
    return {
        "tracked_mode": found.mode.astype(np.int16),
        "tracked_mac": found.mac,
        "tracked_frequency_hz": np.where(found.mode >= 0, own, np.nan),
    }


def attributes(points: Points) -> dict[str, Any]:
    """Return settings and provenance: what says which study, case and version this is."""
    study = points.study
    return {
        "title": study.name or f"Sweep of {study.case.vehicle.name}",
        "source": f"antinode {__version__}",
        "store_format": FORMAT,
        "antinode_version": __version__,
        "case_hash": case_hash(study.case),
        "study_hash": study_hash(study),
        "cases": points.cases,
        "shape": list(points.shape),
        "chunk": study.run.chunk,
        "design": study.design.kind,
        "seed": study.design.seed,
        "modes": study.solve.modes,
        "families": list(study.solve.families),
        "tolerance": study.solve.tolerance,
        "mode_names": mode_names(study),
        "input_names": [v.name for v in points.variables],
        "settings": json.dumps(_settings(study), sort_keys=True),
        "created": _now(),
    }


def _final(reason: npt.NDArray[Any]) -> dict[str, Any]:
    return {"failed": int(np.count_nonzero(failed(reason))), "finished": _now()}


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _settings(study: Study) -> dict[str, Any]:
    """Return the study as plain values, without its case, figure and the values of tables."""
    kept = study.model_dump(mode="json", exclude={"case", "figure"}, exclude_defaults=True)
    for given in kept.get("inputs", []):
        if len(given.get("values") or []) > 100:
            given["values"] = f"{len(given['values'])} values"
    return kept


def case_hash(case: Case) -> str:
    """Return what stands for a case: equal for equal numbers."""
    return _hash(case.model_dump(mode="json"))


def study_hash(study: Study) -> str:
    """Return what stands for a study; its figure and its name do not count."""
    return _hash(study.model_dump(mode="json", exclude={"case", "figure", "name"}))


def _hash(data: Any) -> str:
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:32]
