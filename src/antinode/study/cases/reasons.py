"""Why a case of a study has no answer, or a special one: codes and what they mean."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from antinode.arrays import Integers
from antinode.modes.batch import REASONS
from antinode.vehicle.refusals import CAVITATION, EXTRA_DRAG, FINS, NOT_FINITE, OUT_OF_RANGE

PAST_BUCKLING, FLUTTERS, BEYOND_LIMITS, NO_BEAM, NOT_FOUND = 6, 7, 15, 16, 17
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
}
"""What the reason codes mean; past buckling and flutter are answers, others but 0 are failures."""


def failed(reason: Integers) -> npt.NDArray[np.bool_]:
    """Tell which cases have no answer."""
    return np.asarray((reason != 0) & (reason != PAST_BUCKLING) & (reason != FLUTTERS))
