"""An identification as plain numbers: for JSON and CSV, units in keys and headers."""

from __future__ import annotations

import csv
import io
import math
from typing import Any

from .identification import Comparison, Identification
from .words import correlations_text, directions_text


def identification_dict(result: Identification) -> dict[str, object]:
    """Return all that was found as plain numbers."""
    e = result.estimates
    return {
        "schema_version": 1,
        "name": result.case.vehicle.name,
        "interrupted": result.interrupted,
        "cost": result.cost,
        "worst_relative": result.worst_relative,
        "rms_relative": result.rms_relative,
        "noise_factor": e.noise,
        "noise_known": e.known_noise,
        "degrees_of_freedom": e.freedoms,
        "parameters": [_parameter(result, k) for k in range(len(result.parameters))],
        "rows": [_comparison(c) for c in result.comparisons],
        "correlation": e.correlation.tolist(),
        "singular_values": e.singular_values.tolist(),
        "undetermined": [
            {
                "singular_value": d.singular_value,
                "parameters": [e.unknowns.items[k].label for k in d.entries],
                "parts": list(d.parts),
            }
            for d in e.undetermined
        ],
        "words": [*directions_text(e), *correlations_text(e)],
        "starts": [start._asdict() for start in result.starts],
        "evaluations": result.evaluations,
        "seconds": result.seconds,
        "warnings": list(result.warnings),
    }


def _parameter(result: Identification, k: int) -> dict[str, Any]:
    p = result.parameters[k]
    return {
        "name": p.name,
        "unit": p.unit,
        "value": p.value,
        "start": p.start,
        "sd": _null(p.sd),
        "interval_95": [_null(v) for v in p.interval],
        "determined": p.determined,
        "at_bound": p.at_bound,
    }


def _comparison(c: Comparison) -> dict[str, Any]:
    return {
        "row": c.row,
        "name": c.label,
        "family": c.family,
        "number": c.number,
        "paired_number": c.paired,
        "observed_hz": c.observed_hz,
        "fitted_hz": c.fitted_hz,
        "relative_difference": c.relative,
        "sd_hz": c.sd_hz,
        "mac": _null(c.mac),
    }


def _null(value: float) -> float | None:
    return value if math.isfinite(value) else None


def comparison_csv(result: Identification) -> str:
    """Return observed against fitted as CSV, one line a frequency."""
    header = ["row", "name", "family", "number", "paired_number", "observed [Hz]", "fitted [Hz]"]
    return _csv(
        [*header, "relative_difference", "sd [Hz]", "mac"],
        [list(_comparison(c).values()) for c in result.comparisons],
    )


def parameter_csv(result: Identification) -> str:
    """Return the parameters as CSV."""
    header = ["name", "unit", "value", "start", "sd", "low_95", "high_95", "determined", "at_bound"]
    rows = []
    for k in range(len(result.parameters)):
        cells = _parameter(result, k)
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
