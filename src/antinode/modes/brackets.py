"""Brackets that neighbours share where rounding, or an extrapolation, makes theirs overlap."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array, Integers


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
