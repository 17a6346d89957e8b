"""Observations for `antinode identify`: rows of frequencies as TOML, CSV or JSON."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from antinode.beam.families import FAMILIES
from antinode.inputs.toml_writing import toml_text
from antinode.show.writing import to_json, write_text, write_whole

from .formats import Format

_HEAD = """\
# Observations for an identification file, beside its case and what of it may change:
# put them into it, or name a .csv of them with observations = "FILE.csv".
"""


def write_observations(path: Path, rows: Sequence[dict[str, Any]], how: Format) -> tuple[str, ...]:
    """Write rows of observations.

    Parameters
    ----------
    path : Path
    rows : sequence of dict
        As an identification file has them.
    how : {"toml", "csv", "json"}

    Returns
    -------
    tuple of str
        What the file leaves out.
    """
    texts = {"toml": observations_toml, "csv": observations_csv, "json": observations_json}
    text = texts[how](rows)
    write_whole(path, lambda partial: write_text(partial, text))
    shapes = sum(len(row.get("shapes", ())) for row in rows)
    if how == "csv" and shapes:
        return (f"shapes are left out ({shapes}); write a .toml to keep them",)
    return ()


def observations_toml(rows: Sequence[dict[str, Any]]) -> str:
    """Return rows as tables `[[observations]]`."""
    return _HEAD + "\n" + toml_text({"observations": [_flat(row) for row in rows]})


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row with its keys in their order."""
    order = ("name", *FAMILIES, "sd", "shapes")
    return {key: row[key] for key in order if key in row}


def observations_json(rows: Sequence[dict[str, Any]]) -> str:
    """Return rows as JSON; null stands for what was not measured."""
    return to_json({"schema_version": 1, "observations": list(rows)}) + "\n"


def observations_csv(rows: Sequence[dict[str, Any]]) -> str:
    """Return rows as a CSV table, without shapes."""
    most = {family: max(len(row.get(family, ())) for row in rows) for family in FAMILIES}
    columns = [(family, k) for family in FAMILIES for k in range(most[family])]
    with_sd = any("sd" in row for row in rows)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    header = [f"{family}:{k + 1} [Hz]" for family, k in columns]
    writer.writerow(["name", *header, *(["sd [Hz]"] if with_sd else [])])
    for row in rows:
        cells = [_cell(row.get(family, ()), k) for family, k in columns]
        sd = [repr(row["sd"]) if "sd" in row else ""] if with_sd else []
        writer.writerow([row.get("name", ""), *cells, *sd])
    return out.getvalue()


def _cell(values: Sequence[float], index: int) -> str:
    value = values[index] if index < len(values) else math.nan
    return "" if math.isnan(value) else repr(float(value))
