"""A report as one HTML file that loads nothing."""

from __future__ import annotations

from importlib.resources import files
from typing import Any

from antinode.extras import import_extra
from antinode.show.svg import for_page
from antinode.version import __version__

from .blocks import Document


def to_html(document: Document) -> str:
    """Return the page."""
    jinja2: Any = import_extra("jinja2", "report")
    text = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    drawings = {figure.name: for_page(figure.svg, figure.name) for figure in document.figures()}
    page: str = environment.from_string(text).render(
        document=document, drawings=drawings, version=__version__
    )
    return page
