"""Drag and lift of fins that stand out of the cavity, each fin by itself.

``F_fX = C_fX (rho V^2 / 2) h_f d_f`` with ``C_fX = 0.185 (1 + 2 sigma)``, where h_f is the length
of the fin outside the cavity, between 0 and its span. A fin at the roll angle phi (0 up) has a
normal, taken upwards, whose vertical part is abs(sin(phi)): the fin meets the flow at
theta abs(sin(phi)) + deflection, and gives abs(sin(phi)) of its force as lift.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 14 and 15. The lift is a choice: a thin plate with an open
cavity on its back, pi/2 per radian and wetted area (Kirchhoff and Rayleigh).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .validity import Range

DRAG_RANGE = Range(
    "fin drag, eq. 15",
    "sigma",
    0.0,
    0.1,
    "engineering choice: thin wedges with an open cavity; the source gives none",
    "take the fins' drag as an extrapolation",
)
LIFT_RANGE = Range(
    "fin lift, thin plate",
    "abs(incidence) [rad]",
    0.0,
    0.26,
    "engineering choice: 15 deg, where the linear law is some 20 % above Rayleigh's",
    "reduce the body angle or the deflection",
)


def fin_drag_coefficient(sigma: Any) -> Any:
    """Drag coefficient C_fX of a fin by eq. 15 [-].

    Parameters
    ----------
    sigma : array_like
        Cavitation number [-].
    """
    return 0.185 * (1 + 2 * sigma)


def fin_drag(density: Any, speed: Any, sigma: Any, h_f: Any, d_f: Any) -> Any:
    """Drag of one fin by eq. 14 [N], positive aft.

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        V [m/s].
    sigma : array_like
        Cavitation number [-].
    h_f : array_like
        Immersed length of the fin [m].
    d_f : array_like
        Thickness of the fin [m].
    """
    return fin_drag_coefficient(sigma) * density * speed**2 / 2 * h_f * d_f


def fin_incidence(theta: Any, deflection: Any, roll_angle: Any) -> Any:
    """Angle at which a fin meets the flow, positive if the force on it has an upward part [rad].

    Parameters
    ----------
    theta : array_like
        Angle of the body, nose-up positive [rad].
    deflection : array_like
        Deflection, positive if it lifts, on either side of the body [rad].
    roll_angle : array_like
        Where the fin stands, 0 up, pi/2 starboard [rad].
    """
    return theta * np.abs(np.sin(roll_angle)) + deflection


def fin_lift(
    density: Any, speed: Any, lift_slope: Any, wetted_area: Any, incidence: Any, roll_angle: Any
) -> Any:
    """Lift of one fin, the vertical part of its normal force [N], up positive.

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        V [m/s].
    lift_slope : array_like
        Lift coefficient per radian, on the wetted area [1/rad].
    wetted_area : array_like
        Immersed length times chord [m^2].
    incidence : array_like
        Angle of `fin_incidence` [rad].
    roll_angle : array_like
        Where the fin stands [rad].
    """
    normal_force = density * speed**2 / 2 * lift_slope * wetted_area * incidence
    return normal_force * np.abs(np.sin(roll_angle))


def radial_immersion(
    root_radius: Any, tip_radius: Any, roll_angle: Any, offset: Any, R_c: Any
) -> Any:
    """Length of a radial fin outside the circle of the offset cavity [m], between 0 and the span.

    Parameters
    ----------
    root_radius, tip_radius : array_like
        Where the fin begins and ends, from the body axis [m].
    roll_angle : array_like
        Where the fin stands [rad].
    offset : array_like
        Cavity axis minus body axis, up positive [m].
    R_c : array_like
        Radius of the cavity [m]; 0 where there is none.
    """
    middle = offset * np.cos(roll_angle)
    half_chord = np.sqrt(np.maximum(np.square(R_c) - (offset * np.sin(roll_angle)) ** 2, 0))
    first = np.maximum(root_radius, middle - half_chord)
    last = np.minimum(tip_radius, middle + half_chord)
    return tip_radius - root_radius - np.maximum(last - first, 0)


def tip_immersion(root_radius: Any, tip_radius: Any, roll_angle: Any, offset: Any, R_c: Any) -> Any:
    """Distance of a fin's tip from the wall of the cavity [m], between 0 and the span.

    Parameters
    ----------
    root_radius, tip_radius : array_like
        Where the fin begins and ends, from the body axis [m].
    roll_angle : array_like
        Where the fin stands [rad].
    offset : array_like
        Cavity axis minus body axis, up positive [m].
    R_c : array_like
        Radius of the cavity [m]; 0 where there is none: the whole span is wet.
    """
    span = tip_radius - root_radius
    tip_up = tip_radius * np.cos(roll_angle) - offset
    distance = np.hypot(tip_up, tip_radius * np.sin(roll_angle)) - R_c
    return np.where(np.asarray(R_c) > 0, np.clip(distance, 0, span), span)
