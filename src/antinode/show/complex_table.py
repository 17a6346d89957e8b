"""Complex modes as a table on the terminal: frequency, damping ratio, growth."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from rich.text import Text

if TYPE_CHECKING:
    from rich.table import Table

    from antinode.modes.result import Mode

HEADINGS = (
    "mode",
    "kind",
    "frequency [Hz]",
    "damping ratio",
    "growth [1/s]",
    "+- error [1/s]",
)
BRIEF = "mode", "kind", "f [Hz]", "damping", "growth [1/s]", "+- [1/s]"


def fill(table: Table, modes: Sequence[Mode], frequency_text: Callable[[Mode], str]) -> Table:
    """Add a row for each mode, families apart."""
    family = ""
    for mode in modes:
        if family and mode.family != family:
            table.add_section()
        family = mode.family
        table.add_row(*(Text(cell) for cell in _cells(mode, frequency_text)))
    return table


def _cells(mode: Mode, frequency_text: Callable[[Mode], str]) -> tuple[str, ...]:
    s = mode.eigenvalue_per_s
    ratio = mode.damping_ratio
    exact = s == 0 or mode.error_per_s is None
    if mode.error_per_s is not None:
        error = "exact" if exact else f"{mode.error_per_s:.1e}"
    else:
        error = f"{2 * math.pi * mode.error_hz:.1e}" if mode.omega2 > 0 else ""
    return (
        mode.name,
        mode.kind,
        "" if mode.omega2 < 0 else "0" if mode.omega2 == 0 else frequency_text(mode),
        "" if math.isnan(ratio) else f"{ratio:.5g}",
        f"{s.real:.6g}",
        error,
    )
