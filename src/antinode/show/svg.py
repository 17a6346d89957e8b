"""A drawing of matplotlib as part of an HTML page: text as text, ids of its own, no references."""

from __future__ import annotations

import re

_SIZE = re.compile(r'width="[\d.]+pt" height="([\d.]+)pt" viewBox="0 0 ([\d.]+) [\d.]+"')


def for_page(svg: str, name: str, cut: float = 0.0) -> str:
    """Return an SVG to stand inside a page.

    Parameters
    ----------
    svg : str
        As matplotlib writes it.
    name : str
        Put before every id, so that drawings do not meet.
    cut : float
        Height that is cut off at the bottom [pt].
    """
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r' xmlns(:\w+)?="[^"]*"', "", svg[svg.index("<svg") :])
    size = _SIZE.search(svg)
    assert size is not None
    height = float(size[1]) - cut
    svg = _SIZE.sub(f'viewBox="0 0 {size[2]} {height:.2f}" role="img"', svg, count=1)
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    return re.sub(r'(url\(#|href="#)', rf"\g<1>{name}-", svg)
