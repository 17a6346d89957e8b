"""An independent reference for forced beams: hp finite elements, factored once a frequency.

Motion of the supports is told in relative motion, by inertia: nothing is shared with the solver,
which tells it in absolute motion by supports and springs.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from antinode.beam.attachments import Dashpot
from hp_beam import _breaks, _Mesh, _weighted


class HpResponse:
    """Matrices of a beam; `count` modes are as fine as waves are resolved."""

    def __init__(self, beam, eta, count=12, family="bending", degree=11, phase=2.4, ratio=2.0):
        dampers = [item for item in beam.attachments if isinstance(item, Dashpot)]
        beam = replace(beam, attachments=tuple(i for i in beam.attachments if i not in dampers))
        self.beam, self.family = beam, family
        cuts = _breaks(beam, family, count, phase, ratio)
        mesh = _Mesh(beam, family, cuts, degree)
        n = mesh.size
        self.K, self.M = np.zeros((n, n), complex), np.zeros((n, n))
        Ke = (1 + 1j * eta) * _weighted(mesh.stiffness, mesh.top)
        Ke = Ke - _weighted(mesh.force, mesh.slope)
        Me = _weighted(mesh.mass, mesh.value)
        for e in range(len(mesh.h)):
            self.K[np.ix_(mesh.dofs[e], mesh.dofs[e])] += Ke[e]
            self.M[np.ix_(mesh.dofs[e], mesh.dofs[e])] += Me[e]
        for dofs, k, m in mesh.points:
            self.K[np.ix_(dofs, dofs)] += k
            self.M[np.ix_(dofs, dofs)] += m
        self.C = np.zeros((n, n))
        self.order, self.first = (
            mesh.order,
            np.concatenate([[0], np.cumsum([len(c) - 1 for c in cuts])]),
        )
        for item in dampers:
            own = (item.translational, item.rotational) if self.order == 2 else (item.axial,)
            for i, c in enumerate(own):
                self.C[self.dof(item.x, i), self.dof(item.x, i)] += c
        self.free = np.setdiff1d(np.arange(n), mesh.held)
        self.mesh = mesh
        self.factors = lru_cache(maxsize=1)(self._factors)

    def dof(self, x, freedom=0):
        """Unknown at a breakpoint, on the left of a joint."""
        k = int(np.argmin(np.abs(self.beam.x - x)))
        return self.order * int(self.first[k]) + freedom

    def dynamic(self, omega):
        D = self.K + 1j * omega * self.C - omega**2 * self.M
        return D[np.ix_(self.free, self.free)]

    def _factors(self, omega):
        """Scaling to a unit diagonal, and the factors of what is scaled."""
        d = 1 / np.sqrt(
            np.abs(np.diag(self.K)[self.free].real) + omega**2 * np.diag(self.M)[self.free]
        )
        return d, splu(csc_matrix(self.dynamic(omega) * np.outer(d, d)))

    def solve(self, omega, load):
        d, factors = self.factors(omega)
        u = np.zeros(len(self.K), complex)
        u[self.free] = d * factors.solve(d * load[self.free])
        return u

    def by_force(self, omega, x, freedom=0):
        load = np.zeros(len(self.K), complex)
        load[self.dof(x, freedom)] = 1.0
        return self.solve(omega, load)

    def by_ground(self, omega):
        """Absolute displacements under a unit displacement of all that is fixed to the ground."""
        rigid = np.zeros(len(self.K))
        rigid[: self.order * (int(self.first[-1]) + 1) : self.order] = 1.0
        return self.solve(omega, omega**2 * (self.M @ rigid)) + rigid
