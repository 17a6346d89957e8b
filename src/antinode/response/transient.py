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
from .motion.oscillators import Gains, Linear, Seen
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
    longest : float
        No step is longer [s].
    """

    def __init__(
        self, histories: tuple[History, ...], time_s: Array, longest: float = np.inf
    ) -> None:
        self.histories = histories
        kinks = np.concatenate([h.time_s for h in histories])
        inside = kinks[(kinks > time_s[0]) & (kinks < time_s[-1])]
        places = np.sort(np.concatenate([time_s, inside]))
        apart = np.diff(places, prepend=-np.inf) > 1e-12 * max(abs(time_s[-1]), 1e-300)
        self.time_s = _cut(places[apart], longest)
        self.start = np.array([h.after(self.time_s[:-1]) for h in histories]).T
        self.end = np.array([h.before(self.time_s[1:]) for h in histories]).T
        self.asked = np.clip(
            np.searchsorted(self.time_s, time_s - 1e-12 * abs(time_s[-1])), 0, len(self.time_s) - 1
        )
        self.value = np.vstack([self.start, self.end[-1:]])
        slope = (self.end - self.start) / np.diff(self.time_s)[:, None]
        self.slope = np.vstack([slope, slope[-1:]])


def _cut(time_s: Array, longest: float) -> Array:
    """Return times with as many more between them as makes no step longer."""
    h = np.diff(time_s)
    parts = np.maximum(np.ceil(h / longest * (1 - 1e-9)), 1).astype(int)
    first = np.repeat(np.cumsum(parts) - parts, parts)
    share = (np.arange(np.sum(parts)) - first) / np.repeat(parts, parts)
    inside = np.repeat(time_s[:-1], parts) + share * np.repeat(h, parts)
    return np.append(inside, time_s[-1])


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

    @property
    def linear(self) -> Linear:
        """The modes, and the ground as one that nothing holds, as `oscillators` takes them."""
        own, driven = self.summed.basis, self.driven
        n = len(own.omega2)
        K, C = np.zeros((2, n + 1, n + 1))
        K[:n, :n] = np.diag(own.omega2) + (0.0 if own.coupling is None else own.coupling)
        C[:n, :n] = own.damping
        ground = np.zeros(own.drives.shape[1])
        ground[self._shaken] = 1.0
        moved = self._ground()
        q, rate = (np.column_stack([part, moved[k]]) for k, part in enumerate(self.motion))
        into = np.vstack([own.drives, ground])
        return Linear(K, C, into, driven.time_s, q, rate, driven.start, driven.end)

    def seen(self, row: int, linear: Linear) -> Seen:
        """Return what an output of this family takes of `linear`."""
        own, output, rest = self.summed.basis, self.summed.model.outputs[row], self.summed.rest[row]
        absolute = float(output.moves and not output.relative)
        c, none = np.append(own.outputs[row], absolute), np.zeros_like(rest)
        if output.rate == 0:
            return Seen(c, np.append(own.drag[row], 0.0), rest, none)
        if output.rate == 1:
            return Seen(np.zeros_like(c), c, none, rest)
        return Seen(-c @ linear.stiffness, -c @ linear.damping, c @ linear.into, none)

    def felt(self, gains: Gains) -> Array:
        """Return what oscillators on each output may feel of what `left_out` states, (outputs, f).

        Mode by mode: slow ones hardly feel fast modes.
        """
        own, outputs = self.summed.basis, self.summed.model.outputs
        upper = np.argsort(own.omega2, kind="stable")[len(own.omega2) // 2 :]
        weight = self._doubtful()
        weight[upper] += _TAIL
        rest = own.drives / (np.abs(own.omega2) + self.summed.shift)[:, None]
        still = np.zeros((2, len(own.omega2)))
        still[:, upper] = 1.0
        q = self.motion.q - still[0] * (self.driven.value @ rest.T)
        rate = self.motion.rate - still[0] * (self.driven.slope @ rest.T)
        most = [np.max(np.abs(p), axis=0) for p in (*self.motion, self.acceleration, q, rate)]
        none = np.full(len(weight), np.inf)
        slid = most[1] + np.abs(np.diag(own.damping)) * most[0]  # omega^2 times what is integrated
        slid = np.where(own.omega2 > 0, slid / np.where(own.omega2 > 0, own.omega2, 1.0), np.inf)
        parts = {
            0: gains.of(most[3], slid, none),
            1: gains.of(most[4], most[3], none),
            2: gains.of(most[2], most[1], most[0]),
        }
        chord = np.array([h.chord for h in self.driven.histories])
        found = np.zeros((len(outputs), len(gains.level)))
        for row, output in enumerate(outputs):
            c = np.abs(own.outputs[row])
            found[row] = parts[output.rate] @ (c * weight)
            D, V, A = chorded(own, chord, self.driven.time_s[-1])
            swings = [(D, none, none), (V, D, none), (A, V, D)][output.rate]
            found[row] += gains.of(*swings) @ c
        return found

    @property
    def _shaken(self) -> list[int]:
        """Which drives are the motion of the ground."""
        model = self.summed.model
        return [
            case
            for case, drive in enumerate(model.drives)
            if isinstance(drive, Base) and drive.family == self.summed.family
        ]

    def _ground(self) -> tuple[Array, Array, Array]:
        """Return displacement, velocity and acceleration of the ground."""
        driven, cases = self.driven, self._shaken
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
) -> tuple[Array, Array, Array, Driven, tuple[Basis, ...], tuple[Histories, ...]]:
    """Return outputs on the grid of kinks, errors, the part of chords, grid, modes, families."""
    driven = Driven(histories, time_s)
    y = np.zeros((len(model.outputs), len(driven.time_s)))
    error, chords = np.zeros(len(y)), np.zeros(len(y))
    parts: list[Histories] = []
    for family in model.families:
        number = modes or _FIRST
        while True:
            own = Histories(summed(model, family, number), driven)
            part = own.values()
            wrong = own.left_out(part)
            peak = np.max(np.abs(part), axis=1)
            if modes or np.all(wrong <= _WANTED * peak) or 2 * number > min(_MOST, MOST_MODES):
                break
            number *= 2
        y, error = y + part, error + wrong
        chords = chords + _chords(own.summed, histories, time_s[-1])
        parts.append(own)
    return y, error + chords, chords, driven, tuple(p.summed.basis for p in parts), tuple(parts)


def _chords(summed: Summed | Closed, histories: tuple[History, ...], duration_s: float) -> Array:
    """Return how far chords may move outputs."""
    own, model = summed.basis, summed.model
    moved = chorded(own, np.array([h.chord for h in histories]), duration_s)
    return np.array(
        [np.abs(own.outputs[row]) @ moved[output.rate] for row, output in enumerate(model.outputs)]
    )


def chorded(own: Basis, chord: Array, duration_s: float) -> tuple[Array, Array, Array]:
    """Return how far chords move the coordinates, their rates and accelerations, at most.

    Each mode doubles at most what it does at rest; what nothing holds drifts.
    """
    stiff, by = np.abs(own.omega2), 2 * np.abs(own.drives) @ chord
    held = stiff > 1e-9 * np.max(stiff)
    omega = np.sqrt(np.where(held, stiff, 1.0))
    drift = by / 2 * duration_s
    return (
        np.where(held, by / omega**2, drift * duration_s / 2),
        np.where(held, by / omega, drift),
        by,
    )


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
    y, error, _, driven, bases, _ = respond(model, histories, time, file.response.modes)
    largest, between = peaks_of(driven.time_s, y)
    return TransientResult(
        problem.title,
        time,
        model.outputs,
        y[:, driven.asked],
        error,
        largest,
        error + between,
        sum(len(own.omega2) for own in bases),
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
