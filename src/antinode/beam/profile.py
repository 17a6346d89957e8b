"""A property along an axis: its values at both ends of intervals, and what runs between them.

"step" and "linear" run along a straight line between the ends (equal ones for "step"), "log" along
an exponential. Leading dimensions of the values are cases: one profile holds a property of many.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

from antinode.arrays import Array, Integers, Interpolation

ROUNDING = 1e-12
"""Of the largest |x|, by which a place may miss an end of the beam: "3 ft" is not quite "36 in"."""


AT_START = np.zeros(())
"""The fraction of all intervals at which they start: what stands there needs no arithmetic."""


def interpolated(a: Any, b: Any, fraction: Any, how: Interpolation) -> Any:
    """Return what a property is at fractions 0 ... 1 between its values `a` and `b`."""
    return a * (b / a) ** fraction if how == "log" else a + (b - a) * fraction


def kept_intervals(x: Array, how: Interpolation) -> npt.NDArray[np.bool_]:
    """Tell which intervals of a table have a length; two rows at one x are a jump."""
    return np.ones(len(x) - 1, dtype=bool) if how == "step" else np.asarray(x[1:] != x[:-1])


def breakpoints(x: Array, kept: npt.NDArray[np.bool_]) -> Array:
    """Return the bounds of the intervals of a table that are kept."""
    return x if _all(kept) else np.append(x[:-1][kept], x[-1:])


def _all(kept: npt.NDArray[np.bool_]) -> bool:
    return int(np.count_nonzero(kept)) == len(kept)


def interval_ends(column: Array, kept: npt.NDArray[np.bool_], how: Interpolation) -> Array:
    """Return a column with a row a station at both ends of the intervals, (n, 2), read-only."""
    table = np.empty((len(kept), 2))
    table[:, 0] = column[: len(kept)]
    table[:, 1] = table[:, 0] if how == "step" else column[1:]
    table = table if how == "step" or _all(kept) else table[kept]
    table.flags.writeable = False
    return table


@dataclass(frozen=True, eq=False)
class Profile:
    """A property along an axis, of one case or of many.

    Parameters
    ----------
    x : ndarray (n+1,)
        Bounds of the intervals [m].
    ends : ndarray (..., n, 2)
        The property at both ends of each interval.
    interpolation : {"step", "linear", "log"}
        How it runs between the ends.
    """

    x: Array
    ends: Array
    interpolation: Interpolation

    @classmethod
    def of_rows(cls, x: Array, rows: Array, how: Interpolation) -> Self:
        """Return the profile of a column with one row a station, (..., n+1); "step" holds it."""
        before = rows[..., :-1]
        after = before if how == "step" else rows[..., 1:]
        return cls(x, np.stack([before, after], axis=-1), how)

    def interval(self, x: Array) -> Integers:
        """Return the interval of every place; aft of the step at a bound."""
        k = np.searchsorted(self.x, x, side="right") - 1
        return np.asarray(np.clip(k, 0, len(self.x) - 2))

    def at(self, x: ArrayLike) -> Array:
        """Return the property at `x`; aft of the step where it jumps, constant off the axis."""
        x = np.asarray(x, dtype=float)
        k = self.interval(x)
        return self._within(k, x)

    def between(self, x: Array) -> Array:
        """Return the property at both ends of the intervals between `x`, (..., m, 2)."""
        k = self.interval((x[:-1] + x[1:]) / 2)
        return np.stack([self._within(k, x[:-1]), self._within(k, x[1:])], axis=-1)

    def _within(self, k: Integers, x: Array) -> Array:
        """Values at places in the intervals `k`; exact at their bounds."""
        a, b = self.ends[..., k, 0], self.ends[..., k, 1]
        t = np.clip((x - self.x[k]) / (self.x[k + 1] - self.x[k]), 0.0, 1.0)
        return np.where(t == 1.0, b, interpolated(a, b, t, self.interpolation))
