"""The cards of a deck sorted into a model, and checked.

A card that would change the frequencies and is not understood is refused by its name and line. Of a
larger model, of which only some elements are read, all else is left out, and listed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.text import short

from .cards import Card
from .coordinates import Systems, systems_of
from .deck import Deck
from .model import NU, Elastic, Element, Grid, Link, Material, Model
from .passed import CHOSEN, ELEMENTS, PASSED, REDUCTIONS, UNLISTED
from .sections import READERS as SECTIONS
from .sections import section_of


def read_model(deck: Deck, wanted: tuple[range, ...] = ()) -> Model:
    """Sort the cards of a deck.

    Parameters
    ----------
    deck : Deck
    wanted : tuple of range
        Numbers of the elements to read; empty for all.

    Raises
    ------
    InputError
        If a card is not understood.
    """
    named: dict[str, list[Card]] = {}
    for card in deck.cards:
        named.setdefault(card.name, []).append(card)
    model = Model(deck, _systems(named), wanted)
    for name, reader in _READERS.items():
        for card in named.pop(name, ()):
            reader(model, card)
    for name, cards in named.items():
        _pass(model, name, cards)
    _check_elements(model, named)
    return model


def _systems(named: dict[str, list[Card]]) -> Systems:
    """Return the coordinate systems, with the grids that they may refer to."""
    default = next(iter(named.get("GRDSET", ())), None)
    grids: dict[int, Card] = {}
    for k, card in enumerate(named.get("GRID", ())):
        card = card.filled(default, (2,), (6,), (7,))
        named["GRID"][k] = card
        number = card.integer(1)
        _new(grids, number, card)
        grids[number] = card
    names = [n for n in named if n.startswith(("CORD1", "CORD2"))]
    return systems_of([card for name in names for card in named.pop(name)], grids)


def _pass(model: Model, name: str, cards: list[Card]) -> None:
    """Count cards that do not matter; refuse others."""
    chosen = [
        f"{own} = {case.settings[own]}"
        for own in CHOSEN.get(name, ())
        for case in model.deck.subcases
        if own in case.settings
    ]
    if name in PASSED or (name in CHOSEN and not chosen) or model.wanted:
        model.passed[name] += len(cards)
        return
    if chosen:
        instead = "write a rigid link as RBE2, or " if name.startswith("MPC") else ""
        raise cards[0].error(
            f"the case control chooses {chosen[0]}, which is not read: {instead}take it out of the "
            "case control"
        )
    if name in ELEMENTS:
        raise cards[0].error(
            "it is no element of a beam; name those that are with --elements, e.g. --elements "
            "100:140"
        )
    known = ", ".join(sorted(_READERS))
    raise cards[0].error(
        f"this card is not understood; read are {known}: remove it, or what depends on it"
    )


def _check_elements(model: Model, others: Iterable[str]) -> None:
    if model.elements:
        return
    if model.wanted:
        raise InputError(
            f"{model.deck.path}: --elements: the deck has no CBAR or CBEAM of these numbers"
        )
    raise InputError(f"{model.deck.path}: there is no CBAR or CBEAM; check that this is a beam")


def passed_notes(model: Model) -> tuple[str, ...]:
    """Say which cards were passed over."""
    model.passed.update(model.systems.unused())
    left = {name: n for name, n in sorted(model.passed.items()) if name not in UNLISTED}
    words = ", ".join(f"{n} {name}" for name, n in left.items())
    notes = []
    if model.wanted and left:
        notes.append(f"left out of the model: {words}; where they join the beam they would hold it")
    elif left:
        notes.append(f"passed over, since they bear no part in the modes: {words}")
    if REDUCTIONS & set(left):
        notes.append("a solver would condense this model to its ASET; these modes are uncondensed")
    return tuple(notes)


def _new(table: Mapping[int, object], number: int, card: Card) -> None:
    if number < 1:
        raise card.error(f"the number {number} is not positive")
    if number in table:
        raise card.error(f"there is another one of the number {number}; remove one")


def _default(model: Model, card: Card) -> None:
    model.defaults[card.name] = card


def _grid(model: Model, card: Card) -> None:
    number = card.integer(1)
    at = model.systems.grid(number, card)
    axes = model.systems.directions(card.integer(6, 0), at, card)
    model.grids[number] = Grid(at, axes, card.freedoms(7), card)


def _element(model: Model, card: Card) -> None:
    number = card.integer(1)
    if not model.wants(number):
        model.passed[card.name] += 1
        return
    card = card.filled(model.defaults.get("BAROR" if card.name == "CBAR" else "BEAMOR"), *_FILLED)
    _new(model.elements, number, card)
    left, right = (model.grid(card.integer(i), card) for i in (3, 4))
    frames, prop = _frames(card), card.integer(2, number)
    model.used.add(prop)
    model.elements[number] = Element(
        prop,
        card.integer(3),
        card.integer(4),
        _towards(card, left.axes if frames[0] == "G" else np.eye(3)),
        _offsets(card, frames, (left, right)),
        card.freedoms(9) + card.freedoms(10),
        card,
    )


_FILLED = (2,), (5, 6, 7), (8,)


def _frames(card: Card) -> str:
    """Return the letters of the frames of orientation and offsets: G, those of the grids.

    Old decks say there whether the orientation is a vector, 1, or a grid, 2.
    """
    frames = card.text(8).upper()
    if frames in ("", "1", "2"):
        return "GGG"
    if len(frames) != 3 or frames[0] not in "GB" or set(frames[1:]) - set("GO"):
        raise card.error(f"field 8 is {short(card.text(8))}; GGG or BGG can be read")
    return frames


def _towards(card: Card, axes: Array) -> Array | int | None:
    if card.text(5).isdigit() and not card.text(6) and not card.text(7):
        return card.integer(5)
    vector = np.array([card.real(i, 0.0) for i in (5, 6, 7)])
    return vector @ axes if np.any(vector) else None


def _offsets(card: Card, frames: str, grids: tuple[Grid, Grid]) -> Array:
    given = np.array([[card.real(3 * e + i, 0.0) for i in (11, 12, 13)] for e in (0, 1)])
    for vector, letter in zip(given, frames[1:], strict=True):
        if letter == "O" and np.any(vector):
            raise card.error("an offset in the element's own directions (O) is not read; give it G")
    return np.stack([v @ grid.axes for v, grid in zip(given, grids, strict=True)])


def _section(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.sections, number, card)
    if number in model.used:
        material = model.materials.get(card.integer(2))
        model.sections[number] = section_of(card, material.nu if material else NU)


def _mat1(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.materials, number, card)
    E, G, nu = (card.real(i) if card.text(i) else None for i in (2, 3, 4))
    if E is None and G is not None and nu is not None:
        E = 2 * (1 + nu) * G
    if G is None and E is not None and nu is not None:
        G = E / (2 * (1 + nu))
    if E is None:
        raise card.error("it gives no E; fill in field 2")
    model.materials[number] = Material(E, G or 0.0, card.real(5, 0.0), card.real(8, 0.0))


def _celas(model: Model, card: Card) -> None:
    k = card.real(2) if card.name == "CELAS2" else _pelas(model, card)
    pairs = [(card.integer(3, 0), card.integer(4, 0)), (card.integer(5, 0), card.integer(6, 0))]
    model.springs.append(Elastic(k, tuple(p for p in pairs if p[0]), card))


def _pelas(model: Model, card: Card) -> float:
    number = card.integer(2, card.integer(1))
    if number not in model.stiffness:
        raise card.error(f"there is no PELAS {number}")
    return model.stiffness[number].real(2)


def _store_pelas(model: Model, card: Card) -> None:
    for first in (1, 5):
        if card.text(first):
            number = card.integer(first)
            _new(model.stiffness, number, card)
            fields = card.fields[first - 1 : first + 3]
            model.stiffness[number] = Card(card.name, card.line, fields, card.path)


def _store_pbush(model: Model, card: Card) -> None:
    number = card.integer(1)
    _new(model.bushes, number, card)
    model.bushes[number] = card


def _bush(model: Model, card: Card) -> None:
    """Read a CBUSH to the ground, in the directions of its grid."""
    number, grid = card.integer(2, card.integer(1)), card.integer(3)
    if card.text(4):
        _unread(
            model,
            card,
            "it joins two grids; only one to the ground is read: write a joint as CELAS2 and RBE2",
        )
        return
    if number not in model.bushes:
        raise card.error(f"there is no PBUSH {number}")
    if grid in model.grids:
        frame = model.systems.directions(card.integer(8, 0), model.grids[grid].at, card)
        if not np.allclose(frame, model.grids[grid].axes):
            raise card.error("its coordinate system is not that of its grid; only that is read")
    prop = model.bushes[number]
    at = next((i for i in range(2, len(prop.fields)) if prop.text(i).upper() == "K"), 0)
    for freedom in range(1, 7) if at else ():
        k = prop.real(at + freedom, 0.0)
        if k:
            model.springs.append(Elastic(k, ((grid, freedom),), card))


def _rbe2(model: Model, card: Card) -> None:
    grids = card.numbers(4, model.grids)
    model.links.append(Link(card.integer(2), card.freedoms(3), grids, card))


def _crigd1(model: Model, card: Card) -> None:
    """Read the rigid element of NASTRAN's first decades, which ties all freedoms."""
    grids = card.numbers(3, model.grids)
    model.links.append(Link(card.integer(2), "123456", grids, card))


def _rbar(model: Model, card: Card) -> None:
    a, b = card.integer(2), card.integer(3)
    if card.freedoms(4) == "123456" and not card.text(5):
        model.links.append(Link(a, card.freedoms(7) or "123456", (b,), card))
    elif card.freedoms(5) == "123456" and not card.text(4):
        model.links.append(Link(b, card.freedoms(6) or "123456", (a,), card))
    else:
        _unread(model, card, "one of its grids must be independent in 123456; only that is read")


def _unread(model: Model, card: Card, what: str) -> None:
    """Refuse a card; of a larger model it is left out."""
    if not model.wanted:
        raise card.error(what)
    model.passed[card.name] += 1


def _spc(model: Model, card: Card) -> None:
    for i in (2, 5):
        if card.text(i):
            _support(model, card, card.integer(i), card.freedoms(i + 1))


def _spc1(model: Model, card: Card) -> None:
    for number in card.numbers(3, model.grids):
        _support(model, card, number, card.freedoms(2))


def _support(model: Model, card: Card, grid: int, freedoms: str) -> None:
    if not freedoms and grid not in model.grids:
        return  # a scalar point
    if not freedoms:
        _unread(model, card, "it names no freedoms; 1 to 6 may be held")
        return
    model.supports.append((card.integer(1), grid, freedoms, card))


def _spcadd(model: Model, card: Card) -> None:
    sets = tuple(card.integer(i) for i in range(2, len(card.fields) + 1) if card.text(i))
    _new(model.unions, card.integer(1), card)
    model.unions[card.integer(1)] = sets


def _param(model: Model, card: Card) -> None:
    if card.text(1).upper() == "WTMASS":
        model.mass_factor = card.real(2)


_READERS: dict[str, Callable[[Model, Card], None]] = {
    "GRDSET": _default,
    "BAROR": _default,
    "BEAMOR": _default,
    "GRID": _grid,
    "CBAR": _element,
    "CBEAM": _element,
    "MAT1": _mat1,
    **dict.fromkeys(SECTIONS, _section),
    "CONM2": lambda model, card: model.masses.append(card),
    "PELAS": _store_pelas,
    "CELAS1": _celas,
    "CELAS2": _celas,
    "PBUSH": _store_pbush,
    "CBUSH": _bush,
    "RBE2": _rbe2,
    "CRIGD1": _crigd1,
    "RBAR": _rbar,
    "SPC": _spc,
    "SPC1": _spc1,
    "SPCADD": _spcadd,
    "FORCE": lambda model, card: model.forces.append(card),
    "LOAD": lambda model, card: model.loads.append(card),
    "GRAV": lambda model, card: model.loads.append(card),
    "PARAM": _param,
}
"""In the order in which they are read: what a card refers to stands above it."""
