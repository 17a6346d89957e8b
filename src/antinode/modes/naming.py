"""Names of modes, and brackets that neighbours share."""

from __future__ import annotations

from dataclasses import replace

from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.riccati.roots import Eigenvalue

from .result import Mode
from .rigid import exact_zeros, rigid_modes


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
        names[names.index(None)] = (f"rigid {name}", 0)
    number = 0
    for k, given in enumerate(names):
        if given is None:
            number += 1
            names[k] = (f"{family} {number}", number)
    return [name for name in names if name is not None]


def with_joint_brackets(modes: list[Mode]) -> list[Mode]:
    """Let modes share a bracket where rounding cannot part them."""
    groups: list[list[Mode]] = []
    for mode in modes:
        if groups and mode.bracket_omega2[0] <= max(m.bracket_omega2[1] for m in groups[-1]):
            groups[-1].append(mode)
        else:
            groups.append([mode])
    return [mode for group in groups for mode in (_sharing(group) if group[1:] else group)]


def _sharing(group: list[Mode]) -> list[Mode]:
    low, high = zip(*(mode.bracket_omega2 for mode in group), strict=True)
    below, above = zip(*(mode.counts for mode in group), strict=True)
    bracket, counts = (min(low), max(high)), (min(below), max(above))
    return [replace(mode, bracket_omega2=bracket, counts=counts) for mode in group]
