"""The style and the palette of all figures, read from one style file of matplotlib."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from antinode.extras import import_extra

FILE = Path(__file__).with_name("antinode.mplstyle")
"""The style file: `matplotlib.pyplot.style.use(FILE)` gives it to figures of one's own."""

WIDTH = 7.1
"""Width of a figure [in], two columns of a journal."""


def _read(text: str) -> dict[str, str]:
    """Return the settings of a style file, whose values matplotlib itself will check."""
    lines = (line.partition("#")[0] for line in text.splitlines())
    pairs = (line.partition(":") for line in lines if line.strip())
    return {key.strip(): value.strip() for key, _, value in pairs}


STYLE: Any = _read(FILE.read_text(encoding="utf-8"))
"""Settings of matplotlib that all figures share."""

PALETTE = tuple(f"#{c}" for c in re.findall(r"'([0-9A-F]{6})'", STYLE["axes.prop_cycle"]))
"""Colours of curves, in their order."""

INK, GREY, LIGHT = (f"#{STYLE[key]}" for key in ("text.color", "axes.edgecolor", "grid.color"))
BODY, EDGE, WATER = "#C9CED6", "#4B5563", "#DCEBF7"
"""A body, its outline, and the cavity round it."""


_SCREEN = ContextVar("on_screen", default=False)


@contextmanager
def on_screen() -> Iterator[None]:
    """Draw where the caller draws: in a window, in a notebook; without it figures are for files."""
    token = _SCREEN.set(True)
    try:
        yield
    finally:
        _SCREEN.reset(token)


def pyplot() -> Any:
    """Return matplotlib.pyplot, drawing to files; raise InputError if it is not installed.

    A notebook, which names a backend of its own, keeps it.
    """
    matplotlib = import_extra("matplotlib", "plot")
    if not _SCREEN.get() and not os.environ.get("MPLBACKEND", "").startswith("module://"):
        matplotlib.use("Agg", force=False)
    import matplotlib.pyplot as plt

    return plt


@contextmanager
def styled() -> Iterator[Any]:
    """Give matplotlib.pyplot with the style of all figures."""
    plt = pyplot()
    with plt.rc_context(STYLE):
        yield plt


def zero_line(axes: Any) -> None:
    """Draw the line of zero, under the curves."""
    axes.axhline(0, color=GREY, linewidth=0.6, zorder=1)
