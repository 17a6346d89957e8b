"""The cards of a beam along one line, checked: grids, elements, properties, what is attached.

Every card that is not understood is refused by its name and line, since what is left out would
change the frequencies.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.text import short

from .cards import Card, Deck


@dataclass(frozen=True)
class Grid:
    """A grid point: position and the freedoms that it holds for good."""

    at: Array
    held: str
    card: Card


@dataclass(frozen=True)
class Element:
    """A CBAR or CBEAM: property, grids, and the vector that spans plane 1 with its axis."""

    prop: int
    left: int
    right: int
    towards: Array | int
    card: Card


@dataclass(frozen=True)
class Section:
    """A property at fractions 0 ... 1 of an element; columns are fraction, A, I1, I2, NSM."""

    material: int
    rows: Array
    card: Card


@dataclass
class Model:
    """What the deck holds, by number; filled card by card."""

    deck: Deck
    grids: dict[int, Grid] = field(default_factory=dict)
    elements: dict[int, Element] = field(default_factory=dict)
    sections: dict[int, Section] = field(default_factory=dict)
    materials: dict[int, tuple[float, float]] = field(default_factory=dict)
    masses: list[Card] = field(default_factory=list)
    springs: list[Card] = field(default_factory=list)
    links: list[Card] = field(default_factory=list)
    supports: list[tuple[int, int, str, Card]] = field(default_factory=list)
    forces: list[Card] = field(default_factory=list)
    mass_factor: float = 1.0
    sheared: bool = False

    def grid(self, number: int, card: Card) -> Grid:
        """Return a grid that a card names."""
        if number not in self.grids:
            raise card.error(f"there is no GRID {number}")
        return self.grids[number]


def read_model(deck: Deck) -> Model:
    """Sort the cards of a deck.

    Raises
    ------
    InputError
        If a card is not understood.
    """
    model = Model(deck)
    for card in deck.cards:
        if card.name in _PASSED:
            continue
        if card.name not in _READERS:
            raise card.error(
                f"this card is not understood; known are {', '.join(sorted(_READERS))}: remove it, "
                "or what depends on it"
            )
        _READERS[card.name](model, card)
    if not model.elements:
        raise InputError(f"{deck.path}: there is no CBAR or CBEAM; check that this is a beam")
    return model


def _new(table: dict[int, object], number: int, card: Card) -> None:
    if number < 1:
        raise card.error(f"the number {number} is not positive")
    if number in table:
        raise card.error(f"there is another one of the number {number}; remove one")


def _grid(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.grids, number, card)  # type: ignore[arg-type]
    card.zero((2, 6), "a coordinate system")
    held = card.text(7)
    if held and not set(held) <= set("0123456"):
        raise card.error(f"field 7 is {short(held)}; freedoms 1 to 6 may stand there")
    model.grids[number] = Grid(np.array([card.real(i, 0.0) for i in (3, 4, 5)]), held, card)


def _element(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.elements, number, card)  # type: ignore[arg-type]
    if card.text(8) not in ("", "GGG"):
        raise card.error(f"field 8 is {short(card.text(8))}; only offsets GGG can be read")
    card.zero((9, 10), "a pin flag")
    card.zero(range(11, 17), "an offset")
    towards: Array | int = (
        card.integer(5)
        if card.text(5).isdigit() and not card.text(6)
        else np.array([card.real(i, 0.0) for i in (5, 6, 7)])
    )
    if not isinstance(towards, int) and not np.any(towards):
        raise card.error("fields 5 to 7 hold no orientation; give the vector of plane 1")
    model.elements[number] = Element(
        card.integer(2, number), card.integer(3), card.integer(4), towards, card
    )


def _pbar(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.sections, number, card)  # type: ignore[arg-type]
    card.zero((19,), "a product of inertia I12")
    row = [0.0, *(card.real(i, 0.0) for i in (3, 4, 5, 7))]
    model.sections[number] = Section(card.integer(2), np.array([row, [1.0, *row[1:]]]), card)
    model.sheared |= any(card.real(i, 0.0) != 0 for i in (17, 18))


def _pbeam(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.sections, number, card)  # type: ignore[arg-type]
    card.zero((6,), "a product of inertia I12")
    rows = [[0.0, *(card.real(i, 0.0) for i in (3, 4, 5, 8))]]
    place = 9 if _is_station(card, 9) else 17
    while _is_station(card, place):
        rows.append(_station(card, place, rows[0]))
        place += 16 if card.text(place).upper() == "YES" else 8
    card.zero((place + 4, place + 5, *range(place + 8, place + 16)), "NSI, or an offset,")
    if rows[-1][0] != 1.0:
        rows.append([1.0, *rows[0][1:]])
    rows.sort()
    model.sections[number] = Section(card.integer(2), np.array(rows), card)
    model.sheared |= card.text(place) == "" or card.real(place, 1.0) != 0


def _is_station(card: Card, place: int) -> bool:
    return card.text(place).upper() in ("YES", "YESA", "NO")


def _station(card: Card, place: int, start: list[float]) -> list[float]:
    """Return a row of a PBEAM; what it leaves empty is as at end A."""
    at = card.real(place + 1)
    if not 0 < at <= 1:
        raise card.error(f"field {place + 1} is {at:g}; X/XB lies between 0 and 1")
    card.zero((place + 5,), "a product of inertia I12")
    cells = (place + 2, place + 3, place + 4, place + 7)
    return [at, *(card.real(i, a) for i, a in zip(cells, start[1:], strict=True))]


def _mat1(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.materials, number, card)  # type: ignore[arg-type]
    model.materials[number] = card.real(2), card.real(5, 0.0)


def _spc(model: Model, card: Card) -> None:
    for i in (2, 5):
        if card.text(i):
            card.zero((i + 2,), "an enforced displacement")
            _support(model, card, card.integer(i), card.text(i + 1))


def _spc1(model: Model, card: Card) -> None:
    grids = [text for text in card.fields[2:] if text]
    if len(grids) == 3 and grids[1].upper() == "THRU":
        first, last = card.integer(3), card.integer(5)
        for number in sorted(n for n in model.grids if first <= n <= last):
            _support(model, card, number, card.text(2))
        return
    for i in range(3, len(card.fields) + 1):
        if card.text(i):
            _support(model, card, card.integer(i), card.text(2))


def _support(model: Model, card: Card, grid: int, freedoms: str) -> None:
    if not freedoms or not set(freedoms) <= set("123456"):
        raise card.error(f"{short(freedoms)} are no freedoms; 1 to 6 may be held")
    model.supports.append((card.integer(1), grid, freedoms, card))


def _param(model: Model, card: Card) -> None:
    if card.text(1).upper() == "WTMASS":
        model.mass_factor = card.real(2)


_PASSED = {"EIGRL", "EIGR", "ENDDATA", "ECHOON", "ECHOOFF"}
_READERS: dict[str, Callable[[Model, Card], None]] = {
    "GRID": _grid,
    "CBAR": _element,
    "CBEAM": _element,
    "PBAR": _pbar,
    "PBEAM": _pbeam,
    "MAT1": _mat1,
    "CONM2": lambda model, card: model.masses.append(card),
    "CELAS2": lambda model, card: model.springs.append(card),
    "RBE2": lambda model, card: model.links.append(card),
    "SPC": _spc,
    "SPC1": _spc1,
    "FORCE": lambda model, card: model.forces.append(card),
    "PARAM": _param,
}
