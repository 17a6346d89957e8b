"""The water's stiffness: fins, planing and cavitator linearised about the computed state.

A place x on the body that moves up by Y and turns by psi = dY/dx, both slowly against the flow
past it, meets the cavity's axis lower by Y and the flow at an angle that is smaller by
psi + Y_t/V. So the forces change, exactly to first order, by

    dF_Y = dF/dY Y + dF/dpsi (psi + Y_t/V),      moment about x: F dx_P

and each device is one `Tangent`: a spring, a dashpot, and terms that follow. The derivatives are
those of the formulas of `forces.py` themselves, by central differences with Richardson's step.

The disk is fixed to the nose and its pressure stands normal to it: turning the nose by psi is
turning the cavitator by psi, and the share that follows is replaced by the slope of eq. 6,
``F_x0 cos 2 alpha``, never added to it.

What is left out: the cavity stays where the steady state has it, since what the nose does to it
arrives at x only x/V later; drags change by second order; each device sees its own place alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.arrays import Array

from .forces import fin_loads
from .hydrodynamics.cavity import Cavity
from .hydrodynamics.planing import planing_state
from .loads import Loads
from .numbers import ManyCases

QUASI_STEADY = 0.3
"""f L/V up to which the water follows the motion without much delay [-]."""

_STEP = 1e-4  # of the body's radius, and in radians: truncation and rounding both below 1e-9
_STEPS = np.array([1.0, -1.0, 0.5, -0.5])


@dataclass(frozen=True, eq=False)
class Tangent:
    """What the water does about one device when the body moves there.

    ``[F_Y, moment] = -stiffness @ [Y, psi] - damping @ [Y_t, psi_t]``: force up, moment that raises
    psi.

    Attributes
    ----------
    name : str
        Which device.
    x : float
        Where it acts [m].
    force : float
        The lateral force about which it is linear, up positive [N].
    stiffness : array, shape (2, 2)
        [[N/m, N/rad], [N, N m/rad]].
    damping : array, shape (2, 2)
        [[N s/m, N s/rad], [N s, N m s/rad]].
    room : float
        How far the body may move where it touches until a one-sided contact ends [m]; infinite
        where there is none.
    touches : float
        Where that contact is [m]; NaN where there is none.
    """

    name: str
    x: float
    force: float
    stiffness: Array
    damping: Array
    room: float = np.inf
    touches: float = np.nan

    @property
    def spring(self) -> float:
        """Force against a deflection [N/m]."""
        return float(self.stiffness[0, 0])

    @property
    def dashpot(self) -> float:
        """Force against a lateral velocity [N s/m]."""
        return float(self.damping[0, 0])

    @property
    def following(self) -> float:
        """Force up for the slope psi of the body: what turns with it [N/rad]."""
        return -float(self.stiffness[0, 1])


def tangents(cases: ManyCases, loads: Loads) -> tuple[Tangent, ...]:
    """Return the tangents of cavitator, fins and planing tail of one case, those that are not zero.

    That of the cavitator is what `disk_share` does not say.

    Parameters
    ----------
    cases : ManyCases
        The one case.
    loads : Loads
        Its loads.
    """
    sets = (_fin_tangent(cases, loads, k) for k in range(len(loads.fins)))
    found = (disk_tangent(loads, cases.condition.speed), *sets, _planing_tangent(cases, loads))
    return tuple(t for t in found if t.stiffness.any() or t.damping.any())


def disk_share(loads: Loads) -> float:
    """Return the share of the cavitator's drag that turns with the nose, by eq. 5 and 6 [-].

    ``F_x0 cos 2 alpha / F_CX = 1 - tan^2 alpha``: the slope of the lift of a disk that turns.
    """
    return float(1 - np.tan(loads.cavity.alpha) ** 2)


def disk_tangent(loads: Loads, speed: float) -> Tangent:
    """Return what the disk's pressure does against the nose's lateral velocity.

    The flow meets the disk at ``alpha + Y_t/V``, its pressure keeps the direction of the disk:
    ``dF_Y = -F_x0 sin^2 alpha Y_t/V``.

    Parameters
    ----------
    loads : Loads
    speed : float
        V [m/s].
    """
    damping = np.zeros((2, 2))
    damping[0, 0] = loads.F_CY * np.tan(loads.cavity.alpha) / speed
    return Tangent("cavitator", 0.0, loads.F_CY, np.zeros((2, 2)), damping)


def _slopes(forces: Callable[[Array, Array], Array], radius: float) -> tuple[Array, Array]:
    """Return the derivatives of forces by deflection and by slope, (rows,) each."""
    h, none = np.array([_STEP * radius, _STEP]), np.zeros(len(_STEPS))
    values = forces(
        np.concatenate([h[0] * _STEPS, none]), np.concatenate([none, h[1] * _STEPS])
    ).reshape(-1, 2, len(_STEPS))
    whole = (values[..., 0] - values[..., 1]) / (2 * h)
    half = (values[..., 2] - values[..., 3]) / h
    found = (4 * half - whole) / 3
    return found[:, 0], found[:, 1]


def _repeated(cases: ManyCases) -> ManyCases:
    """Return the one case as often as there are steps."""
    return ManyCases(
        cases.vehicle, cases.condition, cases.water, cases.model, cases=2 * len(_STEPS)
    )


def _moved(cavity: Cavity, x: float, deflection: Array, slope: Array) -> Cavity:
    """Return the cavity of one case as a place sees it that moves in several ways."""
    rows = {name: np.full(len(slope), getattr(cavity, name)) for name in Cavity._varying}
    many = Cavity(**rows, body_length=cavity.body_length, model=cavity.model)
    return many.seen_from(x, deflection, slope)


def _fin_tangent(cases: ManyCases, loads: Loads, k: int) -> Tangent:
    fin, many = loads.fins[k], _repeated(cases)
    radius = float(cases.vehicle.radius_at(np.array([fin.position]))[0])
    x, R = np.full(many.cases, fin.position), np.full(many.cases, radius)

    def force(deflection: Array, slope: Array) -> Array:
        return fin_loads(many, k, _moved(loads.cavity, fin.position, deflection, slope), x, R).F_fY

    (by_place,), (by_angle,) = _slopes(force, radius)
    stiffness = -np.array([[by_place, by_angle], [0.0, 0.0]])
    damping = -np.array([[by_angle, 0.0], [0.0, 0.0]]) / cases.condition.speed
    return Tangent(f"fin set {k + 1}", fin.position, fin.F_fY, stiffness, damping)


def _planing_tangent(cases: ManyCases, loads: Loads) -> Tangent:
    tail, many, cavity = min(loads.length, loads.cavity.L_c), _repeated(cases), loads.cavity
    radius = float(cases.vehicle.radius_profile.ends[-1, 1])
    water = ("water", "density"), ("condition", "speed"), ("water", "dynamic_viscosity")

    def forces(deflection: Array, slope: Array) -> Array:
        moved = _moved(cavity, tail, deflection, slope)
        found = planing_state(
            moved, cases.vehicle.radius_profile, *(many.number(*keys) for keys in water)
        )
        return np.stack([found.F_PY, loads.F_PY * found.x_P])

    by_place, by_angle = _slopes(forces, radius)
    x, F = _acts_at(loads), loads.F_PY
    # the motion of the tail is that of x: Y + (tail - x) psi
    arm = np.array([[1.0, tail - x], [0.0, 1.0]])
    stiffness = -np.stack([by_place, by_angle], axis=-1) @ arm
    damping = -np.array([[by_angle[0], 0.0], [0.0, 0.0]]) / cases.condition.speed @ arm
    room = _room(loads, radius)
    touches = tail if np.isfinite(room) else np.nan
    return Tangent("planing", x, F, stiffness, damping, room, touches)


def _acts_at(loads: Loads) -> float:
    """Return the station of the planing forces [m]."""
    return next((f.x for f in loads.forces if f.name == "planing"), loads.x_P)


def _room(loads: Loads, radius: float) -> float:
    """Return how far the tail may move until the contact on one side ends [m]."""
    planing: Any = loads.planing
    if planing.all_round or not loads.F_PY:
        return np.inf
    return float(planing.h * radius)
