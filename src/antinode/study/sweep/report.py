"""A sweep on the terminal: ranges of frequencies, failures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from antinode.arrays import Array, Integers
from antinode.errors import AntinodeError
from antinode.modes.warnings import shear_buckles
from antinode.show.printing import fitting, new_table, percent, show_left_out, show_warnings
from antinode.study.cases.reasons import PAST_BUCKLING, WHY, failed
from antinode.study.cases.values import Cases
from antinode.study.design.points import Points
from antinode.text import counted

if TYPE_CHECKING:
    import xarray

_BLOCK = 100_000


def summary(points: Points, dataset: xarray.Dataset) -> dict[str, Any]:
    """Return what a sweep has found as plain values: ranges by mode, failures, warnings."""
    codes = _codes(dataset)
    modes = [] if "frequency_hz" not in dataset else _ranges(dataset)
    return {
        "schema_version": 1,
        "name": points.study.name or points.study.subject.name,
        "cases": points.cases,
        "failed": sum(number for code, (number, _) in codes.items() if _fails(code)),
        "past_buckling": codes.get(PAST_BUCKLING, (0, 0))[0],
        "failures": [
            {
                "code": code,
                "reason": WHY[code],
                "cases": number,
                "first_case": first,
                "text": failure_text(points, first),
            }
            for code, (number, first) in sorted(codes.items())
            if _fails(code)
        ],
        "inputs": [
            {"name": v.name, "key": v.key, "unit": v.unit, **_range(dataset[v.name])}
            for v in points.variables
        ],
        "modes": modes,
        "responses": _response_ranges(points, dataset),
        "not_modelled": list(dataset.attrs.get("not_modelled", ())),
        "warnings": list(dataset.attrs["warnings"]),
    }


def _fails(code: int) -> bool:
    return bool(failed(np.array(code)))


def _blocks(values: xarray.DataArray) -> Iterator[tuple[int, Any]]:
    """Yield an output a block of cases at a time, with the first case of each."""
    for start in range(0, values.sizes["case"], _BLOCK):
        yield start, np.asarray(values[start : start + _BLOCK])


def _codes(dataset: xarray.Dataset) -> dict[int, tuple[int, int]]:
    """Return how many cases have each reason, and the first of them."""
    found: dict[int, tuple[int, int]] = {}
    for start, reason in _blocks(dataset["reason"]):
        for code, at, number in zip(
            *(v.tolist() for v in np.unique(reason, return_index=True, return_counts=True)),
            strict=True,
        ):
            before, first = found.get(code, (0, start + at))
            found[code] = before + number, first
    return found


def _range(values: xarray.DataArray) -> dict[str, float]:
    ends = np.array([(part.min(), part.max()) for _, part in _blocks(values)])
    return {"least": float(ends[:, 0].min()), "largest": float(ends[:, 1].max())}


def _ranges(dataset: xarray.Dataset) -> list[dict[str, Any]]:
    """Return what is known of every mode: its frequencies, and how far they may be off."""
    names = [str(name) for name in dataset["mode"].values]
    outputs = "frequency_hz", "error_hz", "model_error", "effect_of_shear"
    hz, error, *effects = (_extent(dataset, name) for name in outputs)
    estimated, solved = (
        [_null(_farther(*ends)) for ends in zip(effect.least, effect.largest, strict=True)]
        for effect in effects
    )
    return [
        {
            "name": name,
            "cases": int(hz.number[k]),
            "least_hz": _null(hz.least[k]),
            "mean_hz": _null(hz.mean[k]),
            "largest_hz": _null(hz.largest[k]),
            "largest_error_hz": _null(error.largest[k]),
            "largest_model_error": estimated[k],
            "largest_effect_of_shear": solved[k],
        }
        for k, name in enumerate(names)
    ]


def _response_ranges(points: Points, dataset: xarray.Dataset) -> list[dict[str, Any]]:
    """Return what is known of every number of the responses: its range, and how wrong it may be."""
    found = []
    for one in points.study.asked:
        values, error = (
            np.concatenate([part for _, part in _blocks(dataset[name])])
            for name in (one.name, f"{one.name}_error")
        )
        known = values[np.isfinite(values)]
        ends = (known.min(), known.mean(), known.max()) if len(known) else (np.nan,) * 3
        found.append(
            {
                "name": one.name,
                "label": one.label,
                "unit": one.unit,
                "cases": len(known),
                **{k: _null(v) for k, v in zip(("least", "mean", "largest"), ends, strict=True)},
                "largest_error": _null(np.max(error[np.isfinite(error)], initial=-np.inf)),
            }
        )
    return found


class _Extent(NamedTuple):
    """Of an output that has one number a mode; infinite or NaN where there is none, (modes,)."""

    least: Array
    mean: Array
    largest: Array
    number: Integers


def _extent(dataset: xarray.Dataset, output: str) -> _Extent:
    """Look through the cases, a block at a time."""
    modes = dataset.sizes["mode"]
    least, largest = np.full(modes, np.inf), np.full(modes, -np.inf)
    total, count = np.zeros(modes), np.zeros(modes, dtype=np.int64)
    for _, part in _blocks(dataset[output]) if output in dataset else ():
        known = np.isfinite(part)
        least = np.minimum(least, np.min(part, axis=0, where=known, initial=np.inf))
        largest = np.maximum(largest, np.max(part, axis=0, where=known, initial=-np.inf))
        total += np.sum(part, axis=0, where=known)
        count += known.sum(axis=0)
    with np.errstate(invalid="ignore"):
        return _Extent(least, total / count, largest, count)


def _farther(low: float, high: float) -> float:
    """Return the bound that is farther from zero."""
    return low if abs(low) > abs(high) else high


def _null(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def failure_text(points: Points, index: int) -> str:
    """Say of one case why it failed, as the case itself would."""
    chunk = index // points.study.run_table.chunk
    row = index - points.bounds(chunk)[0]
    values = points.values(chunk)[row : row + 1]
    cases = Cases(points.study, points.variables, values)
    told = ", ".join(
        f"{v.name} {x:.6g}{'' if v.unit == '1' else ' ' + v.unit}"
        for v, x in list(zip(points.variables, values[0], strict=True))[:6]
    )
    try:
        cases.problem(0).beam()
    except AntinodeError as error:
        return f"{told}: {error}"
    return told


def show_sweep(out: Console, data: dict[str, Any], stored: str) -> None:
    """Print the ranges of inputs and frequencies, failures and warnings."""
    solved = data["cases"] - data["failed"]
    out.print(
        f"[bold]{escape(data['name'])}[/bold]: {solved} of {counted(data['cases'], 'case')} solved"
        f"{escape(stored)}",
        highlight=False,
    )
    out.print(_inputs_table(data))
    if data["modes"]:
        out.print(fitting((_modes_table(data, kept) for kept in _KEPT), out))
    if data["responses"]:
        out.print(fitting((_responses_table(data, kept) for kept in _NUMBERS_KEPT), out))
    if data["past_buckling"]:
        number = counted(data["past_buckling"], "case")
        out.print(f"{number} past buckling: the first mode has no frequency there", highlight=False)
    for failure in data["failures"]:
        text = (
            f"{counted(failure['cases'], 'case')} failed ({failure['code']}): {failure['reason']}"
        )
        out.print(Text(f"{text}; the first is case {failure['first_case']}, {failure['text']}"))
    show_warnings(out, warning_texts(data["warnings"], data["cases"]))
    show_left_out(out, data["not_modelled"])


def _inputs_table(data: dict[str, Any]) -> Table:
    table = new_table("input", "unit", "from", "to", left=(0, 1))
    for v in data["inputs"]:
        unit = "" if v["unit"] == "1" else v["unit"]
        table.add_row(Text(v["name"]), unit, f"{v['least']:.6g}", f"{v['largest']:.6g}")
    return table


_HEADINGS = ("mode", "cases", "least [Hz]", "mean [Hz]", "largest [Hz]", "+- [Hz]", "by shear")
_KEPT = (range(7), (0, 1, 2, 4, 5, 6), (0, 2, 4, 6))
"""Columns that narrower terminals keep."""


def _modes_table(data: dict[str, Any], kept: Sequence[int]) -> Table:
    table = new_table(*(_HEADINGS[k] for k in kept))
    for m in data["modes"]:
        shown = ["" if m[key] is None else f"{m[key]:.6g}" for key in _RANGE]
        error = m["largest_error_hz"]
        shear = by_shear(m["largest_model_error"], m["largest_effect_of_shear"])
        shown += ["" if error is None else f"{error:.1e}", shear]
        cells = (m["name"], str(m["cases"]), *shown)
        table.add_row(*(cells[k] for k in kept))
    return table


_NUMBERS = ("response", "cases", "least", "mean", "largest", "unit", "+-")
_NUMBERS_KEPT = (range(7), (0, 2, 4, 5, 6), (0, 2, 4, 5))


def _responses_table(data: dict[str, Any], kept: Sequence[int]) -> Table:
    left = tuple(k for k, column in enumerate(kept) if column in (0, 5))
    table = new_table(*(_NUMBERS[k] for k in kept), left=left)
    for one in data["responses"]:
        least, mean, largest = (
            "" if one[key] is None else f"{one[key]:.5g}" for key in ("least", "mean", "largest")
        )
        error = "" if one["largest_error"] is None else f"{one['largest_error']:.1e}"
        cells = (one["label"], str(one["cases"]), least, mean, largest, one["unit"], error)
        table.add_row(*(Text(cells[k]) for k in kept))
    return table


def by_shear(estimated: float | None, solved: float | None) -> str:
    """Write the largest effect of shear on a mode, solved or else estimated.

    An estimate that leaves nothing of a frequency is no number.
    """
    if solved is not None and np.isfinite(solved):
        return percent(solved)
    if estimated is None or not np.isfinite(estimated):
        return ""
    return "past buckling" if shear_buckles(estimated) else percent(estimated)


_RANGE = ("least_hz", "mean_hz", "largest_hz")


def warning_texts(warnings: Iterable[dict[str, Any]], cases: int) -> list[str]:
    """Return counted warnings as sentences."""
    return [f"{w['message']} ({_concerned(w, cases)})" for w in warnings]


def _concerned(warning: dict[str, Any], cases: int) -> str:
    if warning["count"] == cases:
        return "every case"
    return f"{warning['count']} of {cases} cases, first case {warning['first_case']}"
