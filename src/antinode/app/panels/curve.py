"""Frequencies against one input, with a cursor at its present value."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.curve import Curve
from antinode.app.display import System
from antinode.app.inputs import Input
from antinode.arrays import Array
from antinode.modes.hertz import hertz

from .numbers import pairs, short_list


def curve_data(curve: Curve, item: Input, system: System) -> dict[str, Any]:
    """Return one line a mode, over the input in units of the screen."""
    unit = item.shown(system)
    frequencies = hertz(curve.omega2)
    x = curve.values / unit.factor
    return {
        "label": item.label,
        "unit": unit.name,
        "low": unit.of(item.low),
        "high": unit.of(item.high),
        "lines": [pairs(x, column) for column in frequencies.T],
    }


def no_curve(item: Input, system: System) -> dict[str, Any]:
    """Return the frame of a curve that is not computed yet."""
    return curve_data(Curve("", item.path, np.empty(0), np.empty((0, 0))), item, system)


def cursor_data(item: Input, omega2: Array, system: System) -> dict[str, Any]:
    """Return the present value of the input and the frequencies there."""
    shown = short_list(hertz(omega2), 5)
    return {"value": item.shown(system).of(item.value), "hertz": shown}
