"""Hydrodynamics of a supercavitating body: cavitator, cavity, fins, planing (eq. 1-17)."""

from .cavitator import cavitator_forces
from .cavity import Cavity, form_cavity
from .planing import Planing, planing_state
from .validity import Range, Validity

__all__ = [
    "Cavity",
    "Planing",
    "Range",
    "Validity",
    "cavitator_forces",
    "form_cavity",
    "planing_state",
]
