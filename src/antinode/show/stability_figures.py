"""Root loci: frequency and growth of the lowest modes against a factor on the axial forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import INK, PALETTE, WIDTH, styled, zero_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from antinode.stability.loci import Loci

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
