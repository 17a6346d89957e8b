"""What the result of a sweep holds: its arrays with units and meaning, settings, provenance."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.beam.attachments import is_damped
from antinode.beam.families import BENDING
from antinode.beam.file import BeamFile
from antinode.modes.result import not_modelled
from antinode.study.cases.chunks import mode_names
from antinode.study.cases.reasons import ANSWERS, WHY, failed
from antinode.study.cases.warned import counted_warnings, messages, type_of_bits
from antinode.study.design.file import CASE_OUTPUTS, MODE_OUTPUTS, Study
from antinode.study.design.points import GROWING, Points
from antinode.vehicle.case import Case
from antinode.version import __version__

from .build import sources_hash

if TYPE_CHECKING:
    import xarray

FORMAT = 3
TIMESTAMPS = ("created", "finished")
"""Attributes that differ from run to run."""
UNLIKE, SWAPPED = 1, 2
"""What is doubtful of a track: the mode is unlike its neighbour, or has another number there."""
TRACKED = ("tracked_mode", "tracked_mac", "tracked_doubtful", "tracked_frequency_hz")
"""Outputs that are known after all cases."""


class Output(NamedTuple):
    """An array of the result.

    Attributes
    ----------
    dims : tuple of str
        "case" first.
    shape : tuple of int
    dtype : str
    attrs : dict
        Units and meaning.
    """

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    dtype: str
    attrs: dict[str, Any]


class Coordinate(NamedTuple):
    """A coordinate that is known beforehand."""

    dim: str
    values: npt.NDArray[Any]
    attrs: dict[str, Any]


def outputs_of(points: Points) -> dict[str, Output]:
    """Return every variable over cases, with units and meaning."""
    study, n = points.study, points.cases
    modes = len(mode_names(study))
    found = {
        v.name: Output(("case",), (n,), "float64", {"units": v.unit, "long_name": _long_name(v)})
        for v in points.variables
    }
    found["reason"] = Output(("case",), (n,), "int16", _reason_attrs())
    found["warned"] = Output(("case",), (n,), type_of_bits(study), _warned_attrs(study))
    for name in study.outputs:
        each = name in MODE_OUTPUTS
        unit, text = (MODE_OUTPUTS | CASE_OUTPUTS)[name]
        attrs = {"units": unit, "long_name": text}
        dims, shape = (("case", "mode"), (n, modes)) if each else (("case",), (n,))
        found[name] = Output(dims, shape, "float64", attrs)
    for one in study.asked:
        about = {"units": one.unit, "long_name": one.label}
        wrong = {"units": one.unit, "long_name": f"error of {one.label}"}
        found[one.name] = Output(("case",), (n,), "float64", about)
        found[f"{one.name}_error"] = Output(("case",), (n,), "float64", wrong)
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
        "long_name": "0 where a case was solved, else why it was not; "
        f"{', '.join(map(str, ANSWERS[1:]))} have an answer",
        "flag_values": list(WHY),
        "flag_meanings": list(WHY.values()),
    }


def _warned_attrs(study: Study) -> dict[str, Any]:
    texts = messages(study)
    return {
        "long_name": "what a case warns of, a bit for each sentence; 0 of cases that failed",
        "flag_masks": [1 << k for k in range(len(texts))],
        "flag_meanings": list(texts),
    }


def _tracked_variables(study: Study, n: int, modes: int) -> dict[str, Output]:
    points = study.tracking.points
    dims, shape = ("case", "track"), (n, modes)
    hz = {"units": "Hz", "long_name": "frequency of each tracked mode"}
    mac = {"units": "1", "long_name": "likeness with the neighbouring case (MAC)"}
    limit = study.tracking.doubtful
    doubt = {
        "long_name": f"1 where tracked_mac is below {limit:g}: it may be another mode; 2 where the "
        "mode has another number than in the neighbour: it crossed one, or veered in that step"
    }
    mode = {"long_name": "index of the mode that a track is; -1 where the case failed"}
    form = {"units": "1", "long_name": "shape of each mode, of unit norm"}
    return {
        "shape": Output(("case", "mode", "point"), (n, modes, points), "float64", form),
        "tracked_mode": Output(dims, shape, "int16", mode),
        "tracked_mac": Output(dims, shape, "float64", mac),
        "tracked_doubtful": Output(dims, shape, "int8", doubt),
        "tracked_frequency_hz": Output(dims, shape, "float64", hz),
    }


def coordinates_of(points: Points) -> dict[str, Coordinate]:
    """Return the coordinates that are known beforehand."""
    names = np.array(mode_names(points.study), dtype=object)
    found = {"mode": Coordinate("mode", names, {})}
    if points.tracked:
        about = {"units": "m", "long_name": "position from the nose"}
        found["track"] = Coordinate("track", names, {})
        found["point"] = Coordinate("point", tracking_points(points.study), about)
    return found


def tracking_points(study: Study) -> npt.NDArray[np.float64]:
    """Return where shapes are compared [m]."""
    return study.subject.points(study.tracking.points)


def attributes(points: Points) -> dict[str, Any]:
    """Return settings and provenance: what says which study, case and version this is."""
    study = points.study
    return {
        "title": study.name or f"Sweep of {study.subject.name}",
        "source": f"antinode {__version__}",
        "store_format": FORMAT,
        "antinode_version": __version__,
        "sources_hash": sources_hash(),
        "case_hash": case_hash(study.case),
        "study_hash": study_hash(study),
        "cases": points.cases,
        "shape": list(points.shape),
        "chunk": study.run_table.chunk,
        "design": study.design.kind,
        "seed": study.design.seed,
        "modes": study.solve.modes,
        "families": list(study.solve.families),
        "tolerance": study.solve.tolerance,
        "mode_names": mode_names(study),
        "input_names": [v.name for v in points.variables],
        "not_modelled": list(missing(study)),
        "settings": json.dumps(_settings(study), sort_keys=True),
        "created": _now(),
    }


def missing(study: Study) -> tuple[str, ...]:
    """Return what the model of a study's case leaves out, as of its own numbers."""
    beam = study.case.beam()
    return not_modelled(beam, is_damped(beam.attachments, BENDING))


def final_attributes(
    points: Points,
    reasons: Iterable[npt.NDArray[Any]],
    bits: Iterable[npt.NDArray[Any]],
    doubtful: npt.NDArray[Any] | None,
) -> dict[str, Any]:
    """Return what is known after all cases: how many failed, and what they warn of.

    Parameters
    ----------
    points : Points
    reasons, bits : iterable of array of int
        The variables `reason` and `warned`, one block after the other.
    doubtful : array of int, shape (cases, tracks), or None
        Which modes are doubtful, if they are tracked.
    """
    study, found = points.study, counted_warnings(messages(points.study), bits, points.cases)
    if doubtful is not None:
        told = (
            "a mode is so unlike its neighbour (MAC below tracking.doubtful = "
            f"{study.tracking.doubtful:g}) that the track may go on along another one: take more "
            "values between them"
        )
        crossed = (
            "two modes of a family change their order between neighbours: they crossed, or veered "
            "within that one step, and then the tracks should have stayed apart: take more values "
            "between them"
        )
        marks = np.any(doubtful == UNLIKE, axis=1) + 2 * np.any(doubtful == SWAPPED, axis=1)
        found += counted_warnings([told, crossed], [marks], points.cases)
    number = sum(int(np.count_nonzero(failed(some))) for some in reasons)
    return {"failed": number, "warnings": found, "finished": _now()}


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _settings(study: Study) -> dict[str, Any]:
    """Return the study as plain values, without its case, figure and the values of tables."""
    kept = study.model_dump(
        mode="json", exclude={"case", "figure"}, exclude_defaults=True, by_alias=True
    )
    for given in kept.get("inputs", []):
        if len(given.get("values") or []) > 100:
            given["values"] = f"{len(given['values'])} values"
    return kept


def case_hash(case: Case | BeamFile) -> str:
    """Return what stands for a case: equal for equal numbers."""
    return _hash(case.model_dump(mode="json"))


def study_hash(study: Study) -> str:
    """Return what stands for a study; its figure and its name do not count.

    Nor does the number of samples of a design that can grow.
    """
    kept = study.model_dump(mode="json", exclude={"case", "figure", "name"}, by_alias=True)
    if study.design.kind in GROWING:
        kept["design"].pop("number")
    return _hash(kept)


def _hash(data: Any) -> str:
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def labelled(dataset: xarray.Dataset) -> xarray.Dataset:
    """Return the Dataset of a store with its inputs and names as coordinates."""
    names = dataset.attrs["mode_names"]
    coordinates: dict[str, Any] = {"mode": list(names)}
    if "track" in dataset.sizes:
        coordinates["track"] = list(names)
    inputs = [name for name in dataset.attrs["input_names"] if name in dataset]
    kept = dataset.drop_vars("checksum", errors="ignore")
    return kept.assign_coords(coordinates).set_coords([*inputs, *_present(kept, ("point",))])


def blank(points: Points) -> xarray.Dataset:
    """Return what a result looks like before anything is solved: one case, all numbers 0."""
    import xarray

    data: dict[str, Any] = {
        name: (about.dims, np.zeros((1, *about.shape[1:])), about.attrs)
        for name, about in outputs_of(points).items()
    }
    data.update(coordinates_of(points))
    return labelled(xarray.Dataset(data, attrs=attributes(points)))


def _present(dataset: xarray.Dataset, names: tuple[str, ...]) -> list[str]:
    return [name for name in names if name in dataset.variables]
