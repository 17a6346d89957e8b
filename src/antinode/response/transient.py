"""Transient responses: histories of outputs under forces that run straight between points.

Modes move exactly (`recurrence`), those left out rest under the force as it is (`modal_sum`).
A loss factor acts as the viscous ratio that loses as much at each mode's resonance: time knows no
loss factor. The stated error is what the last part of the modes still changed, and what chords of
formulas differ from their curves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arguments import ByValue
from antinode.arrays import Array
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.methods import ResponseMethods

from .damping import Damping
from .file import Problem
from .frequency import Model
from .harmonic import output_keys
from .histories import History, history_from
from .modal import MOST_MODES, Basis
from .modal_sum import SHAPE, Summed
from .motion.loops import Closed, summed
from .motion.recurrence import move, move_coupled, move_together, twice_integrated
from .numbers import plain
from .quantities import Base, Drive, Output

_FIRST = 16  # modes of each family that one begins with
_MOST = 160
_TAIL = 2.0  # times the upper half of the modes, that all beyond may do
_WANTED = 1e-3  # error over peak that is enough where no number of modes is given


@dataclass(frozen=True, eq=False, repr=False)
class TransientResult(ResponseMethods, ByValue):
    """Histories of outputs.

    Attributes
    ----------
    title : str
    time_s : array, shape (k,)
    outputs : tuple of Output
    values : array, shape (outputs, k)
        SI.
    error : array, shape (outputs,)
        Of all values, by modes left out and chords.
    largest : tuple of (float, float)
        Time and value of the largest modulus of each output, between the times as well.
    peak_error : array, shape (outputs,)
        Of that modulus.
    count : int
        Modes that were summed.
    modes : tuple of Basis
    damping : Damping
    warnings : tuple of str
    """

    title: str
    time_s: Array
    outputs: tuple[Output, ...]
    values: Array = field(repr=False)
    error: Array
    largest: tuple[tuple[float, float], ...]
    peak_error: Array
    count: int
    modes: tuple[Basis, ...] = field(repr=False)
    damping: Damping
    warnings: tuple[str, ...]

    kind = "transient"

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON."""
        rows = [
            {
                **output_keys(output),
                "value": plain(self.values[row]),
                "error": plain(self.error[row]),
                "peak": plain(abs(self.largest[row][1])),
                "peak_time_s": self.largest[row][0],
                "peak_error": plain(self.peak_error[row]),
            }
            for row, output in enumerate(self.outputs)
        ]
        return {
            "schema_version": 1,
            "kind": self.kind,
            "name": self.title,
            "damping": self.damping.describe(),
            "modes": self.count,
            "time_s": self.time_s.tolist(),
            "outputs": rows,
            "warnings": list(self.warnings),
        }

    def curves(self) -> list[tuple[Output, Drive | None, Array, Array, str]]:
        """Return output, no drive, times, history and unit, for universal files."""
        rows = zip(self.outputs, self.values, strict=True)
        return [(o, None, self.time_s, values, o.unit) for o, values in rows]

    def columns(self) -> list[tuple[str, Array]]:
        """Return a table: time, then each output."""
        rows = zip(self.outputs, self.values, strict=True)
        return [("time [s]", self.time_s), *((f"{o.name} [{o.unit}]", v) for o, v in rows)]


class Driven:
    """Forces over time on a grid that has all their kinks.

    Parameters
    ----------
    histories : sequence of History
    time_s : array
        Times that are asked for.
    """

    def __init__(self, histories: tuple[History, ...], time_s: Array) -> None:
        kinks = np.concatenate([h.time_s for h in histories])
        inside = kinks[(kinks > time_s[0]) & (kinks < time_s[-1])]
        places = np.sort(np.concatenate([time_s, inside]))
        apart = np.diff(places, prepend=-np.inf) > 1e-12 * max(abs(time_s[-1]), 1e-300)
        self.time_s = places[apart]
        self.start = np.array([h.after(self.time_s[:-1]) for h in histories]).T
        self.end = np.array([h.before(self.time_s[1:]) for h in histories]).T
        self.asked = np.clip(
            np.searchsorted(self.time_s, time_s - 1e-12 * abs(time_s[-1])), 0, len(self.time_s) - 1
        )
        self.value = np.vstack([self.start, self.end[-1:]])
        slope = (self.end - self.start) / np.diff(self.time_s)[:, None]
        self.slope = np.vstack([slope, slope[-1:]])


class Histories:
    """Outputs of one model over time, mode by mode.

    Parameters
    ----------
    summed : Summed or Closed
        Modes of one family with their static rest.
    driven : Driven
    """

    def __init__(self, summed: Summed | Closed, driven: Driven) -> None:
        self.summed, self.driven = summed, driven
        own = summed.basis
        start, end = driven.start @ own.drives.T, driven.end @ own.drives.T
        C = own.damping
        if own.coupling is not None:
            K = np.diag(own.omega2) + own.coupling
            self.motion = move_coupled(K, C, own.drives, driven.time_s, driven.start, driven.end)
        elif np.any(C - np.diag(np.diag(C))):
            self.motion = move_together(own.omega2, C, driven.time_s, start, end)
        else:
            self.motion = move(own.omega2, np.diag(C), driven.time_s, start, end)
        self.force = np.vstack([start, end[-1:]])

    def values(self) -> Array:
        """Return all outputs, (outputs, times); zeros of other families."""
        own, driven, rest = self.summed.basis, self.driven, self.summed.rest
        q, rate = self.motion
        y = np.zeros((len(self.summed.model.outputs), len(driven.time_s)))
        moved = self._ground()
        for row, output in enumerate(self.summed.model.outputs):
            if output.family != self.summed.family:
                continue
            c = own.outputs[row]
            if output.rate == 0:
                y[row] = q @ c + driven.value @ rest[row] + rate @ own.drag[row]
            elif output.rate == 1:
                y[row] = rate @ c + driven.slope @ rest[row]
            else:
                y[row] = self.acceleration @ c
            if output.moves and not output.relative:
                y[row] += moved[output.rate]
        return y

    @property
    def acceleration(self) -> Array:
        """Accelerations of the modal coordinates, (times, n)."""
        own = self.summed.basis
        pulled = self.motion.q * own.omega2
        if own.coupling is not None:
            pulled = pulled + self.motion.q @ own.coupling.T
        return np.asarray(self.force - self.motion.rate @ own.damping.T - pulled)

    def left_out(self, values: Array) -> Array:
        """Return what modes beyond the last may still change of `values`, (outputs,).

        `_TAIL` times the sum of the largest that each of the upper half does beyond its rest; where
        forces depend on motion at least what the upper half changes altogether.
        """
        own, driven, shift = self.summed.basis, self.driven, self.summed.shift
        upper = np.argsort(own.omega2, kind="stable")[len(own.omega2) // 2 :]
        rest = own.drives[upper] / (own.omega2[upper] + shift)[:, None]
        at_rest = driven.value @ rest.T, driven.slope @ rest.T, np.zeros(len(upper))
        own_parts = self.motion.q, self.motion.rate, self.acceleration
        beyond = [part[:, upper] - still for part, still in zip(own_parts, at_rest, strict=True)]
        tail = _TAIL * self._largest(own.outputs[:, upper], beyond)
        tail = tail + self._largest(own.outputs * self._doubtful(), own_parts)
        if not isinstance(self.summed, Closed):
            return np.asarray(tail)
        few = Histories(self.summed.half, driven).values()
        return np.asarray(np.maximum(tail, np.max(np.abs(values - few), axis=1)))

    def _largest(self, outputs: Array, parts: Sequence[Array]) -> Array:
        """Return the sums over modes of the largest of motions, rates or accelerations."""
        most = [np.max(np.abs(part), axis=0) for part in parts]
        size = np.array([most[output.rate] for output in self.summed.model.outputs])
        return np.asarray(np.sum(np.abs(outputs) * size, axis=1))

    def _doubtful(self) -> Array:
        """Return how wrong each mode's motion may be, relative: its shape, and its phase at last.

        A frequency that is off drifts until the mode has rung down, or to the end.
        """
        own, time = self.summed.basis, self.driven.time_s
        square = np.abs(own.omega2)
        elastic = square > 1e-9 * np.max(square)
        safe, drag = np.where(elastic, square, 1.0), np.abs(np.diag(own.damping))
        rings = np.minimum(time[-1] - time[0], 2 / np.maximum(drag, 1e-300))
        phase = np.where(elastic, own.doubts / (2 * np.sqrt(safe)) * rings, 0.0)
        return np.asarray(phase + SHAPE * np.max(np.where(elastic, own.doubts / safe, 0.0)))

    def _ground(self) -> tuple[Array, Array, Array]:
        """Return displacement, velocity and acceleration of the ground."""
        driven, model = self.driven, self.summed.model
        cases = [
            case
            for case, drive in enumerate(model.drives)
            if isinstance(drive, Base) and drive.family == self.summed.family
        ]
        start, end = (part[:, cases].sum(axis=1)[:, None] for part in (driven.start, driven.end))
        displacement, velocity = twice_integrated(driven.time_s, start, end)
        return displacement[:, 0], velocity[:, 0], driven.value[:, cases].sum(axis=1)


def histories_of(problem: Problem) -> tuple[History, ...]:
    """Return the histories of a file's drives.

    Raises
    ------
    InputError
        If one is no history, or the ground's is not its acceleration.
    """
    file = problem.file
    found = []
    for (name, table), drive in zip(file.drive_tables(), file.drives, strict=True):
        if isinstance(drive, Base) and drive.rate != 2:
            raise InputError(
                f"{problem.where}: base.motion is {drive.motion}; over time the motion of the "
                "supports is given as acceleration: differentiate it"
            )
        where = f"{problem.where}: {name}.history"
        found.append(history_from(table.history, drive.unit, problem.folder, where))
    return tuple(found)


def respond(
    model: Model, histories: tuple[History, ...], time_s: Array, modes: int | None
) -> tuple[Array, Array, Array, Driven, tuple[Basis, ...], int]:
    """Return outputs on the grid of kinks, errors, the part of chords, grid, modes, number."""
    driven = Driven(histories, time_s)
    y = np.zeros((len(model.outputs), len(driven.time_s)))
    error, chords = np.zeros(len(y)), np.zeros(len(y))
    bases, count = [], 0
    for family in model.families:
        number = modes or _FIRST
        while True:
            own = Histories(summed(model, family, number), driven)
            n = len(own.summed.basis.omega2)
            part = own.values()
            wrong = own.left_out(part)
            peak = np.max(np.abs(part), axis=1)
            if modes or np.all(wrong <= _WANTED * peak) or 2 * number > min(_MOST, MOST_MODES):
                break
            number *= 2
        y, error = y + part, error + wrong
        chords = chords + _chords(own.summed, histories)
        bases.append(own.summed.basis)
        count += n
    return y, error + chords, chords, driven, tuple(bases), count


def _chords(summed: Summed | Closed, histories: tuple[History, ...]) -> Array:
    """Return how far chords may move outputs: each mode doubles at most what it does at rest."""
    own, model = summed.basis, summed.model
    chord = np.array([h.chord for h in histories])
    stiff = np.abs(own.omega2)
    static = np.where(stiff > 1e-9 * np.max(stiff), 1 / np.where(stiff > 0, stiff, 1.0), 0.0)
    found = np.zeros(len(model.outputs))
    for row, output in enumerate(model.outputs):
        rate = np.sqrt(stiff) ** output.rate
        found[row] = 2 * np.abs(own.outputs[row]) * static * rate @ np.abs(own.drives) @ chord
    return found


@out_of_range_is_an_error()
def solve_transient(problem: Problem) -> TransientResult:
    """Compute the histories that a file asks for."""
    file, damping = problem.file, problem.damping
    assert file.time is not None
    time = file.time.seconds()
    histories = histories_of(problem)
    model = Model(
        problem.beam, file.drives, file.outputs, damping, 1 / file.time.to, problem.backend
    )
    y, error, _, driven, bases, count = respond(model, histories, time, file.response.modes)
    largest, between = peaks_of(driven.time_s, y)
    return TransientResult(
        problem.title,
        time,
        model.outputs,
        y[:, driven.asked],
        error,
        largest,
        error + between,
        count,
        bases,
        damping,
        tuple(slow_warnings(model, y, error)),
    )


def slow_warnings(model: Model, y: Array, error: Array) -> list[str]:
    """Say which outputs sums of modes do not settle."""
    size = np.max(np.abs(y), axis=1)
    slow = [
        f"{output.name} ({100 * e / s:.2g} %)"
        for output, e, s in zip(model.outputs, error, size, strict=True)
        if e > 5 * _WANTED * s
    ]
    if not slow:
        return []
    return [
        f"modes left out still change {'; '.join(slow[:4])}: a force that jumps, or a shock "
        "shorter than a mode's period, shakes all modes; see the errors, smooth the force, or set "
        "response.modes"
    ]


def peaks_of(time_s: Array, y: Array) -> tuple[tuple[tuple[float, float], ...], Array]:
    """Return time and value of the largest modulus of histories, and what may be between times.

    By the parabola through three points; second differences bound what other places may hide.
    """
    found, between = [], np.zeros(len(y))
    for row, values in enumerate(y):
        size = np.abs(values)
        k = int(np.argmax(size))
        time, value = float(time_s[k]), float(values[k])
        if 0 < k < len(values) - 1:
            time, value = _parabola(time_s[k - 1 : k + 2], values[k - 1 : k + 2], (time, value))
        bend = np.zeros(len(values))
        bend[1:-1] = np.abs(values[2:] - 2 * values[1:-1] + values[:-2]) / 8
        reach = float(np.max(size + np.maximum.reduce([bend, np.roll(bend, 1), np.roll(bend, -1)])))
        between[row] = max(reach - abs(value), 0.0) + 0.5 * abs(abs(value) - float(size[k]))
        found.append((time, value))
    return tuple(found), between


def _parabola(t: Array, v: Array, else_: tuple[float, float]) -> tuple[float, float]:
    """Return the vertex of a parabola through three points, if it lies between them."""
    a, b = (v[1] - v[0]) / (t[1] - t[0]), (v[2] - v[1]) / (t[2] - t[1])
    bend = (b - a) / (t[2] - t[0])
    if bend == 0 or bend * v[1] > 0:
        return else_
    vertex = (t[0] + t[1]) / 2 - a / (2 * bend)
    if not t[0] < vertex < t[2]:
        return else_
    value = v[0] + a * (vertex - t[0]) + bend * (vertex - t[0]) * (vertex - t[1])
    return float(vertex), float(value)
