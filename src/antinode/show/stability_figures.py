"""Root loci, and maps of critical values over two inputs, as figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array

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
        growing = np.maximum(np.nan_to_num(loci.growth_per_s), 0.0)
        for k in np.flatnonzero(np.any(growing > 0, axis=0)).tolist():
            below.plot(loci.factor, growing[:, k], color=PALETTE[k % len(PALETTE)], zorder=3)
            below.fill_between(loci.factor, growing[:, k], color=_FLUTTER, alpha=0.08, linewidth=0)
        for axes in (above, below):
            _mark(axes, loci, named=axes is above)
        above.set(ylabel="frequency [Hz]", ylim=(0, 1.18 * _highest(loci)))
        below.set(ylabel="growth [1/s]", xlabel=loci.label)
        below.set_ylim(bottom=0, top=1.1 * max(float(np.max(growing)), 1e-9))
        below.set_xlim(float(loci.factor[0]), float(loci.factor[-1]))
        return figure


def _highest(loci: Loci) -> float:
    """Return a frequency that shows the modes that lose stability, and one or two above."""
    shown = min(3, loci.frequency_hz.shape[1])
    return float(np.nanmax(loci.frequency_hz[:, :shown])) or 1.0


def _mark(axes: Axes, loci: Loci, named: bool) -> None:
    """Draw critical loads as lines, each named along its own."""
    low, high = float(loci.factor[0]), float(loci.factor[-1])
    for each in loci.marks:
        colour = _FLUTTER if each.kind == "flutter" else _DIVERGENCE
        axes.axvline(each.value, color=colour, linewidth=0.9, linestyle=(0, (4, 3)), zorder=2)
        if not named:
            continue
        kind = each.kind if each.change == "lost" else f"{each.kind} {each.change}"
        first = each.value < low + 0.03 * (high - low)
        axes.annotate(
            f"{each.value:.5g}: {kind}, {' + '.join(each.modes)}",
            (each.value, 1.0),
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


def plot_map(
    x: Array, boundaries: dict[str, Array], labels: tuple[str, str], top: tuple[float, float]
) -> Figure:
    """Draw where stability is lost over a second input, and shade what lies beyond.

    Parameters
    ----------
    x : array, shape (rows,)
        Of the second input.
    boundaries : dict
        Critical values of the first by kind, NaN where there is none.
    labels : tuple of str
        Of both axes.
    top : tuple of float
        Range of the first input; where it is not finite it follows from the values.
    """
    with styled() as plt:
        figure: Figure
        figure, axes = plt.subplots(figsize=(WIDTH, 0.6 * WIDTH), layout="constrained")
        low, high = top
        known = np.concatenate(list(boundaries.values()))
        if not np.isfinite(high):
            high = 1.2 * float(np.max(known, initial=0.0, where=np.isfinite(known))) or 1.0
        lowest = np.nanmin([np.nan_to_num(v, nan=np.inf) for v in boundaries.values()], axis=0)
        first = np.minimum(lowest, high)
        axes.fill_between(x, first, high, color=_FLUTTER, alpha=0.06, linewidth=0)
        for kind, values in boundaries.items():
            if np.any(np.isfinite(values)):
                colour = _FLUTTER if kind == "flutter" else _DIVERGENCE
                axes.plot(x, values, "o-", markersize=3, color=colour, label=kind, zorder=3)
        if np.any(np.isfinite(known)):
            axes.legend()
        else:
            axes.annotate("stable", (0.5, 0.5), xycoords="axes fraction", ha="center")
        axes.set(xlabel=labels[0], ylabel=labels[1], ylim=(low, high))
        axes.set_xlim(float(x[0]), float(x[-1]))
        return figure
