"""Sensitivities and identifications as tables of pandas, and an identification as files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.show.objects.frames import frame

from .identify.fitted_case import write_identification

if TYPE_CHECKING:
    import pandas

    from .identify.result import Identification
    from .sensitivity.sensitivity import SensitivityResult


def sensitivity_frame(result: SensitivityResult) -> pandas.DataFrame:
    """Return sensitivities as a table, one row for each mode and input.

    Returns
    -------
    DataFrame
        mode, input, first and total Sobol index with the ends of their 95 % intervals, slope [Hz
        for each SI unit of the input], percent_per_percent.
    """
    rows: list[dict[str, Any]] = []
    for m in result.modes:
        for k, name in enumerate(result.inputs):
            first, total = m.indices.first_band[k], m.indices.total_band[k]
            rows.append(
                {
                    "mode": m.name,
                    "input": name,
                    "first": m.indices.first[k],
                    "first_low": first[0],
                    "first_high": first[1],
                    "total": m.indices.total[k],
                    "total_low": total[0],
                    "total_high": total[1],
                    "slope_hz_per_unit": m.slope[k],
                    "percent_per_percent": m.elasticity[k],
                }
            )
    columns = {name: [row[name] for row in rows] for name in rows[0]} if rows else {}
    return frame(columns, {})


def identification_frame(result: Identification) -> pandas.DataFrame:
    """Return observed against fitted frequencies, one row each."""
    rows = [c.to_dict() for c in result.comparisons]
    columns = {name: [row[name] for row in rows] for name in rows[0]} if rows else {}
    return frame(columns, {"observed_hz": "Hz", "fitted_hz": "Hz", "sd_hz": "Hz"})


def save_identification(
    result: Identification, folder: str | Path, *, overwrite: bool = False
) -> list[Path]:
    """Write the fitted case, tables and JSON into a folder, as `antinode identify -o` does.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        If a file exists already, or the folder cannot be written.
    """
    return write_identification(result, Path(folder), overwrite=overwrite)
