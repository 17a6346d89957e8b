"""Cards that repeat the one before them, field by field.

`=` stands for the same field of the line before, `==` for that and all that follow, `*(2)` for 2
more; `=(3)` or `=3` in the first field for three such lines, by the steps of the line itself or of
the one before (MSC Nastran Quick Reference Guide, replication).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from antinode.text import short

from .cards import number_in
from .fields import Fields, is_step
from .lines import Line

MOST_COPIES = 100_000
_TIMES = re.compile(r"=\(?(\d{1,6})\)?$")
_STEP = re.compile(r"\*\(\s*([^()]+?)\s*\)$")


@dataclass
class Repetition:
    """The line before, and the steps by which it was made from another.

    Attributes
    ----------
    last : Fields or None
        With what it repeats filled in.
    pattern : list of str
        Its fields as they were written.
    copies : int
        Made so far.
    """

    last: Fields | None = None
    pattern: list[str] = field(default_factory=list)
    copies: int = 0

    def lines(self, given: Fields, line: Line) -> Iterator[Fields]:
        """Yield the lines that one stands for.

        Raises
        ------
        InputError
            If nothing is before it, or it cannot be made.
        """
        if not given.repeats:
            self.last, self.pattern = given, given.data
            yield given
            return
        times = _TIMES.match(given.head)
        count = int(times[1]) if times else 1
        pattern = self.pattern if times and not any(given.data) else given.data
        self.copies += count
        if self.copies > MOST_COPIES:
            raise line.error(f"more than {MOST_COPIES} cards by repetition; write fewer")
        for _ in range(count):
            self.last = self._next(given.head, pattern, line)
            yield self.last
        self.pattern = pattern

    def _next(self, head: str, pattern: list[str], line: Line) -> Fields:
        last = self.last
        if last is None or last.continues:
            raise line.error("it repeats a card by =, but none is before it; write it out")
        if head[:1] not in ("=", "") and head != last.head:
            raise line.error(f"it repeats fields of another card, {last.head}; write them out")
        if len(pattern) != len(last.data):
            raise line.error("it repeats fields of another width; write them out")
        rest = pattern.index("==") if "==" in pattern else len(pattern)
        cells = [*pattern[:rest], *["="] * (len(pattern) - rest)]
        data = [_cell(cell, before, line) for cell, before in zip(cells, last.data, strict=True)]
        return Fields(last.head, data)


def _cell(cell: str, before: str, line: Line) -> str:
    if cell == "=":
        return before
    if not is_step(cell):
        return cell
    step, start = _STEP.match(cell), number_in(before)
    by = number_in(step[1]) if step else None
    if by is None or start is None:
        raise line.error(f"{short(cell)} cannot be added to {short(before)}; write the cards out")
    whole = all(re.fullmatch(r"[+-]?\d+", text) for text in (before, step[1] if step else ""))
    return str(int(start + by)) if whole else repr(start + by)
