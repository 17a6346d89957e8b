"""`antinode convert`: from one format to another, by way of the beam."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import get_args

from antinode.arguments import choice
from antinode.errors import InputError
from antinode.show.writing import check_output
from antinode.text import nearest, one_line

from .formats import INPUTS, OUTPUTS, Format, format_of
from .inputs import Choices, Found, read_beam
from .mesh.analyses import Analysis
from .outputs import Modes, check_libraries, write_beam, write_modes
from .units import SI, SYSTEMS, SystemName

_BEAMS = ("toml", "csv", "xlsx")
_TABLES = ("csv", "xlsx")
_ROWS = ("toml", "csv", "json")


@dataclass(frozen=True)
class Request:
    """What to convert, and how.

    Attributes
    ----------
    source, target : Path
    from_format, to_format : str
        Names of the formats; empty for what the endings say.
    choices : Choices
    modes : int or None
        To solve for; by default the file's.
    analysis : {"modes", "unloaded", "statsub", "buckling"}
        What a solver is to do with a deck.
    """

    source: Path
    target: Path
    from_format: str = ""
    to_format: str = ""
    choices: Choices = field(default_factory=Choices)
    modes: int | None = None
    analysis: Analysis = "modes"


def convert(request: Request) -> tuple[str, ...]:
    """Convert a file.

    Returns
    -------
    tuple of str
        What the new file leaves out, or does not hold exactly.

    Raises
    ------
    InputError
        If the one cannot be read, or the other one not written.
    """
    how_in = _named(request.from_format, "--from") or _sniffed(request.source)
    how_out = _named(request.to_format, "--to") or format_of(request.target, OUTPUTS)
    _check(request, how_in, how_out)
    inert = tuple(_without_effect(request, how_in, how_out))
    if how_in == "uff":
        return (*inert, *_convert_measurements(request, how_out))
    found = read_beam(request.source, how_in, request.choices)
    notes = (*inert, *found.notes, *_left_out(found, how_out))
    if how_out in _BEAMS:
        return (*notes, *write_beam(request.target, found.beam, how_out, found.hull))
    modes = _solved(found, request.modes)
    system = request.choices.system
    return (*notes, *write_modes(request.target, modes, how_out, system, request.analysis))


def convert_file(
    source: str | Path, target: str | Path, *, modes: int | None = None, units: SystemName = "SI"
) -> tuple[str, ...]:
    """Convert a beam, or measurements, from one file format to another, by their endings.

    Parameters
    ----------
    source, target : str or Path
        One of the target's name is replaced.
    modes : int, optional
        To solve for, where the target holds modes; by default the file's.
    units : {"SI", "mm-t-s", "mm-kg-ms", "in-lbf-s", "ft-lbf-s"}
        Of a deck, or of measurements that do not say them.

    Returns
    -------
    tuple of str
        What the new file leaves out, or does not hold exactly.

    Raises
    ------
    InputError
        If the one cannot be read, or the other one not written.
    """
    choice("units", units, SystemName)
    choices = Choices(system=SYSTEMS[units])
    return convert(Request(Path(source), Path(target), choices=choices, modes=modes))


def _left_out(found: Found, how_out: Format) -> tuple[str, ...]:
    """Say which columns of a hull the output cannot hold."""
    names = [name for name in found.hull if name != "x"]
    if not names or how_out in _TABLES:
        return ()
    return (f"left out, since a beam has none: {', '.join(names)}",)


def _without_effect(request: Request, how_in: Format, how_out: Format) -> Iterator[str]:
    """Say which options are given that nothing here asks for."""
    given, deck = request.choices, how_out in ("nastran", "calculix")
    modal = how_out not in (*_BEAMS, *_ROWS) or (how_in != "uff" and how_out == "json")
    told = (
        ("--elements", given.elements and how_in != "nastran", "for NASTRAN models"),
        ("--length", given.length and how_in != "sections", "for tables of fractions of a length"),
        ("--plane", given.plane != 1 and how_in not in _PLANES, "for files with two planes"),
        ("--analysis", request.analysis != "modes" and not deck, "for decks (.bdf, .inp)"),
        ("--modes", request.modes and not modal, "for outputs with modes"),
        ("--set", given.assignments and how_in == "uff", "for beams"),
        ("--units", given.system is not SI and not (deck or how_in in _UNITLESS), _NO_UNITS),
    )
    return (f"{name} has no effect here: it is {why}" for name, inert, why in told if inert)


_PLANES = ("nastran", "sections", "bmodes", "uff")
_UNITLESS = ("nastran", "uff")
_NO_UNITS = "for NASTRAN and CalculiX decks, and measurements; all other files are in SI, or say it"


def _named(name: str, option: str) -> Format | None:
    names: tuple[Format, ...] = get_args(Format)
    if not name:
        return None
    for known in names:
        if known == name:
            return known
    raise InputError(f"{option} {one_line(name, 40)} is no format; {nearest(name, names)}")


def _sniffed(path: Path) -> Format:
    """Return the format of a file by its ending; .dat may be NASTRAN's or a table of sections."""
    how = format_of(path, INPUTS)
    if path.suffix.lower() == ".dat" and path.is_file():
        with path.open("rb") as file:
            lines = file.read(100_000).decode("utf-8", errors="replace").upper().splitlines()
        if any(line.startswith(("BEGIN BULK", "GRID")) for line in lines):
            return "nastran"
    return how


def _check(request: Request, how_in: Format, how_out: Format) -> None:
    """Refuse what cannot be converted before any work is done."""
    known = set(INPUTS.values())
    if how_in not in known:
        raise InputError(f"--from {how_in} cannot be read; allowed are {', '.join(sorted(known))}")
    if how_in == "uff" and how_out not in _ROWS:
        raise InputError(
            f"{request.source}: measurements become observations, as {', '.join(_ROWS)}; they "
            f"cannot be written as {how_out}: name another file"
        )
    if how_out in ("sections", "bmodes"):
        raise InputError(f"--to {how_out} cannot be written; choose toml, csv or xlsx")
    if os.path.realpath(request.source) == os.path.realpath(request.target):
        raise InputError(f"{request.target} is the input; name another file for the output")
    check_output(request.target, [request.target.suffix.lower()])
    check_libraries(how_out)


def _solved(found: Found, number: int | None) -> Modes:
    from antinode.modes.solve import solve_one

    solve = found.solve.overridden(modes=number)
    result = solve_one(found.beam, solve.modes, tolerance=solve.tolerance, unloaded=True)
    return Modes(result, result.to_dict())


def _convert_measurements(request: Request, how_out: Format) -> tuple[str, ...]:
    from .observation_rows import write_observations
    from .uff.reader import read_measurements

    choices = request.choices
    rows, notes = read_measurements(request.source, choices.system, choices.plane)
    return (*notes, *write_observations(request.target, rows, how_out))
