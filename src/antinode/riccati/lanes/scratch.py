"""What compiled code writes into, kept by each thread from one call to the next."""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

import numpy as np

from antinode.riccati.arrays import Array

from .structures import Kept
from .workspace import (
    ROWS,
    Chain,
    Levels,
    Room,
    Search,
    new_chain,
    new_lanes,
    new_levels,
    new_room,
    new_search,
)

_KEPT = 16  # sizes of each kind
_MOST_KEPT = 4_000  # segments of shapes: some ten megabytes


def new_table(pieces: int) -> Array:
    """Return a table for so many pieces, and half as many more."""
    return np.empty((ROWS, pieces + pieces // 2))


class Need(NamedTuple):
    """Least room of a chain and of its table."""

    segments: int = 64
    pieces: int = 0

    def is_met(self, levels: Levels) -> bool:
        """Tell whether there is so much."""
        room = len(levels.chain.length) >= self.segments
        return room and levels.table.shape[1] >= self.pieces


class _Scratch(threading.local):
    """Structures of one thread, by their size."""

    def __init__(self) -> None:
        self.lanes = Kept(new_lanes())
        self.columns = new_table(0)
        self.chains: dict[tuple[int, ...], Kept[Chain]] = {}
        self.searches: dict[int, Kept[Search]] = {}
        self.beams: dict[tuple[int, int, int], Kept[Levels]] = {}
        self.shapes = Kept(new_room(64))

    def table(self, pieces: int) -> Array:
        """Return a table of pieces with at least so many columns."""
        if self.columns.shape[1] < pieces:
            self.columns = new_table(pieces)
        return self.columns

    def chain(self, law: int, left: int, right: int, segments: int) -> Kept[Chain]:
        """Return room for a chain without points."""
        key = law, left, right, segments
        if key not in self.chains:
            _make_room(self.chains)
            self.chains[key] = Kept(new_chain(*key))
        return self.chains[key]

    def room(self, segments: int) -> Kept[Room]:
        """Return room for shapes along at least so many segments."""
        if segments <= len(self.shapes.structure.own.stiffness):
            return self.shapes
        room = Kept(new_room(segments))
        if segments <= _MOST_KEPT:
            self.shapes = room
        return room

    def search(self, roots: int) -> Kept[Search]:
        """Return what `search.find_roots` writes into."""
        if roots not in self.searches:
            _make_room(self.searches)
            self.searches[roots] = Kept(new_search(roots))
        return self.searches[roots]

    def levels(self, law: int, intervals: int, roots: int, need: Need) -> Kept[Levels]:
        """Return what `levels.solve_levels` takes and writes into, with at least so much room."""
        key = law, intervals, roots
        kept = self.beams.get(key)
        if kept is None or not need.is_met(kept.structure):
            _make_room(self.beams)
            table = self.table(need.pieces)
            kept = Kept(new_levels(law, intervals, 2 * need.segments, table, roots))
            self.beams[key] = kept
        return kept


def _make_room(kept: dict[Any, Any]) -> None:
    if len(kept) >= _KEPT:
        kept.clear()


scratch = _Scratch()
