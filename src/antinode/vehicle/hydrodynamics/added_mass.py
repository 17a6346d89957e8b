"""Added mass of what the water wets: fins and planing tail, strip by strip, as they move sideways.

- ``plate``: a flat plate of chord c that moves along its normal in open water carries
  ``rho pi c^2/4`` per length of span (Lamb, Hydrodynamics, 6th ed. 1932, art. 71: a circular
  cylinder about the chord); ``plate_one_face`` half of that, where a cavity covers its back.
- ``wedge``: a strip of the tail whose wetted part is b wide carries ``rho pi b^2/8``, half a plate
  (von Karman, The impact on seaplane floats during landing, NACA TN 321, 1929); wetted all round,
  where there is no cavity, ``rho pi R^2``.

Strips know nothing of the ends of a span, past which water escapes: they are an upper bound for
short fins. The cavity keeps its pressure and its place, and the flow past the body adds nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from antinode.arrays import Array, at_station
from antinode.beam.profile import Profile
from antinode.vehicle.options import Model

from .cavity import Cavity
from .wetted import wet_integral, wetted_width

T = TypeVar("T")
_SHORTEST = 1e-9  # wetted length over that of the body
_FORMULAS: dict[str, tuple[str, int]] = {
    "plate": ("plate, rho pi c^2/4", 2),
    "plate_one_face": ("plate with a cavity behind, rho pi c^2/8", 1),
}


class AddedMass(NamedTuple, Generic[T]):
    """Water that moves sideways with a part of the body: of one case, or arrays of many.

    Attributes
    ----------
    name : str
        Which part.
    formula : str
        By its name.
    start, end : float or array
        Over which it is spread evenly [m].
    mass : float or array
        [kg].
    """

    name: str
    formula: str
    start: T
    end: T
    mass: T

    def of(self, case: int) -> AddedMass[float]:
        """Return that of one of many cases."""
        numbers = (float(np.asarray(v)[case]) for v in (self.start, self.end, self.mass))
        return AddedMass(self.name, self.formula, *numbers)

    @property
    def per_length(self) -> Any:
        """[kg/m]; 0 where there is none."""
        length = np.asarray(self.end) - np.asarray(self.start)
        return np.where(length > 0, self.mass / np.where(length > 0, length, 1.0), 0.0)


class Plates(NamedTuple):
    """A set of fins in many cases.

    Attributes
    ----------
    position, chord : array (cases,)
        [m].
    immersion : array (fins, cases)
        Wetted length of each fin [m].
    roll : sequence of float
        Roll angle of each fin [rad], 0 up.
    """

    position: Array
    chord: Array
    immersion: Array
    roll: Sequence[float]


def added_masses(
    model: Model,
    density: Array,
    fins: Sequence[Plates],
    cavities: Cavity,
    planing_length: Array,
    body: Profile,
) -> Iterator[AddedMass[Array]]:
    """Yield the added mass of every set of fins, and of the planing tail, that the model counts.

    Parameters
    ----------
    model : Model
    density : array (cases,)
        Density of the water [kg/m^3].
    fins : sequence of Plates
    cavities : Cavity
        The cavities, their numbers arrays (cases,).
    planing_length : array (cases,)
        Wetted length of the tail [m].
    body : Profile
        Radius of the body [m].
    """
    tail = float(body.x[-1])
    if model.fin_added_mass != "none":
        formula, faces = _FORMULAS[model.fin_added_mass]
        for k, fin in enumerate(fins, 1):
            mass = fin_mass(density, fin.chord, fin.immersion, fin.roll, faces)
            start = at_station(body.x, np.maximum(fin.position - fin.chord / 2, 0.0))
            end = at_station(body.x, np.minimum(fin.position + fin.chord / 2, tail))
            yield AddedMass(f"fin set {k}", formula, start, end, mass)
    if model.planing_added_mass != "none":
        wet = planing_length > _SHORTEST * tail
        start = at_station(body.x, np.where(wet, tail - planing_length, tail))
        mass = np.where(wet, tail_mass(density, cavities, body), 0.0)
        yield AddedMass("tail", "wedge, rho pi b^2/8", start, np.full(len(wet), tail), mass)


def plate(density: Any, chord: Any, *, faces: int = 2) -> Any:
    """Return the added mass of a plate that moves along its normal, per length of span [kg/m].

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    chord : array_like
        c [m].
    faces : int
        That are wet: 2, or 1 with a cavity behind.
    """
    return density * math.pi * np.square(chord) / 4 * (faces / 2)


def wedge(density: Any, width: Any) -> Any:
    """Return the added mass of a strip whose wetted part is so wide, per length [kg/m].

    Parameters
    ----------
    density : array_like
        Density of the water [kg/m^3].
    width : array_like
        b across the body [m].
    """
    return density * math.pi * np.square(width) / 8


def circle(density: Any, radius: Any) -> Any:
    """Return that of a circle that is wet all round, per length [kg/m], from its radius [m]."""
    return density * math.pi * np.square(radius)


def fin_mass(density: Any, chord: Any, immersion: Any, roll: Sequence[float], faces: int) -> Any:
    """Return the added mass of a set of fins that moves up and down [kg].

    A fin at the roll angle phi moves along its normal by ``abs(sin phi)`` of that, and so counts
    ``sin^2 phi`` of its wetted part.

    Parameters
    ----------
    density, chord : float or array (cases,)
        [kg/m^3], [m].
    immersion : array_like (fins,) or (fins, cases)
        Of each fin: wetted length [m].
    roll : sequence of float
        Of each fin: roll angle [rad], 0 up.
    """
    span = np.tensordot(np.sin(roll) ** 2, np.asarray(immersion), 1)
    return plate(density, chord, faces=faces) * span


def tail_mass(density: Array, cavities: Cavity, body: Profile) -> Array:
    """Return the added mass of the wetted part of bodies aft of the cavities' middles [kg].

    Parameters
    ----------
    density : array (cases,)
        Density of the water [kg/m^3].
    cavities : Cavity
        The cavities, their numbers arrays (cases,).
    body : Profile
        Radius of the body, the same for all cases [m].
    """
    return density * wet_integral(cavities, body, _strips)


def _strips(R: Array, angle: Array) -> Array:
    """Return the added mass per length and density [m^2]."""
    part = wedge(1.0, wetted_width(R, angle, "projected"))
    return np.asarray(np.where(angle >= 2 * math.pi * (1 - 1e-12), circle(1.0, R), part))
