"""Results as tables in CSV, with units in their headers."""

from __future__ import annotations

import csv
import io
import math

from antinode.modes.dataset import SCALARS
from antinode.modes.result import ModalResult


def modal_table(result: ModalResult) -> str:
    """Return the modes as CSV with units in the header, one row a mode."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    units = ["" if unit == "1" else f" [{unit}]" for _, unit, _ in SCALARS]
    header = [name + unit for (name, _, _), unit in zip(SCALARS, units, strict=True)]
    writer.writerow(["family", "number", "name", "kind", *header])
    for m in result.modes:
        values = [_number(getattr(m, name)) for name, _, _ in SCALARS]
        cells = ["" if math.isnan(v) else repr(float(v)) for v in values]
        writer.writerow([m.family, m.number, m.name, m.kind, *cells])
    return out.getvalue()


def _number(value: float | None) -> float:
    return math.nan if value is None else value
