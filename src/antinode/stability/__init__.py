"""Stability: where a beam diverges or flutters, along a factor on all its axial forces.

The room bears the name of its function: importing any module of it puts the room where
``antinode.stability`` is looked up, so that the room itself may be called.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any


class _Room(ModuleType):
    """A package that calls its function."""

    def __call__(self, *arguments: Any, **settings: Any) -> Any:
        from .stability import stability

        return stability(*arguments, **settings)


sys.modules[__name__].__class__ = _Room
