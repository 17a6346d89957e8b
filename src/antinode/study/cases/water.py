"""Cases of a vehicle on the water's stiffness, each solved by itself: their modes are complex."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.beam.plausible import doubts

from .beams import CaseBeams
from .reasons import failed
from .single import Solved
from .structures import BeamAnswers, answers_of
from .values import Cases
from .warned import LAST_BIT
from .water_warnings import WATER_MESSAGES, water_warned


def solve_in_water(cases: Cases, beams: CaseBeams, points: int) -> BeamAnswers:
    """Return the answers of some cases, with shapes at so many points."""
    built = {i: beam for i, (_, beam) in beams.built.items()}

    def bits(i: int, families: Sequence[Solved]) -> int:
        case, beam = beams.built[i]
        return water_warned(case, families, doubts(beam))

    found = answers_of(cases, built, beams.reason, points, bits)
    more = np.concatenate([cases.doubts(beams.scalars["mass"], beams.strained), beams.doubts])
    for k, concerns in enumerate(more, len(WATER_MESSAGES)):
        found.warned[:] |= concerns.astype(np.int64) << min(k, LAST_BIT)
    found.warned[failed(found.reason)] = 0
    return found
