"""Brackets that neighbours share where rounding, or an extrapolation, makes theirs overlap."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array, Integers

ROUNDING = 64 * np.finfo(float).eps
"""Share of what must cancel to make an eigenvalue that its rounding is taken for."""


def share_brackets(low: Array, high: Array, counts: Integers) -> None:
    """Join the brackets of ascending modes that overlap, with their counts, in place.

    Parameters
    ----------
    low, high : array, shape (modes,)
    counts : array of int, shape (modes, 2)
        Number of eigenvalues below either end.
    """
    edges = np.flatnonzero(low[1:] > np.maximum.accumulate(high)[:-1]) + 1
    for group in np.split(np.arange(len(low)), edges):
        low[group], high[group] = low[group].min(), high[group].max()
        counts[group] = counts[group, 0].min(), counts[group, 1].max()


def cancelling(size: Array, mass: Array, omega2: Array) -> Array:
    """Return what must cancel to make each omega^2 [rad^2/s^2]: its rounding is a share of it.

    That is the size of the mode's energies over its mass. Where an elastic mode lies so near zero
    that rounding may hide it, its shape cannot be told from a rigid one's, which stores nothing:
    it is given the most that any mode has.
    """
    own = size / mass
    most = np.fmax.reduce(own, initial=0.0)
    return np.where((omega2 != 0.0) & (np.abs(omega2) < ROUNDING * most), most, own)
