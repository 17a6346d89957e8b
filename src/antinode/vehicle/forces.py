"""The forces on many bodies in motion but the thrust: cavitator, fins, planing, extra drag.

Numbers are arrays over cases (cases,).

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 1-17; eq. 21 for the drag ahead of a place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from antinode.arrays import Array, at_station

from .hydrodynamics import cavitator, fins
from .hydrodynamics.cavitation_number import Cavitation, Stream, cavitation
from .hydrodynamics.cavity import Cavity, form_cavity
from .hydrodynamics.planing import Planing, planing_state
from .numbers import ManyCases
from .refusals import EXTRA_DRAG, FINS, Refusals

T = TypeVar("T")


class ForceOnBody(NamedTuple, Generic[T]):
    """A force at one station: floats, or arrays over cases.

    Attributes
    ----------
    name : str
        Where it comes from.
    x : float or array
        Where it acts [m].
    F_X, F_Y : float or array
        Drag, positive aft, and lift, positive up [N].
    """

    name: str
    x: T
    F_X: T
    F_Y: T


class FinLoads(NamedTuple):
    """The forces of one set of fins in many cases.

    Attributes
    ----------
    position : array (cases,)
        x of the set [m].
    immersion, incidence : array (fins, cases)
        Of each fin: length outside the cavity [m], angle to the flow [rad].
    F_fX, F_fY : array (cases,)
        Drag, positive aft, and lift, positive up [N].
    """

    position: Array
    immersion: Array
    incidence: Array
    F_fX: Array
    F_fY: Array


class Hydrodynamics(NamedTuple):
    """The cavities and what acts on the bodies; forces begin with the cavitator's."""

    state: Cavitation[Array]
    cavity: Cavity
    fins: tuple[FinLoads, ...]
    planing: Planing
    forces: tuple[ForceOnBody[Array], ...]


def hydrodynamics(cases: ManyCases, refusals: Refusals) -> Hydrodynamics:
    """Work out cavities and forces, eq. 1-17; cases that cannot be are refused."""
    rho, V = cases.number("water", "density"), cases.number("condition", "speed")
    state = cavitation(_stream(cases), refusals)
    hole = _cavity(cases, V, np.where(refusals.none, state.sigma, 0.5))
    disk = cavitator.cavitator_forces(rho, V, hole.sigma, hole.D_n, hole.alpha)
    sets = tuple(_fin_set(cases, k, hole, refusals) for k in range(len(cases.vehicle.fins)))
    mu = cases.number("water", "dynamic_viscosity")
    tail = planing_state(hole, cases.vehicle.radius_profile, rho, V, mu)
    forces = [
        ForceOnBody("cavitator", np.zeros(cases.cases), *disk),
        *(_at_station(cases, f"fin set {k}", *_acting(fin)) for k, fin in enumerate(sets, 1)),
        _at_station(cases, "planing", tail.x_P, tail.F_PX, tail.F_PY),
        *_extra_drag(cases, refusals),
    ]
    return Hydrodynamics(state, hole, sets, tail, tuple(forces))


def forces_of(forces: tuple[ForceOnBody[Array], ...], case: int) -> tuple[ForceOnBody[float], ...]:
    """Return the forces on one of the bodies; without the planing forces where there are none."""
    found = (ForceOnBody(f.name, *(float(v[case]) for v in f[1:])) for f in forces)
    return tuple(f for f in found if f.name != "planing" or f.F_X or f.F_Y)


def drag_ahead(
    forces: Sequence[ForceOnBody[Any]], counts: Callable[[ForceOnBody[Any]], Any]
) -> Any:
    """Return the drag that acts ahead of a place: the forces' part of N, eq. 21 [N].

    Parameters
    ----------
    forces : sequence of ForceOnBody
        The cavitator's first: it is ahead of everything.
    counts : callable
        Whether a force is ahead of the place, or of places in an array.
    """
    return sum((f.F_X * counts(f) for f in forces[1:]), forces[0].F_X)


def _stream(cases: ManyCases) -> Stream:
    return Stream(
        speed=cases.number("condition", "speed"),
        density=cases.number("water", "density"),
        gravity=cases.number("water", "gravity"),
        atmospheric_pressure=cases.number("water", "atmospheric_pressure"),
        vapour_pressure=cases.number("water", "vapour_pressure"),
        sigma=cases.given("condition", "cavitation_number"),
        depth=cases.given("condition", "depth"),
        cavity_pressure=cases.given("condition", "cavity_pressure"),
    )


def _cavity(cases: ManyCases, speed: Array, sigma: Array) -> Cavity:
    return form_cavity(
        cases.number("vehicle", "cavitator", "diameter"),
        sigma,
        speed=speed,
        gravity=cases.number("water", "gravity"),
        body_length=cases.vehicle.length,
        body_angle=cases.number("condition", "body_angle"),
        cavitator_angle=cases.number("condition", "cavitator_angle"),
        model=cases.model,
    )


def _fin_place(cases: ManyCases, k: int, refusals: Refusals) -> tuple[Array, Array]:
    """Return position of a set and the body's radius there [m]; the fins must stand on the body."""
    vehicle, name = cases.vehicle, f"vehicle.fins, set {k + 1}: received"
    x = cases.given("vehicle", "fins", k, "position")
    x = cases.given("condition", "fin_position") if x is None else x
    if x is None:
        say = f"{name} no position: give the set a position, or the condition a fin_position"
        refusals.refuse(np.ones(cases.cases, dtype=bool), FINS, lambda _: say)
        x = np.zeros(cases.cases)
    place, R, L = x, vehicle.radius_at(x), vehicle.length
    tip = cases.number("vehicle", "fins", k, "tip_radius")

    def off(i: int) -> str:
        say = f"it must lie on the body, within 0 and {L:g} m: move the fins"
        return f"{name} position {place[i]:g} m; {say}"

    def inside(i: int) -> str:
        say = f"must be greater than the body's radius of {R[i]:g} m at x = {place[i]:g} m"
        return f"{name} tip_radius {tip[i]:g} m; it {say}: correct it"

    refusals.refuse(x > L, FINS, off)
    refusals.refuse(tip <= R, FINS, inside)
    return x, R


def _fin_set(cases: ManyCases, k: int, hole: Cavity, refusals: Refusals) -> FinLoads:
    x, R = _fin_place(cases, k, refusals)
    return fin_loads(cases, k, hole, x, R)


def fin_loads(cases: ManyCases, k: int, hole: Cavity, x: Array, R: Array) -> FinLoads:
    """Work out the forces of a set of fins, eq. 14 and 15.

    Parameters
    ----------
    cases : ManyCases
    k : int
        Which set.
    hole : Cavity
        The cavity of every case.
    x, R : array (cases,)
        Where the fins stand, and the body's radius there [m].
    """
    model, phi = cases.model, np.array(cases.vehicle.fins[k].roll_angles)[:, None]
    rho, V = cases.number("water", "density"), cases.number("condition", "speed")
    tip = cases.number("vehicle", "fins", k, "tip_radius")
    radial = model.fin_immersion == "radial"
    immersion = fins.radial_immersion if radial else fins.tip_immersion
    h_f = immersion(R, tip, phi, hole.axis_offset(x), hole.radius(x))
    d_f = cases.number("vehicle", "fins", k, "thickness")
    drag = fins.fin_drag(rho, V, hole.sigma, h_f, d_f)
    plate = model.fin_lift == "plate"
    slope = cases.number("vehicle", "fins", k, "lift_slope") if plate else np.zeros(cases.cases)
    chord = cases.given("vehicle", "fins", k, "chord")
    area = h_f * (tip - R if chord is None else chord)
    incidence = fins.fin_incidence(
        hole.theta, cases.number("vehicle", "fins", k, "deflection"), phi
    )
    lift = fins.fin_lift(rho, V, slope, area, incidence, phi)
    return FinLoads(x, h_f, incidence, reduce(np.add, drag), reduce(np.add, lift))


def _acting(fin: FinLoads) -> tuple[Array, Array, Array]:
    return fin.position, fin.F_fX, fin.F_fY


def _extra_drag(cases: ManyCases, refusals: Refusals) -> Iterator[ForceOnBody[Array]]:
    """Yield the drag that the condition itself gives, if it does."""
    drag = cases.given("condition", "extra_drag")
    if drag is None:
        return
    length = cases.vehicle.length
    places = (
        cases.given("condition", "extra_drag_position"),
        cases.given("condition", "fin_position"),
        np.full(cases.cases, length),
    )
    x = next(place for place in places if place is not None)

    def off(i: int) -> str:
        say = f"it must lie on the body, within 0 and {length:g} m: correct it"
        return f"condition.extra_drag_position: received {x[i]:g} m; {say}"

    refusals.refuse(x > length, EXTRA_DRAG, off)
    yield _at_station(cases, "extra drag", x, drag, np.zeros(cases.cases))


def _at_station(
    cases: ManyCases, name: str, x: Array, drag: Array, lift: Array
) -> ForceOnBody[Array]:
    """Return a force, moved to a station that is the same place but for rounding."""
    return ForceOnBody(name, at_station(cases.vehicle.stations.x, x), drag, lift)
