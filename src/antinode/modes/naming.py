"""Names of modes, and brackets that neighbours share."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FamilyName
from antinode.riccati.roots import Eigenvalue

from .brackets import share_brackets
from .result import Mode
from .rigid import exact_zeros, pivot_of, rigid_modes
from .rotation import rotation_among


def name_modes(
    beam: Beam, family: FamilyName, eigenvalues: list[Eigenvalue]
) -> list[tuple[str, int]]:
    """Return name and number of each eigenvalue, rigid modes set aside by index."""
    rigid = list(rigid_modes(beam, family))
    names: list[tuple[str, int] | None] = [None] * len(eigenvalues)
    zeros = [k for k, value in enumerate(eigenvalues) if value.omega2 == 0.0]
    for k, name in zip(zeros, rigid[: exact_zeros(beam, family)], strict=False):
        names[k] = (f"rigid {name}", 0)
        rigid.remove(name)
    for name in rigid:  # a rotation that the axial force moves off zero is the lowest of the rest
        rest = [k for k, given in enumerate(names) if given is None]
        k = rest[0] if not any(beam.following(family)) else _traced(beam, eigenvalues, rest)
        names[k] = (f"rigid {name}", 0)
    number = 0
    for k, given in enumerate(names):
        if given is None:
            number += 1
            names[k] = (f"{family} {number}", number)
    return [name for name in names if name is not None]


def _traced(beam: Beam, eigenvalues: list[Eigenvalue], rest: list[int]) -> int:
    """Return which eigenvalue is the rotation where end forces follow."""
    some = [eigenvalues[k] for k in rest]
    return rest[rotation_among(some, beam.chain(BENDING), pivot_of(beam))]


def with_joint_brackets(modes: list[Mode]) -> list[Mode]:
    """Let ascending modes share a bracket where rounding cannot part them."""
    brackets = [mode.bracket_omega2 for mode in modes]
    if all(a[1] < b[0] for a, b in pairwise(brackets)):
        return modes
    low, high = np.array(brackets).T.copy()
    counts = np.array([mode.counts for mode in modes])
    share_brackets(low, high, counts)
    rows = zip(low.tolist(), high.tolist(), counts.tolist(), strict=True)
    return [
        replace(mode, bracket_omega2=(a, b), counts=(below, above))
        for mode, (a, b, (below, above)) in zip(modes, rows, strict=True)
    ]
