"""A report as PDF, set by typst; as pictures of its pages too."""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from antinode.errors import ComputationError
from antinode.extras import import_extra
from antinode.version import __version__

from .blocks import Document


def to_pdf(document: Document) -> bytes:
    """Return the PDF."""
    return _compiled(document, "pdf")[0]


def to_pictures(document: Document, dots_per_inch: float = 100.0) -> list[bytes]:
    """Return every page as PNG."""
    return _compiled(document, "png", ppi=dots_per_inch)


def _compiled(document: Document, kind: str, **options: Any) -> list[bytes]:
    typst: Any = import_extra("typst", "report")
    with TemporaryDirectory() as name:
        folder = Path(name)
        _write_sources(document, folder)
        try:
            made = typst.compile(
                str(folder / "document.typ"),
                root=name,
                font_paths=[_fonts()],
                ignore_system_fonts=True,
                format=kind,
                **options,
            )
        except typst.TypstError as error:
            raise ComputationError(f"typst could not set the report: {error}") from error
    return made if isinstance(made, list) else [made]


def _write_sources(document: Document, folder: Path) -> None:
    """Write the template, the content as JSON, and the drawings."""
    template = files(__package__).joinpath("document.typ").read_text(encoding="utf-8")
    folder.joinpath("document.typ").write_text(template, encoding="utf-8")
    data = {**document.to_dict(), "version": __version__}
    folder.joinpath("document.json").write_text(json.dumps(data), encoding="utf-8")
    for figure in document.figures():
        folder.joinpath(f"{figure.name}.svg").write_text(figure.svg, encoding="utf-8")


def _fonts() -> str:
    """Return the folder of the fonts that the drawings use: those of matplotlib."""
    matplotlib: Any = import_extra("matplotlib", "report")
    return str(Path(matplotlib.get_data_path()) / "fonts" / "ttf")
