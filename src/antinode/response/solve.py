"""`solve_response`: from a response file to its result."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from antinode.beam.beam import Beam
from antinode.errors import ComputationError

from .file import Problem, load_response
from .quantities import Drive

if TYPE_CHECKING:
    from .harmonic import HarmonicResult
    from .random import RandomResult
    from .shock import ShockResult
    from .transient import TransientResult

    Result = HarmonicResult | RandomResult | TransientResult | ShockResult


def solve_response(problem: Problem | str | Path) -> Result:
    """Compute what a response file asks for.

    Parameters
    ----------
    problem : Problem or path
        As `load_response` returns it, or the name of a response file.

    Returns
    -------
    HarmonicResult, RandomResult, TransientResult or ShockResult
        By the file's `kind`.

    Raises
    ------
    InputError
        If anything in the file is wrong.
    ComputationError
        If no trustworthy answer could be computed.
    """
    own = problem if isinstance(problem, Problem) else load_response(problem)
    growing = unstable(own.beam, own.file.drives)
    if growing and own.file.equipment:
        raise ComputationError(
            f"{own.title}: {growing}; no verdict on equipment can be given: lower the axial force, "
            "or leave [[equipment]] out to see the forced part alone"
        )
    result = _solved(own)
    if growing:
        told = f"{growing}: what is shown is the forced part alone, which never comes by itself"
        result = replace(result, warnings=(told, *result.warnings))
    return result


def unstable(beam: Beam, drives: tuple[Drive, ...]) -> str:
    """Return which modes of a driven family grow by themselves, without dampers; empty if none."""
    from antinode.modes.solve import solve_one

    if not np.any(beam.axial_force) and not beam.axial_acceleration:
        return ""
    found = [
        f"{mode.name} grows at {mode.growth_rate_per_s:.4g} /s"
        for family in dict.fromkeys(drive.family for drive in drives)
        for mode in solve_one(beam, 3, families=[family]).family(family)
        if mode.kind in ("divergent", "flutter")
    ]
    return f"the body is not stable under its axial force ({', '.join(found[:3])})" if found else ""


def _solved(own: Problem) -> Result:
    kind = own.file.response.kind
    if kind == "harmonic":
        from .harmonic import solve_harmonic

        return solve_harmonic(own)
    if kind == "random":
        from .random import solve_random

        return solve_random(own)
    if kind == "transient":
        from .transient import solve_transient

        return solve_transient(own)
    from .shock import solve_shock

    return solve_shock(own)
