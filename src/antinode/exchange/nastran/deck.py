"""A NASTRAN file as case control and cards, with their continuations."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from antinode.errors import InputError
from antinode.text import short

from .cards import Card
from .fields import Fields, fields_of
from .lines import Line, Source, begins_bulk
from .repeated import Repetition


@dataclass(frozen=True)
class Subcase:
    """Settings of a subcase of the case control that may change modes, upper case.

    Attributes
    ----------
    number : int
        0 for what stands before the first subcase.
    settings : dict
        Numbers of sets by name; 0 for a set with a name.
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
    missing : tuple of str
        Files included before the bulk data that are not there.
    """

    path: Path
    solution: str
    subcases: tuple[Subcase, ...]
    cards: tuple[Card, ...]
    whole: bool = True
    missing: tuple[str, ...] = ()

    @property
    def buckles(self) -> bool:
        """Whether the deck asks for buckling: its load then stands in the first subcase."""
        return self.solution in ("105", "SEBUCKL", "BUCKLING", "5")


def read_deck(path: Path) -> Deck:
    """Read a NASTRAN file.

    Raises
    ------
    InputError
        If it, or a file that it includes, cannot be read.
    """
    source = Source(path)
    lines = source.lines()
    upper = [line.text.upper().split() for line in lines]
    begin = next((i for i, line in enumerate(lines) if begins_bulk(line.text)), None)
    cend = any(words[:1] == ["CEND"] for words in upper)
    if cend and begin is None:
        raise InputError(f"{path}: there is no BEGIN BULK after CEND; the file may be cut off")
    first = 0 if begin is None else begin + 1
    last = next((i for i, words in enumerate(upper) if words[:1] == ["ENDDATA"]), None)
    control = lines[: begin or 0]
    solution = [line.text.split()[1] for line in control if _is_solution(line)]
    bulk = [line for line in lines[first:last] if not begins_bulk(line.text)]
    for line in bulk:
        if re.match(r"\s*BEGIN\s+\w", line.text, re.I):
            raise line.error(
                f"{line.text.strip()[:40]} begins a part of the model (a superelement), which is "
                "not read; write the beam out as one model"
            )
    cards = (*_parameters(control), *_cards(bulk))
    whole = begin is None or last is not None
    name = solution[0].upper() if solution else ""
    return Deck(path, name, _subcases(control), cards, whole, tuple(source.missing))


def _parameters(control: list[Line]) -> Iterator[Card]:
    """Yield PARAM of the case control, where blanks may stand for commas."""
    for line in control:
        name, *fields = re.split(r"[,\s]+", line.text.strip())
        if name.upper() == "PARAM":
            yield Card("PARAM", line.number, tuple(fields), line.path)


def _is_solution(line: Line) -> bool:
    words = line.text.upper().split()
    return len(words) > 1 and words[0] == "SOL"


_SETTING = re.compile(
    r"\s*(SPC|LOAD|METHOD|STATSUB|MPC|NSM|TEMP\w*|DEFORM|[KM]2(?:GG|PP)|TFL|RGYRO)"
    r"\s*(?:\(.*?\))?\s*=\s*(\w{1,16})\s*$",
    re.I,
)


def _subcases(control: list[Line]) -> tuple[Subcase, ...]:
    """Return the subcases; a case control without any is one subcase."""
    found = [Subcase(0)]
    for line in control:
        if start := re.match(r"\s*SUBCASE\s*=?\s*(\d{1,9})\s*$", line.text, re.I):
            found.append(Subcase(int(start[1]), dict(found[0].settings)))
        elif setting := _SETTING.match(line.text):
            name = setting[1].upper()
            number = int(setting[2]) if setting[2].isdigit() else 0
            found[-1].settings["TEMP" if name.startswith("TEMP") else name] = number
    return tuple(found[1:] or (found if control else ()))


@dataclass
class _Open:
    """A card to which continuations may still be added."""

    name: str
    line: Line
    fields: list[str]
    marks: frozenset[str]

    def go_on(self, own: Fields) -> None:
        """Add a continuation."""
        self.fields += own.data
        self.marks = own.marks

    def card(self) -> Card:
        return Card(self.name, self.line.number, tuple(self.fields), self.line.path)


def _cards(lines: Iterable[Line]) -> Iterator[Card]:
    """Yield the cards of lines of bulk data, continuations at their ends.

    A continuation belongs to the card whose tenth field has its mark, above or below it, or else
    to the card before it.
    """
    rows = [(line, fields_of(line)) for line in lines if line.text.strip()]
    marks = frozenset[str]().union(*(own.marks for _, own in rows))
    heads = {own.head_mark for _, own in rows if own.continues}
    lost = any(own.marks and not own.marks & heads for _, own in rows)
    found: list[_Open] = []
    waiting: dict[str, tuple[Line, Fields]] = {}
    repetition = Repetition()
    for line, own in rows:
        if not own.continues:
            made = repetition.lines(own, line)
            found += [_Open(card.head, line, list(card.data), card.marks) for card in made]
            continue
        if own.repeats:
            raise line.error("a continuation that repeats another (=) is not read; write it out")
        mark = own.head_mark
        if mark in marks and not (found and mark in found[-1].marks):
            if mark in waiting:
                raise line.error(f"another line continues as {short(mark)}; give it another mark")
            waiting[mark] = line, own
        elif mark and lost and mark not in marks:
            raise line.error(f"no card continues as {short(mark)}; correct the continuation")
        elif not found:
            raise line.error(f"{short(line.text)} continues a card, but none is before it")
        else:
            found[-1].go_on(own)
    _join(found, waiting)
    return (card.card() for card in found)


def _join(found: list[_Open], waiting: dict[str, tuple[Line, Fields]]) -> None:
    """Add continuations that do not follow their cards."""
    for card in found if waiting else ():
        while mark := next((m for m in card.marks if m in waiting), ""):
            card.go_on(waiting.pop(mark)[1])
    for mark, (line, _) in waiting.items():
        raise line.error(f"no card continues as {short(mark)}; correct the continuation")
