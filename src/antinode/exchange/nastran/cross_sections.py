"""Cross-sections by their type and dimensions, as PBARL and PBEAML give them.

Each is a sum of rectangles of width b along z and height h along y, or a circle or hexagon:
`A = sum b h`, `I1 = sum (b h^3/12 + b h y^2)` about the neutral axis (bending in plane 1, along
y), I2 with b and h exchanged, `I12 = sum b h y z`. Types and dimensions: MSC Nastran Quick
Reference Guide, entries PBARL and PBEAML.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array

from .shear_torsion import (
    cells_in_torsion,
    rectangle_in_torsion,
    shear_factor,
    shear_factor_of_ring,
)


class CrossSection(NamedTuple):
    """Area, second moments about the neutral axes, torsion (0 if not known), shear factors."""

    A: float
    I1: float
    I2: float
    I12: float
    J: float
    K1: float
    K2: float


class Rectangle(NamedTuple):
    """Of width b along z and height h along y, centred at y, z; a hole counts -1."""

    b: float
    h: float
    y: float = 0.0
    z: float = 0.0
    sign: int = 1


Shape = Callable[..., list[Rectangle]]


def cross_section(kind: str, dimensions: Sequence[float], nu: float = 0.3) -> CrossSection:
    """Return the properties of a cross-section.

    Parameters
    ----------
    kind : str
        One of `DIMENSIONS`.
    dimensions : sequence of float
    nu : float
        Poisson's ratio: the shear factor of circles depends on it.

    Raises
    ------
    ValueError
        If the dimensions do not fit together.
    """
    d = list(dimensions)
    if kind in _ROUND:
        outer, inner = _ROUND[kind](*d)
        if not 0 <= inner < outer:
            raise ValueError("its radii do not fit together")
        inertia = math.pi / 4 * (outer**4 - inner**4)
        area, K = math.pi * (outer**2 - inner**2), shear_factor_of_ring(outer, inner, nu)
        return CrossSection(area, inertia, inertia, 0.0, 2 * inertia, K, K)
    if kind == "HEXA":
        return _hexagon(*d)
    parts = _RECTANGLES[kind](*d)
    own = _sum(parts)
    closed = _CELLS.get(kind)
    J = closed(*d) if closed else sum(rectangle_in_torsion(p.b, p.h) for p in parts)
    return own._replace(J=J)


def _sum(parts: list[Rectangle]) -> CrossSection:
    b, h, y, z, sign = np.array(parts).T
    if np.any(b < 0) or np.any(h < 0):
        raise ValueError("its dimensions do not fit together")
    area = sign * b * h
    A = float(np.sum(area))
    if not A > 0:
        raise ValueError("its area is not positive")
    y, z = y - np.sum(area * y) / A, z - np.sum(area * z) / A
    I1 = float(np.sum(area * (h**2 / 12 + y**2)))
    I2 = float(np.sum(area * (b**2 / 12 + z**2)))
    K1, K2 = _shear(y, h, sign * b), _shear(z, b, sign * h)
    return CrossSection(A, I1, I2, float(np.sum(area * y * z)), 0.0, K1, K2)


def _shear(middle: Array, along: Array, across: Array) -> float:
    """Return the shear factor of rectangles, in the direction of their sides `along`."""
    ends = np.stack([middle - along / 2, middle + along / 2])
    at = np.unique(np.round(ends, 15 - int(np.ceil(np.log10(np.max(np.abs(ends)))))))
    inside = (at[:-1, None] + at[1:, None]) / 2
    there = (ends[0] < inside) & (inside < ends[1])
    width = np.sum(np.where(there, across, 0.0), axis=1)
    if np.any(width <= 0):
        raise ValueError("its parts do not hang together")
    return shear_factor(at, np.stack([width, width], axis=1))


def _hexagon(d1: float, d2: float, d3: float) -> CrossSection:
    """Corners d1 from the top edge's ends, width d2, height d3."""
    flat = d2 - 2 * d1
    if not (d1 >= 0 and flat >= 0 and d3 > 0):
        raise ValueError("its dimensions do not fit together")
    corner = d1 * d3 / 2
    y = np.array([-d3 / 2, 0.0, d3 / 2])
    z = np.array([-d2 / 2, -flat / 2, flat / 2, d2 / 2])
    sides = np.array([[0.0, d3], [d3, d3], [d3, 0.0]])
    kept = np.diff(z) > 0
    return CrossSection(
        flat * d3 + 2 * corner,
        flat * d3**3 / 12 + d1 * d3**3 / 24,
        d3 * flat**3 / 12 + 2 * corner * (d1**2 / 18 + (flat / 2 + d1 / 3) ** 2),
        0.0,
        0.0,
        shear_factor(y, np.array([[flat, d2], [d2, flat]])),
        shear_factor(np.append(z[:-1][kept], z[-1]), sides[kept]),
    )


def _bar(d1: float, d2: float) -> list[Rectangle]:
    return [Rectangle(d1, d2)]


def _box(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    return [Rectangle(d1, d2), Rectangle(d1 - 2 * d4, d2 - 2 * d3, sign=-1)]


def _box1(
    d1: float, d2: float, top: float, bottom: float, left: float, right: float
) -> list[Rectangle]:
    y, z = (bottom - top) / 2, (left - right) / 2
    return [Rectangle(d1, d2), Rectangle(d1 - left - right, d2 - top - bottom, y, z, -1)]


def _dbox(*d: float) -> list[Rectangle]:
    """Two cells: width, height, middle web's place, webs d4 d5 d6, plates d7 to d10."""
    d1, d2, d3, left, middle, right, *plates = d
    b = d3 - left - middle / 2, d1 - d3 - middle / 2 - right
    z = left + b[0] / 2, d3 + middle / 2 + b[1] / 2
    cells = [
        Rectangle(b[k], d2 - top - bottom, (bottom - top) / 2, z[k] - d1 / 2, -1)
        for k, (top, bottom) in enumerate((plates[:2], plates[2:]))
    ]
    return [Rectangle(d1, d2), *cells]


def _i(
    height: float, bottom: float, top: float, web: float, t_bottom: float, t_top: float
) -> list[Rectangle]:
    inner = height - t_bottom - t_top
    return [
        Rectangle(bottom, t_bottom, t_bottom / 2),
        Rectangle(top, t_top, height - t_top / 2),
        Rectangle(web, inner, t_bottom + inner / 2),
    ]


def _i1(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    flange = (d4 - d3) / 2
    return _i(d4, d1 + d2, d1 + d2, d2, flange, flange)


def _chan(d1: float, d2: float, web: float, flange: float) -> list[Rectangle]:
    y, z = (d2 - flange) / 2, d1 / 2
    return [
        Rectangle(web, d2 - 2 * flange, 0.0, web / 2),
        Rectangle(d1, flange, y, z),
        Rectangle(d1, flange, -y, z),
    ]


def _chan1(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    return _chan(d1 + d2, d4, d2, (d4 - d3) / 2)


def _chan2(leg: float, base: float, height: float, width: float) -> list[Rectangle]:
    y, z = base + (height - base) / 2, (width - leg) / 2
    return [
        Rectangle(width, base, base / 2),
        Rectangle(leg, height - base, y, z),
        Rectangle(leg, height - base, y, -z),
    ]


def _t(d1: float, d2: float, flange: float, web: float) -> list[Rectangle]:
    return [Rectangle(d1, flange), Rectangle(web, d2 - flange, -d2 / 2)]


def _t1(d1: float, d2: float, flange: float, web: float) -> list[Rectangle]:
    return [Rectangle(flange, d1), Rectangle(d2, web, 0.0, -(flange + d2) / 2)]


def _cross(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    z = d2 / 2 + d1 / 4
    return [Rectangle(d2, d3), Rectangle(d1 / 2, d4, 0.0, z), Rectangle(d1 / 2, d4, 0.0, -z)]


def _h(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    z = d1 / 2 + d2 / 4
    return [Rectangle(d1, d4), Rectangle(d2 / 2, d3, 0.0, z), Rectangle(d2 / 2, d3, 0.0, -z)]


def _z(d1: float, d2: float, d3: float, d4: float) -> list[Rectangle]:
    flange = (d4 - d3) / 2
    y, z = (d3 + flange) / 2, (d1 + d2) / 2
    return [Rectangle(d2, d4), Rectangle(d1, flange, y, -z), Rectangle(d1, flange, -y, z)]


def _l(d1: float, d2: float, leg: float, stem: float) -> list[Rectangle]:
    return [
        Rectangle(d1, leg, leg / 2, d1 / 2),
        Rectangle(stem, d2 - leg, (leg + d2) / 2, stem / 2),
    ]


def _hat(height: float, t: float, top: float, brim: float) -> list[Rectangle]:
    y, z = height / 2, (top - t) / 2
    b, z_brim = brim + t, top / 2 - t + (brim + t) / 2
    return [
        Rectangle(top, t, height - t / 2),
        Rectangle(t, height - 2 * t, y, z),
        Rectangle(t, height - 2 * t, y, -z),
        Rectangle(b, t, t / 2, z_brim),
        Rectangle(b, t, t / 2, -z_brim),
    ]


def _hat1(width: float, height: float, top: float, t: float, plate: float) -> list[Rectangle]:
    hat = _hat(height - plate, t, top, (width - top) / 2)
    return [Rectangle(width, plate, -plate / 2), *hat]


def _box_in_torsion(*d: float) -> float:
    """J of BOX, whose dimensions are width, height, plates, webs, or of BOX1."""
    d1, d2, top, bottom, left, right = d if len(d) == 6 else (d[0], d[1], d[2], d[2], d[3], d[3])
    w, h = d1 - (left + right) / 2, d2 - (top + bottom) / 2
    return cells_in_torsion([w * h], [h / left + h / right + w / top + w / bottom], 0.0)


def _dbox_in_torsion(*d: float) -> float:
    d1, d2, d3, left, middle, right, *plates = d
    widths = d3 - left / 2, d1 - d3 - right / 2
    heights = d2 - sum(plates[:2]) / 2, d2 - sum(plates[2:]) / 2
    around = [
        w / top + w / bottom + h / side + h / middle
        for w, h, side, top, bottom in zip(
            widths, heights, (left, right), plates[::2], plates[1::2], strict=True
        )
    ]
    areas = [w * h for w, h in zip(widths, heights, strict=True)]
    return cells_in_torsion(areas, around, sum(heights) / 2 / middle)


def _hat1_in_torsion(width: float, height: float, top: float, t: float, plate: float) -> float:
    """J of the cell between hat and plate, and of what sticks out of it."""
    w, h = top - t, height - plate / 2 - t / 2
    brim = (width - top) / 2
    out = 2 * rectangle_in_torsion(brim, t + plate)
    return cells_in_torsion([w * h], [(w + 2 * h) / t + w / plate], 0.0) + out


_CELLS: dict[str, Callable[..., float]] = {
    "BOX": _box_in_torsion,
    "BOX1": _box_in_torsion,
    "DBOX": _dbox_in_torsion,
    "HAT1": _hat1_in_torsion,
}
_ROUND: dict[str, Callable[..., tuple[float, float]]] = {
    "ROD": lambda d1: (d1, 0.0),
    "TUBE": lambda d1, d2: (d1, d2),
    "TUBE2": lambda d1, d2: (d1, d1 - d2),
}
_RECTANGLES: dict[str, Shape] = {
    "BAR": _bar,
    "BOX": _box,
    "BOX1": _box1,
    "DBOX": _dbox,
    "I": _i,
    "I1": _i1,
    "CHAN": _chan,
    "CHAN1": _chan1,
    "CHAN2": _chan2,
    "T": _t,
    "T1": _t1,
    "T2": _t,
    "CROSS": _cross,
    "H": _h,
    "Z": _z,
    "L": _l,
    "HAT": _hat,
    "HAT1": _hat1,
}
_FOURS = ("BOX", "I1", "CHAN", "CHAN1", "CHAN2", "T", "T1", "T2", "CROSS", "H", "Z", "L", "HAT")
DIMENSIONS = dict.fromkeys(_FOURS, 4) | {
    "ROD": 1,
    "TUBE": 2,
    "TUBE2": 2,
    "BAR": 2,
    "HEXA": 3,
    "HAT1": 5,
    "I": 6,
    "BOX1": 6,
    "DBOX": 10,
}
"""Types of cross-sections, with how many dimensions each has."""
