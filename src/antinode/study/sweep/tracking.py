"""Modes that keep their identity along a sweep, by the likeness of their shapes.

``MAC = (u . v)^2 / (u^2 v^2)`` with the mass as weight is 1 for equal shapes and 0 for different
modes of one body. From each case to its neighbour, modes are paired so that the sum of MAC is
largest: a mode goes on through crossings, and through veerings as its shape turns. A family is
tracked by itself: bending and longitudinal modes never mix. Where two tracks of a family change
places between neighbours, the modes crossed, or veered within that one step: their shapes before
and after are alike, so that the likeness alone does not tell.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers

_TIE = 1e-6  # weight of closeness in frequency where shapes do not decide


class Tracks(NamedTuple):
    """Which mode each track is in each case.

    Attributes
    ----------
    mode : array of int, shape (cases, tracks)
        Index along the modes; -1 where the case failed.
    mac : array, shape (cases, tracks)
        Likeness with the neighbour; 1 where the track starts, NaN where the case failed.
    swapped : array of bool, shape (cases, tracks)
        Whether the mode has another number than in the neighbour.
    """

    mode: Integers
    mac: Array
    swapped: npt.NDArray[np.bool_]


def neighbours(shape: tuple[int, ...]) -> Integers:
    """Return the case that each case of a grid is compared with: one step back; -1 for the first.

    A case goes back along the last input if it can, else along the one before, and so on.
    """
    index = np.indices(shape).reshape(len(shape), -1)
    found = np.full(index.shape[1], -1)
    strides = [int(np.prod(shape[k + 1 :])) for k in range(len(shape))]
    for k in range(len(shape)):
        moves = index[k] > 0
        found[moves] = np.flatnonzero(moves) - strides[k]
    return found


def track(shapes: Array, omega2: Array, before: Integers, weights: Array, family: int) -> Tracks:
    """Follow modes from case to case.

    Parameters
    ----------
    shapes : array, shape (cases, modes, points)
        NaN in cases that failed.
    omega2 : array, shape (cases, modes)
        Or frequencies: what parts equal shapes.
    before : array of int, shape (cases,)
        The neighbour that each case is compared with, of smaller number; -1 for none.
    weights : array, shape (points,)
        Mass at the points.
    family : int
        Modes of one family, which stand together.
    """
    from scipy.optimize import linear_sum_assignment

    cases, modes, _ = shapes.shape
    scaled = shapes * np.sqrt(weights)
    size = np.linalg.norm(scaled, axis=-1, keepdims=True)
    scaled = scaled / np.where(size > 0, size, 1.0)
    mode, mac = np.full((cases, modes), -1), np.full((cases, modes), np.nan)
    swapped = np.zeros((cases, modes), dtype=bool)
    known = np.full(cases, -1)  # the last case on the way here that did not fail
    for i in range(cases):
        back = known[before[i]] if before[i] >= 0 else -1
        if not np.all(np.isfinite(scaled[i])):
            known[i] = back
            continue
        known[i] = i
        if back < 0:
            mode[i], mac[i] = np.arange(modes), 1.0
            continue
        for first in range(0, modes, family):
            own = slice(first, first + family)
            was = mode[back, own]
            likeness = (scaled[back, was] @ scaled[i, own].T) ** 2
            with np.errstate(all="ignore"):
                apart = np.abs(np.subtract.outer(omega2[back, was], omega2[i, own]))
                largest = np.max(np.nan_to_num(np.abs(omega2[i, own])))
                apart = np.nan_to_num(apart / largest, posinf=0.0)
            rows, columns = linear_sum_assignment(_TIE * apart - likeness)
            mode[i, own] = columns + first
            mac[i, own] = likeness[rows, columns]
            swapped[i, own] = mode[i, own] != was
    return Tracks(mode, mac, swapped)
