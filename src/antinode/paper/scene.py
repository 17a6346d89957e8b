"""What the figures of the paper show: conditions out of its tables, solved once when needed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from antinode.arrays import Array
from antinode.beam.ends import Ends
from antinode.modes.result import ModalResult, Mode
from antinode.modes.solve import solve_one
from antinode.vehicle.case import Case

from .comparison import Comparison


@dataclass(frozen=True)
class Scene:
    """The reconstructed vehicle in the conditions of the paper.

    Attributes
    ----------
    comparison : Comparison
        All rows of the tables with their cases.
    """

    comparison: Comparison

    def cases(self, table: int) -> tuple[Case, ...]:
        """Return the conditions of one table."""
        return tuple(line.case for line in self.comparison.table(table))

    @property
    def common(self) -> Case:
        """The condition that Tables 1 to 4 share."""
        return next(c for c in self.cases(1) if c.condition.cavitation_number == 0.02)

    @property
    def modal(self) -> Case:
        """The condition whose modes the paper shows: the largest cavitation number of Table 1."""
        return self.cases(1)[-1]

    @cached_property
    def result(self) -> ModalResult:
        """Modes in this condition."""
        return solve_one(self.modal, 6)

    @cached_property
    def unloaded(self) -> ModalResult:
        """Modes of the same beam without axial force."""
        return solve_one(self.modal.beam().without_axial_force(), 6)

    @cached_property
    def clamped_tail(self) -> ModalResult:
        """Modes of the same beam with its tail clamped: det S has its poles there."""
        beam = replace(self.modal.beam(), ends=Ends("free", "clamped"))
        return solve_one(beam, 8)

    def elastic(self, family: str) -> list[Mode]:
        """Return modes 1 to 6 of a family."""
        return [mode for mode in self.result.modes if mode.family == family and mode.number]


def axial_force_curve(case: Case) -> tuple[Array, Array]:
    """Return x [m] and N [kN] along the body, with both sides of every step."""
    loads = case.loads
    x = np.union1d(np.linspace(0, case.vehicle.length, 241), loads.breakpoints)
    sides = [loads.axial_force(x, "left"), loads.axial_force(x, "right")]
    return np.repeat(x, 2), np.stack(sides, axis=1).ravel() / 1e3
