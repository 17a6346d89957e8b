"""Libraries that come with the extra `exchange`, imported when they are needed."""

from __future__ import annotations

from typing import Any

from antinode.dataset import import_extra


def need(module: str) -> Any:
    """Import a library of the extra `exchange`, or say how to install it.

    Raises
    ------
    InputError
        If it is not installed.
    """
    return import_extra(module, "exchange")
