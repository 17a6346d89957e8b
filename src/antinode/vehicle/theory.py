"""What Timoshenko's theory asks of a body besides: kGA and rho I, of one case or of many.

kGA is that of the stations, or EA/(4 + 3 nu), that of a thin tube of nu = 0.3; rho I that of the
stations, or m times the square of the radius of gyration: of the stations, the hull, or
sqrt(EI/EA). It runs straight between the bounds of the intervals of the masses.

Source of the tube: Cowper, J. Appl. Mech. 33 (1966) 335.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Interpolation
from antinode.beam.checks import ShearForm
from antinode.beam.mass import MassDistribution
from antinode.beam.profile import Profile
from antinode.beam.sections.shapes import THIN_TUBE

from .options import Model
from .vehicle import Vehicle

Column = Callable[[str], Array | None]
"""A column of the stations by its name, (rows,) or (cases, rows); None where there is none."""


class Sheared(NamedTuple):
    """Shear and rotary inertia between the bounds of the masses' intervals.

    Leading dimensions are cases.
    """

    stiffness: Profile
    """kGA [N]."""
    rotary: Profile
    """rho I [kg m]."""
    form: ShearForm


def sheared(
    vehicle: Vehicle, model: Model, masses: MassDistribution, column: Column
) -> Sheared | None:
    """Return what shear and rotary inertia a body has; None in Euler-Bernoulli's theory.

    Parameters
    ----------
    vehicle : Vehicle
    model : Model
        Its theory, and how the axial force and shear meet.
    masses : MassDistribution
        All of its mass.
    column : callable
        Returns columns of its stations.
    """
    if model.theory == "euler_bernoulli":
        return None
    straight: Interpolation = "step" if masses.interpolation == "step" else "linear"
    kGA, rotary = column("shear_stiffness"), column("rotary_inertia_per_length")
    if kGA is None:
        kGA = _known(column, "axial_stiffness") / THIN_TUBE
    ends = Profile.of_rows(vehicle.stations.x, kGA, vehicle.interpolation).between(masses.x)
    if rotary is None:
        turning = masses.ends * _squared_radius(vehicle, masses.x, column)
    else:
        own: Interpolation = "step" if vehicle.interpolation == "step" else "linear"
        turning = Profile.of_rows(vehicle.stations.x, rotary, own).between(masses.x)
    return Sheared(
        Profile(masses.x, ends, masses.interpolation),
        Profile(masses.x, turning, straight),
        model.shear_form,
    )


def _squared_radius(vehicle: Vehicle, x: Array, column: Column) -> Array:
    """Return the square of the radius of gyration at both ends of intervals [m^2]."""
    given = radius_of_gyration(vehicle, x)
    if given is not None:
        return given**2
    rows, how = vehicle.stations.x, vehicle.interpolation
    EI, EA = (
        Profile.of_rows(rows, _known(column, name), how).between(x)
        for name in ("bending_stiffness", "axial_stiffness")
    )
    return np.asarray(EI / EA)


def radius_of_gyration(vehicle: Vehicle, x: Array) -> Array | None:
    """Return the radius of gyration of the cross-section: as given, or of the hull's tube [m].

    ``r^2 = (R^2 + (R - t)^2)/4`` with outer radius R and wall t; None if neither is given (the beam
    then takes sqrt(EI/EA)).

    Parameters
    ----------
    x : array, shape (n + 1,)
        Bounds of intervals [m]; values are those at both ends of each, shape (n, 2).
    """
    own, wall = vehicle.radial("radius_of_gyration"), vehicle.radial("wall")
    if own is not None:
        return own.between(x)
    if wall is None:
        return None
    radius = vehicle.radius_profile.between(x)
    inner = np.maximum(radius - wall.between(x), 0.0)
    return np.asarray(np.sqrt((radius**2 + inner**2) / 4))


def _known(column: Column, name: str) -> Array:
    found = column(name)
    assert found is not None
    return found
