"""Tables of sections of wind-turbine programs: ElastoDyn's towers and blades, BModes' sections.

A line of column names, a line of units in parentheses, then one row a section; words after the
numbers, and what stands above the names, are passed over but for the factors that adjust a column.
Sections stand at fractions of the length, and columns run linearly between them.
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
    axial, inertia : str or tuple
        Axial stiffness, and mass moments per length in the two planes, where there are any.
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
        factors={"tmassden": "adjtwma", "twfastif": "adjfast", "twssstif": "adjssst"},
        count="ntwinpst",
    ),
    Kind(
        "ElastoDyn blade",
        "blfract",
        "bmassden",
        ("flpstff", "edgstff"),
        factors={"bmassden": "adjblms", "flpstff": "adjflst", "edgstff": "adjedst"},
        count="nblinpst",
        unmodelled=("strctwst",),
    ),
    Kind(
        "BModes sections",
        "sec_loc",
        "mass_den",
        ("flp_stff", "edge_stff"),
        axial="axial_stff",
        inertia=("flp_iner", "edge_iner"),
        count="n_secs",
        unmodelled=("str_tw", "tw_iner", "cg_offst", "sc_offst", "tc_offst"),
    ),
)
UNITS = {"mass": "kg/m", "stiffness": "N m^2", "axial": "N", "inertia": "kg m"}


def read_sections(
    path: Path, plane: int, length: float | None
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Read a table of sections.

    Parameters
    ----------
    path : Path
    plane : {1, 2}
        Flap or fore-aft, or edge or side-side.
    length : float or None
        [m], of which the sections stand at fractions.

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
    columns = _columns(lines, head, kind, path)
    if length is None:
        raise InputError(
            f"{path}: the sections stand at fractions of the length of the {kind.name[:9]} file's "
            "beam, which it does not give; add --length, e.g. --length 87.6m"
        )
    for name, key in (kind.factors or {}).items():
        columns[name] = columns[name] * _above(lines[:head], key, 1.0, path)
    stations = {
        "x": (columns[kind.x] * length).tolist(),
        "mass_per_length": columns[kind.mass].tolist(),
        "bending_stiffness": columns[kind.stiffness[plane - 1]].tolist(),
    }
    if kind.axial in columns:
        stations["axial_stiffness"] = columns[kind.axial].tolist()
    if kind.inertia and kind.inertia[plane - 1] in columns:
        inertia = columns[kind.inertia[plane - 1]]
        if np.all(inertia > 0) and np.all(columns[kind.mass] > 0):
            stations["radius_of_gyration"] = np.sqrt(inertia / columns[kind.mass]).tolist()
    table = {"name": path.stem[:200], "interpolation": "linear", "stations": stations}
    return table, _notes(kind, columns, plane)


def _notes(kind: Kind, columns: Mapping[str, Array], plane: int) -> tuple[str, ...]:
    left = [name for name in kind.unmodelled if name in columns and np.any(columns[name])]
    notes = [f"{kind.name}, {kind.stiffness[plane - 1]}: plane {plane} of bending (--plane)"]
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


def _columns(lines: Sequence[str], head: int, kind: Kind, path: Path) -> dict[str, Array]:
    """Return the columns in SI; x as it stands."""
    names = lines[head].lower().split()
    needed = [kind.x, kind.mass, *kind.stiffness]
    for name in needed:
        if name not in names:
            raise InputError(f"{path}, line {head + 1}: there is no column {name}; add it")
    units = lines[head + 1].split() if head + 1 < len(lines) else []
    start = head + 1 + (bool(units) and units[0].startswith("("))
    factors = _factors(names, units, kind, path, head + 2) if start > head + 1 else {}
    rows = _rows(lines, start, len(names))
    wanted = int(_above(lines[:head], kind.count, len(rows), path))
    if len(rows) < max(wanted, 2):
        say = f"{len(rows)} sections from line {start + 1} on, but {kind.count} says {wanted}"
        raise InputError(f"{path}: {say}; the file may be cut off")
    table = np.array(rows[:wanted])
    return {n: table[:, i] * factors.get(n, 1.0) for i, n in enumerate(names)}


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
    factors = {}
    for name, unit in zip(names, units, strict=False):
        if name in si:
            written = unit.strip("()").replace("Nm", "N m").replace("kg-m", "kg m")
            try:
                factors[name] = unit_factor(written, si[name])
            except ValueError as error:
                raise InputError(f"{path}, line {line}: column {name}: {error}") from error
    return factors


def _above(lines: Sequence[str], key: str, default: float, path: Path) -> float:
    """Return the number on the line whose second word is this key, as `1.0 AdjTwMa - ...`."""
    for number, line in enumerate(lines, 1):
        words = line.split()
        if len(words) > 1 and words[1].lower().strip(":") == key:
            value = _number(words[0])
            if not (math.isfinite(value) and 0 < value <= 1e6):
                raise InputError(
                    f"{path}, line {number}: {words[1]} is {short(words[0])}; it must be a "
                    "positive number"
                )
            return value
    return default
