"""Numbers as JSON takes them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np


def plain(values: Any) -> Any:
    """Return an array, or a number, as lists of floats with None for what is no finite number."""
    array = np.asarray(values, dtype=float)
    if array.ndim == 0:
        return float(array) if math.isfinite(array) else None
    if np.isfinite(array).all():
        return array.tolist()
    return [plain(value) for value in array]
