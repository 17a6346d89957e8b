"""Reading TOML and CSV: from a file on disk to plain tables, or one clear sentence.

Every error names the file, the key, the value received, what is allowed and what to do next.
Nothing is ever written here.
"""

from __future__ import annotations

import codecs
import csv
import difflib
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from antinode.errors import AntinodeError, InputError
from antinode.text import nearest, short

from .override import override
from .toml_reading import parse_toml
from .units import unit_factor
from .written import number

MOST_TOML_BYTES = 2_000_000
MOST_CSV_BYTES = 20_000_000
MOST_ROWS = 20_000

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


class Row(NamedTuple):
    """A row of a CSV table with the number of its line in the file."""

    line: int
    cells: list[str]


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


def read_text(path: Path, most: int, what: str) -> str:
    """Read a text of at most so many bytes, with plain line ends.

    Raises
    ------
    InputError
        If it cannot be read, or is no text.
    """
    try:
        data = read_bytes(path, most, what)
        text = data.decode("utf-16" if data[:2] in _UTF_16 else "utf-8-sig")
        return text.replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: this is not UTF-8 text; save it as UTF-8, or check that this is {what}"
        ) from error


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
    """Read a TOML file that names a case, as `read_overridden` does.

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
            f"{path}: this is a beam file; {what} names the case of a vehicle: solve the beam with "
            f"'antinode beam {path}', once for each change by --set, or vary it in Python"
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
    for name, column in source.items():
        _check_column(str(name), columns, key)
        if isinstance(column, list) and len(column) > MOST_ROWS:
            raise InputError(f"{key}.{name} has {len(column)} rows; {_TOO_MANY}")
    return dict(source), None


_TOO_MANY = f"at most {MOST_ROWS} are allowed: give a coarser table"


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
    rows = list(rows)
    if not rows:
        raise InputError(f"{path}: the table is empty; {_NEEDED}")
    names, factors = _header(rows[0].cells, columns, path)
    if len(rows) < 3:
        raise InputError(f"{path}: the table has less than two rows of numbers; {_NEEDED}")
    if not any(rows[-1].cells[1:]):
        rows[-1] = Row(rows[-1].line, rows[-1].cells[:1] + rows[-2].cells[1:])
    table = [_numbers(row, names, path) for row in rows[1:]]
    return {
        name: [row[c] * factor for row in table]
        for c, (name, factor) in enumerate(zip(names, factors, strict=True))
    }


def read_csv_text(path: Path) -> str:
    """Return a CSV file as text."""
    return read_text(path, MOST_CSV_BYTES, "a CSV table")


def read_cells(path: Path) -> list[Row]:
    """Read the cells of any CSV table, header first; empty rows and ``#`` lines are left out."""
    return list(_rows(read_csv_text(path), path))


_NEEDED = "it needs a header such as 'x [m], mass_per_length [kg/m], ...' and two rows or more"


def _rows(text: str, path: Path) -> Iterator[Row]:
    """Yield the header and the rows that have anything in them."""
    count, mark = 0, _separator(text)
    for line, content in enumerate(text.splitlines(), 1):
        if content.lstrip().startswith("#"):
            continue
        try:
            row = next(csv.reader([content], delimiter=mark, skipinitialspace=True))
            cells = [cell.strip() for cell in row]
        except csv.Error as error:
            raise InputError(
                f"{path}, line {line}: no CSV table ({error}); check that it is the right file"
            ) from error
        if any(cells):
            count += 1
            if count > MOST_ROWS + 1:
                raise InputError(f"{path}: the table has more than {MOST_ROWS} rows; {_TOO_MANY}")
            yield Row(line, cells)


def _separator(text: str) -> str:
    """Return what separates the cells: the mark that the header has most of."""
    lines = (
        line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")
    )
    header = next(lines, "")
    return max(",;\t", key=header.count)


def _header(cells: list[str], columns: Sequence[str], path: Path) -> tuple[list[str], list[float]]:
    """Return the names of the columns and the factors to their SI units."""
    where = f"{path}: header"
    names: list[str] = []
    factors: list[float] = []
    for cell in cells:
        name, bracket, unit = _in_brackets(cell).partition("[")
        name = _column_name(name.strip(), columns)
        _check_column(name, columns, where)
        if name in names:
            raise InputError(f"{where}: the column {name} stands there twice; remove one")
        names.append(name)
        factors.append(_factor(name, unit, where) if bracket else 1.0)
    return names, factors


def _in_brackets(cell: str) -> str:
    """Return a heading with its unit in square brackets: x (mm) as x [mm]."""
    if cell.endswith(")") and "[" not in cell:
        name, _, unit = cell[:-1].partition("(")
        return f"{name.strip()} [{unit}]"
    return cell


_SYMBOLS = {
    "EI": "bending_stiffness",
    "EA": "axial_stiffness",
    "GJ": "torsional_stiffness",
    "kGA": "shear_stiffness",
}


def _column_name(written: str, columns: Sequence[str]) -> str:
    """Return the column that a heading means: EI, Bending stiffness; as it is if none."""
    words = "_".join(written.lower().split())
    found = (name for name in (written, _SYMBOLS.get(written, ""), words) if name in columns)
    return next(found, written)


def _factor(name: str, unit: str, where: str) -> float:
    """Return the factor from a column's unit, written up to a closing bracket, to its SI unit."""
    si = COLUMN_UNITS[name.partition(":")[0]]
    try:
        if not unit.endswith("]"):
            raise ValueError("the bracket around its unit is not closed")
        return unit_factor(unit[:-1].strip(), si)
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
