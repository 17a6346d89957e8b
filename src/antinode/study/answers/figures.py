"""A number over two inputs, as a map: means of the cases that fall into each cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arrays import Array
from antinode.show.figures import STYLE, pyplot

from .answers import Answers

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CELLS, _FEWEST = 40, 6  # along an axis: at most; cases in a cell, on average
_VALUES = 200  # of a grid, along an axis


def plot_map(answers: Answers, x: str, y: str, of: str) -> Figure:
    """Draw a number over two inputs; where others vary, each cell has the mean over them.

    Parameters
    ----------
    answers : Answers
    x, y, of : str
        Formulas: the axes, and what is shown.
    """
    plt, every = pyplot(), _together(answers, (x, y, of))
    edges = [_edges(values) for values in every[:2]]
    histogram: Any = np.histogram2d
    count, total = (histogram(*every[:2], bins=edges, weights=w)[0] for w in (None, every[2]))
    with np.errstate(invalid="ignore"):
        mean = total / count
    with plt.rc_context(STYLE):
        figure: Figure
        figure, axes = plt.subplots(figsize=(7.0, 5.0), layout="constrained")
        shown = axes.pcolormesh(*edges, mean.T, cmap="viridis", shading="flat")
        _contours(axes, edges, mean)
        figure.colorbar(shown, ax=axes, label=_label(answers, of))
        axes.set_xlabel(_label(answers, x))
        axes.set_ylabel(_label(answers, y))
        most = int(count.max()) if count.size else 0
        over = "" if most <= 1 else f"; each cell is the mean of up to {most} cases"
        axes.set_title(f"{of} over {x} and {y}{over}", loc="left")
    return figure


def _contours(axes: Any, edges: list[Array], mean: Array) -> None:
    """Draw lines of equal values where all cells have one."""
    if np.isfinite(mean).all() and min(mean.shape) > 1 and np.ptp(mean) > 0:
        middles = [(e[1:] + e[:-1]) / 2 for e in edges]
        lines = axes.contour(*middles, mean.T, colors="white", linewidths=0.8)
        axes.clabel(lines, fontsize=8)


def _together(answers: Answers, texts: tuple[str, ...]) -> list[Array]:
    """Return several numbers in the cases that have all of them."""
    found = [answers.values(text) for text in texts]
    cases = found[0][0]
    for at, _ in found[1:]:
        cases = np.intersect1d(cases, at, assume_unique=True)
    return [values[np.searchsorted(at, cases)] for at, values in found]


def _edges(values: Array) -> Array:
    """Return bounds of cells: around each value of a grid, else even ones."""
    own = np.unique(values)
    if len(own) == 1:
        return np.array([own[0] - 0.5, own[0] + 0.5])
    if len(own) <= min(_VALUES, len(values) - 1):
        middle = (own[1:] + own[:-1]) / 2
        return np.concatenate([[2 * own[0] - middle[0]], middle, [2 * own[-1] - middle[-1]]])
    number = int(np.clip(np.sqrt(len(values) / _FEWEST), 4, _CELLS))
    return np.linspace(own[0], own[-1], number + 1)


def _label(answers: Answers, text: str) -> str:
    unit = answers.number(text).unit
    return text if unit in ("", "1") else f"{text} [{unit}]"
