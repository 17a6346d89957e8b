"""Numbers as JSON takes them; and those few that a response comes to."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
    """How wrong it may be, in the same unit."""
    unit: str


class Asked(NamedTuple):
    """What one such number is, before anything is solved."""

    key: str
    label: str
    unit: str

    @property
    def name(self) -> str:
        """As a variable of a study: ``outputs_0_rms``."""
        return self.key.replace(".", "_")


NAMES = {"harmonic": "largest", "random": "rms", "transient": "peak", "shock": "srs"}


def asked_of(kind: str, outputs: Sequence[Any], equipment: Sequence[Any]) -> tuple[Asked, ...]:
    """Return what a response comes to, by its kind, its outputs, and its equipment."""
    name = NAMES[kind]
    rows = [
        Asked(f"outputs.{row}.{name}", f"{name} {output.name}", output.unit)
        for row, output in enumerate(outputs)
    ]
    rows += [
        Asked(f"equipment.{row}.margin", f"margin of {item.name}", "dB")
        for row, item in enumerate(equipment)
    ]
    return tuple(rows)


def headlines(result: Any) -> tuple[Headline, ...]:
    """Return what a response comes to, for tables and studies.

    Parameters
    ----------
    result : HarmonicResult, RandomResult, TransientResult or ShockResult

    Returns
    -------
    tuple of Headline
        Of each output the largest amplitude in the band, peaks between the frequencies of the file
        included; the rms; the largest of the history, or of the shock spectrum at the frequencies
        of the file, SI. Of each piece of equipment the margin [dB].
    """
    verdicts = getattr(result, "verdicts", ())
    numbers = [_number(result, row) for row in range(len(result.outputs))]
    numbers += [(verdict.margin_db, verdict.error_db) for verdict in verdicts]
    asked = asked_of(result.kind, result.outputs, verdicts)
    return tuple(
        Headline(one.key, one.label, *number, one.unit)
        for one, number in zip(asked, numbers, strict=True)
    )


def _number(result: Any, row: int) -> tuple[float, float]:
    """Return the number of an output, and its error."""
    if result.kind == "random":
        return result.statistics[row].rms, result.statistics[row].error
    if result.kind == "transient":
        return abs(result.largest[row][1]), float(result.peak_error[row])
    if result.kind == "shock":
        srs, off = result.srs[row], result.off[row]
        most, least = float(np.max(srs + off)), float(np.max(srs - off))
        return float(np.max(srs)), max(most - float(np.max(srs)), float(np.max(srs)) - least)
    at_most = max((peak.size for peak in result.peaks[row]), default=0.0)
    largest = max(at_most, float(np.max(np.abs(result.values[row]))))
    return largest, float(max(result.error[row], result.peak_error[row]))
