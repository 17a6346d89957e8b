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
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from antinode.beam.attachments import refuse_feedback
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import ComputationError, InputError
from antinode.riccati.bracket import Sample, narrow
from antinode.riccati.chain import Chain
from antinode.riccati.shapes import Energies, energies, split_for

from .backends import Backend, BackendName, choose, for_one
from .brackets import ROUNDING
from .refinement import Refinement, layer_length, varying_segments
from .result import ModalResult
from .rigid import rigid_modes

_GROWTH = 4.0
_LARGEST = 1e9  # times the force that the shortest compressed part would bear by itself
_NO_FORCE = 1e-12  # share of the largest |N| below which compression is rounding
_TRACE = 1e-9  # share of the stiffness in shear that must be left
_WIDTH = 1e-11  # of the bracket, relative
_NEAR = 1e-3  # relative distance of the next chain's factor, mostly
_EVALUATIONS = 30  # of the chain that solved the modes, of one omega^2 each
_MOST_SEGMENTS = 200_000


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
    beam: Beam, tolerance: float = 1e-6, *, backend: BackendName = "auto"
) -> Buckling | None:
    """Find the load factor at which the first supported bending mode diverges.

    Parameters
    ----------
    beam : Beam
        Under the axial force that is to be multiplied.
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
    if any(beam.following()):
        raise InputError(
            "the force of an end turns with it: counts of negative eigenvalues, which find the "
            "buckling load of fixed directions, do not hold then; set left_follower and "
            "right_follower to 0 for that load"
        )
    refuse_feedback(beam.attachments, BENDING, "buckling loads")
    beam = beam.with_breakpoints(_zeros_of_force(beam))
    solver, rigid = choose(backend), rigid_modes(beam, BENDING)
    factors = _range_of_factors(beam)
    if factors is None:
        return None
    factors = factors[0], min(factors[1], _sheared(beam))
    varies = bool(np.any(beam.varies(BENDING)))
    levels, refinement, guess = Refinement(tolerance / 2, coarse=_WIDTH), 1, None
    while True:
        load = _loading(beam, refinement, "translation" in rigid)
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
    half, rounding = max(high - root, root - low), value * _rounding(solver, loaded)
    low, high = min(low, value), max(high, value)
    return Buckling(value, (low, high), error + half + rounding)


def _rounding(solver: Backend, loaded: Chain) -> float:
    """Return the relative rounding of a critical factor: small against the energies that make it.

    The factor is the strain over the work of the forces, which may cancel in part.
    """
    zero, one = np.zeros(1), np.ones(1, dtype=np.int64)
    fine = split_for(loaded, zero)
    states = solver.mode_states(fine, zero, one)
    own: Energies = solver.mode_energies(fine, states, zero)
    strain = energies(_loaded(fine, 0.0), states, own.squares).stiffness
    return float(ROUNDING * own.size[0] / strain[0])


def _zeros_of_force(beam: Beam) -> list[float]:
    """Return where the tabulated axial force changes its sign inside intervals [m].

    Under an acceleration the force is no straight line, nor where it is a polynomial: a grid then.
    """
    k = np.arange(len(beam.x) - 1)
    straight = beam.axial_acceleration == 0.0 and beam.axial_force.shape[1] == 2
    t = np.linspace(0.0, 1.0, 2 if straight else 33)
    N = np.stack([beam.axial_force_at(k, np.full(len(k), share)) for share in t], axis=1)
    interval, i = np.nonzero(N[:, :-1] * N[:, 1:] < 0)
    a, b = N[interval, i], N[interval, i + 1]
    share = t[i] + (t[i + 1] - t[i]) * a / (a - b)
    return list((beam.x[interval] + share * np.diff(beam.x)[interval]).tolist())


def _range_of_factors(beam: Beam) -> tuple[float, float] | None:
    """Return a factor below most that buckle, and one above all; None if nothing can.

    N/EI of the most compressed place makes the scale, and the arm of a mass whose own weight turns
    it over, against the stiffness of the softest place.
    """
    k = np.arange(len(beam.x) - 1)
    N = np.stack([beam.axial_force_at(k, np.full(len(k), t)) for t in np.linspace(0, 1, 33)])
    compressed = _NO_FORCE * np.max(np.abs(N)) < N
    _, _, points = beam.points(BENDING)
    turning = max((-p.own_load * p.offset for p in points), default=0.0)
    if not np.any(compressed) and turning <= 0:
        return None
    soft = np.min(beam.bending_stiffness, axis=1)
    scales, shortest = [], beam.length
    if np.any(compressed):
        largest = float(np.max(np.where(compressed, N, 0.0) / soft))
        shortest = float(np.min(np.diff(beam.x)[np.any(compressed, axis=0)]))
        scales.append(1 / (largest * beam.length**2))
    if turning > 0:
        scales.append(float(np.min(soft)) / (turning * beam.length))
    low, most = 1e-3 * min(scales), _LARGEST * max(scales) * (beam.length / shortest) ** 2
    if not (low > 0 and most < np.inf):
        raise OverflowError("the axial force is out of proportion to the bending stiffness")
    return low, most


def _held(chain: Chain, translates: bool) -> Chain:
    """Return the chain with Y held at its left end if nothing else holds it."""
    return replace(chain, left=chain.law.end_holding(chain.left, (0,))) if translates else chain


Loading = Callable[[float], Chain]
"""Of a beam: its chain under a factor times its axial force."""


def _loading(beam: Beam, refinement: int, translates: bool) -> Loading:
    """Return the chains of a beam; in Engesser's form the flexibility in shear depends on N too."""
    if beam.has_shear and beam.shear_form == "engesser":
        return lambda factor: _held(_under(beam, factor).chain(BENDING, refinement), translates)
    chain = _held(beam.chain(BENDING, refinement), translates)
    return lambda factor: _loaded(chain, factor)


def _under(beam: Beam, factor: float) -> Beam:
    """Return a beam under a factor times its axial force."""
    N, a = factor * beam.axial_force, factor * beam.axial_acceleration
    return replace(beam, axial_force=N, axial_acceleration=a)


def _loaded(chain: Chain, factor: float) -> Chain:
    """Return the chain under `factor` times its axial force."""
    powers = {"axial_force": factor, "shear_turn": factor, "shear_work": factor * factor}
    shared = powers.keys() & chain.columns.keys()
    columns = {name: powers[name] * chain.columns[name] for name in shared}
    points = tuple(replace(p, own_load=factor * p.own_load) for p in chain.points)
    return replace(chain.with_columns(**columns), points=points)


def _sheared(beam: Beam) -> float:
    """Return the factor at which the stiffness in shear is used up somewhere, less a trace."""
    if not beam.has_shear:
        return np.inf
    k = np.arange(len(beam.x) - 1)[:, None]
    t = np.linspace(0.0, 1.0, 33)
    sign = 1.0 if beam.shear_form == "engesser" else -1.0
    share = sign * beam.axial_force_at(k, t) / beam.column_at("shear_stiffness", k, t)
    return (1 - _TRACE) / float(np.max(share)) if np.any(share > 0) else np.inf


def _statics(solver: Backend, load: Loading, factor: float) -> Sample:
    """Return how many eigenvalues are negative under a factor, and the determinant."""
    found = solver.evaluate(load(factor), [0.0])
    return int(found.below[0]), float(found.characteristic[0])


def _critical(
    solver: Backend, load: Loading, rotations: int, low: float, most: float, guess: float | None
) -> tuple[float, float, float] | None:
    """Bracket the load factor at which more eigenvalues are negative than rigid rotations."""
    statics = partial(_statics, solver, load)
    allowed = min(rotations, statics(low)[0])
    while statics(low)[0] > allowed:
        low /= 1e3
        if low == 0:
            raise ComputationError(
                "the beam diverges under any share of its axial force; check the unit of its forces"
            )
        allowed = min(rotations, statics(low)[0])
    if guess is not None and statics(guess * (1 - _NEAR))[0] <= allowed:
        low = guess * (1 - _NEAR)
    high = _beyond(statics, allowed, low if guess is None else guess * (1 + _NEAR), most)
    return None if high is None else narrow(statics, allowed, low, high, _WIDTH)


def _beyond(
    statics: Callable[[float], Sample], allowed: int, start: float, most: float
) -> float | None:
    """Return a factor under which more diverge than is allowed; None if there is none."""
    high = min(start, most)
    while statics(high)[0] <= allowed:
        if high == most:
            return None
        high = min(_GROWTH * high, most)
    return high
