r"""Exact derivatives of critical loads: percent of the factor for each percent of an input.

At a critical factor p the eigenvalue is lambda = 0 (divergence), or two have met (flutter), so that
their right and left eigenvectors v, w have ``w^T M v = 0``. Either way, as p moves with an input a

    w^T (dK/da - lambda dM/da) v da + w^T dK/dp v dp = 0

and the derivative of lambda, which is none at a flutter, is not needed. All forces go with p, so
that with ``w^T (K - lambda M) v = 0`` the shares of stiffness, mass, foundation, springs and point
masses add up to 1.

In shear, with ``V = Q - N psi`` of either vector and flexibility s, ``w^T K v`` holds
``s V_w V_v``: its share is that of kGA in Haringx' form, where s = 1/kGA; in Engesser's,
s = 1/(kGA - N), it is ``(1 + N s)`` times as much, and the force's so much less.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Joint, refuse_feedback
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
from antinode.riccati.damped.slopes import Eigenpairs
from antinode.riccati.laws import Squares
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
        Of each interval between stations, all of it multiplied; added mass counts as mass.
    springs, point_masses : float
        Of all of them together, supports with a stiffness and joints that turn among the springs.
    shear_stiffness, rotary_inertia, foundation_stiffness : array, shape (intervals,)
        As of the bending stiffness; zero where there is none.
    """

    bending_stiffness: Array
    mass_per_length: Array
    springs: float
    point_masses: float
    shear_stiffness: Array
    rotary_inertia: Array
    foundation_stiffness: Array

    @property
    def columns(self) -> dict[str, Array]:
        """All that belongs to intervals, by name."""
        names = (
            "bending_stiffness",
            "mass_per_length",
            "shear_stiffness",
            "rotary_inertia",
            "foundation_stiffness",
        )
        return {name: getattr(self, name) for name in names}

    @property
    def total(self) -> float:
        """The sum of all, which is 1 but for rounding: a check."""
        parts = [float(np.sum(values)) for values in self.columns.values()]
        return sum(parts) + self.springs + self.point_masses

    def to_dict(self) -> dict[str, object]:
        """Return it as plain numbers for JSON."""
        return {
            **{name: float(np.sum(values)) for name, values in self.columns.items()},
            "springs": self.springs,
            "point_masses": self.point_masses,
            "by_interval": {name: values.tolist() for name, values in self.columns.items()},
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
        If the critical load is a rotation that diverges at once.
    ComputationError
        If a motion that rests hides the one that diverges.
    """
    beam = problem if isinstance(problem, Beam) else problem.beam()
    translates = _translates(beam, critical)
    refinement, before = _FIRST, None
    while True:
        chain = without_dashpots(loading(beam, refinement, translates)(critical.load_factor))
        found = _of_chain(beam, chain, critical.omega2)
        fine = not np.any(beam.varies(BENDING)) or 2 * len(chain.length) > _MOST_SEGMENTS
        if fine or (before is not None and _distance(before, found) < _SAME):
            return found
        refinement, before = 2 * refinement, found


def _translates(beam: Beam, critical: CriticalLoad) -> bool:
    """Tell whether a free translation rests beside a divergence; refuse what has no derivatives."""
    refuse_feedback(beam.attachments, BENDING, "derivatives of critical loads")
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
    return translates


@out_of_range_is_an_error()
def critical_slopes(
    beam: Beam, critical: CriticalLoad, sides: Sequence[tuple[Beam, Beam, float] | None]
) -> Array:
    """Return the derivatives of a critical factor by any numbers of a beam: exact, as above.

    Parameters
    ----------
    beam : Beam
    critical : CriticalLoad
        One of `stability` of it.
    sides : sequence of (Beam, Beam, float) or None
        By number: the beams a little below and above, and how far these values are apart.

    Returns
    -------
    array, shape (numbers,)
        NaN where there are no sides.

    Raises
    ------
    InputError
        If the critical load is a rotation that diverges at once.
    ComputationError
        If a motion that rests hides the one that diverges, or a joint turns.
    """
    translates, p = _translates(beam, critical), critical.load_factor
    if any(isinstance(item, Joint) for item in beam.attachments):
        raise ComputationError(
            "joints turn between the parts of the beam: derivatives of critical loads by inputs "
            "are not told; vary the input (--along)"
        )
    refinement, before = _FIRST, None
    while True:

        def loaded(of: Beam, factor: float, refinement: int = refinement) -> Chain:
            return without_dashpots(loading(of, refinement, translates)(factor))

        chain = loaded(beam, p)
        pairs = Eigenpairs(Damped(chain), np.array([np.sqrt(complex(-critical.omega2))]))
        h = _FACTOR_STEP * p
        along = pairs.change(loaded(beam, p - h), loaded(beam, p + h)) / (2 * h)
        found = np.full(len(sides), np.nan)
        for k, side in enumerate(sides):
            if side is not None:
                low, high, step = side
                change = pairs.change(loaded(low, p), loaded(high, p)) / step
                found[k] = float((-change / along).real[0])
        fine = not np.any(beam.varies(BENDING)) or 2 * len(chain.length) > _MOST_SEGMENTS
        if fine or (before is not None and np.allclose(before, found, rtol=_NEAR, equal_nan=True)):
            return found
        refinement, before = 2 * refinement, found


_FACTOR_STEP = 1e-6
_NEAR = 1e-6


def _distance(a: Influence, b: Influence) -> float:
    pairs = zip(a.columns.values(), b.columns.values(), strict=True)
    return max(float(np.max(np.abs(one - other))) for one, other in pairs)


def _of_chain(beam: Beam, chain: Chain, omega2: float) -> Influence:
    """Return the shares on one chain under the critical force."""
    fine = split_for(chain, np.array([abs(omega2)]))
    damped, s = Damped(fine), np.array([np.sqrt(complex(-omega2))])
    right, left = complex_states(damped, s), complex_states(damped.transposed, s)
    forms = products(damped, fine, s, right, left)
    strain = _strain(beam, fine, forms.squares)
    inertia_of = {
        "mass_per_length": fine.mass * forms.squares.displacement[:, 0],
        "rotary_inertia": fine.columns.get("rotary_inertia", 0.0) * forms.squares.turn[:, 0],
    }
    shares = strain | {name: -omega2 * values for name, values in inertia_of.items()}
    springs, masses = 0j, 0j
    for point in damped.base.points:
        inertia, elastic, _ = point_forms(fine, replace(point, own_load=0.0), right, left)
        springs, masses = springs + elastic[0], masses - omega2 * inertia[0]
    forces = forms.stiffness[0] - sum(np.sum(values) for values in strain.values()) - springs
    owner = np.searchsorted(beam.x, beam.x[0] + (fine.nodes[1:] + fine.nodes[:-1]) / 2) - 1

    def by_interval(values: Array) -> Array:
        own = (-values / forces).real
        return np.asarray(np.bincount(owner, own, minlength=len(beam.x) - 1), dtype=float)

    return Influence(
        springs=float((-springs / forces).real),
        point_masses=float((-masses / forces).real),
        **{name: by_interval(values) for name, values in shares.items()},
    )


def _strain(beam: Beam, chain: Chain, squares: Squares) -> dict[str, Array]:
    """Return the shares of w^T K v of each segment that do not move with the force, by column."""
    columns = chain.columns
    soft = np.asarray(columns.get("shear", np.zeros(len(chain.length))))
    if beam.has_shear and beam.shear_form == "engesser":
        soft = soft * (1 + chain.axial_force * soft)
    return {
        "bending_stiffness": squares.moment[:, 0] / chain.stiffness,
        "shear_stiffness": soft * squares.shear[:, 0],
        "foundation_stiffness": columns.get("foundation", 0.0) * squares.displacement[:, 0],
    }


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
