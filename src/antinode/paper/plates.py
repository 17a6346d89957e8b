"""Figures with captions, of one style, written as SVG, PDF and PNG (matplotlib)."""

from __future__ import annotations

import io
import re
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.show.style import PALETTE, WIDTH, pyplot, styled
from antinode.show.svg import for_page

from .scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_CAPTION_SIZE, _CAPTION_COLUMNS = 7.5, 128
_LINE = _CAPTION_SIZE * 1.4 / 72  # inches
_SYMBOL = re.compile(r"\b([^\W\d_])_(\w+)\b")
COLOURS = PALETTE[:6]


@dataclass(frozen=True)
class Plate:
    """A figure of the paper: how it is named, and what draws it.

    Attributes
    ----------
    name : str
        File name without its ending.
    heading : str
        ``"Figure 7"``.
    draw : callable
        Takes a scene and returns the figure and its caption.
    """

    name: str
    heading: str
    draw: Callable[[Scene], tuple[Figure, str]]


def sheet(height: float, rows: int = 1, columns: int = 1, **options: Any) -> tuple[Any, Any]:
    """Return a figure of the full width and so many inches of height, and its axes."""
    figure, axes = pyplot().subplots(
        rows, columns, figsize=(WIDTH, height), layout="constrained", **options
    )
    return figure, axes


def letter(axes: Axes, text: str, mark: str) -> None:
    """Put the letter of a panel and what it shows over its left corner."""
    axes.set_title(f"({mark})  {text}")


def shades(number: int) -> list[Any]:
    """Return colours for an ordered quantity, dark to light, told apart by colour-blind eyes."""
    import matplotlib as mpl

    ramp = mpl.colormaps["viridis"]
    return [ramp(0.88 * k / max(number - 1, 1)) for k in range(number)]


def publish(plate: Plate, scene: Scene, folder: Path) -> tuple[str, str]:
    """Write a plate as SVG, PDF and PNG, its caption below it.

    Returns
    -------
    str
        The drawing as SVG without the caption, for a page.
    str
        The caption.
    """
    with styled() as plt:
        plt.rcParams["svg.hashsalt"] = plate.name
        figure, caption = plate.draw(scene)
        text = f"{plate.heading} (reconstruction). {caption}"
        strip = _add_caption(figure, text)
        about = {"Title": f"{plate.heading} (reconstruction)"}
        buffer = io.StringIO()
        words = {**about, "Description": text, "Date": None, "Creator": None}
        figure.savefig(buffer, format="svg", metadata=words)
        folder.joinpath(f"{plate.name}.svg").write_text(buffer.getvalue(), encoding="utf-8")
        dates = {"CreationDate": None, "ModDate": None}
        figure.savefig(folder / f"{plate.name}.pdf", metadata={**about, "Subject": text, **dates})
        figure.savefig(folder / f"{plate.name}.png", metadata={**about, "Description": text})
        plt.close(figure)
    return _without_caption(buffer.getvalue(), strip, plate.name), caption


def _add_caption(figure: Figure, text: str) -> float:
    """Write the caption into a strip below the figure; return its height [in]."""
    lines = textwrap.wrap(text, _CAPTION_COLUMNS)
    strip = len(lines) * _LINE + 0.16
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + strip)
    bottom = strip / (height + strip)
    engine: Any = figure.get_layout_engine()
    engine.set(rect=(0, bottom, 1, 1 - bottom))
    figure.text(
        0.012,
        bottom - 0.05 / (height + strip),
        "\n".join(_SYMBOL.sub(r"$\1_{\\mathrm{\2}}$", line) for line in lines),
        fontsize=_CAPTION_SIZE,
        linespacing=1.4,
        va="top",
        gid="caption",
    )
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return strip


def _without_caption(svg: str, strip: float, name: str) -> str:
    """Return a drawing for a page, its strip cut off."""
    svg = re.sub(r'<g id="caption">.*?</g>\s*(?=</g>\s*<defs>|</g>\s*</svg>)', "", svg, flags=re.S)
    return for_page(svg, name, cut=72 * strip)
