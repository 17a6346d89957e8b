"""Torsion of a deck: whether the beam has it, and the polar inertia lumped at its grids.

Most solvers give a CBAR no polar inertia of its own, so a deck lumps it: one CONM2 at every grid,
massless, with I11 alone. Where `rho (I1 + I2)` of the bars is zero, these are theirs, the first
such card of a grid: of density I11 over half the lengths of the grid's elements, an element's being
the mean of its grids'.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Joint, PointMass, Spring

from .cards import Card
from .line import SAME, Line
from .model import Model

GJ, INERTIA = "torsional_stiffness", "polar_inertia_per_length"


def lumps_of(model: Model, line: Line, tables: Mapping[str, Array]) -> dict[int, Card]:
    """Return the cards that lump the polar inertia of the bars, by grid; none if not at each."""
    if np.any(tables[INERTIA]):
        return {}
    found: dict[int, Card] = {}
    for card in model.masses:
        grid = card.integer(2)
        if grid in line.node and _polar(line, grid, card) > 0:
            found.setdefault(grid, card)
    return found if len(found) == len(line.node) else {}


def _polar(line: Line, grid: int, card: Card) -> float:
    """Return the moment about the axis of a card that has no mass, and no other moment."""
    place = {4: 9, 5: 11, 6: 14}[line.freedoms(grid, card)[3]]
    others = [i for i in (4, *range(9, 15)) if i != place and card.real(i, 0.0)]
    return 0.0 if others or card.text(3) not in ("", "0") else card.real(place, 0.0)


def spread(line: Line, lumps: Mapping[int, Card], x: Array) -> Array:
    """Return the lumped polar inertia per length on the intervals between breakpoints."""
    half: dict[int, float] = {}
    for k, element in enumerate(line.elements):
        for grid in (element.left, element.right):
            half[grid] = half.get(grid, 0.0) + (line.x[k + 1] - line.x[k]) / 2
    density = {grid: _polar(line, grid, card) / half[grid] for grid, card in lumps.items()}
    means = np.array([(density[e.left] + density[e.right]) / 2 for e in line.elements])
    own = means[np.searchsorted(line.x, (x[1:] + x[:-1]) / 2) - 1]
    return np.stack([own, own], axis=1)


def missing(
    line: Line,
    tables: Mapping[str, Array],
    held: Mapping[int, set[str]],
    items: Sequence[Attachment],
) -> str | None:
    """Say why the beam has no torsion; None where it has."""
    if not np.all(tables[GJ] > 0):
        return "J, or G, is not known of all elements"
    if all("torsional" in held.get(k, ()) for k in range(len(line.x))):
        return "freedom 4 is held at every grid"
    if not np.all(tables[INERTIA] > 0):
        return "rho (I1 + I2) is zero, and no massless CONM2 at every grid stands for it"
    if any(np.max(np.abs(arm)) > SAME * np.ptp(line.x) for arm in line.arms.values()):
        return "grids beside the axis couple it to bending"
    if any(isinstance(item, Joint) and math.isinf(item.torsional) for item in items):
        return "the two grids of a joint are not joined in it"
    return None


def without(
    held: Mapping[int, set[str]], items: Sequence[Attachment]
) -> tuple[dict[int, set[str]], list[Attachment]]:
    """Return supports and attachments without what acts in torsion alone."""
    kept = {node: names - {"torsional"} for node, names in held.items() if names != {"torsional"}}
    bare = [_bare(item) for item in items]
    return kept, [item for item in bare if any(v for n, v in vars(item).items() if n != "x")]


def _bare(item: Attachment) -> Attachment:
    if isinstance(item, PointMass):
        return replace(item, polar_inertia=0.0)
    if isinstance(item, Spring):
        return replace(item, torsional=0.0)
    return replace(item, torsional=0.0)
