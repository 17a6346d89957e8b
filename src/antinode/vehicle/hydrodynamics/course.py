"""How a cavity runs along a body, in a few numbers: radius, axis, and their slopes.

With ``s = 2 x / L_c``, which is 2 at the closure, eq. 9 is
``R_c^2 = s (2 - s) (D_c^2 - D_n^2)/4 + D_n^2/4``, and the axis runs ``a_0 + a_1 s + a_3 s^3`` above
the body's: its angle and eq. 13 are straight, eq. 10 is a cube; the rise by buoyancy comes to that.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 9, 10, 13.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.arrays import Array


def rise_by_buoyancy(x_bar: Any, Fr_L: Any) -> Any:
    """Rise of an ellipsoidal cavity by the momentum of its buoyancy, over half its length [-].

    A section of area S moves up at g Q / (V S), with Q the volume of cavity ahead of it: the
    impulse of its buoyancy over its displaced mass. The integral is infinite at the cavity's end.

    Parameters
    ----------
    x_bar : array_like
        Distance from the nose over half the cavity length, below 2 [-].
    Fr_L : array_like
        Froude number of the cavity length [-].
    """
    return (x_bar**2 / 6 - x_bar / 3 - 2 / 3 * np.log1p(-x_bar / 2)) / (2 * Fr_L**2)


def buoyancy_slope(x_bar: Any, Fr_L: Any) -> Any:
    """Return the derivative of `rise_by_buoyancy` by `x_bar` [-]."""
    return (x_bar / 3 - 1 / 3 + 2 / 3 / (2 - x_bar)) / (2 * Fr_L**2)


@dataclass(frozen=True)
class Course:
    """The course of one cavity, or of many.

    Parameters
    ----------
    numbers : array, shape (7 or 10, ...)
        L_c [m], 2/L_c [1/m], (D_c^2 - D_n^2)/4 and D_n^2/4 [m^2], a_0, a_1, a_3 [m]; where the rise
        is by buoyancy what it is multiplied by [m], Fr_L, and the s from which it stays.
    """

    numbers: Array

    @property
    def closure(self) -> Array:
        """L_c [m]."""
        return np.asarray(self.numbers[0])

    @property
    def is_buoyant(self) -> bool:
        """Whether the rise is by buoyancy."""
        return len(self.numbers) > 7

    def take(self, rows: Any) -> Course:
        """Return the courses of some cases; of a slice a view."""
        if isinstance(rows, slice):
            return Course(self.numbers[:, rows])
        return Course(np.take(self.numbers, rows, axis=1))

    def radius(self, x: Any) -> Array:
        """Return R_c at places [m]; 0 behind the closure."""
        return np.where(x <= self.closure, self.radius_ahead(x), 0.0)

    def axis(self, x: Any) -> Array:
        """Return cavity axis minus body axis at places [m]; behind the closure that at it."""
        return self.axis_ahead(np.minimum(x, self.closure))

    def radius_ahead(self, x: Any) -> Array:
        """Return R_c at places that are not behind the closure [m]."""
        _, scale, growth, least, *_ = self.numbers
        s = scale * x
        square = (2 - s) * s
        square *= growth
        square += least
        return np.asarray(np.sqrt(np.maximum(square, 0)))

    def axis_ahead(self, x: Any) -> Array:
        """Return cavity axis minus body axis at places that are not behind the closure [m]."""
        _, scale, _, _, a0, a1, a3, *buoyancy = self.numbers
        s = scale * x
        found = s * s
        found *= a3
        found += a1
        found *= s
        found += a0
        if buoyancy:
            amount, Fr_L, last = buoyancy
            found = found + amount * rise_by_buoyancy(np.minimum(s, last), Fr_L)
        return np.asarray(found)

    def radius_slope(self, x: Any) -> Array:
        """Return dR_c/dx at places [-]; 0 behind the closure."""
        closure, scale, growth, *_ = self.numbers
        ahead = x <= closure
        R_c = np.where(ahead, self.radius_ahead(x), 1.0)
        return np.where(ahead, growth * (1 - scale * x) * scale / R_c, 0.0)

    def axis_slope(self, x: Any) -> Array:
        """Return the slope of the axis at places [-]; behind the closure that at it."""
        closure, scale, _, _, _, a1, a3, *buoyancy = self.numbers
        s = scale * np.minimum(x, closure)
        found = a1 + 3 * a3 * s * s
        if buoyancy:
            amount, Fr_L, last = buoyancy
            slope = amount * buoyancy_slope(np.minimum(s, last), Fr_L)
            found = found + np.where(s < last, slope, 0.0)
        return np.asarray(found * scale)

    def protrusion_bound(self, start: Any, end: Any, R_start: Any, R_end: Any) -> Array:
        """Return what ``abs(axis) + R - R_c`` is at most between places [m]; infinite: unknown.

        R is straight there, R_c concave, the axis convex: ``axis + R - R_c`` is largest at an end,
        ``-axis + R - R_c`` above its ends by no more than the axis lies below its chord, a quarter
        of the length times the growth of its slope.

        Parameters
        ----------
        start, end : float or array
            The places [m].
        R_start, R_end : float or array
            Radius of the body there [m].
        """
        _, scale, growth, _, _, _, a3, *buoyancy = self.numbers
        below = (end - start) * (self.axis_slope(end) - self.axis_slope(start)) / 4
        ends = (
            np.abs(self.axis(x)) + R - self.radius(x) for x, R in ((start, R_start), (end, R_end))
        )
        amount, _, last = buoyancy or (a3, None, math.inf)
        known = (end <= self.closure) & (scale * end <= last)
        is_convex = (growth >= 0) & (amount >= 0) & known
        return np.where(is_convex, np.maximum(*ends) + below, np.inf)
