"""Equipment: what it feels against what it is qualified for, unit by unit.

The margin is the smallest distance of the response below the allowed curve, in decibel: at the
response's own peaks and between them, where both are known. Below zero the verdict is "no".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .file import Problem
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
        Smallest distance to the allowed curve; negative where it is exceeded.
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
    curve : tuple of array
        Frequencies [Hz], what is felt, what is allowed.
    """

    name: str
    x: float
    margin_db: float
    frequency_hz: float
    felt: float
    allowed: float
    unit: str
    mode: str
    force: str
    band_hz: tuple[float, float]
    curve: tuple[Array, Array, Array] = field(repr=False, compare=False)
    rms: float | None = None

    @property
    def passed(self) -> bool:
        """Whether it stays within."""
        return self.margin_db >= 0

    def with_rms(self, rms: float) -> Verdict:
        """Return the verdict with the rms of the acceleration."""
        return replace(self, rms=rms)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "name": self.name,
            "x": self.x,
            "verdict": "yes" if self.passed else "no",
            "margin_db": plain(self.margin_db),
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
        if not both[0] < both[1]:
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

    def judged(
        self,
        frequency_hz: Array,
        shares: Array,
        decibel: float,
        modes: tuple[Basis, ...],
        names: Sequence[str],
    ) -> Verdict:
        """Return the verdict from what each drive makes of the response, (drives, k).

        `decibel` is 10 for what goes with power, 20 for amplitudes.
        """
        felt = np.maximum(np.sum(shares, axis=0), 1e-300)
        allowed = self.allowed.at(frequency_hz)
        margin = decibel * np.log10(allowed / felt)
        worst = int(np.argmin(margin))
        f = float(frequency_hz[worst])
        return Verdict(
            self.name,
            self.output.x,
            float(margin[worst]),
            f,
            float(felt[worst]),
            float(allowed[worst]),
            self.unit,
            nearest_mode(modes, f),
            names[int(np.argmax(shares[:, worst]))] if len(names) == len(shares) else "",
            (float(frequency_hz[0]), float(frequency_hz[-1])),
            (frequency_hz, felt, allowed),
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
