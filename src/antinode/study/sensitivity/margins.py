"""Critical factors of the case itself, and their exact derivatives by the inputs of a study."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array
from antinode.errors import AntinodeError
from antinode.stability.influence import critical_slopes
from antinode.stability.stability import stability
from antinode.study.cases.margins import first_lost
from antinode.study.complex_modes import Beside
from antinode.study.design.file import MARGIN_OUTPUTS, Study

LABELS = {"flutter_factor": "flutter factor", "divergence_factor": "divergence factor"}


def margin_slopes(
    study: Study, sides: Sequence[Beside | None]
) -> dict[str, tuple[float, float, Array]]:
    """Return factor, error, and derivatives by each input, of every margin that a study keeps.

    By left and right eigenvectors, as `antinode stability --influence` has them; NaN where the case
    has no such factor, or its derivatives are not told.
    """
    none = np.full(len(sides), np.nan)
    found: dict[str, tuple[float, float, Array]] = {
        name: (np.nan, np.nan, none) for name in study.outputs if name in MARGIN_OUTPUTS
    }
    if not found:
        return {}
    try:
        beam = study.case.beam()
        tolerance = study.solve.tolerance
        result = stability(beam, tolerance=tolerance, dampers=False, backend="numba")
    except (AntinodeError, ArithmeticError):
        return found
    for name in found:
        first = first_lost(result, name.removesuffix("_factor"))
        if first is None:
            continue
        try:
            slopes = critical_slopes(beam, first, sides)
        except AntinodeError:
            slopes = none
        found[name] = first.load_factor, first.error, slopes
    return found
