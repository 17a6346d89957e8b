"""Reading a beam from any of the formats that hold one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.file import ALL_COLUMNS, BeamFile, load_beam
from antinode.beam.limits import check_limits
from antinode.beam.settings import Solve
from antinode.beam.station_csv import hull_of, read_station_csv, without_hull
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.override import override
from antinode.inputs.reading import naming, read_toml
from antinode.text import short

from .formats import Format
from .tabulated import Hull
from .units import SI, System

Notes = tuple[str, ...]


@dataclass(frozen=True)
class Choices:
    """What a file may leave open.

    Attributes
    ----------
    assignments : tuple of str
        Overrides such as ``"beam.ends.left=clamped"``.
    system : System
        Units of a file that does not say them.
    plane : {1, 2}
        In which the beam bends, where a file has two.
    length : float or None
        [m], where stations are fractions of it.
    elements : tuple of range
        Of a larger model that make up the beam; empty for all.
    """

    assignments: tuple[str, ...] = ()
    system: System = SI
    plane: int = 1
    length: float | None = None
    elements: tuple[range, ...] = ()


def elements_of(text: str) -> tuple[range, ...]:
    """Return the numbers that a list such as ``"7,100:140"`` names, both ends among them.

    Raises
    ------
    InputError
        If it is no such list.
    """
    found = []
    for part in text.split(",") if text.strip() else ():
        ends = [end.strip() for end in part.split(":")]
        if not (1 <= len(ends) <= 2 and all(re.fullmatch(r"\d{1,18}", end) for end in ends)):
            raise InputError(
                f"--elements {short(text)}: {short(part)} is no number or range; write e.g. 100:140"
            )
        first, last = int(ends[0]), int(ends[-1])
        if last < first:
            raise InputError(
                f"--elements {short(text)}: {short(part)} runs backwards; turn it round"
            )
        found.append(range(first, last + 1))
    return tuple(found)


@dataclass(frozen=True)
class Found:
    """A beam from a file, with what to solve for, and what was left out of it.

    Columns of a hull stand beside it: a table of stations may have them, a beam has none.
    """

    beam: Beam
    solve: Solve
    notes: Notes
    hull: Hull = field(default_factory=dict)


def read_beam(path: Path, how: Format, choices: Choices) -> Found:
    """Read a beam.

    Parameters
    ----------
    path : Path
    how : str
        Name of its format.
    choices : Choices

    Raises
    ------
    InputError
        If it cannot be read.
    """
    readers: dict[str, Callable[[Path, Choices], Found]] = {
        "toml": _from_toml,
        "csv": _from_csv,
        "xlsx": _from_workbook,
        "nastran": _from_nastran,
        "sections": _from_sections,
        "bmodes": _from_bmodes,
    }
    if how not in readers:
        raise InputError(f"{path}: a beam cannot be read from the format {how}; give another file")
    return readers[how](path, choices)


def _from_tables(
    tables: dict[str, Any], where: str, assignments: Iterable[str], notes: Notes
) -> Found:
    """Return the beam of the tables of a beam file, overridden."""
    assignments = tuple(assignments)
    override(tables, assignments)
    where = f"{where} (with --set)" if assignments else where
    file = validate(BeamFile, tables, where)
    with naming(where):
        beam = file.beam()
        check_limits(beam)
    return Found(beam, file.solve, (*notes, *file.notes))


def _from_toml(path: Path, choices: Choices) -> Found:
    assignments = choices.assignments
    if "vehicle" in read_toml(path):
        from antinode.vehicle.case import load_case

        case = load_case(path, assignments)
        with naming(str(path)):
            return Found(case.beam(), case.solve, ())
    file = load_beam(path, assignments)
    return Found(file.beam(), file.solve, file.notes)


def _from_nastran(path: Path, choices: Choices) -> Found:
    from .nastran.reader import read_nastran

    beam, notes = read_nastran(path, choices.system, choices.plane, choices.elements)
    if choices.assignments:
        from .beam_toml import beam_tables

        tables, more = beam_tables(beam)
        return _from_tables({"beam": tables}, str(path), choices.assignments, (*notes, *more))
    with naming(str(path)):
        check_limits(beam)
    return Found(beam, Solve(), notes)


def _from_csv(path: Path, choices: Choices) -> Found:
    return _with_hull(read_station_csv(path, ALL_COLUMNS), path, choices)


def _from_workbook(path: Path, choices: Choices) -> Found:
    from antinode.beam.workbook import read_workbook

    return _with_hull(read_workbook(path, ALL_COLUMNS), path, choices)


def _with_hull(table: dict[str, Any], path: Path, choices: Choices) -> Found:
    """Return the beam of a table of stations, with the columns of a hull beside it."""
    tables = {"beam": without_hull(table)}
    found = _from_tables(tables, str(path), choices.assignments, ())
    columns = table["stations"]
    names = hull_of(columns)
    hull = {name: np.array(columns[name]) for name in ("x", *names)} if names else {}
    return replace(found, hull=hull)


def _from_sections(path: Path, choices: Choices) -> Found:
    from .sections import read_sections

    table, notes = read_sections(path, choices.plane, choices.length)
    return _from_tables({"beam": table}, str(path), choices.assignments, notes)


def _from_bmodes(path: Path, choices: Choices) -> Found:
    from .bmodes import read_main_file

    table, notes = read_main_file(path, choices.plane)
    return _from_tables({"beam": table}, str(path), choices.assignments, notes)
