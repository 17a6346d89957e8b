"""Critical loads on the terminal, as CSV, and in a figure of root loci."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.text import Text

from antinode.modes.result import not_modelled
from antinode.text import counted

from .printing import fitting, new_table, show_left_out, show_warnings
from .style import INK, PALETTE, WIDTH, styled, zero_line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from rich.table import Table

    from antinode.beam.beam import Beam
    from antinode.stability.loci import Loci
    from antinode.stability.result import CriticalLoad, DampedLoss, Stability

_CHANGES = {
    "lost": "lost",
    "regained": "regained",
    "merged": "diverging modes begin to flutter",
}
_HEADINGS = "modes", "factor", "+-", "kind", "f [Hz]", "stability", "bracket by"
_KEPT = ((0, 1, 2, 3, 4, 5, 6), (0, 1, 2, 3, 4, 6), (0, 1, 3, 4, 6), (0, 1, 3, 6), (0, 1, 3))
"""Columns that a narrow terminal keeps."""
_PROOFS = {"counts": "counts", "winding": "winding number", "none": "not proven"}


def show_stability(out: Console, result: Stability, beam: Beam) -> None:
    """Print every change of stability, what lies between, warnings, and what is left out."""
    if result.critical:
        tables = (_critical_table(result.critical, kept) for kept in _KEPT)
        out.print(fitting(tables, out, wrapped=True))
    else:
        out.print("stable, whatever the factor" if result.range[1] == float("inf") else "stable")
    if result.damped is not None:
        out.print(Text(_with_dampers(result.damped)))
    out.print(f"[dim]{_between(result)}[/dim]", highlight=False)
    show_warnings(out, result.warnings)
    show_left_out(out, not_modelled(beam))


def _critical_table(critical: Sequence[CriticalLoad], kept: Sequence[int]) -> Table:
    headings = [_HEADINGS[k] for k in kept]
    table = new_table(*headings, left=[i for i, k in enumerate(kept) if k in (0, 3, 5, 6)])
    for each in critical:
        cells = _cells(each)
        table.add_row(*(Text(cells[k]) for k in kept))
    return table


def _cells(each: CriticalLoad) -> tuple[str, ...]:
    flutter = each.kind == "flutter"
    return (
        " with ".join(each.modes),
        f"{each.load_factor:.10g}",
        f"{each.error:.1e}",
        each.kind,
        f"{each.frequency_hz:.7g}" if flutter else "",
        _CHANGES[each.change],
        _PROOFS[each.certificate.kind],
    )


def _with_dampers(damped: DampedLoss) -> str:
    at = f" at {damped.frequency_hz:.7g} Hz" if damped.frequency_hz else ""
    proven = "" if damped.proven else ", not proven"
    return (
        f"With its dashpots and loss factors: {damped.mode}, {damped.kind}{at} from "
        f"{damped.load_factor:.8g}{proven}."
    )


def _between(result: Stability) -> str:
    """Return what was looked at, and why nothing is missing."""
    last, force = result.range[1], result.largest_force
    text = f"Factors on all axial forces (largest {force:.6g} N), 0 to {last:.7g}. "
    if result.complete == "counts":
        return text + "All forces keep their direction: counts prove that no change is missing."
    return text + (
        f"Between the brackets the modes were followed in {counted(result.steps, 'step')}: that "
        "none is missing there is not proven."
    )


def stability_csv(result: Stability) -> str:
    """Return the changes of stability as CSV with units in the header, one a row."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    names = "kind", "load_factor", "low", "high", "error", "frequency [Hz]", "modes", "change"
    writer.writerow([*names, "certificate"])
    for each in result.critical:
        numbers = each.load_factor, *each.bracket, each.error, each.frequency_hz
        told = " + ".join(each.modes), each.change, each.certificate.kind
        writer.writerow([each.kind, *(repr(float(v)) for v in numbers), *told])
    return out.getvalue()


# --- root loci ------------------------------------------------------------------------------------

_FLUTTER, _DIVERGENCE = "#B91C1C", "#B45309"


def plot_loci(loci: Loci) -> Figure:
    """Draw frequencies above, growth below; each critical load is a line across both."""
    with styled() as plt:
        figure: Figure
        figure, (above, below) = plt.subplots(
            2,
            1,
            figsize=(WIDTH, 0.72 * WIDTH),
            sharex=True,
            height_ratios=(3, 2),
            layout="constrained",
        )
        for k in range(loci.frequency_hz.shape[1]):
            colour = PALETTE[k % len(PALETTE)]
            above.plot(loci.factor, loci.frequency_hz[:, k], color=colour, zorder=3)
        zero_line(below)
        growing = np.maximum(loci.growth_per_s, 0.0)
        for k in np.flatnonzero(np.any(growing > 0, axis=0)).tolist():
            below.plot(loci.factor, growing[:, k], color=PALETTE[k % len(PALETTE)], zorder=3)
            below.fill_between(loci.factor, growing[:, k], color=_FLUTTER, alpha=0.08, linewidth=0)
        for axes in (above, below):
            _mark(axes, loci, named=axes is above)
        above.set(ylabel="frequency [Hz]", ylim=(0, 1.18 * _highest(loci)))
        below.set(ylabel="growth [1/s]", xlabel="factor on all axial forces")
        below.set_ylim(bottom=0, top=1.1 * max(float(np.max(growing)), 1e-9))
        below.set_xlim(0, float(loci.factor[-1]))
        return figure


def _highest(loci: Loci) -> float:
    """Return a frequency that shows the modes that lose stability, and one or two above."""
    shown = min(3, loci.frequency_hz.shape[1])
    return float(np.max(loci.frequency_hz[:, :shown])) or 1.0


def _mark(axes: Axes, loci: Loci, named: bool) -> None:
    """Draw critical loads as lines, each named along its own."""
    for each in loci.critical.critical:
        colour = _FLUTTER if each.kind == "flutter" else _DIVERGENCE
        axes.axvline(each.load_factor, color=colour, linewidth=0.9, linestyle=(0, (4, 3)), zorder=2)
        if not named:
            continue
        kind = each.kind if each.change == "lost" else f"{each.kind} {each.change}"
        first = each.load_factor < 0.03 * loci.factor[-1]
        axes.annotate(
            f"{each.load_factor:.5g}: {kind}, {' + '.join(each.modes)}",
            (each.load_factor, 1.0),
            (3 if first else -3, -4),
            xycoords=axes.get_xaxis_transform(),
            textcoords="offset points",
            rotation=90,
            ha="left" if first else "right",
            va="top",
            fontsize="small",
            color=INK,
            zorder=4,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5},
        )
