"""The differences between the paper's tables and antinode's frequencies, row by row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.show.style import GREY, zero_line

from .comparison import Comparison
from .plates import COLOURS, letter, sheet
from .scene import Scene
from .tables import MODES, TABLES, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = "os^DvP"
_HEADS = ("σ", "V [m/s]", "α [deg]", "$x_{fin}$ [m]", "V [m/s]")


def differences(scene: Scene) -> tuple[Figure, str]:
    """Draw the relative differences of all thirty rows."""
    comparison = scene.comparison
    counts = [len(comparison.table(table.number)) for table in TABLES]
    figure, panels = sheet(2.9, 1, len(TABLES), sharey=True, width_ratios=[n + 0.6 for n in counts])
    for table, head, axes in zip(TABLES, _HEADS, panels, strict=True):
        _panel(axes, comparison, table)
        letter(axes, f"Table {table.number}", "abcde"[table.number - 1])
        axes.set_xlabel(head)
    panels[0].set_ylabel("antinode less paper [%]")
    panels[-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    figure.align_xlabels()
    size, bounds = comparison.overall, comparison.bounds
    return figure, (
        "Relative differences of the 180 natural frequencies of Tables 1 to 5, the roots of eq. "
        "80. Shaded: rows that were held out of the fit. "
        f"Worst {size.worst:.2g}, rms {size.rms:.2g}; dashed: the bound "
        f"{bounds.worst:.2g} that the reconstructed vehicle is held to."
    )


def _panel(axes: Axes, comparison: Comparison, table: Table) -> None:
    lines = comparison.table(table.number)
    place = np.arange(len(lines))
    for k in place[[line.row.held_out for line in lines]]:
        axes.axvspan(k - 0.5, k + 0.5, color="#F3E8D2", linewidth=0, zorder=0)
    for mode in range(MODES):
        values = [100 * line.differences[mode] for line in lines]
        spread = place + 0.11 * (mode - (MODES - 1) / 2)
        axes.plot(
            spread, values, _MARKERS[mode], color=COLOURS[mode], markersize=3.5,
            label=f"bending {mode + 1}",
        )  # fmt: skip
    for sign in (-1, 1):
        bound = 100 * sign * comparison.bounds.worst
        axes.axhline(bound, color=GREY, linewidth=0.8, linestyle="--")
    zero_line(axes)
    axes.set_xticks(place, [table.value(line.row) for line in lines], rotation=90)
    axes.set_xlim(-0.6, len(lines) - 0.4)
    axes.grid(visible=False, axis="x")
