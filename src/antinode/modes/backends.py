"""Which code solves: numpy, which is read, or numba's, which is fast. Both answer the same calls.

It is chosen by name, openly: nothing that was solved before, and no file on the disk, decides.
"""

from __future__ import annotations

from typing import Literal, Protocol

import numpy.typing as npt

from antinode.arguments import choice
from antinode.arrays import Array, Integers
from antinode.errors import ComputationError
from antinode.riccati.chain import Chain, Evaluation
from antinode.riccati.chains import BeamRoots, ChainRoots, Chains, Tables
from antinode.riccati.damped.chain import Form
from antinode.riccati.forced import Lanes, Loads, Sides
from antinode.riccati.laws import Columns
from antinode.riccati.normalised import Normalised, Wanted
from antinode.riccati.roots import Eigenvalue, FollowingRoots
from antinode.riccati.shapes import Energies

BackendName = Literal["auto", "numpy", "numba"]

AUTO: BackendName = "numba"
"""What "auto" stands for."""

_SMALL = 10_000  # segments times modes that numpy solves in some tenths of a second


class DrivenChain(Protocol):
    """A chain with what drives it, ready to be asked at any frequencies."""

    def states(self, lanes: Lanes, /) -> Sides:
        """Return the states on either side of the wanted nodes."""
        ...


class Backend(Protocol):
    """What solves chains and beams: a module, `riccati.readable` or `riccati.lanes.calls`."""

    name: str
    complex_form: type[Form]
    """What answers for chains at complex s."""

    def evaluate(self, chain: Chain, omega2: npt.ArrayLike, /) -> Evaluation:
        """Count the eigenvalues below each omega^2, with the characteristic function there."""
        ...

    def find_eigenvalues(
        self,
        chain: Chain,
        wanted: int,
        /,
        *,
        zeros: int = 0,
        width: float = 1e-10,
        expected: Array | None = None,
    ) -> list[Eigenvalue]:
        """Return the lowest eigenvalues of a chain, certified, without a gap."""
        ...

    def find_following(
        self, chain: Chain, below: int, wanted: int, /, *, zeros: int, free: bool, width: float
    ) -> FollowingRoots | None:
        """Return the lowest eigenvalues where ends follow, proven; None if it does not prove."""
        ...

    def solve_chains(
        self, chains: Chains, below: int, number: int, width: float, /, *, proven: bool = True
    ) -> ChainRoots:
        """Solve chain after chain for eigenvalues below + 1 ... below + number.

        Those that are not `proven` are enclosed, and predicted to a tenth of the width.
        """
        ...

    def certify_guesses(
        self, chains: Chains, guess: Array, below: int, width: float, /
    ) -> ChainRoots:
        """Certify guesses for chains of one structure under many axial forces."""
        ...

    def solve_beam(
        self,
        beam: Tables,
        below: int,
        number: int,
        refinement: int,
        tolerance: float,
        width: float,
        /,
    ) -> BeamRoots | None:
        """Solve a beam with steps halved until they agree; None if that is not its own to do."""
        ...

    def cut(self, chain: Chain, positions: Array, omega2: Array, /) -> Chain:
        """Return a chain with joints at positions as well, fit for states at every omega^2."""
        ...

    def mode_states(
        self, chain: Chain, omega2: Array, multiplicity: Integers, /, *, adjoint: bool = False
    ) -> Array:
        """Return the states of modes at every node, shape (n + 1, k, s)."""
        ...

    def mode_energies(self, chain: Chain, states: Array, omega2: Array, /) -> Energies:
        """Return modal mass and stiffness of modes."""
        ...

    def normalise(
        self,
        chain: Chain,
        states: Array,
        omega2: Array,
        wanted: Wanted,
        left: Array | None = None,
        /,
    ) -> Normalised:
        """Return modes scaled as asked, with their forms, at places along the chain."""
        ...

    def normal_modes(
        self, chain: Chain, omega2: Array, motions: Array, wanted: Wanted, /
    ) -> Normalised:
        """Return modes that are apart, known or solved, as `normalise` scales them."""
        ...

    def driven(
        self, chain: Chain, columns: Columns, loads: Loads, wanted: Integers, /
    ) -> DrivenChain:
        """Return a chain with what drives it, to be asked for states at some nodes."""
        ...


def choose(name: BackendName = "auto") -> Backend:
    """Return the backend of a name; "auto" is numba, loaded in some hundredths of a second.

    Raises
    ------
    InputError
        If there is none of this name.
    ComputationError
        If numba's code is missing and cannot be made.
    """
    choice("backend", name, BackendName)
    if (AUTO if name == "auto" else name) == "numpy":
        from antinode.riccati import readable

        return readable
    from antinode.riccati.lanes import calls
    from antinode.riccati.lanes.library import LibraryError, library

    try:
        library()
    except LibraryError as error:
        raise ComputationError(str(error)) from error
    return calls


def for_one(segments: int, modes: int) -> BackendName:
    """Return what a command that solves a single problem asks for.

    Below 10,000 segments times modes numpy takes some tenths of a second at most: such a command
    answers at once on a fresh install, where numba would compile for ten seconds first.
    """
    return "numpy" if segments * modes < _SMALL else "numba"
