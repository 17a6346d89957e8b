"""Loads on the body in motion: rigid-body balance, axial force, shear force and bending moment.

``a_X = (T - F_PX - sum F_fX - F_CX) / m``, ``a_Y = (F_CY + sum F_fY + F_PY - m g) / m``,
``beta = sum F_Y (x_M - x) / I``: forward, up and nose-up positive. With x [m] aft from the nose

- ``N(x) = F_CX + a_X m_ahead(x) + sum F_X [x > x_i]``, compression positive: the cavitator's drag
  at the nose, the thrust at the tail;
- ``Q' = q - m (a_Y + g + (x_M - x) beta)`` and ``M' = Q``, where q are the lateral forces: Q is the
  force up on the part ahead of x, and M = EI Y''. Both vanish at both free ends.

The integrals over the mass are exact, so the balance closes to rounding.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 18-26. There the distance X runs forward from the tail:
X = L - x. The weight, a body force, is missing in its eq. 24 and 26.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antinode.arrays import Array
from antinode.beam.mass import MassDistribution
from antinode.errors import InputError

from .condition import Cavitation, OperatingCondition, Water, resolve_cavitation
from .hydrodynamics import cavitator, cavity, fins, planing
from .hydrodynamics.cavity import Cavity, form_cavity
from .hydrodynamics.planing import Planing, planing_state
from .hydrodynamics.validity import Range, Validity
from .options import Model
from .vehicle import FinSet, Vehicle

Side = Literal["left", "right"]


class PointForce(NamedTuple):
    """A force at one station.

    Attributes
    ----------
    name : str
        Where it comes from.
    x : float
        Where it acts [m].
    F_X, F_Y : float
        Drag, positive aft, and lift, positive up [N].
    """

    name: str
    x: float
    F_X: float
    F_Y: float


class FinLoad(NamedTuple):
    """The forces of one set of fins.

    Attributes
    ----------
    position : float
        x of the set [m].
    immersion : tuple of float
        Length of each fin outside the cavity [m].
    F_fX, F_fY : float
        Drag, positive aft, and lift, positive up [N].
    """

    position: float
    immersion: tuple[float, ...]
    F_fX: float
    F_fY: float


class RigidBody(NamedTuple):
    """Mass and accelerations of the body as a whole.

    Attributes
    ----------
    mass : float
        Mass [kg].
    x_M : float
        Centre of mass [m].
    inertia : float
        Moment of inertia about the centre of mass [kg m^2].
    a_X, a_Y : float
        Accelerations, forward and up positive [m/s^2].
    beta : float
        Angular acceleration, nose-up positive [rad/s^2].
    """

    mass: float
    x_M: float
    inertia: float
    a_X: float
    a_Y: float
    beta: float


class Checks(NamedTuple):
    """What is left of N, Q and M at the ends, over the largest force (and the length).

    Attributes
    ----------
    axial_nose, axial_tail : float
        N at the nose less the cavitator's drag, N at the tail less the thrust [-].
    shear_nose, shear_tail : float
        Q at the ends [-].
    moment_nose, moment_tail : float
        M at the ends [-].
    """

    axial_nose: float
    axial_tail: float
    shear_nose: float
    shear_tail: float
    moment_nose: float
    moment_tail: float

    @property
    def worst(self) -> float:
        """The largest of the six, as a size [-]."""
        return max(map(abs, self))


@dataclass(frozen=True, eq=False)
class Loads:
    """Everything that acts on the body in one condition.

    Parameters
    ----------
    cavity : Cavity
        The cavity.
    cavity_pressure, depth : float or None
        Given or implied pressure in the cavity [Pa] and depth [m]; None where nothing says so.
    F_CX, F_CY : float
        Drag (aft) and lift (up) of the cavitator [N].
    fins : tuple of FinLoad
        Forces of each set of fins.
    planing : Planing
        Planing state and forces.
    thrust : float
        Thrust at the tail, forward [N].
    gravity : float
        g [m/s^2].
    body : RigidBody
        Mass, centre and accelerations.
    forces : tuple of PointForce
        Forces on the body but the thrust, cavitator first.
    mass_distribution : MassDistribution
        Mass along the axis.
    axial_model : {"exact", "element_midpoint"}
        How N runs between the breakpoints.
    warnings : tuple of str
        What is doubtful, and what to do about it.
    validity : tuple of Validity
        Every checked range.
    """

    cavity: Cavity
    cavity_pressure: float | None
    depth: float | None
    F_CX: float
    F_CY: float
    fins: tuple[FinLoad, ...]
    planing: Planing
    thrust: float
    gravity: float
    body: RigidBody
    forces: tuple[PointForce, ...]
    mass_distribution: MassDistribution
    axial_model: Literal["exact", "element_midpoint"]
    warnings: tuple[str, ...]
    validity: tuple[Validity, ...]

    @property
    def sigma(self) -> float:
        """Cavitation number [-]."""
        return self.cavity.sigma

    @property
    def length(self) -> float:
        """Length of the body [m]."""
        return float(self.mass_distribution.x[-1])

    @property
    def F_fX(self) -> float:
        """Drag of all fins [N], positive aft."""
        return sum(fin.F_fX for fin in self.fins)

    @property
    def F_fY(self) -> float:
        """Lift of all fins [N], up positive."""
        return sum(fin.F_fY for fin in self.fins)

    @property
    def F_PX(self) -> float:
        """Planing drag [N], positive aft."""
        return self.planing.F_PX

    @property
    def F_PY(self) -> float:
        """Planing lift [N], up positive."""
        return self.planing.F_PY

    @property
    def x_P(self) -> float:
        """Where the planing forces act [m]."""
        return self.planing.x_P

    @property
    def mass(self) -> float:
        """Mass of the body [kg]."""
        return self.body.mass

    @property
    def x_M(self) -> float:
        """Centre of mass [m]."""
        return self.body.x_M

    @property
    def inertia(self) -> float:
        """Moment of inertia about the centre of mass [kg m^2]."""
        return self.body.inertia

    @property
    def a_X(self) -> float:
        """Acceleration along the axis, forward positive [m/s^2]."""
        return self.body.a_X

    @property
    def a_Y(self) -> float:
        """Lateral acceleration of the centre of mass, up positive [m/s^2]."""
        return self.body.a_Y

    @property
    def beta(self) -> float:
        """Angular acceleration, nose-up positive [rad/s^2]."""
        return self.body.beta

    @property
    def weight(self) -> float:
        """Weight m g [N]."""
        return self.body.mass * self.gravity

    @property
    def axial_inertia(self) -> float:
        """Factor on the mass ahead in N [m/s^2]: a_X, or 0 with N constant between stations."""
        return self.a_X if self.axial_model == "exact" else 0.0

    @cached_property
    def breakpoints(self) -> Array:
        """Positions between which `axial_jump` is constant [m], (n+1,).

        The stations, and with the exact axial force the forces between nose and tail.
        """
        x = self.mass_distribution.x
        if self.axial_model == "element_midpoint":
            return x
        return np.unique(np.concatenate([x, [force.x for force in self.forces]]))

    @cached_property
    def axial_jump(self) -> Array:
        """Part of N that is constant on each interval of the breakpoints [N], (n,).

        N(x) is this plus `axial_inertia` times the mass ahead of x.
        """
        x = self.breakpoints
        middle = (x[:-1] + x[1:]) / 2
        if self.axial_model == "exact":
            return self._drag_ahead(middle, "left")
        ahead = self.mass_distribution.moments(x)[0]
        inertia = self.a_X * (ahead[:-1] + ahead[1:]) / 2
        return np.asarray(self._drag_ahead(middle, "left") + inertia)

    def axial_force(self, x: ArrayLike, side: Side = "left") -> Array:
        """Return the axial compression N.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].
        side : {"left", "right"}
            The value just ahead of `x`, or just aft of it, where it jumps. At the tail every force
            counts, and at the nose the cavitator's.

        Returns
        -------
        ndarray
            N, compression positive [N].
        """
        x = self._on_body(x)
        if self.axial_model == "exact":
            ahead = self.mass_distribution.moments(x)[0]
            return np.asarray(self._drag_ahead(x, side) + self.a_X * ahead)
        k = np.searchsorted(self.breakpoints, x, side=side) - 1
        return self.axial_jump[np.clip(k, 0, len(self.axial_jump) - 1)]

    def shear_force(self, x: ArrayLike, side: Side = "left") -> Array:
        """Return the shear force Q = M', the force up on the part ahead of `x`.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].
        side : {"left", "right"}
            The value just ahead of `x`, or just aft of it, where it jumps. At the tail every force
            counts.

        Returns
        -------
        ndarray
            Q, up positive [N].
        """
        x = self._on_body(x)
        J0, J1, _ = self.mass_distribution.moments(x)
        c = self._inertial_load
        lift = sum(force.F_Y * self._counts(force, x, side) for force in self.forces)
        return np.asarray(lift - c * J0 + self.beta * J1)

    def bending_moment(self, x: ArrayLike) -> Array:
        """Return the bending moment M = EI Y'', of the loads alone.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].

        Returns
        -------
        ndarray
            M [N m].
        """
        x = self._on_body(x)
        J0, J1, J2 = self.mass_distribution.moments(x)
        c = self._inertial_load
        lift = sum(force.F_Y * np.maximum(x - force.x, 0) for force in self.forces)
        return np.asarray(lift - c * (x * J0 - J1) + self.beta * (x * J1 - J2))

    @cached_property
    def checks(self) -> Checks:
        """What is left at the ends of N, Q and M, relative to the largest force."""
        sizes = [abs(part) for force in self.forces for part in (force.F_X, force.F_Y)]
        F, L = max(*sizes, self.thrust, self.weight, 1e-300), self.length
        ends = np.array([0.0, L])
        N = self._drag_ahead(ends, "left") + self.a_X * self.mass_distribution.moments(ends)[0]
        N = (N - [self.F_CX, self.thrust]) / F
        Q, M = self.shear_force(ends) / F, self.bending_moment(ends) / (F * L)
        return Checks(*map(float, (*N, *Q, *M)))

    @property
    def _inertial_load(self) -> float:
        """Inertial and weight load per mass at the nose [m/s^2]."""
        return self.a_Y + self.gravity + self.x_M * self.beta

    def _on_body(self, x: ArrayLike) -> Array:
        x = np.asarray(x, dtype=float)
        if not ((x >= 0) & (x <= self.length)).all():
            raise InputError(f"x = {x} m is not on the body: must lie within 0 and {self.length:g}")
        return x

    def _counts(self, force: PointForce, x: Array, side: Side) -> NDArray[np.bool_]:
        """Whether a force counts as ahead of `x`: all of them do at the tail."""
        return (x > force.x if side == "left" else x >= force.x) | (x >= self.length)

    def _drag_ahead(self, x: Array, side: Side) -> Array:
        jumps = sum(force.F_X * self._counts(force, x, side) for force in self.forces[1:])
        return np.asarray(self.F_CX + jumps + 0 * x)

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        p = self.planing
        yield (
            f"cavity: sigma {self.sigma:.4g}, length {self.cavity.L_c:.4g} m, "
            f"largest diameter {self.cavity.D_c:.4g} m"
        )
        yield (
            f"forces [N]: cavitator {self.F_CX:.5g} aft, {self.F_CY:.5g} up; "
            f"fins {self.F_fX:.5g} aft, {self.F_fY:.5g} up; "
            f"planing {p.F_PX:.5g} aft, {p.F_PY:.5g} up at x = {p.x_P:.4g} m; "
            f"thrust {self.thrust:.5g}; weight {self.weight:.5g}"
        )
        yield (
            f"body: {self.mass:.5g} kg, centre of mass at x = {self.x_M:.4g} m; "
            f"acceleration {self.a_X:.4g} m/s^2 forward, {self.a_Y:.4g} m/s^2 up, "
            f"{self.beta:.4g} rad/s^2 nose-up"
        )
        yield f"balance of N, Q and M at the ends closes to {self.checks.worst:.1e}"
        yield from (f"warning: {warning}" for warning in self.warnings)


def compute_loads(
    vehicle: Vehicle,
    condition: OperatingCondition,
    water: Water | None = None,
    model: Model | None = None,
) -> Loads:
    """Work out cavity, forces, accelerations and internal loads of a vehicle in a condition.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle.
    condition : OperatingCondition
        How it moves.
    water : Water, optional
        The water; by default fresh water at 20 C.
    model : Model, optional
        The choices that the equations leave open; by default those of `Model`.

    Returns
    -------
    Loads
        The loads, with warnings, ranges of validity and checks.

    Raises
    ------
    InputError
        If the input contradicts itself or cannot be: pressures, or fins that are off the body.
    """
    water, model = water or Water(), model or Model()
    state = resolve_cavitation(condition, water)
    return _assembled(
        vehicle, condition, water, state, *_hydrodynamics(vehicle, condition, water, model, state)
    )


def point_forces(
    vehicle: Vehicle, condition: OperatingCondition, water: Water, model: Model
) -> tuple[PointForce, ...]:
    """Return the forces on the body but the thrust, cavitator first: `Loads.forces` alone."""
    state = resolve_cavitation(condition, water)
    return _hydrodynamics(vehicle, condition, water, model, state).forces


class _Hydrodynamics(NamedTuple):
    """The cavity and what acts on the body."""

    cavity: Cavity
    fins: tuple[FinLoad, ...]
    tail: Planing
    forces: tuple[PointForce, ...]


def _hydrodynamics(
    vehicle: Vehicle,
    condition: OperatingCondition,
    water: Water,
    model: Model,
    state: Cavitation,
) -> _Hydrodynamics:
    hole = _cavity(vehicle, condition, water, model, state.sigma)
    fin_loads = tuple(
        _fin_load(vehicle, fin, number, condition, water.density, hole)
        for number, fin in enumerate(vehicle.fins, 1)
    )
    tail = _planing(vehicle, hole, water, condition.speed)
    forces = _forces(vehicle, _disk_force(hole, water, condition.speed), fin_loads, tail)
    return _Hydrodynamics(hole, fin_loads, tail, (*forces, *_extra_drag(vehicle, condition)))


def _extra_drag(vehicle: Vehicle, condition: OperatingCondition) -> Iterator[PointForce]:
    """Yield the drag that the condition itself gives, if it does."""
    if condition.extra_drag is None:
        return
    places = (condition.extra_drag_position, condition.fin_position, vehicle.length)
    x = next(place for place in places if place is not None)
    if x > vehicle.length:
        say = f"must lie on the body, within 0 and {vehicle.length:g} m: correct it"
        raise InputError(f"condition.extra_drag_position: received {x:g} m; it {say}")
    yield PointForce("extra drag", _snapped(x, vehicle.stations.x), condition.extra_drag, 0.0)


def _assembled(
    vehicle: Vehicle,
    condition: OperatingCondition,
    water: Water,
    state: Cavitation,
    hole: Cavity,
    fin_loads: tuple[FinLoad, ...],
    tail: Planing,
    forces: tuple[PointForce, ...],
) -> Loads:
    """Balance the forces, check the ranges, and put everything together."""
    mass = vehicle.mass_distribution(condition.burn_fraction)
    ranges = list(_ranges(vehicle, hole, tail))
    return Loads(
        cavity=hole,
        cavity_pressure=state.cavity_pressure,
        depth=state.depth,
        F_CX=forces[0].F_X,
        F_CY=forces[0].F_Y,
        fins=fin_loads,
        planing=tail,
        thrust=condition.thrust,
        gravity=water.gravity,
        body=_balance(forces, mass, condition.thrust, water.gravity),
        forces=forces,
        mass_distribution=mass,
        axial_model=hole.model.axial_force,
        warnings=tuple(_warnings(vehicle, hole, fin_loads, tail, ranges)),
        validity=tuple(known.check(value) for known, value in ranges),
    )


def _cavity(
    vehicle: Vehicle, condition: OperatingCondition, water: Water, model: Model, sigma: float
) -> Cavity:
    return form_cavity(
        vehicle.cavitator.diameter,
        sigma,
        speed=condition.speed,
        gravity=water.gravity,
        body_length=vehicle.length,
        body_angle=condition.body_angle,
        cavitator_angle=condition.cavitator_angle,
        model=model,
    )


def _fin_place(
    vehicle: Vehicle, fin: FinSet, number: int, condition: OperatingCondition
) -> tuple[float, float]:
    """Position of a set and radius of the body there [m]; the fin must stand on the body."""
    x = condition.fin_position if fin.position is None else fin.position
    if x is None:
        say = "give the set a position, or the condition a fin_position"
        raise InputError(f"vehicle.fins, set {number}: received no position: {say}")
    L = vehicle.length
    if x > L:
        say = f"must lie on the body, within 0 and {L:g} m: move the fins"
        raise InputError(f"vehicle.fins, set {number}: received position {x:g} m; it {say}")
    R = float(vehicle.radius_at(x))
    if fin.tip_radius <= R:
        wrong = f"vehicle.fins, set {number}: received tip_radius {fin.tip_radius:g} m"
        say = f"must be greater than the body's radius of {R:g} m at x = {x:g} m: correct it"
        raise InputError(f"{wrong}; it {say}")
    return x, R


def _fin_load(
    vehicle: Vehicle,
    fin: FinSet,
    number: int,
    condition: OperatingCondition,
    rho: float,
    hole: Cavity,
) -> FinLoad:
    x, R = _fin_place(vehicle, fin, number, condition)
    phi, V = np.array(fin.roll_angles), condition.speed
    radial = hole.model.fin_immersion == "radial"
    immersion = fins.radial_immersion if radial else fins.tip_immersion
    h_f = immersion(R, fin.tip_radius, phi, float(hole.axis_offset(x)), float(hole.radius(x)))
    drag = fins.fin_drag(rho, V, hole.sigma, h_f, fin.thickness)
    slope = fin.lift_slope if hole.model.fin_lift == "plate" else 0.0
    area = h_f * (fin.chord if fin.chord is not None else fin.tip_radius - R)
    incidence = fins.fin_incidence(hole.theta, fin.deflection, phi)
    lift = fins.fin_lift(rho, V, slope, area, incidence, phi)
    return FinLoad(x, tuple(map(float, h_f)), float(drag.sum()), float(lift.sum()))


def _disk_force(hole: Cavity, water: Water, speed: float) -> PointForce:
    drag, lift = cavitator.cavitator_forces(water.density, speed, hole.sigma, hole.D_n, hole.alpha)
    return PointForce("cavitator", 0.0, float(drag), float(lift))


def _planing(vehicle: Vehicle, hole: Cavity, water: Water, speed: float) -> Planing:
    x = vehicle.stations.x
    rho, mu = water.density, water.dynamic_viscosity
    state = planing_state(hole, vehicle.radius_at, x, rho, speed, mu)
    return state if hole.model.planing == "paper" else state.without_force()


def _forces(
    vehicle: Vehicle, disk: PointForce, fin_loads: tuple[FinLoad, ...], tail: Planing
) -> tuple[PointForce, ...]:
    """Gather the point forces, cavitator first."""
    x = vehicle.stations.x
    finned = [
        PointForce(f"fin set {number}", _snapped(fin.position, x), fin.F_fX, fin.F_fY)
        for number, fin in enumerate(fin_loads, 1)
    ]
    forces = [disk, *finned]
    if tail.F_PX or tail.F_PY:
        forces.append(PointForce("planing", _snapped(tail.x_P, x), tail.F_PX, tail.F_PY))
    return tuple(forces)


def _snapped(position: float, stations: Array) -> float:
    """Return the station that is the same as a position but for rounding, or the position."""
    nearest = float(stations[np.argmin(np.abs(stations - position))])
    return nearest if abs(nearest - position) <= 1e-9 * stations[-1] else position


def _balance(
    forces: tuple[PointForce, ...], distribution: MassDistribution, thrust: float, gravity: float
) -> RigidBody:
    """Eq. 18-20, with the exact integrals of the mass."""
    m, J1, J2 = map(float, distribution.moments(distribution.x[-1]))
    x_M = J1 / m
    inertia = J2 - x_M * J1
    a_X = (thrust - sum(force.F_X for force in forces)) / m
    a_Y = sum(force.F_Y for force in forces) / m - gravity
    beta = sum(force.F_Y * (x_M - force.x) for force in forces) / inertia
    return RigidBody(m, x_M, inertia, a_X, a_Y, beta)


def _ranges(vehicle: Vehicle, hole: Cavity, tail: Planing) -> Iterator[tuple[Range, float]]:
    """Every range that this condition touches, with the value."""
    sigma, alpha = hole.sigma, abs(hole.alpha)
    yield cavitator.DRAG_RANGE, sigma
    yield cavitator.ANGLE_RANGE, alpha
    yield cavity.SIZE_RANGE, sigma
    if hole.model.gravity_rise != "none":
        yield cavity.RISE_RANGE, hole.Fr_L
    if hole.model.distortion != "none":
        yield cavity.DISTORTION_RANGE, alpha
    if vehicle.fins:
        yield fins.DRAG_RANGE, sigma
        if hole.model.fin_lift != "none":
            yield fins.LIFT_RANGE, max(_largest_incidence(fin, hole) for fin in vehicle.fins)
    planes = hole.model.planing != "none"
    if planes and tail.area > 0:
        yield planing.FRICTION_RANGE, tail.Re_w
    if planes and tail.h > 0:
        yield planing.CLEARANCE_RANGE, tail.R_prime
        yield planing.SLOPE_RANGE, tail.alpha_p


def _largest_incidence(fin: FinSet, hole: Cavity) -> float:
    incidence = fins.fin_incidence(hole.theta, fin.deflection, np.array(fin.roll_angles))
    return float(np.abs(incidence).max())


def _warnings(
    vehicle: Vehicle,
    hole: Cavity,
    fin_loads: tuple[FinLoad, ...],
    tail: Planing,
    ranges: list[tuple[Range, float]],
) -> Iterator[str]:
    outside = (known.warning(value) for known, value in ranges if not known.check(value).inside)
    yield from dict.fromkeys(outside)
    if hole.L_c < vehicle.length:
        yield (
            f"The cavity closes at x = {hole.L_c:.4g} m, ahead of the tail at "
            f"{vehicle.length:.4g} m, and the body behind it is taken as wetted all round: "
            "lower sigma, or take a larger cavitator, if a full cavity was meant."
        )
    for number, fin in enumerate(fin_loads, 1):
        if not any(fin.immersion):
            yield (
                f"Fin set {number} at x = {fin.position:.4g} m is inside the cavity altogether and "
                "gives no force: move it aft, or make its tip_radius larger."
            )
    yield from _forebody(vehicle, hole)


def _forebody(vehicle: Vehicle, hole: Cavity) -> Iterator[str]:
    """Warn of a nose outside the cavity, but for the rim of the disk (its radius in length)."""
    start, end = hole.D_n / 2, min(hole.L_c / 2, vehicle.length)
    if start >= end:
        return
    stations = vehicle.stations.x
    inner = stations[(stations > start) & (stations < end)]
    x = np.union1d(np.linspace(start, end, 400), inner)
    out = np.abs(hole.axis_offset(x)) + vehicle.radius_at(x) - hole.radius(x)
    if out.max() > 0:
        worst = x[np.argmax(out)]
        yield (
            f"The forebody stands {out.max():.3g} m out of the cavity at x = {worst:.4g} m, where "
            "no force is counted: make the nose slimmer, or the cavity larger."
        )
