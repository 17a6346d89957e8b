"""The characteristic function over frequency, scaled so that all its zeros show, and its roots."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.modes.hertz import hertz

from .numbers import pairs, short_list


def characteristic_data(answer: Answer) -> dict[str, Any]:
    """Return the function, scaled to sign(y) |y|^(1/3) of its largest value, and the roots."""
    frequencies, values = answer.characteristic
    size = np.max(np.abs(values)) or 1.0
    omega2 = answer.quick.omega2
    return {
        "points": pairs(frequencies, np.cbrt(values / size)),
        "roots": [] if answer.is_damped else short_list(hertz(omega2[omega2 > 0]), 6),
        "note": "without dampers and feedback" if answer.is_damped else "",
        "divergent": int(np.sum(omega2 < 0)),
    }
