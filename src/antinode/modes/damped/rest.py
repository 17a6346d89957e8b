r"""What rests: motions of a rigid body that no force opposes, eigenvalues s = 0.

A rigid motion ``a + b x`` rests where every feedback gives ``K (Y, psi) = 0`` for it; an axial
force leaves translation alone. Of n such motions, with left ones w, s = 0 is an eigenvalue

    n + (n - rank w^T C v)

times: each once where a dashpot opposes it, and else twice, because a motion at constant speed goes
on as well. It is divided out so often, by derivation, not by moving the edge of a region.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.modes.rigid import turns_freely
from antinode.riccati.damped.chain import Damped
from antinode.riccati.points import Point

_RANK = 1e-10  # of the largest singular value


@dataclass(frozen=True)
class AtRest:
    """Eigenvalues at s = 0.

    Attributes
    ----------
    motions : array, shape (n, 2)
        Rows [a, b] of the motions ``a + b (x - x[0])`` that rest; and the turn of a body that
        carries its inertia alone (`rigid.turns_freely`).
    free : array, shape (m, 2)
        Those that nothing but the axial force opposes.
    base_zeros : int
        Eigenvalues omega^2 = 0 of the base chain.
    multiplicity : int
        Of s = 0.
    """

    motions: Array
    free: Array
    base_zeros: int
    multiplicity: int


def at_rest(beam: Beam, damped: Damped) -> AtRest:
    """Return what rests on a beam's chain with all that acts on it."""
    chain, family = damped.chain, damped.chain.law.name
    free = beam.freedoms(family)
    points = chain.points
    loaded = chain.law.has_axial_force and not beam.is_unloaded
    K = [_K(p) for p in points]
    diagonal = [np.diag(np.diag(matrix)) for matrix in K]
    at = [float(chain.nodes[p.node]) for p in points]
    base = _annulled(_translations(free) if loaded else free, diagonal, at)
    own = _annulled(free, K, at)
    motions = _translations(own) if loaded else own
    adjoint = _annulled(_translations(free) if loaded else free, [m.T for m in K], at)
    number = len(motions)
    if number and loaded and turns_freely(beam, family) and not damped.acting.C.any():
        return AtRest(own, own, len(base), 2 * number + 2)  # the turn is no eigenvector
    if any(chain.following) or len(adjoint) != number:
        adjoint = motions
    C = sum(
        (
            of_motions(adjoint, x) @ rate_matrix(p) @ of_motions(motions, x).T
            for p, x in zip(points, at, strict=True)
        ),
        np.zeros((number, number)),
    )
    return AtRest(motions, own, len(base), 2 * number - _rank(C))


def _rank(C: Array) -> int:
    if not C.any():
        return 0
    size = np.linalg.svd(C, compute_uv=False)
    return int(np.sum(size > _RANK * size[0]))


def of_motions(motions: Array, x: float) -> Array:
    """Return displacement and turn of motions at a place, shape (n, 2)."""
    return np.stack([motions[:, 0] + motions[:, 1] * x, motions[:, 1]], axis=1)


def _translations(motions: Array) -> Array:
    """Return the translation, if it is among the motions."""
    if len(motions) == 2:
        return np.array([[1.0, 0.0]])
    return motions[motions[:, 1] == 0.0] if len(motions) else motions


def _annulled(motions: Array, matrices: list[Array], places: list[float]) -> Array:
    """Return the motions for which no matrix gives a force: combinations of those given."""
    acting = [(m, x) for m, x in zip(matrices, places, strict=True) if m.any()]
    if not len(motions) or not acting:
        return motions
    rows = np.concatenate([m @ of_motions(motions, x).T for m, x in acting])
    _, size, V = np.linalg.svd(rows)
    rank = int(np.sum(size > _RANK * size[0])) if size[0] > 0 else 0
    if rank == 0:
        return motions
    return np.asarray(V[rank:] @ motions)


def _K(point: Point) -> Array:
    return np.array(point.feedback or np.zeros(4)).reshape(2, 2)


def rate_matrix(point: Point) -> Array:
    """Return C of a point, shape (2, 2)."""
    own = np.diag([point.dashpot, point.rotational_dashpot])
    return np.array(point.feedback_damping or np.zeros(4)).reshape(2, 2) + own
