"""How large, small and uneven the numbers of a file may be: beyond, they are of a wrong unit.

Within the limits no intermediate result overflows, and a solution does not take for ever.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from antinode.arrays import Array, Integers
from antinode.errors import AntinodeError, ComputationError, InputError

from .attachments import PointMass
from .beam import Beam
from .checks import ALLOWED
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
MOST_TENSION = 1e9
"""Largest square of the integral of sqrt(tension/EI): tension length^2 over bending stiffness."""
MOST_IN_SHEAR = 1e3
"""Axial force over the stiffness in shear: of a rubber bearing it is some ten."""
SAMPLES = (np.arange(32) + 0.5) / 32
"""Where intervals are sampled for both, as shares of their lengths."""


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
            f"x runs from {beam.x[0]:.12g} to {beam.x[-1]:.12g} m; a beam may be {low:g} to "
            f"{high:g} m long, and no further than that from x = 0: check the unit of x"
        )
    read = (table for family in FAMILIES.values() for table in (*family.tables, *family.more))
    for name in dict.fromkeys(read):
        values = getattr(beam, name)
        if values is not None and name != "axial_force":
            counted = np.abs(values[np.isfinite(values) & (values != 0)])
            if len(counted):
                _check_property(name, counted, name not in ALLOWED)
    _check_point_masses(beam)
    _check_axial_force(beam)
    _check_force_in_shear(beam)


def _check_point_masses(beam: Beam) -> None:
    masses = [item for item in beam.attachments if isinstance(item, PointMass)]
    if not masses:
        return
    own = replace(beam, attachments=()).mass
    for item in masses:
        if item.mass > MOST_POINT_MASS * own:
            raise InputError(
                f"the point mass of {item.mass:g} kg at x = {item.x:g} m is more than "
                f"{MOST_POINT_MASS:g} times the beam's: check its unit, or hold the beam there by "
                "a support"
            )


def _check_property(name: str, values: Array, evenly: bool) -> None:
    (low, high), smallest, largest = SIZES, np.min(values), np.max(values)
    if not (low <= smallest and largest <= high):
        raise InputError(
            f"{name} runs from {smallest:g} to {largest:g}; {low:g} to {high:g} is allowed: "
            "check its unit"
        )
    if evenly and largest > MOST_RATIO * smallest:
        raise InputError(
            f"{name} runs from {smallest:g} to {largest:g}; a ratio of at most {MOST_RATIO:g} is "
            "allowed: check each row's unit"
        )


def waves(N: Array, EI: Array, length: Array) -> tuple[Array, Array]:
    """Return about how many modes diverge, and tension times length squared over stiffness.

    Where N is in compression, sqrt(N/EI) is the wave number at omega^2 = 0: its integral over pi is
    the number of half waves. In tension it is the inverse length of the layers at the ends.

    Parameters
    ----------
    N, EI : array, shape (..., n, samples)
        At `SAMPLES` of n intervals [N, N m^2].
    length : array, shape (n,)
        Of the intervals [m].
    """
    buckled, pulled = (
        np.sum(np.mean(np.sqrt(np.maximum(force, 0.0) / EI), axis=-1) * length, axis=-1)
        for force in (N, -N)
    )
    return buckled / np.pi, pulled**2


def _check_axial_force(beam: Beam) -> None:
    """Refuse a force that is out of all proportion to the bending stiffness."""
    buckled = _waves_of(beam)[0]
    if not buckled <= MOST_BUCKLED:
        N = beam.axial_force_at(*_places(beam))
        raise InputError(
            f"the axial force of up to {np.max(N):.3g} N would make about {buckled:.0f} modes "
            f"diverge; at most {MOST_BUCKLED:g} are computed: check the units of axial force and "
            "bending_stiffness"
        )
    check_tension(beam)


def _check_force_in_shear(beam: Beam) -> None:
    """Refuse a force that is out of all proportion to the stiffness in shear."""
    if beam.shear_stiffness is None or not beam.has_shear or beam.is_unloaded:
        return
    N, kGA = (np.abs(each) for each in _in_shear(beam))
    share = N / kGA
    if np.any(share > MOST_IN_SHEAR):
        k = np.unravel_index(np.argmax(share), N.shape)
        raise InputError(
            f"the axial force of {N[k]:.3g} N in interval {k[0] + 1} is more than "
            f"{MOST_IN_SHEAR:g} times the stiffness in shear of {kGA[k]:.3g} N there: check the "
            "units of axial force and shear_stiffness (of a vehicle EA/4.9 unless it is given)"
        )


def _in_shear(beam: Beam) -> tuple[Array, Array]:
    """Return N and kGA [N] at the samples of all intervals."""
    places = _places(beam)
    return beam.axial_force_at(*places), beam.column_at("shear_stiffness", *places)


def check_tension(beam: Beam) -> None:
    """Refuse a tension whose layers at the ends are too thin for shapes.

    Raises
    ------
    InputError
        If it is more than `MOST_TENSION` times bending stiffness over length squared.
    """
    N, EI = beam.axial_force, beam.bending_stiffness
    if not beam.axial_acceleration and -N.min() * beam.length**2 <= MOST_TENSION * EI.min():
        return
    tension, N = _waves_of(beam)[1], beam.axial_force_at(*_places(beam))
    if not tension <= MOST_TENSION:
        raise InputError(
            f"the tension of up to {-np.min(N):.3g} N is about {tension:.2g} times "
            f"bending_stiffness over length squared; at most {MOST_TENSION:g} is computed with "
            "shapes: check their units; if they are right, it is a string, f_k = k/(2 L) "
            "sqrt(tension/m); natural_frequencies in Python solves without shapes"
        )


def _waves_of(beam: Beam) -> tuple[float, float]:
    """Return `waves` of a beam."""
    interval, fraction = _places(beam)
    N = beam.axial_force_at(interval, fraction)
    EI = beam.column_at("bending_stiffness", interval, fraction)
    buckled, tension = waves(N, EI, np.diff(beam.x))
    return float(buckled), float(tension)


def _places(beam: Beam) -> tuple[Integers, Array]:
    """Return where a beam is sampled: intervals, and shares of their lengths."""
    return np.arange(len(beam.x) - 1)[:, None], SAMPLES[None]
