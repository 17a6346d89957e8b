"""Beams as they are drawn: dimensions of sections and a material, from which all else follows.

from antinode.beam.sections import Material, drawn_beam
"""

from .drawn import drawn_beam
from .material import Material

__all__ = ["Material", "drawn_beam"]
