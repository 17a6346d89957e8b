"""The elements of a deck in order along one line, with the plane in which they bend.

The line is that of the neutral axes: an element's end is its grid plus its offset. A grid may stand
beside the line, joined to it by a rigid arm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .cards import Card
from .model import Element, Grid, Model
from .sections import Section

SAME = 1e-6
"""Of the length: what may be off the line."""


@dataclass(frozen=True)
class Line:
    """The elements in order along their line.

    Attributes
    ----------
    x : array, shape (n + 1,)
        Along the axis, in units of the file.
    elements : tuple of Element
        From left to right.
    node : dict
        Index in `x` by grid.
    arms : dict
        From the place on the line to the grid, along axis, direction of bending and normal.
    right_grids : frozenset of int
        Grids on the right side of a joint.
    frame : array, shape (3, 3)
        Axis, direction of bending, and the normal of both.
    grids : dict
        All grids of the deck.
    """

    x: Array
    elements: tuple[Element, ...]
    node: dict[int, int]
    arms: dict[int, Array]
    right_grids: frozenset[int]
    frame: Array
    grids: Mapping[int, Grid]

    def freedoms(self, grid: int, card: Card) -> tuple[int, int, int, int]:
        """Return the numbers of axial, lateral, rotational and torsional freedom at a grid."""
        shares = np.abs(self.frame @ self.grids[grid].axes.T)
        if np.any(np.sort(shares, axis=1)[:, :2] > SAME):
            raise card.error(
                f"the beam or its plane of bending is oblique to the axes of grid {grid}, so that "
                "freedoms cannot be told apart: turn the model"
            )
        axis, lateral, normal = (int(np.argmax(row)) for row in shares)
        return axis + 1, lateral + 1, normal + 4, axis + 4


def line_of(model: Model, plane: int) -> Line:
    """Order the elements from left to right, or say why they make up no line."""
    elements = tuple(model.elements.values())
    _check_pins(elements, plane)
    ends = np.stack([_ends(model, element) for element in elements])
    axis, length = _axis(ends.reshape(-1, 3), model)
    _check_straight(ends, elements, axis, length)
    along = ends @ axis
    x = _places(np.sort(along.ravel()), length)
    nodes = _nearest(x, along)
    node, at = _by_grid(elements, nodes, ends, length)
    ordered, right_grids = _ordered(model, elements, nodes, node)
    frame = _frame(model, ordered, axis, plane)
    arms = {g: frame @ (model.grids[g].at - place) for g, place in at.items()}
    return Line(x, ordered, node, arms, right_grids, frame, model.grids)


def _check_pins(elements: tuple[Element, ...], plane: int) -> None:
    """Refuse ends released in the plane of bending; other releases do not matter in it."""
    for element in elements:
        if released := sorted(set(element.pins) & set("126" if plane == 1 else "135")):
            raise element.card.error(
                f"a pin flag releases {', '.join(released)} in the plane of bending, which is not "
                "read; use two grids with RBE2 and CELAS2 for a joint"
            )


def section(model: Model, element: Element) -> Section:
    """Return the section of an element."""
    if element.prop not in model.sections:
        raise element.card.error(f"there is no PBAR or PBEAM {element.prop}")
    return model.sections[element.prop]


def _ends(model: Model, element: Element) -> Array:
    """Return the places of both ends of an element's neutral axis."""
    grids = [model.grid(g, element.card).at for g in (element.left, element.right)]
    ends = np.stack(grids) + element.offsets
    shift = section(model, element).neutral
    if np.any(shift):
        y = _across(model, element, ends[0], _unit(ends[1] - ends[0], element))
        if y is None:
            raise element.card.error("fields 5 to 7 hold no orientation; give that of plane 1")
        z = np.cross(_unit(ends[1] - ends[0], element), y)
        ends = ends + shift @ np.stack([y, z])
    return ends


def _unit(vector: Array, element: Element) -> Array:
    size = float(np.linalg.norm(vector))
    if not size > 0:
        raise element.card.error("this element has the length 0; elements must follow each other")
    return vector / size


def _axis(at: Array, model: Model) -> tuple[Array, float]:
    """Return the direction of the line, positive along its largest component, and its length."""
    far = at[np.argmax(np.linalg.norm(at - at[0], axis=1))]
    other = at[np.argmax(np.linalg.norm(at - far, axis=1))]
    length = float(np.linalg.norm(far - other))
    if not 0 < length < 1e150:
        raise InputError(
            f"{model.deck.path}: all elements have the length 0; correct the GRID cards"
        )
    axis = (far - other) / length
    axis[np.abs(axis) < 1e-12] = 0.0
    return axis * np.sign(axis[np.argmax(np.abs(axis))]), length


def _check_straight(ends: Array, elements: tuple[Element, ...], axis: Array, length: float) -> None:
    away = ends - ends[0, 0]
    off = np.linalg.norm(away - (away @ axis)[..., None] * axis, axis=2)
    for k, end in np.argwhere(off > SAME * length)[:1]:
        element = elements[k]
        grid = (element.left, element.right)[end]
        raise element.card.error(
            f"its end at grid {grid} is {off[k, end]:.3g} off the line of the others; one straight "
            "beam is read: name its elements with --elements, e.g. --elements 100:140"
        )


def _places(x: Array, length: float) -> Array:
    return np.asarray(x[np.append([True], np.diff(x) > 1e-9 * length)])


def _nearest(x: Array, along: Array) -> Array:
    """Return the index of the nearest of the places."""
    right = np.clip(np.searchsorted(x, along), 1, len(x) - 1)
    return np.where(along - x[right - 1] < x[right] - along, right - 1, right)


def _by_grid(
    elements: tuple[Element, ...], nodes: Array, ends: Array, length: float
) -> tuple[dict[int, int], dict[int, Array]]:
    """Return node and place on the line by grid."""
    node: dict[int, int] = {}
    at: dict[int, Array] = {}
    for k, element in enumerate(elements):
        for end, grid in enumerate((element.left, element.right)):
            place = ends[k, end]
            if np.linalg.norm(at.setdefault(grid, place) - place) > SAME * length:
                raise element.card.error(
                    f"offsets put grid {grid} at two places; elements must follow each other"
                )
            node[grid] = int(nodes[k, end])
    return node, at


def _ordered(
    model: Model, elements: tuple[Element, ...], nodes: Array, node: dict[int, int]
) -> tuple[tuple[Element, ...], frozenset[int]]:
    """Return the elements from left to right, and the grids on the right side of joints."""
    found: dict[int, Element] = {}
    for element, (a, b) in zip(elements, nodes.tolist(), strict=True):
        if abs(a - b) != 1:
            between = "has the length 0" if a == b else "runs past another grid of the beam"
            raise element.card.error(f"this element {between}; elements must follow each other")
        if min(a, b) in found:
            other = found[min(a, b)].card.line
            raise element.card.error(
                f"this element lies beside that of line {other}; remove one, or name those of the "
                "beam with --elements"
            )
        found[min(a, b)] = element
    last = int(np.max(nodes))
    for k in range(last):
        if k not in found:
            raise InputError(
                f"{model.deck.path}: there is a gap between the elements; close it, or name those "
                "of one beam with --elements"
            )
    ordered = tuple(found[k] for k in range(last))
    right = set()
    for before, after in pairwise(ordered):
        end, start = right_end(before, node), left_end(after, node)
        if end != start:
            _check_joint(model, end, start, after.card)
            right.add(start)
    return ordered, frozenset(right)


def left_end(element: Element, node: dict[int, int]) -> int:
    """Return the grid at the left end of an element."""
    return min(element.left, element.right, key=lambda g: node[g])


def right_end(element: Element, node: dict[int, int]) -> int:
    """Return the grid at its right end."""
    return max(element.left, element.right, key=lambda g: node[g])


def _check_joint(model: Model, left: int, right: int, card: Card) -> None:
    if not linked(model, left, right) and not linked(model, right, left):
        raise card.error(
            f"grids {left} and {right} stand at one place, but no RBE2 or RBAR links them across; "
            "merge them, or link them"
        )


def linked(model: Model, left: int, right: int) -> str:
    """Return the freedoms in which the right grid is tied to the left one."""
    return "".join(k.freedoms for k in model.links if k.to == left and right in k.grids)


def _frame(model: Model, elements: tuple[Element, ...], axis: Array, plane: int) -> Array:
    """Return axis, direction of bending and their normal, the same for all elements.

    Where bending is alike in all directions an element's plane does not matter.
    """
    first: Array | None = None
    for element in elements:
        if section(model, element).round:
            continue
        v = _across(model, element, None, axis)
        if v is None:
            raise element.card.error("fields 5 to 7 hold no orientation; give that of plane 1")
        first = v if first is None else first
        if abs(float(v @ first)) < 1 - 1e-9:
            raise element.card.error("its plane 1 is turned against that of the first element")
    if first is None:
        first = _any_plane(model, elements[0], axis)
    lateral = first if plane == 1 else np.cross(axis, first)
    return np.stack([axis, lateral, np.cross(axis, lateral)])


def _across(model: Model, element: Element, start: Array | None, axis: Array) -> Array | None:
    """Return the direction of plane 1 across the axis, None where nothing gives it."""
    towards = element.towards
    if towards is None:
        return None
    if isinstance(towards, int):
        begin = model.grid(element.left, element.card).at if start is None else start
        v = model.grid(towards, element.card).at - begin
    else:
        v = towards
    whole = max(float(np.linalg.norm(v)), 1e-300)
    v = v - (v @ axis) * axis
    size = float(np.linalg.norm(v))
    if size < 1e-9 * whole:
        if section(model, element).round:
            return None
        raise element.card.error("its orientation runs along the beam; give a vector across it")
    return np.asarray(v / size)


def _any_plane(model: Model, element: Element, axis: Array) -> Array:
    """Return the direction of bending of sections that are alike in all: that given, or y or z."""
    v = _across(model, element, None, axis)
    if v is not None:
        return v
    own = model.grids[element.left].axes
    v = min(own[[1, 2, 0]], key=lambda row: round(abs(float(row @ axis)), 9))
    v = v - (v @ axis) * axis
    return np.asarray(v / np.linalg.norm(v))
