"""What cases on the water's stiffness warn of: what complex modes tell, and its limits."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array
from antinode.vehicle.case import Case
from antinode.vehicle.tangent import QUASI_STEADY

from .beam_warnings import RECOGNISED, recognised
from .single import Solved

DELAYED = (
    f"some modes: f L/V is above {QUASI_STEADY:g}, so the water needs longer to pass the body than "
    "its tangents allow for; with them the frequencies are a limit, no prediction"
)
ONE_SIDED = (
    "the planing tail touches on one side: the modes hold up to the amplitude at which that "
    "contact ends, some mm as a rule; 'antinode modes' tells it, and the modes without contact"
)
_OWN = "a warning of its own: 'antinode modes' of that case alone says it"
WATER_MESSAGES = (*(text for _, text in RECOGNISED), DELAYED, ONE_SIDED, _OWN)


def is_one_sided(case: Case) -> bool:
    """Tell whether a contact of a case ends at some amplitude."""
    return any(math.isfinite(tangent.room) for tangent in case.tangents)


def is_delayed(case: Case, frequency_hz: Array) -> bool:
    """Tell whether the water needs too long to pass the body for some of its modes."""
    quick = float(np.nanmax(frequency_hz, initial=0.0))
    return quick * case.vehicle.length / case.condition.speed > QUASI_STEADY


def water_warned(case: Case, families: Sequence[Solved], unlikely: Sequence[str]) -> int:
    """Return the bits of one case, by `WATER_MESSAGES`.

    Parameters
    ----------
    case : Case
    families : sequence of Solved
        In the order of the study.
    unlikely : sequence of str
        What its beam warns of besides, which has bits of its own.
    """
    told = set[str]()
    for solved in families:
        told |= {
            recognised(warning, WATER_MESSAGES) or _OWN
            for warning in solved.warnings or ()
            if warning not in unlikely
        }
        if solved.is_complex and solved.motion is not None:
            delayed = is_delayed(case, solved.motion.frequency_hz)
            told |= {DELAYED} if delayed else set()
    if is_one_sided(case):
        told.add(ONE_SIDED)
    return sum(1 << WATER_MESSAGES.index(text) for text in told)
