"""NASTRAN's bulk data as cards: small, large and free field, continuations, its own reals.

A line is ten fields of 8 characters, or name, four fields of 16 and continuation where the name
ends in `*`, or fields between commas. A real may leave out its E: `7.0-3` is 0.007.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from antinode.errors import InputError
from antinode.inputs.reading import read_bytes
from antinode.text import short

MOST_BYTES = 20_000_000
_REAL = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[EeDd]?([+-]?\d+))?$")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,7}\*?$")


@dataclass(frozen=True)
class Card:
    """A card with its continuations; fields count from 1, the one after the name.

    Attributes
    ----------
    name : str
    line : int
        On which it starts.
    fields : tuple of str
    path : Path
    """

    name: str
    line: int
    fields: tuple[str, ...]
    path: Path

    def text(self, number: int) -> str:
        """Return a field, empty if it is not there."""
        return self.fields[number - 1] if number <= len(self.fields) else ""

    def real(self, number: int, default: float | None = None) -> float:
        """Return a field as a number, or the default of an empty one."""
        text = self.text(number)
        if not text and default is not None:
            return default
        found = _REAL.match(text)
        if not found:
            raise self.error(f"field {number} is {short(text)}; a number must stand there")
        value = float(f"{found[1]}e{found[2] or 0}")
        if abs(value) > 1e300:
            raise self.error(f"field {number} is {short(text)}; that is too large: correct it")
        return value

    def integer(self, number: int, default: int | None = None) -> int:
        """Return a field as a whole number, or the default of an empty one."""
        text = self.text(number)
        if not text and default is not None:
            return default
        if not re.fullmatch(r"[+-]?\d{1,9}", text):
            raise self.error(f"field {number} is {short(text)}; a whole number must stand there")
        return int(text)

    def zero(self, numbers: Iterable[int], what: str) -> None:
        """Refuse the card unless these fields are empty or zero."""
        for number in numbers:
            text = self.text(number)
            if text and not (_REAL.match(text) and self.real(number) == 0):
                raise self.error(f"{what} in field {number} ({short(text)}) cannot be read")

    def error(self, what: str) -> InputError:
        """Return what is wrong with the card as an error that names it and its line."""
        return InputError(f"{self.path}, line {self.line}: {self.name}: {what}")


@dataclass(frozen=True)
class Subcase:
    """Settings of a subcase of the case control, upper case: SPC, LOAD, METHOD, STATSUB.

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
    subcases : tuple of Subcase
        Each with what it takes from above the first one; empty for a file of bulk data alone.
    cards : tuple of Card
    """

    path: Path
    subcases: tuple[Subcase, ...]
    cards: tuple[Card, ...]


def read_deck(path: Path) -> Deck:
    """Read a NASTRAN file.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    text = read_bytes(path, MOST_BYTES, "a NASTRAN file").decode("utf-8", errors="replace")
    lines = [(n, line.partition("$")[0].rstrip()) for n, line in enumerate(text.splitlines(), 1)]
    upper = [line.upper().split() for _, line in lines]
    begin = next((i for i, words in enumerate(upper) if words[:2] == ["BEGIN", "BULK"]), None)
    cend = any(words[:1] == ["CEND"] for words in upper)
    if cend and begin is None:
        raise InputError(f"{path}: there is no BEGIN BULK after CEND; the file may be cut off")
    first = 0 if begin is None else begin + 1
    last = next((i for i, words in enumerate(upper) if words[:1] == ["ENDDATA"]), None)
    if last is None and begin is not None:
        raise InputError(f"{path}: there is no ENDDATA at its end; the file may be cut off")
    control = lines[: begin or 0]
    return Deck(path, _subcases(control), tuple(_cards(lines[first:last], path)))


_SETTING = re.compile(r"\s*(SPC|LOAD|METHOD|STATSUB)\s*(?:\(.*?\))?\s*=\s*(\d{1,9})\s*$", re.I)


def _subcases(control: list[tuple[int, str]]) -> tuple[Subcase, ...]:
    """Return the subcases; a case control without any is one subcase."""
    found = [Subcase(0)]
    for _, line in control:
        if start := re.match(r"\s*SUBCASE\s*=?\s*(\d{1,9})\s*$", line, re.I):
            found.append(Subcase(int(start[1]), dict(found[0].settings)))
        elif setting := _SETTING.match(line):
            found[-1].settings[setting[1].upper()] = int(setting[2])
    return tuple(found[1:] or (found if control else ()))


def _cards(lines: list[tuple[int, str]], path: Path) -> Iterable[Card]:
    name, start, fields = "", 0, list[str]()
    for number, line in lines:
        if not line.strip():
            continue
        head, data = _split(line.expandtabs(8), number, path)
        if head in ("", "+", "*"):
            if not name:
                where = f"{path}, line {number}"
                raise InputError(f"{where}: {short(line)} continues a card, but none is before it")
            fields += data
            continue
        if name:
            yield Card(name, start, tuple(fields), path)
        name, start, fields = head, number, data
    if name:
        yield Card(name, start, tuple(fields), path)


def _split(line: str, number: int, path: Path) -> tuple[str, list[str]]:
    """Return the name of a line, or what marks a continuation, and its fields."""
    if "," in line:
        head, *cells = [cell.strip() for cell in line.split(",")]
        if len(cells) > 9:
            raise InputError(
                f"{path}, line {number}: {len(cells) + 1} fields between commas; a line has at "
                "most ten: continue it on the next one"
            )
        width = 4 if head.endswith("*") or head.startswith("*") else 8
    else:
        head = line[:8].strip()
        size = 16 if "*" in head else 8
        width = 64 // size
        cells = [line[8 + size * i : 8 + size * (i + 1)].strip() for i in range(width)]
    data = (cells + [""] * width)[:width]
    if not head or head[0] in "+*":
        return head[:1], data
    if not _NAME.match(head):
        raise InputError(f"{path}, line {number}: {short(head)} is no name of a card")
    return head.rstrip("*").upper(), data


def real_text(value: float) -> str:
    """Return a number with as many digits as a field of 16 characters takes."""
    for digits in range(15, 7, -1):
        mantissa, e, exponent = f"{value:.{digits}G}".partition("E")
        point = mantissa if "." in mantissa else f"{mantissa}."
        text = f"{point}{e}{exponent}"
        if len(text) <= 16:
            return text
    raise ValueError(value)


def card_text(name: str, *fields: str | int | float | None) -> str:
    """Return a card in large fields."""
    cells = [_cell(value) for value in fields]
    rows = [cells[i : i + 4] for i in range(0, len(cells), 4)]
    lines = [
        f"{head:<8}" + "".join(f"{cell:>16}" for cell in row)
        for head, row in zip([f"{name}*", *["*"] * (len(rows) - 1)], rows, strict=True)
    ]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _cell(value: str | int | float | None) -> str:
    if value is None:
        return ""
    return real_text(value) if isinstance(value, float) else str(value)
