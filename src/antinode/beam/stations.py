"""Columns of a beam as people have them, as tables at both ends of the intervals between stations.

A column may be one number for the whole beam; one for each station; with "step" also one for each
interval; a table of the intervals, as the beam keeps it. Numbers are SI, texts carry units.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import choice, numbers
from antinode.arrays import Array, Interpolation
from antinode.errors import InputError
from antinode.text import counted

from .profile import breakpoints, interval_ends, kept_intervals


def as_column(name: str, values: Any) -> Array:
    """Return a column of a beam as floats in SI, not copied where it is one already."""
    if type(values) is np.ndarray and values.dtype.kind in "biuf":
        return numbers(name, values)
    from antinode.inputs.given import in_si
    from antinode.inputs.reading import COLUMN_UNITS

    return numbers(name, in_si(name, values, COLUMN_UNITS[name]))


def check_stations(x: Array) -> None:
    """Raise InputError unless x is a column of at least two places."""
    if x.ndim != 1 or len(x) < 2:
        received = counted(len(x), "place") if x.ndim == 1 else f"an array of shape {x.shape}"
        raise InputError(f"a beam needs at least two breakpoints x; received {received}")


def column_of_rows(
    name: str, values: npt.ArrayLike, rows: int, interpolation: Interpolation
) -> Array:
    """Return a column with a value at every station, from one number for all or one for each.

    Raises
    ------
    InputError
        Unless it has one for each station, or step, of a table.
    """
    given = as_column(name, values)
    if given.ndim == 0:
        given = np.full(rows, given)
    choice("interpolation", interpolation, Interpolation)
    allowed = (rows, rows - 1) if interpolation == "step" else (rows,)
    if given.ndim != 1 or len(given) not in allowed:
        wanted = " or ".join(f"({number},)" for number in allowed)
        raise InputError(
            f"{name} has shape {given.shape}, but x has {counted(rows, 'station')}: give one "
            f"value for each, shape {wanted}, or a single number"
        )
    return given


def tables_of(
    x: Any, columns: Mapping[str, Any], interpolation: Interpolation
) -> tuple[Array, dict[str, Any]]:
    """Return breakpoints and tables of a beam from columns of any form.

    Parameters
    ----------
    x : array_like, shape (n + 1,) or (n + 1, 1)
        Stations [m]; two rows at one x are a jump where all columns are given at the stations.
    columns : dict
        By the beam's names: numbers, columns or tables.
    interpolation : {"step", "linear", "log"}

    Raises
    ------
    InputError
        If a column has another length, or the last row of a stepped one would be lost.
    """
    stations = _upright(as_column("x", x))
    given = {name: _upright(as_column(name, values)) for name, values in columns.items()}
    tables = {name: values for name, values in given.items() if values.ndim >= 2}
    rows = {name: values for name, values in given.items() if values.ndim < 2}
    if not rows:
        return stations, tables
    for name, values in rows.items():
        _check_last(name, values, stations, interpolation)
    at, made = tables_at_stations(stations, rows, interpolation, jumps=not tables)
    return at, tables | made


def tables_at_stations(
    x: Array, columns: Mapping[str, Any], interpolation: Interpolation, *, jumps: bool = True
) -> tuple[Array, dict[str, Any]]:
    """Return breakpoints and tables of columns that have one value for each station.

    With "step" row k holds from x_k to x_k+1, and the last row only closes the table.

    Parameters
    ----------
    x : array, shape (rows,)
        Stations [m].
    columns : dict of array_like, shape (rows,), or with "step" (rows - 1,), or numbers
        By the beam's names.
    interpolation : {"step", "linear", "log"}
    jumps : bool
        Whether two rows at one x are a jump, unless "step".

    Raises
    ------
    InputError
        If a column has another length.
    """
    check_stations(x)
    kept = kept_intervals(x, interpolation if jumps else "step")
    rows = {
        name: column_of_rows(name, values, len(x), interpolation)
        for name, values in columns.items()
    }
    tables = {name: interval_ends(values, kept, interpolation) for name, values in rows.items()}
    return breakpoints(x, kept), tables


def _upright(values: Array) -> Array:
    """Return a column of one number a row as a plain one."""
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _check_last(name: str, rows: Array, x: Array, interpolation: Interpolation) -> None:
    """Refuse a last row that a stepped column does not use though it differs."""
    if interpolation == "step" and rows.shape == x.shape and len(x) > 1 and rows[-1] != rows[-2]:
        raise InputError(
            f"{name} is {rows[-2]:g}, then {rows[-1]:g} in the last rows, but with interpolation "
            "'step', the default, a row holds up to the next station and the last one is not used: "
            "set interpolation='linear' if values run straight between stations, else repeat the "
            "row before, or give one value for each interval"
        )
