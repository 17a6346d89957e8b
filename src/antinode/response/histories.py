"""Histories: forces and motions over time, straight between their points, by table or by formula.

Formulas are sampled where they bend, and exactly straight elsewhere: a half sine has points enough
that the chords stay within a given share of its height.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from antinode.arguments import ByValue, numbers
from antinode.arrays import Array, Integers, Numbers
from antinode.errors import InputError

from .units import in_si, read_columns


@dataclass(frozen=True, eq=False)
class History(ByValue):
    """Values over time, straight between points; zero before the first one, held after the last.

    Parameters
    ----------
    time_s : array, shape (n,)
        Not decreasing [s]; two points at one time are a jump.
    value : array, shape (n,)
    chord : float
        How far the straight lines may be from what they stand for, in the unit of the values.
    name : str
        For messages.
    """

    time_s: Array
    value: Array
    chord: float = 0.0
    name: str = "the history"

    def __post_init__(self) -> None:
        t, v = (numbers(name, getattr(self, name)) for name in ("time_s", "value"))
        object.__setattr__(self, "time_s", t)
        object.__setattr__(self, "value", v)
        if t.ndim != 1 or t.shape != v.shape or len(t) < 2:
            raise InputError(f"{self.name}: it needs two points or more, a value for each time")
        if not (np.isfinite(t).all() and np.isfinite(v).all()):
            raise InputError(f"{self.name}: every time and value must be a finite number")
        for row in np.flatnonzero(np.diff(t) < 0)[:1]:
            raise InputError(
                f"{self.name}: {t[row + 1]:g} s in row {row + 2} follows {t[row]:g} s; sort the "
                "rows by time"
            )
        for row in np.flatnonzero((np.diff(t)[1:] == 0) & (np.diff(t)[:-1] == 0))[:1]:
            raise InputError(f"{self.name}: three rows are at {t[row]:g} s; two make a jump")

    def before(self, time_s: Array) -> Array:
        """Return the values just before given times: the left one at a jump."""
        t, v = self.time_s, self.value
        k = np.searchsorted(t, time_s, side="left")
        return self._between(np.clip(k, 1, len(t) - 1), time_s, k == 0, k >= len(t), v)

    def after(self, time_s: Array) -> Array:
        """Return the values just after given times: the right one at a jump."""
        t, v = self.time_s, self.value
        k = np.searchsorted(t, time_s, side="right")
        return self._between(np.clip(k, 1, len(t) - 1), time_s, k == 0, k >= len(t), v)

    def _between(
        self, k: Integers, time_s: Array, early: Numbers, late: Numbers, v: Array
    ) -> Array:
        t = self.time_s
        step = t[k] - t[k - 1]
        share = np.clip((time_s - t[k - 1]) / np.where(step > 0, step, 1.0), 0.0, 1.0)
        value = v[k - 1] + (v[k] - v[k - 1]) * share
        return np.asarray(np.where(early, 0.0, np.where(late, v[-1], value)))


def half_sine(height: float, duration: float, start: float, chord: float) -> History:
    """Return half a sine wave, its chords within `chord` of the height."""
    points = 2 * int(np.ceil(np.pi / np.sqrt(8 * chord) / 2)) + 1
    t = np.linspace(0.0, duration, points)
    return History(start + t, height * np.sin(np.pi * t / duration), chord * abs(height))


def step(height: float, duration: float, start: float, chord: float) -> History:
    """Return a step that rises in no time and stays."""
    del chord
    return History(np.array([start, start, start + duration]), height * np.array([0.0, 1.0, 1.0]))


def ramp(height: float, duration: float, start: float, chord: float) -> History:
    """Return a straight rise over a duration, which stays: a thrust that builds up."""
    del chord
    return History(np.array([start, start + duration]), height * np.array([0.0, 1.0]))


def smooth_rise(height: float, duration: float, start: float, chord: float) -> History:
    """Return a rise ``(1 - cos(pi t/T))/2`` over a duration, which stays."""
    points = 2 * int(np.ceil(np.pi / np.sqrt(16 * chord) / 2)) + 1
    t = np.linspace(0.0, duration, points)
    return History(
        start + t, height * (1 - np.cos(np.pi * t / duration)) / 2, chord * abs(height) / 2
    )


def rectangle(height: float, duration: float, start: float, chord: float) -> History:
    """Return a pulse of constant height."""
    del chord
    t = start + duration * np.array([0.0, 0.0, 1.0, 1.0])
    return History(t, height * np.array([0.0, 1.0, 1.0, 0.0]))


def triangle(height: float, duration: float, start: float, chord: float) -> History:
    """Return a pulse that rises and falls straight."""
    del chord
    return History(start + duration * np.array([0.0, 0.5, 1.0]), height * np.array([0.0, 1.0, 0.0]))


def sawtooth(height: float, duration: float, start: float, chord: float) -> History:
    """Return a pulse that rises straight and ends at its peak."""
    del chord
    return History(start + duration * np.array([0.0, 1.0, 1.0]), height * np.array([0.0, 1.0, 0.0]))


Formula = Callable[[float, float, float, float], History]
FORMULAS: dict[str, Formula] = {
    "half_sine": half_sine,
    "step": step,
    "ramp": ramp,
    "smooth_rise": smooth_rise,
    "rectangle": rectangle,
    "triangle": triangle,
    "sawtooth": sawtooth,
}
_KEYS = ("shape", "height", "duration", "start", "period", "count")
CHORD = 1e-5
"""Share of its height that the chords of a formula may be away from it."""


def history_from(source: object, unit: str, folder: Path, where: str) -> History:
    """Return a history as a file has it.

    Parameters
    ----------
    source : str or dict
        The name of a CSV file of time and value; or a table with `time` and `value` as lists; or
        with `shape`, `height`, `duration`, `start`; and, for a train of pulses, `period`, `count`.
    unit : str
        SI unit of the values.
    folder : Path
    where : str
        For messages.
    """
    if isinstance(source, str):
        path = folder / source
        columns = read_columns(path, ("time", "value"), ("s", unit))
        return History(*columns, name=str(path))
    if isinstance(source, dict) and set(source) == {"time", "value"}:
        return _listed(source, unit, where)
    if not isinstance(source, dict) or source.get("shape") not in FORMULAS:
        raise InputError(
            f"{where} must be the name of a CSV file, {{ time = [...], value = [...] }}, or "
            "{ shape = '...', height = ..., duration = ... } with a shape of "
            f"{', '.join(FORMULAS)}"
        )
    for key in source:
        if key not in _KEYS:
            raise InputError(
                f"{where}: unknown key {str(key)[:40]}; allowed are {', '.join(_KEYS)}"
            )
    height = in_si(source.get("height", 1.0), unit, f"{where}.height")
    missing = 1.0 if source["shape"] == "step" else None  # a step stays as it is
    duration = in_si(source.get("duration", missing), "s", f"{where}.duration")
    start = in_si(source.get("start", 0.0), "s", f"{where}.start")
    if not duration > 0:
        raise InputError(f"{where}.duration is {duration:g} s; it must be above 0")
    pulse = FORMULAS[source["shape"]](height, duration, start, CHORD)
    count = source.get("count", 1)
    if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count <= 10_000:
        raise InputError(f"{where}.count must be a whole number, 1 to 10000")
    if count == 1:
        return History(pulse.time_s, pulse.value, pulse.chord, where)
    period = in_si(source.get("period"), "s", f"{where}.period")
    if period < duration or pulse.value[-1] != 0.0:
        raise InputError(
            f"{where}: a train needs pulses that end at 0, and a period of at least the duration "
            f"({duration:g} s)"
        )
    later = np.arange(count)[:, None] * period
    t = (pulse.time_s + later).ravel()
    return History(t, np.tile(pulse.value, count), pulse.chord, where)


def _listed(source: dict[str, object], unit: str, where: str) -> History:
    """Return a history from lists of times and values."""
    columns = []
    for key, of in (("time", "s"), ("value", unit)):
        given = source[key]
        if not isinstance(given, list):
            raise InputError(f"{where}: time and value are lists of as many numbers")
        columns.append(np.array([in_si(one, of, f"{where}.{key}") for one in given]))
    return History(columns[0], columns[1], name=where)
