"""How large, small and uneven the numbers of a file may be: beyond, they are of a wrong unit.

Within the limits no intermediate result overflows, and a solution does not take for ever.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from antinode.arrays import Array
from antinode.errors import AntinodeError, ComputationError, InputError

from .attachments import PointMass
from .beam import Beam
from .families import FAMILIES

LENGTHS = 1e-9, 1e9
"""Smallest and largest length of a beam, largest position [m]."""
SIZES = 1e-30, 1e30
"""Smallest and largest mass per length [kg/m], stiffness [N m^2, N], force [N]."""
MOST_RATIO = 1e12
"""Largest over smallest value of a property along the beam."""
MOST_POINT_MASS = 1e15
"""Largest point mass over the mass of the beam without them."""
MOST_BUCKLED = 12.0
"""Modes that the compression may make diverge, about."""
MOST_TENSION = 1e7
"""Largest tension times length squared over bending stiffness."""


@contextmanager
def out_of_range_is_an_error() -> Iterator[None]:
    """Compute without numpy's warnings; say what an overflow or a division by zero means."""
    with np.errstate(all="ignore"):
        try:
            yield
        except AntinodeError:
            raise
        except (ArithmeticError, np.linalg.LinAlgError) as error:
            raise ComputationError(
                f"a number is too large or too small to compute with ({error}); check the units of "
                "lengths, stiffness, mass and axial force"
            ) from error


def check_limits(beam: Beam) -> None:
    """Raise InputError if a number of the beam is beyond all reason."""
    low, high = LENGTHS
    if not low <= beam.length <= high or np.max(np.abs(beam.x)) > high:
        raise InputError(
            f"x runs from {beam.x[0]:g} to {beam.x[-1]:g} m; a beam may be {low:g} to {high:g} m "
            "long: check the unit of x"
        )
    for name in dict.fromkeys(table for family in FAMILIES.values() for table in family.tables):
        values = getattr(beam, name)
        if values is not None and name != "axial_force":
            _check_property(name, values)
    _check_point_masses(beam)
    _check_axial_force(beam)


def _check_point_masses(beam: Beam) -> None:
    own = replace(beam, attachments=()).mass
    for item in beam.attachments:
        if isinstance(item, PointMass) and item.mass > MOST_POINT_MASS * own:
            raise InputError(
                f"the point mass of {item.mass:g} kg at x = {item.x:g} m is more than "
                f"{MOST_POINT_MASS:g} times the beam's: check its unit, or hold the beam there by "
                "a support"
            )


def _check_property(name: str, values: Array) -> None:
    (low, high), smallest, largest = SIZES, np.min(values), np.max(values)
    if not (low <= smallest and largest <= high):
        raise InputError(
            f"{name} runs from {smallest:g} to {largest:g}; {low:g} to {high:g} is allowed: "
            "check its unit"
        )
    if largest > MOST_RATIO * smallest:
        raise InputError(
            f"{name} runs from {smallest:g} to {largest:g}; a ratio of at most {MOST_RATIO:g} is "
            "allowed: check each row's unit"
        )


def _check_axial_force(beam: Beam) -> None:
    """Refuse a force that is out of all proportion to the bending stiffness."""
    intervals = np.arange(len(beam.x) - 1)
    at_ends = [beam.axial_force_at(intervals, np.full(len(intervals), t)) for t in (0.0, 1.0)]
    most, least = np.max(at_ends, axis=0), np.min(at_ends, axis=0)

    def waves(force: Array) -> float:
        EI = np.min(beam.bending_stiffness, axis=1)
        return float(np.sum(np.sqrt(np.maximum(force, 0) / EI) * np.diff(beam.x)))

    buckled, tension = waves(most) / np.pi, waves(-least) ** 2
    if not buckled <= MOST_BUCKLED:
        raise InputError(
            f"the axial force of up to {np.max(most):g} N would make about {buckled:.0f} modes "
            f"diverge; at most {MOST_BUCKLED:g} are computed: check the units of axial force and "
            "bending_stiffness"
        )
    if not tension <= MOST_TENSION:
        raise InputError(
            f"the tension of up to {-np.min(least):g} N is {tension:.3g} times bending_stiffness "
            f"over length squared; at most {MOST_TENSION:g} is computed: check their units (this "
            "beam is a string)"
        )
