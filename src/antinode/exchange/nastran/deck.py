"""A NASTRAN file as case control and cards: small, large and free field, continuations, includes.

A line is ten fields of 8 characters, or name, four fields of 16 and continuation where the name
ends in `*`, or fields between commas where one stands in the first ten columns. A continuation
belongs to the card whose tenth field has its name, or else to the card before it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from antinode.errors import InputError
from antinode.inputs.reading import read_bytes
from antinode.text import short

from .cards import Card

MOST_BYTES = 20_000_000
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,7}\*?$")
_INCLUDE = re.compile(r"\s*INCLUDE\s+['\"]?([^'\"]+)['\"]?\s*$", re.I)
_MOST_INCLUDES = 50


@dataclass(frozen=True)
class Subcase:
    """Settings of a subcase of the case control, upper case: SPC, LOAD, METHOD, STATSUB, MPC, NSM.

    Attributes
    ----------
    number : int
        0 for what stands before the first subcase.
    settings : dict
        Whole numbers by name.
    """

    number: int
    settings: dict[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Deck:
    """A NASTRAN file.

    Attributes
    ----------
    path : Path
    solution : str
        What SOL says, upper case; empty if nothing does.
    subcases : tuple of Subcase
        Each with what it takes from above the first one; empty for a file of bulk data alone.
    cards : tuple of Card
    whole : bool
        Whether it ends as it should, by ENDDATA.
    """

    path: Path
    solution: str
    subcases: tuple[Subcase, ...]
    cards: tuple[Card, ...]
    whole: bool = True

    @property
    def buckles(self) -> bool:
        """Whether the deck asks for buckling: its load then stands in the first subcase."""
        return self.solution in ("105", "SEBUCKL", "BUCKLING", "5")


@dataclass(frozen=True)
class Line:
    """A line without its comment, and where it stands."""

    path: Path
    number: int
    text: str

    def error(self, what: str) -> InputError:
        """Return what is wrong with the line as an error that names it."""
        return InputError(f"{self.path}, line {self.number}: {what}")


def read_deck(path: Path) -> Deck:
    """Read a NASTRAN file.

    Raises
    ------
    InputError
        If it, or a file that it includes, cannot be read.
    """
    lines = list(_lines(path, [path]))
    upper = [line.text.upper().split() for line in lines]
    begin = next((i for i, words in enumerate(upper) if _begins_bulk(words)), None)
    cend = any(words[:1] == ["CEND"] for words in upper)
    if cend and begin is None:
        raise InputError(f"{path}: there is no BEGIN BULK after CEND; the file may be cut off")
    first = 0 if begin is None else begin + 1
    last = next((i for i, words in enumerate(upper) if words[:1] == ["ENDDATA"]), None)
    control = lines[: begin or 0]
    solution = [line.text.split()[1] for line in control if _is_solution(line)]
    bulk = [
        line
        for line, words in zip(lines[first:last], upper[first:last], strict=True)
        if not _begins_bulk(words)
    ]
    cards = (*_parameters(control), *_cards(bulk))
    whole = begin is None or last is not None
    return Deck(path, solution[0].upper() if solution else "", _subcases(control), cards, whole)


def _parameters(control: list[Line]) -> Iterator[Card]:
    """Yield PARAM of the case control, where blanks may stand for commas."""
    for line in control:
        name, *fields = re.split(r"[,\s]+", line.text.strip())
        if name.upper() == "PARAM":
            yield Card("PARAM", line.number, tuple(fields), line.path)


def _begins_bulk(words: list[str]) -> bool:
    return words in (["BEGIN"], ["BEGINBULK"]) or words[:2] == ["BEGIN", "BULK"]


def _is_solution(line: Line) -> bool:
    words = line.text.upper().split()
    return len(words) > 1 and words[0] == "SOL"


def _lines(path: Path, above: list[Path]) -> Iterator[Line]:
    """Yield the lines of a file and of those that it includes, in their order."""
    text = read_bytes(path, MOST_BYTES, "a NASTRAN file").decode("utf-8", errors="replace")
    for number, whole in enumerate(text.splitlines(), 1):
        line = Line(path, number, whole.partition("$")[0].rstrip())
        if not (include := _INCLUDE.match(line.text)):
            yield line
            continue
        other = path.parent / include[1].strip()
        if other in above or len(above) > _MOST_INCLUDES:
            raise line.error(f"INCLUDE of {short(str(other))} goes round in a circle")
        if not other.is_file():
            raise line.error(f"INCLUDE: there is no file {short(str(other))}; put it there")
        yield from _lines(other, [*above, other])


_SETTING = re.compile(
    r"\s*(SPC|LOAD|METHOD|STATSUB|MPC|NSM|TEMP\w*|DEFORM)\s*(?:\(.*?\))?\s*=\s*(\d{1,9})\s*$", re.I
)


def _subcases(control: list[Line]) -> tuple[Subcase, ...]:
    """Return the subcases; a case control without any is one subcase."""
    found = [Subcase(0)]
    for line in control:
        if start := re.match(r"\s*SUBCASE\s*=?\s*(\d{1,9})\s*$", line.text, re.I):
            found.append(Subcase(int(start[1]), dict(found[0].settings)))
        elif setting := _SETTING.match(line.text):
            name = setting[1].upper()
            found[-1].settings["TEMP" if name.startswith("TEMP") else name] = int(setting[2])
    return tuple(found[1:] or (found if control else ()))


@dataclass
class _Open:
    """A card to which continuations may still be added."""

    name: str
    line: Line
    fields: list[str]

    def card(self) -> Card:
        return Card(self.name, self.line.number, tuple(self.fields), self.line.path)


def _cards(lines: Iterable[Line]) -> Iterator[Card]:
    found: list[_Open] = []
    waiting: dict[str, _Open] = {}
    for line in lines:
        if not line.text.strip():
            continue
        head, data, marker = _split(line)
        if head[:1] in ("", "+", "*"):
            name = head[1:].strip()
            card = waiting.pop(name, None) if name else None
            card = card or _before(found, name if waiting else "", line)
            card.fields += data
        else:
            card = _Open(head, line, data)
            found.append(card)
        for name in {marker, marker[1:]} - {""}:  # the first character counts nothing in NASTRAN
            waiting[name] = card
    return (card.card() for card in found)


def _before(found: list[_Open], name: str, line: Line) -> _Open:
    """Return the card before a continuation that no card names."""
    if not found:
        raise line.error(f"{short(line.text)} continues a card, but none is before it")
    if name:
        raise line.error(f"no card above it continues as {short(name)}; correct the continuation")
    return found[-1]


def _split(line: Line) -> tuple[str, list[str], str]:
    """Return the name of a line, or what marks a continuation; its fields; how it continues."""
    text = line.text.expandtabs(8)
    if "," in text[:10]:
        head, *cells = [cell.strip() for cell in text.split(",")]
        if len(cells) > 9:
            raise line.error(
                f"{len(cells) + 1} fields between commas; a line has at most ten: continue it on "
                "the next one"
            )
        width = 4 if head.endswith("*") or head.startswith("*") else 8
    else:
        head = text[:8].strip()
        size = 16 if "*" in head else 8
        width = 64 // size
        cells = [text[8 + size * i : 8 + size * (i + 1)].strip() for i in range(width)]
        cells.append(text[72:80].strip())
    data = (cells + [""] * width)[:width]
    marker = "".join(cells[width:]).strip()
    marker = "" if marker in ("+", "*") else marker
    if not head or head[0] in "+*":
        return head, data, marker
    if head[0] == "=" or any(cell in ("=", "==") for cell in data):
        raise line.error("cards that repeat the one before them (=) are not read; write them out")
    if not _NAME.match(head):
        raise line.error(f"{short(head)} is no name of a card")
    return head.rstrip("*").upper(), data, marker
