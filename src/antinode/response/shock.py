"""Shock response spectra: the largest acceleration of oscillators that ride on an output.

An oscillator of frequency f and ratio zeta = 1/(2 Q) on a place that accelerates by a(t):
``w'' + 2 zeta omega w' + omega^2 w = -a``; it feels ``-(2 zeta omega w' + omega^2 w)``. The
recurrence is exact for a straight between its points: Smallwood's ramp-invariant filter (Shock Vib.
Bull. 51 (1981) 279; ISO 18431-4). Largest, during the record and after it ("maximax").
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import ByValue, numbers, within
from antinode.arrays import Array
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.methods import ResponseMethods

from .damping import Damping
from .equipment import Felt, Judge, Verdict, items_of
from .file import Problem
from .frequency import Model, checked_frequencies
from .harmonic import output_keys
from .modal import Basis
from .motion.oscillators import Gains, Linear, ride
from .motion.recurrence import phi
from .numbers import plain
from .quantities import Drive, Output
from .transient import Driven, Histories, histories_of, respond, slow_warnings

_PER_PERIOD = 40  # points of the record in a period of the oscillator, at least
_ROUNDING = 1e-13  # relative
_MOST = 6_000_000  # coordinates over all times
_SETTLED = 1e-3  # nepers that a margin may miss between frequencies


def srs(
    time_s: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    frequency_hz: npt.ArrayLike,
    ratio: float = 0.05,
) -> Array:
    """Return the maximax shock response spectrum of a record.

    Parameters
    ----------
    time_s : array_like, shape (k,)
        Even times [s].
    acceleration : array_like, shape (k,)
        Any unit; straight between the times, zero before them and after.
    frequency_hz : array_like, shape (n,)
        [Hz].
    ratio : float
        Damping ratio of the oscillators, 1/(2 Q); from 0 to below 1.

    Returns
    -------
    array, shape (n,)
        In the unit of the record.
    """
    spectrum, _ = _spectrum(time_s, acceleration, frequency_hz, ratio)
    return spectrum


def _spectrum(
    time_s: npt.ArrayLike, acceleration: npt.ArrayLike, frequency_hz: npt.ArrayLike, ratio: float
) -> tuple[Array, Array]:
    """Return the spectrum, and how far its maxima may be off between points, (n,) each."""
    t, a = numbers("time_s", time_s), numbers("acceleration", acceleration)
    ratio = within("ratio", ratio, 0.0, 0.999, " (1/(2 Q))")
    if t.ndim != 1 or t.shape != a.shape or len(t) < 2:
        raise InputError("time_s and acceleration must be two lists of the same length, 2 or more")
    step = np.diff(t)
    if np.any(step <= 0) or np.ptp(step) > 1e-6 * np.mean(step):
        raise InputError("time_s must rise by even steps: resample the record")
    if not (np.isfinite(t).all() and np.isfinite(a).all()):
        raise InputError("every time and acceleration must be a finite number")
    h = float((t[-1] - t[0]) / (len(t) - 1))
    found = [_largest(a, h, f, ratio) for f in checked_frequencies(frequency_hz)]
    return np.array([value for value, _ in found]), np.array([off for _, off in found])


def _largest(a: Array, h: float, f: float, ratio: float) -> tuple[float, float]:
    """Return the largest acceleration of one oscillator, and how far off it may be.

    A cubic through values and rates is within ``h^4/384`` of the largest fourth derivative; that of
    ``z' = root z + a`` is ``root^4 z + root^3 a + root^2 a'`` where a runs straight.
    """
    from scipy.signal import lfilter

    fine = max(1, int(np.ceil(_PER_PERIOD * f * h)))
    if fine > 1:
        places = np.arange((len(a) - 1) * fine + 1) / fine
        a, h = np.interp(places, np.arange(len(a)), a), h / fine
    omega, damped = 2 * np.pi * f, 2 * np.pi * f * np.sqrt(1 - ratio**2)
    root = -ratio * omega + 1j * damped
    e, one, two = phi(np.array([root * h]))
    b = h * np.array([two[0], (one - two)[0]])
    z, _ = lfilter(b, [1.0, -e[0]], a, zi=[-b[0] * a[0]])

    def felt(z: Any) -> tuple[Array, Array]:
        """Return what the oscillator feels, and its rate; z answers to the acceleration itself."""
        w, rate = np.imag(z) / damped, np.imag(root * z) / damped
        return 2 * ratio * omega * rate + omega**2 * w, rate

    x, rate = felt(z)
    change = 2 * ratio * omega * (a - 2 * ratio * omega * rate - omega**2 * np.imag(z) / damped)
    change = change + omega**2 * rate
    after = np.exp(root * np.linspace(0, 1 / f, 4 * _PER_PERIOD + 1)) * z[-1]
    y, late = felt(after)
    fall = 2 * ratio * omega * (-2 * ratio * omega * late - omega**2 * np.imag(after) / damped)
    fall = fall + omega**2 * late
    late_step = 1 / f / (4 * _PER_PERIOD)
    weight = np.abs(2 * ratio * omega * root + omega**2) / damped / 384
    slope = np.max(np.abs(np.diff(a)), initial=0.0) / h
    bend = omega**4 * np.max(np.abs(z)) + omega**3 * np.max(np.abs(a)) + omega**2 * slope
    off = weight * max(h**4 * bend, late_step**4 * omega**4 * float(np.abs(z[-1])))
    largest = max(_cubic_peak(x, change, h), _cubic_peak(y, fall, late_step))
    return largest, float(off + _ROUNDING * largest)


def _cubic_peak(x: Array, rate: Array, h: float) -> float:
    """Return the largest modulus of cubics through values and rates."""
    k = np.flatnonzero(rate[:-1] * rate[1:] < 0)
    best = float(np.max(np.abs(x)))
    if not len(k):
        return best
    x0, x1, r0, r1 = x[k], x[k + 1], h * rate[k], h * rate[k + 1]
    c2, c3 = 3 * (x1 - x0) - 2 * r0 - r1, 2 * (x0 - x1) + r0 + r1
    with np.errstate(all="ignore"):
        root = np.sqrt(np.maximum(c2**2 - 3 * c3 * r0, 0.0))
        s = -r0 / (c2 + np.where(c2 >= 0, root, -root))
        other = -(c2 + np.where(c2 >= 0, root, -root)) / (3 * c3)
    for place in (s, other):
        inside = np.isfinite(place) & (place > 0) & (place < 1)
        p = np.where(inside, place, 0.0)
        best = max(best, float(np.max(np.abs(x0 + p * (r0 + p * (c2 + p * c3))))))
    return best


@dataclass(frozen=True, eq=False, repr=False)
class ShockResult(ResponseMethods, ByValue):
    """Shock response spectra of outputs.

    Attributes
    ----------
    title : str
    frequency_hz : array, shape (k,)
    outputs : tuple of Output
    srs : array, shape (outputs, k)
        In the unit of each output.
    off : array, shape (outputs, k)
        How wrong each may be: modes left out, their own errors and chords of formulas, as far as an
        oscillator feels them, and cubics between points in time.
    error : array, shape (outputs,)
        The largest of these.
    q : float
    verdicts : tuple of Verdict
    count : int
        Modes that were summed.
    modes : tuple of Basis
    damping : Damping
    warnings : tuple of str
    """

    title: str
    frequency_hz: Array
    outputs: tuple[Output, ...]
    srs: Array = field(repr=False)
    off: Array = field(repr=False)
    error: Array
    q: float
    verdicts: tuple[Verdict, ...]
    count: int
    modes: tuple[Basis, ...] = field(repr=False)
    damping: Damping
    warnings: tuple[str, ...]

    kind = "shock"

    @property
    def passed(self) -> bool:
        """Whether all equipment is within what it is qualified for."""
        return all(verdict.passed for verdict in self.verdicts)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON."""
        rows = [
            {
                **output_keys(o),
                "srs": plain(self.srs[row]),
                "srs_error": plain(self.off[row]),
                "error": plain(self.error[row]),
            }
            for row, o in enumerate(self.outputs)
        ]
        return {
            "schema_version": 1,
            "kind": self.kind,
            "name": self.title,
            "damping": self.damping.describe(),
            "q": self.q,
            "modes": self.count,
            "frequency_hz": self.frequency_hz.tolist(),
            "outputs": rows,
            "equipment": [verdict.to_dict() for verdict in self.verdicts],
            "warnings": list(self.warnings),
        }

    def curves(self) -> list[tuple[Output, Drive | None, Array, Array, str]]:
        """Return output, no drive, frequencies, spectrum and unit, for universal files."""
        rows = zip(self.outputs, self.srs, strict=True)
        return [(o, None, self.frequency_hz, values, o.unit) for o, values in rows]

    def columns(self) -> list[tuple[str, Array]]:
        """Return a table: frequency, then the spectrum of each output."""
        rows = zip(self.outputs, self.srs, strict=True)
        heads = ((f"SRS of {o.name} [{o.unit}]", v) for o, v in rows)
        return [("frequency [Hz]", self.frequency_hz), *heads]


class Riders:
    """Oscillators of any frequency on the outputs of a model.

    Steps are short beside the period of those that are asked for together, an octave.

    Parameters
    ----------
    parts : tuple of Histories
        By family.
    time_s : array
    ratio : float
        Of the oscillators.
    """

    def __init__(self, parts: tuple[Histories, ...], time_s: Array, ratio: float) -> None:
        self.parts, self.time_s, self.ratio = parts, time_s, ratio
        self.step = float(np.max(np.diff(time_s)))
        self._on: dict[int, list[tuple[Histories, Linear]]] = {}

    def felt(self, rows: Sequence[int], frequency_hz: Array) -> tuple[Array, Array]:
        """Return what oscillators feel on outputs, and how wrong it may be, (rows, f) each."""
        octave = np.ceil(np.log2(frequency_hz)).astype(int)
        found, off = np.zeros((2, len(rows), len(frequency_hz)))
        for k in np.unique(octave).tolist():
            own = octave == k
            for histories, linear in self._finer(k):
                gains = Gains.over(frequency_hz[own], self.ratio, float(self.time_s[-1]))
                left_out = histories.felt(gains)
                for i, row in enumerate(rows):
                    if histories.summed.model.outputs[row].family != histories.summed.family:
                        continue
                    seen = histories.seen(row, linear)
                    ridden = ride(linear, seen, frequency_hz[own], self.ratio)
                    found[i, own] = ridden.largest
                    off[i, own] = ridden.off + left_out[row]
        return found, off

    def _finer(self, octave: int) -> list[tuple[Histories, Linear]]:
        """Return the histories in steps that are short beside periods of an octave."""
        modes = sum(len(own.summed.basis.omega2) for own in self.parts)
        longest = max(0.5**octave / _PER_PERIOD, self.time_s[-1] * modes / _MOST)
        parts = max(1, int(np.ceil(self.step / longest * (1 - 1e-9))))
        if parts not in self._on:
            made = []
            for own in self.parts:
                driven = Driven(own.driven.histories, self.time_s, self.step / parts)
                finer = own if parts == 1 else Histories(own.summed, driven)
                made.append((finer, finer.linear))
            self._on[parts] = made
        return self._on[parts]


@out_of_range_is_an_error()
def solve_shock(problem: Problem) -> ShockResult:
    """Compute the shock response spectra that a file asks for."""
    file, damping = problem.file, problem.damping
    assert file.time is not None
    assert file.frequency is not None
    frequency, items = file.frequency.hertz(), items_of(problem, "amplitude")
    time, shown = file.time.seconds(), len(file.outputs)
    outputs = (*file.outputs, *(item.output for item in items))
    model = Model(problem.beam, file.drives, outputs, damping, 1 / file.time.to, problem.backend)
    y, error, _, _, bases, parts = respond(model, histories_of(problem), time, file.response.modes)
    riders = Riders(parts, time, 1 / (2 * file.shock.q))
    spectra, off = riders.felt(range(shown), frequency)
    wide = tuple(replace(own, damping=_as_wide(own, riders.ratio)) for own in bases)
    names = file.drive_names if len(file.drive_names) == 1 else ()
    judge = Judge(frequency, wide, names, 20.0, _SETTLED)
    verdicts = [judge.verdict(item, _ridden(riders, row)) for row, item in enumerate(items, shown)]
    warnings = slow_warnings(model, y, error)
    warnings += [told for verdict in verdicts for told in verdict.warnings]
    return ShockResult(
        problem.title,
        frequency,
        outputs[:shown],
        spectra,
        off,
        np.max(off, axis=-1, initial=0.0),
        file.shock.q,
        tuple(verdicts),
        sum(len(own.omega2) for own in bases),
        bases,
        damping,
        tuple(warnings),
    )


def _as_wide(own: Basis, ratio: float) -> Array:
    """Return damping by which no mode's resonance is narrower than an oscillator's."""
    return own.damping + np.diag(2 * ratio * np.sqrt(np.abs(own.omega2)))


def _ridden(riders: Riders, row: int) -> Felt:
    """Return what an oscillator on a place feels."""

    def known(f: Array) -> tuple[Array, Array]:
        size, wrong = riders.felt([row], f)
        return size, wrong[0]

    return Felt(lambda f: riders.felt([row], f)[0][0], known, 0.0)
