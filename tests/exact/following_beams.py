"""Random beams whose end forces follow, and what else tells their eigenvalues.

Finite elements of `tests.hp_beam`, made non-symmetric by what the ends do, go through a dense
solver (LAPACK); chains of uniform segments through matrix exponentials in 40 digits.
"""

import mpmath
import numpy as np
from scipy.linalg import lu_factor, lu_solve

import antinode as an
from antinode.beam.attachments import PointMass, Spring
from hp_beam import _breaks, _Mesh, _weighted


def random_beam(rng, load, *, uniform=False):
    """A beam of random table, masses and springs; its load is in units of its own buckling."""
    n = int(rng.integers(2, 6))
    x = np.sort(np.concatenate([[0, 1], rng.uniform(0.1, 0.9, n - 1)]))
    m, EI = (np.exp(rng.uniform(-0.7, 0.7, n + 1)) for _ in range(2))
    P = load * rng.uniform(0.3, 1.0)
    N = P * rng.uniform(0.2, 1.0, n + 1)
    left = rng.choice(["free", "free", "clamped", "pinned"])
    shares = {"right_follower": float(rng.uniform(0.3, 1.0))}
    if left == "free" and rng.random() < 0.5:
        shares["left_follower"] = float(rng.uniform(0.0, 1.0))
    how = "step" if uniform else str(rng.choice(["linear", "log"]))
    ends = an.Ends(str(left), "free", **shares)
    beam = an.Beam.from_stations(x, m, EI, axial_force=N, interpolation=how, ends=ends)
    if not uniform and rng.random() < 0.4:
        beam = beam.with_attachments(PointMass(float(rng.choice(x)), rng.uniform(0.05, 0.5)))
    if not uniform and rng.random() < 0.2:
        beam = beam.with_attachments(Spring(float(x[1]), translational=rng.uniform(1, 50)))
    return beam


def elements(beam, count, shift):
    """Eigenvalues of finite elements near a shift, complex, by rising real part."""
    _, K, M, _ = _scaled(beam, count, shift)
    inverse = np.linalg.eigvals(np.linalg.solve(K - shift * M, M))
    found = shift + 1 / inverse[np.abs(inverse) > 1e-9 * np.abs(inverse).max()]
    return found[np.argsort(found.real)]


def nearest(beam, count, shift):
    """The eigenvalue of finite elements next to a shift, to nearly all digits.

    Right and left vectors by inverse iteration; their quotient is summed at the Gauss points from
    derivatives of the vectors, so that short elements beside long ones cost no digits.
    """
    mesh, K, M, d = _scaled(beam, count, shift)
    v = w = np.random.default_rng(1).normal(size=len(K)) + 0j
    factors = lu_factor(K - shift * M)
    for _ in range(_ITERATIONS):
        v, w = lu_solve(factors, M @ v), lu_solve(factors, M @ w, trans=1)
        v, w = v / np.max(np.abs(v)), w / np.max(np.abs(w))
    right, left = np.zeros((2, mesh.size), complex)
    free = np.setdiff1d(np.arange(mesh.size), mesh.held)
    right[free], left[free] = d * v, d * w
    top, slope, value = (
        [np.einsum("eqi,ei->eq", basis, z[mesh.dofs]) for z in (right, left)]
        for basis in (mesh.top, mesh.slope, mesh.value)
    )
    stiffness = np.sum(mesh.stiffness * top[0] * top[1] - mesh.force * slope[0] * slope[1])
    mass = np.sum(mesh.mass * value[0] * value[1])
    for dofs, k, m in mesh.points:
        stiffness, mass = (
            stiffness + left[dofs] @ k @ right[dofs],
            mass + left[dofs] @ m @ right[dofs],
        )
    nose, tail = beam.following()
    last = 2 * len(mesh.h)
    stiffness += tail * left[last] * right[last + 1] - nose * left[0] * right[1]
    return stiffness / mass


_ITERATIONS = 12


def _scaled(beam, count, shift):
    """A mesh, its K and M as far as they are free, scaled, and the scales."""
    mesh = _Mesh(beam, "bending", _breaks(beam, "bending", count, 1.6, 1.8), 11)
    size = mesh.size
    K, M = np.zeros((size, size)), np.zeros((size, size))
    Ke = _weighted(mesh.stiffness, mesh.top) - _weighted(mesh.force, mesh.slope)
    Me = _weighted(mesh.mass, mesh.value)
    for e, dofs in enumerate(mesh.dofs):
        K[np.ix_(dofs, dofs)] += Ke[e]
        M[np.ix_(dofs, dofs)] += Me[e]
    for dofs, k, m in mesh.points:
        K[np.ix_(dofs, dofs)] += k
        M[np.ix_(dofs, dofs)] += m
    left, right = beam.following()
    last = 2 * len(mesh.h)
    K[0, 1] -= left  # of w Y' at the ends
    K[last, last + 1] += right
    free = np.setdiff1d(np.arange(size), mesh.held)
    K, M = K[np.ix_(free, free)], M[np.ix_(free, free)]
    d = 1 / np.sqrt(np.diag(K) + np.diag(M) * abs(shift))
    return mesh, K * np.outer(d, d), M * np.outer(d, d), d


class Exponentials:
    """The characteristic function of a stepped beam without attachments, in many digits."""

    def __init__(self, beam, digits=40):
        mpmath.mp.dps = digits
        self.beam, self.digits = beam, digits

    def __call__(self, omega2):
        mpmath.mp.dps = self.digits
        beam, mpf = self.beam, mpmath.mpf
        left, right = map(mpf, beam.following())
        start = {"free": [[1, 0, 0, 0], [0, 1, 0, left]], "clamped": [[0, 0, 1, 0], [0, 0, 0, 1]]}
        start["pinned"] = [[0, 1, 0, 0], [0, 0, 0, 1]]
        z = mpmath.matrix(start[beam.ends.left]).T
        for k in range(len(beam.x) - 1):
            m, EI, N = (
                mpf(v[k, 0])
                for v in (beam.mass_per_length, beam.bending_stiffness, beam.axial_force)
            )
            A = mpmath.matrix(
                [[0, 1, 0, 0], [0, 0, 1 / EI, 0], [0, -N, 0, 1], [m * omega2, 0, 0, 0]]
            )
            z = mpmath.expm(A * (mpf(beam.x[k + 1]) - mpf(beam.x[k]))) * z
        M, Q = z[2, :], z[3, :] - right * z[1, :]
        return M[0] * Q[1] - M[1] * Q[0]

    def refined(self, guess):
        """Return the eigenvalue next to a guess."""
        mpmath.mp.dps = self.digits
        z = mpmath.mpc(guess)
        near = [z, z * (1 + mpmath.mpf("1e-9")), z * (1 - mpmath.mpf("1e-9"))]
        return complex(mpmath.findroot(self, near, solver="muller", tol=1e-25, verify=False))
