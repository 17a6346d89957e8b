"""Integrals of modes over a beam by Gauss points on the exact shapes, for the tests."""

import numpy as np


def gauss_points(result, points=12):
    """Positions [m] and weights between the nodes of the solved chain."""
    nodes = result.solutions["bending"].chain.nodes + result.beam.x[0]
    p, w = np.polynomial.legendre.leggauss(points)
    h = np.diff(nodes)[:, None]
    return nodes[:-1, None] + h * (p + 1) / 2, h * w / 2


def chain_matrices(result, family="bending"):
    """Mass and stiffness-less-axial-force matrices of the modes, by the chain's own properties."""
    x, w = gauss_points(result)
    chain = result.solutions[family].chain
    z = result.at(x.ravel(), family).reshape(*x.shape, len(result.family(family)), -1)

    def form(weight, component):
        values = z[..., component]
        return np.einsum("np,n,npi,npj->ij", w, weight, values, values)

    mass = form(chain.mass, 0)
    if family == "longitudinal":
        return mass, form(1 / chain.stiffness, 1)
    return mass, form(1 / chain.stiffness, 2) - form(chain.axial_force, 1)
