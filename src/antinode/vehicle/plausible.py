"""Numbers that hardly any vehicle has: a unit was likely missed.

Its mean density lies between those of foam and tungsten, its section is no wider than the body, its
fins reach no further than half its length, and it is slower than sound in the water.

Source: the speed of sound in fresh water of 20 C, 1482 m/s (Marczak, J. Acoust. Soc. Am. 102, 2776,
1997); the formulas of the forces are for a liquid of constant density.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.inputs.columns import dropped_row
from antinode.inputs.reading import COLUMN_UNITS

from .load_warnings import LoadWarning
from .numbers import ManyCases

DENSITIES = 100.0, 2e4
"""Mean density of a body [kg/m^3]: foam, and tungsten (19,300)."""
LIQUIDS = 400.0, 2e4
"""Density of liquids [kg/m^3]: below that of propane, and above mercury's."""
SPEED_OF_SOUND = 1482.0
"""In fresh water of 20 C [m/s]."""


def doubtful_vehicles(
    cases: ManyCases, mass: Array, counted: npt.NDArray[np.bool_]
) -> tuple[LoadWarning, ...]:
    """Return where the numbers of cases may be not of this world; those counted are concerned.

    Parameters
    ----------
    cases : ManyCases
    mass : array (cases,)
        Of the bodies [kg].
    counted : array of bool (cases,)
    """
    every = (
        *_last_row(cases),
        *_depth(cases),
        _water(cases),
        _density(cases, mass),
        _section(cases),
        *_fins(cases),
        _speed(cases),
    )
    return tuple(replace(warning, concerns=warning.concerns & counted) for warning in every)


def _last_row(cases: ManyCases) -> Iterator[LoadWarning]:
    """Tell of a stepped table that does not use its last row although it differs."""
    table, columns = cases.vehicle.stations, []
    for name in COLUMN_UNITS:
        column = getattr(table, name, None)
        states = column.values() if isinstance(column, dict) else (column,)
        columns += [(name, state) for state in states if name != "x" and state is not None]
    told = dropped_row(cases.vehicle.interpolation, table.x, columns, {})
    if told:
        none, text = np.zeros(cases.cases), f"{told[0].upper()}{told[1:]}."
        yield LoadWarning(text, "rows", none, 0.0, 0.0, none == 0, lambda _: text)


def _depth(cases: ManyCases) -> Iterator[LoadWarning]:
    """Tell that a depth does nothing beside a cavitation number."""
    given = cases.condition
    if given.cavitation_number is not None and given.depth is not None:
        none = np.zeros(cases.cases)
        text = (
            "The cavitation number is given, and alone makes the cavity: the depth changes nothing "
            "but the pressure that it implies in it; leave cavitation_number out to have it follow "
            "from the depth."
        )
        yield LoadWarning(text, "depth [m]", none, 0.0, 0.0, none == 0, lambda _: text)


def _water(cases: ManyCases) -> LoadWarning:
    value, (low, high) = cases.number("water", "density"), LIQUIDS
    rest = f"no liquid's, {low:g} to {high:g} kg/m^3: check the unit of water.density [kg/m^3]."
    return LoadWarning(
        f"The density of the water is {rest}",
        "density of the water [kg/m^3]",
        value,
        low,
        high,
        (value < low) | (value > high),
        lambda k: f"The density of the water, {value[k]:.4g} kg/m^3, is {rest}",
    )


def _density(cases: ManyCases, mass: Array) -> LoadWarning:
    value, (low, high) = mass / _volume(cases), DENSITIES
    rest = (
        f"{low:g} to {high:g} kg/m^3 is usual: check the units of mass_per_length [kg/m, not the "
        "kg of each piece] and radius [m]."
    )
    return LoadWarning(
        f"The mean density of the body is unusual, {rest}",
        "mean density of the body [kg/m^3]",
        value,
        low,
        high,
        (value < low) | (value > high),
        lambda k: f"The mean density of the body is {value[k]:.4g} kg/m^3, {rest}",
    )


def _volume(cases: ManyCases) -> float:
    """Return the volume of the body [m^3]: cones between the stations."""
    profile = cases.vehicle.radius_profile
    a, b = profile.ends.T
    return math.pi / 3 * float(np.diff(profile.x) @ (a * a + a * b + b * b))


def _section(cases: ManyCases) -> LoadWarning:
    """Doubt a stiffness whose material would lie outside the body."""
    EI, EA = cases.column("bending_stiffness"), cases.column("axial_stiffness")
    value = np.broadcast_to(np.sqrt(np.max(EI / EA, axis=-1)), cases.cases)
    R = float(np.max(cases.vehicle.stations.radius))
    rest = (
        f"larger than the body's radius of {R:.4g} m: check the units of bending_stiffness "
        "[N m^2, not N mm^2], axial_stiffness [N] and radius [m]."
    )
    return LoadWarning(
        f"The section's radius of gyration sqrt(EI/EA) is {rest}",
        "radius of gyration sqrt(EI/EA) [m]",
        value,
        0.0,
        R,
        value > R,
        lambda k: f"The section's radius of gyration sqrt(EI/EA) is {value[k]:.4g} m, {rest}",
    )


def _fins(cases: ManyCases) -> Iterator[LoadWarning]:
    """Doubt fins that reach further out than the body is long, both ways together."""
    length = cases.vehicle.length
    rest = (
        f"on a body {length:.4g} m long: check the unit of tip_radius, the distance of the fin's "
        "tip from the body's axis [m]."
    )
    for number in range(len(cases.vehicle.fins)):
        yield _fin(number + 1, cases.number("vehicle", "fins", number, "tip_radius"), length, rest)


def _fin(number: int, tip: Array, length: float, rest: str) -> LoadWarning:
    return LoadWarning(
        f"The fins of set {number} reach unusually far out {rest}",
        "tip_radius of the fins [m]",
        tip,
        0.0,
        length / 2,
        tip > length / 2,
        lambda k: f"The fins of set {number} reach {tip[k]:.4g} m out {rest}",
    )


def _speed(cases: ManyCases) -> LoadWarning:
    V = cases.number("condition", "speed")
    rest = (
        f"faster than sound in water, {SPEED_OF_SOUND:g} m/s: no formula here knows of a liquid "
        "that is compressed; check the unit of speed [m/s]."
    )
    return LoadWarning(
        f"The body is {rest}",
        "speed [m/s]",
        V,
        0.0,
        SPEED_OF_SOUND,
        V > SPEED_OF_SOUND,
        lambda k: f"The body moves at {V[k]:.5g} m/s, {rest}",
    )
