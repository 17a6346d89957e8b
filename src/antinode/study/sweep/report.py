"""A sweep on the terminal: ranges of frequencies, failures."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from antinode.errors import AntinodeError
from antinode.show.printing import new_table
from antinode.study.cases.reasons import PAST_BUCKLING, WHY, failed
from antinode.study.cases.values import Cases
from antinode.study.design.points import Points
from antinode.text import counted

if TYPE_CHECKING:
    import xarray

_BLOCK = 100_000


def summary(points: Points, dataset: xarray.Dataset) -> dict[str, Any]:
    """Return what a sweep has found as plain values: ranges by mode, and failures by reason."""
    reason = np.asarray(dataset["reason"])
    wrong = failed(reason)
    modes = [] if "frequency_hz" not in dataset else _ranges(dataset)
    return {
        "schema_version": 1,
        "name": points.study.name or points.study.case.vehicle.name,
        "cases": points.cases,
        "failed": int(wrong.sum()),
        "past_buckling": int(np.sum(reason == PAST_BUCKLING)),
        "failures": [
            {
                "code": code,
                "reason": WHY[code],
                "cases": number,
                "first_case": int(np.flatnonzero(reason == code)[0]),
                "text": failure_text(points, int(np.flatnonzero(reason == code)[0])),
            }
            for code, number in sorted(Counter(reason[wrong].tolist()).items())
        ],
        "inputs": [
            {"name": v.name, "key": v.key, "unit": v.unit, **_range(dataset[v.name])}
            for v in points.variables
        ],
        "modes": modes,
    }


def _range(values: xarray.DataArray) -> dict[str, float]:
    data = np.asarray(values)
    return {"least": float(np.min(data)), "largest": float(np.max(data))}


def _ranges(dataset: xarray.Dataset) -> list[dict[str, Any]]:
    """Return least, mean and largest frequency of every mode, a block of cases at a time."""
    hz, n = dataset["frequency_hz"], dataset.sizes["case"]
    names = [str(name) for name in dataset["mode"].values]
    least, largest = np.full(len(names), np.inf), np.full(len(names), -np.inf)
    total, count = np.zeros(len(names)), np.zeros(len(names), dtype=np.int64)
    for start in range(0, n, _BLOCK):
        part = np.asarray(hz[start : start + _BLOCK])
        known = np.isfinite(part)
        least = np.minimum(least, np.min(part, axis=0, where=known, initial=np.inf))
        largest = np.maximum(largest, np.max(part, axis=0, where=known, initial=-np.inf))
        total += np.sum(part, axis=0, where=known)
        count += known.sum(axis=0)
    mean = total / np.maximum(count, 1)
    columns = (least, mean, largest, count)
    return [
        {
            "name": name,
            "cases": int(k),
            **dict(zip(_SHOWN, (float(v) if k else None for v in (a, b, c)), strict=True)),
        }
        for name, a, b, c, k in zip(names, *columns, strict=True)
    ]


_SHOWN = ("least_hz", "mean_hz", "largest_hz")


def failure_text(points: Points, index: int) -> str:
    """Say of one case why it failed, as the case itself would."""
    chunk = index // points.study.run.chunk
    row = index - points.bounds(chunk)[0]
    values = points.values(chunk)[row : row + 1]
    cases = Cases(points.study, points.variables, values)
    told = ", ".join(
        f"{v.name} {x:.6g}{'' if v.unit == '1' else ' ' + v.unit}"
        for v, x in list(zip(points.variables, values[0], strict=True))[:6]
    )
    try:
        cases.case(0).beam()
    except AntinodeError as error:
        return f"{told}: {error}"
    return told


def show_sweep(out: Console, data: dict[str, Any], stored: str) -> None:
    """Print the ranges of inputs and frequencies, and the failures."""
    solved = data["cases"] - data["failed"]
    out.print(
        f"[bold]{escape(data['name'])}[/bold]: {solved} of {counted(data['cases'], 'case')} solved"
        f"{escape(stored)}",
        highlight=False,
    )
    out.print(_inputs_table(data))
    if data["modes"]:
        out.print(_modes_table(data))
    if data["past_buckling"]:
        number = counted(data["past_buckling"], "case")
        out.print(f"{number} past buckling: the first mode has no frequency there", highlight=False)
    for failure in data["failures"]:
        text = (
            f"{counted(failure['cases'], 'case')} failed ({failure['code']}): {failure['reason']}"
        )
        out.print(Text(f"{text}; the first is case {failure['first_case']}, {failure['text']}"))


def _inputs_table(data: dict[str, Any]) -> Table:
    table = new_table("input", "unit", "from", "to", left=(0, 1))
    for v in data["inputs"]:
        unit = "" if v["unit"] == "1" else v["unit"]
        table.add_row(Text(v["name"]), unit, f"{v['least']:.6g}", f"{v['largest']:.6g}")
    return table


def _modes_table(data: dict[str, Any]) -> Table:
    table = new_table("mode", "cases", "least [Hz]", "mean [Hz]", "largest [Hz]")
    for m in data["modes"]:
        cells = ["" if m[key] is None else f"{m[key]:.6g}" for key in _SHOWN]
        table.add_row(m["name"], str(m["cases"]), *cells)
    return table
