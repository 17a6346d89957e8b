"""Integrals of spectra over a band, and what outputs come to by them.

    rms^2 = int S_y df,   nu = sqrt(int f^2 S_y df / int S_y df)

Of a stationary Gaussian output the mean of the largest value in a duration T is
``rms (g + 0.5772/g)``, ``g = sqrt(2 ln(nu T))`` (Davenport, Proc. Inst. Civ. Eng. 28 (1964) 187).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FamilyName
from antinode.response.forced import NOISE, largest_of_unit, refined_all
from antinode.response.frequency import Model
from antinode.response.integrals import Pieces, integrate, pieces_of
from antinode.response.modal import Basis
from antinode.response.modal_sum import ModalSum

from .inputs import Inputs

EULER = 0.5772156649015329
_NOISE = 1e-16  # share of a mean square, an rms of 1e-8, below which there is but rounding


class Moments(NamedTuple):
    """Integrals of the outputs' spectra."""

    square: Array
    """Mean squares, shape (outputs,)."""
    second: Array
    """int f^2 S_y df, shape (outputs,)."""
    error: Array
    """Of the mean squares, absolute."""
    by_mode: Array
    """Mean squares by cell, shape (outputs, cells)."""
    by_drive: Array
    """Mean squares by drive, shape (outputs, drives)."""
    bounds: Array
    """Of the cells [Hz], shape (cells + 1,)."""
    owners: tuple[str, ...]
    """The mode of each cell."""


def moments(
    model: Model,
    inputs: Inputs,
    modes: tuple[Basis, ...],
    band: tuple[float, float],
    tolerance: float,
) -> Moments:
    """Integrate the outputs' spectra over a band, each resonance at its own scale.

    Parameters
    ----------
    model : Model
        Not by ratios of modes.
    tolerance : float
        Relative, of the mean squares.
    """
    names = [name for own in modes for name in own.names]
    resonance = np.concatenate([own.frequency_hz for own in modes])
    ratio = np.concatenate([own.ratio for own in modes])
    real = resonance > 0
    names = [name for name, keep in zip(names, real, strict=True) if keep]
    pieces, bounds, owner = pieces_of(*band, resonance[real], ratio[real], inputs.kinks)
    count, top = len(bounds) - 1, band[1] ** 2
    last: dict[str, Array] = {}

    def compute(levels: dict[FamilyName, int]) -> Array:
        parts, wrong = _integrals(model, inputs, levels, pieces, count, tolerance / 10)
        square = np.sum(parts[:, 0], axis=-1)
        last.update(parts=parts, wrong=wrong[:, 0])
        return np.stack([square, np.sum(parts[:, 1], axis=-1) / top], axis=1)[:, :, None]

    first = {family: model.first(family) for family in model.families}
    better, error = refined_all(
        model.beam, first, compute, tolerance, [o.unit for o in model.outputs], NOISE**1.5
    )
    parts = last["parts"]
    square = better[:, 0, 0]
    return Moments(
        square,
        better[:, 1, 0] * top,
        error[:, 0, 0] + last["wrong"] + 1e-10 * square,
        parts[:, 0],
        np.sum(parts[:, 2:], axis=-1),
        bounds,
        tuple(names[k] for k in owner) if names else ("",) * count,
    )


def _integrals(
    model: Model,
    inputs: Inputs,
    levels: dict[FamilyName, int],
    pieces: Pieces,
    count: int,
    tolerance: float,
) -> tuple[Array, Array]:
    """Return integrals (outputs, 2 + drives, cells): of S, f^2 S, and the drives' shares of S."""
    number, kinds = len(model.outputs), 2 + len(inputs.spectra)

    def integrand(frequency_hz: Array) -> Array:
        shares = inputs.shares(model.on(levels, frequency_hz), frequency_hz)
        S = np.sum(shares, axis=1, keepdims=True)
        return np.concatenate([S, frequency_hz**2 * S, shares], axis=1).reshape(number * kinds, -1)

    units = [output.unit for output in model.outputs]

    def scales(whole: Array) -> Array:
        """Measure by the outputs' own; by the largest of a unit where rounding is all there is."""
        own = whole.reshape(number, kinds)
        own = np.maximum(own, _NOISE * largest_of_unit(own, units))
        own[:, 2:] = own[:, :1]
        return own.ravel()

    parts, error = integrate(integrand, pieces, count, tolerance, scales)
    return parts.reshape(number, kinds, count), error.reshape(number, kinds)


def by_modes(
    summed: ModalSum,
    inputs: Inputs,
    frequency_hz: Array,
    psd: Array,
    kept: Sequence[int],
    square: Array,
) -> Array:
    """Return how far the errors of summed modes move the mean squares of the outputs that are kept.

    A resonance that is off in frequency takes what is at the ends of the band out of it or in, and
    meets another input there: that is less than ten times its relative error.
    """
    most = np.einsum("od,dk->ok", summed.peak_error, inputs.amplitudes(frequency_hz))
    wrong = np.max(2 * np.sqrt(psd) * most + most**2, axis=-1)
    relative = np.max(wrong / np.maximum(np.max(psd, axis=-1), 1e-300))
    ends = summed.shift_hz * (psd[kept, 0] + psd[kept, -1])
    return np.asarray((relative + 10 * summed.shift_hz / frequency_hz[0]) * square + ends)


@dataclass(frozen=True)
class OutputStatistics:
    """What a random output comes to.

    Attributes
    ----------
    rms, error : float
        Root mean square over the band, and how wrong it may be, SI.
    crossings_per_s : float
        Upward crossings of the mean.
    peak : float
        Mean of the largest value in the duration; NaN where it hardly crosses the mean.
    by_mode : tuple of (str, float, float, float)
        Mode, share of the mean square, and between which frequencies [Hz].
    by_drive : tuple of (str, float)
        Force, and its share.
    """

    rms: float
    error: float
    crossings_per_s: float
    peak: float
    by_mode: tuple[tuple[str, float, float, float], ...]
    by_drive: tuple[tuple[str, float], ...]


def statistics(
    own: Moments, names: Sequence[str], duration_s: float
) -> tuple[OutputStatistics, ...]:
    """Return what outputs come to."""
    found = []
    for row, square in enumerate(own.square.tolist()):
        rms, safe = float(np.sqrt(square)), square if square > 0 else 1.0
        nu = float(np.sqrt(max(own.second[row], 0.0) / safe))
        by_drive = [(n, float(v / safe)) for n, v in zip(names, own.by_drive[row], strict=True)]
        found.append(
            OutputStatistics(
                rms,
                float(own.error[row] / (2 * np.sqrt(safe))),
                nu,
                davenport(rms, nu, duration_s),
                _by_mode(own, row, safe),
                tuple(sorted(by_drive, key=lambda item: -item[1])),
            )
        )
    return tuple(found)


def _by_mode(own: Moments, row: int, whole: float) -> tuple[tuple[str, float, float, float], ...]:
    """Return modes with their shares and bands, the largest first."""
    merged: dict[str, tuple[str, float, float, float]] = {}
    for k, name in enumerate(own.owners):
        low, high = float(own.bounds[k]), float(own.bounds[k + 1])
        _, share, first, _ = merged.get(name, (name, 0.0, low, high))
        merged[name] = name, share + float(own.by_mode[row, k] / whole), first, high
    return tuple(sorted(merged.values(), key=lambda item: -item[1]))


def davenport(rms: float, crossings_per_s: float, duration_s: float) -> float:
    """Return the mean of the largest value in a duration; NaN for less than two crossings."""
    number = crossings_per_s * duration_s
    if number < 2:
        return float("nan")
    g = float(np.sqrt(2 * np.log(number)))
    return rms * (g + EULER / g)


def without_bound(mode: str) -> OutputStatistics:
    """Return what an output comes to that a mode without damping carries away."""
    nan, inf = float("nan"), float("inf")
    return OutputStatistics(inf, inf, nan, nan, ((mode, 1.0, nan, nan),), ())
