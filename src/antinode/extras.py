"""Libraries of the extras of the package: imported when needed, or how to install them."""

from __future__ import annotations

import importlib
from typing import Any

from .errors import InputError


def import_extra(module: str, extra: str) -> Any:
    """Import a library of an extra.

    Raises
    ------
    InputError
        If it is not installed; the sentence says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise InputError(
            f"{module} is not installed; add it with: pip install 'antinode[{extra}]'"
        ) from error
