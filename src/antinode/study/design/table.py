"""A table of cases in a file, CSV or Parquet, of any length: it is read by chunk.

When a study is loaded the table is read through once: its rows are counted and checked, and where
every few thousand of them begin is kept. A worker then reads the rows of its chunk.
"""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from pydantic import Field

from antinode.errors import InputError
from antinode.inputs.cells import COMMENTS, cells_of, mark_of
from antinode.inputs.reading import read_csv_text
from antinode.inputs.units import Frozen
from antinode.text import short

_BLOCK = 4096  # rows
_FIRST_LINES = 50  # by which the mark between cells is found
_HASHED = 1 << 20  # bytes at once
_COMMENTS = tuple(mark.encode() for mark in COMMENTS)


class TableRows(NamedTuple):
    """Some rows of a table, column by column."""

    lines: list[int]
    """Of the file, or numbers of the rows, from 1."""
    columns: list[list[Any]]
    """Texts or numbers."""


class Block(NamedTuple):
    """Where some rows of a CSV file begin."""

    place: int
    """Bytes from the start of the file."""
    line: int


class DesignTable(Frozen):
    """A table with a column for each input, and a row for each case."""

    path: str = Field(exclude=True)
    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: int
    digest: str
    mark: str | None = Field(exclude=True)
    """Between the cells of a CSV file; None in Parquet."""
    blocks: tuple[Block, ...] = Field(exclude=True)

    def read(self, start: int, stop: int) -> TableRows:
        """Return the rows from `start` to `stop`, counted from 0.

        Raises
        ------
        InputError
            If the file cannot be read any more, or a row has more or fewer cells than the header.
        """
        try:
            return (
                self._of_csv(start, stop)
                if self.mark is not None
                else self._of_parquet(start, stop)
            )
        except OSError as error:
            raise InputError(f"{self.path} cannot be read ({error.strerror or error})") from error

    def parts(self) -> Iterator[TableRows]:
        """Yield all rows, some at once."""
        for start in range(0, self.rows, _BLOCK):
            yield self.read(start, min(start + _BLOCK, self.rows))

    @property
    def unit_of_rows(self) -> str:
        """What rows are counted in: lines of a text, rows else."""
        return "row" if self.mark is None else "line"

    def _of_csv(self, start: int, stop: int) -> TableRows:
        assert self.mark is not None
        first = start // _BLOCK
        skip, lines, rows = start - first * _BLOCK, [], []
        with _opened(Path(self.path)) as handle:
            place, line = self.blocks[first]
            handle.seek(place)
            for number, cells in _rows(handle, self.mark, self.path, line):
                if skip:
                    skip -= 1
                    continue
                if len(cells) != len(self.names):
                    say = f"{len(cells)} cells, but {len(self.names)} in the header"
                    raise InputError(f"{self.path}, line {number}: {say}; give one for each column")
                lines.append(number)
                rows.append(cells)
                if len(rows) == stop - start:
                    break
        if len(rows) < stop - start:
            raise InputError(f"{self.path} became shorter while it was read; load the study anew")
        return TableRows(lines, [list(column) for column in zip(*rows, strict=True)])

    def _of_parquet(self, start: int, stop: int) -> TableRows:
        columns = _parquet(self.path, start, stop - start)
        return TableRows(list(range(start + 1, stop + 1)), list(columns.values()))


def open_table(path: Path) -> DesignTable:
    """Read through a table of cases: a header such as ``speed [m/s], thrust [kN]``, then rows.

    Raises
    ------
    InputError
        If it cannot be read, or has no rows.
    """
    try:
        found = _open_parquet(path) if path.suffix.lower() == ".parquet" else _open_csv(path)
    except OSError as error:
        raise InputError(f"{path} cannot be read ({error.strerror or error})") from error
    if not found.rows:
        raise InputError(
            f"{path}: the table has no rows; give a header, then one row for each case"
        )
    return found


def _open_csv(path: Path) -> DesignTable:
    with _opened(path) as handle:
        head = [_decoded(line) for line, _ in zip(handle, range(_FIRST_LINES), strict=False)]
        mark = mark_of(head)
        handle.seek(0)
        names: list[str] = []
        rows, blocks, place = 0, [], 0
        for number, raw in enumerate(handle, 1):
            start, place = place, place + len(raw)
            if _is_empty(raw):
                continue
            if not names:
                names = cells_of(_decoded(raw), mark, f"{path}, line {number}")
                continue
            if rows % _BLOCK == 0:
                blocks.append(Block(start, number))
            rows += 1
        handle.seek(0)
        digest = _digest(handle)
    return _table(path, names, rows, digest, mark, blocks)


def _open_parquet(path: Path) -> DesignTable:
    names, rows = _parquet_head(path)
    with path.open("rb") as handle:
        digest = _digest(handle)
    return _table(path, names, rows, digest, None, [])


def _table(
    path: Path, headings: list[str], rows: int, digest: str, mark: str | None, blocks: list[Block]
) -> DesignTable:
    names, units = [], []
    for cell in headings:
        key, bracket, unit = cell.partition("[")
        if not key.strip() or (bracket and not unit.strip().endswith("]")):
            raise InputError(f"{path}: header: {short(cell)} is no column; write e.g. speed [m/s]")
        names.append(key.strip())
        units.append(unit.strip().removesuffix("]").strip())
    return DesignTable(
        path=str(path.absolute()),
        names=tuple(names),
        units=tuple(units),
        rows=rows,
        digest=digest,
        mark=mark,
        blocks=tuple(blocks),
    )


def _opened(path: Path) -> BinaryIO:
    """Open a text table; one in UTF-16, which has no lines of bytes, is recoded in memory."""
    with path.open("rb") as handle:
        wide = handle.read(2) in (b"\xff\xfe", b"\xfe\xff")
    return io.BytesIO(read_csv_text(path).encode()) if wide else path.open("rb")


def _rows(handle: BinaryIO, mark: str, path: str, line: int) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows that have anything in them, with the numbers of their lines."""
    for number, raw in enumerate(handle, line):
        if not _is_empty(raw):
            yield number, cells_of(_decoded(raw), mark, f"{path}, line {number}")


def _is_empty(raw: bytes) -> bool:
    """Tell whether a line is a comment, or has nothing in its cells."""
    return not raw.strip(b' \t\r\n,;|"') or raw.lstrip().startswith(_COMMENTS)


def _decoded(raw: bytes) -> str:
    try:
        return raw.decode("utf-8-sig").rstrip("\r\n")
    except UnicodeDecodeError:
        return raw.decode("cp1252", errors="replace").rstrip("\r\n")


def _digest(handle: BinaryIO) -> str:
    found = hashlib.sha256()
    while data := handle.read(_HASHED):
        found.update(data)
    return found.hexdigest()[:32]


# --- Parquet --------------------------------------------------------------------------------------


def _parquet_head(path: Path) -> tuple[list[str], int]:
    """Return the names of the columns, and the number of rows."""
    try:
        polars: Any = import_module("polars")
    except ImportError:
        file = _pyarrow(path)
        return list(file.schema_arrow.names), int(file.metadata.num_rows)
    lazy = _readable(path, lambda: polars.scan_parquet(path))
    rows = _readable(path, lambda: lazy.select(polars.len()).collect().item())
    return list(lazy.collect_schema().names()), int(rows)


def _parquet(path: str, start: int, number: int) -> dict[str, list[Any]]:
    """Return some rows by column."""
    try:
        polars: Any = import_module("polars")
    except ImportError:
        file = _pyarrow(Path(path))
        found: dict[str, list[Any]] = {name: [] for name in file.schema_arrow.names}
        seen = 0
        for group in range(file.num_row_groups):
            rows = file.metadata.row_group(group).num_rows
            first, last = max(start - seen, 0), min(start + number - seen, rows)
            if first < last:
                part = file.read_row_group(group).slice(first, last - first).to_pydict()
                for name, values in part.items():
                    found[name] += values
            seen += rows
        return found
    part = polars.scan_parquet(path).slice(start, number).collect()
    return {str(name): column for name, column in part.to_dict(as_series=False).items()}


def _pyarrow(path: Path) -> Any:
    try:
        parquet: Any = import_module("pyarrow.parquet")
    except ImportError as error:
        raise InputError(
            f"{path}: Parquet needs polars or pyarrow: pip install 'antinode[parquet]'; "
            "or name a .csv file"
        ) from error
    return _readable(path, lambda: parquet.ParquetFile(path))


def _readable(path: Path, action: Any) -> Any:
    try:
        return action()
    except OSError:
        raise
    except Exception as error:
        raise InputError(f"{path}: no Parquet file ({short(str(error))}); check it") from error
