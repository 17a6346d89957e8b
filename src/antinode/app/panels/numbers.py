"""Numbers short enough to send: four digits are more than a screen shows."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np


def short_list(values: Iterable[float] | np.ndarray, digits: int = 4) -> list[float | None]:
    """Return numbers with so many digits; None where there is none."""
    flat = np.asarray(values, dtype=float).ravel().tolist()
    return [float(f"{v:.{digits}g}") if math.isfinite(v) else None for v in flat]


def pairs(x: np.ndarray, y: np.ndarray, digits: int = 4) -> list[list[float | None]]:
    """Return points of a curve as [x, y]."""
    return [
        list(pair) for pair in zip(short_list(x, digits + 1), short_list(y, digits), strict=True)
    ]


def thinned(x: np.ndarray, y: np.ndarray, most: int = 160) -> tuple[np.ndarray, np.ndarray]:
    """Leave out points of a smooth curve beyond a number, its ends kept."""
    if len(x) <= most:
        return x, y
    k = np.unique(np.linspace(0, len(x) - 1, most).round().astype(int))
    return x[k], y[k]
