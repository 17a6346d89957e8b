"""A line of bulk data as its fields: small, large and free.

A line is ten fields of 8 characters, or name, four fields of 16 and continuation where the name
ends in `*`, or fields between commas where one stands in the first ten columns; more than ten of
these go on as on a next line.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from antinode.text import short

from .lines import Line

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,7}\*?$")


class Fields(NamedTuple):
    """The fields of a line.

    Attributes
    ----------
    head : str
        The name of a card, upper case; or what marks a continuation or a repetition.
    data : list of str
        Eight, or four large ones.
    marks : frozenset of str
        By which the card goes on, two readings of it; empty if it names none.
    """

    head: str
    data: list[str]
    marks: frozenset[str] = frozenset()

    @property
    def head_mark(self) -> str:
        """By which a continuation names its card."""
        return self.head[1:].strip()

    @property
    def continues(self) -> bool:
        """Whether the line belongs to a card above it, or below."""
        return self.head[:1] in ("", "+", "*")

    @property
    def repeats(self) -> bool:
        """Whether the line repeats fields of the one before it."""
        return self.head[:1] == "=" or any(c in ("=", "==") or is_step(c) for c in self.data)


def is_step(cell: str) -> bool:
    """Tell whether a field adds to that of the line before: `*(2)`."""
    return cell[:2] == "*(" or cell[:2] == "%("


def fields_of(line: Line) -> Fields:
    """Return the fields of a line.

    Raises
    ------
    InputError
        If they are none of a card.
    """
    text = line.text.expandtabs(8)
    if "," in text[:10]:
        head, *cells = [cell.strip() for cell in text.split(",")]
        width = 4 if head.endswith("*") or head.startswith("*") else 8
        if len(cells) > 9:  # it goes on at once, without a mark between
            cells, width = _long(line, cells), -(-len(cells) // 8) * 8
    else:
        head = text[:8].strip()
        size = 16 if "*" in head else 8
        width = 64 // size
        cells = [text[8 + size * i : 8 + size * (i + 1)].strip() for i in range(width)]
        cells.append(text[72:80].strip())
    data = (cells + [""] * width)[:width]
    found = Fields(head, data, _marks("".join(cells[width:]).strip()))
    if found.continues or head[0] == "=":
        return found
    head = head.rstrip("*").rstrip() + "*" * head.endswith("*")
    if not _NAME.match(head):
        raise line.error(f"{short(head)} is no name of a card")
    return found._replace(head=head.rstrip("*").upper())


def _long(line: Line, cells: list[str]) -> list[str]:
    """Return the fields of a line that has more than ten.

    Raises
    ------
    InputError
        If a mark stands among them.
    """
    if re.match(r"[+*]\D", cells[8]) and any(cells[9:]):
        raise line.error(
            f"fields follow on {short(cells[8])}, by which the card goes on; write them on the "
            "next line"
        )
    return cells[:8] if re.match(r"[+*]", cells[8]) and not any(cells[9:]) else cells


def _marks(text: str) -> frozenset[str]:
    """Return the readings of a mark: its first character counts nothing, or is left out."""
    return frozenset({text, text[1:].strip()}) - {"", "+", "*"}
