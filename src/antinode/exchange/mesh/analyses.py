"""What a solver may be asked to do with a deck."""

from __future__ import annotations

from typing import Literal

Analysis = Literal["modes", "unloaded", "statsub", "buckling"]
"""Modes under N, without it, under N by a static subcase; the factor on N that buckles."""
