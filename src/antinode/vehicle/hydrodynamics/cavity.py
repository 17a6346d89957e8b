"""The cavity behind a disk: size, shape, and where its axis runs.

``D_c = D_n sqrt(C_D0 (1+sigma)/sigma)``, ``L_c = D_n sqrt(C_D0 (1+sigma)/sigma^2 ln(1/sigma))``,
``R_c = sqrt(xbar (2-xbar) (D_c^2-D_n^2) + D_n^2) / 2``, ``xbar = 2 x / L_c``; none behind L_c.
The cavity axis runs ``theta x + h_g - h_sigma`` above the body axis: up by buoyancy, away from the
cavitator's lift; nose-up theta, lift and offset are positive.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 7-13. As printed, eq. 10 has no dimension; the length
that makes it one is a model option.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from antinode.vehicle.options import Model

from .cavitator import drag_coefficient
from .course import Course, rise_by_buoyancy
from .validity import Range

SIZE_RANGE = Range(
    "cavity of a disk, eq. 7-9",
    "sigma",
    0.005,
    0.1,
    "engineering choice: the formulas are asymptotic for slender cavities (length over diameter "
    "about 5 at 0.1), and below 0.005 a cavity some 400 disks long is hardly steady; the source "
    "gives none",
    "take the cavity's size as an extrapolation",
)
RISE_RANGE = Range(
    "gravity rise, eq. 10",
    "Fr_L",
    2.0,
    math.inf,
    "engineering choice: below 2 the rise is no longer small against the cavity's length; the "
    "source gives none",
    "raise the speed or the cavitation number, or take the rise as an extrapolation",
)
DISTORTION_RANGE = Range(
    "distortion by the cavitator's angle, eq. 13",
    "abs(alpha) [rad]",
    0.0,
    math.radians(20),
    "engineering choice: linear in the angle, where the lift goes with sin cos (8 % less at "
    "20 deg); the source gives none",
    "take the cavity's offset as an extrapolation, or reduce the cavitator's angle",
)


def maximum_diameter(D_n: Any, sigma: Any) -> Any:
    """Largest diameter D_c of the cavity by eq. 7 [m], from D_n [m] and sigma [-]."""
    return D_n * np.sqrt(drag_coefficient(sigma) / sigma)


def cavity_length(D_n: Any, sigma: Any) -> Any:
    """Length L_c of the cavity by eq. 8 [m], from D_n [m] and sigma [-]."""
    return D_n * np.sqrt(drag_coefficient(sigma) / sigma**2 * np.log(1 / sigma))


def froude_number(speed: Any, gravity: Any, L_c: Any) -> Any:
    """Froude number Fr_L of the cavity length by eq. 12 [-]; infinite without gravity.

    Parameters
    ----------
    speed : array_like
        V [m/s].
    gravity : array_like
        g [m/s^2].
    L_c : array_like
        Cavity length [m].
    """
    with np.errstate(divide="ignore"):
        return np.divide(speed, np.sqrt(gravity * L_c))


def rise_by_paper(x_bar: Any, sigma: Any, Fr_L: Any) -> Any:
    """Rise of the cavity axis by gravity, eq. 10, over the reference length [-].

    Parameters
    ----------
    x_bar : array_like
        Distance from the nose over half the cavity length, eq. 11 [-].
    sigma : array_like
        Cavitation number [-].
    Fr_L : array_like
        Froude number of the cavity length [-].
    """
    return (1 + sigma) / (4.5 * Fr_L**2) * x_bar**2 * x_bar


def distortion(x_bar: Any, sigma: Any, alpha: Any, R_n: Any) -> Any:
    """Shift h_sigma of the cavity axis away from the cavitator's lift by eq. 13 [m].

    Parameters
    ----------
    x_bar : array_like
        Distance from the nose over half the cavity length [-].
    sigma : array_like
        Cavitation number [-].
    alpha : array_like
        Angle of the disk [rad].
    R_n : array_like
        Radius of the disk [m].
    """
    return drag_coefficient(sigma) * alpha * R_n * (0.46 - sigma + x_bar)


@dataclass(frozen=True)
class Cavity:
    """A cavity and the course of its axis against the body's; or those of many conditions.

    The numbers of many conditions are arrays (cases,); places x may then have leading dimensions.

    Parameters
    ----------
    D_n : float or array
        Diameter of the disk [m].
    sigma : float or array
        Cavitation number [-].
    theta : float or array
        Angle of the body, nose-up positive [rad].
    alpha : float or array
        Angle of the disk [rad].
    D_c, L_c : float or array
        Largest diameter, and length from the nose to the closure [m].
    Fr_L : float or array
        Froude number of the cavity length [-].
    body_length : float
        Length of the body [m].
    model : Model
        The choices.
    """

    _varying: ClassVar[tuple[str, ...]] = ("D_n", "sigma", "theta", "alpha", "D_c", "L_c", "Fr_L")

    D_n: Any
    sigma: Any
    theta: Any
    alpha: Any
    D_c: Any
    L_c: Any
    Fr_L: Any
    body_length: float
    model: Model

    def take(self, rows: Any) -> Cavity:
        """Return the cavities of some cases."""
        return replace(self, **{name: getattr(self, name)[rows] for name in self._varying})

    def of(self, case: int) -> Cavity:
        """Return the cavity of one case, its numbers as floats."""
        numbers: dict[str, Any] = {name: float(getattr(self, name)[case]) for name in self._varying}
        return replace(self, **numbers)

    def seen_from(self, x: Any, deflection: Any, slope: Any) -> MovedCavity:
        """Return this cavity as a place on the body sees it that has moved, with what is near it.

        Parameters
        ----------
        x : float or array
            The place [m].
        deflection : float or array
            How far it has moved up [m].
        slope : float or array
            By how much the body's axis turned there, dY/dx: nose-down positive [rad].
        """
        numbers: dict[str, Any] = {f.name: getattr(self, f.name) for f in fields(Cavity)}
        numbers["theta"] = self.theta - slope
        return MovedCavity(**numbers, raised=slope * x - deflection)

    @cached_property
    def course(self) -> Course:
        """Radius and axis along the body, in a few numbers."""
        numbers = [self.L_c, 2 / self.L_c, (self.D_c**2 - self.D_n**2) / 4, self.D_n**2 / 4]
        straight = (self.distortion(self.L_c) - self.distortion(0.0)) / 2
        numbers += [-self.distortion(0.0), self.theta * self.L_c / 2 - straight]
        none = 0.0 * self.L_c
        if self.model.gravity_rise == "paper":
            numbers += [self._rise_scale * rise_by_paper(1.0, self.sigma, self.Fr_L)]
        elif self.model.gravity_rise == "none":
            numbers += [none]
        else:
            numbers += [none, self._rise_scale, self.Fr_L, self._last_station]
        return Course(np.array(np.broadcast_arrays(*numbers), dtype=float))

    def radius(self, x: ArrayLike) -> Any:
        """Return the cavity's radius R_c at `x` by eq. 9 [m]; 0 behind the closure."""
        return self.course.radius(np.asarray(x, dtype=float))

    def radius_slope(self, x: ArrayLike) -> Any:
        """Return dR_c/dx at `x` [-]; 0 behind the closure."""
        return self.course.radius_slope(np.asarray(x, dtype=float))

    def axis_offset(self, x: ArrayLike) -> Any:
        """Return cavity axis minus body axis at `x`, up positive [m].

        Behind the closure, where there is no cavity, it keeps the value at the closure.
        """
        return self.course.axis(np.asarray(x, dtype=float))

    def axis_slope(self, x: ArrayLike) -> Any:
        """Return the slope of the cavity axis against the body axis at `x` [-].

        Behind the closure it keeps the value at the closure.
        """
        return self.course.axis_slope(np.asarray(x, dtype=float))

    def gravity_rise(self, x: ArrayLike) -> Any:
        """Return the rise h_g at `x` of the chosen formula [m]."""
        x_bar = self._rise_station(x)
        if self.model.gravity_rise == "none":
            return 0 * x_bar
        if self.model.gravity_rise == "buoyancy":
            return self._rise_scale * rise_by_buoyancy(x_bar, self.Fr_L)
        return self._rise_scale * rise_by_paper(x_bar, self.sigma, self.Fr_L)

    def distortion(self, x: ArrayLike) -> Any:
        """Return the distortion h_sigma at `x` by eq. 13, or 0 if it is switched off [m]."""
        factor = self.model.distortion_factor if self.model.distortion == "paper" else 0.0
        x_bar = 2 * np.asarray(x, dtype=float) / self.L_c
        return factor * distortion(x_bar, self.sigma, self.alpha, self.D_n / 2)

    def _rise_station(self, x: ArrayLike) -> Any:
        """x_bar of the rise; "buoyancy" stops where the ellipsoid is as thin as the disk."""
        x_bar = 2 * np.asarray(x, dtype=float) / self.L_c
        return np.minimum(x_bar, self._last_station)

    @cached_property
    def _last_station(self) -> Any:
        if self.model.gravity_rise != "buoyancy":
            return 2.0
        return 1 + np.sqrt(1 - (self.D_n / self.D_c) ** 2)

    @cached_property
    def _rise_scale(self) -> Any:
        """The length that h_g is made with, times the factor [m]."""
        lengths = {
            "half_cavity": self.L_c / 2,
            "cavity": self.L_c,
            "cavitator": self.D_n,
            "body": self.body_length,
        }
        buoyancy = self.model.gravity_rise == "buoyancy"
        name = "half_cavity" if buoyancy else self.model.gravity_rise_length
        return self.model.gravity_rise_factor * lengths[name]


@dataclass(frozen=True)
class MovedCavity(Cavity):
    """A cavity seen from a place on a body that has moved a little: `Cavity.seen_from` makes it.

    Parameters
    ----------
    raised : float or array
        How far the cavity's axis lies above where its equations put it [m].
    """

    _varying: ClassVar[tuple[str, ...]] = (*Cavity._varying, "raised")

    raised: Any = 0.0

    @cached_property
    def course(self) -> Course:
        """Radius and axis along the body, as the place sees them."""
        numbers = [*super().course.numbers]
        numbers[4] = numbers[4] + self.raised
        return Course(np.array(np.broadcast_arrays(*numbers)))


def form_cavity(
    diameter: Any,
    sigma: Any,
    *,
    speed: Any,
    gravity: Any,
    body_length: float,
    body_angle: Any = 0.0,
    cavitator_angle: Any = 0.0,
    model: Model | None = None,
) -> Cavity:
    """Form the cavity of a disk in a condition, or in many: arrays of one shape.

    Parameters
    ----------
    diameter : array_like
        Diameter D_n of the disk [m].
    sigma : array_like
        Cavitation number [-].
    speed : array_like
        V [m/s].
    gravity : array_like
        g [m/s^2].
    body_length : float
        Length of the body [m].
    body_angle, cavitator_angle : array_like
        theta and delta_n [rad].
    model : Model, optional
        The choices.

    Returns
    -------
    Cavity
        The cavity.
    """
    L_c = cavity_length(diameter, sigma)
    return Cavity(
        D_n=diameter,
        sigma=sigma,
        theta=body_angle,
        alpha=body_angle + cavitator_angle,
        D_c=maximum_diameter(diameter, sigma),
        L_c=L_c,
        Fr_L=froude_number(speed, gravity, L_c),
        body_length=body_length,
        model=model or Model(),
    )
