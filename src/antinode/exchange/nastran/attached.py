"""Masses, springs and joints of a deck, and what its supports hold, in units of the file.

A grid beside the beam's axis moves with it by a rigid arm `r`: a mass there counts with its centre,
which must lie on the axis; a support must not turn the arm into a lever between axial and lateral
motion, so it holds sideways alone, or all.
"""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Joint, PointMass, Spring
from antinode.beam.ends import AxialEnd, End, Ends
from antinode.errors import InputError

from .cards import Card
from .deck import Subcase
from .line import SAME, Line, left_end, linked, right_end
from .lumped import Lumps, moving_ends
from .model import Elastic, Model

_ENDS: dict[tuple[bool, bool], End] = {
    (True, True): "clamped",
    (True, False): "pinned",
    (False, True): "sliding",
    (False, False): "free",
}
_FREEDOMS = ("axial", "lateral", "rotational", "torsional")


def attachments_of(
    model: Model, line: Line, modal: Subcase | None, lumps: Lumps
) -> tuple[list[Attachment], dict[int, set[str]]]:
    """Return masses, springs and joints, and what the supports of the modes hold at each node.

    What is lumped of the bars is none of the masses and springs.
    """
    own = [card for card in model.masses if not lumps.are(card)]
    here = [card for card in own if _is_here(model, line, card.integer(2), card)]
    items: list[Attachment] = [_point_mass(model, line, card) for card in here]
    items += springs_of(model, line, lumps)
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
    """Return which of axial, lateral, rotational and torsional are held at each node."""
    sets = set() if chosen is None else model.chosen_supports(chosen)
    given = [(g, grid.held, grid.card) for g, grid in model.grids.items() if grid.held]
    given += [(g, freedoms, card) for n, g, freedoms, card in model.supports if n in sets]
    by_grid: dict[int, tuple[set[str], Card]] = {}
    for grid, freedoms, card in given:
        held, _ = by_grid.setdefault(grid, (set(), card))
        held.update(freedoms)
    found: dict[int, set[str]] = {}
    for grid, (freedoms_held, card) in by_grid.items():
        if (seat := _seat(model, line, grid)) is None:
            continue
        names = _names(line, grid, freedoms_held, card)
        if names == {"torsional"} and grid in line.right_grids:
            continue
        if names:
            _check_side(line, grid, card)
            _check_arm(seat[1], names, card, all_held=set("123456") <= freedoms_held)
            found.setdefault(seat[0], set()).update(names)
    return found


def _names(line: Line, grid: int, freedoms: set[str], card: Card) -> set[str]:
    """Return which freedoms of the beam are among those of a grid."""
    if set("123456") <= freedoms:
        return set(_FREEDOMS)
    own = zip(_FREEDOMS, line.freedoms(grid, card), strict=True)
    return {name for name, freedom in own if str(freedom) in freedoms}


def _seat(model: Model, line: Line, grid: int) -> tuple[int, Array] | None:
    """Return the node that a grid moves with as a rigid body, and the arm to the grid."""
    if grid in line.node:
        return line.node[grid], line.arms[grid]
    for link in model.links:
        if grid in link.grids and link.to in line.node and set("123456") <= set(link.freedoms):
            away = line.frame @ (model.grids[grid].at - model.grids[link.to].at)
            return line.node[link.to], np.asarray(line.arms[link.to] + away)
    return None


def _is_here(model: Model, line: Line, grid: int, card: Card) -> bool:
    """Tell whether a card stands on the beam; of a larger model others are left out."""
    if _seat(model, line, grid) is not None:
        return True
    if model.wanted:
        model.passed[card.name] += 1
        return False
    raise card.error(f"grid {grid} is no grid of the beam's elements, nor tied to one")


def _check_side(line: Line, grid: int, card: Card) -> None:
    if grid in line.right_grids:
        raise card.error(f"grid {grid} is the right side of a joint; attach it to the left side")


def _check_arm(arm: Array, names: set[str], card: Card, *, all_held: bool = False) -> None:
    """Refuse what holds a grid beside the axis so that an arm becomes a lever."""
    size = max(float(np.max(np.abs(arm))), 1e-300)
    along, beside, normal = (abs(float(v)) > 1e-9 * size for v in arm)
    if names <= {"torsional"}:
        return
    if size <= 1e-12 or all_held or ({*_FREEDOMS[:3]} <= names and not normal):
        return
    if along or normal or (beside and "axial" in names):
        raise card.error(
            "its grid stands beside the axis of the beam, whose axial motion it would couple to "
            "bending; hold all freedoms, or move the grid onto the axis"
        )


def ends_of(held: dict[int, set[str]], last: int) -> Ends:
    """Return how node 0 and the last one are held."""

    def of(node: int) -> tuple[End, AxialEnd, AxialEnd]:
        here = held.get(node, set())
        axial: AxialEnd = "fixed" if "axial" in here else "free"
        torsion: AxialEnd = "fixed" if "torsional" in here else "free"
        return _ENDS["lateral" in here, "rotational" in here], axial, torsion

    (left, left_axial, left_torsion), (right, right_axial, right_torsion) = of(0), of(last)
    return Ends(left, right, left_axial, right_axial, left_torsion, right_torsion)


def inner_supports(held: dict[int, set[str]], x: Array) -> list[Spring]:
    """Return the supports between the ends."""
    inner = [k for k in sorted(held) if 0 < k < len(x) - 1]
    stiff = {name: {k: math.inf if name in held[k] else 0.0 for k in inner} for name in _FREEDOMS}
    return [
        Spring(
            float(x[k]),
            stiff["lateral"][k],
            stiff["rotational"][k],
            stiff["axial"][k],
            stiff["torsional"][k],
        )
        for k in inner
    ]


def place_of(model: Model, line: Line, grid: int, card: Card) -> tuple[float, Array]:
    """Return x of what a card attaches to a grid, and the arm to the grid."""
    seat = _seat(model, line, grid)
    if seat is None:
        raise card.error(f"grid {grid} is no grid of the beam's elements, nor tied to one")
    _check_side(line, grid, card)
    return float(line.x[seat[0]]), seat[1]


def _point_mass(model: Model, line: Line, card: Card) -> PointMass:
    grid = card.integer(2)
    x, arm = place_of(model, line, grid, card)
    axes, offset = _mass_frame(model, grid, card)
    centre = arm + line.frame @ offset
    if np.linalg.norm(centre[1:]) > SAME * float(np.ptp(line.x)):
        raise card.error("its centre is off the axis of the beam; only an offset along it is read")
    I = [card.real(i, 0.0) for i in range(9, 15)]  # noqa: E741
    tensor = np.array([[I[0], -I[1], -I[3]], [-I[1], I[2], -I[4]], [-I[3], -I[4], I[5]]])
    normal = axes @ line.frame[2]
    mass, factor = card.real(4), model.mass_factor
    if not mass > 0 and not (mass == 0 and any(I)):
        raise card.error(f"field 4 is {mass:g}; a mass must be positive")
    turning, polar = (float(v @ tensor @ v) * factor for v in (normal, axes @ line.frame[0]))
    if min(turning, polar) < 0:
        raise card.error(
            f"its moment of inertia is {min(turning, polar):g}; it must not be negative"
        )
    return PointMass(x, mass * factor, turning, float(centre[0]), polar)


def _mass_frame(model: Model, grid: int, card: Card) -> tuple[Array, Array]:
    """Return the axes of a mass's inertia as rows, and the offset of its centre, basic."""
    given = np.array([card.real(i, 0.0) for i in (5, 6, 7)])
    at = model.grid(grid, card).at
    if card.text(3) == "-1":
        return np.eye(3), given - at
    number = card.integer(3, 0)
    axes = model.systems.directions(number, at, card) if number else model.grids[grid].axes
    return axes, np.asarray(given @ axes)


def is_joint(line: Line, spring: Elastic) -> bool:
    """Tell whether a spring joins the two sides of a joint."""
    return len(spring.ends) == 2 and any(grid in line.right_grids for grid, _ in spring.ends)


def string_of(line: Line, spring: Elastic) -> int | None:
    """Return the element across which a spring acts as a taut string does, if it is one.

    It joins the lateral freedoms of the element's grids: `k = -N/h`.
    """
    grids = {grid for grid, _ in spring.ends}
    if len(grids) != 2 or not grids <= set(line.node):
        return None
    k = min(line.node[grid] for grid in grids)
    if k == len(line.elements) or grids != {line.elements[k].left, line.elements[k].right}:
        return None
    lateral = {(grid, line.freedoms(grid, spring.card)[1]) for grid in grids}
    return k if lateral == set(spring.ends) else None


def axial_force_of_strings(model: Model, line: Line) -> Array:
    """Return N of the elements that springs across them amount to."""
    N = np.zeros(len(line.elements))
    for spring in model.springs:
        if (k := string_of(line, spring)) is not None:
            N[k] -= spring.k * (line.x[k + 1] - line.x[k])
    return N


def _to_ground(model: Model, line: Line, spring: Elastic) -> Elastic:
    """Return a spring without those of its ends that are held and bear no element: the ground."""
    free = moving_ends(model, line, spring)
    return replace(spring, ends=tuple(free)) if free else spring


def springs_of(model: Model, line: Line, lumps: Lumps) -> list[Spring]:
    """Return the springs to the ground that are no foundation."""
    found = []
    own = (spring for spring in model.springs if not lumps.are(spring))
    for spring in (_to_ground(model, line, item) for item in own):
        if is_joint(line, spring) or string_of(line, spring) is not None:
            continue
        if model.wanted and not all(grid in line.node for grid, _ in spring.ends):
            model.passed[spring.card.name] += 1
            continue
        if (read := _spring(model, line, spring)) is not None:
            found.append(read)
    return found


def _spring(model: Model, line: Line, spring: Elastic) -> Spring | None:
    """Return a spring to the ground; None for one out of the plane of bending."""
    card = spring.card
    if len(spring.ends) != 1:
        raise card.error("it must join one grid to the ground, or the two sides of a joint")
    ((grid, freedom),) = spring.ends
    if not spring.k > 0:
        raise card.error(f"its stiffness is {spring.k:g}; a stiffness must be positive")
    x, arm = place_of(model, line, grid, card)
    own = dict(zip(line.freedoms(grid, card), _FREEDOMS, strict=True))
    if freedom not in own:
        return None
    name, k = own[freedom], spring.k
    _check_arm(arm, {name}, card)
    along, sideways, turning, twisting = (k * (name == own) for own in _FREEDOMS)
    return Spring(x, sideways, turning, along, twisting)


def joints_of(model: Model, line: Line) -> list[Joint]:
    """Return the joints, by the links and springs between the two grids of each."""
    found = []
    for a, b in pairwise(line.elements):
        left, right = right_end(a, line.node), left_end(b, line.node)
        if left == right:
            continue
        rigid = linked(model, left, right) + linked(model, right, left)
        axial, lateral, rotational, torsional = line.freedoms(right, b.card)
        if str(lateral) not in rigid:
            raise b.card.error(f"grids {left} and {right} are not linked in freedom {lateral}")
        found.append(
            Joint(
                float(line.x[line.node[left]]),
                _compliance(model, line, (left, right), rotational, rigid, b.card),
                _compliance(model, line, (left, right), axial, rigid, b.card),
                _compliance(model, line, (left, right), torsional, rigid, None),
            )
        )
    return found


def _compliance(
    model: Model, line: Line, grids: tuple[int, int], freedom: int, rigid: str, card: Card | None
) -> float:
    """Return the compliance in a freedom; infinite where nothing joins it and no card says so."""
    if str(freedom) in rigid:
        return 0.0
    k = sum(
        spring.k
        for spring in model.springs
        if is_joint(line, spring) and {(g, freedom) for g in grids} == set(spring.ends)
    )
    if not k > 0 and card is None:
        return math.inf
    if not k > 0 and card:
        raise card.error(f"grids {grids[0]} and {grids[1]} are not joined in freedom {freedom}")
    return 1 / k
