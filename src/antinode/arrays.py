"""Names for arrays, and for how values run between stations."""

from typing import Literal

import numpy as np

from .riccati.arrays import Array, Complex, Integers, Numbers, distinct

Interpolation = Literal["step", "linear", "log"]

__all__ = ["Array", "Complex", "Integers", "Interpolation", "Numbers", "at_station", "distinct"]

_SAME = 1e-9  # of the last station: places that are one


def at_station(stations: Array, x: Array) -> Array:
    """Return places, moved to a station that is the same place but for rounding."""
    after = np.clip(np.searchsorted(stations, x), 1, len(stations) - 1)
    low, high = stations[after - 1], stations[after]
    nearest = np.where(np.abs(x - low) <= np.abs(high - x), low, high)
    return np.where(np.abs(nearest - x) <= _SAME * stations[-1], nearest, x)
