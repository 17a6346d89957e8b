"""From a state to the numbers that the panels show: quickly while something moves, then fully.

Everything here is SI. Results are kept by what they depend on, so that going back is free.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.modes.result import ModalResult, not_modelled
from antinode.modes.solve import solve_modes
from antinode.riccati.chain import evaluate
from antinode.vehicle.case import Case

from .inputs import Problem
from .quick import QUICK_FAMILY, Quick, quick_modes
from .state import State

Result = TypeVar("Result")
_SAMPLES = 129  # of the characteristic function
MOST_MODES = 12
"""Bending modes on the page; more are for the command line."""


@dataclass(frozen=True)
class Answer:
    """All that a page shows of one problem.

    Parameters
    ----------
    problem : Case or BeamFile
    beam : Beam
    quick : Quick
        Bending modes.
    full : ModalResult or None
        All modes with certificates and comparisons; None while something moves.
    """

    problem: Problem
    beam: Beam
    quick: Quick
    full: ModalResult | None = None

    @cached_property
    def characteristic(self) -> tuple[Array, Array]:
        """Frequencies up to beyond the last mode [Hz], and the characteristic function there."""
        top = 1.12 * np.sqrt(max(float(self.quick.omega2[-1]), 1e-12))
        omega = np.linspace(0.0, top, _SAMPLES)[1:]
        with np.errstate(all="ignore"):
            values = evaluate(self.beam.chain(QUICK_FAMILY), omega**2).characteristic
        return omega / (2 * np.pi), values

    @property
    def case(self) -> Case | None:
        """The problem if it is a vehicle in a condition."""
        return self.problem if isinstance(self.problem, Case) else None

    @property
    def warnings(self) -> list[str]:
        """Warnings as on the command line."""
        loads = list(self.case.loads.warnings) if self.case else []
        return [*loads, *self.problem.notes, *(self.full.warnings if self.full else ())]

    @property
    def is_damped(self) -> bool:
        """Whether bending modes are complex: of dashpots or feedback."""
        return is_damped(self.beam.attachments, QUICK_FAMILY)

    @property
    def left_out(self) -> tuple[str, ...]:
        """What the model leaves out."""
        return not_modelled(self.beam, self.is_damped)


def wanted_modes(problem: Problem) -> int:
    """Return how many bending modes the page shows of a problem."""
    return min(problem.solve.modes, MOST_MODES)


def quick_answer(state: State) -> Answer:
    """Compute what changes while a slider moves: loads, bending modes to 1e-4.

    Raises
    ------
    AntinodeError
        If the input is wrong or nothing can be computed.
    """

    def compute() -> Answer:
        problem, beam = state.problem, state.beam
        return Answer(problem, beam, quick_modes(beam, wanted_modes(problem)))

    return kept(("quick", state.key), compute)


def full_answer(state: State) -> Answer:
    """Compute everything to the tolerance of the file, with brackets, counts and shifts.

    Raises
    ------
    AntinodeError
        If the input is wrong or nothing can be computed.
    """

    def compute() -> Answer:
        quick, solve = quick_answer(state), state.problem.solve
        result = solve_modes(quick.beam, solve.modes, tolerance=solve.tolerance, unloaded=True)
        return Answer(quick.problem, quick.beam, _exact(quick.quick, result), result)

    return kept(("full", state.key), compute)


def _exact(quick: Quick, result: ModalResult) -> Quick:
    """Put the certified omega^2 in place of the quick ones; the shapes are the same to the eye."""
    found = [m for m in result.family(QUICK_FAMILY) if m.number][: len(quick.omega2)]
    omega2 = np.array([m.omega2 for m in found])
    return quick._replace(omega2=omega2, error=np.array([m.error_omega2 for m in found]))


# --- what was computed lately -------------------------------------------------------------------

_MOST_KEPT = 400
_kept_results: OrderedDict[Any, Any] = OrderedDict()
_lock = threading.Lock()


def is_kept(key: Any) -> bool:
    """Tell whether a result is there without any work."""
    with _lock:
        return key in _kept_results


def kept(key: Any, compute: Callable[[], Result]) -> Result:
    """Return a result that was computed before, or compute it now."""
    with _lock:
        if key in _kept_results:
            _kept_results.move_to_end(key)
            found: Result = _kept_results[key]
            return found
    result = compute()
    with _lock:
        _kept_results[key] = result
        while len(_kept_results) > _MOST_KEPT:
            _kept_results.popitem(last=False)
    return result
