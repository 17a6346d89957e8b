"""What a deck lumps at its grids because bars have it not of themselves, spread over them again.

- Polar and rotary inertia: the first CONM2 of a grid that has no mass and no moments but these,
  where `rho` of the bars gives none; at every grid, or at `FINE` of them.
- Added mass: CONM2 on grids that follow nodes sideways alone.
- A foundation: the first spring of a node sideways to the ground, at `FINE` nodes or more.

Density at a grid is the lump over half the lengths of its elements; an element's is the mean of its
grids'.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from antinode.arrays import Array

from .cards import Card
from .line import Line
from .model import Elastic, Model

FINE = 50
"""So many lumps of a kind are a property of the bars, and no attachments."""
INERTIA, ROTARY = "polar_inertia_per_length", "rotary_inertia_per_length"
ADDED, FOUNDATION = "added_mass_per_length", "foundation_stiffness"


@dataclass(frozen=True)
class Lumps:
    """What is lumped: by column and grid, and the cards that it stands on.

    Attributes
    ----------
    at : dict
        By column of a beam: the lump by grid, or by node where sideways motion has it.
    cards : frozenset of int
        Identities of cards and springs that are none of the attachments.
    """

    at: dict[str, dict[int, float]] = field(default_factory=dict)
    cards: frozenset[int] = frozenset()

    def are(self, item: Card | Elastic) -> bool:
        """Tell whether a card or a spring is one of them."""
        card = item.card if isinstance(item, Elastic) else item
        return id(card) in self.cards

    def spread(self, line: Line, x: Array) -> dict[str, Array]:
        """Return the columns on the intervals between breakpoints."""
        return {
            name: _spread(line, lumps, x, by_node=name in (ADDED, FOUNDATION))
            for name, lumps in self.at.items()
        }

    def without(self, column: str) -> Lumps:
        """Return them without a column; its cards stay none of the attachments."""
        return replace(self, at={n: lumps for n, lumps in self.at.items() if n != column})


def lumps_of(model: Model, line: Line, tables: Mapping[str, Array]) -> Lumps:
    """Return what is lumped of columns that the bars do not have."""
    at: dict[str, dict[int, float]] = {}
    cards: set[int] = set()
    own = _moments(model, line)
    wanted = {
        name: {grid: values[k] for grid, (_, values) in own.items()}
        for k, name in enumerate((INERTIA, ROTARY))
    }
    there = {name: lumps for name, lumps in wanted.items() if any(lumps.values())}
    if there and not any(np.any(tables.get(name, 0.0)) for name in there):
        at |= there
        cards |= {id(card) for card, _ in own.values()}
    for name, found in ((ADDED, _water(model, line)), (FOUNDATION, _bedding(model, line))):
        if found:
            at[name] = {node: value for node, (_, value) in found.items()}
            cards |= {id(card) for card, _ in found.values()}
    return Lumps(at, frozenset(cards))


def _moments(model: Model, line: Line) -> dict[int, tuple[Card, tuple[float, float]]]:
    """Return the massless cards with their polar and rotary inertia, if they are lumps of bars."""
    found: dict[int, tuple[Card, tuple[float, float]]] = {}
    for card in model.masses:
        grid = card.integer(2)
        if grid in line.node and any(values := _moments_of(line, grid, card)):
            found.setdefault(grid, (card, values))
    return found if len(found) >= min(len(line.node), FINE) else {}


def _moments_of(line: Line, grid: int, card: Card) -> tuple[float, float]:
    """Return the moments about axis and normal of a card that has no mass, and no other moments."""
    _, _, about_normal, about_axis = line.freedoms(grid, card)
    places = [{4: 9, 5: 11, 6: 14}[freedom] for freedom in (about_axis, about_normal)]
    others = [i for i in (4, *range(9, 15)) if i not in places and card.real(i, 0.0)]
    if others or card.text(3) not in ("", "0"):
        return 0.0, 0.0
    polar, turning = (card.real(place, 0.0) for place in places)
    return polar, turning


def _water(model: Model, line: Line) -> dict[int, tuple[Card, float]]:
    """Return the masses on grids that follow nodes sideways alone."""
    follows: dict[int, int] = {}
    for link in model.links:
        if link.to in line.node and set(link.freedoms) == {_lateral(line, link.to, link.card)}:
            follows |= {g: line.node[link.to] for g in link.grids if g not in line.node}
    found: dict[int, tuple[Card, float]] = {}
    for card in model.masses if follows else ():
        if (node := follows.get(card.integer(2), -1)) >= 0:
            found.setdefault(node, (card, card.real(4, 0.0)))
    return found


def _lateral(line: Line, grid: int, card: Card) -> str:
    return str(line.freedoms(grid, card)[1])


def _bedding(model: Model, line: Line) -> dict[int, tuple[Card, float]]:
    """Return the springs sideways to the ground, if they are many."""
    found: dict[int, tuple[Card, float]] = {}
    for spring in model.springs:
        ends = moving_ends(model, line, spring)
        if len(ends) == 1 and ends[0][0] in line.node and spring.k > 0:
            grid, freedom = ends[0]
            if str(freedom) == _lateral(line, grid, spring.card):
                found.setdefault(line.node[grid], (spring.card, spring.k))
    return found if len(found) >= FINE else {}


def moving_ends(model: Model, line: Line, spring: Elastic) -> Sequence[tuple[int, int]]:
    """Return the ends of a spring but those that are held and bear no element.

    Raises
    ------
    InputError
        If there is no such grid; of a larger model it may be a scalar point.
    """

    def moves(grid: int) -> bool:
        if grid in line.node or (model.wanted and grid not in model.grids):
            return True
        return set(model.grid(grid, spring.card).held) < set("123456")

    return [(grid, freedom) for grid, freedom in spring.ends if moves(grid)]


def _spread(line: Line, lumps: Mapping[int, float], x: Array, *, by_node: bool) -> Array:
    """Return what is lumped per length on the intervals between breakpoints."""
    keys = [
        (line.node[e.left], line.node[e.right]) if by_node else (e.left, e.right)
        for e in line.elements
    ]
    half: dict[int, float] = {}
    for k, pair in enumerate(keys):
        for key in pair:
            half[key] = half.get(key, 0.0) + (line.x[k + 1] - line.x[k]) / 2
    density = {key: lump / half[key] for key, lump in lumps.items()}
    means = np.array([(density.get(a, 0.0) + density.get(b, 0.0)) / 2 for a, b in keys])
    own = means[np.searchsorted(line.x, (x[1:] + x[:-1]) / 2) - 1]
    return np.stack([own, own], axis=1)
