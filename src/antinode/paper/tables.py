"""Tables 1 to 5 of the paper as numbers: thirty conditions, six bending frequencies in each.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", Tables 1-5. Tables 2 and 3 are taken at sigma = 0.02, with
which they were computed, whatever their captions say.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from antinode.inputs.units import to_si

MODES = 6
BURN_FRACTION = {"t0": 0, "t10": 1}
"""Burn fraction of the mass states: at the start, and after 10 s."""

_UNITS = {
    "speed": "m/s",
    "cavitation_number": "",
    "cavitator_angle": "rad",
    "fin_position": "m",
    "thrust": "N",
}


@dataclass(frozen=True)
class Row:
    """One row of a table of the paper.

    Attributes
    ----------
    table : int
        1 to 5.
    settings : tuple of str
        What `--set` needs to bring the example into this condition.
    condition : dict
        The same by name, in SI units: ``speed`` [m/s], ``cavitation_number``,
        ``cavitator_angle`` [rad], ``fin_position`` [m], ``burn_fraction``, and ``thrust`` [N]
        where the paper prints it.
    mass_state : str
        ``"t0"`` or ``"t10"``.
    frequencies_hz : tuple of float
        Bending frequencies 1 to 6 as printed [Hz].
    held_out : bool
        Whether the reconstructed vehicle was fitted without this row.
    """

    table: int
    settings: tuple[str, ...]
    condition: dict[str, float]
    mass_state: str
    frequencies_hz: tuple[float, ...]
    held_out: bool


@dataclass(frozen=True)
class Table:
    """What a table of the paper varies.

    Attributes
    ----------
    number : int
        1 to 5.
    title : str
        What it holds.
    varies : str
        The name in `Row.condition` that runs from row to row.
    symbol, unit : str
        How a head names it.
    factor : float
        From SI to `unit`.
    held : str
        What stays the same.
    """

    number: int
    title: str
    varies: str
    symbol: str
    unit: str
    factor: float
    held: str

    @property
    def head(self) -> str:
        """Return the symbol with its unit."""
        return f"{self.symbol} [{self.unit}]" if self.unit else self.symbol

    def value(self, row: Row) -> str:
        """Return what the row has of the quantity that varies, in the table's unit."""
        return f"{row.condition[self.varies] * self.factor:.6g}"


TABLES = (
    Table(
        1, "cavitation number", "cavitation_number", "sigma", "", 1, "80 m/s, 10 deg, fins at 5 m"
    ),
    Table(2, "speed", "speed", "V", "m/s", 1, "sigma = 0.02, 10 deg, fins at 5 m"),
    Table(
        3, "cavitator angle", "cavitator_angle", "alpha", "deg", 180 / math.pi,
        "80 m/s, sigma = 0.02, fins at 5 m",
    ),
    Table(
        4, "fin position", "fin_position", "x_fin", "m", 1, "80 m/s, sigma = 0.02, 10 deg"
    ),
    Table(
        5, "start (t = 0 s) and steady state (t = 10 s)", "speed", "V", "m/s", 1,
        "20 m/s, sigma = 0.02, 10 deg, 120 kN; 150 m/s, sigma = 0.01, 5 deg, 50 kN; fins at 5 m",
    ),
)  # fmt: skip
"""The five tables of the paper."""


@cache
def read_rows() -> tuple[Row, ...]:
    """Return the thirty rows in the order of the paper."""
    text = files(__package__).joinpath("tables.csv").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    return tuple(_row(cells) for cells in csv.DictReader(lines))


def _row(cells: dict[str, str]) -> Row:
    given = dict(_quantities(cells))
    burnt = BURN_FRACTION[cells["mass_state"]]
    condition = {name: to_si(text, _UNITS[name]) for name, text in given.items()}
    return Row(
        table=int(cells["table"]),
        settings=tuple(
            f"condition.{name}={text}"
            for name, text in {**given, "burn_fraction": str(burnt)}.items()
        ),
        condition={**condition, "burn_fraction": float(burnt)},
        mass_state=cells["mass_state"],
        frequencies_hz=tuple(float(cells[f"f{mode} [Hz]"]) for mode in range(1, MODES + 1)),
        held_out=cells["held_out"] == "1",
    )


def _quantities(cells: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Name and text with its unit of everything that the paper prints of a condition."""
    for head, text in cells.items():
        name, _, unit = head.partition(" [")
        if name in _UNITS and text:
            yield name, text + unit.removesuffix("]")
