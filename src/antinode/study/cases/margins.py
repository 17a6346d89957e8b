"""Margins of stability of each case: factors on its axial forces, solved a case at a time."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array, Integers
from antinode.errors import AntinodeError
from antinode.stability.result import CriticalLoad, Stability
from antinode.stability.stability import stability

from .reasons import failed
from .values import Cases


def margins(cases: Cases, reason: Integers) -> dict[str, Array]:
    """Return the factors at which flutter begins, and at which a mode first diverges.

    NaN where the case failed, where there is no such factor, and where none was found. Dashpots and
    loss factors are left out.
    """
    number = len(reason)
    found = {name: np.full(number, np.nan) for name in ("flutter_factor", "divergence_factor")}
    tolerance = cases.study.solve.tolerance
    for i in np.flatnonzero(~failed(reason)).tolist():
        try:
            beam = cases.problem(i).beam()
            result = stability(beam, tolerance=tolerance, dampers=False, backend="numba")
        except (AntinodeError, ArithmeticError):
            continue
        for kind in ("flutter", "divergence"):
            first = first_lost(result, kind)
            if first is not None:
                found[f"{kind}_factor"][i] = first.load_factor
    return found


def first_lost(result: Stability, kind: str) -> CriticalLoad | None:
    """Return the first critical load of a kind at which stability is lost."""
    lost = (each for each in result.critical if each.change == "lost")
    return next((each for each in lost if each.kind == kind), None)
