"""Buckling: the factor on the axial force at which the first supported mode starts to diverge.

With end forces of fixed direction a beam loses stability where an eigenvalue omega^2 passes through
zero, so the same counts that certify frequencies find and bracket the critical load: they are taken
at omega^2 = 0, as a function of the factor. Rigid motions are no buckling. A translation costs
nothing under any load, and is held at the left end. A free beam's rotation, which diverges under
any net compression, is left out; in net tension nothing diverges at first, and any mode that does
has buckled. Beside these the least eigenvalue is a concave function of the factor: what has
diverged stays so, and the count rises once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.beam.loads.turning import refuse_complex
from antinode.errors import ComputationError, InputError
from antinode.riccati.chain import Chain
from antinode.riccati.roots import Sample, narrow
from antinode.riccati.shapes import Energies, energies, split_for

from .backends import Backend, BackendName, choose, for_one
from .brackets import ROUNDING
from .loading import (
    Loading,
    greatest_in_shear,
    loaded_chain,
    loading,
    range_of_factors,
    zeros_of_force,
)
from .refinement import Refinement, layer_length, varying_segments
from .result import ModalResult
from .rigid import rigid_modes
from .solve import HasBeam, beam_of

_GROWTH = 4.0
_NEAR = 1e-3  # relative distance of the next chain's factor, mostly
_EVALUATIONS = 30  # of the chain that solved the modes, of one omega^2 each
_MOST_SEGMENTS = 200_000
WIDTH = 1e-11
"""Of a bracket, relative."""


@dataclass(frozen=True)
class Buckling:
    """The critical load of a beam.

    Attributes
    ----------
    load_factor : float
        Factor on the whole axial force at which the first supported mode diverges.
    bracket : tuple of float
        Load factors with no divergent supported mode, and with one, on the finest segment chain;
        it reaches to `load_factor` where that is extrapolated beyond it.
    error : float
        Bound on the distance to the load factor of the beam as given.
    """

    load_factor: float
    bracket: tuple[float, float]
    error: float

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "load_factor": self.load_factor,
            "bracket": list(self.bracket),
            "error": self.error,
        }


@out_of_range_is_an_error()
def buckling(
    problem: Beam | HasBeam, tolerance: float = 1e-6, *, backend: BackendName = "auto"
) -> Buckling | None:
    """Find the load factor at which the first supported bending mode diverges.

    Parameters
    ----------
    problem : Beam or case
        Under the axial force that is to be multiplied; a beam, or anything with a method
        ``beam()``.
    tolerance : float
        Largest relative error by what varies inside segments.
    backend : {"auto", "numpy", "numba"}
        What evaluates chains; "auto" is numba.

    Returns
    -------
    Buckling or None
        None where no factor buckles the beam: nothing in it is in compression, nor carries the
        weight of a mass above its support.

    Raises
    ------
    ComputationError
        If the tolerance is out of reach.
    """
    beam = beam_of(problem)
    if any(beam.following()):
        raise InputError(
            "the force of an end turns with it: counts of negative eigenvalues, which find the "
            "buckling load of fixed directions, do not hold then; set left_follower and "
            "right_follower to 0 for that load"
        )
    refuse_complex(beam, BENDING, "buckling loads")
    beam = beam.with_breakpoints(zeros_of_force(beam))
    solver, rigid = choose(backend), rigid_modes(beam, BENDING)
    factors = range_of_factors(beam)
    if factors is None:
        return None
    factors = factors[0], min(factors[1], greatest_in_shear(beam))
    varies = bool(np.any(beam.varies(BENDING)))
    levels, refinement, guess = Refinement(tolerance / 2, coarse=WIDTH), 1, None
    while True:
        load = loading(beam, refinement, "translation" in rigid)
        found = _critical(solver, load, int("rotation" in rigid), *factors, guess)
        if found is None and (not varies or refinement > 16):
            return None
        if found is not None:
            guess = found[2]
            loaded = load(guess)
            levels.add(np.array([guess]), layer_length(loaded, varying_segments(beam, loaded)))
            if not varies or levels.met(levels.error):
                error = float(levels.error[0]) if varies else 0.0
                return _buckling(solver, loaded, found, float(levels.better[0]), error)
        if 2 * len(load(1.0).length) > _MOST_SEGMENTS:
            raise ComputationError(
                f"the critical load did not converge to {tolerance:g} on {len(load(1.0).length)} "
                "segments; give the stations more smoothly, or ask for a larger tolerance"
            )
        refinement *= 2


def buckling_of(result: ModalResult) -> Buckling | None:
    """Find the factor for a beam that a command has solved: a small one by numpy, as its modes."""
    backend = for_one(result.segments[BENDING], _EVALUATIONS)
    return buckling(result.beam, result.tolerance, backend=backend)


def _buckling(
    solver: Backend, loaded: Chain, bracket: tuple[float, float, float], value: float, error: float
) -> Buckling:
    """Report a factor; the bracket is that of the chain, and reaches to the extrapolated value."""
    low, high, root = bracket
    half, rounding = max(high - root, root - low), value * rounding_of(solver, loaded)
    low, high = min(low, value), max(high, value)
    return Buckling(value, (low, high), error + half + rounding)


def rounding_of(solver: Backend, loaded: Chain) -> float:
    """Return the relative rounding of a critical factor: small against the energies that make it.

    The factor is the strain over the work of the forces, which may cancel in part.
    """
    zero, one = np.zeros(1), np.ones(1, dtype=np.int64)
    fine = split_for(loaded, zero)
    states = solver.mode_states(fine, zero, one)
    own: Energies = solver.mode_energies(fine, states, zero)
    strain = energies(loaded_chain(fine, 0.0), states, own.squares).stiffness
    return float(ROUNDING * own.size[0] / strain[0])


def statics(solver: Backend, load: Loading, factor: float) -> Sample:
    """Return how many eigenvalues are negative under a factor, and the determinant."""
    found = solver.evaluate(load(factor), [0.0])
    return int(found.below[0]), float(found.characteristic[0])


def _critical(
    solver: Backend, load: Loading, rotations: int, low: float, most: float, guess: float | None
) -> tuple[float, float, float] | None:
    """Bracket the load factor at which more eigenvalues are negative than rigid rotations."""
    count = partial(statics, solver, load)
    allowed = min(rotations, count(low)[0])
    while count(low)[0] > allowed:
        low /= 1e3
        if low == 0:
            raise ComputationError(
                "the beam diverges under any share of its axial force; check the unit of its forces"
            )
        allowed = min(rotations, count(low)[0])
    if guess is not None and count(guess * (1 - _NEAR))[0] <= allowed:
        low = guess * (1 - _NEAR)
    high = _beyond(count, allowed, low if guess is None else guess * (1 + _NEAR), most)
    return None if high is None else narrow(count, allowed, low, high, WIDTH)


def _beyond(
    count: Callable[[float], Sample], allowed: int, start: float, most: float
) -> float | None:
    """Return a factor under which more diverge than is allowed; None if there is none."""
    high = min(start, most)
    while count(high)[0] <= allowed:
        if high == most:
            return None
        high = min(_GROWTH * high, most)
    return high
