"""Forms of a chain between two states, such as left and right eigenvectors: ``w^T M v``.

Quadratic forms of `Law.squares` are polarised: ``w v = ((w + v)^2 - (w - v)^2)/4``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Numbers
from antinode.riccati.chain import Chain, largest_wave_number
from antinode.riccati.laws import Squares
from antinode.riccati.points import Point
from antinode.riccati.shapes import gauss_rule, propagate

from .chain import Damped, adjoint_chain


class Products(NamedTuple):
    """Forms of modes, shape (k,)."""

    mass: Numbers
    """w^T M v"""
    stiffness: Numbers
    """w^T K v, of all that does not move with the rate"""
    damping: Numbers
    """w^T C v"""
    size: Array
    """v^H M v: the integral of m abs(Y)^2, the modal mass."""
    squares: Squares
    """Of w v, over each segment."""


def products(damped: Damped, chain: Chain, s: Numbers, right: Numbers, left: Numbers) -> Products:
    """Return the forms of modes on a chain.

    Parameters
    ----------
    damped : Damped
        Whose `chain` is this one, or has the same nodes at its points.
    chain : Chain
        With columns as they lose energy.
    s : array, shape (k,)
    right, left : array, shape (n + 1, k, c)
    """
    squares, of_size, turned = _integrals(damped, chain, s, right, left)
    forms = chain.law.forms(chain.columns, squares)
    mass: Numbers = forms.mass
    stiffness: Numbers = forms.strain - forms.work - turned
    size: Numbers = chain.law.forms(chain.columns, of_size).mass
    of_points = [point_forms(chain, point, right, left) for point in damped.base.points]
    for inertia, elastic, own_size in of_points:
        mass, stiffness, size = mass + inertia, stiffness + elastic, size + own_size
    acting = damped.acting
    damping: Numbers = np.zeros(len(s), complex)
    if acting.node:
        v, w = (
            np.array([z[n, :, i] for n, i in zip(acting.node, acting.freedom, strict=True)])
            for z in (right, left)
        )
        damping = np.einsum("ik,ij,jk->k", w, acting.C, v)
        stiffness = stiffness + np.einsum("ik,ij,jk->k", w, acting.K, v)
    return Products(mass, stiffness, damping, size.real, squares)


def _integrals(
    damped: Damped, chain: Chain, s: Numbers, right: Numbers, left: Numbers
) -> tuple[Squares, Squares, Numbers]:
    """Return integrals of w v and of conj(v) v over segments, and what loads that turn give."""
    turned: Numbers = np.zeros(len(s), complex)
    found = damped.other.products(s, right, left)
    if found is not None:
        return *found, turned
    omega2: Numbers = -s * s
    total = np.zeros((2, len(Squares._fields), len(chain.length), len(s)), complex)
    adjoint, along = adjoint_chain(chain), chain.columns.get("tangential")
    phase = largest_wave_number(damped.chain, float(np.max(np.abs(omega2)))) * chain.length
    for point, weight in zip(*gauss_rule(float(np.max(phase))), strict=True):
        v = propagate(chain, right[:-1], omega2, point * chain.length)
        w = propagate(adjoint, left[:-1], omega2, point * chain.length)
        own = weight * chain.length[:, None]
        if along is not None:
            turned = turned + (own[:, 0] * along) @ (w[..., 0] * v[..., 1])
        for i, other in enumerate((w, v.conj())):
            total[i] += own * _polar(lambda z: chain.law.squares(chain.columns, z), other, v)
    return Squares(*total[0]), Squares(*total[1]), turned


def point_forms(
    chain: Chain, point: Point, right: Numbers, left: Numbers
) -> tuple[Numbers, Numbers, Numbers]:
    """Return a point's share of mass, stiffness and size."""
    last, v, w = point.node == len(right) - 1, right[point.node], left[point.node]

    def energies(z: Numbers) -> tuple[Numbers, Numbers]:
        return chain.law.point_energies(point, z, last)

    (inertia, elastic), (less, soft) = energies(w + v), energies(w - v)
    size = energies(v.real)[0] + energies(v.imag)[0] if inertia.any() else 0 * less
    return (inertia - less) / 4, (elastic - soft) / 4, size


def _polar(quadratic: Callable[[Numbers], Numbers], a: Numbers, b: Numbers) -> Numbers:
    """Return a bilinear form from its quadratic one."""
    return np.asarray((quadratic(a + b) - quadratic(a - b)) / 4)
