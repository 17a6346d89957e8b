"""`solve_response`: from a response file to its result."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .file import Problem, load_response

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
