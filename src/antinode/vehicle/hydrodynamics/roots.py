"""Roots of many functions at once, each between two places where its sign differs.

Chandrupatla's method: inverse quadratic interpolation where the three latest points allow it, else
bisection; the first place is that of the secant. A place where the function is zero is a root: near
one it may be zero over some rounding errors. A root does not depend on which others are looked for
beside it.

Source: T. R. Chandrupatla, "A new hybrid quadratic/bisection algorithm for finding the zero of a
nonlinear function without using derivatives", Advances in Engineering Software 28 (1997) 145-149.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from antinode.arrays import Array, Integers

_MOST_STEPS = 100
_SHARE = 4  # those that are found are set aside once they are one in so many
_LEAST = 1 / 64  # of an interval, between its end and the first place
_PRECISION = 2 * np.finfo(float).eps


def find_roots(function: Callable[[Array, Integers], Array], low: Array, high: Array) -> Array:
    """Return where a function becomes positive, or stops being so, between two places each.

    Parameters
    ----------
    function : callable
        Values at one place for each of some roots, which the second argument names.
    low, high : array, shape (roots,)
        Places of which one has a positive value.
    """
    rows = np.arange(len(low))
    a, b, root = high, low, high.copy()
    f_a, f_b = function(a, rows), function(b, rows)
    with np.errstate(all="ignore"):
        t = np.clip(np.nan_to_num(f_a / (f_a - f_b), nan=0.5), _LEAST, 1 - _LEAST)
        for _ in range(_MOST_STEPS if len(low) else 0):
            precision = _PRECISION * np.maximum(np.abs(a), np.abs(b))
            found = (np.abs(b - a) <= precision) | (f_a == 0)
            if np.count_nonzero(found) * _SHARE >= len(found):
                root[rows] = np.where(np.abs(f_a) <= np.abs(f_b), a, b)
                left = np.flatnonzero(~found)
                if not len(left):
                    return root
                rows, precision, found = rows[left], precision[left], found[left]
                a, b, t, f_a, f_b = (v[left] for v in (a, b, t, f_a, f_b))
            x = np.where(found, a, a + t * (b - a))
            f_x = function(x, rows)
            same = (f_x > 0) == (f_a > 0)
            c, f_c = np.where(same, a, b), np.where(same, f_a, f_b)
            b, f_b = np.where(same, b, a), np.where(same, f_b, f_a)
            a, f_a = x, f_x
            t = _next_fraction(a, b, c, f_a, f_b, f_c, precision)
    root[rows] = np.where(np.abs(f_a) <= np.abs(f_b), a, b)
    return root


def _next_fraction(
    a: Array, b: Array, c: Array, f_a: Array, f_b: Array, f_c: Array, precision: Array
) -> Array:
    """Return where to look between `a` and `b`; `c` is the place that was given up last.

    Equal places and values are not smooth, or found already.
    """
    width = b - a
    place, value = -width / (c - b), (f_a - f_b) / (f_c - f_b)
    smooth = (value * value < place) & ((1 - value) * (1 - value) < 1 - place)
    quadratic = f_a / (f_b - f_a) * f_c / (f_b - f_c)
    quadratic += (c - a) / width * f_a / (f_c - f_a) * f_b / (f_c - f_b)
    near = np.minimum(precision / np.abs(width), 0.5)
    return np.where(smooth, np.minimum(np.maximum(quadratic, near), 1 - near), 0.5)
