"""Buckling: the factor on the axial force at which the first supported mode starts to diverge.

With end forces of fixed direction a beam loses stability where an eigenvalue omega^2 passes through
zero, so the same counts that certify frequencies find and bracket the critical load. Rigid motions
are no buckling: a free beam's rotation, which diverges under any net compression, is left out. In
net tension nothing diverges at first, and any mode that does has buckled.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import ComputationError
from antinode.riccati.chain import Chain, count_below, omega2_scale

from .rigid import rigid_modes

_GROWTH = 1.15
_LARGEST = 1e9  # factor on the force of the shortest clamped interval, beyond which none buckles


@dataclass(frozen=True)
class Buckling:
    """The critical load of a beam.

    Attributes
    ----------
    load_factor : float
        Factor on the whole axial force at which the first supported mode diverges.
    bracket : tuple of float
        Load factors with no divergent supported mode, and with one, on the segment chain.
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
def buckling(beam: Beam, tolerance: float = 1e-6) -> Buckling | None:
    """Find the load factor at which the first supported bending mode diverges.

    Parameters
    ----------
    beam : Beam
        Under the axial force that is to be multiplied.
    tolerance : float
        Largest relative error by what varies inside segments.

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
    rotations = int("rotation" in rigid_modes(beam, BENDING))
    refinement = 1
    found = _critical(beam.chain(BENDING, refinement), rotations)
    if found is None or not np.any(beam.varies(BENDING)):
        return None if found is None else _buckling(found, 0.0)
    while refinement < 256:
        refinement *= 2
        coarse, found = found, _critical(beam.chain(BENDING, refinement), rotations)
        if found is None:
            break
        error = abs(sum(found) - sum(coarse)) / 2 / 8
        if error <= tolerance * found[0]:
            return _buckling(found, error)
    raise ComputationError("the critical load did not converge; give the stations more smoothly")


def _buckling(bracket: tuple[float, float], error: float) -> Buckling:
    low, high = float(bracket[0]), float(bracket[1])
    return Buckling((low + high) / 2, (low, high), float(error) + (high - low) / 2)


def _critical(chain: Chain, rotations: int) -> tuple[float, float] | None:
    """Bracket the load factor at which more eigenvalues are negative than rigid rotations."""
    low, most = _range_of_factors(chain)
    if not low < np.inf:
        return None
    allowed = min(rotations, _diverge(chain, low))
    while _diverge(chain, low) > allowed:
        low /= 1e3
        if low == 0:
            raise ComputationError(
                "the beam diverges under any share of its axial force; check the unit of its forces"
            )
        allowed = min(rotations, _diverge(chain, low))
    high = low * _GROWTH
    while _diverge(chain, high) <= allowed:
        low, high = high, high * _GROWTH
        if high > most:
            return None
    while high - low > 1e-11 * high:
        middle = (low + high) / 2
        low, high = (low, middle) if _diverge(chain, middle) > allowed else (middle, high)
    return low, high


def _range_of_factors(chain: Chain) -> tuple[float, float]:
    """Return a factor below all that buckle, and one above; infinite if nothing can.

    N/EI of the most compressed segment makes the scale, and the arm of a mass whose own weight
    turns it over, against the stiffness of the softest segment.
    """
    L = float(chain.nodes[-1])
    largest = float(np.max(chain.axial_force / chain.stiffness))
    turning = max((-p.own_load * p.offset for p in chain.points), default=0.0)
    if largest <= 0 and turning <= 0:
        return np.inf, np.inf
    low = np.inf if largest <= 0 else 1e-3 / (largest * L**2)
    most = 0.0 if largest <= 0 else _LARGEST / (largest * float(np.min(chain.length)) ** 2)
    if turning > 0:
        low = min(low, 1e-3 * float(np.min(chain.stiffness)) / (turning * L))
        stiffest = float(np.max(chain.stiffness)) / float(np.min(chain.length))
        most = max(most, _LARGEST * stiffest / turning)
    if not (np.isfinite(low) and np.isfinite(most) and low > 0):
        raise OverflowError("the axial force is out of proportion to the bending stiffness")
    return low, most


def _diverge(chain: Chain, factor: float) -> int:
    """Return how many eigenvalues are negative under `factor` times the axial force."""
    points = tuple(replace(p, own_load=factor * p.own_load) for p in chain.points)
    loaded = replace(chain.with_columns(axial_force=factor * chain.axial_force), points=points)
    return int(count_below(loaded, [-1e-13 * omega2_scale(chain)])[0])
