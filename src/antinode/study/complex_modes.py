"""Complex bending eigenvalues on a chain of fixed refinement, with their exact derivatives."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Complex, Numbers
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.errors import ComputationError
from antinode.modes.backends import choose
from antinode.modes.damped.family import NOT_PROVEN, on_refinement
from antinode.modes.damped.modes import names_in
from antinode.riccati.chain import Chain
from antinode.riccati.damped.slopes import Eigenpairs

STEP = 2e-6
"""Of a number's size: how far beams are apart whose difference is a derivative."""


class Beside(NamedTuple):
    """The beams on two sides of a number, and how far these are apart."""

    low: Beam
    high: Beam
    step: float


@dataclass(frozen=True)
class ComplexModes:
    """Complex eigenvalues 1 ... n of a beam in bending, named as `solve_modes` names them.

    Attributes
    ----------
    pairs : Eigenpairs
    refinement : int
    """

    pairs: Eigenpairs
    refinement: int

    @property
    def s(self) -> Complex:
        """[1/s], Im s >= 0."""
        return self.pairs.s

    @property
    def omega2(self) -> Numbers:
        """-s^2 [rad^2/s^2]."""
        return self.pairs.omega2

    @property
    def frequencies_hz(self) -> Array:
        """[Hz]; 0 where a mode does not oscillate."""
        return np.asarray(self.s.imag / (2 * math.pi))

    def displacement(self, x: Array) -> Complex:
        """Return the displacements of the modes at places [m], to any scale, (points, k)."""
        return np.asarray(self.pairs.at(x)[0][..., 0])

    def slopes(self, sides: Sequence[Beside | None]) -> Complex:
        """Return ds by each of some numbers, shape (k, numbers); NaN where there are no sides."""
        found = [
            np.full(len(self.s), np.nan, complex)
            if beside is None
            else self.pairs.slope(self._chain(beside.low), self._chain(beside.high), beside.step)
            for beside in sides
        ]
        return np.stack(found, axis=1) if found else np.zeros((len(self.s), 0), complex)

    def frequency_slopes(self, sides: Sequence[Beside | None]) -> Array:
        """Return the derivatives of the frequencies [Hz], NaN where a mode does not oscillate."""
        slope = self.slopes(sides).imag / (2 * math.pi)
        return np.asarray(np.where(self.s.imag[:, None] > 0, slope, np.nan))

    def _chain(self, beam: Beam) -> Chain:
        return beam.chain(BENDING, self.refinement)


def complex_modes(beam: Beam, number: int, refinement: int) -> ComplexModes:
    """Return the complex modes 1 ... n of a beam in bending, on chains of one refinement.

    Raises
    ------
    ComputationError
        If they could not be enclosed, or are not proven to be all.
    """
    found = on_refinement(beam, refinement, number, choose(), dampers=True)
    if found.certificate["kind"] == "none":
        raise ComputationError(f"{BENDING}: {NOT_PROVEN}")
    names = names_in(beam, found)
    rows = [k for k, (_, place) in enumerate(names) if place][:number]
    s = np.array([found.eigenvalues[k].s for k in rows])
    return ComplexModes(Eigenpairs(found.damped, s), refinement)
