"""What a report can be written as, and the libraries for it, or how to install them."""

from __future__ import annotations

from pathlib import Path

from antinode.extras import import_extra

ENDINGS = (".html", ".pdf")
_NEEDED = {".html": ("jinja2", "matplotlib"), ".pdf": ("typst", "matplotlib")}


def check_libraries(path: Path) -> None:
    """Raise InputError if a report of this name cannot be made."""
    for module in _NEEDED[path.suffix.lower()]:
        import_extra(module, "report")
