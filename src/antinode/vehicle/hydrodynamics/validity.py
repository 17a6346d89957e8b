"""Ranges of validity: data next to each correlation, and the check that turns them into words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple


class Validity(NamedTuple):
    """One checked range: which correlation, which quantity, its value and whether it is inside."""

    correlation: str
    quantity: str
    value: float
    low: float
    high: float
    inside: bool


@dataclass(frozen=True)
class Range:
    """A correlation's range of validity.

    Parameters
    ----------
    correlation : str
        What it is, with its equation.
    quantity : str
        The quantity that is bounded, with its unit.
    low, high : float
        The bounds; infinite where there is none.
    source : str
        Where the bounds come from.
    advice : str
        What to do about a value outside.
    """

    correlation: str
    quantity: str
    low: float
    high: float
    source: str
    advice: str

    def check(self, value: float) -> Validity:
        """Return the range together with a value and the verdict."""
        inside = self.low <= value <= self.high
        return Validity(self.correlation, self.quantity, value, self.low, self.high, inside)

    def warning(self, value: float) -> str:
        """Return the sentence for a value outside: what, allowed, what to do."""
        allowed = f"{self.low:g} to {self.high:g}"
        if math.isinf(self.high):
            allowed = f"at least {self.low:g}"
        what = f"{self.correlation}: {self.quantity} = {value:.4g} is outside its range, {allowed}"
        return f"{what}: {self.advice}."
