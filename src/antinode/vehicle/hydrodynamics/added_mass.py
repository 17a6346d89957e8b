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
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.profile import Profile

from .cavity import Cavity
from .wetted import wet_angle, wetted_width

_PANELS = 400  # of the part that may be wet
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


class AddedMass(NamedTuple):
    """Water that moves sideways with a part of the body.

    Attributes
    ----------
    name : str
        Which part.
    formula : str
        By its name.
    start, end : float
        Over which it is spread evenly [m].
    mass : float
        [kg].
    """

    name: str
    formula: str
    start: float
    end: float
    mass: float


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


def fin_mass(
    density: float, chord: float, immersion: Sequence[float], roll: Sequence[float], faces: int
) -> float:
    """Return the added mass of a set of fins that moves up and down [kg].

    A fin at the roll angle phi moves along its normal by ``abs(sin phi)`` of that, and so counts
    ``sin^2 phi`` of its wetted part.

    Parameters
    ----------
    chord : float
        [m].
    immersion, roll : sequence of float
        Of each fin: wetted length [m], roll angle [rad], 0 up.
    """
    span = np.sum(np.asarray(immersion) * np.sin(roll) ** 2)
    return float(plate(density, chord, faces=faces) * span)


def tail_mass(density: float, cavity: Cavity, body: Profile) -> float:
    """Return the added mass of the wetted part of the body aft of the cavity's middle [kg].

    Parameters
    ----------
    cavity : Cavity
        Of one case.
    body : Profile
        Radius of the body [m].
    """
    tail = float(body.x[-1])
    start = min(float(cavity.L_c) / 2, tail)
    inside = [float(x) for x in (*body.x, float(cavity.L_c)) if start < x < tail]
    edges = np.concatenate(
        [np.linspace(a, b, _PANELS + 1)[:-1] for a, b in pairwise([start, *inside, tail])]
        + [[tail]]
    )
    half = np.diff(edges)[:, None] / 2
    x = (edges[:-1, None] + half * (1 + _NODES)).ravel()
    strips = _strips(density, x, cavity, _radius(body, x))
    return float(np.sum(strips.reshape(len(half), -1) * half * _WEIGHTS))


def _radius(body: Profile, x: Array) -> Array:
    interval = np.clip(np.searchsorted(body.x, x) - 1, 0, len(body.x) - 2)
    share = (x - body.x[interval]) / np.diff(body.x)[interval]
    low, high = body.ends[interval].T
    return np.asarray(low + (high - low) * share)


def _strips(density: float, x: Array, cavity: Cavity, R: Array) -> Array:
    """Return the added mass per length at places [kg/m]."""
    angle = wet_angle(R, cavity.radius(x), cavity.axis_offset(x))
    part = wedge(density, wetted_width(R, angle, "projected"))
    closed = angle >= 2 * math.pi * (1 - 1e-12)
    return np.asarray(np.where(closed, circle(density, R), part))
