"""An independent reference for sheared beams under N: p elements for Y and psi, in float64.

    U = 1/2 int EI psi'^2 + kGA (Y' - psi)^2 + N (psi^2 - 2 psi Y') dx   (Haringx)
    T = 1/2 int m Y'^2 + rho I psi'^2 dx

with both as integrated Legendre polynomials of one degree on elements that end at stations. Masses
and springs sit at nodes. Nothing is shared with the solver: no transfer matrices, no chains.
"""

import numpy as np
from numpy.polynomial import legendre

from antinode.beam.attachments import PointMass, Spring

_HELD = {"free": (), "pinned": (0,), "sliding": (1,), "clamped": (0, 1)}


class ShearElements:
    """M and K of a beam with shear, `parts` elements of one degree in every interval.

    Attributes
    ----------
    M, K : array
        K complex by a loss factor of EI and kGA.
    """

    def __init__(self, beam, eta, degree=9, parts=2):
        self.beam, self.parts = beam, parts
        xi, w = legendre.leggauss(degree + 8)
        shape, slope = _shapes(xi, degree)
        nodes, bubbles = parts * (len(beam.x) - 1) + 1, degree - 1
        size = 2 * nodes + 2 * bubbles * (nodes - 1)
        self.K, self.M = np.zeros((size, size), complex), np.zeros((size, size))
        for e in range(nodes - 1):
            k, part = divmod(e, parts)
            dx = (beam.x[k + 1] - beam.x[k]) / parts
            t = (part + (xi + 1) / 2) / parts

            def at(table, k=k, t=t):
                return (1 - t) * table[k, 0] + t * table[k, 1]

            J, first = w * dx / 2, 2 * nodes + 2 * bubbles * e
            places = {
                f: np.r_[2 * e + f, 2 * e + 2 + f, first + f : first + 2 * bubbles : 2]
                for f in (0, 1)
            }
            d = slope * 2 / dx

            def add(A, weight, one, f, other, g, J=J, places=places):
                A[np.ix_(places[f], places[g])] += (one * (J * weight)[:, None]).T @ other

            EI, kGA = (
                (1 + 1j * eta) * at(t_) for t_ in (beam.bending_stiffness, beam.shear_stiffness)
            )
            N = at(beam.axial_force)
            add(self.K, EI, d, 1, d, 1)
            add(self.K, kGA, d, 0, d, 0)
            add(self.K, -kGA - N, d, 0, shape, 1)
            add(self.K, -kGA - N, shape, 1, d, 0)
            add(self.K, kGA + N, shape, 1, shape, 1)
            add(self.M, at(beam.mass_per_length), shape, 0, shape, 0)
            add(self.M, at(beam.rotary_inertia_per_length), shape, 1, shape, 1)
        for item in beam.attachments:
            i = self.dof(item.x)
            if isinstance(item, PointMass):
                self.M[i, i] += item.mass
                self.M[i + 1, i + 1] += item.rotary_inertia
            elif isinstance(item, Spring):
                self.K[i, i] += item.translational
                self.K[i + 1, i + 1] += item.rotational
        ends = ((0, beam.ends.left), (2 * nodes - 2, beam.ends.right))
        held = [first + f for first, end in ends for f in _HELD[end]]
        self.free = np.setdiff1d(np.arange(size), held)

    def dof(self, x, freedom=0):
        """Unknown at a station of the beam."""
        return 2 * self.parts * int(np.argmin(np.abs(self.beam.x - x))) + freedom

    def scaled(self):
        """M and K of what is free, with a unit diagonal of M, the scale, and places by unknown."""
        some = np.ix_(self.free, self.free)
        d = 1 / np.sqrt(np.diag(self.M)[self.free])
        where = {int(i): k for k, i in enumerate(self.free)}
        return self.M[some] * np.outer(d, d), self.K[some] * np.outer(d, d), d, where


def _shapes(xi, degree):
    """Nodal lines, then integrated Legendre polynomials: values and derivatives in xi."""
    shape = [(1 - xi) / 2, (1 + xi) / 2]
    slope = [np.full_like(xi, -0.5), np.full_like(xi, 0.5)]
    for n in range(1, degree):
        one = legendre.Legendre.basis(n)
        integral = one.integ(lbnd=-1)
        size = np.sqrt(n + 0.5)
        shape.append(size * integral(xi))
        slope.append(size * one(xi))
    return np.array(shape).T, np.array(slope).T
