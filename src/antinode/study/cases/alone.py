"""Families solved a beam at a time: once for every different set of columns of the stations."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FamilyName
from antinode.errors import AntinodeError
from antinode.modes.solve import solve_modes
from antinode.riccati.roots import CountingError

from .beams import CaseBeams
from .bending import Eigenvalues, nothing_solved, unit_shapes
from .reasons import NOT_FOUND, failed
from .values import Cases

_Solved = tuple[Array, Array, Array]


def solve_alone(cases: Cases, beams: CaseBeams, points: int, family: FamilyName) -> Eigenvalues:
    """Return the eigenvalues of a family of some cases, with shapes at so many points."""
    out = nothing_solved(cases.study, beams.reason, points)
    known: dict[bytes, _Solved | None] = {}
    for i in np.flatnonzero(~failed(beams.reason)).tolist():
        structure = cases.structure(i)
        if structure not in known:
            known[structure] = _solved(cases, i, points, family)
        solved = known[structure]
        if solved is None:
            out.reason[i] = NOT_FOUND
        else:
            out.omega2[i], out.error[i], out.shapes[i] = solved
    return out


def _solved(cases: Cases, i: int, points: int, family: FamilyName) -> _Solved | None:
    """Return omega^2, its error and the shapes of a case; None where it cannot be solved."""
    solve = cases.study.solve
    try:
        with np.errstate(all="ignore"):
            beam = cases.case(i).beam()
            result = solve_modes(
                beam,
                solve.modes,
                tolerance=solve.tolerance,
                families=[family],
                damping="none",
            )
    except (AntinodeError, ArithmeticError, CountingError):
        return None
    elastic = [k for k, m in enumerate(result.modes) if m.number][: solve.modes]
    if len(elastic) < solve.modes:
        return None
    omega2, error = (
        np.array([getattr(result.modes[k], name) for k in elastic])
        for name in ("omega2", "error_omega2")
    )
    x = np.linspace(0, beam.length, points)
    shapes = unit_shapes(result.at(x, family)[:, elastic, 0]) if points else x
    return omega2, error, shapes
