"""NASTRAN's cards: fields as numbers and words, its own reals, and cards as text.

A real may leave out its E: `7.0-3` is 0.007, and `7.0 -3` too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from antinode.errors import InputError
from antinode.text import short

_REAL = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[EeDd]?([+-]?\d+)| +([+-]\d+))?$")


def number_in(text: str) -> float | None:
    """Return a field as a number; None if it is none."""
    found = _REAL.match(text)
    return float(f"{found[1]}e{found[2] or found[3] or 0}") if found else None


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
        value = number_in(text)
        if value is None:
            raise self.error(f"field {number} is {short(text)}; a number must stand there")
        if abs(value) > 1e300:
            raise self.error(f"field {number} is {short(text)}; that is too large: correct it")
        return value

    def integer(self, number: int, default: int | None = None) -> int:
        """Return a field as a whole number, or the default of an empty one."""
        text = self.text(number)
        if not text and default is not None:
            return default
        if not re.fullmatch(r"[+-]?\d{1,18}", text):
            raise self.error(f"field {number} is {short(text)}; a whole number must stand there")
        return int(text)

    def numbers(self, first: int, there: Iterable[int]) -> tuple[int, ...]:
        """Return the numbers in the fields from one on; of `7 THRU 9` those that are there.

        Raises
        ------
        InputError
            If a field is none; a real closes the list.
        """
        cells = [(i, self.text(i)) for i in range(first, len(self.fields) + 1) if self.text(i)]
        found: list[int] = []
        k = 0
        while k < len(cells):
            i, text = cells[k]
            if "." in text:
                break
            if text.upper() == "THRU" and found and k + 1 < len(cells):
                last, step, k = self.integer(cells[k + 1][0]), 1, k + 2
                if k + 1 < len(cells) and cells[k][1].upper() == "BY":
                    step, k = self.integer(cells[k + 1][0]), k + 2
                if step < 1:
                    raise self.error(f"field {i + 3} is {step}; a step of at least 1 stands there")
                low = found[-1]
                found += sorted(n for n in there if low < n <= last and (n - low) % step == 0)
                continue
            found.append(self.integer(i))
            k += 1
        return tuple(found)

    def freedoms(self, number: int) -> str:
        """Return the freedoms 1 to 6 that a field names; 0 and blanks among them count nothing.

        Raises
        ------
        InputError
            If it names anything else.
        """
        text = "".join(self.text(number).split())
        if not set(text) <= set("0123456"):
            raise self.error(f"field {number} is {short(text)}; freedoms 1 to 6 may stand there")
        return text.replace("0", "")

    def zero(self, numbers: Iterable[int], what: str) -> None:
        """Refuse the card unless these fields are empty or zero."""
        for number in numbers:
            text = self.text(number)
            if text and number_in(text) != 0:
                raise self.error(f"{what} in field {number} ({short(text)}) cannot be read")

    def filled(self, default: Card | None, *groups: tuple[int, ...]) -> Card:
        """Return the card with each group of fields that is empty taken from a default card."""
        if default is None:
            return self
        most = max(number for group in groups for number in group)
        fields = [*self.fields, *[""] * (most - len(self.fields))]
        for group in groups:
            if not any(map(self.text, group)):
                for number in group:
                    fields[number - 1] = default.text(number)
        return replace(self, fields=tuple(fields))

    def error(self, what: str) -> InputError:
        """Return what is wrong with the card as an error that names it and its line."""
        return InputError(f"{self.path}, line {self.line}: {self.name}: {what}")


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
