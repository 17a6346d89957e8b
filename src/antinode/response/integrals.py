r"""Integrals over frequency of what resonates, exact in each resonance whatever grid is asked for.

A response has poles near ``f_n (1 +- i zeta_n)``. Each interval between neighbours' midpoints is
mapped so that a resonance becomes smooth at its own scale,

    f = f_n + w sinh(u),   w = zeta_n f_n,

and cut where the curves of the input have kinks. Gauss points on each piece; pieces are halved
until the sums of two orders agree. The stated error is what they still differ by.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Integers
from antinode.errors import ComputationError

_LOW, _HIGH = 10, 16  # Gauss points of the two sums
_LONGEST = 4.0  # u of the pieces one begins with
_ROUNDS = 14
_MOST_PIECES = 40_000
_LEAST_WIDTH = 1e-9  # zeta of a resonance without damping


class Pieces(NamedTuple):
    """Intervals of u around a resonance each.

    Attributes
    ----------
    centre, width : array, shape (p,)
        f_n and w [Hz].
    low, high : array, shape (p,)
        u.
    cell : array of int, shape (p,)
        Which interval between neighbours' midpoints each belongs to.
    """

    centre: Array
    width: Array
    low: Array
    high: Array
    cell: Integers

    def points(self, order: int) -> tuple[Array, Array]:
        """Return Gauss points [Hz] and weights, shape (p, order)."""
        x, w = np.polynomial.legendre.leggauss(order)
        half = (self.high - self.low) / 2
        u = (self.high + self.low)[:, None] / 2 + half[:, None] * x
        f = self.centre[:, None] + self.width[:, None] * np.sinh(u)
        return f, half[:, None] * w * self.width[:, None] * np.cosh(u)

    def chosen(self, which: Integers) -> Pieces:
        """Return some of them."""
        centre, width, low, high, cell = self
        return Pieces(centre[which], width[which], low[which], high[which], cell[which])

    def halved(self) -> Pieces:
        """Return each as two."""
        middle = (self.low + self.high) / 2
        centre, width = np.tile(self.centre, 2), np.tile(self.width, 2)
        low, high = np.concatenate([self.low, middle]), np.concatenate([middle, self.high])
        return Pieces(centre, width, low, high, np.tile(self.cell, 2))


def cells(low: float, high: float, resonance_hz: Array) -> tuple[Array, Integers]:
    """Return the bounds between resonances, halfway from one to the next, and the resonances.

    Returns
    -------
    bounds : array, shape (n + 1,)
        From `low` to `high` [Hz].
    order : array of int, shape (n,)
        Which resonance each interval is about; the nearest one outside where none lies inside.
    """
    order = np.argsort(resonance_hz, kind="stable")
    f = resonance_hz[order]
    middles = (f[1:] + f[:-1]) / 2
    inside = (middles > low) & (middles < high)
    bounds = np.concatenate([[low], middles[inside], [high]])
    at = np.searchsorted(middles, (bounds[1:] + bounds[:-1]) / 2)
    return bounds, order[at]


def pieces_of(
    low: float, high: float, resonance_hz: Array, ratio: Array, kinks: Array
) -> tuple[Pieces, Array, Integers]:
    """Return the pieces of a band, the bounds of its cells and the resonance of each cell."""
    if not len(resonance_hz):
        resonance_hz, ratio = np.array([np.sqrt(low * high)]), np.array([1.0])
    bounds, owner = cells(low, high, resonance_hz)
    rows: list[tuple[float, float, float, float, int]] = []
    for k, mode in enumerate(owner):
        f = float(resonance_hz[mode])
        w = max(float(ratio[mode]), _LEAST_WIDTH) * f
        inner = kinks[(kinks > bounds[k]) & (kinks < bounds[k + 1])]
        places = np.concatenate([[bounds[k]], inner, [bounds[k + 1]]])
        if bounds[k] < f < bounds[k + 1]:
            places = np.unique(np.append(places, f))
        u = np.arcsinh((places - f) / w)
        for a, b in pairwise(u.tolist()):
            number = int(np.ceil((b - a) / _LONGEST))
            ends = np.linspace(a, b, number + 1)
            rows += [(f, w, c, d, k) for c, d in pairwise(ends.tolist())]
    centre, width, first, last, cell = np.array(rows).T
    return Pieces(centre, width, first, last, cell.astype(np.int64)), bounds, owner


def integrate(
    integrand: Callable[[Array], Array],
    pieces: Pieces,
    count: int,
    tolerance: float,
    scales: Callable[[Array], Array],
) -> tuple[Array, Array]:
    """Integrate several functions over the cells of a band.

    Parameters
    ----------
    integrand : callable
        Values at frequencies [Hz], shape (functions, k).
    pieces : Pieces
    count : int
        How many cells there are.
    tolerance : float
        Of each whole integral, relative to its scale.
    scales : callable
        By what each whole integral is measured, from all of them, shape (functions,).

    Returns
    -------
    parts : array, shape (functions, count)
        By cell.
    error : array, shape (functions,)
        Of the sums over the cells.

    Raises
    ------
    ComputationError
        If the tolerance is not met.
    """
    settled: Array | None = None
    error = np.zeros(0)
    for _ in range(_ROUNDS):
        fine, coarse = (_sums(integrand, pieces, order) for order in (_HIGH, _LOW))
        away = np.abs(fine - coarse)
        if settled is None:
            settled, error = np.zeros((len(fine), count)), np.zeros(len(fine))
        whole = np.sum(settled, axis=1) + np.sum(fine, axis=1)
        share = tolerance * scales(whole) / max(len(pieces.low), 1)
        bad = np.any(away > share[:, None] / 4, axis=0)
        good = ~bad
        np.add.at(settled.T, pieces.cell[good], fine[:, good].T)
        error += np.sum(away[:, good], axis=1)
        if not np.any(bad):
            return settled, error
        pieces = pieces.chosen(np.flatnonzero(bad)).halved()
        if len(pieces.low) > _MOST_PIECES:
            break
    raise ComputationError(
        "the integral over frequency does not settle; give more damping or a larger tolerance"
    )


def _sums(integrand: Callable[[Array], Array], pieces: Pieces, order: int) -> Array:
    f, w = pieces.points(order)
    values = integrand(f.ravel()).reshape(-1, *f.shape)
    return np.asarray(np.einsum("fpq,pq->fp", values, w))
