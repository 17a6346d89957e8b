"""The laws of vibration: all that tells one kind of chain from another, each law in one object.

A law says which columns a segment has, how a state runs through it, how short it must be, which
ends and points there are, how eigenvalues are counted at the nodes, and which energies make modal
mass and stiffness. Everything else in this package reads it from here; no other module of the
readable form names a law.

===========  =============  ===================================  ==================================
law          state          equations                            columns
===========  =============  ===================================  ==================================
`BENDING`    Y theta M Q    ``M = EI Y''``, ``Q = M' + N Y'``    mass, stiffness EI, axial_force N
`BAR`        X Q            ``Q = -EA X'``                       mass, stiffness EA
`SHAFT`      phi T          ``T = GJ phi'``                      mass rho I_p, stiffness GJ
===========  =============  ===================================  ==================================

The force of each law changes along the beam by ``m omega^2 u`` (equation 48 with equation 50).
"""

from __future__ import annotations

from .lateral import Lateral
from .law import Columns, Forms, Law, LawName, Squares, Units
from .wave import Wave

__all__ = ["BAR", "BENDING", "SHAFT", "Columns", "Forms", "Law", "LawName", "Squares", "Units"]

BENDING = Lateral("bending")
BAR = Wave("longitudinal", ("X", "Q"), -1.0)
SHAFT = Wave("torsion", ("phi", "T"), 1.0)
