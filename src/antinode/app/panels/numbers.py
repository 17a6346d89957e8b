"""Numbers short enough to send: four digits are more than a screen shows."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


def short_list(values: Iterable[float] | np.ndarray, digits: int = 4) -> list[float | None]:
    """Return numbers with so many digits; None where there is none."""
    flat = np.asarray(values, dtype=float).ravel()
    known = np.isfinite(flat)
    size = np.abs(np.where(known & (flat != 0), flat, 1.0))
    places = digits - 1 - np.floor(np.log10(np.clip(size, 1e-250, 1e250)))
    up, down = 10.0 ** np.maximum(places, 0), 10.0 ** np.maximum(-places, 0)
    rounded = np.round(np.where(known, flat, 0.0) * up / down) * down / up
    if known.all():
        return list(rounded.tolist())
    return [v if k else None for v, k in zip(rounded.tolist(), known.tolist(), strict=True)]


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
