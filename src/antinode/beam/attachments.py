"""Point masses, springs, supports, joints, dashpots and feedback of a beam, node by node."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import numbers
from antinode.arrays import Array
from antinode.errors import InputError
from antinode.riccati.points import Point
from antinode.text import short

from .families import FAMILIES, Family, FamilyName
from .profile import ROUNDING

APART = 1e-8
"""Least distance of two supports over the length of the beam; nearer ones hold nothing between."""


class _Given:
    """What may be given as texts with units: ``PointMass(x="3 ft", mass="20 kg")``."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if type(value) is not float and type(value) is not int:
                object.__setattr__(self, name, _number(type(self), name, value))


@dataclass(frozen=True)
class PointMass(_Given):
    """A rigid mass fixed to the beam.

    Parameters
    ----------
    x : float
        Station [m].
    mass : float
        [kg], positive.
    rotary_inertia : float
        About its own centre, across the beam [kg m^2].
    offset : float
        Of its centre along +x from the station [m].
    polar_inertia : float
        About the axis of the beam [kg m^2].
    """

    x: float
    mass: float
    rotary_inertia: float = 0.0
    offset: float = 0.0
    polar_inertia: float = 0.0


@dataclass(frozen=True)
class Spring(_Given):
    """Springs between the beam and the ground; infinite ones are supports.

    Parameters
    ----------
    x : float
        Station [m].
    translational, axial : float
        [N/m], zero or positive; `math.inf` holds Y, or X, at zero.
    rotational, torsional : float
        [N m/rad]; `math.inf` holds the slope, or the rotation about the axis, at zero.
    coupling : float
        K_xtheta [N], of either sign: the lateral force of a unit slope, and the moment of a unit
        displacement; not beside an infinite stiffness.
    """

    x: float
    translational: float = 0.0
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0
    coupling: float = 0.0


@dataclass(frozen=True)
class Joint(_Given):
    """An elastic joint in line with the beam.

    Parameters
    ----------
    x : float
        Station inside the span [m].
    rotational : float
        Compliance [rad/(N m)]: slope on the right less slope on the left, over the moment.
    axial : float
        Compliance [m/N].
    torsional : float
        Compliance [rad/(N m)]: rotation on the right less that on the left, over the torque.
    """

    x: float
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0


@dataclass(frozen=True)
class Dashpot(_Given):
    """Dampers between the beam and the ground; undamped modes know nothing of them.

    Parameters
    ----------
    x : float
        Station [m].
    translational, axial : float
        Force over velocity [N s/m], zero or positive.
    rotational, torsional : float
        Moment over angular velocity [N m s/rad].
    """

    x: float
    translational: float = 0.0
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0


@dataclass(frozen=True)
class PointFeedback:
    """A force and a moment at a station that oppose the motion there: not of springs alone.

    With the displacement Y and the turn psi of the section, and their rates, the beam feels::

        force  = -(translational Y + force_of_turn psi)
                 - (translational_damping Y' + force_of_turn_rate psi')
        moment = -(moment_of_displacement Y + rotational psi)
                 - (moment_of_velocity Y' + rotational_damping psi')

    Where `force_of_turn` differs from `moment_of_displacement` no energy stands behind it, and it
    may drive the beam: linearised forces of a fluid, a control. Any number may have either sign.

    Parameters
    ----------
    x : float
        Station [m].
    translational, translational_damping : float
        [N/m], [N s/m].
    force_of_turn, moment_of_displacement : float
        [N] (per rad), [N m/m].
    force_of_turn_rate, moment_of_velocity : float
        [N s] (per rad), [N m s/m].
    rotational, rotational_damping : float
        [N m/rad], [N m s/rad].
    """

    x: float
    translational: float = 0.0
    force_of_turn: float = 0.0
    moment_of_displacement: float = 0.0
    rotational: float = 0.0
    translational_damping: float = 0.0
    force_of_turn_rate: float = 0.0
    moment_of_velocity: float = 0.0
    rotational_damping: float = 0.0

    @classmethod
    def of(
        cls, x: float, stiffness: npt.ArrayLike, damping: npt.ArrayLike = ((0, 0), (0, 0))
    ) -> PointFeedback:
        """Return it by its matrices: ``(force, moment) = -K (Y, psi) - C (Y', psi')``.

        Parameters
        ----------
        x : float
            Station [m].
        stiffness, damping : array_like, shape (2, 2)
            K [N/m, N; N, N m] and C [N s/m, N s; N s, N m s].
        """
        K, C = numbers("stiffness", stiffness), numbers("damping", damping)
        for name, matrix in (("stiffness", K), ("damping", C)):
            if matrix.shape != (2, 2):
                raise InputError(
                    f"the point feedback at x = {x:g} m: {name} has the shape {matrix.shape}; "
                    "(2, 2) is wanted: rows force and moment, columns Y and psi"
                )
        return cls(x, *K.ravel().tolist(), *C.ravel().tolist())

    @property
    def stiffness(self) -> Array:
        """K, shape (2, 2): rows force and moment, columns Y and psi."""
        rows = (self.translational, self.force_of_turn)
        return np.array([rows, (self.moment_of_displacement, self.rotational)])

    @property
    def damping(self) -> Array:
        """C, shape (2, 2)."""
        rows = (self.translational_damping, self.force_of_turn_rate)
        return np.array([rows, (self.moment_of_velocity, self.rotational_damping)])

    @property
    def gives_energy(self) -> bool:
        """Whether its damping gives energy to some motion."""
        (a, b), (c, d) = self.damping.tolist()
        return bool(a < 0 or d < 0 or 4 * a * d < (b + c) ** 2)


Attachment = PointMass | Spring | Joint | Dashpot | PointFeedback


def _number(kind: type, name: str, value: Any) -> Any:
    """Return a number in SI from what was given; what is none is left to `check_kinds`."""
    from antinode.inputs.given import in_si, written_unit

    unit = "m" if name == "x" else written_unit(_UNITS[kind][name])
    number = in_si(f"{name} of a {_NAMES[kind]}", value, unit)
    return float(number) if np.ndim(number) == 0 and np.isreal(number) else value


def beside_joints(items: Iterable[Attachment]) -> list[float]:
    """Return the stations of joints whose left side moves something that stands there [m]."""
    items = tuple(items)
    joints = [item for item in items if isinstance(item, Joint)]
    return sorted(
        {
            joint.x
            for joint in joints
            for item in items
            if item.x == joint.x and _moves_with_a_side(joint, item)
        }
    )


def _moves_with_a_side(joint: Joint, item: Attachment) -> bool:
    """Tell whether what a joint parts - turn, axial motion, twist - moves a mass or spring."""
    if isinstance(item, PointMass):
        turns, twists = item.offset != 0.0 or item.rotary_inertia > 0.0, item.polar_inertia > 0.0
        along = item.mass > 0.0
    elif isinstance(item, Spring | Dashpot):
        turns = item.rotational > 0.0 or (isinstance(item, Spring) and item.coupling != 0.0)
        twists, along = item.torsional > 0.0, item.axial > 0.0
    elif isinstance(item, PointFeedback):
        turns, twists, along = True, False, False
    else:
        return False
    parted = zip(
        (joint.rotational, joint.axial, joint.torsional), (turns, along, twists), strict=True
    )
    return any(compliance > 0.0 and moves for compliance, moves in parted)


def check_kinds(items: Iterable[object]) -> None:
    """Raise InputError unless every one of some things can be attached, with numbers in it."""
    for item in items:
        if not isinstance(item, Attachment):
            raise InputError(
                f"{short(item)} is nothing that a beam carries; give each PointMass, Spring, "
                "Joint, Dashpot or PointFeedback as an argument of its own"
            )
        for name, value in vars(item).items():
            if isinstance(value, str | bytes) or not np.isscalar(value):
                raise InputError(f"the {name_of(item)}: {name} is {short(value)}; give a number")


def is_damped(items: Iterable[Attachment], family: FamilyName) -> bool:
    """Tell whether a dashpot or a feedback acts in a family: its modes are complex then."""
    dashpots = [item for item in items if isinstance(item, Dashpot)]
    damped = any(getattr(item, name) for item in dashpots for name in FAMILIES[family].springs)
    return damped or feeds_back(items, family)


def feeds_back(items: Iterable[Attachment], family: FamilyName) -> bool:
    """Tell whether a feedback acts in a family: there are no undamped modes then."""
    return FAMILIES[family].rotary and any(isinstance(item, PointFeedback) for item in items)


def refuse_feedback(items: Iterable[Attachment], family: FamilyName, what: str) -> None:
    """Raise InputError if a feedback acts in a family, for something that counts on energies."""
    if feeds_back(items, family):
        raise InputError(
            f"a point feedback acts on the beam, and {what} know nothing of it; solve_modes, or "
            "the commands modes and beam, give complex modes with it; or remove the feedback"
        )


def on_beam(place: float, x: Array) -> float:
    """Return the end of the beam where a place misses it by rounding, else the place itself [m]."""
    for end in (float(x[0]), float(x[-1])):
        if abs(place - end) <= ROUNDING * max(abs(x[0]), abs(x[-1])):
            return end
    return place


def check_attachments(
    attachments: Sequence[Attachment], x: Array, *, softened: bool = False
) -> None:
    """Raise InputError unless every attachment has values that make sense and lies on the beam.

    Springs of a beam that its rotation softens may be negative.
    """
    signed = (*_SIGNED, "translational") if softened else _SIGNED
    for item in attachments:
        what = f"the {_NAMES[type(item)]} at x = {item.x:g} m"
        if not x[0] <= item.x <= x[-1]:
            raise InputError(f"{what} is off the beam, which runs from {x[0]:g} to {x[-1]:g} m")
        for name, value in vars(item).items():
            infinite = isinstance(item, Spring) and value == math.inf and name != "coupling"
            free = name in signed or isinstance(item, PointFeedback)
            if not (math.isfinite(value) or infinite) or (value < 0 and not free):
                least = "" if free else " and at least 0"
                raise InputError(f"{what}: {name} is {value:g}; it must be finite{least}")
        if isinstance(item, Spring) and item.coupling and math.inf in lateral(item):
            raise InputError(
                f"{what}: a coupling beside an infinite stiffness; give translational and "
                "rotational as finite numbers, or leave the coupling out"
            )
        if isinstance(item, Joint) and item.x in (x[0], x[-1]):
            raise InputError(f"{what} stands at an end; a joint needs beam on both sides")
    check_supports_apart(held_places(attachments), x)


def lateral(spring: Spring) -> tuple[float, float]:
    """Return the stiffness of a spring against displacement and slope."""
    return spring.translational, spring.rotational


def held_places(attachments: Iterable[Attachment]) -> list[float]:
    """Return where supports hold the beam sideways [m]."""
    springs = (item for item in attachments if isinstance(item, Spring))
    return [spring.x for spring in springs if spring.translational == math.inf]


def check_supports_apart(places: Iterable[float], x: Array) -> None:
    """Raise InputError if two places that hold the beam sideways all but coincide [m]."""
    length = float(x[-1] - x[0])
    for a, b in pairwise(sorted(set(places))):
        if b - a < APART * length:
            raise InputError(
                f"the supports at x = {a:.15g} m and x = {b:.15g} m are {b - a:.2g} m apart; they "
                f"must stand at one place, or at least {APART * length:.2g} m apart, {APART:g} of "
                "the beam's length: give both the same x, or remove one"
            )


def name_of(item: Attachment) -> str:
    """Return what an attachment is: a point mass, a spring, a support or a joint."""
    if isinstance(item, Spring) and math.inf in (getattr(item, name) for name in _UNITS[Spring]):
        return "support"
    return _NAMES[type(item)]


_UNITS: dict[type, dict[str, str]] = {
    PointMass: {"mass": "kg", "rotary_inertia": "kg_m2", "offset": "m", "polar_inertia": "kg_m2"},
    Spring: {
        "translational": "N_per_m",
        "rotational": "N_m_per_rad",
        "axial": "N_per_m",
        "torsional": "N_m_per_rad",
        "coupling": "N",
    },
    Joint: {"rotational": "rad_per_N_m", "axial": "m_per_N", "torsional": "rad_per_N_m"},
    Dashpot: {
        "translational": "N_s_per_m",
        "rotational": "N_m_s_per_rad",
        "axial": "N_s_per_m",
        "torsional": "N_m_s_per_rad",
    },
    PointFeedback: {
        "translational": "N_per_m",
        "force_of_turn": "N",
        "moment_of_displacement": "N",
        "rotational": "N_m_per_rad",
        "translational_damping": "N_s_per_m",
        "force_of_turn_rate": "N_s",
        "moment_of_velocity": "N_s",
        "rotational_damping": "N_m_s_per_rad",
    },
}


def attachment_dict(item: Attachment) -> dict[str, Any]:
    """Return an attachment as plain numbers for JSON, units in the keys.

    An infinite stiffness is null, and named under ``holds``.
    """
    values = {name: getattr(item, name) for name in _UNITS[type(item)]}
    plain = {
        f"{name}_{_UNITS[type(item)][name]}": None if value == math.inf else value
        for name, value in values.items()
    }
    held = [name for name, value in values.items() if value == math.inf]
    more = {"holds": held} if isinstance(item, Spring) else {}
    return {"kind": name_of(item), "x_m": item.x, **plain, **more}


_SIGNED = ("x", "offset", "coupling")
_NAMES = {
    PointMass: "point mass",
    Spring: "spring",
    Joint: "joint",
    Dashpot: "dashpot",
    PointFeedback: "point feedback",
}


def springs_hold(point: Point) -> tuple[float, tuple[int, ...]]:
    """Return which displacements a point holds, and how far from it: 0 but for a coupled spring.

    Springs [[k, k_c], [k_c, k_r]] of rank one hold no more than the displacement at k_c/k from
    their station: they are one spring on a rigid arm.
    """
    k, turning, coupling = point.spring, point.rotational_spring, point.coupling
    if coupling and abs(k * turning - coupling**2) <= ROUNDING * coupling**2:
        return coupling / k, (0,)
    springs = (k or coupling, turning or coupling)
    return 0.0, tuple({*point.holds, *(i for i, stiffness in enumerate(springs) if stiffness)})


def pushing_springs(point: Point) -> bool:
    """Tell whether the springs of a point can do work: K_xtheta^2 above K_x K_theta."""
    k, turning, coupling = point.spring, point.rotational_spring, point.coupling
    return k >= 0 and coupling**2 > max(k * turning, 0.0) + ROUNDING * coupling**2


def gather(
    attachments: Sequence[Attachment], x: Array, family: FamilyName, acceleration: float
) -> dict[int, Point]:
    """Add up what sits at each breakpoint, as the solver's points.

    Parameters
    ----------
    attachments : sequence of PointMass, Spring, Joint, Dashpot or PointFeedback
        At breakpoints.
    x : array
        Breakpoints [m].
    family : str
        A name of `FAMILIES`.
    acceleration : float
        By which a mass m adds m a to N [m/s^2], through its centre; 0 leaves that moment out.

    Returns
    -------
    dict
        Point by index of the breakpoint, in order.
    """
    at: dict[int, list[Attachment]] = {}
    for item in attachments:
        at.setdefault(int(np.argmin(np.abs(x - item.x))), []).append(item)
    points = {k: _point(k, at[k], FAMILIES[family], acceleration) for k in sorted(at)}
    return {k: p for k, p in points.items() if _does_something(p)}


def _does_something(p: Point) -> bool:
    return bool(p.loads or p.damps or p.holds or p.compliance or p.feeds_back)


def _point(k: int, items: list[Attachment], family: Family, acceleration: float) -> Point:
    springs = [item for item in items if isinstance(item, Spring)]
    joints = [item for item in items if isinstance(item, Joint)]
    dashpots = [item for item in items if isinstance(item, Dashpot)]
    drag = [sum(getattr(d, name) for d in dashpots) for name in family.springs]
    stiff = [sum(getattr(s, name) for s in springs) for name in family.springs]
    feedback = [item for item in items if isinstance(item, PointFeedback) and family.rotary]
    finite = [0.0 if math.isinf(stiffness) else stiffness for stiffness in stiff]
    return Point(
        k,
        **_mass([item for item in items if isinstance(item, PointMass)], family, acceleration),
        spring=finite[0],
        rotational_spring=finite[1] if family.rotary else 0.0,
        coupling=sum(s.coupling for s in springs) if family.rotary else 0.0,
        holds=tuple(i for i, stiffness in enumerate(stiff) if math.isinf(stiffness)),
        compliance=sum(getattr(j, family.joint) for j in joints),
        dashpot=drag[0],
        rotational_dashpot=drag[1] if family.rotary else 0.0,
        feedback=_matrix([item.stiffness for item in feedback]),
        feedback_damping=_matrix([item.damping for item in feedback]),
    )


def _matrix(matrices: list[Array]) -> tuple[float, float, float, float] | None:
    """Return the sum of matrices by rows, or None where it is nothing."""
    total = np.sum(matrices, axis=0) if matrices else np.zeros((2, 2))
    a, b, c, d = total.ravel().tolist()
    return (a, b, c, d) if total.any() else None


def _mass(masses: list[PointMass], family: Family, acceleration: float) -> dict[str, float]:
    """Return the masses of a node put together: about their common centre where they turn."""
    mass = sum(getattr(m, family.inertia) for m in masses)
    if not family.rotary:
        return {"mass": mass}
    offset = sum(m.mass * m.offset for m in masses) / mass if mass else 0.0
    inertia = sum(m.rotary_inertia + m.mass * (m.offset - offset) ** 2 for m in masses)
    return {
        "mass": mass,
        "offset": offset,
        "inertia": inertia,
        "own_load": acceleration * mass,
    }
