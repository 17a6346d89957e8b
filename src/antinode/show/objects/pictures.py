"""Small pictures of beams, vehicles and results in SVG, for notebooks: light or dark.

Lines and bodies take the colour of the text around them, so that a picture suits any page; curves
have colours that stand out from white and from black. No library draws them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from antinode.beam.attachments import name_of
from antinode.beam.families import FAMILIES
from antinode.show.sketch import thickness

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads

WIDTH = 460.0
COLOURS = ("#2f86d6", "#d9730d", "#1a9e77", "#c2569b")
"""Of curves."""
_SIDE = 14.0
_MARKS = {"point mass": 1, "joint": 3, "spring": 2, "support": 0, "dashpot": 2, "pedestal": 1}


class Picture:
    """An SVG drawing with one scale along x, and parts drawn one over the other.

    Parameters
    ----------
    x : tuple of float
        What lies at the left and right edges.
    height : float
        Of the picture [px].
    title : str
        What a screen reader says of it.
    """

    def __init__(self, x: tuple[float, float], height: float, title: str) -> None:
        self.low, self.high = x
        self.height, self.title = height, title
        self.parts: list[str] = []

    def across(self, x: npt.ArrayLike) -> Any:
        """Return the place of x in the picture [px]."""
        span = self.high - self.low or 1.0
        return _SIDE + (np.asarray(x, dtype=float) - self.low) / span * (WIDTH - 2 * _SIDE)

    def line(
        self, x: npt.ArrayLike, y: npt.ArrayLike, colour: str = "currentColor", width: float = 1.5
    ) -> None:
        """Draw a line through places; y runs down [px]."""
        self.parts.append(
            f'<polyline points="{_points(self.across(x), y)}" fill="none" stroke="{colour}" '
            f'stroke-width="{width:g}" stroke-linejoin="round"/>'
        )

    def area(
        self, x: npt.ArrayLike, y: npt.ArrayLike, colour: str = "currentColor", shade: float = 0.18
    ) -> None:
        """Fill a polygon."""
        self.parts.append(
            f'<polygon points="{_points(self.across(x), y)}" fill="{colour}" '
            f'fill-opacity="{shade:g}" stroke="{colour}" stroke-opacity="0.7" stroke-width="0.8"/>'
        )

    def dot(self, x: float, y: float, colour: str, radius: float = 4.0) -> None:
        """Draw a dot."""
        self.parts.append(
            f'<circle cx="{self.across(x):.1f}" cy="{y:.1f}" r="{radius:g}" fill="{colour}"/>'
        )

    def word(self, x: float, y: float, text: str, anchor: str = "start") -> None:
        """Write a few words in small type."""
        self.parts.append(
            f'<text x="{self.across(x):.1f}" y="{y:.1f}" font-size="10" fill="currentColor" '
            f'fill-opacity="0.75" text-anchor="{anchor}">{escape(text)}</text>'
        )

    def key(self, y: float, names: Iterable[str], words: str = "") -> None:
        """Write the names of curves in their order, each behind a dot of its colour."""
        parts = [
            f'<tspan fill="{colour}" fill-opacity="1">●</tspan> {escape(name)}'
            for name, colour in zip(names, COLOURS, strict=False)
        ]
        self.parts.append(
            f'<text x="{_SIDE:g}" y="{y:.1f}" font-size="10" fill="currentColor" '
            f'fill-opacity="0.75">{"&#160; ".join([escape(words), *parts])}</text>'
        )

    def __str__(self) -> str:
        return (
            f'<svg viewBox="0 0 {WIDTH:g} {self.height:g}" role="img" width="{WIDTH:g}" '
            f'style="max-width:100%;height:auto" font-family="sans-serif">'
            f"<title>{escape(self.title)}</title>{''.join(self.parts)}</svg>"
        )


def _points(x: npt.ArrayLike, y: npt.ArrayLike) -> str:
    pairs = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(*pairs, strict=True))


def beam_picture(beam: Beam) -> str:
    """Return a beam, thicker where it is stiffer, with its ends and what is attached."""
    picture = Picture((float(beam.x[0]), float(beam.x[-1])), 62, f"{beam.name}, a sketch")
    _draw_beam(picture, beam, 26.0, 22.0)
    picture.word(beam.x[0], 58, f"{beam.x[0]:g}")
    picture.word(beam.x[-1], 58, f"{beam.x[-1]:.5g} m", "end")
    return str(picture)


def _draw_beam(picture: Picture, beam: Beam, middle: float, half: float) -> None:
    x, size = np.repeat(beam.x, 2)[1:-1], thickness(beam) * half
    picture.area(np.append(x, x[::-1]), np.append(middle - size, middle + size[::-1]))
    ends = ((beam.ends.left, beam.x[0], -1), (beam.ends.right, beam.x[-1], 1))
    for end, place, outwards in ends:
        _draw_end(picture, end, float(place), outwards, middle, half)
    for item in beam.attachments:
        kind = name_of(item)
        if kind in ("point mass", "joint"):
            picture.dot(item.x, middle, COLOURS[_MARKS[kind]], 4.5)
        else:
            _draw_spring(picture, item.x, middle, COLOURS[_MARKS.get(kind, 0)])


def _draw_end(
    picture: Picture, end: str, place: float, outwards: int, middle: float, half: float
) -> None:
    """Draw a wall, a pin, or a slide; nothing at a free end."""
    reach = outwards * (picture.high - picture.low) / (WIDTH - 2 * _SIDE)  # of one pixel
    if end == "clamped":
        walls = [place, place + 9 * reach, place + 9 * reach, place]
        picture.area(walls, [middle - half] * 2 + [middle + half] * 2, shade=0.35)
        picture.line([place] * 2, [middle - half, middle + half], width=2)
    elif end in ("pinned", "sliding"):
        low = middle + half * 0.9
        picture.area([place - 6 * abs(reach), place, place + 6 * abs(reach)], [low, middle, low])
    if end == "sliding":
        picture.line([place - 8 * reach, place + 8 * reach], [middle + half] * 2)


def _draw_spring(picture: Picture, x: float, middle: float, colour: str) -> None:
    reach = (picture.high - picture.low) / (WIDTH - 2 * _SIDE)
    zigzag = np.array([0, 0, 4, -4, 4, -4, 0, 0]) * reach
    picture.line(x + zigzag, middle + np.array([4, 8, 10, 13, 16, 19, 21, 25]), colour)
    picture.line([x - 6 * reach, x + 6 * reach], [middle + 25] * 2, colour)


def modes_picture(result: ModalResult, most: int = 4) -> str:
    """Return the first shapes of the first family that has any, over the beam."""
    beam = result.beam
    for family in result.families:
        modes = [mode for mode in result.family(family) if mode.number][:most]
        if modes:
            break
    else:
        return beam_picture(beam)
    symbol = FAMILIES[family].quantities[0].symbol
    picture = Picture((float(beam.x[0]), float(beam.x[-1])), 104, f"{family} modes of {beam.name}")
    picture.line(beam.x[[0, -1]], [46, 46], width=0.8)
    for mode, colour in zip(modes, COLOURS, strict=False):
        shape = mode.shape / (np.max(np.abs(mode.shape)) or 1.0)
        picture.line(result.x, 46 - 38 * shape, colour)
    numbers = [str(mode.number) for mode in modes]
    picture.key(100, numbers, f"{symbol} of {family} modes, largest 1")
    return str(picture)


def loads_picture(loads: Loads) -> str:
    """Return N along the body."""
    x = np.unique(np.concatenate([np.linspace(0, loads.length, 201), loads.breakpoints]))
    sides = [loads.axial_force(x, "left"), loads.axial_force(x, "right")]
    N = np.stack(sides, axis=1).ravel() / 1e3
    picture = Picture((0.0, loads.length), 92, "axial force along the body")
    high, low = max(float(N.max()), 0.0), min(float(N.min()), 0.0)
    y = 72 - 60 * (N - low) / (high - low or 1.0)
    zero = 72 - 60 * (0.0 - low) / (high - low or 1.0)
    xx = np.repeat(x, 2)
    picture.area(np.r_[xx, xx[-1], xx[0]], np.r_[y, zero, zero], COLOURS[0])
    picture.line([0, loads.length], [zero, zero], width=0.8)
    picture.word(0, 88, f"N {N[0]:.4g} kN at the nose")
    picture.word(loads.length, 88, f"{N[-1]:.4g} kN at the tail, {loads.length:.4g} m", "end")
    return str(picture)


def case_picture(case: Case) -> str:
    """Return the vehicle in its cavity, to scale, seen from the side."""
    vehicle, cavity = case.vehicle, case.loads.cavity
    L = vehicle.length
    x = np.linspace(0, min(cavity.L_c, 1.06 * L), 120)
    middle, radius = cavity.axis_offset(x), cavity.radius(x)
    scale = (WIDTH - 2 * _SIDE) / (1.06 * L)
    reach = float(np.max(np.abs(middle) + radius)) * scale + 10
    picture = Picture((0.0, 1.06 * L), 2 * reach + 14, f"{vehicle.name} in its cavity")
    upper, lower = reach - scale * (middle + radius), reach - scale * (middle - radius)
    picture.area(np.append(x, x[::-1]), np.append(upper, lower[::-1]), COLOURS[0], 0.12)
    places = np.unique(np.concatenate([vehicle.stations.x, np.linspace(0, L, 120)]))
    inner = (places[1:] + places[:-1]) / 2
    body = np.repeat(vehicle.radius_at(inner), 2) * scale
    along = np.repeat(places, 2)[1:-1]
    picture.area(np.append(along, along[::-1]), np.append(reach - body, reach + body[::-1]))
    half = vehicle.cavitator.diameter / 2 * scale
    picture.line([0, 0], [reach - half, reach + half], width=3)
    for fins, load in zip(vehicle.fins, case.loads.fins, strict=True):
        tip, chord = fins.tip_radius * scale, fins.chord or 0.02 * L
        sides = [load.position - chord / 2, load.position + chord / 2]
        for sign in (-1, 1):
            root = sign * float(vehicle.radius_at(load.position)) * scale
            edges = [reach + root, reach + root, reach + sign * tip, reach + sign * tip]
            picture.area([*sides, *sides[::-1]], edges, shade=0.4)
    picture.word(0, 2 * reach + 10, f"body {L:.4g} m, cavity {cavity.L_c:.4g} m")
    return str(picture)


def curve_picture(
    x: npt.ArrayLike,
    curves: Sequence[npt.ArrayLike],
    names: Sequence[str],
    words: str,
    *,
    log: bool,
) -> str:
    """Return curves over x.

    Parameters
    ----------
    x : array_like, shape (k,)
    curves : sequence of array_like, shape (k,)
    names : sequence of str
        Of the curves.
    words : str
        Below, at the right.
    log : bool
        Whether both axes are logarithmic.
    """
    places = np.log(np.asarray(x, dtype=float)) if log else np.asarray(x, dtype=float)
    picture = Picture((float(places[0]), float(places[-1])), 104, ", ".join(names))
    values = [np.asarray(curve, dtype=float) for curve in curves]
    if log:
        values = [np.log(np.maximum(v, np.max(v) * 1e-6 + 1e-300)) for v in values]
    low = min(float(np.min(v)) for v in values)
    high = max(float(np.max(v)) for v in values)
    every = max(1, len(places) // 800)
    for value, colour in zip(values, COLOURS, strict=False):
        y = 84 - 76 * (value - low) / (high - low or 1.0)
        picture.line(places[::every], y[::every], colour)
    picture.line([picture.low, picture.high], [86, 86], width=0.8)
    picture.key(100, names)
    picture.word(picture.high, 100, words, "end")
    return str(picture)


def bars_picture(rows: Iterable[tuple[str, float]], title: str, unit: str) -> str:
    """Return horizontal bars from zero, named at the left; unlimited numbers are left out."""
    kept = [(name, value) for name, value in rows if math.isfinite(value)][:12]
    if not kept:
        return ""
    low, high = min(0.0, *(v for _, v in kept)), max(0.0, *(v for _, v in kept))
    span = high - low or 1.0
    picture = Picture((low - 0.6 * span, high + 0.25 * span), 16 + 15 * len(kept), title)
    for k, (name, value) in enumerate(kept):
        y = 4 + 15 * k
        picture.area([0, value, value, 0], [y, y, y + 10, y + 10], COLOURS[0], 0.6)
        picture.word(low - 0.02 * span, y + 9, name[:34], "end")
        picture.word(max(value, 0.0) + 0.01 * span, y + 9, f"{value:.3g} {unit}")
    picture.line([0, 0], [0, 4 + 15 * len(kept)], width=0.8)
    return str(picture)
