"""The tables of the paper against what antinode finds for the reconstructed vehicle.

A difference is ``(antinode - paper) / paper``. The frequencies are those of `antinode modes` on the
example, brought into each row's condition by `--set`.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import BENDING
from antinode.errors import ComputationError
from antinode.modes.solve import solve_one
from antinode.show.loads_table import condition_dict
from antinode.vehicle.case import Case, load_case

from .tables import MODES, TABLES, Row, read_rows


def example() -> Path:
    """Return the case file of the reconstructed vehicle."""
    return Path(str(files("antinode").joinpath("examples", "paper", "case.toml")))


@dataclass(frozen=True)
class Bounds:
    """Largest differences that are allowed.

    Attributes
    ----------
    worst, rms : float
        Largest, and root mean square, of the relative differences [-].
    """

    worst: float
    rms: float


def read_bounds() -> dict[str, Any]:
    """Return the bounds that ship with the vehicle: ``target``, ``shipped`` and ``achieved``."""
    text = files(__package__).joinpath("bounds.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@dataclass(frozen=True)
class Line:
    """A row of the paper beside what antinode finds.

    Attributes
    ----------
    row : Row
        The paper's.
    case : Case
        The reconstructed vehicle in the row's condition.
    antinode_hz : ndarray
        Bending frequencies 1 to 6 [Hz].
    """

    row: Row
    case: Case
    antinode_hz: Array

    @cached_property
    def differences(self) -> Array:
        """Relative differences, antinode less paper [-]."""
        paper = np.array(self.row.frequencies_hz)
        return np.asarray((self.antinode_hz - paper) / paper)

    def to_dict(self) -> dict[str, Any]:
        """Return the line as plain numbers for JSON."""
        return {
            "table": self.row.table,
            "condition": condition_dict(self.case),
            "mass_state": self.row.mass_state,
            "set": list(self.row.settings),
            "paper_hz": list(self.row.frequencies_hz),
            "antinode_hz": self.antinode_hz.tolist(),
            "relative_differences": self.differences.tolist(),
            "held_out": self.row.held_out,
        }


@dataclass(frozen=True)
class Comparison:
    """All rows, and the bounds that they are held to.

    Attributes
    ----------
    lines : tuple of Line
        In the order of the paper.
    target, bounds : Bounds
        What was aimed at, and what the shipped vehicle is held to.
    """

    lines: tuple[Line, ...]
    target: Bounds
    bounds: Bounds

    @cached_property
    def overall(self) -> Bounds:
        """Worst and rms difference over all rows."""
        return size_of(self.lines)

    @property
    def fitted(self) -> tuple[Line, ...]:
        """The rows that the vehicle was fitted to."""
        return tuple(line for line in self.lines if not line.row.held_out)

    @property
    def held_out(self) -> tuple[Line, ...]:
        """The rows that it was not fitted to."""
        return tuple(line for line in self.lines if line.row.held_out)

    def table(self, number: int) -> tuple[Line, ...]:
        """Return the lines of one table."""
        return tuple(line for line in self.lines if line.row.table == number)

    @property
    def within_bounds(self) -> bool:
        """Whether the bounds hold that ship with the vehicle."""
        return within(self.overall, self.bounds)

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain numbers for JSON."""
        groups = {"held_out": self.held_out, "fitted": self.fitted}
        return {
            "schema_version": 1,
            "vehicle": self.lines[0].case.vehicle.name,
            "reconstruction": True,
            "rows": [line.to_dict() for line in self.lines],
            "tables": [
                {"table": table.number, **_relative(size_of(self.table(table.number)))}
                for table in TABLES
            ],
            **_relative(self.overall),
            **{name: _relative(size_of(lines)) for name, lines in groups.items()},
            "bounds": _relative(self.bounds),
            "target": _relative(self.target),
            "within_bounds": self.within_bounds,
        }


def _relative(size: Bounds) -> dict[str, float]:
    return {"worst_relative": size.worst, "rms_relative": size.rms}


def size_of(lines: Iterable[Line]) -> Bounds:
    """Return the worst and the root mean square difference of some lines."""
    differences = np.concatenate([line.differences for line in lines])
    return Bounds(float(np.max(np.abs(differences))), math.sqrt(float(np.mean(differences**2))))


def within(size: Bounds, bounds: Bounds) -> bool:
    """Whether differences of this size keep the bounds."""
    return size.worst <= bounds.worst and size.rms <= bounds.rms


def check_bounds(comparison: Comparison) -> None:
    """Raise ComputationError if the differences are beyond the shipped bounds."""
    size, bounds = comparison.overall, comparison.bounds
    if not within(size, bounds):
        raise ComputationError(
            f"the reconstructed vehicle is {size.worst:.3g} at worst and {size.rms:.3g} rms from "
            f"the paper's tables, beyond the bounds {bounds.worst:.3g} and {bounds.rms:.3g} that "
            "ship with it; reinstall antinode"
        )


def compare() -> Comparison:
    """Compute all rows of the paper with the reconstructed vehicle."""
    bounds = read_bounds()
    return Comparison(
        lines=tuple(_line(row) for row in read_rows()),
        target=Bounds(**bounds["target"]),
        bounds=Bounds(**bounds["shipped"]),
    )


def _line(row: Row) -> Line:
    case = load_case(example(), row.settings)
    modes = max(case.solve.modes, MODES)
    result = solve_one(case, modes, tolerance=case.solve.tolerance, families=[BENDING])
    return Line(row, case, result.frequencies_hz()[:MODES])
