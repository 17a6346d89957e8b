"""What holds a beam along its axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Spring
from antinode.beam.families import LONGITUDINAL

if TYPE_CHECKING:
    from antinode.beam.beam import Beam


def axial_supports(beam: Beam) -> Array:
    """Return the axial stiffness to ground at every breakpoint [N/m], infinite at fixed ends."""
    stiffness = np.zeros(len(beam.x))
    left, right = beam.ends.of(LONGITUDINAL)
    stiffness[0] += np.inf if left == "fixed" else 0.0
    stiffness[-1] += np.inf if right == "fixed" else 0.0
    for item in beam.attachments:
        if isinstance(item, Spring):
            stiffness[int(np.argmin(np.abs(beam.x - item.x)))] += item.axial
    return stiffness
