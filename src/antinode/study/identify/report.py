"""An identification on the terminal: tables and words (rich)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import groupby

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from antinode.beam.families import BENDING
from antinode.show.printing import new_table, show_left_out, show_warnings

from .result import Estimate, Identification
from .words import brief, correlations_text, directions_text


def show_identification(out: Console, result: Identification) -> None:
    """Print what was found: fit, parameters, what is open, warnings."""
    out.print(_summary(result), highlight=False)
    out.print(_rows_table(result))
    out.print(
        "above: (fitted - observed) / observed in thousandths, by number of the mode\n",
        highlight=False,
    )
    out.print(_parameter_table(result.parameters))
    for line in (*directions_text(result.estimates), *correlations_text(result.estimates)):
        out.print(escape(line), highlight=False)
    show_warnings(out, result.warnings)
    show_left_out(out, result.not_modelled)


def _summary(result: Identification) -> str:
    e = result.estimates
    noise = "" if e.known_noise else f"; estimated noise {e.noise * 1e-3:.2g} of a frequency"
    best = min(result.starts, key=lambda s: s.cost, default=None)
    ended = f"; {best.reason}" if best else ""
    starts = f", {len(result.starts)} starts" if len(result.starts) > 1 else ""
    return (
        f"[bold]{len(result.comparisons)} frequencies in {len(result.problem.observations)} rows"
        f"[/bold], {len(e.vector)} parameters: rms difference {result.rms_relative:.2e}, worst "
        f"{result.worst_relative:.2e}{noise} ({result.evaluations} evaluations{starts}{ended})"
    )


def _rows_table(result: Identification) -> Table:
    """Return a table with a line for every row and family: relative differences by mode."""
    most = max(c.number for c in result.comparisons)
    shown = min(most, 8)
    table = new_table("row", "observed [Hz]", *(f"{k}" for k in range(1, shown + 1)), "worst")
    for (_, family), group in groupby(result.comparisons, key=lambda c: (c.row, c.family)):
        entries = list(group)
        label = entries[0].label + ("" if family == BENDING else f" ({family})")
        by_number = {c.number: c for c in entries}
        cells = [
            f"{1e3 * by_number[k].relative:+.3f}" if k in by_number else ""
            for k in range(1, shown + 1)
        ]
        first = f"{entries[0].observed_hz:.5g} ..."
        worst = max((c.relative for c in entries), key=abs)
        table.add_row(Text(f"{label}"), first, *cells, f"{1e3 * worst:+.3f}")
    return table


def _parameter_table(parameters: Iterable[Estimate]) -> Table:
    table = new_table("parameter", "unit", "value", "+-", "95 % from", "to", "by data", left=(0, 1))
    for p in parameters:
        low, high = p.interval
        sd = "at bound" if p.at_bound else "open" if math.isinf(p.sd) else brief(p.sd)
        cells = (p.name, p.unit, f"{p.value:.6g}", sd, _number(low), _number(high))
        table.add_row(*(Text(cell) for cell in cells), f"{p.determined:.0%}")
    return table


def _number(value: float) -> str:
    return f"{value:.5g}" if math.isfinite(value) else ""
