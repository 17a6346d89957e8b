"""Cases that have no loads, and why: the first reason of each counts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Integers
from antinode.errors import ComputationError, InputError

OUT_OF_RANGE, CAVITATION, FINS, EXTRA_DRAG, NOT_FINITE = 10, 11, 12, 13, 14
"""Reasons as numbers: 0 stands for a case that has loads."""

Words = Callable[[int], str]
"""The sentence for a case, by its row."""


class Refusals:
    """Reasons of many cases, gathered while their loads are worked out.

    Attributes
    ----------
    code : array of int, shape (cases,)
        0, or the reason.
    """

    def __init__(self, cases: int) -> None:
        self.code: Integers = np.zeros(cases, dtype=np.int64)
        self._words: list[tuple[npt.NDArray[np.bool_], Words]] = []

    @property
    def none(self) -> npt.NDArray[np.bool_]:
        """Which cases are not refused so far."""
        return np.asarray(self.code == 0)

    def refuse(self, wrong: Any, code: int, words: Words) -> None:
        """Refuse cases that are not refused already."""
        new = np.asarray(wrong) & (self.code == 0)
        if new.any():
            self.code[new] = code
            self._words.append((new, words))

    def check(self, case: int) -> None:
        """Raise what is wrong with a case if it is refused.

        Raises
        ------
        InputError
            If the case contradicts itself or cannot be.
        ComputationError
            If its loads are beyond what numbers can hold.
        """
        if self.code[case]:
            error = ComputationError if self.code[case] == NOT_FINITE else InputError
            raise error(next(words(case) for cases, words in self._words if cases[case]))
