"""What the ends do: bending frequencies of a vehicle for every choice of its end forces.

A fixed nozzle turns with the tail, and a disk's pressure with the nose. Beside what the case says
stand the other choices, each solved on the chain that its own solution needed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import BENDING
from antinode.modes.backends import choose, for_one
from antinode.modes.following import eigenvalues_alone
from antinode.modes.hertz import error_hz, hertz
from antinode.modes.result import ModalResult, null
from antinode.modes.rigid import rigid_modes
from antinode.riccati.chain import Chain
from antinode.riccati.following.beside import Neighbours, neighbours
from antinode.riccati.roots import CountingError

from .case import Case

CHOICES = (
    ("fixed directions", (0.0, 0.0)),
    ("thrust follows", (0.0, 1.0)),
    ("thrust and cavitator follow", (1.0, 1.0)),
)
"""By name: shares of the cavitator's drag, and of the thrust, that turn with the body."""
_WIDTH = 1e-8
_MOST_HALVINGS = 8
_OWN = "as the file says"


@dataclass(frozen=True)
class Choice:
    """Bending frequencies for one choice of end forces.

    Attributes
    ----------
    name : str
    follow : tuple of float
        Shares of the cavitator's drag, and of the thrust, that turn with the body.
    frequencies_hz, error_hz : array, shape (modes,)
        [Hz]; NaN where a mode diverges, or they were not found.
    proven : bool
        Whether it is certain that none is missing.
    stated : bool
        Whether it is what the case says.
    """

    name: str
    follow: tuple[float, float]
    frequencies_hz: Array
    error_hz: Array
    proven: bool
    stated: bool

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        values, errors = self.frequencies_hz.tolist(), self.error_hz.tolist()
        return {
            "name": self.name,
            "cavitator_follows": self.follow[0],
            "thrust_follows": self.follow[1],
            "stated": self.stated,
            "proven": self.proven,
            "frequencies_hz": [null(value) for value in values],
            "error_hz": [null(value) for value in errors],
        }


def compare_end_forces(case: Case, result: ModalResult) -> tuple[Choice, ...]:
    """Return the bending frequencies for every choice of the end forces, what the case says first.

    None where bending is not among the modes, one of them does not oscillate steadily, or the
    water's stiffness takes part.
    """
    modes = [m for m in result.family(BENDING) if m.number]
    steady = all(m.omega2 > 0 and not m.growth for m in modes)
    if not modes or not steady or result.method == "tmm" or case.tangents:
        return ()
    omega2 = np.array([m.omega2 for m in modes])
    error = np.array([m.error_omega2 for m in modes])
    own = case.model.follow
    name = next((name for name, follow in CHOICES if follow == own), _OWN)
    proven = result.certificate.get("kind") != "none"
    first = Choice(name, own, hertz(omega2), error_hz(omega2, error), proven, stated=True)
    others = [pair for pair in CHOICES if pair[1] != own]
    return first, *_solved(case, result, others, omega2, error)


def _solved_chain(result: ModalResult) -> Chain:
    """Return the chain that was solved, without the nodes that shapes needed."""
    for halvings in range(_MOST_HALVINGS):
        chain = result.beam.chain(BENDING, 2**halvings)
        if len(chain.length) >= result.segments[BENDING]:
            return chain
    return result.solutions[BENDING].chain


def _solved(
    case: Case,
    result: ModalResult,
    others: Sequence[tuple[str, tuple[float, float]]],
    known: Array,
    error: Array,
) -> list[Choice]:
    """Solve other choices side by side; their chain errs as much as that known, or twice that."""
    chain = replace(_solved_chain(result), following=(0.0, 0.0))
    ends = np.array([follow for _, follow in others]) * (case.loads.F_CX, case.loads.thrust)
    rigid = len(rigid_modes(result.beam, BENDING))
    with np.errstate(all="ignore"):
        found = neighbours(chain, ends, known, rigid, _WIDTH)
        found = [
            one if one.eigenvalues else _anew(replace(chain, following=tuple(f)), len(known), rigid)
            for one, f in zip(found, ends.tolist(), strict=True)
        ]
    return [_choice(*pair, one, error) for pair, one in zip(others, found, strict=True)]


def _choice(name: str, follow: tuple[float, float], found: Neighbours, error: Array) -> Choice:
    if not found.eigenvalues:
        none = np.full(len(error), np.nan)
        return Choice(name, follow, none, none, proven=False, stated=False)
    omega2 = np.array([v.omega2 for v in found.eigenvalues])
    width = np.array([v.bracket[1] - v.bracket[0] for v in found.eigenvalues])
    off = error_hz(omega2, 2 * error + width)
    return Choice(name, follow, hertz(omega2), off, found.proven, stated=False)


def _anew(chain: Chain, number: int, rigid: int) -> Neighbours:
    """Solve a choice whose modes are not all next to those known: where some diverge, say."""
    wanted, zeros = rigid + number, 1 if np.any(chain.axial_force) else rigid
    try:
        solver = choose(for_one(len(chain.length), wanted))
        values = eigenvalues_alone(solver, chain, wanted, zeros, _WIDTH)
    except (CountingError, FloatingPointError):
        return Neighbours([], proven=False)
    moved = sorted((v for v in values if v.omega2 or v.imaginary), key=lambda v: v.omega2)
    elastic = moved[rigid - zeros :][:number]
    if len(elastic) < number or any(v.imaginary for v in elastic):
        return Neighbours([], proven=False)
    return Neighbours(elastic, proven=True)
