"""Families solved a beam at a time: once for every different set of columns of the stations."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FamilyName
from antinode.modes.solve import solve_modes

from .beams import CaseBeams
from .bending import Eigenvalues, nothing_solved, unit_shapes
from .reasons import failed
from .values import Cases


def solve_alone(cases: Cases, beams: CaseBeams, points: int, family: FamilyName) -> Eigenvalues:
    """Return the eigenvalues of a family of some cases, with shapes at so many points."""
    out = nothing_solved(cases.study, beams.reason, points)
    varies = [k for k in cases.numbers if k[:2] == ("vehicle", "stations")]
    varies += [k for k in cases.numbers if k == ("condition", "burn_fraction")]
    known: dict[bytes, tuple[Array, Array, Array]] = {}
    for i in np.flatnonzero(~failed(beams.reason)).tolist():
        key = b"".join(np.ascontiguousarray(cases.numbers[k][i]).tobytes() for k in varies)
        if key not in known:
            known[key] = _solved(cases, i, points, family)
        out.omega2[i], out.error[i], out.shapes[i] = known[key]
    return out


def _solved(cases: Cases, i: int, points: int, family: FamilyName) -> tuple[Array, Array, Array]:
    solve = cases.study.solve
    beam = cases.case(i).beam()
    result = solve_modes(beam, solve.modes, tolerance=solve.tolerance, families=[family])
    elastic = [k for k, m in enumerate(result.modes) if m.number][: solve.modes]
    omega2, error = (
        np.array([getattr(result.modes[k], name) for k in elastic])
        for name in ("omega2", "error_omega2")
    )
    x = np.linspace(0, beam.length, points)
    shapes = unit_shapes(result.at(x, family)[:, elastic, 0]) if points else x
    return omega2, error, shapes
