"""Equipment: what it feels against what it is qualified for, unit by unit.

The margin is the smallest distance of the response below the allowed curve, in decibel, wherever
both are known (`margins`). Its error is that of the response there, and what samples may miss.
Below zero by more than its error the verdict is "no", within its error "not decided".
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .file import Problem
from .margins import margin_of, samples_for
from .modal import Basis
from .numbers import plain
from .quantities import Output
from .spectra import Spectrum, spectrum_from
from .units import spectral


@dataclass(frozen=True)
class Verdict:
    """Whether a unit bears what it feels.

    Attributes
    ----------
    name : str
    x : float
        Station [m].
    margin_db : float
        Smallest distance to the allowed curve; negative where it is exceeded. Infinite where
        nothing is felt, minus infinity where nothing limits what is felt.
    least_db, most_db : float
        Between these lies the true one.
    frequency_hz : float
        Where it is smallest.
    felt, allowed : float
        Both there, SI.
    unit : str
    mode : str
        The mode whose frequency is nearest.
    force : str
        What drives most of it there.
    rms : float or None
        Of the acceleration over the band [m/s^2].
    band_hz : tuple of float
        Where both curves are known.
    known_hz : tuple of tuple of float
        Where what is allowed is known, and where the response.
    curve : tuple of array
        Frequencies [Hz], what is felt, what is allowed.
    """

    name: str
    x: float
    margin_db: float
    least_db: float
    most_db: float
    frequency_hz: float
    felt: float
    allowed: float
    unit: str
    mode: str
    force: str
    band_hz: tuple[float, float]
    curve: tuple[Array, Array, Array] = field(repr=False, compare=False)
    known_hz: tuple[tuple[float, float], tuple[float, float]]
    rms: float | None = None

    @property
    def error_db(self) -> float:
        """How wrong the margin may be; infinite where what is felt may be nothing."""
        if self.least_db == self.most_db:
            return 0.0
        return max(self.margin_db - self.least_db, self.most_db - self.margin_db)

    @property
    def passed(self) -> bool:
        """Whether it stays within, for certain."""
        return self.least_db >= 0

    @property
    def verdict(self) -> str:
        """Whether it stays within: yes, no, not decided."""
        return "yes" if self.passed else "no" if self.most_db < 0 else "not decided"

    @property
    def margin_words(self) -> str:
        """The margin in words where it is no number."""
        if np.isneginf(self.margin_db):
            return "none: endless"
        if np.isposinf(self.margin_db):
            return "feels nothing"
        return f"> {self.least_db:.3g}" if np.isposinf(self.most_db) else f"{self.margin_db:+.2f}"

    @property
    def warnings(self) -> list[str]:
        """What must be said beside the verdict."""
        own, told = f"equipment '{self.name}'", []
        if np.isneginf(self.margin_db):
            told.append(
                f"nothing limits what {own} feels at {self.mode}: there is no margin without "
                "damping; give [damping] loss_factor"
            )
        elif np.isposinf(self.most_db):
            told.append(
                f"nothing is felt by {own} beyond the error of the computation: its margin is "
                + ("without bound" if np.isposinf(self.margin_db) else f"> {self.least_db:.3g} dB")
            )
        if self.verdict == "not decided":
            told.append(
                f"not decided: the margin of {own}, {self.margin_db:+.2g} dB, is within its error, "
                f"{self.error_db:.1e} dB; give a smaller response.tolerance, or more response.modes"
            )
        allowed, response = self.known_hz
        if (self.band_hz, self.band_hz) != (allowed, response):
            told.append(
                f"not all is judged: {own} from {self.band_hz[0]:g} to {self.band_hz[1]:g} Hz "
                f"alone; what it may feel is known from {allowed[0]:g} to {allowed[1]:g} Hz, the "
                f"response from {response[0]:g} to {response[1]:g} Hz"
            )
        return told

    def with_rms(self, rms: float) -> Verdict:
        """Return the verdict with the rms of the acceleration."""
        return replace(self, rms=rms)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "name": self.name,
            "x": self.x,
            "verdict": self.verdict,
            "margin_db": plain(self.margin_db),
            "error_db": plain(self.error_db),
            "at_least_db": plain(self.least_db),
            "frequency_hz": self.frequency_hz,
            "felt": plain(self.felt),
            "allowed": plain(self.allowed),
            "unit": self.unit,
            "mode": self.mode,
            "force": self.force,
            "band_hz": list(self.band_hz),
            **({"rms_m_per_s2": plain(self.rms)} if self.rms is not None else {}),
        }


@dataclass(frozen=True)
class Item:
    """A unit of equipment with what it may feel."""

    name: str
    output: Output
    allowed: Spectrum
    unit: str

    def overlap(self, low: float, high: float) -> tuple[float, float]:
        """Return where the allowed curve and a band overlap [Hz], or raise InputError."""
        first, last = self.allowed.band
        both = max(first, low), min(last, high)
        if both[0] > both[1]:
            raise InputError(
                f"equipment '{self.name}': what is allowed is known from {first:g} to {last:g} Hz, "
                f"but the response from {low:g} to {high:g} Hz: give a table for this band"
            )
        return both

    def places(self, frequency_hz: Array, more: Sequence[float]) -> Array:
        """Return where to compare: a grid, peaks, and kinks of what is allowed, in both bands."""
        low, high = self.overlap(float(frequency_hz[0]), float(frequency_hz[-1]))
        kinks = self.allowed.frequency_hz
        places = np.unique(np.concatenate([frequency_hz, more, kinks, [low, high]]))
        return places[(places >= low) & (places <= high)]


class Felt(NamedTuple):
    """What a place feels at frequencies [Hz], as functions of them."""

    quick: Callable[[Array], Array]
    """All of it, (k,)."""
    known: Callable[[Array], tuple[Array, Array]]
    """What each drive makes of it, (drives, k), and how wrong the whole may be, (k,)."""
    floor: float
    """Below which it is but the error of the computation."""
    endless: str = ""
    """The mode at which nothing limits it."""


@dataclass(frozen=True)
class Judge:
    """What the verdicts of a response share.

    Parameters
    ----------
    frequency_hz : array
        A grid, increasing, with every kink of what drives.
    modes : tuple of Basis
    names : sequence of str
        Of the drives.
    decibel : float
        10 for what goes with power, 20 for amplitudes.
    settled : float
        Nepers that a margin may miss between samples.
    """

    frequency_hz: Array
    modes: tuple[Basis, ...]
    names: Sequence[str]
    decibel: float
    settled: float = 1e-6

    def verdict(self, item: Item, felt: Felt, more: Sequence[float] = ()) -> Verdict:
        """Return the verdict on an item; `more` frequencies are among those where it is asked."""
        resonance = np.concatenate([own.frequency_hz for own in self.modes])
        ratio = np.concatenate([own.ratio for own in self.modes])[resonance > 0]
        floor = max(felt.floor, 1e-300)

        def excess(f: Array) -> Array:
            return np.log(np.maximum(felt.quick(f), floor) / item.allowed.at(f))

        f, missed = item.places(self.frequency_hz, more), 0.0
        if not felt.endless:
            f, missed = samples_for(excess, f, resonance[resonance > 0], ratio, self.settled)
        shares, wrong = felt.known(f)
        size, allowed = np.sum(shares, axis=0), item.allowed.at(f)
        margin = margin_of(allowed, size, wrong, felt.floor, missed, self.decibel)
        at, bounds = margin.at, (margin.value, margin.least, margin.most)
        mode = nearest_mode(self.modes, float(f[at]))
        if felt.endless:
            bounds, mode, size[at] = (-np.inf,) * 3, felt.endless, np.inf
        known = item.allowed.band, (float(self.frequency_hz[0]), float(self.frequency_hz[-1]))
        return Verdict(
            item.name,
            item.output.x,
            *bounds,
            float(f[at]),
            float(size[at]),
            float(allowed[at]),
            item.unit,
            mode,
            self.names[int(np.argmax(shares[:, at]))] if len(self.names) == len(shares) else "",
            (float(f[0]), float(f[-1])),
            (f, size, allowed),
            known,
        )


def nearest_mode(modes: tuple[Basis, ...], frequency_hz: float) -> str:
    """Return the mode that vibrates nearest to a frequency, in ratio; nothing if none does."""
    rows = [
        (abs(np.log(f / frequency_hz)), name)
        for own in modes
        for name, f in zip(own.names, own.frequency_hz, strict=True)
        if f > 0
    ]
    return min(rows)[1] if rows else ""


def items_of(problem: Problem, kind: str) -> list[Item]:
    """Return the equipment of a file; its allowed curve is a psd, or an amplitude or srs."""
    found = []
    for k, table in enumerate(problem.file.equipment):
        direction = table.direction or problem.file.direction
        output = Output(table.x, "acceleration", direction)
        unit = spectral(output.unit) if kind == "psd" else output.unit
        where = f"{problem.where}: equipment.{k}.allowed"
        allowed = spectrum_from(table.allowed, unit, problem.folder, where)
        found.append(Item(table.name, output, allowed, unit))
    return found
