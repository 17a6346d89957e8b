"""How a beam becomes a chain: steps, and two uniform half-segments for each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array, Integers

from .families import FAMILIES, FamilyName

if TYPE_CHECKING:
    from .beam import Beam

GAUSS = 0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6
NEAR, FAR = 0.5 + np.sqrt(3) / 3, 0.5 - np.sqrt(3) / 3
_STEEPEST = 4.0  # ratio of a property across one step (averages stay positive up to 13.9)
_LONGEST = 1 / 16  # share of one step in the waves along the beam
_MOST_HALVINGS = 40
LIMITS = _STEEPEST, _LONGEST, _MOST_HALVINGS
"""What the coarsest steps keep to: `riccati.lanes` makes the same ones."""


def halved(values: Array) -> Array:
    """Return means on the two halves of steps, from values at their Gauss points, (..., 2)."""
    first, last = values[..., 0], values[..., 1]
    return np.stack([NEAR * first + FAR * last, FAR * first + NEAR * last], axis=-1)


def copies(times: Integers) -> tuple[Integers, Integers]:
    """Return, for entry k repeated ``times[k]`` times, every copy's k and its number from 0."""
    index = np.repeat(np.arange(len(times)), times)
    return index, np.arange(len(index)) - (np.cumsum(times) - times)[index]


def coarsest_steps(beam: Beam, family: FamilyName) -> tuple[Integers, Array, Array]:
    """Divide intervals in which something varies until no step is long or steep.

    Returns
    -------
    interval, start, size : array
        Of every step; start and size as fractions of the interval's length.
    """
    interval = np.arange(len(beam.x) - 1)
    start, size = np.zeros(len(interval)), np.ones(len(interval))
    columns, power = FAMILIES[family].columns, FAMILIES[family].law.power
    varies = beam.varies(family)
    for _ in range(_MOST_HALVINGS):
        ends = [
            [beam.column_at(columns[name], interval, start + side * size) for side in (0.0, 1.0)]
            for name in ("mass", "stiffness")
        ]
        steepest = np.max([np.maximum(a / b, b / a) for a, b in ends], axis=0)
        mass, stiffness = (np.sqrt(a * b) for a, b in ends)
        phase = (mass / stiffness) ** (1 / power) * np.diff(beam.x)[interval] * size
        coarse = (steepest > _STEEPEST) | (phase > _LONGEST * np.sum(phase))
        pieces = np.where(coarse & varies[interval], 2, 1)
        if np.all(pieces == 1):
            break
        which, second = copies(pieces)
        interval, size = interval[which], (size / pieces)[which]
        start = start[which] + second * size
    return interval, start, size
