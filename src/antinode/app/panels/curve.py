"""Frequencies against one input, with a cursor at its present value."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.curve import Curve
from antinode.app.display import System, shown_unit
from antinode.app.inputs import Input

from .numbers import pairs


def curve_data(curve: Curve, item: Input, system: System) -> dict[str, Any]:
    """Return one line a mode, over the input in units of the screen."""
    unit = shown_unit(item.unit, system)
    with np.errstate(invalid="ignore"):
        hertz = np.sqrt(np.where(curve.omega2 >= 0, curve.omega2, np.nan)) / (2 * np.pi)
    x = curve.values / unit.factor
    return {
        "label": item.label,
        "unit": unit.name,
        "low": unit.of(item.low),
        "high": unit.of(item.high),
        "lines": [pairs(x, hertz[:, k]) for k in range(hertz.shape[1])],
    }


def cursor_data(item: Input, hertz: list[float | None], system: System) -> dict[str, Any]:
    """Return the present value of the input and the frequencies there."""
    return {"value": shown_unit(item.unit, system).of(item.value), "hertz": hertz}
