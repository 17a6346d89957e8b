"""What the ends do, as a picture: a bent body with its end forces, for every choice of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .style import BODY, GREY, INK, PALETTE, WIDTH, pyplot, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from antinode.arrays import Array
    from antinode.vehicle.end_forces import Choice

_BOW = 0.12  # of the drawn shape, in lengths
_ARROW = 0.2


@styled()
def plot_end_forces(x: Array, shape: Array, choices: Sequence[Choice]) -> Figure:
    """Draw the first bending mode with thrust and drag, a panel for each choice of the end forces.

    Parameters
    ----------
    x, shape : array, shape (points,)
        Place from the nose and displacement of the mode, to any scale.
    choices : sequence of Choice
        From `antinode.vehicle.end_forces`.
    """
    plt = pyplot()
    figure: Figure = plt.figure(figsize=(WIDTH, 0.22 * WIDTH), layout="constrained")
    panels = figure.subplots(1, len(choices), squeeze=False)
    place = (x - x[0]) / (x[-1] - x[0])
    bow = _BOW * shape / np.max(np.abs(shape))
    for axes, choice in zip(panels[0], choices, strict=True):
        _draw(axes, place, bow, choice)
    return figure


def _draw(axes: Axes, x: Array, y: Array, choice: Choice) -> None:
    axes.plot(x, 0 * x, color=GREY, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.plot(x, y, color=BODY, linewidth=5, solid_capstyle="round")
    nose, tail = choice.follow
    slopes = (y[1] - y[0]) / (x[1] - x[0]), (y[-1] - y[-2]) / (x[-1] - x[-2])
    _push(axes, (0.0, float(y[0])), 1.0, nose * float(slopes[0]))
    _push(axes, (1.0, float(y[-1])), -1.0, tail * float(slopes[1]))
    axes.set_title(choice.name, fontsize="medium", color=INK)
    first = choice.frequencies_hz[0]
    text = f"bending 1: {first:.3f} Hz" if np.isfinite(first) else "not found"
    axes.text(0.5, -0.3, text, ha="center", color=INK)
    axes.set(xlim=(-0.3, 1.3), ylim=(-0.36, 0.3), aspect="equal")
    axes.axis("off")


def _push(axes: Axes, at: tuple[float, float], way: float, slope: float) -> None:
    """Draw a force that pushes an end along `way` (1: aft), turned by a slope."""
    length = np.hypot(1.0, slope)
    start = at[0] - way * _ARROW / length, at[1] - way * _ARROW * slope / length
    style = {"arrowstyle": "-|>", "color": PALETTE[1], "linewidth": 1.8, "shrinkB": 3}
    axes.annotate("", at, start, arrowprops=style)
