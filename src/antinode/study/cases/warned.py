"""What each case warns of: a bit for each sentence, and how many cases it concerns."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.modes.warnings import (
    MODEL_LIMIT,
    PAST_BUCKLING,
    ROTATION_DIVERGES,
    SHEAR_BUCKLES,
    SHEAR_LOWERS,
    shear_buckles,
)
from antinode.study.design.file import Study

from .reasons import failed

_OF_MODES = (
    f"elastic modes with omega^2 < 0: {PAST_BUCKLING}",
    ROTATION_DIVERGES,
    f"some modes: {SHEAR_LOWERS}",
    f"some modes: {SHEAR_BUCKLES}",
)


def messages(study: Study) -> tuple[str, ...]:
    """Return what a case of a study can warn of, in the order of the bits."""
    return _OF_MODES


def warned(reason: Integers, omega2: Array, net_force: Array, model_error: Array) -> Integers:
    """Return the bits of every case.

    Parameters
    ----------
    reason : array of int, shape (cases,)
        Cases that failed warn of nothing.
    omega2, model_error : array, shape (cases, modes)
    net_force : array, shape (cases,)
        Integral of N along the axis [N m].
    """
    with np.errstate(invalid="ignore"):
        told = (
            np.any(omega2 < 0, axis=1),
            net_force > 0,
            np.any(np.abs(model_error) > MODEL_LIMIT, axis=1),
            np.any(shear_buckles(model_error), axis=1),
        )
    bits = sum(np.where(each, 1 << k, 0) for k, each in enumerate(told))
    return np.where(failed(reason), 0, bits)


def counted_warnings(
    texts: Iterable[str], blocks: Iterable[npt.NDArray[Any]], cases: int
) -> list[dict[str, Any]]:
    """Count the cases that each sentence concerns; sentences that concern none are left out.

    Parameters
    ----------
    texts : iterable of str
        In the order of the bits.
    blocks : iterable of array of int
        The bits of all cases, one block after the other.
    cases : int
        Number of all cases, those that failed included.
    """
    texts = tuple(texts)
    count, first, start = [0] * len(texts), [-1] * len(texts), 0
    for bits in blocks:
        for k in range(len(texts)):
            concerned = np.flatnonzero(bits & (1 << k))
            if len(concerned) and first[k] < 0:
                first[k] = start + int(concerned[0])
            count[k] += len(concerned)
        start += len(bits)
    return [
        {"message": text, "count": n, "share": n / cases, "first_case": at}
        for text, n, at in zip(texts, count, first, strict=True)
        if n
    ]
