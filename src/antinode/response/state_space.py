"""State space models: modes as ``x' = A x + B u, y = C x + D u``, for other programs.

    x = [q, q'],   A = [[0, 1], [-omega_n^2, -C]],   B = [0, b],   C, D by the outputs' rates

Modes left out act at rest through D, in displacements and internal forces. Inputs are the forces,
and the acceleration of supports that move; then displacements and velocities are relative to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arguments import ByValue, whole
from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.modes.solve import HasBeam
from antinode.whole import write_file

from .damping import UNDAMPED, Damping
from .frequency import Model
from .modal import Basis
from .modal_sum import Summed
from .quantities import Base, Drive, Output


@dataclass(frozen=True, eq=False)
class StateSpace(ByValue):
    """A linear model in time.

    Attributes
    ----------
    A, B, C, D : array
        Shapes (2n, 2n), (2n, inputs), (outputs, 2n), (outputs, inputs), SI.
    states, inputs, outputs : tuple of str
        What they are, with units.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    def to_scipy(self) -> Any:
        """Return it as `scipy.signal.StateSpace`."""
        from scipy.signal import StateSpace as Own

        return Own(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """Return it as `control.StateSpace`; needs python-control."""
        control = import_extra("control", "control")
        names = {"states": self.states, "inputs": self.inputs, "outputs": self.outputs}
        plain = {key: [_word(name) for name in value] for key, value in names.items()}
        return control.ss(self.A, self.B, self.C, self.D, **plain)

    def write_mat(self, path: str | Path) -> None:
        """Write A, B, C, D and the names to a file of MATLAB's."""
        from scipy.io import savemat

        data = {
            **{name: getattr(self, name) for name in "ABCD"},
            **{
                name: np.array(getattr(self, name), dtype=object)
                for name in ("states", "inputs", "outputs")
            },
        }
        write_file(Path(path), lambda partial: savemat(partial, data, appendmat=False))


def _word(name: str) -> str:
    return "".join(c if c.isalnum() else "_" for c in name)


def state_space(
    problem: Beam | HasBeam,
    drives: Sequence[Drive],
    outputs: Sequence[Output],
    modes: int = 10,
    *,
    damping: Damping = UNDAMPED,
) -> StateSpace:
    """Return the modes of a beam as a model in time.

    Parameters
    ----------
    problem : Beam or case
    drives : sequence of Force or Base
        Of a base the input is its acceleration.
    outputs : sequence of Output
    modes : int
        Elastic modes of each family, besides rigid ones.
    damping : Damping
        A loss factor acts as the viscous ratio that loses as much at resonance.

    Raises
    ------
    InputError
        If a displacement or velocity is absolute where supports move, or `modal_sum` refuses it.
    """
    modes = whole("modes", modes, 200)
    beam = problem if isinstance(problem, Beam) else problem.beam()
    model = Model(beam, drives, outputs, damping, 1.0)
    parts = [Summed(model, family, modes) for family in model.families]
    n = sum(len(part.basis.omega2) for part in parts)
    A, B = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, len(model.drives)))
    C, D = np.zeros((len(model.outputs), 2 * n)), np.zeros((len(model.outputs), len(model.drives)))
    A[:n, n:] = np.eye(n)
    names: list[str] = []
    for part in parts:
        q = slice(len(names), len(names) + len(part.basis.omega2))
        rate = slice(n + q.start, n + q.stop)
        A[rate, q], A[rate, rate] = -np.diag(part.basis.omega2), -part.basis.damping
        B[rate] = part.basis.drives
        for row, output in enumerate(model.outputs):
            if output.family == part.family:
                C[row, q], C[row, rate], D[row] = _row(part, row, output, model.drives)
        names += part.basis.names
    return StateSpace(
        A,
        B,
        C,
        D,
        (*names, *(f"rate of {name}" for name in names)),
        tuple(_input(drive) for drive in model.drives),
        tuple(f"{output.name} [{output.unit}]" for output in model.outputs),
    )


def _input(drive: Drive) -> str:
    if isinstance(drive, Base):
        return f"{drive.direction} acceleration of the supports [{drive.unit}]"
    return f"{drive.name} [{drive.unit}]"


def _row(
    part: Summed, row: int, output: Output, drives: tuple[Drive, ...]
) -> tuple[Array, Array, Array]:
    """Return an output's part of C for coordinates and rates, and of D."""
    own: Basis = part.basis
    c, none = own.outputs[row], np.zeros(len(own.omega2))
    moving = np.array([isinstance(d, Base) and d.family == part.family for d in drives])
    if np.any(moving) and output.moves and not output.relative and output.rate < 2:
        raise InputError(
            f"{output.name}: where supports move, a model in time gives displacement and velocity "
            "relative to them: set relative = true"
        )
    if output.rate == 0:
        return c, own.drag[row], part.rest[row]
    if output.rate == 1:
        return none, c, np.zeros(len(drives))
    through = c @ own.drives
    if output.moves and not output.relative:
        through = through + moving
    return -c * own.omega2, -c @ own.damping, through
