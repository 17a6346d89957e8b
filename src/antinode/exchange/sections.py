"""Tables of sections of wind-turbine programs: ElastoDyn's towers and blades, BModes' sections.

A line of column names, a line of units in parentheses, then one row a section; words after the
numbers, and what stands above the names, are passed over but for the factors that adjust a column.
Sections stand at fractions of the length, from 0 to 1, and columns run linearly between them. A
second table of the same kind of fractions holds concentrated masses.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.inputs.reading import MOST_ROWS, read_bytes
from antinode.inputs.units import unit_factor
from antinode.text import short

MOST_BYTES = 20_000_000


@dataclass(frozen=True)
class Kind:
    """A kind of file, known by its first column.

    Attributes
    ----------
    name : str
    x, mass : str
        Columns, lower case.
    stiffness : tuple of str
        In plane 1 and in plane 2.
    axial, torsion, inertia : str or tuple
        Axial and torsional stiffness, and mass moments per length in the two planes, where there
        are any.
    factors : dict
        Factors by column: what stands on a line above the table.
    count : str
        How many rows there should be: what stands on a line above the table.
    unmodelled : tuple of str
        Columns that should be zero.
    """

    name: str
    x: str
    mass: str
    stiffness: tuple[str, str]
    axial: str = ""
    torsion: str = ""
    inertia: tuple[str, str] | tuple[()] = ()
    factors: Mapping[str, str] | None = None
    count: str = ""
    unmodelled: tuple[str, ...] = ()


KINDS = (
    Kind(
        "ElastoDyn tower",
        "htfract",
        "tmassden",
        ("twfastif", "twssstif"),
        axial="tweastif",
        torsion="twgjstif",
        inertia=("twfainer", "twssiner"),
        factors={"tmassden": "adjtwma", "twfastif": "adjfast", "twssstif": "adjssst"},
        count="ntwinpst",
        unmodelled=("twgjstif", "twfacgof", "twsscgof"),
    ),
    Kind(
        "ElastoDyn blade",
        "blfract",
        "bmassden",
        ("flpstff", "edgstff"),
        axial="eastff",
        torsion="gjstff",
        inertia=("flpiner", "edginer"),
        factors={"bmassden": "adjblms", "flpstff": "adjflst", "edgstff": "adjedst"},
        count="nblinpst",
        unmodelled=(
            *("strctwst", "gjstff", "alpha", "precrvref", "preswpref", "flpcgof", "edgcgof"),
            *("flpeaof", "edgeaof"),
        ),
    ),
    Kind(
        "BModes sections",
        "sec_loc",
        "mass_den",
        ("flp_stff", "edge_stff"),
        axial="axial_stff",
        torsion="tor_stff",
        inertia=("flp_iner", "edge_iner"),
        count="n_secs",
        unmodelled=("str_tw", "tw_iner", "tor_stff", "cg_offst", "sc_offst", "tc_offst"),
    ),
)
UNITS = {"mass": "kg/m", "stiffness": "N m^2", "axial": "N", "inertia": "kg m"}


def read_sections(
    path: Path, plane: int, length: float | None, factors: Mapping[str, float] | None = None
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Read a table of sections.

    Parameters
    ----------
    path : Path
    plane : {1, 2}
        Flap or fore-aft, or edge or side-side.
    length : float or None
        [m], of which the sections stand at fractions.
    factors : dict, optional
        By which columns are multiplied, beside those of the file.

    Returns
    -------
    dict
        The table `[beam]`.
    tuple of str
        What was left out.

    Raises
    ------
    InputError
        If there is no such table, or the length is missing.
    """
    text = read_bytes(path, MOST_BYTES, "a table of sections").decode("utf-8", errors="replace")
    lines = text.splitlines()
    kind, head = _kind(lines, path)
    columns, end = _columns(lines, head, kind, path)
    _check_fractions(columns[kind.x], f"{path}, line {head + 1}: column {kind.x}")
    if length is None:
        raise InputError(
            f"{path}: the sections stand at fractions of the length of the {kind.name[:9]} file's "
            "beam, which it does not give; add --length, e.g. --length 87.6m"
        )
    for name, key in (kind.factors or {}).items():
        columns[name] = columns[name] * _above(lines[:head], key, 1.0, path)
    for name in (factors or {}).keys() & columns.keys():
        columns[name] = columns[name] * (factors or {})[name]
    stations = {
        "x": (columns[kind.x] * length).tolist(),
        "mass_per_length": columns[kind.mass].tolist(),
        "bending_stiffness": columns[kind.stiffness[plane - 1]].tolist(),
    }
    if kind.axial in columns:
        stations["axial_stiffness"] = columns[kind.axial].tolist()
    stations |= (torsion := _torsion(kind, columns))
    turning = columns.get(kind.inertia[plane - 1]) if kind.inertia else None
    if turning is not None and np.any(turning):
        stations["rotary_inertia_per_length"] = turning.tolist()
    table: dict[str, Any] = {
        "name": path.stem[:200],
        "interpolation": "linear",
        "stations": stations,
    }
    if masses := _concentrated(lines, end, kind, path):
        table["point_masses"] = [{"x": at * length, "mass": mass} for at, mass in masses]
    return table, _notes(kind, columns, plane, torsion=bool(torsion))


def _torsion(kind: Kind, columns: Mapping[str, Array]) -> dict[str, list[float]]:
    """Return GJ, and the polar inertia as the sum of both mass moments, where all are given."""
    needed = (kind.torsion, *kind.inertia)
    if not all(name in columns and np.all(columns[name] > 0) for name in needed):
        return {}
    polar = np.sum([columns[name] for name in kind.inertia], axis=0)
    return {
        "torsional_stiffness": columns[kind.torsion].tolist(),
        "polar_inertia_per_length": polar.tolist(),
    }


def _check_fractions(at: Array, where: str) -> None:
    """Refuse a table that is no table of fractions of the whole length."""
    if not (abs(at[0]) <= _SAME and abs(at[-1] - 1) <= _SAME):
        raise InputError(
            f"{where} runs from {at[0]:g} to {at[-1]:g}; fractions of the length run from 0 to 1: "
            "complete the table"
        )


_SAME = 1e-6


def _concentrated(
    lines: Sequence[str], start: int, kind: Kind, path: Path
) -> list[tuple[float, float]]:
    """Return fractions and masses of the tables of concentrated masses below the sections."""
    found: list[tuple[float, float]] = []
    for number in range(start, len(lines)):
        names = lines[number].lower().split()
        if names[:1] != [kind.x]:
            continue
        where = f"{path}, line {number + 1}"
        if len(names) != 2 or not names[1].endswith("cmass"):
            raise InputError(
                f"{where}: a second table, of {', '.join(names[1:])}, cannot be read; known is one "
                "of concentrated masses, e.g. TwCMass: remove the other"
            )
        units = _units(lines[number + 1]) if number + 1 < len(lines) else []
        units = units if units and units[0].startswith("(") else []
        factor = _si(units[1], "kg", f"{where}: column {names[1]}") if len(units) > 1 else 1.0
        rows = _rows(lines, number + 1 + bool(units), 2)
        _check_count(len(rows), _above(lines[start:number], f"n{names[1]}", len(rows), path), where)
        for at, mass in rows:
            if not (0 <= at <= 1 and mass >= 0):
                raise InputError(
                    f"{where}: a mass of {mass:g} at {at:g}; fractions run from 0 to 1, and masses "
                    "are positive"
                )
        found += [(at, mass * factor) for at, mass in rows if mass]
    return found


def _check_count(rows: int, wanted: float, where: str) -> None:
    if rows != wanted:
        raise InputError(
            f"{where}: {rows} rows below it, but {wanted:g} are announced above; correct the "
            "number, or complete the table"
        )


def _notes(
    kind: Kind, columns: Mapping[str, Array], plane: int, *, torsion: bool
) -> tuple[str, ...]:
    left = [name for name in kind.unmodelled if name in columns and np.any(columns[name])]
    left = [name for name in left if not (torsion and name == kind.torsion)]
    notes = [f"{kind.name}, {kind.stiffness[plane - 1]}: plane {plane} of bending (--plane)"]
    if kind.inertia and np.any(columns.get(kind.inertia[plane - 1], 0.0)):
        notes.append(f"{kind.inertia[plane - 1]} counts as rotary inertia")
    if left:
        notes.append(f"left out, since a beam in one plane has none: {', '.join(left)}")
    return tuple(notes)


def _kind(lines: Sequence[str], path: Path) -> tuple[Kind, int]:
    """Return the kind of file and the line of its column names."""
    for number, line in enumerate(lines):
        words = line.lower().split()
        for kind in KINDS:
            if kind.x in words and kind.mass in words:
                return kind, number
    names = "; ".join(f"{k.x}, {k.mass}, {', '.join(k.stiffness)}" for k in KINDS)
    raise InputError(
        f"{path}: there is no table of sections; its column names must hold one of: {names}"
    )


def _columns(
    lines: Sequence[str], head: int, kind: Kind, path: Path
) -> tuple[dict[str, Array], int]:
    """Return the columns in SI, x as it stands, and the number of the line below them."""
    names = lines[head].lower().split()
    needed = [kind.x, kind.mass, *kind.stiffness]
    for name in needed:
        if name not in names:
            raise InputError(f"{path}, line {head + 1}: there is no column {name}; add it")
    units = _units(lines[head + 1]) if head + 1 < len(lines) else []
    start = head + 1 + (bool(units) and units[0].startswith("("))
    factors = _factors(names, units, kind, path, head + 2) if start > head + 1 else {}
    rows = _rows(lines, start, len(names))
    wanted = int(_above(lines[:head], kind.count, max(len(rows), 2), path))
    if len(rows) != wanted:
        say = f"{len(rows)} sections from line {start + 1} on, but {kind.count} says {wanted}"
        raise InputError(f"{path}: {say}; correct the number, or complete the table")
    table = np.array(rows)
    columns = {n: table[:, i] * factors.get(n, 1.0) for i, n in enumerate(names)}
    return columns, start + len(rows)


def _units(line: str) -> list[str]:
    """Return the units of a line, with their parentheses, in which blanks may stand."""
    return re.findall(r"\([^()]*\)", line) if line.lstrip().startswith("(") else line.split()


def _rows(lines: Sequence[str], start: int, width: int) -> list[list[float]]:
    """Return rows of numbers up to the first line that has fewer of them."""
    rows: list[list[float]] = []
    for line in lines[start : start + MOST_ROWS]:
        words = line.replace("\t", " ").split()[:width]
        numbers = [_number(word) for word in words]
        if len(words) < width or not all(map(math.isfinite, numbers)):
            break
        rows.append(numbers)
    return rows


def _number(word: str) -> float:
    try:
        return float(re.sub("[dD]", "e", word))
    except ValueError:
        return math.nan


def _factors(
    names: Sequence[str], units: Sequence[str], kind: Kind, path: Path, line: int
) -> dict[str, float]:
    """Return the factors to SI from the line of units."""
    si = {kind.mass: UNITS["mass"], **dict.fromkeys(kind.stiffness, UNITS["stiffness"])}
    si |= {kind.axial: UNITS["axial"], **dict.fromkeys(kind.inertia, UNITS["inertia"])}
    si[kind.torsion] = UNITS["stiffness"]
    factors = {}
    for name, unit in zip(names, units, strict=False):
        if name in si:
            factors[name] = _si(unit, si[name], f"{path}, line {line}: column {name}")
    return factors


def _si(unit: str, si: str, where: str) -> float:
    """Return the factor from a unit in parentheses to SI."""
    written = unit.strip("()").replace("Nm", "N m").replace("kg-m", "kg m")
    try:
        return unit_factor(written, si)
    except ValueError as error:
        raise InputError(f"{where}: {error}") from error


def _above(lines: Sequence[str], key: str, default: float, path: Path) -> float:
    """Return the number on the line whose second word is this key, as `1.0 AdjTwMa - ...`."""
    for number, line in enumerate(lines, 1):
        words = line.split()
        if len(words) > 1 and words[1].lower().strip(":") == key:
            value = _number(words[0])
            least = 0.0 if key.startswith("n") else 1e-9  # a count may be none, a factor not
            if not (math.isfinite(value) and least <= value <= 1e6):
                raise InputError(
                    f"{path}, line {number}: {words[1]} is {short(words[0])}; it must be a "
                    "positive number"
                )
            return value
    return default
