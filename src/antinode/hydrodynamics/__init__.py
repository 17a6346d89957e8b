"""Hydrodynamics of a supercavitating body: cavitator, cavity, fins, planing (eq. 2-17)."""

from antinode.hydrodynamics.cavitator import cavitator_forces
from antinode.hydrodynamics.cavity import Cavity, form_cavity
from antinode.hydrodynamics.planing import Planing, planing_state
from antinode.hydrodynamics.validity import Range, Validity

__all__ = [
    "Cavity",
    "Planing",
    "Range",
    "Validity",
    "cavitator_forces",
    "form_cavity",
    "planing_state",
]
