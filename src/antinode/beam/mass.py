"""Mass along an axis: its integrals, which stand here once for all.

``J_p = integral of m t^p dt``, p = 0, 1, 2, from the start of an interval: polynomials, or for
"log" ``J_0 = a s expm1(k s) / (k s)``, ``k = ln(b/a) / length``, and 16 Gauss points beyond.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from antinode.arrays import Array, Integers, Interpolation, distinct

from . import curves
from .profile import Profile

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2


def mass_within(a: Any, b: Any, length: Any, s: Any, how: Interpolation) -> Array:
    """Return the mass of the first `s` metres of intervals.

    Parameters
    ----------
    a, b : array_like
        Mass per length at both ends [kg/m].
    length, s : array_like
        Of the interval, and of its first part [m].
    how : {"step", "linear", "log"}
        How the mass runs between the ends.
    """
    if how != "log":
        return np.asarray(s * (a + (b - a) / length * s / 2))
    rate = np.log(b / a) * s / length
    mean = np.where(np.abs(rate) > 1e-12, np.expm1(rate) / np.where(rate == 0, 1.0, rate), 1.0)
    return np.asarray(a * s * mean)


def moments_within(a: Any, b: Any, length: Any, s: Any, how: Interpolation) -> list[Array]:
    """Return J_0, J_1, J_2 of the first `s` metres of intervals, about where these start.

    The arguments are those of `mass_within`.
    """
    J0 = mass_within(a, b, length, s, how)
    if how != "log":
        slope = (b - a) / length
        return [J0, s * s * (a / 2 + slope * s / 3), s * s * s * (a / 3 + slope * s / 4)]
    t = np.asarray(s)[..., None] * _NODES
    m = a[..., None] * (b / a)[..., None] ** (t / np.asarray(length)[..., None])
    return [J0, *(s * np.sum(_WEIGHTS * m * power, axis=-1) for power in (t, t * t))]


def moments_of_part(
    m: Array, length: Array, share: Array, how: Interpolation, most: int = 2
) -> list[Array]:
    """Return J_0 ... J_most of the first share of intervals, about where these start.

    Parameters
    ----------
    m : array, shape (..., 2) or (..., p + 1)
        Mass per length at both ends, or the control values of a polynomial [kg/m].
    length, share : array
        Of the intervals [m], and of that what the part takes.
    how : {"step", "linear", "log"}
    most : int
        0, or 2.
    """
    if m.shape[-1] > 2:
        return curves.moments(m, length, share, most)
    within = moments_within if most else mass_within
    found = within(m[..., 0], m[..., 1], length, share * length, how)
    return found if isinstance(found, list) else [found]


class MassDistribution(Profile):
    """Mass per length along the axis [kg/m], with its integrals: a `Profile`."""

    def __add__(self, other: MassDistribution) -> MassDistribution:
        """Return the sum of two distributions, each zero outside its own range.

        Raises
        ------
        ValueError
            If one is logarithmic: the sum would not be.
        """
        kinds = {self.interpolation, other.interpolation}
        if "log" in kinds:
            raise ValueError("masses interpolated by 'log' cannot be added: use step or linear")
        x = distinct(np.append(self.x, other.x))
        how: Interpolation = "step" if kinds == {"step"} else "linear"
        return MassDistribution(x, self.between(x) + other.between(x), how)

    def between(self, x: Array) -> Array:
        """Return the mass per length at both ends of the intervals between `x`, (..., m, 2)."""
        middle = (x[:-1] + x[1:]) / 2
        inside = (middle > self.x[0]) & (middle < self.x[-1])
        return np.where(inside[:, None], super().between(x), 0.0)

    def moments(self, x: ArrayLike) -> Array:
        """Return the integrals of m, m x and m x^2 from the nose to `x`.

        Parameters
        ----------
        x : array_like
            Where the integrals end [m].

        Returns
        -------
        ndarray (3, ...)
            Mass [kg], first moment [kg m] and second moment [kg m^2] about the nose.
        """
        x = np.asarray(x, dtype=float)
        k = self.interval(x)
        return np.asarray(self.moments_ahead[..., k] + self._partial(k, x - self.x[k]))

    @cached_property
    def moments_ahead(self) -> Array:
        """Moments from the nose to the bounds of the intervals, (3, ..., n+1)."""
        each = self._partial(np.arange(len(self.x) - 1), np.diff(self.x))
        return np.concatenate([np.zeros_like(each[..., :1]), np.cumsum(each, axis=-1)], axis=-1)

    def _partial(self, k: Integers, s: Array) -> Array:
        """Moments about the nose of the first `s` metres of the intervals `k`."""
        x, length = self.x[k], self.x[k + 1] - self.x[k]
        a, b = self.ends[..., k, 0], self.ends[..., k, 1]
        return np.stack(shifted(x, *moments_within(a, b, length, s, self.interpolation)))


def shifted(x: Array, J0: Array, J1: Array, J2: Array) -> tuple[Array, Array, Array]:
    """Return J_0, J_1, J_2 about the origin, of parts that start at `x`."""
    return J0, x * J0 + J1, x * x * J0 + 2 * x * J1 + J2


def state_shares(states: int, burn_fraction: Any) -> list[Any]:
    """Return how much each state of mass counts at a burn fraction: 0 the first, 1 the last.

    Between neighbouring states it is linear; the shares add up to 1.
    """
    place = np.asarray(burn_fraction) * (states - 1)
    return [np.maximum(0.0, 1.0 - np.abs(place - k)) for k in range(states)]


def burnt(columns: Sequence[Array], burn_fraction: Any) -> Array:
    """Return the column of mass per length at a burn fraction.

    Parameters
    ----------
    columns : sequence of array (..., rows)
        The states of mass, from full to burnt out [kg/m].
    burn_fraction : float or array (cases,)
        From 0 to 1 [-].
    """
    shares = state_shares(len(columns), burn_fraction)
    parts = [np.asarray(w)[..., None] * column for w, column in zip(shares, columns, strict=True)]
    return np.asarray(sum(parts[1:], parts[0]))
