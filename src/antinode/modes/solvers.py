"""Solvers: ways to find the lowest eigenvalues of a chain, each with what it certifies.

A solver is chosen by its method's name; the refinement and everything behind it ask nothing else.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from antinode.arrays import Array
from antinode.errors import ComputationError, InputError
from antinode.riccati.chain import Chain
from antinode.riccati.roots import CountingError, Eigenvalue, check_certificate

from .backends import Backend
from .result import Method

Certificate = Literal["counts", "winding", "none"]
_LONG = 1000  # segments from which brackets are wider


@dataclass(frozen=True)
class Found:
    """Eigenvalues of a chain, ascending, and what to say of them."""

    eigenvalues: list[Eigenvalue]
    warnings: tuple[str, ...] = ()
    certificate: Mapping[str, Any] = field(default_factory=lambda: {"kind": "counts"})
    """What proves the list, as JSON has it."""


class Solver(ABC):
    """A way to find the lowest eigenvalues of a chain.

    Attributes
    ----------
    certificate : {"counts", "winding", "none"}
        What proves that the list has no gap and nothing too many; an error is stated only where
        something does.
    backend : Backend
        What evaluates chains.
    counting : Solver
        The one that certifies, by the same backend.
    """

    certificate: ClassVar[Certificate]
    backend: Backend

    @property
    @abstractmethod
    def counting(self) -> Counting:
        """What brackets eigenvalues by counts."""

    @abstractmethod
    def find(
        self, chain: Chain, wanted: int, *, zeros: int, expected: Array | None = None
    ) -> Found:
        """Find the lowest eigenvalues of a chain, and every other one below or at zero.

        Parameters
        ----------
        chain : Chain
        wanted : int
            How many eigenvalues, from the lowest, at the least.
        zeros : int
            How many are exactly zero by the supports.
        expected : array, optional
            Places beside which they probably lie [rad^2/s^2]; they only save time.

        Raises
        ------
        ComputationError
            If they could not be found.
        """


@dataclass(frozen=True)
class Counting(Solver):
    """The Riccati form with counts (equations 67-80; Wittrick and Williams, 1971)."""

    backend: Backend
    certificate = "counts"

    @property
    def counting(self) -> Counting:
        """Itself."""
        return self

    def find(
        self, chain: Chain, wanted: int, *, zeros: int, expected: Array | None = None
    ) -> Found:
        """Bracket every eigenvalue by counts."""
        width = 1e-10 if len(chain.length) <= _LONG else 2e-10
        try:
            found = self.backend.find_eigenvalues(
                chain, wanted, zeros=zeros, width=width, expected=expected
            )
        except (CountingError, FloatingPointError) as error:
            raise ComputationError(
                f"the {chain.law.name} eigenvalues could not be certified: {error}; "
                "check stiffness, mass and axial force for values of a wrong unit"
            ) from error
        if not check_certificate(found):
            raise ComputationError(
                f"the counts of the {chain.law.name} modes contradict each other"
            )
        return Found(found)


@dataclass(frozen=True)
class TransferMatrices(Solver):
    """The determinant of equation 66, scanned as its users do it: for comparison."""

    backend: Backend
    certificate = "none"

    @property
    def counting(self) -> Counting:
        """What it is compared with."""
        return Counting(self.backend)

    def find(
        self, chain: Chain, wanted: int, *, zeros: int, expected: Array | None = None
    ) -> Found:
        """Scan as far as the counts say that the eigenvalues reach, and compare with them."""
        from antinode.riccati.literal import find_eigenvalues_tmm

        if chain.follows:
            raise InputError(
                "method 'tmm' knows end forces of fixed direction alone; set the follower shares "
                "to 0, or leave the method out"
            )
        counted = self.counting.find(chain, wanted, zeros=zeros, expected=expected)
        certified = counted.eigenvalues
        lowest, highest = certified[0].omega2, certified[-1].omega2
        below = min(1.5 * lowest, -1e-3 * abs(highest))
        found = find_eigenvalues_tmm(
            chain, len(certified), below=below, above=1.1 * abs(highest), zeros=zeros
        )
        if not found:
            raise ComputationError(f"the transfer matrix scan found no {chain.law.name} mode")
        steps = sum(e.counts == (e.index - 1, e.index) or e.omega2 == 0.0 for e in found)
        if steps == len(certified):
            return Found(found, certificate={"kind": "none"})
        warning = (
            f"{chain.law.name}: the transfer matrix scan confirms {steps} of {len(certified)} "
            "eigenvalues; use the default method for a certified list"
        )
        return Found(found, (warning,), {"kind": "none"})


SOLVERS: dict[Method, type[Counting] | type[TransferMatrices]] = {
    "riccati": Counting,
    "tmm": TransferMatrices,
}


def solver_of(method: Method, backend: Backend) -> Solver:
    """Return the solver of a method's name, on a backend.

    Raises
    ------
    InputError
        If there is none.
    """
    if method not in SOLVERS:
        raise InputError(f"method is {method!r}; allowed are {', '.join(map(repr, SOLVERS))}")
    return SOLVERS[method](backend)
