"""Reading TOML and CSV: from a file on disk to plain tables, or one clear sentence.

Every error names the file, the key, the value received, what is allowed and what to do next.
Nothing is ever written here.
"""

from __future__ import annotations

import codecs
import difflib
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from antinode.errors import AntinodeError, InputError
from antinode.text import nearest, short

from .cells import MOST_ROWS as MOST_ROWS
from .cells import TOO_MANY, rows_of, with_heading, without_empty_columns
from .cells import Row as Row
from .headings import are_units, bare_unit, heading
from .override import override
from .toml_reading import parse_toml
from .units import unit_factor
from .written import number

MOST_TOML_BYTES = 2_000_000
MOST_CSV_BYTES = 20_000_000

COLUMN_UNITS = {
    "x": "m",
    "mass_per_length": "kg/m",
    "bending_stiffness": "N m^2",
    "axial_stiffness": "N",
    "axial_force": "N",
    "radius": "m",
    "radius_of_gyration": "m",
    "wall": "m",
    "torsional_stiffness": "N m^2",
    "polar_inertia_per_length": "kg m",
    "shear_stiffness": "N",
    "rotary_inertia_per_length": "kg m",
    "foundation_stiffness": "N/m^2",
    "added_mass_per_length": "kg/m",
    "loss_factor": "",
    "tangential_load": "N/m",
    "outer_diameter": "m",
    "width": "m",
    "height": "m",
    "area": "m^2",
    "second_moment": "m^4",
    "shear_area": "m^2",
    "polar_moment": "m^4",
    "torsion_constant": "m^4",
}
_MAY_BE_INFINITE = ("shear_stiffness",)
"""SI unit of every column that a table of stations may have."""


def read_toml(path: Path) -> dict[str, Any]:
    """Read a TOML file into plain tables.

    Raises
    ------
    InputError
        If the file is missing, too large, no text, or no TOML.
    """
    text = toml_source(path)
    try:
        return parse_toml(text)
    except ValueError as error:
        raise InputError(
            f"{path}: this is not valid TOML ({error}); correct it, or compare it with the file "
            "that 'antinode init' writes"
        ) from error


def toml_source(path: Path) -> str:
    """Return a TOML file as it is written.

    Raises
    ------
    InputError
        If it is missing, too large, or no text.
    """
    if (told := _OTHER_FILES.get(path.suffix.lower())) and path.is_file():
        raise InputError(f"{path}: {told.format(path=path, name=path.name)}")
    return read_text(path, MOST_TOML_BYTES, "a TOML file")


_DECK = (
    "this is a file of another program, no TOML; 'antinode convert {path} beam.toml' makes a beam "
    "file of it"
)
_TABLE = (
    "this is a table of stations; name it in a case file with vehicle.stations = '{name}', or "
    "solve it as a beam with 'antinode beam {path}'"
)
_MEASURED = (
    "these are measurements; 'antinode convert {path} observations.csv' makes observations for "
    "'antinode identify' of them"
)
_OTHER_FILES = {
    **dict.fromkeys((".bdf", ".nas", ".fem", ".dat"), _DECK),
    **dict.fromkeys((".csv", ".xlsx"), _TABLE),
    **dict.fromkeys((".uff", ".unv"), _MEASURED),
}
"""What files are that stand where a TOML file is expected, by ending."""


_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def read_text(path: Path, most: int, what: str, other: str = "") -> str:
    """Read a text of at most so many bytes, with plain line ends.

    UTF-8 or UTF-16, or else `other`, a code in which no byte below a blank may stand.

    Raises
    ------
    InputError
        If it cannot be read, or is no text.
    """
    try:
        data = read_bytes(path, most, what)
        text = _decoded(data, other)
        return text.replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: this is not UTF-8 text; save it as UTF-8, or check that this is {what}"
        ) from error


def _decoded(data: bytes, other: str) -> str:
    """Return bytes as text; UTF-16 without its mark shows by zeros beside the first letter."""
    if data[:2] in _UTF_16:
        return data.decode("utf-16")
    if len(data) > 1 and (data[0] == 0) != (data[1] == 0):
        return data.decode("utf-16-be" if data[0] == 0 else "utf-16-le")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        if not other or re.search(rb"[\x00-\x08\x0e-\x1f]", data):
            raise
        return data.decode(other)


def read_bytes(path: Path, most: int, what: str) -> bytes:
    """Read a file of at most so many bytes.

    Raises
    ------
    InputError
        If it is missing, no file, or too large.
    """
    try:
        if path.is_file() and (size := path.stat().st_size) <= most:
            return path.read_bytes()
        exists, folder = path.exists(), path.is_dir()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{short(str(path))} cannot be read ({reason}); check the path") from error
    if not exists:
        raise InputError(f"{path}: no such file{_similar_file(path)}")
    if folder:
        raise InputError(f"{path}: this is a folder; name {what} inside it")
    if not path.is_file():
        raise InputError(f"{path}: this is no regular file; name {what}")
    raise InputError(
        f"{path}: {size / 1e6:.1f} MB is more than the {most / 1e6:g} MB allowed for {what}; "
        "check that this is the right file"
    )


def _similar_file(path: Path) -> str:
    try:
        stems = [p.stem for p in path.parent.iterdir() if p.suffix == path.suffix][:500]
    except OSError:
        return f"; the folder {path.parent} does not exist either: check the path"
    close = difflib.get_close_matches(path.stem, stems, n=1)
    if close:
        return f"; did you mean {path.with_name(close[0] + path.suffix)}?"
    return "; write one with 'antinode init'" if path.suffix == ".toml" else "; check the path"


class Tables(NamedTuple):
    """The tables of a file, ready to be checked.

    Attributes
    ----------
    tables : dict
        With overrides applied and stations read.
    where : str
        The file, for messages.
    elsewhere : dict
        Files that tables come from which stand in a file of their own, by the tables' keys.
    """

    tables: dict[str, Any]
    where: str
    elsewhere: dict[str, Path]


def read_overridden(path: Path, assignments: Iterable[str]) -> tuple[dict[str, Any], str]:
    """Read a TOML file and apply overrides; return its tables, and its name for messages.

    Raises
    ------
    InputError
        If the file or an override cannot be read.
    """
    tables, assignments = read_toml(path), tuple(assignments)
    override(tables, assignments)
    return tables, f"{path} (with --set)" if assignments else str(path)


def read_beside_case(
    path: Path, assignments: Iterable[str], what: str
) -> tuple[dict[str, Any], str]:
    """Read a TOML file that names a case or a beam file, as `read_overridden` does.

    Parameters
    ----------
    path : Path
    assignments : iterable of str
        Overrides.
    what : str
        What the file is, for messages: "a study file".

    Raises
    ------
    InputError
        If it cannot be read, or is a case itself.
    """
    tables, where = read_overridden(path, assignments)
    if "vehicle" in tables:
        raise InputError(
            f"{path}: this is a case file; name it in {what} with case = '{path.name}'"
        )
    if "beam" in tables:
        raise InputError(
            f"{path}: this is a beam file; name it in {what} with case = '{path.name}'"
        )
    return tables, where


def read_tables(
    path: Path, assignments: Iterable[str], name: str, columns: Sequence[str]
) -> Tables:
    """Read a TOML file and the stations of its table `name`; apply overrides.

    Raises
    ------
    InputError
        If anything in it cannot be read.
    """
    tables, where = read_overridden(path, assignments)
    table = tables.get(name)
    if not isinstance(table, dict) or "stations" not in table:
        return Tables(tables, where, {})
    key = f"{name}.stations"
    stations, file = _read_stations(table["stations"], path.parent, f"{where}: {key}", columns)
    tables = {**tables, name: {**table, "stations": stations}}
    return Tables(tables, where, {key: file} if file else {})


@contextmanager
def naming(where: str) -> Iterator[None]:
    """Put the name of the file in front of what is wrong with its contents."""
    try:
        yield
    except AntinodeError as error:
        raise type(error)(f"{where}: {error}") from error


def _read_stations(
    source: object, folder: Path, key: str, columns: Sequence[str]
) -> tuple[object, Path | None]:
    """Read a table of stations: columns given inline, or a CSV file, which is returned too."""
    if isinstance(source, str) and source:
        return read_csv(folder / source, columns), folder / source
    if not isinstance(source, Mapping):
        raise InputError(
            f"{key} is {short(source)}; give the name of a CSV file, or a table of columns such as "
            "{ x = [0, 1], ... }"
        )
    stations: dict[str, Any] = {}
    for written, column in source.items():
        name, unit = heading(str(written), columns)
        _check_column(name, columns, key)
        if name in stations:
            raise InputError(f"{key}: the column {name} stands there twice; remove one")
        if isinstance(column, list) and len(column) > MOST_ROWS:
            raise InputError(f"{key}.{name} has {len(column)} rows; {TOO_MANY}")
        factor = _factor(name, unit, key) if unit else 1.0
        stations[name] = _times(column, factor) if unit else column
    return stations, None


def _times(column: object, factor: float) -> object:
    """Return a column whose heading names a unit in SI; texts say their units themselves."""
    if not isinstance(column, list):
        return column
    plain = (int, float)
    return [v * factor if isinstance(v, plain) and not isinstance(v, bool) else v for v in column]


def read_csv(path: Path, columns: Sequence[str]) -> dict[str, list[float]]:
    """Read a table of stations: a header ``name [unit]`` (or SI names), then rows of numbers.

    Empty rows and lines that start with ``#`` are left out. A last row of which only the first cell
    is filled repeats the row before: it closes a stepped table.
    """
    return station_columns(read_cells(path), columns, path)


def station_columns(rows: list[Row], columns: Sequence[str], path: Path) -> dict[str, list[float]]:
    """Return the columns of a table of stations, SI, from its rows of text, header first.

    Raises
    ------
    InputError
        If it is no such table.
    """
    named = (_named(row, columns) > 1 for row in rows[:_HIGHEST_TITLE])
    rows = list(rows) if rows and _named(rows[0], columns) else with_heading(list(rows), named)
    if not rows:
        raise InputError(f"{path}: the table is empty; {_NEEDED}")
    rows = without_empty_columns(rows)
    head, units = rows[0].cells, list[str]()
    if len(rows) > 1 and not any(heading(cell, columns).unit for cell in head):
        units = rows[1].cells if are_units(rows[1].cells) else []
    names, factors = _header(head, units, columns, path)
    rows = [rows[0], *rows[1 + bool(units) :]]
    if len(rows) < 3:
        raise InputError(f"{path}: the table has less than two rows of numbers; {_NEEDED}")
    if not any(rows[-1].cells[1:]):
        rows[-1] = Row(rows[-1].line, rows[-1].cells[:1] + rows[-2].cells[1:])
    table = [_numbers(row, names, path) for row in rows[1:]]
    return {
        name: [row[c] * factor for row in table]
        for c, (name, factor) in enumerate(zip(names, factors, strict=True))
    }


_HIGHEST_TITLE = 20
"""Rows among which headings are looked for, below a title."""


def _named(row: Row, columns: Sequence[str]) -> int:
    """Return how many cells name a column."""
    return sum(heading(cell, columns).name in columns for cell in row.cells)


def read_csv_text(path: Path) -> str:
    """Return a CSV file as text; where it is not UTF-8 it is what spreadsheets write in Europe."""
    return read_text(path, MOST_CSV_BYTES, "a CSV table", other="cp1252")


def read_cells(path: Path) -> list[Row]:
    """Read the cells of any CSV table, header first; empty rows and ``#`` lines are left out."""
    return list(rows_of(read_csv_text(path), path))


_NEEDED = "it needs a header such as 'x [m], mass_per_length [kg/m], ...' and two rows or more"


def _header(
    cells: list[str], units: Sequence[str], columns: Sequence[str], path: Path
) -> tuple[list[str], list[float]]:
    """Return the names of the columns and the factors to their SI units.

    Units stand in the headings, or in a row of their own.
    """
    where = f"{path}: header"
    names: list[str] = []
    factors: list[float] = []
    for k, cell in enumerate(cells):
        name, unit = heading(cell, columns)
        _check_column(name, columns, where)
        if name in names:
            raise InputError(f"{where}: the column {name} stands there twice; remove one")
        names.append(name)
        below = bare_unit(units[k]) if k < len(units) else ""
        factors.append(_factor(name, unit or below, where) if unit or below not in ("", "-") else 1)
    return names, factors


def _factor(name: str, unit: str, where: str) -> float:
    """Return the factor from a column's unit to its SI unit."""
    si = COLUMN_UNITS[name.partition(":")[0]]
    try:
        if unit[0] in "[(":
            raise ValueError("the bracket around its unit is not closed")
        return unit_factor(unit, si)
    except ValueError as error:
        raise InputError(f"{where}: column {name}: {error}; write e.g. [{si}]") from error


def _check_column(name: str, columns: Sequence[str], where: str) -> None:
    if not name:
        raise InputError(f"{where}: a column has no name; name it, or remove it")
    first, space, unit = name.partition(" ")
    if space and first in columns:
        raise InputError(f"{where}: {short(name)}: its unit stands in brackets: {first} [{unit}]")
    base, state, _ = name.partition(":")
    if base not in columns or (state and base != "mass_per_length"):
        raise InputError(f"{where}: unknown column {short(name)}; {nearest(base, columns)}")


def _numbers(row: Row, names: list[str], path: Path) -> list[float]:
    """Return the numbers of a row, one for each column."""
    where = f"{path}, line {row.line}"
    if len(row.cells) != len(names):
        raise InputError(
            f"{where}: {len(row.cells)} cells, but {len(names)} in the header; give one number "
            "for each column"
        )
    values = []
    for name, cell in zip(names, row.cells, strict=True):
        try:
            values.append(number(cell))
        except ValueError as error:
            why = f"{error}" if "may be" in str(error) else "give a number"
            raise InputError(
                f"{where}, column {name}: received {short(cell)}; {why} (its unit stands in the "
                "header)"
            ) from None
        if not math.isfinite(values[-1]) and name not in _MAY_BE_INFINITE:
            raise InputError(
                f"{where}, column {name}: received {short(cell)}; give a finite number"
            )
    return values
