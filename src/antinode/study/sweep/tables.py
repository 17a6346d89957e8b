"""A sweep as a table of rows, and as a Dataset that NetCDF can hold."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray


def sweep_csv(dataset: xarray.Dataset) -> str:
    """Return a sweep as CSV: a row for each case, units in the header."""
    headings: list[str] = []
    columns: list[Any] = []
    for name in [*dataset.attrs["input_names"], *dataset.data_vars]:
        values = dataset[name]
        unit = values.attrs.get("units", "1")
        suffix = "" if unit == "1" else f" [{unit}]"
        if values.dims == ("case",):
            headings.append(f"{name}{suffix}")
            columns.append(np.asarray(values))
        elif values.ndim == 2 and values.dims[0] == "case":
            labels = [str(label) for label in dataset[str(values.dims[1])].values]
            headings += [f"{name}: {label}{suffix}" for label in labels]
            columns += list(np.asarray(values).T)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["case", *headings])
    for i, row in enumerate(zip(*columns, strict=True)):
        writer.writerow([i, *("" if np.isnan(v) else v for v in row)])
    return out.getvalue()


def without_lists(dataset: xarray.Dataset) -> xarray.Dataset:
    """Return a Dataset whose attributes NetCDF can hold: lists of texts or tables as JSON."""
    plain = dataset.copy()
    plain.attrs = {k: _plain(v) for k, v in dataset.attrs.items()}
    for name in plain.variables:
        plain[name].attrs = {k: _plain(v) for k, v in plain[name].attrs.items()}
    return plain


def _plain(value: Any) -> Any:
    texts = isinstance(value, list) and any(isinstance(v, str | dict) for v in value)
    texts = texts or value == []
    return json.dumps(value) if texts else value
