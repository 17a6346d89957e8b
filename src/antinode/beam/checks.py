"""What a beam must keep to, row by row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.arguments import choice
from antinode.arrays import Array, Interpolation
from antinode.errors import InputError
from antinode.text import counted

from .attachments import check_attachments, check_supports_apart, held_places
from .families import FAMILIES, FamilyName

if TYPE_CHECKING:
    from .beam import Beam


def check(beam: Beam) -> None:
    """Raise InputError unless shapes agree, x rises, and every property is in its range."""
    n = len(beam.x) - 1
    check_stations(beam.x)
    choice("interpolation", beam.interpolation, Interpolation)
    if not np.isfinite(beam.x).all():
        raise InputError("x: every breakpoint must be a finite number [m]")
    rises = beam.x[1:] > beam.x[:-1]
    for k in () if rises.all() else np.flatnonzero(~rises)[:1]:
        raise InputError(
            f"x must increase from row to row: row {k + 2} has {beam.x[k + 1]:g} m "
            f"after {beam.x[k]:g} m in row {k + 1}"
        )
    for name in TABLES:
        values = getattr(beam, name)
        if values is not None:
            _check_table(name, values, n)
    _check_complete(beam)
    if beam.attachments:
        check_attachments(beam.attachments, beam.x)
        _check_supports(beam)
    for item in beam.attachments:
        if np.min(np.abs(beam.x - item.x)) > 1e-9 * beam.length:
            raise InputError(
                f"no breakpoint at x = {item.x:g} m, where something is attached; "
                "use Beam.with_attachments"
            )


def check_stations(x: Array) -> None:
    """Raise InputError unless x is a column of at least two places."""
    if x.ndim != 1 or len(x) < 2:
        received = counted(len(x), "place") if x.ndim == 1 else f"an array of shape {x.shape}"
        raise InputError(f"a beam needs at least two breakpoints x; received {received}")


def check_rows(name: str, column: Array, rows: int, interpolation: Interpolation) -> None:
    """Raise InputError unless a column has a value for each station, or step, of a table."""
    choice("interpolation", interpolation, Interpolation)
    allowed = (rows, rows - 1) if interpolation == "step" else (rows,)
    if column.ndim != 1 or len(column) not in allowed:
        wanted = " or ".join(f"({number},)" for number in allowed)
        raise InputError(
            f"{name} has shape {column.shape}, but x has {counted(rows, 'station')}: give one "
            f"value for each, shape {wanted}, or a single number"
        )


def _check_complete(beam: Beam) -> None:
    """Refuse one column of a family without the other, but for what every beam has."""
    for name, family in FAMILIES.items():
        absent = [table for table in family.tables if getattr(beam, table) is None]
        there = [table for table in family.tables if table not in (*absent, *_ALWAYS)]
        if absent and there:
            raise InputError(
                f"{there[0]} is given, but {absent[0]} is missing: {name} modes need both; give "
                "both, or neither"
            )


_ALWAYS = "mass_per_length", "axial_force"


def _check_supports(beam: Beam) -> None:
    """Refuse a support that all but coincides with an end which is held, or with another one."""
    ends = zip((beam.ends.left, beam.ends.right), beam.x[[0, -1]].tolist(), strict=True)
    held = [x for end, x in ends if end in ("pinned", "clamped")]
    check_supports_apart([*held, *held_places(beam.attachments)], beam.x)


def _check_table(name: str, values: Array, n: int) -> None:
    if values.shape != (n, 2):
        raise InputError(f"{name} has shape {values.shape}; {n} intervals need shape ({n}, 2)")
    ok = np.isfinite(values) if name == "axial_force" else np.isfinite(values) & (values > 0)
    if ok.all():
        return
    for row, side in np.argwhere(~ok)[:1]:
        allowed = "finite" if name == "axial_force" else "positive and finite"
        raise InputError(f"{name} must be {allowed}: interval {row + 1} has {values[row, side]:g}")


TABLES = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "axial_force",
    "radius_of_gyration",
    "torsional_stiffness",
    "polar_inertia_per_length",
)

LOGARITHMIC = ("mass_per_length", "bending_stiffness", "axial_stiffness", "torsional_stiffness")
"""Those that vary exponentially where the interpolation is "log"; the others vary linearly."""


def given(beam: Beam, name: FamilyName, column: str) -> Array:
    """Return the beam's table for a column of a family's law, or say that it is missing."""
    family = FAMILIES[name]
    values: Array | None = getattr(beam, family.columns[column])
    if values is None:
        raise InputError(
            f"{family.columns[column]} is missing: {name} modes need {family.symbol} and "
            f"{family.columns['mass']} at every station"
        )
    return values
