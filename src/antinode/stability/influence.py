r"""Exact derivatives of critical loads: percent of the factor for each percent of an input.

At a critical factor p the eigenvalue is lambda = 0 (divergence), or two have met (flutter), so that
their right and left eigenvectors v, w have ``w^T M v = 0``. Either way, as p moves with an input a

    w^T (dK/da - lambda dM/da) v da + w^T dK/dp v dp = 0

and the derivative of lambda, which is none at a flutter, is not needed. All forces go with p, so
that with ``w^T (K - lambda M) v = 0`` the shares of bending stiffness, mass, springs and point
masses add up to 1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import refuse_feedback
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import AntinodeError, ComputationError, InputError
from antinode.modes.damped.family import without_dashpots
from antinode.modes.loading import loading
from antinode.modes.rigid import rigid_modes
from antinode.modes.solve import HasBeam
from antinode.riccati.chain import Chain
from antinode.riccati.damped.chain import Damped
from antinode.riccati.damped.energies import point_forms, products
from antinode.riccati.damped.shapes import complex_states
from antinode.riccati.shapes import split_for

from .result import CriticalLoad

_FIRST = 4
_MOST_SEGMENTS = 5_000
_SAME = 1e-8


@dataclass(frozen=True)
class Influence:
    """What moves a critical factor, in percent for each percent.

    Attributes
    ----------
    bending_stiffness, mass_per_length : array, shape (intervals,)
        Of each interval between stations, all of it multiplied.
    springs, point_masses : float
        Of all of them together, supports with a stiffness and joints that turn among the springs.
    """

    bending_stiffness: Array
    mass_per_length: Array
    springs: float
    point_masses: float

    @property
    def total(self) -> float:
        """The sum of all, which is 1 but for rounding: a check."""
        parts = np.sum(self.bending_stiffness), np.sum(self.mass_per_length)
        return float(sum(parts)) + self.springs + self.point_masses

    def to_dict(self) -> dict[str, object]:
        """Return it as plain numbers for JSON."""
        return {
            "bending_stiffness": float(np.sum(self.bending_stiffness)),
            "mass_per_length": float(np.sum(self.mass_per_length)),
            "springs": self.springs,
            "point_masses": self.point_masses,
            "by_interval": {
                "bending_stiffness": self.bending_stiffness.tolist(),
                "mass_per_length": self.mass_per_length.tolist(),
            },
        }


@out_of_range_is_an_error()
def critical_influence(problem: Beam | HasBeam, critical: CriticalLoad) -> Influence:
    """Return what moves a critical factor: exact derivatives, by left and right eigenvectors.

    Parameters
    ----------
    problem : Beam or case
    critical : CriticalLoad
        One of `stability` of the same beam.

    Raises
    ------
    InputError
        If the beam has shear, rotary inertia or a foundation, or the critical load is a rotation
        that diverges at once.
    ComputationError
        If a motion that rests hides the one that diverges.
    """
    beam = problem if isinstance(problem, Beam) else problem.beam()
    refuse_feedback(beam.attachments, BENDING, "derivatives of critical loads")
    if not beam.chain(BENDING).is_plain and not beam.loads_turn:
        raise InputError(
            f"{beam.name}: derivatives of critical loads are those of Euler-Bernoulli's theory "
            'without a foundation; set theory = "euler_bernoulli", or vary the input (--along)'
        )
    if critical.load_factor == 0.0:
        raise InputError(
            "a rotation that diverges at once has no factor whose derivatives could be told"
        )
    rigid = rigid_modes(beam, BENDING)
    translates = critical.kind == "divergence" and "translation" in rigid
    if translates and any(beam.following()):
        raise ComputationError(
            "a free translation rests beside the motion that diverges: its derivatives are not "
            "told; vary the input (--along)"
        )
    refinement, before = _FIRST, None
    while True:
        chain = without_dashpots(loading(beam, refinement, translates)(critical.load_factor))
        found = _of_chain(beam, chain, critical.omega2)
        fine = not np.any(beam.varies(BENDING)) or 2 * len(chain.length) > _MOST_SEGMENTS
        if fine or (before is not None and _distance(before, found) < _SAME):
            return found
        refinement, before = 2 * refinement, found


def _distance(a: Influence, b: Influence) -> float:
    pairs = (
        (a.bending_stiffness, b.bending_stiffness),
        (a.mass_per_length, b.mass_per_length),
    )
    return max(float(np.max(np.abs(one - other))) for one, other in pairs)


def _of_chain(beam: Beam, chain: Chain, omega2: float) -> Influence:
    """Return the shares on one chain under the critical force."""
    fine = split_for(chain, np.array([abs(omega2)]))
    damped, s = Damped(fine), np.array([np.sqrt(complex(-omega2))])
    right, left = complex_states(damped, s), complex_states(damped.transposed, s)
    forms = products(damped, fine, s, right, left)
    strain = forms.squares.moment[:, 0] / fine.stiffness
    mass = -omega2 * fine.mass * forms.squares.displacement[:, 0]
    springs, masses = 0j, 0j
    for point in damped.base.points:
        inertia, elastic, _ = point_forms(fine, replace(point, own_load=0.0), right, left)
        springs, masses = springs + elastic[0], masses - omega2 * inertia[0]
    forces = forms.stiffness[0] - np.sum(strain) - springs
    owner = np.searchsorted(beam.x, beam.x[0] + (fine.nodes[1:] + fine.nodes[:-1]) / 2) - 1

    def by_interval(values: Array) -> Array:
        shares = (-values / forces).real
        return np.asarray(np.bincount(owner, shares, minlength=len(beam.x) - 1), dtype=float)

    return Influence(
        by_interval(strain),
        by_interval(mass),
        float((-springs / forces).real),
        float((-masses / forces).real),
    )


def influences(beam: Beam, critical: tuple[CriticalLoad, ...]) -> list[Influence | None]:
    """Return what moves each critical load of a beam; None where that is not told.

    Raises
    ------
    InputError
        If it is told of none of them.
    """
    found: list[Influence | None] = []
    reason: AntinodeError | None = None
    for each in critical:
        try:
            found.append(critical_influence(beam, each))
        except AntinodeError as error:
            found.append(None)
            reason = error
    if reason is not None and not any(found):
        raise reason
    return found
