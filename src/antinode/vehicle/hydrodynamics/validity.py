"""Ranges of validity: data next to each correlation, and the check that turns them into words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple


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

    def is_inside(self, value: Any) -> Any:
        """Tell whether values, an array or one, are inside."""
        return (self.low <= value) & (value <= self.high)

    def check(self, value: float) -> Validity:
        """Return the range together with a value and the verdict."""
        inside = bool(self.is_inside(value))
        return Validity(self.correlation, self.quantity, value, self.low, self.high, inside)

    @property
    def message(self) -> str:
        """The sentence for any value outside: what, allowed, what to do."""
        return self._sentence(f"{self.quantity} is outside its range")

    def warning(self, value: float) -> str:
        """Return the same sentence with the value."""
        return self._sentence(f"{self.quantity} = {value:.4g} is outside its range")

    def _sentence(self, what: str) -> str:
        allowed = f"{self.low:g} to {self.high:g}"
        if math.isinf(self.high):
            allowed = f"at least {self.low:g}"
        return f"{self.correlation}: {what}, {allowed}: {self.advice}."
