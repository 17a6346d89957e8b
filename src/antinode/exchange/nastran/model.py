"""What a deck holds of a beam, by number: grids, elements, properties, what is attached."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from antinode.arrays import Array
from antinode.errors import InputError

from .cards import Card
from .coordinates import Systems
from .deck import Deck
from .sections import Section


@dataclass(frozen=True)
class Grid:
    """A grid point: place, the directions of its freedoms as rows, and which it holds for good."""

    at: Array
    axes: Array
    held: str
    card: Card


@dataclass(frozen=True)
class Element:
    """A CBAR or CBEAM.

    Attributes
    ----------
    prop, left, right : int
        Property and grids A and B.
    towards : array or int or None
        Spans plane 1 with the axis: a vector, or a grid.
    offsets : array, shape (2, 3)
        Of ends A and B from their grids.
    pins : str
        Freedoms of the element's own frame that either end releases.
    card : Card
    """

    prop: int
    left: int
    right: int
    towards: Array | int | None
    offsets: Array
    pins: str
    card: Card


@dataclass(frozen=True)
class Material:
    """Of MAT1: E, G (0 where it is not known), density, loss factor, in units of the file."""

    E: float
    G: float
    rho: float
    loss: float = 0.0

    @property
    def nu(self) -> float:
        """Poisson's ratio, from E and G."""
        nu = self.E / (2 * self.G) - 1 if self.G > 0 else NU
        return nu if 0 <= nu < 0.5 else NU


NU = 0.3
"""Poisson's ratio where none is given: of metals."""


@dataclass(frozen=True)
class Elastic:
    """A scalar spring between freedoms of grids, or of one and the ground."""

    k: float
    ends: tuple[tuple[int, int], ...]
    card: Card


@dataclass(frozen=True)
class Link:
    """Freedoms of grids tied to one grid by a rigid body."""

    to: int
    freedoms: str
    grids: tuple[int, ...]
    card: Card


@dataclass
class Model:
    """What the deck holds, by number; filled card by card.

    Attributes
    ----------
    wanted : tuple of range
        Numbers of the elements to read; empty for all.
    supports : list of tuple
        Set, grid, freedoms, card.
    used : set
        Numbers of the properties of the elements.
    passed : Counter
        Cards passed over by name.
    notes : list of str
        What else of the deck is not taken as it stands.
    """

    deck: Deck
    systems: Systems
    wanted: tuple[range, ...] = ()
    grids: dict[int, Grid] = field(default_factory=dict)
    elements: dict[int, Element] = field(default_factory=dict)
    sections: dict[int, Section] = field(default_factory=dict)
    materials: dict[int, Material] = field(default_factory=dict)
    masses: list[Card] = field(default_factory=list)
    springs: list[Elastic] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    supports: list[tuple[int, int, str, Card]] = field(default_factory=list)
    unions: dict[int, tuple[int, ...]] = field(default_factory=dict)
    forces: list[Card] = field(default_factory=list)
    loads: list[Card] = field(default_factory=list)
    defaults: dict[str, Card] = field(default_factory=dict)
    stiffness: dict[int, Card] = field(default_factory=dict)
    bushes: dict[int, Card] = field(default_factory=dict)
    used: set[int] = field(default_factory=set)
    mass_factor: float = 1.0
    passed: Counter[str] = field(default_factory=Counter)
    notes: list[str] = field(default_factory=list)

    def grid(self, number: int, card: Card) -> Grid:
        """Return a grid that a card names."""
        if number not in self.grids:
            raise card.error(f"there is no GRID {number}")
        return self.grids[number]

    def wants(self, element: int) -> bool:
        """Tell whether an element is to be read."""
        return not self.wanted or any(element in numbers for numbers in self.wanted)

    def chosen_supports(self, number: int) -> set[int]:
        """Return the sets of supports that one number stands for, SPCADD followed.

        Raises
        ------
        InputError
            If there is no such set.
        """
        sets = set(self.unions.get(number, (number,)))
        known = {n for n, *_ in self.supports}
        if not sets & known:
            there = ", ".join(map(str, sorted(known))) or "none"
            raise InputError(
                f"{self.deck.path}: SPC = {number} is chosen, but no SPC card is of that set; "
                f"there are sets {there}: correct the case control"
            )
        return sets
