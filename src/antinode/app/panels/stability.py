"""Where stability is lost along a factor on all axial forces, as a table."""

from __future__ import annotations

from typing import Any

from antinode.app.compute import Answer
from antinode.errors import AntinodeError
from antinode.stability.result import CriticalLoad
from antinode.stability.stability import stability

from .sheet import said, sheet


def stability_data(answer: Answer) -> dict[str, Any]:
    """Return every change of stability up to the first flutter, by rising factor."""
    try:
        found = stability(answer.beam)
    except AntinodeError as error:
        return said(str(error))
    if not found.critical:
        low, high = found.range
        return said(f"No stability is lost for factors from {low:g} to {high:.4g}.")
    heads = ["kind", "factor", "±", "Hz", "modes", "proven"]
    meaning = "Factor on all axial forces at which stability is lost; 1 is the present state."
    return sheet(heads, map(_row, found.critical), found.warnings, meaning)


def _row(load: CriticalLoad) -> list[str]:
    return [
        load.kind if load.change == "lost" else f"{load.kind}, {load.change}",
        f"{load.load_factor:.6g}",
        f"{load.error:.0e}".replace("e-0", "e-"),
        f"{load.frequency_hz:.5g}",
        ", ".join(load.modes),
        "yes" if load.proven else "no",
    ]
