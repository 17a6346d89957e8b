r"""Exact derivatives of complex eigenvalues, and of critical loads, by left and right eigenvectors.

With ``A`` the rates of the state z = [Y, psi, M, Q] (`riccati.lateral`) and J the symplectic one,
``w^T (s^2 M + s C + K) v`` of two states is

    F = int w^T J A v dx + sum over points of [Y, psi]_w (K + s C + s^2 M) [Y, psi]_v

stationary about eigenvectors. So as a number a of the beam changes, with the states as they are,

    ds/da = -(dF/da) / (w^T (2 s M + C) v),

and where a factor p keeps the eigenvalue critical, ``dp/da = -(dF/da) / (dF/dp)``: no derivative of
s is needed, which a flutter has none of. dF/da is a difference of chains alone; nothing is solved
anew. Between the nodes of all chains columns are constant, so that the integrals are exact; where a
point moves past a kink, its two sides count half each.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers, Numbers
from antinode.riccati.chain import Chain, largest_wave_number
from antinode.riccati.points import Point
from antinode.riccati.shapes import gauss_rule, propagate, split_for

from .chain import Damped, adjoint_chain
from .energies import products
from .shapes import complex_states


@dataclass(frozen=True)
class Eigenpairs:
    """Right and left eigenvectors of a chain.

    Attributes
    ----------
    damped : Damped
        Without loss factors; no joint turns.
    s : array of complex, shape (k,)
        Its eigenvalues [1/s].
    """

    damped: Damped
    s: Complex

    @cached_property
    def _fine(self) -> Damped:
        chain = split_for(self.damped.chain, np.append(np.abs(self.s) ** 2, 0.0))
        return Damped(chain)

    @property
    def chain(self) -> Chain:
        """Split for these eigenvalues."""
        return self._fine.chain

    @property
    def omega2(self) -> Numbers:
        """-s^2."""
        return -self.s * self.s

    @cached_property
    def right(self) -> Numbers:
        """States v at the nodes, shape (n + 1, k, 4)."""
        return complex_states(self._fine, self.s)

    @cached_property
    def left(self) -> Numbers:
        """States w of the adjoint problem at the nodes."""
        return complex_states(self._fine.transposed, self.s)

    def at(self, x: Array) -> tuple[Numbers, Numbers]:
        """Return v and w at places from the left end [m], shape (points, k, 4) each."""
        nodes = self.chain.nodes
        segment = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
        away, adjoint = x - nodes[segment], adjoint_chain(self.chain)
        v = propagate(self.chain, self.right[segment], self.omega2, away, segment)
        w = propagate(adjoint, self.left[segment], self.omega2, away, segment)
        return v, w

    @cached_property
    def along(self) -> Complex:
        """``w^T (2 s M + C) v``: what dF is divided by."""
        forms = products(self._fine, self.chain, self.s, self.right, self.left)
        return np.asarray(2 * self.s * forms.mass + forms.damping)

    def change(self, low: Chain, high: Chain) -> Complex:
        """Return by how much F is larger on one chain than on another of the same length."""
        nodes = [self.chain.nodes, low.nodes, high.nodes]
        mesh = np.unique(np.clip(np.concatenate(nodes), 0.0, self.chain.nodes[-1]))
        a, size = mesh[:-1], np.diff(mesh)
        own = [_owner(chain, a + size / 2) for chain in (low, high)]
        rates = [
            _rates(chain, rows, self.omega2) for chain, rows in zip((low, high), own, strict=True)
        ]
        differs = np.flatnonzero(np.any(np.abs(rates[1] - rates[0]) > 0, axis=(1, 2, 3)))
        total: Complex = np.zeros(len(self.s), complex)
        a, size, moved = a[differs], size[differs], (rates[1] - rates[0])[differs]
        J = self.chain.law.symplectic
        for point, weight in zip(*gauss_rule(self._phase), strict=True) if len(differs) else ():
            v, w = self.at(a + point * size)
            total += weight * np.einsum("n,nki,ij,nkjl,nkl->k", size, w, J, moved, v)
        return np.asarray(total + self._at_points(high) - self._at_points(low))

    def slope(self, low: Chain, high: Chain, step: float) -> Complex:
        """Return ds of each eigenvalue for each unit of a number that is larger by a step."""
        return np.asarray(-self.change(low, high) / step / self.along)

    @cached_property
    def _phase(self) -> float:
        k = largest_wave_number(self.chain, float(np.max(np.abs(self.omega2))))
        return float(np.max(k * self.chain.length))

    def _at_points(self, chain: Chain) -> Complex:
        """Return the share of F of points, end forces that turn among them."""
        total: Complex = np.zeros(len(self.s), complex)
        points = Damped(chain).points
        if not points:
            return total
        v, w = self.at(np.array([chain.nodes[point.node] for point in points]))
        for k, point in enumerate(points):
            K, C, M = _matrices(point)
            s = self.s[:, None, None]
            total += np.einsum("ki,kij,kj->k", w[k, :, :2], K + s * C + s * s * M, v[k, :, :2])
        return total


def _owner(chain: Chain, middle: Array) -> Integers:
    found = np.searchsorted(chain.nodes, middle) - 1
    return np.asarray(np.clip(found, 0, len(chain.length) - 1))


def _rates(chain: Chain, rows: Integers, omega2: Numbers) -> Complex:
    """Return A of some segments, shape (segments, k, 4, 4)."""
    columns = {name: values[rows, None] for name, values in chain.columns.items()}
    found = np.zeros((len(rows), len(omega2), 4, 4), complex)
    for i, row in enumerate(chain.law.rates(columns, omega2)):
        for j, entry in enumerate(row):
            found[..., i, j] = entry
    return found


def _matrices(point: Point) -> tuple[Array, Array, Array]:
    """Return stiffness, damping and mass of a point, rows and columns Y and psi."""
    m, d = point.mass, point.offset
    turning = point.rotational_spring + point.own_load * d
    K = np.array([[point.spring, point.coupling], [point.coupling, turning]])
    K = K + np.reshape(point.feedback or np.zeros(4), (2, 2))
    C = np.diag([point.dashpot, point.rotational_dashpot])
    C = C + np.reshape(point.feedback_damping or np.zeros(4), (2, 2))
    return K, C, np.array([[m, m * d], [m * d, m * d * d + point.inertia]])
