"""Text tables as rows of cells: commas, semicolons, tabs, bars or blanks between them.

The mark is that of the first line that has any; `sep=;`, as spreadsheets write it, says it. Lines
that start with `#`, `%`, `!` or `//` are comments, typographic quotes count as straight ones.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from antinode.errors import InputError

MOST_ROWS = 20_000
"""Most rows of a table."""
TOO_MANY = f"at most {MOST_ROWS} are allowed: give a coarser table"


class Row(NamedTuple):
    """A row of a table with the number of its line in the file."""

    line: int
    cells: list[str]


COMMENTS = "#", "%", "!", "//"
_MARKS = ",;\t|"
_QUOTES = str.maketrans(dict.fromkeys("\u201c\u201d\u201e\u00ab\u00bb", '"'))
_SAID = re.compile(r'"?sep=(.)"?\s*$', re.IGNORECASE)


def rows_of(text: str, path: Path) -> Iterator[Row]:
    """Yield the rows of a text that have anything in them.

    Raises
    ------
    InputError
        If there are too many, or one cannot be read.
    """
    lines = text.splitlines()
    mark, count = mark_of(lines), 0
    for line, content in enumerate(lines, 1):
        cells = cells_of(content, mark, f"{path}, line {line}")
        if any(cells):
            count += 1
            if count > MOST_ROWS + 1:
                raise InputError(f"{path}: the table has more than {MOST_ROWS} rows; {TOO_MANY}")
            yield Row(line, cells)


def mark_of(lines: list[str]) -> str:
    """Return what separates the cells of a table, by its first lines; blanks: empty."""
    said = _SAID.match(lines[0]) if lines else None
    return said[1] if said else _separator(lines)


def cells_of(content: str, mark: str, where: str) -> list[str]:
    """Return the cells of a line; none of a comment, or of one that says the mark.

    Raises
    ------
    InputError
        If it cannot be read; `where` says which line it is.
    """
    if content.lstrip().startswith(COMMENTS) or _SAID.match(content):
        return []
    content = content.translate(_QUOTES)
    if not mark:
        return content.split()
    try:
        row = next(csv.reader([content], delimiter=mark, skipinitialspace=True), [])
    except csv.Error as error:
        raise InputError(
            f"{where}: no CSV table ({error}); check that it is the right file"
        ) from error
    return [cell.strip() for cell in row]


def _separator(lines: list[str]) -> str:
    """Return what separates the cells: blanks, empty, where plain words stand without a mark."""
    content = (line for line in lines if line.strip())
    own = [line for line in content if not line.lstrip().startswith(COMMENTS)]
    for line in own:
        mark = max(_MARKS, key=line.count)
        if mark in line:
            return mark
    plain = own and len(own[0].split()) > 2 and not set("[(") & set(own[0])
    return "" if plain else ","


def with_heading(rows: list[Row], names: Iterator[bool]) -> list[Row]:
    """Return rows from the first one on that is a heading, all if none of them is.

    Parameters
    ----------
    rows : list of Row
    names : iterator of bool
        Of each row whether it names columns.
    """
    first = next((k for k, named in enumerate(names) if named), 0)
    return rows[first:]


def without_empty_columns(rows: list[Row]) -> list[Row]:
    """Return rows without the columns at their right that have neither name nor value."""
    width = max((k + 1 for k, cell in enumerate(rows[0].cells) if cell), default=0)
    if any(any(row.cells[width:]) for row in rows):
        return rows
    return [Row(row.line, row.cells[:width]) for row in rows]
