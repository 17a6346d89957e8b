"""Planing of the afterbody on the wall of the cavity.

``F_PX = (rho V^2 / 2) C_PX A_w`` with ``C_PX = 0.031 Re_w^(-1/7)``,
``F_PY = pi rho R^2 V^2 [1 - (R'/(h'+R'))^2] (1+h')/(1+2h') alpha_p``, ``R' = (R_c - R)/R`` and
``h' = max(0, abs(offset)/R - R')`` at the tail. Where R' <= 0 or behind the closure the body is
wet all round: the bracket is 1. h' is at most 2. The force has the direction of the offset: cavity
axis above body axis wets the belly and pushes up. Drag is positive aft.

The wetted area is where the circle of the body (radius R) stands out of the circle of the cavity
(radius R_c), aft of the cavity's middle; the forces act at its centroid x_P. Where the wetted area
is measured across its chord, or the forces act at the tail, are options of the model.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 16 and 17. Eq. 16 as printed is singular at h' = R';
here it has the sign with which the bracket runs from 0 to 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.arrays import Array

from .cavity import Cavity
from .validity import Range

Radius = Callable[[Any], Array]

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


def wet_angle(R: Any, R_c: Any, offset: Any) -> Any:
    """Angle of the body circle that stands out of the cavity circle [rad], from 0 to 2 pi.

    Parameters
    ----------
    R : array_like
        Radius of the body [m].
    R_c : array_like
        Radius of the cavity [m].
    offset : array_like
        Distance between the centres, of either sign [m].
    """
    d = np.maximum(np.abs(offset), np.finfo(float).tiny / np.finfo(float).eps)
    cosine = np.clip((R**2 - R_c**2 + d**2) / d, -2 * R, 2 * R) / (2 * R)
    return 2 * np.arccos(-cosine)


def wetted_width(R: Any, angle: Any, area: str) -> Any:
    """Width of the wetted surface across the body [m].

    Parameters
    ----------
    R : array_like
        Radius of the body [m].
    angle : array_like
        Angle of the body circle outside the cavity [rad], from 0 to 2 pi.
    area : {"arc", "projected"}
        Along the arc, or its chord, which from half a circle on is the diameter.
    """
    if area == "arc":
        return R * angle
    return 2 * R * np.sin(np.minimum(angle, math.pi) / 2)


@dataclass(frozen=True)
class WettedSurface:
    """Wetted part of the body aft of the cavity's middle.

    Parameters
    ----------
    length : float
        Wetted length L_w [m].
    area : float
        Wetted area A_w [m^2].
    centroid : float
        x of the centroid x_P [m]; the tail if nothing is wet.
    """

    length: float
    area: float
    centroid: float


_SAMPLES = 256
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_S = (_NODES + 1) / 2
_T, _DT = _S**2 * (3 - 2 * _S), 3 * _S * (1 - _S) * _WEIGHTS
"""Gauss nodes and weights on 0...1, drawn to the ends, where the wet angle starts like a root."""


def wetted_surface(cavity: Cavity, radius: Radius, stations: Array) -> WettedSurface:
    """Integrate the wetted surface from the cavity's middle to the tail.

    Parameters
    ----------
    cavity : Cavity
        The cavity.
    radius : callable
        Radius of the body at x, both in [m].
    stations : ndarray
        Where the radius may jump or kink, from nose to tail [m].

    Returns
    -------
    WettedSurface
        Length, area and centroid.
    """
    tail = float(stations[-1])
    start = cavity.L_c / 2
    if start >= tail:
        return WettedSurface(0.0, 0.0, tail)
    inner = stations[(stations > start) & (stations < tail)]
    closure = [cavity.L_c] if cavity.L_c < tail else []
    cuts = np.unique(np.concatenate([[start, tail], inner, closure]))
    return _integrate(_split_at_contacts(cuts, cavity, radius), cavity, radius, tail)


def _integrate(pieces: Array, cavity: Cavity, radius: Radius, tail: float) -> WettedSurface:
    width = np.diff(pieces)[:, None]
    x = pieces[:-1, None] + width * _T
    R = radius(x)
    angle = wet_angle(R, cavity.radius(x), cavity.axis_offset(x))
    across = wetted_width(R, angle, cavity.model.planing_area)
    strips = width * _DT * across
    area = float(strips.sum())
    if area <= 0:
        return WettedSurface(0.0, 0.0, tail)
    length = float(width[across.any(axis=1)].sum())
    return WettedSurface(length, area, float((strips * x).sum() / area))


def _split_at_contacts(cuts: Array, cavity: Cavity, radius: Radius) -> Array:
    """Add the points where wetting starts or ends, and where the body leaves the cavity wholly."""

    def outside(x: Array) -> Array:
        return np.asarray(np.abs(cavity.axis_offset(x)) + radius(x) - cavity.radius(x))

    def around(x: Array) -> Array:
        gap = np.abs(radius(x) - np.abs(cavity.axis_offset(x))) - cavity.radius(x)
        return np.asarray(gap)

    count = max(4, -(-_SAMPLES // (len(cuts) - 1)))
    t = np.clip(np.linspace(0, 1, count + 1), 1e-12, 1 - 1e-12)
    grid = cuts[:-1, None] + np.diff(cuts)[:, None] * t
    return np.unique(np.concatenate([cuts, _roots(outside, grid), _roots(around, grid)]))


def _roots(function: Callable[[Array], Array], grid: Array) -> Array:
    """Bisect between neighbours on each row of the grid where the function changes its sign."""
    positive = function(grid) > 0
    change = positive[:, :-1] != positive[:, 1:]
    low, high, sign = grid[:, :-1][change], grid[:, 1:][change], positive[:, :-1][change]
    for _ in range(50 if low.size else 0):
        middle = (low + high) / 2
        left = (function(middle) > 0) == sign
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return np.asarray((low + high) / 2)


@dataclass(frozen=True)
class Planing:
    """The planing state and its forces.

    Parameters
    ----------
    F_PX, F_PY : float
        Drag, positive aft, and lift, positive up [N].
    x_P : float
        Where they act [m].
    h, R_prime : float
        Immersion h' and clearance R' at the tail [-].
    alpha_p : float
        Planing angle [rad].
    length, area : float
        Wetted length L_w [m] and area A_w [m^2].
    Re_w : float
        Reynolds number of the wetted length [-].
    all_round : bool
        Whether the tail is wetted all round: R' <= 0, or behind the closure.
    """

    F_PX: float
    F_PY: float
    x_P: float
    h: float
    R_prime: float
    alpha_p: float
    length: float
    area: float
    Re_w: float
    all_round: bool

    def without_force(self) -> Planing:
        """Return the same state with no forces."""
        return replace(self, F_PX=0.0, F_PY=0.0)


def planing_angle(cavity: Cavity, tail: float) -> float:
    """Planing angle alpha_p at the tail, or at the closure if that is ahead, by the model [rad].

    Parameters
    ----------
    cavity : Cavity
        The cavity, with its model.
    tail : float
        x of the tail [m].
    """
    if cavity.model.planing_angle == "attitude":
        return abs(cavity.theta)
    x = min(tail, cavity.L_c)
    axis = abs(float(cavity.axis_slope(x)))
    return axis if cavity.model.planing_angle == "axis" else axis + abs(cavity.radius_slope(x))


def planing_state(
    cavity: Cavity, radius: Radius, stations: Array, density: float, speed: float, viscosity: float
) -> Planing:
    """Work out the planing state and its forces.

    Parameters
    ----------
    cavity : Cavity
        The cavity.
    radius : callable
        Radius of the body at x, both in [m].
    stations : ndarray
        Where the radius may jump or kink, from nose to tail [m].
    density : float
        Density of the water [kg/m^3].
    speed : float
        V [m/s].
    viscosity : float
        Dynamic viscosity [Pa s].

    Returns
    -------
    Planing
        Forces, point of action and what they came from.
    """
    tail = float(stations[-1])
    wet = wetted_surface(cavity, radius, stations)
    x = min(tail, cavity.L_c)
    R, R_c, offset = float(radius(tail)), float(cavity.radius(x)), float(cavity.axis_offset(x))
    h, R_prime = float(immersion_ratio(offset, R_c, R)), clearance_ratio(R_c, R)
    alpha_p, all_round = planing_angle(cavity, tail), cavity.L_c < tail or R_prime <= 0
    size = planing_force(density, speed, R, h, R_prime, alpha_p, cavity.L_c < tail)
    drag = planing_drag(density, speed, wet.length, wet.area, viscosity)
    return Planing(
        F_PX=cavity.model.planing_drag_factor * float(drag),
        F_PY=float(size * direction(offset, R, cavity.model.planing_direction_width)),
        x_P=wet.centroid if cavity.model.planing_position == "centroid" else tail,
        h=h,
        R_prime=R_prime,
        alpha_p=float(alpha_p),
        length=wet.length,
        area=wet.area,
        Re_w=float(reynolds_number(density, speed, wet.length, viscosity)),
        all_round=all_round,
    )
