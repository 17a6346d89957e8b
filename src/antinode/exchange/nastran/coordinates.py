"""Coordinate systems of a deck: rectangular, cylindrical, spherical, one defined in another.

CORD2 gives origin A, a point B on the axis 3 and a point C in the plane 1-3; CORD1 takes grids for
them. Cylindrical coordinates are r, angle [deg], z; spherical ones r, angle from axis 3 [deg],
angle in the plane 1-2 [deg].
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .cards import Card

BASIC = np.eye(3)
_MOST = 50  # systems one in another


@dataclass(frozen=True)
class System:
    """A coordinate system in the basic one: origin, axes as rows, and its kind, R, C or S."""

    origin: Array
    axes: Array
    kind: str

    def place(self, values: Array) -> Array:
        """Return the place of coordinates in the basic system."""
        r, a, b = (float(v) for v in values)
        if self.kind == "R":
            local = values
        elif self.kind == "C":
            local = r * _direction(90.0, a) + np.array([0.0, 0.0, b])
        else:
            local = r * _direction(a, b)
        return np.asarray(self.origin + local @ self.axes)

    def directions(self, place: Array) -> Array:
        """Return the unit vectors of the coordinates at a place, as rows."""
        x, y, z = self.axes @ (place - self.origin)
        if self.kind == "R":
            return self.axes
        around = np.degrees(np.arctan2(y, x))
        e_around = _direction(90.0, around + 90.0)
        if self.kind == "C":
            local = np.array([_direction(90.0, around), e_around, [0.0, 0.0, 1.0]])
        else:
            down = np.degrees(np.arctan2(np.hypot(x, y), z))
            local = np.array([_direction(down, around), _direction(down + 90.0, around), e_around])
        return np.asarray(local @ self.axes)


def _direction(from_3: float, in_12: float) -> Array:
    """Return the unit vector at an angle from axis 3 and one in the plane 1-2 [deg]."""
    a, b = np.radians([from_3, in_12])
    return np.array([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)])


@dataclass
class Systems:
    """The coordinate systems of a deck by number, found when they are asked for.

    Attributes
    ----------
    cards : dict
        Of the systems; the second number counts those of one CORD1 card from 0.
    grids : dict
        Cards of the grids.
    """

    cards: dict[int, tuple[Card, int]]
    grids: dict[int, Card]
    _found: dict[int, System] = field(default_factory=dict)

    def place(self, number: int, values: Array, card: Card) -> Array:
        """Return the place of coordinates in a system."""
        return values if number == 0 else self.system(number, card).place(values)

    def directions(self, number: int, place: Array, card: Card) -> Array:
        """Return the unit vectors of a system at a place, as rows."""
        return BASIC if number == 0 else self.system(number, card).directions(place)

    def grid(self, number: int, card: Card, depth: int = 0) -> Array:
        """Return the place of a grid."""
        if number not in self.grids:
            raise card.error(f"there is no GRID {number}")
        own = self.grids[number]
        values = np.array([own.real(i, 0.0) for i in (3, 4, 5)])
        return self._place(own.integer(2, 0), values, own, depth)

    def system(self, number: int, card: Card, depth: int = 0) -> System:
        """Return a system that a card names.

        Raises
        ------
        InputError
            If it is not there, is defined by itself, or its three points lie on a line.
        """
        if number in self._found:
            return self._found[number]
        if number not in self.cards:
            raise card.error(f"there is no coordinate system {number}")
        own, which = self.cards[number]
        if depth > _MOST:
            raise own.error("it is defined by itself; correct the systems that it refers to")
        A, B, C = self._points(own, which, depth)
        self._found[number] = System(A, _axes(A, B, C, own), own.name[-1])
        return self._found[number]

    def unused(self) -> list[str]:
        """Return the names of the cards of systems that nothing refers to."""
        return [card.name for number, (card, _) in self.cards.items() if number not in self._found]

    def _place(self, number: int, values: Array, card: Card, depth: int) -> Array:
        if number == 0:
            return values
        return self.system(number, card, depth + 1).place(values)

    def _points(self, card: Card, which: int, depth: int) -> tuple[Array, Array, Array]:
        if card.name.startswith("CORD1"):
            A, B, C = (self.grid(card.integer(4 * which + i), card, depth) for i in (2, 3, 4))
        else:
            values = np.array([card.real(i, 0.0) for i in range(3, 12)]).reshape(3, 3)
            A, B, C = (self._place(card.integer(2, 0), v, card, depth) for v in values)
        return A, B, C


def _axes(A: Array, B: Array, C: Array, card: Card) -> Array:
    third = B - A
    second = np.cross(third, C - A)
    sizes = np.linalg.norm(third), np.linalg.norm(second)
    if not sizes[1] > 1e-9 * sizes[0] * np.linalg.norm(C - A):
        raise card.error("its three points lie on a line; correct them")
    third, second = third / sizes[0], second / sizes[1]
    return np.array([np.cross(second, third), second, third])


def systems_of(cards: list[Card], grids: dict[int, Card]) -> Systems:
    """Return the systems of all CORD cards.

    Raises
    ------
    InputError
        If two have one number.
    """
    found: dict[int, tuple[Card, int]] = {}
    for card in cards:
        for which in (0, 1) if card.name.startswith("CORD1") else (0,):
            if which and not card.text(5):
                continue
            number = card.integer(4 * which + 1)
            if number in found:
                raise _twice(card, number)
            found[number] = card, which
    return Systems(found, grids)


def _twice(card: Card, number: int) -> InputError:
    return card.error(f"there is another coordinate system {number}; remove one")
