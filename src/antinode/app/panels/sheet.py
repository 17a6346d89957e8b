"""A table as JSON for the browser: headings, rows of cells, what is said below."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any


def sheet(
    columns: Sequence[str],
    rows: Iterable[Sequence[str | dict[str, Any]]],
    notes: Iterable[str] = (),
    meaning: str = "",
) -> dict[str, Any]:
    """Return a table; a cell is a text, or one with a signed share of the cell that a bar takes."""
    return {
        "meaning": meaning,
        "columns": list(columns),
        "rows": [list(row) for row in rows],
        "notes": list(notes),
    }


def barred(value: float, largest: float, text: str) -> dict[str, Any]:
    """Return a cell with a bar from its middle, to the left where the value is negative."""
    known = math.isfinite(value) and largest > 0
    return {"text": text, "share": float(f"{value / largest:.3g}") if known else 0.0}


def said(sentence: str) -> dict[str, Any]:
    """Return a table that says why there is none."""
    return sheet((), (), (sentence,))
