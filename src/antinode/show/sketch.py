"""A beam as a sketch: its ends, and what is attached to it, each kind with a mark of its own."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.beam.attachments import Attachment, Spring, name_of

from .style import BODY, EDGE, GREY, INK, PALETTE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from antinode.beam.beam import Beam

_MARKS: dict[str, dict[str, Any]] = {
    "point mass": {"marker": "o", "y": 0.0, "color": PALETTE[1], "ms": 7, "label": "point mass"},
    "spring": {"marker": "", "y": -0.7, "color": PALETTE[2], "ms": 13, "label": "spring"},
    "pedestal": {"marker": "s", "y": -0.7, "color": PALETTE[1], "ms": 7, "label": "pedestal"},
    "support": {"marker": "^", "y": -0.75, "color": INK, "ms": 7, "label": "support"},
    "joint": {"marker": "D", "y": 0.0, "color": PALETTE[3], "ms": 5, "label": "joint"},
    "dashpot": {"marker": "$\\sqcup$", "y": -0.6, "color": PALETTE[2], "ms": 9, "label": "dashpot"},
    "point feedback": {
        "marker": "$\\circlearrowleft$",
        "y": 0.5,
        "color": PALETTE[3],
        "ms": 9,
        "label": "feedback",
    },
}
_ENDS = {"pinned": ("^", -0.75), "sliding": ("s", 0.0)}
_MOST_LINES = 12  # lines through the panels, beyond which they would be a grid
_THIN, _THICK = 0.14, 0.5  # half-height of the sketch, by the bending stiffness


def draw_beam(beam: Beam, axes: Axes) -> None:
    """Draw the beam, thicker where it is stiffer, with its ends and what is attached to it."""
    x = np.repeat(beam.x, 2)[1:-1]
    half = thickness(beam)
    axes.fill_between(x, -half, half, color=BODY, edgecolor=EDGE, linewidth=0.7, zorder=2)
    reach = 0.02 * beam.length
    for side, sign, x_end in ((beam.ends.left, -1, beam.x[0]), (beam.ends.right, 1, beam.x[-1])):
        _draw_end(axes, side, float(x_end), sign * reach)
    for kind in _MARKS:
        _draw_kind(axes, kind, [item for item in beam.attachments if name_of(item) == kind])
    axes.set(title=_title(beam), ylim=(-1.15, 0.9), yticks=[])
    axes.spines["left"].set_visible(False)
    axes.grid(visible=False)
    if beam.attachments:
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def thickness(beam: Beam) -> np.ndarray:
    """Return half the height of the sketch at both ends of every interval."""
    size = np.log(beam.bending_stiffness[:, [0, -1]].ravel())
    low, high = float(size.min()), float(size.max())
    share = (size - low) / (high - low) if high - low > 1e-9 else np.full(len(size), 0.5)
    return np.asarray(_THIN + (_THICK - _THIN) * share)


def _title(beam: Beam) -> str:
    return f"Beam, {beam.ends.left} - {beam.ends.right} (thickness by EI, not to scale)"


def _draw_end(axes: Axes, end: str, x: float, outwards: float) -> None:
    """Draw a wall, a pin or a slide; nothing at a free end."""
    if end == "clamped":
        sides = sorted((x, x + outwards))
        axes.fill_between(sides, -0.9, 0.8, color="white", hatch="////", edgecolor=EDGE, lw=0)
        axes.plot([x, x], [-0.9, 0.8], color=EDGE, linewidth=1.5, zorder=3)
    elif end in _ENDS:
        marker, y = _ENDS[end]
        axes.plot([x], [y], marker, color=EDGE, markersize=7, clip_on=False, zorder=4)


def _draw_kind(axes: Axes, kind: str, items: list[Attachment]) -> None:
    if not items:
        return
    mark = _MARKS[kind]
    axes.plot(
        [item.x for item in items],
        [mark["y"]] * len(items),
        linestyle="none",
        marker=mark["marker"] or _coil(),
        fillstyle="none" if kind == "spring" else "full",
        color=mark["color"],
        markersize=mark["ms"],
        markeredgecolor="white" if kind in ("point mass", "joint") else mark["color"],
        label=mark["label"],
        clip_on=False,
        zorder=5,
    )


def _coil() -> Any:
    """Return the mark of a spring."""
    from matplotlib.path import Path

    return Path([(0, 5), (0, 4), (2, 3), (-2, 1), (2, -1), (-2, -3), (0, -4), (0, -5)])


def mark_stations(beam: Beam, axes: Axes) -> None:
    """Draw a thin line in a panel where something is attached, unless there are many."""
    places = {item.x: item for item in beam.attachments}
    if len(places) <= _MOST_LINES:
        for x, item in places.items():
            held = isinstance(item, Spring) and math.inf in (item.translational, item.rotational)
            style = "-" if held else (0, (4, 3))
            axes.axvline(x, color=GREY, linewidth=0.6, linestyle=style, alpha=0.7, zorder=0.5)
