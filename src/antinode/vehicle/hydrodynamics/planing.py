"""Planing of the afterbody on the wall of the cavity.

``F_PX = (rho V^2 / 2) C_PX A_w`` with ``C_PX = 0.031 Re_w^(-1/7)``,
``F_PY = pi rho R^2 V^2 [1 - (R'/(h'+R'))^2] (1+h')/(1+2h') alpha_p``, ``R' = (R_c - R)/R`` and
``h' = max(0, abs(offset)/R - R')`` at the tail. Where R' <= 0 or behind the closure the body is
wet all round: the bracket is 1. h' is at most 2. The force has the direction of the offset: cavity
axis above body axis wets the belly and pushes up. Drag is positive aft.

A_w and its centroid x_P, where the forces act, are those of `wetted.py`.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 16 and 17. Eq. 16 as printed is singular at h' = R';
here it has the sign with which the bracket runs from 0 to 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.profile import Profile

from .cavity import Cavity
from .validity import Range
from .wetted import wetted_surface

FRICTION_RANGE = Range(
    "planing friction, eq. 16",
    "Re_w",
    5e5,
    1e9,
    "engineering choice: the one-seventh power law of a turbulent boundary layer, from transition "
    "to where the logarithmic law leaves it; the source gives none",
    "take the planing drag as an extrapolation",
)
CLEARANCE_RANGE = Range(
    "planing force, eq. 16",
    "R'",
    0.0,
    math.inf,
    "the formula needs a cavity wider than the tail",
    "the tail is wetted all round and the lateral force is an upper estimate; lower sigma, or take "
    "a larger cavitator",
)
SLOPE_RANGE = Range(
    "planing force, eq. 16",
    "alpha_p [rad]",
    0.0,
    0.2,
    "engineering choice: planing theory for small angles; the source gives none",
    "take the lateral planing force as an extrapolation",
)
LARGEST_IMMERSION = 2.0
"""Largest h' [-]: the whole body circle has passed the wall."""


def friction_coefficient(Re_w: Any) -> Any:
    """Friction coefficient C_PX of the wetted area, eq. 16 [-]; 0 where nothing is wet.

    Parameters
    ----------
    Re_w : array_like
        Reynolds number of the wetted length [-].
    """
    Re_w = np.asarray(Re_w, dtype=float)
    return np.where(Re_w > 0, 0.031 * np.where(Re_w > 0, Re_w, 1.0) ** (-1 / 7), 0.0)


def reynolds_number(density: Any, speed: Any, length: Any, viscosity: Any) -> Any:
    """Reynolds number of the wetted length, eq. 16 [-].

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        V [m/s].
    length : array_like
        Wetted length L_w [m].
    viscosity : array_like
        Dynamic viscosity mu [Pa s].
    """
    return density * speed * length / viscosity


def planing_drag(density: Any, speed: Any, length: Any, area: Any, viscosity: Any) -> Any:
    """Drag F_PX of the wetted area by eq. 16 [N], positive aft.

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        V [m/s].
    length : array_like
        Wetted length L_w [m].
    area : array_like
        Wetted area A_w [m^2].
    viscosity : array_like
        Dynamic viscosity mu [Pa s].
    """
    C_PX = friction_coefficient(reynolds_number(density, speed, length, viscosity))
    return density * speed**2 / 2 * C_PX * area


def clearance_ratio(R_c: Any, R: Any) -> Any:
    """Clearance R' = (R_c - R)/R of a centred body in the cavity [-], from R_c and R [m]."""
    return (R_c - R) / R


def immersion_ratio(offset: Any, R_c: Any, R: Any) -> Any:
    """Immersion h' of the tail by eq. 17 [-], between 0 and 2.

    Parameters
    ----------
    offset : array_like
        Cavity axis minus body axis at the tail, up positive [m].
    R_c : array_like
        Radius of the cavity [m].
    R : array_like
        Radius of the body [m].
    """
    return np.clip((np.abs(offset) - (R_c - R)) / R, 0, LARGEST_IMMERSION)


def planing_force(
    density: Any, speed: Any, R: Any, h: Any, R_prime: Any, alpha_p: Any, all_round: Any = False
) -> Any:
    """Size of the lateral planing force F_PY by eq. 16 [N].

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        V [m/s].
    R : array_like
        Radius of the body at the tail [m].
    h : array_like
        Immersion h' [-].
    R_prime : array_like
        Clearance R' [-].
    alpha_p : array_like
        Planing angle [rad].
    all_round : array_like of bool
        Behind the closure: wetted all round, whatever R' is.
    """
    free = (np.asarray(R_prime) > 0) & ~np.asarray(all_round)
    bracket = 1 - (np.where(free, R_prime, 0.0) / np.where(free, h + R_prime, 1.0)) ** 2
    return math.pi * density * R**2 * speed**2 * bracket * (1 + h) / (1 + 2 * h) * alpha_p


def direction(offset: Any, R: Any, width: float) -> Any:
    """Direction of the planing force [-]: the offset's sign, linear between -width R and width R.

    Parameters
    ----------
    offset : array_like
        Cavity axis minus body axis at the tail [m].
    R : array_like
        Radius of the body [m].
    width : float
        Offset in radii at which the force has its full size [-]; 0 gives the plain sign.
    """
    return np.clip(offset / (width * R), -1, 1) if width > 0 else np.sign(offset)


@dataclass(frozen=True)
class Planing:
    """The planing state and its forces; the numbers of many conditions are arrays (cases,).

    Parameters
    ----------
    F_PX, F_PY : float or array
        Drag, positive aft, and lift, positive up [N].
    x_P : float or array
        Where they act [m].
    h, R_prime : float or array
        Immersion h' and clearance R' at the tail [-].
    alpha_p : float or array
        Planing angle [rad].
    length, area : float or array
        Wetted length L_w [m] and area A_w [m^2].
    Re_w : float or array
        Reynolds number of the wetted length [-].
    all_round : bool or array of bool
        Whether the tail is wetted all round: R' <= 0, or behind the closure.
    """

    F_PX: Any
    F_PY: Any
    x_P: Any
    h: Any
    R_prime: Any
    alpha_p: Any
    length: Any
    area: Any
    Re_w: Any
    all_round: Any

    def of(self, case: int) -> Planing:
        """Return the state of one case, its numbers as floats."""
        return Planing(*(getattr(self, f.name)[case].item() for f in fields(self)))


def planing_angle(cavity: Cavity, x: Any) -> Any:
    """Planing angle alpha_p by the model [rad].

    Parameters
    ----------
    cavity : Cavity
        The cavity, with its model.
    x : array_like
        The tail, or the closure if that is ahead [m].
    """
    if cavity.model.planing_angle == "attitude":
        return np.abs(cavity.theta)
    axis = np.abs(cavity.axis_slope(x))
    return axis if cavity.model.planing_angle == "axis" else axis + np.abs(cavity.radius_slope(x))


def planing_state(
    cavity: Cavity, radius: Profile, density: Array, speed: Array, viscosity: Array
) -> Planing:
    """Work out the planing state and its forces of many conditions.

    Parameters
    ----------
    cavity : Cavity
        The cavities, their numbers arrays (cases,).
    radius : Profile
        Radius of the body, the same for all [m].
    density : array
        Density of the water [kg/m^3].
    speed : array
        V [m/s].
    viscosity : array
        Dynamic viscosity [Pa s].

    Returns
    -------
    Planing
        Forces, point of action and what they came from.
    """
    model, tail = cavity.model, float(radius.x[-1])
    wet = wetted_surface(cavity, radius)
    closed, x = cavity.L_c < tail, np.minimum(tail, cavity.L_c)
    R, R_c, offset = float(radius.ends[-1, 1]), cavity.radius(x), cavity.axis_offset(x)
    h, R_prime = immersion_ratio(offset, R_c, R), clearance_ratio(R_c, R)
    alpha_p = planing_angle(cavity, x)
    size = planing_force(density, speed, R, h, R_prime, alpha_p, closed)
    lift = size * direction(offset, R, model.planing_direction_width)
    drag = planing_drag(density, speed, wet.length, wet.area, viscosity)
    acts, none = model.planing == "paper", np.zeros_like(x)
    return Planing(
        F_PX=model.planing_drag_factor * drag if acts else none,
        F_PY=lift if acts else none,
        x_P=wet.centroid if model.planing_position == "centroid" else np.full_like(x, tail),
        h=h,
        R_prime=R_prime,
        alpha_p=alpha_p,
        length=wet.length,
        area=wet.area,
        Re_w=reynolds_number(density, speed, wet.length, viscosity),
        all_round=closed | (R_prime <= 0),
    )
