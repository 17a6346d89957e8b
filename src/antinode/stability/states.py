"""All eigenvalues of a beam under one factor on its axial force, and how many of them are unstable.

In the plane of omega^2 a mode is stable on the positive real axis, diverges on the negative one,
and flutters off the axis, in pairs. Eigenvalues that are zero by the supports stay out of it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.modes.backends import Backend
from antinode.modes.batch import rounding_by_shapes
from antinode.modes.damped.family import on_chain
from antinode.modes.following import Following
from antinode.modes.loading import Loading, loading
from antinode.modes.rigid import exact_zeros, pivot_of, rigid_modes, rigid_rotation
from antinode.riccati.arrays import Complex
from antinode.riccati.chain import Chain
from antinode.riccati.lateral import without_tangential
from antinode.riccati.roots import Eigenvalue

_MEETING = 0.5  # gap over the middle of two eigenvalues
_ROUNDING = 1e-12  # of s
_TRACE = 1e-300  # what tells where a rotation goes that stands at zero without force


@dataclass(frozen=True)
class State:
    """The lowest eigenvalues under one factor.

    Attributes
    ----------
    factor : float
    real : array, shape (r,)
        Real ones, ascending, without those that are always zero [rad^2/s^2].
    pairs : array of complex, shape (c,)
        Of each complex pair the one with a positive imaginary part.
    number : int
        Of all eigenvalues left of a line, with those that are zero.
    proven : bool
        Whether it is proven that these are all.
    """

    factor: float
    real: Array
    pairs: Complex
    number: int
    proven: bool

    @property
    def status(self) -> tuple[int, int]:
        """How many diverge, and how many pairs flutter."""
        return int(np.sum(self.real < 0)), len(self.pairs)

    @property
    def unstable(self) -> int:
        """Modes that diverge or flutter: two of each pair."""
        negative, pairs = self.status
        return negative + 2 * pairs


@dataclass
class Watcher:
    """Encloses the eigenvalues of a beam under any factor on its axial force.

    Parameters
    ----------
    beam : Beam
    backend : Backend
    refinement : int
        Of its chains.
    elastic : int
        Elastic modes that are watched, at the least.
    """

    beam: Beam
    backend: Backend
    refinement: int
    elastic: int
    solved: dict[float, State] = field(default_factory=dict)
    """What was found, by factor."""

    def __post_init__(self) -> None:
        self.rigid = rigid_modes(self.beam, BENDING)
        self.zeros = exact_zeros(self.beam, BENDING)
        self.load: Loading = loading(self.beam, self.refinement, translates=False)
        self.solver = Following(self.backend)

    @property
    def names(self) -> tuple[str, ...]:
        """Of the eigenvalues that are not always zero, ascending: real ones never pass another."""
        moved = [f"rigid {name}" for name in self.rigid[self.zeros :]]
        return *moved, *(f"{BENDING} {k + 1}" for k in range(10 * self.elastic))

    def at(self, factor: float, pair: complex | None = None) -> State:
        """Return the state under a factor, near which a pair, or two that meet, may be known."""
        if factor not in self.solved:
            pairs = self._near(factor) if pair is None else np.array([pair])
            self.solved[factor] = self._solve(self.load(factor), factor, pairs)
        return self.solved[factor]

    def _near(self, factor: float) -> Complex:
        """Return pairs, and the middles of those that are about to meet, of the nearest state."""
        if not self.solved:
            return np.zeros(0, complex)
        near = self.solved[min(self.solved, key=lambda known: abs(known - factor))]
        middle, gap = (near.real[1:] + near.real[:-1]) / 2, np.diff(near.real)
        return np.concatenate([near.pairs, middle[gap < _MEETING * np.abs(middle)]])

    def _solve(self, chain: Chain, factor: float, pairs: Complex) -> State:
        if factor and self.beam.loads_turn:
            return self._with_loads(chain, factor)
        zeros = self.zeros if factor else len(self.rigid)
        wanted, own = len(self.rigid) + self.elastic, without_tangential(chain.columns)
        chain = chain if factor else replace(chain, columns=own)
        found = self.solver.find(chain, wanted, zeros=zeros, pairs=pairs)
        kept = [v for v in found.eigenvalues if v.omega2 != 0.0 or v.imaginary != 0.0]
        real = np.sort([v.omega2 for v in kept if v.imaginary == 0.0])
        pairs = np.array([v.value for v in kept if v.imaginary > 0.0], dtype=complex)
        proven = found.certificate["kind"] != "none"
        if factor == 0.0 and len(self.rigid) > self.zeros:
            turn = rigid_rotation(self.load(1.0), pivot_of(self.beam))
            real = np.sort(np.append(real, np.copysign(_TRACE, turn)))
        return State(factor, real, pairs, len(found.eigenvalues), proven)

    def doubtful(self, state: State, index: int) -> bool:
        """Tell whether rounding hides the sign of a real eigenvalue.

        A follower that pulls has one that falls like ``exp(-2 L sqrt(-N/EI))``: positive for any
        pull, and soon less than rounding leaves of it.
        """
        if not index < len(state.real):
            return False
        omega2 = float(state.real[index])
        value = Eigenvalue(0, omega2, (omega2, omega2), (0, 0))
        doubt = rounding_by_shapes(self.backend, self.load(state.factor), [value])
        return bool(abs(omega2) <= doubt[0])

    def _with_loads(self, chain: Chain, factor: float) -> State:
        """Return the state where loads along the beam turn: from complex modes, ``-s^2``."""
        roots = on_chain(self.beam, chain, self.elastic, self.backend)
        real, pairs = [], []
        for value in roots.eigenvalues:
            s, size = value.s, _ROUNDING * abs(value.s) + value.error
            if s.imag == 0 and s.real > 0:
                real.append(-(s.real**2))
            elif s.imag > 0 and abs(s.real) <= size:
                real.append(s.imag**2)
            elif s.imag > 0 and s.real > 0:
                pairs.append(-((-s.conjugate()) ** 2))
        number = self.zeros + len(real) + 2 * len(pairs)
        return State(factor, np.sort(real), np.array(pairs, dtype=complex), number, roots.proven)
