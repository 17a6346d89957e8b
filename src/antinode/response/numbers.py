"""Numbers as JSON takes them; and those few that a response comes to."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np


def plain(values: Any) -> Any:
    """Return an array, or a number, as lists of floats with None for what is no finite number."""
    array = np.asarray(values, dtype=float)
    if array.ndim == 0:
        return float(array) if math.isfinite(array) else None
    if np.isfinite(array).all():
        return array.tolist()
    return [plain(value) for value in array]


class Headline(NamedTuple):
    """One number that a response comes to."""

    key: str
    """By its place in the response file: ``outputs.0.rms``, ``equipment.1.margin``."""
    label: str
    value: float
    error: float
    """How wrong it may be, in the same unit; NaN where that is not known."""
    unit: str


def headlines(result: Any) -> tuple[Headline, ...]:
    """Return what a response comes to, for tables and studies.

    Parameters
    ----------
    result : HarmonicResult, RandomResult, TransientResult or ShockResult

    Returns
    -------
    tuple of Headline
        Of each output the largest amplitude among the frequencies of the file, the rms, the largest
        of the history or of the shock spectrum, SI; of each piece of equipment the margin [dB],
        whose error is not known.
    """
    names = {"harmonic": "largest", "random": "rms", "transient": "peak", "shock": "srs"}
    name, rows = names[result.kind], []
    for row, output in enumerate(result.outputs):
        value, error = _number(result, row)
        label = f"{name} {output.name}"
        rows.append(Headline(f"outputs.{row}.{name}", label, value, error, output.unit))
    for row, verdict in enumerate(getattr(result, "verdicts", ())):
        label = f"margin of {verdict.name}"
        rows.append(Headline(f"equipment.{row}.margin", label, verdict.margin_db, math.nan, "dB"))
    return tuple(rows)


def _number(result: Any, row: int) -> tuple[float, float]:
    """Return the number of an output, and its error."""
    if result.kind == "random":
        return result.statistics[row].rms, result.statistics[row].error
    if result.kind == "transient":
        return abs(result.largest[row][1]), float(result.peak_error[row])
    values = result.values if result.kind == "harmonic" else result.srs
    return float(np.max(np.abs(values[row]))), float(result.error[row])
