"""What a beam carries, checked and gathered node by node."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.riccati.points import Pedestal as PedestalPoint
from antinode.riccati.points import Point
from antinode.text import short

from .carried.kinds import (
    Attachment,
    Dashpot,
    Joint,
    Pedestal,
    PointFeedback,
    PointMass,
    Spring,
    attachment_dict,
    name_of,
    name_of_kind,
)
from .families import FAMILIES, Family, FamilyName
from .profile import ROUNDING

__all__ = [
    "APART",
    "Attachment",
    "Dashpot",
    "Joint",
    "Pedestal",
    "PointFeedback",
    "PointMass",
    "Spring",
    "attachment_dict",
    "beside_joints",
    "check_attachments",
    "check_kinds",
    "check_pedestals",
    "check_supports_apart",
    "feeds_back",
    "gather",
    "held_places",
    "is_damped",
    "lateral",
    "name_of",
    "on_beam",
    "pushing_springs",
    "refuse_feedback",
    "refuse_pedestals",
    "springs_hold",
]

APART = 1e-8
"""Least distance of two supports over the length of the beam; nearer ones hold nothing between."""


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
                "Pedestal, Joint, Dashpot or PointFeedback as an argument of its own"
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


def refuse_pedestals(items: Iterable[Attachment], what: str) -> None:
    """Raise InputError if a pedestal stands on a beam, for something that does not know it yet."""
    for item in items:
        if isinstance(item, Pedestal):
            raise InputError(
                f"the pedestal at x = {item.x:g} m: {what} know nothing of a mass between two "
                "springs as yet; take it out there, or ask for modes, frequencies or buckling"
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
        what = f"the {name_of_kind(type(item))} at x = {item.x:g} m"
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
    check_pedestals(attachments, held_places(attachments))


def check_pedestals(attachments: Sequence[Attachment], held: Sequence[float]) -> None:
    """Raise InputError unless pedestals have a mass and a spring, and places that can move.

    Parameters
    ----------
    attachments : sequence
    held : sequence of float
        Where the beam is held sideways [m].
    """
    places: set[float] = set()
    for item in attachments:
        if not isinstance(item, Pedestal):
            continue
        what = f"the pedestal at x = {item.x:g} m"
        for name in ("mass", "beam_stiffness"):
            if getattr(item, name) == 0:
                raise InputError(f"{what}: {name} is 0; it must be positive")
        if item.x in places:
            raise InputError(f"{what} stands where another does; a station takes one pedestal")
        if item.x in held:
            raise InputError(
                f"{what} stands where the beam is held sideways, and does nothing to it: "
                "remove it, or move it to where the beam moves"
            )
        places.add(item.x)


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


_SIGNED = ("x", "offset", "coupling")


def springs_hold(point: Point) -> tuple[float, tuple[int, ...]]:
    """Return which displacements a point holds, and how far from it: 0 but for a coupled spring.

    Springs [[k, k_c], [k_c, k_r]] of rank one hold no more than the displacement at k_c/k from
    their station: they are one spring on a rigid arm.
    """
    k, turning, coupling = point.static_spring, point.rotational_spring, point.coupling
    if coupling and abs(k * turning - coupling**2) <= ROUNDING * coupling**2:
        return coupling / k, (0,)
    springs = (k or coupling, turning or coupling)
    return 0.0, tuple({*point.holds, *(i for i, stiffness in enumerate(springs) if stiffness)})


def pushing_springs(point: Point) -> bool:
    """Tell whether the springs of a point can do work: K_xtheta^2 above K_x K_theta."""
    k, turning, coupling = point.static_spring, point.rotational_spring, point.coupling
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
        pedestal=_pedestal(items, family),
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


def _pedestal(items: list[Attachment], family: Family) -> PedestalPoint | None:
    """Return the pedestal of a node; it moves sideways alone."""
    own = next((item for item in items if isinstance(item, Pedestal)), None)
    if own is None or not family.rotary:
        return None
    return PedestalPoint(own.mass, own.beam_stiffness, own.ground_stiffness)


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
