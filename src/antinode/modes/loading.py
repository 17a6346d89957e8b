"""A beam under a factor times all of its axial force: its chains, and how large the factor may be.

What multiplies is N everywhere, the forces at the ends, the share of these that turns with them,
and the weight of masses off their stations. Stiffness, mass and springs stay.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.riccati.chain import Chain

_LARGEST = 1e9  # times the force that the shortest compressed part would bear by itself
_NO_FORCE = 1e-12  # share of the largest |N| below which compression is rounding
_TRACE = 1e-9  # share of the stiffness in shear that must be left


def zeros_of_force(beam: Beam) -> list[float]:
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


def range_of_factors(beam: Beam) -> tuple[float, float] | None:
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


def held_chain(chain: Chain, translates: bool) -> Chain:
    """Return the chain with Y held at its left end if nothing else holds it."""
    return replace(chain, left=chain.law.end_holding(chain.left, (0,))) if translates else chain


Loading = Callable[[float], Chain]
"""Of a beam: its chain under a factor times its axial force."""


def loading(beam: Beam, refinement: int, translates: bool) -> Loading:
    """Return the chains of a beam; in Engesser's form the flexibility in shear depends on N too."""
    if beam.has_shear and beam.shear_form == "engesser":
        return lambda factor: held_chain(under(beam, factor).chain(BENDING, refinement), translates)
    chain = held_chain(beam.chain(BENDING, refinement), translates)
    return lambda factor: loaded_chain(chain, factor)


def under(beam: Beam, factor: float) -> Beam:
    """Return a beam under a factor times its axial force."""
    N, a, ends = factor * beam.axial_force, factor * beam.axial_acceleration, beam.end_force
    outside = None if ends is None else (factor * ends[0], factor * ends[1])
    load = None if beam.tangential_load is None else factor * beam.tangential_load
    return replace(
        beam, axial_force=N, axial_acceleration=a, end_force=outside, tangential_load=load
    )


def loaded_chain(chain: Chain, factor: float) -> Chain:
    """Return the chain under `factor` times its axial force."""
    powers = dict.fromkeys(("axial_force", "shear_turn", "tangential"), factor)
    powers["shear_work"] = factor * factor
    shared = powers.keys() & chain.columns.keys()
    columns = {name: powers[name] * chain.columns[name] for name in shared}
    points = tuple(replace(p, own_load=factor * p.own_load) for p in chain.points)
    left, right = chain.following
    ends = (factor * left, factor * right)
    return replace(chain.with_columns(**columns), points=points, following=ends)


def greatest_in_shear(beam: Beam) -> float:
    """Return the factor at which the stiffness in shear is used up somewhere, less a trace."""
    if not beam.has_shear:
        return np.inf
    k = np.arange(len(beam.x) - 1)[:, None]
    t = np.linspace(0.0, 1.0, 33)
    sign = 1.0 if beam.shear_form == "engesser" else -1.0
    share = sign * beam.axial_force_at(k, t) / beam.column_at("shear_stiffness", k, t)
    return (1 - _TRACE) / float(np.max(share)) if np.any(share > 0) else np.inf
