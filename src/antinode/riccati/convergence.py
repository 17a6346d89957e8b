"""The one error rule: eigenvalues of ever finer chains, extrapolated, and how wrong they may be.

What varies inside segments is represented by steps that are halved from level to level. The error
of an eigenvalue falls as the fourth power of the steps: from a, b, c on three levels

    better = c + (c - b)/15,    better before = b + (b - a)/15,

and the error of `better` falls by 16 or more from level to level, so that it is at most 1/15 of
the last difference of the two. Stated is `SHARE` of it, and never less than a small share of the
change of omega^2 itself, a neighbour's as well: two levels may agree by accident.

A tension makes layers of width sqrt(EI/N) at ends, supports and kinks. While steps are longer than
these, what they leave of the error falls slowly, and mostly hides under the rest: then the whole
difference counts `LAYERED` times, that of the level before as well, and the largest of all modes
for each, because layers shorten the beam for all of them alike (validation/all_ways.md). Where the
coarsest of the three chains was so, the whole difference counts.

`modes.refinement` halves the steps until it holds; the compiled form does so in `lanes.levels`.

Numpy calls these functions as they stand, and `riccati.lanes` compiles them: plain loops on arrays.
Any number that is solved on halved steps may be judged so: omega^2, or a critical load factor.
"""

from __future__ import annotations

from .arrays import Array

SHARE = 1 / 4  # of the last difference of extrapolated values
ACCIDENT = 1 / 100  # of the last change, one's own or a neighbour's, that an error keeps
LAYERED = 3.0  # of the difference while layers are longer than steps
LAYER = 0.3  # |N| h^2/EI of half-steps up to which they are not
FEW = 1 / 4  # of the only change, where two levels are enough


def extrapolate(
    levels: Array, last: int, coarse: float, layer: float, better: Array, error: Array
) -> None:
    """Set the extrapolated values and bounds on their errors.

    Parameters
    ----------
    levels : array, shape (levels, number)
        Values on chains whose steps are halved each time.
    last : int
        Row of the finest, at least 1. With two rows alone nothing confirms the order: for beams
        whose axial force alone varies, in steps that resolve its layers.
    coarse : float
        Relative width to a tenth of which the values of all rows but the last are known.
    layer : float
        The largest abs(N) h^2/EI of the half-steps of the finest chain.
    better, error : array, shape (number,)
        Set.
    """
    number, worst = levels.shape[1], 0.0
    share = 1.0 if 16 * layer > LAYER else SHARE
    for k in range(number):
        b, c = levels[last - 1, k], levels[last, k]
        better[k] = c + (c - b) / 15
        if last == 1:
            error[k] = FEW * abs(c - b)
            continue
        before = b + (b - levels[last - 2, k]) / 15
        moved = abs(better[k] - before)
        error[k] = share * moved
        if layer > LAYER:
            if last > 2:
                a, z = levels[last - 2, k], levels[last - 3, k]
                moved = max(moved, abs(before - (a + (a - z) / 15)) / 4)
            worst = max(worst, moved / abs(better[k])) if better[k] != 0.0 else worst
    for k in range(number):
        error[k] = max(error[k], LAYERED * worst * abs(better[k]))
        for j in range(max(0, k - 1), min(number, k + 2)):
            change = abs(levels[last, j] - levels[last - 1, j])
            if last > 1:
                change = max(change, abs(levels[last - 1, j] - levels[last - 2, j]) / 16)
            if abs(better[j]) > abs(better[k]):
                change *= abs(better[k] / better[j])
            error[k] = max(error[k], ACCIDENT * change)
        error[k] += coarse / 100 * abs(better[k])


def within(better: Array, error: Array, tolerance: float, least: float) -> bool:
    """Tell whether the relative error of every frequency, half that of omega^2, is allowed.

    Relative to omega^2, or to `least` where it is smaller: near zero.
    """
    met = True
    for k in range(len(better)):
        met = met and error[k] <= 2.0 * tolerance * max(abs(better[k]), least)
    return met
