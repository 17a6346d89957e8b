"""Answers on the terminal."""

from __future__ import annotations

from typing import Any

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.text import Text

from antinode.show.printing import new_table
from antinode.text import counted


def show_answers(out: Console, data: dict[str, Any]) -> None:
    """Print shares, quantiles, worst cases and what was searched for."""
    where = ""
    if asked := data["asked"]:
        where = f", where {asked['condition']}: {counted(asked['holds'], 'case')}{_unknown(asked)}"
    out.print(
        f"[bold]{escape(data['name'])}[/bold]: {counted(data['cases'], 'case')}{escape(where)}",
        highlight=False,
    )
    for share in data["shares"]:
        _show_share(out, share)
    if data["quantiles"]:
        _show_quantiles(out, data["quantiles"])
    for worst in data["worst"]:
        _show_worst(out, worst)
    for found in data["searches"]:
        _show_search(out, found)


def _show_share(out: Console, share: dict[str, Any]) -> None:
    told = "in no case known"
    if share["counted"]:
        told = f"{share['share']:.4g} of the cases ({share['holds']} of {share['counted']})"
    out.print(Text(f"{share['condition']}: {told}{_unknown(share)}"))


def _unknown(found: dict[str, Any]) -> str:
    return f"; not known in {counted(found['unknown'], 'case')}" if found["unknown"] else ""


def _show_quantiles(out: Console, every: list[dict[str, Any]]) -> None:
    table = new_table("below", *(f"{q['of']}{_unit(q['unit'])}" for q in every))
    for k, share in enumerate(every[0]["shares"]):
        table.add_row(f"{100 * share:g} %", *(_number(q["values"][k]) for q in every))
    table.add_row("cases", *(str(q["counted"]) for q in every))
    out.print(table)


def _show_worst(out: Console, worst: dict[str, Any]) -> None:
    how = "largest" if worst["largest"] else "smallest"
    out.print(Text(f"{how} {worst['of']}{_unknown(worst)}"))
    if not worst["cases"]:
        return
    names = [f"{name}{_unit(worst['units'][name])}" for name in worst["inputs"][0]]
    table = new_table("case", f"{worst['of']}{_unit(worst['unit'])}", *names)
    for case, value, inputs in zip(worst["cases"], worst["values"], worst["inputs"], strict=True):
        table.add_row(str(case), _number(value), *map(_number, inputs.values()))
    out.print(table)


def _show_search(out: Console, found: dict[str, Any]) -> None:
    how = "largest" if found["largest"] else "smallest"
    inputs = ", ".join(
        f"{name} = {_number(v)}{_behind(found['units'][name])}"
        for name, v in found["inputs"].items()
    )
    text = (
        f"{how} {found['of']} found inside the bounds: {_number(found['value'])}"
        f"{_behind(found['unit'])} at {inputs} (the design's: {_number(found['design'])}; "
        f"{found['evaluations']} cases solved; the worst that was seen, no proof that there is "
        "none worse)"
    )
    if found["at_bounds"]:
        text += f"; at the end of the range: {', '.join(found['at_bounds'])}"
    out.print(Text(text))


def _unit(unit: str) -> str:
    return "" if unit in ("", "1") else f" [{unit}]"


def _behind(unit: str) -> str:
    return "" if unit in ("", "1") else f" {unit}"


def _number(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.6g}"
