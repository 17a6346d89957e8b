"""The solver of beams with end forces that turn with the end: certified by winding numbers.

The chain with fixed directions is solved with counts; the winding number of what the following ends
make of it tells how many eigenvalues lie left of a line (`riccati.following.roots`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.errors import ComputationError
from antinode.riccati.arrays import Complex
from antinode.riccati.chain import Chain
from antinode.riccati.roots import Certificate, CountingError, Eigenvalue, FollowingRoots
from antinode.riccati.shapes import Energies, energies_between

from .backends import Backend
from .rigid import rigid_modes
from .solvers import Counting, Found, Solver

NOT_PROVEN = (
    "that no mode is missing is not proven here: the forces that follow are too large beside the "
    "stiffness; compare with fewer or more modes"
)

_WIDTH = 1e-10  # relative, of brackets in omega^2


@dataclass(frozen=True)
class Following(Solver):
    """Ends whose force follows: real eigenvalues by changes of sign, pairs by circles."""

    backend: Backend
    rigid: int | None = None
    """Eigenvalues that the supports leave rigid, if that is known."""
    certificate = "winding"

    @property
    def counting(self) -> Counting:
        """What solves the same chain with fixed directions."""
        return Counting(self.backend)

    def find(
        self,
        chain: Chain,
        wanted: int,
        *,
        zeros: int,
        expected: Array | None = None,
        pairs: Complex | None = None,
    ) -> Found:
        """Enclose every eigenvalue left of a line above those wanted.

        Where `pairs` are expected, or two are about to meet, it looks first.
        """
        if not chain.follows:
            return self.counting.find(chain, wanted, zeros=zeros, expected=expected)
        exact = int(zeros > 0 and translates_freely(chain))  # a turn is free in the limit
        try:
            found = self._find(chain, wanted, exact, zeros > exact, pairs)
        except (CountingError, FloatingPointError) as error:
            raise ComputationError(
                f"the {chain.law.name} eigenvalues could not be enclosed: {error}; "
                "check stiffness, mass and axial force for values of a wrong unit"
            ) from error
        proven = found.complete and found.certificate.proven
        eigenvalues = _freed(found.eigenvalues) if zeros > exact else found.eigenvalues
        warnings = () if proven else (f"{chain.law.name}: {NOT_PROVEN}",)
        return Found(eigenvalues, warnings, certificate_dict(found.certificate, proven))

    def _find(
        self, chain: Chain, wanted: int, zeros: int, free: bool, pairs: Complex | None
    ) -> FollowingRoots:
        """Find them by what the backend proves at once, or else by winding numbers."""
        if self.rigid is not None and pairs is None:
            settings: dict[str, Any] = {"zeros": zeros, "free": free, "width": _WIDTH}
            found = self.backend.find_following(chain, self.rigid, wanted, **settings)
            if found is not None:
                return found
        from antinode.riccati.following.roots import Finder

        def fixed(number: int) -> list[Eigenvalue]:
            return self.counting.find(chain.fixed, number, zeros=zeros).eigenvalues

        return Finder(chain, fixed, zeros, _WIDTH).find(wanted, pairs)


def certifying(solver: Solver, beam: Beam, family: FamilyName) -> Solver:
    """Return the solver that certifies a family of a beam, by the same backend."""
    if not any(beam.following(family)):
        return solver.counting
    return Following(solver.backend, len(rigid_modes(beam, family)))


def eigenvalues_alone(
    backend: Backend,
    chain: Chain,
    number: int,
    zeros: int,
    width: float,
    rigid: int | None = None,
) -> list[Eigenvalue]:
    """Return the lowest eigenvalues of one chain, whether its end forces follow or not.

    `rigid` tells how many the supports leave rigid, if that is known: it saves time.

    Raises
    ------
    CountingError, FloatingPointError
        If they cannot be certified.
    """
    if not chain.follows:
        return backend.find_eigenvalues(chain, number, zeros=zeros, width=width)
    if rigid is not None:
        settings: dict[str, Any] = {"zeros": zeros, "free": False, "width": width}
        known = backend.find_following(chain, rigid, number, **settings)
        if known is not None:
            return known.eigenvalues
    from antinode.riccati.following.roots import Finder

    def fixed(count: int) -> list[Eigenvalue]:
        return backend.find_eigenvalues(chain.fixed, count, zeros=zeros, width=width)

    found = Finder(chain, fixed, zeros, width).find(number)
    if not (found.complete and found.certificate.proven):
        raise CountingError("that no mode is missing is not proven")
    return found.eigenvalues


def certificate_dict(certificate: Certificate, proven: bool) -> dict[str, Any]:
    """Return a certificate as JSON has it."""
    record = {
        "fixed_direction_count": certificate.fixed,
        "winding_number": certificate.turns,
        "eigenvalues": certificate.number,
        "samples": certificate.samples,
        "margin": certificate.margin,
    }
    region = {"real_part_of_omega2_below": certificate.below}
    return {"kind": "winding" if proven else "none", "region": region, "record": record}


def _freed(found: list[Eigenvalue]) -> list[Eigenvalue]:
    """Set the eigenvalue next to zero to zero: that of a rotation which nothing turns back.

    A chain of uniform segments shares out the axial force a little wrongly, and misses by that.
    """
    others = [k for k, value in enumerate(found) if value.omega2 != 0.0]
    nearest = min(others, key=lambda k: abs(found[k].value))
    zeros = [nearest, *(k for k, value in enumerate(found) if value.omega2 == 0.0)]
    edges = np.array([found[k].bracket for k in zeros])
    edge = float(min(0.0, np.min(edges[:, 0]))), float(max(0.0, np.max(edges[:, 1])))
    rest = [value for k, value in enumerate(found) if k not in zeros]
    below = sum(value.omega2 < 0 for value in rest)
    exact = [Eigenvalue(0, 0.0, edge, (below, below + len(zeros)))] * len(zeros)
    listed = sorted([*rest, *exact], key=lambda v: (v.order, -v.imaginary))
    return [
        replace(v, index=k + 1, counts=v.counts if v.omega2 == 0.0 else (k, k + 1))
        for k, v in enumerate(listed)
    ]


def translates_freely(chain: Chain) -> bool:
    """Tell whether nothing holds the displacement of a chain."""
    ends = any(0 in chain.law.ends[end] for end in (chain.left, chain.right))
    points = any(p.static_spring or p.coupling or 0 in p.holds for p in chain.points)
    return not (ends or points or np.any(chain.columns.get("foundation", 0.0)))


def energies_of_modes(backend: Backend, chain: Chain, states: Array, omega2: Array) -> Energies:
    """Return the energies of modes, between right and left eigenvectors where these differ."""
    if not chain.follows:
        return backend.mode_energies(chain, states, omega2)
    return two_sided_energies(backend, chain, states, omega2)


def two_sided_energies(backend: Backend, chain: Chain, right: Array, omega2: Array) -> Energies:
    """Return the energies of modes between right and left eigenvectors.

    The left eigenvector w is scaled as the right one v, and so that int m w v > 0.

    Parameters
    ----------
    right : array, shape (n + 1, k, s)
        States of the modes; of rigid ones at omega^2 = 0 as well, which are their own left ones.
    omega2 : array, shape (k,)
    """
    left = left_states(backend, chain, right, omega2)
    return energies_between(backend.mode_energies, chain, right, left, omega2)


def left_states(backend: Backend, chain: Chain, right: Array, omega2: Array) -> Array:
    """Return left eigenvectors as large as the right ones, with int m w v > 0."""
    left = right.copy()
    found = np.flatnonzero(omega2 != 0.0)
    if not len(found):
        return left
    one = np.ones(len(found), np.int64)
    w = backend.mode_states(chain, omega2[found], one, adjoint=True)
    v = right[:, found]
    scale = np.max(np.abs(v[..., 0]), axis=0) / np.max(np.abs(w[..., 0]), axis=0)
    mass = np.einsum("n,nk->k", _mass_at_nodes(chain), v[..., 0] * w[..., 0])
    phase = np.abs(mass) / np.where(mass == 0, 1.0, mass)
    left[:, found] = w * (scale * np.where(mass == 0, 1.0, phase))[:, None]
    return left


def _mass_at_nodes(chain: Chain) -> Array:
    """Return the mass of a chain shared out to its nodes [kg]: enough to tell a sign."""
    own = chain.mass * chain.length / 2
    mass = np.append(own, 0.0) + np.append(0.0, own)
    for point in chain.points:
        mass[point.node] += point.mass
    return np.asarray(mass)
