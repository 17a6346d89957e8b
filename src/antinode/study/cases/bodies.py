"""Families that loads do not act on: once for every different body, bodies side by side."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.errors import AntinodeError

from .beams import CaseBeams
from .bending import Eigenvalues, nothing_solved
from .reasons import NOT_FOUND, failed
from .single import shapes_of
from .structures import solve_beams
from .values import Cases


def solve_bodies(cases: Cases, beams: CaseBeams, points: int, family: FamilyName) -> Eigenvalues:
    """Return the eigenvalues of a family of some cases, with shapes at so many points."""
    out, solve = nothing_solved(cases.study, beams.reason, points), cases.study.solve
    rows = np.flatnonzero(~failed(beams.reason)).tolist()
    first: dict[bytes, int] = {}
    body = {i: first.setdefault(cases.structure(i), i) for i in rows}
    built = {i: beam for i in first.values() if (beam := _built(cases, i)) is not None}
    found = solve_beams(built, family, solve.modes, solve.tolerance)
    shapes = {}
    if points:
        shapes = {i: _shapes(built[i], family, own.omega2, points) for i, own in found.items()}
    for i in rows:
        k = body[i]
        if k not in found:
            out.reason[i] = NOT_FOUND
            continue
        out.omega2[i], out.error[i] = found[k].omega2, found[k].error
        if points:
            out.shapes[i] = shapes[k]
    return out


def _built(cases: Cases, i: int) -> Beam | None:
    """Return the beam of a case; None where it has none."""
    try:
        with np.errstate(all="ignore"):
            return cases.case(i).beam()
    except (AntinodeError, ArithmeticError):
        return None


def _shapes(beam: Beam, family: FamilyName, omega2: Array, points: int) -> Array:
    return shapes_of(beam, family, omega2, beam.x[0] + np.linspace(0, beam.length, points))
