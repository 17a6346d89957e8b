"""An identification as CSV, units in the headers."""

from __future__ import annotations

import csv
import io
from typing import Any

from .result import Identification


def comparison_csv(result: Identification) -> str:
    """Return observed against fitted as CSV, one line a frequency."""
    header = ["row", "name", "family", "number", "paired_number", "observed [Hz]", "fitted [Hz]"]
    return _csv(
        [*header, "relative_difference", "sd [Hz]", "mac"],
        [list(c.to_dict().values()) for c in result.comparisons],
    )


def parameter_csv(result: Identification) -> str:
    """Return the parameters as CSV."""
    header = ["name", "unit", "value", "start", "sd", "low_95", "high_95", "determined", "at_bound"]
    rows = []
    for parameter in result.parameters:
        cells = parameter.to_dict()
        low, high = cells.pop("interval_95")
        cells = {**cells, "low": low, "high": high}
        order = ("name", "unit", "value", "start", "sd", "low", "high", "determined", "at_bound")
        rows.append([cells[name] for name in order])
    return _csv(header, rows)


def _csv(header: list[str], rows: list[list[Any]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([["" if v is None else _cell(v) for v in row] for row in rows])
    return out.getvalue()


def _cell(value: Any) -> Any:
    return repr(float(value)) if isinstance(value, float) else value
