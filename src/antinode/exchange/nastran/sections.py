"""Properties of elements along them: PBAR, PBARL, PBEAM and PBEAML.

What a station between the ends of a PBEAM leaves empty runs linearly from end A to end B; what end
B leaves empty is as at end A. Stations may come in any order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from antinode.arrays import Array
from antinode.text import nearest, short

from .cards import Card
from .cross_sections import DIMENSIONS, cross_section

COLUMNS = ("A", "I1", "I2", "I12", "J", "NSM", "NSI", "K1", "K2")
"""Of a section at a station; NSM is mass per length that carries nothing, NSI its polar inertia.

K1 and K2 are factors of shear: kGA = K G A in planes 1 and 2; 0 is rigid."""
_SYMMETRIC = ("ROD", "TUBE", "TUBE2", "BAR", "BOX", "I1", "CROSS", "H", "Z", "HEXA")


Row = dict[str, float | None]
"""Columns at a station; None where a card leaves them empty."""
Stations = dict[float, Row]


@dataclass(frozen=True)
class Section:
    """A property along an element.

    Attributes
    ----------
    material : int
    at : array, shape (n,)
        Fractions 0 ... 1 of the element.
    columns : dict
        `COLUMNS` at these, linear between them.
    shear : bool
        Whether the deck itself gives K1 or K2.
    neutral : array, shape (2,)
        The neutral axis in y and z from the line of the element's ends.
    card : Card
    notes : tuple of str
        What of the card is left out.
    """

    material: int
    at: Array
    columns: dict[str, Array]
    card: Card
    shear: bool = False
    neutral: Array = field(default_factory=lambda: np.zeros(2))
    notes: tuple[str, ...] = ()

    @property
    def round(self) -> bool:
        """Whether all directions of bending are alike."""
        I1, I2, I12 = (self.columns[name] for name in ("I1", "I2", "I12"))
        return bool(np.all(np.abs(I1 - I2) <= 1e-9 * I1) and np.all(np.abs(I12) <= 1e-9 * I1))


def section_of(card: Card, nu: float) -> Section:
    """Return the section of a card, of a material with this Poisson's ratio."""
    return READERS[card.name](card, nu)


def _uniform(card: Card, row: dict[str, float], *, shear: bool = False) -> Section:
    columns = {name: np.full(2, row.get(name, 0.0)) for name in COLUMNS}
    return Section(card.integer(2), np.array([0.0, 1.0]), columns, card, shear)


def _pbar(card: Card, _: float) -> Section:
    """Read a PBAR; where it has I12 its shear factors do not count in NASTRAN."""
    fields = {"A": 3, "I1": 4, "I2": 5, "J": 6, "NSM": 7, "I12": 19, "K1": 17, "K2": 18}
    row = {name: card.real(i, 0.0) for name, i in fields.items()}
    if row["I12"]:
        row |= {"K1": 0.0, "K2": 0.0}
    return _uniform(card, row, shear=bool(row["K1"] or row["K2"]))


def _pbarl(card: Card, nu: float) -> Section:
    kind, count = _kind(card)
    return _uniform(card, _shape(card, kind, 9, count, nu))


def _kind(card: Card) -> tuple[str, int]:
    """Return the type of a cross-section and how many dimensions it has."""
    group, kind = card.text(3).upper(), card.text(4).upper()
    if group not in ("", "MSCBML0", "MSCBML"):
        raise card.error(f"the group {short(group)} of sections is not known; give a PBAR or PBEAM")
    if kind not in DIMENSIONS:
        say = f"there is no type {short(kind)} of section; {nearest(kind, list(DIMENSIONS))}"
        raise card.error(say)
    return kind, DIMENSIONS[kind]


def _shape(card: Card, kind: str, first: int, count: int, nu: float) -> dict[str, float]:
    """Return the columns of a cross-section whose dimensions begin at a field."""
    dimensions = [card.real(first + i) for i in range(count)]
    return _columns(card, kind, dimensions, nu) | {"NSM": card.real(first + count, 0.0)}


def _columns(card: Card, kind: str, dimensions: list[float], nu: float) -> dict[str, float]:
    try:
        return cross_section(kind, dimensions, nu)._asdict()
    except ValueError as error:
        raise card.error(f"{kind}: {error}; correct them") from error


def _pbeam(card: Card, _: float) -> Section:
    names = ("A", "I1", "I2", "I12", "J", "NSM")
    ends: Stations = {0.0: {name: card.real(3 + i, 0.0) for i, name in enumerate(names)}}
    place = 9 if _is_station(card, 9) else 17
    while _is_station(card, place):
        at = _fraction(card, place + 1)
        _check_new(card, place + 1, at, ends)
        ends[at] = {
            name: card.real(place + 2 + i) if card.text(place + 2 + i) else None
            for i, name in enumerate(names)
        }
        place += 16 if card.text(place).upper() == "YES" else 8
    fractions, columns = _filled(ends)
    nsi = card.real(place + 4, 0.0)
    columns["NSI"] = nsi + (card.real(place + 5, nsi) - nsi) * fractions
    for i, name in enumerate(("K1", "K2")):
        columns[name] = np.full(len(fractions), card.real(place + i, 1.0))
    _check_mass_on_axis(card, place + 8, columns)
    given = bool(card.text(place) or card.text(place + 1))
    neutral = _neutral(card, place + 12)
    return Section(card.integer(2), fractions, columns, card, given, neutral)


def _is_station(card: Card, place: int) -> bool:
    return card.text(place).upper() in ("YES", "YESA", "NO")


def _fraction(card: Card, place: int) -> float:
    at = card.real(place, 1.0)
    if not 0 < at <= 1:
        raise card.error(f"field {place} is {at:g}; X/XB lies between 0 and 1")
    return at


def _check_new(card: Card, place: int, at: float, others: Stations) -> None:
    if at in others:
        raise card.error(f"field {place} is {at:g}, where another station stands; remove one")


def _filled(stations: Stations) -> tuple[Array, dict[str, Array]]:
    """Return fractions in order, and columns with what is empty filled in."""
    start = stations[0.0]
    end = {n: start[n] if v is None else v for n, v in stations.get(1.0, start).items()}
    at = np.array(sorted({*stations, 1.0}))
    table = stations | {1.0: end}
    columns = {}
    for name in COLUMNS:
        a, b = start.get(name) or 0.0, end.get(name) or 0.0
        given = [(table[x].get(name), x) for x in at.tolist()]
        columns[name] = np.array([a + (b - a) * x if v is None else v for v, x in given])
    return at, columns


def _neutral(card: Card, place: int) -> Array:
    """Return N1, N2 of a PBEAM, which must be the same at both ends."""
    start = [card.real(place + i, 0.0) for i in (0, 1)]
    end = [card.real(place + 2 + i, a) for i, a in enumerate(start)]
    if start != end:
        raise card.error(
            "the neutral axis (N1, N2) is not parallel to the element; only that reads"
        )
    return np.array(start)


def _check_mass_on_axis(card: Card, place: int, columns: dict[str, Array]) -> None:
    """Refuse mass beside the neutral axis."""
    if any(card.real(place + i, 0.0) for i in range(4)) and np.any(columns["NSM"]):
        raise card.error(
            f"NSM stands beside the axis (M1, M2 from field {place} on), which couples bending "
            "and torsion; only mass on the axis is read"
        )


def _pbeaml(card: Card, nu: float) -> Section:
    kind, count = _kind(card)
    ends: Stations = {0.0: dict(_shape(card, kind, 9, count, nu))}
    place = 9 + count + 1
    while place <= len(card.fields) and any(card.fields[place - 1 : place + count + 2]):
        at = _fraction(card, place + 1)
        _check_new(card, place + 1, at, ends)
        ends[at] = _station(card, kind, place + 2, count, nu)
        place += count + 3
    fractions, columns = _filled(ends)
    notes = () if kind in _SYMMETRIC else (f"the shear centre of {kind} beside its neutral axis",)
    return Section(card.integer(2), fractions, columns, card, notes=notes)


def _station(card: Card, kind: str, place: int, count: int, nu: float) -> Row:
    """Return a station of a PBEAML; at end B an empty dimension is as at end A."""
    texts = [card.text(place + i) for i in range(count)]
    at = card.real(place - 1, 1.0)
    if at < 1 and not all(texts):
        raise card.error(
            f"at X/XB = {at:g} a dimension is empty; fill it in, or remove the station"
        )
    dimensions = [card.real(place + i if text else 9 + i) for i, text in enumerate(texts)]
    nsm = card.real(place + count) if card.text(place + count) else None
    return {**_columns(card, kind, dimensions, nu), "NSM": nsm}


READERS: dict[str, Callable[[Card, float], Section]] = {
    "PBAR": _pbar,
    "PBARL": _pbarl,
    "PBEAM": _pbeam,
    "PBEAML": _pbeaml,
}
