"""The elements of a deck in order along one line, with the plane in which they bend."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .cards import Card
from .model import Element, Model

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
    right_grids : frozenset of int
        Grids on the right side of a joint.
    frame : array, shape (3, 3)
        Axis, direction of bending, and the normal of both.
    """

    x: Array
    elements: tuple[Element, ...]
    node: dict[int, int]
    right_grids: frozenset[int]
    frame: Array

    def freedoms(self, card: Card) -> tuple[int, int, int]:
        """Return the numbers of axial, lateral and rotational freedom, if the line has them."""
        axis, lateral, normal = (int(np.argmax(np.abs(v))) for v in self.frame)
        if np.any(np.sort(np.abs(self.frame), axis=1)[:, :2] > SAME):
            raise card.error(
                "the beam or its plane of bending is oblique to the axes, so that freedoms cannot "
                "be told apart: turn the model"
            )
        return axis + 1, lateral + 1, normal + 4


def line_of(model: Model, plane: int) -> Line:
    """Order the elements from left to right, or say why they make up no line."""
    used = list(dict.fromkeys(g for e in model.elements.values() for g in (e.left, e.right)))
    cards = {g: e.card for e in model.elements.values() for g in (e.left, e.right)}
    at = np.array([model.grid(g, cards[g]).at for g in used])
    axis, length = _axis(at, model)
    off = np.linalg.norm(at - at[0] - np.outer((at - at[0]) @ axis, axis), axis=1)
    for k in np.flatnonzero(off > SAME * length)[:1]:
        raise model.grids[used[k]].card.error(
            f"grid {used[k]} is {off[k]:.3g} off the line of the others; one straight beam is read"
        )
    along = dict(zip(used, at @ axis, strict=True))
    x = _places(np.array(sorted(along.values())), length)
    node = {g: int(np.argmin(np.abs(x - s))) for g, s in along.items()}
    ordered, right_grids = _ordered(model, node, len(x))
    return Line(x, ordered, node, right_grids, _frame(model, ordered, axis, plane))


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


def _places(x: Array, length: float) -> Array:
    return np.asarray(x[np.append([True], np.diff(x) > 1e-9 * length)])


def _ordered(
    model: Model, node: dict[int, int], places: int
) -> tuple[tuple[Element, ...], frozenset[int]]:
    """Return the elements from left to right, and the grids on the right side of joints."""
    found: dict[int, Element] = {}
    for element in model.elements.values():
        a, b = node[element.left], node[element.right]
        if abs(a - b) != 1:
            between = "has the length 0" if a == b else "runs past another grid of the beam"
            raise element.card.error(f"this element {between}; elements must follow each other")
        if min(a, b) in found:
            other = found[min(a, b)].card.line
            raise element.card.error(f"this element lies beside that of line {other}; remove one")
        found[min(a, b)] = element
    for k in range(places - 1):
        if k not in found:
            raise InputError(f"{model.deck.path}: there is a gap between the elements; close it")
    ordered = tuple(found[k] for k in range(places - 1))
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
            f"grids {left} and {right} stand at one place, but no RBE2 links them across; "
            "merge them, or link them"
        )


def linked(model: Model, left: int, right: int) -> str:
    """Return the freedoms in which an RBE2 ties the right grid to the left one."""
    freedoms = ""
    for card in model.links:
        if card.integer(2) == left and str(right) in card.fields[3:]:
            freedoms += card.text(3)
    return freedoms


def _frame(model: Model, elements: tuple[Element, ...], axis: Array, plane: int) -> Array:
    """Return axis, direction of bending and their normal, the same for all elements."""
    first: Array | None = None
    for element in elements:
        card = element.card
        start = model.grid(element.left, card).at
        towards = element.towards
        v = model.grid(towards, card).at - start if isinstance(towards, int) else towards
        v = v - (v @ axis) * axis
        size = float(np.linalg.norm(v))
        if size < 1e-9 * max(float(np.linalg.norm(towards)), 1e-300):
            raise card.error("its orientation runs along the beam; give a vector across it")
        v = v / size
        first = v if first is None else first
        if abs(float(v @ first)) < 1 - 1e-9:
            raise card.error("its plane 1 is turned against that of the first element")
    assert first is not None
    lateral = first if plane == 1 else np.cross(axis, first)
    return np.stack([axis, lateral, np.cross(axis, lateral)])
