"""Why a case of a study has no answer, or a special one: codes and what they mean."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from antinode.arrays import Integers
from antinode.modes.batch import REASONS
from antinode.vehicle.refusals import CAVITATION, EXTRA_DRAG, FINS, NOT_FINITE, OUT_OF_RANGE

PAST_BUCKLING, FLUTTERS, BEYOND_LIMITS, NO_BEAM, NOT_FOUND = 6, 7, 15, 16, 17
GROWS, NOT_PROVEN = 18, 19
ANSWERS = (0, PAST_BUCKLING, FLUTTERS, GROWS)
"""Codes of cases that have an answer."""
WHY: dict[int, str] = {
    **dict(enumerate(REASONS)),
    0: "solved",
    OUT_OF_RANGE: "an input is outside the range that the case allows",
    CAVITATION: "speed, depth and pressures give no cavitation number between 0 and 1, "
    "or contradict each other",
    FINS: "a fin set is off the body, or its tips are inside it",
    EXTRA_DRAG: "the extra drag acts off the body",
    NOT_FINITE: "the loads are too large or too small for numbers",
    BEYOND_LIMITS: "the axial force is out of all proportion to the bending stiffness",
    NO_BEAM: "the case has no loads or no beam",
    NOT_FOUND: "the modes of a family could not be found",
    GROWS: "a mode grows without oscillating, by forces that answer it or turn with the body",
    NOT_PROVEN: "that no complex mode is missing is not proven: what damps, feeds back or follows "
    "is too large beside the stiffness, or an eigenvalue lies next to zero",
}
"""What the reason codes mean; those of `ANSWERS` are no failures."""


def failed(reason: Integers) -> npt.NDArray[np.bool_]:
    """Tell which cases have no answer."""
    return ~np.isin(reason, ANSWERS)
