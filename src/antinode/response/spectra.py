"""Spectra: power densities and other curves over frequency, straight between points, log-log.

A density is one-sided: the mean square is its integral over positive frequencies [Hz]. Between two
points ``S = S1 (f/f1)^n``: n of 1 is 3.01 dB an octave.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from antinode.arguments import ByValue, numbers
from antinode.arrays import Array
from antinode.errors import InputError

from .units import in_si, read_columns

_PER_OCTAVE = re.compile(r"\s*dB\s*/\s*oct(ave)?\s*$")
OCTAVE = 10 * np.log10(2.0)
"""Decibel of a factor of two in a density."""


@dataclass(frozen=True, eq=False)
class Spectrum(ByValue):
    """A curve over frequency, straight between its points on logarithmic axes.

    Parameters
    ----------
    frequency_hz : array, shape (n,)
        Increasing, above 0 [Hz].
    level : array, shape (n,)
        Above 0: [unit^2/Hz] of a density.
    name : str
        Where it comes from, for messages.
    """

    frequency_hz: Array
    level: Array
    name: str = "the spectrum"

    def __post_init__(self) -> None:
        f, level = (numbers(name, getattr(self, name)) for name in ("frequency_hz", "level"))
        object.__setattr__(self, "frequency_hz", f)
        object.__setattr__(self, "level", level)
        if f.ndim != 1 or f.shape != level.shape or len(f) < 2:
            raise InputError(
                f"{self.name}: it needs two points or more, a level for each frequency"
            )
        for row in np.flatnonzero(~(np.isfinite(f) & (f > 0)))[:1]:
            raise InputError(f"{self.name}: row {row + 1} is at {f[row]:g} Hz; give one above 0")
        for row in np.flatnonzero(np.diff(f) <= 0)[:1]:
            raise InputError(
                f"{self.name}: {f[row + 1]:g} Hz in row {row + 2} follows {f[row]:g} Hz; sort the "
                "rows by frequency, one for each"
            )
        for row in np.flatnonzero(~(np.isfinite(level) & (level > 0)))[:1]:
            raise InputError(
                f"{self.name}: the level at {f[row]:g} Hz is {level[row]:g}; it must be above 0 "
                "(where nothing acts, end the table)"
            )

    @property
    def band(self) -> tuple[float, float]:
        """Where it begins and ends [Hz]."""
        return float(self.frequency_hz[0]), float(self.frequency_hz[-1])

    def at(self, frequency_hz: Array) -> Array:
        """Return the level at frequencies inside its band."""
        x, y = np.log(self.frequency_hz), np.log(self.level)
        return np.asarray(np.exp(np.interp(np.log(frequency_hz), x, y)))

    def check_covers(self, low: float, high: float) -> None:
        """Raise InputError unless it reaches from one frequency to another [Hz]."""
        first, last = self.band
        if first > low * (1 + 1e-9) or last < high * (1 - 1e-9):
            raise InputError(
                f"{self.name} runs from {first:g} to {last:g} Hz, but the response is asked for "
                f"from {low:g} to {high:g} Hz: extend the table, or narrow [frequency]"
            )

    def mean_square(self, low: float, high: float) -> float:
        """Return the integral of the level over a band inside its own, exactly."""
        inside = self.frequency_hz[(self.frequency_hz > low) & (self.frequency_hz < high)]
        f = np.concatenate([[low], inside, [high]])
        S = self.at(f)
        ratio = np.log(f[1:] / f[:-1])
        power = np.log(S[1:] / S[:-1]) / ratio + 1
        flat = np.abs(power * ratio) < 1e-8
        grown = np.expm1(power * ratio) / np.where(flat, 1.0, power)
        return float(np.sum(S[:-1] * f[:-1] * np.where(flat, ratio, grown)))


def spectrum_from(source: object, unit: str, folder: Path, where: str) -> Spectrum:
    """Return a spectrum as a file has it.

    Parameters
    ----------
    source : str or dict
        The name of a CSV file; or a table with `frequency` and `level` as lists; or with `slope`
        [dB per octave] between the frequencies, `level` at one of them and `level_at` which.
    unit : str
        SI unit of the level.
    folder : Path
        In which the CSV file lies.
    where : str
        For messages.
    """
    if isinstance(source, str):
        path = folder / source
        return Spectrum(*read_columns(path, ("frequency", "psd"), ("Hz", unit)), str(path))
    if isinstance(source, (int, float)) and not isinstance(source, bool):
        raise InputError(f"{where} is a number; name a CSV file, or give a table of points")
    if not isinstance(source, dict) or "frequency" not in source or "level" not in source:
        raise InputError(
            f"{where} must be the name of a CSV file, or {{ frequency = [...], level = [...] }}"
        )
    unknown = sorted(set(source) - {"frequency", "level", "slope", "level_at"})
    if unknown:
        raise InputError(
            f"{where}: unknown key {unknown[0]}; allowed are frequency, level, slope, level_at"
        )
    f = np.array([in_si(v, "Hz", f"{where}.frequency") for v in _list(source["frequency"], where)])
    if "slope" in source:
        return _sloped(source, f, unit, where)
    level = [in_si(v, unit, f"{where}.level") for v in _list(source["level"], where)]
    return Spectrum(f, np.array(level), where)


def _list(value: object, where: str) -> list[object]:
    if not isinstance(value, list):
        raise InputError(f"{where}: frequency and level are lists of as many numbers")
    return value


def _slope(value: object, where: str) -> float:
    """Return a slope, which may carry its unit [dB per octave]."""
    if isinstance(value, str):
        value = _PER_OCTAVE.sub("", value)
    return in_si(value, "", where)


def _sloped(source: dict[str, object], f: Array, unit: str, where: str) -> Spectrum:
    """Return a spectrum from slopes in dB per octave and one level."""
    slopes = np.array([_slope(v, f"{where}.slope") for v in _list(source["slope"], where)])
    if len(slopes) != len(f) - 1:
        raise InputError(
            f"{where}: {len(slopes)} slopes between {len(f)} frequencies; give one for each "
            "interval [dB per octave]"
        )
    Spectrum(f, np.ones(len(f)), where)
    level = in_si(source["level"], unit, f"{where}.level")
    at = in_si(source.get("level_at", float(f[0])), "Hz", f"{where}.level_at")
    decibel = np.append(0.0, np.cumsum(slopes * np.log2(f[1:] / f[:-1])))
    if not f[0] <= at <= f[-1]:
        raise InputError(f"{where}.level_at is {at:g} Hz; it must lie between its frequencies")
    own = float(np.interp(np.log(at), np.log(f), decibel))
    return Spectrum(f, level * 10 ** ((decibel - own) / 10), where)
