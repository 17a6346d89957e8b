"""The libraries of the extra `report`, or how to install them."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

from antinode.errors import InputError

ENDINGS = (".html", ".pdf")
_NEEDED = {".html": ("jinja2", "matplotlib"), ".pdf": ("typst", "matplotlib")}


def import_library(module: str) -> Any:
    """Import a library, or say in one sentence how to install it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise InputError(
            f"{module} is not installed; add it with: pip install 'antinode[report]'"
        ) from error


def check_libraries(path: Path) -> None:
    """Raise InputError if a report of this name cannot be made."""
    for module in _NEEDED[path.suffix.lower()]:
        import_library(module)
