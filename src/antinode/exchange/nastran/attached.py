"""Masses, springs and joints of a deck, and what its supports hold, in units of the file."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Joint, PointMass, Spring
from antinode.beam.ends import AxialEnd, End, Ends
from antinode.errors import InputError

from .cards import Card, Subcase
from .line import SAME, Line, left_end, linked, right_end
from .model import Model

_ENDS: dict[tuple[bool, bool], End] = {
    (True, True): "clamped",
    (True, False): "pinned",
    (False, True): "sliding",
    (False, False): "free",
}


def attachments_of(
    model: Model, line: Line, modal: Subcase | None
) -> tuple[list[Attachment], dict[int, set[str]]]:
    """Return masses, springs and joints, and what the supports of the modes hold at each node."""
    items: list[Attachment] = [_point_mass(model, line, card) for card in model.masses]
    items += [spring_of(line, card) for card in model.springs if not is_joint(line, card)]
    items += joints_of(model, line)
    sets = {number for number, *_ in model.supports}
    if modal is None and len(sets) > 1:
        names = ", ".join(map(str, sorted(sets)))
        raise InputError(
            f"{model.deck.path}: there are SPC sets {names}, and no case control says which one "
            "holds; keep one of them"
        )
    chosen = next(iter(sets), None) if modal is None else modal.settings.get("SPC")
    return items, held_by(model, line, chosen)


def held_by(model: Model, line: Line, chosen: int | None) -> dict[int, set[str]]:
    """Return which of axial, lateral and rotational are held at each node."""
    given = [(g, grid.held, grid.card) for g, grid in model.grids.items() if grid.held]
    given += [(g, freedoms, card) for n, g, freedoms, card in model.supports if n == chosen]
    held: dict[int, set[str]] = {}
    for grid, freedoms, card in given:
        if grid not in line.node:
            continue
        if set("123456") <= set(freedoms):
            names = {"axial", "lateral", "rotational"}
        else:
            own = zip(("axial", "lateral", "rotational"), line.freedoms(card), strict=True)
            names = {name for name, freedom in own if str(freedom) in freedoms}
        if names:
            _check_side(line, grid, card)
            held.setdefault(line.node[grid], set()).update(names)
    return held


def _check_side(line: Line, grid: int, card: Card) -> None:
    if grid in line.right_grids:
        raise card.error(f"grid {grid} is the right side of a joint; attach it to the left side")


def ends_of(held: dict[int, set[str]], last: int) -> Ends:
    """Return how node 0 and the last one are held."""

    def of(node: int) -> tuple[End, AxialEnd]:
        here = held.get(node, set())
        axial: AxialEnd = "fixed" if "axial" in here else "free"
        return _ENDS["lateral" in here, "rotational" in here], axial

    (left, left_axial), (right, right_axial) = of(0), of(last)
    return Ends(left, right, left_axial, right_axial)


def inner_supports(held: dict[int, set[str]], x: Array) -> list[Spring]:
    """Return the supports between the ends."""
    inner = [k for k in sorted(held) if 0 < k < len(x) - 1]
    stiff = {name: {k: math.inf if name in held[k] else 0.0 for k in inner} for name in _FREEDOMS}
    return [
        Spring(float(x[k]), stiff["lateral"][k], stiff["rotational"][k], stiff["axial"][k])
        for k in inner
    ]


_FREEDOMS = ("axial", "lateral", "rotational")


def _node(line: Line, grid: int, card: Card) -> int:
    if grid not in line.node:
        raise card.error(f"grid {grid} is no grid of the beam's elements")
    _check_side(line, grid, card)
    return line.node[grid]


def _point_mass(model: Model, line: Line, card: Card) -> PointMass:
    if card.text(3) not in ("", "0"):
        raise card.error("a coordinate system in field 3 cannot be read")
    offset = np.array([card.real(i, 0.0) for i in (5, 6, 7)])
    axis, _, normal = line.frame
    along = float(offset @ axis)
    if np.linalg.norm(offset - along * axis) > SAME * float(np.ptp(line.x)):
        raise card.error("its centre is off the axis of the beam; only an offset along it is read")
    I = [card.real(i, 0.0) for i in range(9, 15)]  # noqa: E741
    tensor = np.array([[I[0], -I[1], -I[3]], [-I[1], I[2], -I[4]], [-I[3], -I[4], I[5]]])
    mass, factor = card.real(4), model.mass_factor
    if not mass > 0:
        raise card.error(f"field 4 is {mass:g}; a mass must be positive")
    at = float(line.x[_node(line, card.integer(2), card)])
    return PointMass(at, mass * factor, float(normal @ tensor @ normal) * factor, along)


def _sides(card: Card) -> list[tuple[int, int]]:
    """Return grid and freedom of the ends of a CELAS2 that are not to the ground."""
    pairs = [(card.integer(3, 0), card.integer(4, 0)), (card.integer(5, 0), card.integer(6, 0))]
    return [(grid, freedom) for grid, freedom in pairs if grid]


def is_joint(line: Line, card: Card) -> bool:
    """Tell whether a spring joins the two sides of a joint."""
    ends = _sides(card)
    return len(ends) == 2 and any(grid in line.right_grids for grid, _ in ends)


def spring_of(line: Line, card: Card) -> Spring:
    """Return a spring to the ground."""
    ends, k = _sides(card), card.real(2)
    if len(ends) != 1:
        raise card.error("it must join one grid to the ground, or the two sides of a joint")
    if not k > 0:
        raise card.error(f"field 2 is {k:g}; a stiffness must be positive")
    ((grid, freedom),) = ends
    axial, lateral, rotational = line.freedoms(card)
    x = float(line.x[_node(line, grid, card)])
    if freedom not in (axial, lateral, rotational):
        raise card.error(f"freedom {freedom} is none of the plane of bending; remove it")
    return Spring(x, k * (freedom == lateral), k * (freedom == rotational), k * (freedom == axial))


def joints_of(model: Model, line: Line) -> list[Joint]:
    """Return the joints, by the links and springs between the two grids of each."""
    found = []
    for a, b in pairwise(line.elements):
        left, right = right_end(a, line.node), left_end(b, line.node)
        if left == right:
            continue
        rigid = linked(model, left, right) + linked(model, right, left)
        axial, lateral, rotational = line.freedoms(b.card)
        if str(lateral) not in rigid:
            raise b.card.error(f"grids {left} and {right} are not linked in freedom {lateral}")
        found.append(
            Joint(
                float(line.x[line.node[left]]),
                _compliance(model, line, (left, right), rotational, rigid, b.card),
                _compliance(model, line, (left, right), axial, rigid, b.card),
            )
        )
    return found


def _compliance(
    model: Model, line: Line, grids: tuple[int, int], freedom: int, rigid: str, card: Card
) -> float:
    if str(freedom) in rigid:
        return 0.0
    k = sum(
        spring.real(2)
        for spring in model.springs
        if is_joint(line, spring) and {(g, freedom) for g in grids} == set(_sides(spring))
    )
    if not k > 0:
        raise card.error(f"grids {grids[0]} and {grids[1]} are not joined in freedom {freedom}")
    return 1 / k
