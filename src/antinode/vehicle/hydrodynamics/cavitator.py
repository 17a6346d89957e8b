"""Forces on a disk cavitator.

``F_x0 = (rho V^2 / 2) C_x S_n``, ``F_CX = F_x0 cos^2 alpha``, ``F_CY = F_x0 cos alpha sin alpha``,
at the angle ``alpha = theta + delta_n``. Drag is positive aft, lift up; positive alpha lifts.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 2-6.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .validity import Range

C_D0 = 0.82
"""Drag coefficient of a disk at sigma = 0 [-], eq. 3."""

DRAG_RANGE = Range(
    "disk drag, eq. 3",
    "sigma",
    0.0,
    1.2,
    "the usual range of C_D0 (1 + sigma) for a disk; the source gives none",
    "take the cavitator's force as an extrapolation",
)
ANGLE_RANGE = Range(
    "disk at an angle, eq. 5 and 6",
    "abs(alpha) [rad]",
    0.0,
    math.radians(50),
    "engineering choice: cos^2 holds while the flow leaves all round the edge of the disk; the "
    "source gives none",
    "reduce the cavitator's angle",
)


def drag_coefficient(sigma: Any) -> Any:
    """Drag coefficient C_x of a disk normal to the flow by eq. 3 [-].

    Parameters
    ----------
    sigma : array_like
        Cavitation number [-].
    """
    return C_D0 * (1 + sigma)


def disk_area(diameter: Any) -> Any:
    """Area S_n of the disk by eq. 4 [m^2].

    Parameters
    ----------
    diameter : array_like
        Diameter D_n [m].
    """
    return math.pi * diameter**2 / 4


def cavitator_forces(
    density: Any, speed: Any, sigma: Any, diameter: Any, alpha: Any
) -> tuple[Any, Any]:
    """Drag and lift of the cavitator by eq. 2-6.

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    speed : array_like
        Speed V [m/s].
    sigma : array_like
        Cavitation number [-].
    diameter : array_like
        Diameter D_n of the disk [m].
    alpha : array_like
        Angle of the disk, body angle plus cavitator angle [rad].

    Returns
    -------
    F_CX, F_CY : array_like
        Drag, positive aft, and lift, positive up [N].
    """
    F_x0 = density * speed**2 / 2 * drag_coefficient(sigma) * disk_area(diameter)
    return F_x0 * np.cos(alpha) ** 2, F_x0 * np.cos(alpha) * np.sin(alpha)
