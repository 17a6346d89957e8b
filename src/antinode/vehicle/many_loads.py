"""Loads of many cases at once, eq. 1-20: one case is one row of these arrays.

What may vary: numbers of the condition, the water, the cavitator and the fins, and the columns of
mass and stiffness. A row is the same to the last bit whatever stands beside it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property, reduce
from typing import Generic, TypeVar

import numpy as np

from antinode.arrays import Array
from antinode.beam.mass import MassDistribution

from .balance import balance, mass_of
from .forces import FinLoads, Hydrodynamics, hydrodynamics
from .hydrodynamics.added_mass import AddedMass, Plates, added_masses
from .load_warnings import CheckedRange, LoadWarning, checked_ranges, load_warnings
from .numbers import ManyCases
from .plausible import doubtful_vehicles
from .refusals import NOT_FINITE, Refusals

T = TypeVar("T")

_BEYOND = (
    "the loads are too large or too small for numbers; check the case for values of a wrong unit"
)


@dataclass(frozen=True, eq=False)
class LoadNumbers(Generic[T]):
    """The numbers that describe the loads: floats of one case, arrays (cases,) of many.

    Parameters
    ----------
    sigma : float or array
        Cavitation number [-].
    cavity_length, cavity_diameter : float or array
        Of the cavity, the largest one [m].
    F_CX, F_CY : float or array
        Drag (aft) and lift (up) of the cavitator [N].
    F_fX, F_fY : float or array
        Drag (aft) and lift (up) of all fins [N].
    F_PX, F_PY : float or array
        Drag (aft) and lift (up) of planing [N].
    x_P : float or array
        Where the planing forces act [m].
    mass : float or array
        Mass of the body [kg].
    x_M : float or array
        Centre of mass [m].
    inertia : float or array
        Moment of inertia about the centre of mass [kg m^2].
    a_X, a_Y : float or array
        Accelerations of the centre of mass, forward and up positive [m/s^2].
    beta : float or array
        Angular acceleration, nose-up positive [rad/s^2].
    """

    sigma: T
    cavity_length: T
    cavity_diameter: T
    F_CX: T
    F_CY: T
    F_fX: T
    F_fY: T
    F_PX: T
    F_PY: T
    x_P: T
    mass: T
    x_M: T
    inertia: T
    a_X: T
    a_Y: T
    beta: T

    @property
    def numbers(self) -> dict[str, T]:
        """All of them by name."""
        return {f.name: getattr(self, f.name) for f in fields(LoadNumbers)}


@dataclass(frozen=True, eq=False)
class ManyLoads(LoadNumbers[Array]):
    """Loads of many cases.

    Parameters
    ----------
    cases : ManyCases
        What they are the loads of.
    refusals : Refusals
        Which cases have no loads, and why.
    hydrodynamics : Hydrodynamics
        Cavities, and forces but the thrust.
    mass_distribution : MassDistribution
        Mass along the axis, with a leading dimension where it varies among the cases.
    """

    cases: ManyCases
    refusals: Refusals
    hydrodynamics: Hydrodynamics
    mass_distribution: MassDistribution

    @cached_property
    def added_masses(self) -> tuple[AddedMass[Array], ...]:
        """Water that moves sideways with the bodies, part by part; none unless asked for."""
        cases, found = self.cases, self.hydrodynamics
        return tuple(
            added_masses(
                cases.model,
                cases.number("water", "density"),
                [_plates(cases, k, fin) for k, fin in enumerate(found.fins)],
                found.cavity,
                found.planing.length,
                cases.vehicle.radius_profile,
            )
        )

    @cached_property
    def ranges(self) -> tuple[CheckedRange, ...]:
        """Every range of validity that the cases touch, with their values."""
        return checked_ranges(self.cases, self.hydrodynamics, self.refusals.none)

    @cached_property
    def warnings(self) -> tuple[LoadWarning, ...]:
        """What is doubtful, with values and cases."""
        with np.errstate(all="ignore"):
            counted = self.refusals.none
            return (
                *doubtful_vehicles(self.cases, self.mass, counted),
                *load_warnings(self.cases, self.hydrodynamics, counted),
            )


def _plates(cases: ManyCases, k: int, fin: FinLoads) -> Plates:
    """Return a set of fins as what carries water along."""
    chord = cases.given("vehicle", "fins", k, "chord")
    if chord is None:
        tip = cases.number("vehicle", "fins", k, "tip_radius")
        chord = tip - cases.vehicle.radius_at(fin.position)
    return Plates(fin.position, chord, fin.immersion, cases.vehicle.fins[k].roll_angles)


def loads_of_many(cases: ManyCases) -> ManyLoads:
    """Work out the loads of many cases; those that cannot be are refused, each with its reason."""
    with np.errstate(all="ignore"):
        return _loads_of_many(cases, Refusals(cases.cases))


def _loads_of_many(cases: ManyCases, refusals: Refusals) -> ManyLoads:
    found = hydrodynamics(cases, refusals)
    thrust, g = cases.number("condition", "thrust"), cases.number("water", "gravity")
    mass = mass_of(cases)
    body = balance(mass, found.forces, thrust, g)
    none, hole, tail = np.zeros(cases.cases), found.cavity, found.planing
    loads = ManyLoads(
        **body._asdict(),
        sigma=hole.sigma,
        cavity_length=hole.L_c,
        cavity_diameter=hole.D_c,
        F_CX=found.forces[0].F_X,
        F_CY=found.forces[0].F_Y,
        F_fX=reduce(np.add, [fin.F_fX for fin in found.fins], none),
        F_fY=reduce(np.add, [fin.F_fY for fin in found.fins], none),
        F_PX=tail.F_PX,
        F_PY=tail.F_PY,
        x_P=tail.x_P,
        cases=cases,
        refusals=refusals,
        hydrodynamics=found,
        mass_distribution=mass,
    )
    finite = np.all(np.isfinite([*loads.numbers.values()]), axis=0)
    refusals.refuse(~finite, NOT_FINITE, lambda _: _BEYOND)
    return loads
