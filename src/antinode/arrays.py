"""Names for arrays, and for how values run between stations."""

from typing import Literal

from .riccati.arrays import Array, Complex, Integers, Numbers, distinct

Interpolation = Literal["step", "linear", "log"]

__all__ = ["Array", "Complex", "Integers", "Interpolation", "Numbers", "distinct"]
