"""A beam as its drawing: rows of dimensions, a material, and parts that add mass.

A beam keeps what it was drawn from; whether its tables still are what follows from that is checked
before it is written, and mass beyond it becomes parts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.beam import curves
from antinode.beam.beam import Beam
from antinode.beam.sections.drawing import PROPERTIES, Columns
from antinode.beam.sections.drawn import OTHERS, on_parts
from antinode.beam.sections.material import Material

_SAME = 1e-11  # relative: of the beam's tables and what follows from its drawing
_STRAIGHT = 1e-12  # of a column's largest value: by which it may miss a straight line


@dataclass(frozen=True)
class Drawn:
    """A beam in the words of its drawing.

    Attributes
    ----------
    x : array, shape (n + 1,)
        Breakpoints that its rows need [m].
    tables : dict of array, shape (n, 2)
        Dimensions, and columns that follow from no section.
    material : Material
    parts : list of dict
        The tables `[[beam.masses]]`.
    """

    x: Array
    tables: dict[str, Array]
    material: Material
    parts: list[dict[str, Any]]


def drawn(beam: Beam) -> Drawn | None:
    """Return a beam as its drawing, None where that does not tell all of it."""
    drawing = beam.drawing
    if drawing is None or beam.radius_of_gyration is not None:
        return None
    others = {n: t for n in OTHERS if (t := getattr(beam, n)) is not None}
    if beam.is_unloaded:
        del others["axial_force"]
    if any(table.shape[1] > 2 for table in others.values()) or not _follows(beam, drawing.columns):
        return None
    parts = _parts(beam, drawing.columns)
    if parts is None:
        return None
    dimensions = {n: on_parts(drawing.x, t, beam.x) for n, t in drawing.dimensions.items()}
    x, tables = _without_needless(beam.x, dimensions | others, drawing.x)
    return Drawn(x, tables, drawing.material, parts)


def _follows(beam: Beam, own: Columns) -> bool:
    """Tell whether all stiffness and inertia of a beam but its mass follows from its drawing."""
    off = max(np.min(np.abs(beam.x - x)) for x in own.x)
    if off > _STRAIGHT * np.max(np.abs(beam.x)):
        return False
    return all(
        name in own.tables and _agree(table, on_parts(own.x, own.tables[name], beam.x))
        for name in PROPERTIES
        if name != "mass_per_length" and (table := getattr(beam, name, None)) is not None
    )


def _agree(a: Array, b: Array) -> bool:
    degree = max(a.shape[1], b.shape[1]) - 1
    return np.allclose(curves.raised(a, degree), curves.raised(b, degree), rtol=_SAME, atol=0)


def _parts(beam: Beam, own: Columns) -> list[dict[str, Any]] | None:
    """Return mass beyond the drawing's as parts; None where that is not straight, or negative."""
    drawn_mass = on_parts(own.x, own.tables["mass_per_length"], beam.x)
    more = curves.total(beam.mass_per_length, -drawn_mass)
    scale = _SAME * np.max(beam.mass_per_length, axis=1, keepdims=True)
    more = np.where(np.abs(more) > scale, more, 0.0)
    straight = curves.raised(more[:, [0, -1]], more.shape[1] - 1)
    if np.any(np.abs(more - straight) > scale) or np.any(more < 0):
        return None
    ends = more[:, [0, -1]]
    return [
        {
            "name": f"part {number}",
            "interpolation": "linear",
            "x": beam.x[first : last + 2].tolist(),
            "mass_per_length": [*ends[first : last + 1, 0].tolist(), float(ends[last, 1])],
        }
        for number, (first, last) in enumerate(_runs(ends), 1)
    ]


def _runs(ends: Array) -> Iterator[tuple[int, int]]:
    """Yield first and last interval of every run in which a table is not zero and does not jump."""
    first = None
    for k, row in enumerate(ends):
        if first is not None and (not row.any() or row[0] != ends[k - 1, 1]):
            yield first, k - 1
            first = None
        if first is None and row.any():
            first = k
    if first is not None:
        yield first, len(ends) - 1


def _without_needless(
    x: Array, tables: dict[str, Array], drawn_at: Array
) -> tuple[Array, dict[str, Array]]:
    """Drop breakpoints that are not drawn and at which every column runs straight on."""
    needed = np.array([np.min(np.abs(drawn_at - place)) == 0 for place in x[1:-1]], dtype=bool)
    h = np.diff(x)
    for table in tables.values():
        needed |= _turns(table, h)
    starts = np.append(True, needed)
    last = np.append(np.flatnonzero(starts)[1:] - 1, len(h) - 1)
    kept = {
        name: np.stack([table[starts, 0], table[last, -1]], axis=1)
        for name, table in tables.items()
    }
    return np.append(x[:-1][starts], x[-1]), kept


def _turns(table: Array, h: Array) -> npt.NDArray[np.bool_]:
    """Tell for every inner breakpoint whether a column jumps, or turns, there."""
    slack = _STRAIGHT * np.max(np.abs(table))
    left, right = table[:-1], table[1:]
    foreseen = left[:, 0] + (left[:, -1] - left[:, 0]) * (h[:-1] + h[1:]) / h[:-1]
    jumps = np.abs(right[:, 0] - left[:, -1]) > slack
    return np.asarray(jumps | (np.abs(foreseen - right[:, -1]) > slack * (1 + h[1:] / h[:-1])))
