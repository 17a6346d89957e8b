"""What sits at a node of a chain: masses, springs, supports and in-line joints, as transfer steps.

A point changes the state between its two sides. From the energy of each (docs/theory/beam.md), in
bending, for a mass m_p whose centre lies d to the right of the node and has the inertia J, springs
to ground k and k_r, the mass' own axial force P along +x, and a joint of rotational compliance f::

    Q+ = Q- + omega^2 m_p (Y + d theta) - k Y
    M+ = M- - omega^2 [m_p d (Y + d theta) + J theta] + k_r theta + P d theta
    theta+ = theta- + f M

and longitudinally ``Q+ = Q- + omega^2 m_p X - k X``, ``X+ = X- - f Q``. A support (an infinite
spring) holds Y, theta or X at zero and leaves the conjugate force free to jump.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .arrays import Array

StepKind = Literal["block", "load", "support", "joint"]


@dataclass(frozen=True)
class Point:
    """Everything at one node of a chain, for one family of modes.

    Parameters
    ----------
    node : int
        0 ... n.
    mass, offset, inertia : float
        m_p [kg], d [m], J [kg m^2]; longitudinally only the mass counts.
    spring, rotational_spring : float
        k [N/m] and k_r [N m/rad].
    holds : tuple of int
        State components held at zero by supports: 0 (Y or X), 1 (theta).
    compliance : float
        f of the joint [rad/(N m)], or [m/N] longitudinally.
    own_load : float
        P [N], by which N jumps because of this mass, acting through its centre.
    """

    node: int
    mass: float = 0.0
    offset: float = 0.0
    inertia: float = 0.0
    spring: float = 0.0
    rotational_spring: float = 0.0
    holds: tuple[int, ...] = ()
    compliance: float = 0.0
    own_load: float = 0.0

    @property
    def loads(self) -> bool:
        """Whether a mass or a finite spring acts here."""
        values = (self.mass, self.inertia, self.spring, self.rotational_spring)
        return any(value != 0.0 for value in values)

    def steps(self, size: int, omega2: Array, units: Array) -> Iterator[tuple[StepKind, Array]]:
        """Yield the steps of this point from left to right, with their scaled matrices.

        Parameters
        ----------
        size : int
            4 in bending, 2 longitudinally.
        omega2 : array, shape (k,)
        units : array, shape (k, s)
            SI value of one unit of each scaled state component.
        """
        if self.holds:
            yield "support", np.broadcast_to(np.eye(size), (len(omega2), size, size))
        if self.loads:
            yield "load", _scaled(self._load(size, omega2), units)
        if self.compliance:
            yield "joint", _scaled(self._joint(size, len(omega2)), units)

    def _load(self, size: int, omega2: Array) -> Array:
        T = np.tile(np.eye(size), (len(omega2), 1, 1))
        if size == 2:
            T[:, 1, 0] = omega2 * self.mass - self.spring
            return T
        m, d, J = self.mass, self.offset, self.inertia
        T[:, 3, 0] = omega2 * m - self.spring
        T[:, 3, 1] = omega2 * m * d
        T[:, 2, 0] = -omega2 * m * d
        T[:, 2, 1] = -omega2 * (m * d * d + J) + self.rotational_spring + self.own_load * d
        return T

    def _joint(self, size: int, lanes: int) -> Array:
        T = np.tile(np.eye(size), (lanes, 1, 1))
        if size == 2:
            T[:, 0, 1] = -self.compliance
        else:
            T[:, 1, 2] = self.compliance
        return T


def _scaled(T: Array, units: Array) -> Array:
    return np.asarray(T * units[:, None, :] / units[:, :, None])


def hold(F: Array, rows: tuple[int, ...]) -> tuple[Array, Array, Array]:
    """Pass a frame through a support that holds displacements at zero.

    Parameters
    ----------
    F : array, shape (k, s, d)
        Frame on the left.
    rows : tuple of int
        Which displacements are held.

    Returns
    -------
    F : array, shape (k, s, d)
        Frame on the right: the states that obey the support, with the reactions free.
    back : array, shape (k, d, d)
        Coefficients on the left are these times those on the right.
    factor : array, shape (k,)
        What the part on the left adds to the characteristic function where it is cut off.
    """
    lanes, size, d = F.shape
    new, back = np.zeros_like(F), np.zeros((lanes, d, d))
    if len(rows) == d:  # everything held: what follows knows nothing of what came before
        new[:, d:] = np.eye(d)
        return new, back, np.linalg.det(F[:, :d])
    row, force = rows[0], size - 1 - rows[0]
    a = np.stack([F[:, row, 1], -F[:, row, 0]], axis=-1)
    a = np.where(np.any(a, axis=-1, keepdims=True), a, np.array([1.0, 0.0]))
    state = np.einsum("ksd,kd->ks", F, a)
    state[:, [row, force]] = 0.0
    length = np.linalg.norm(state, axis=-1, keepdims=True)
    length = np.where(length > 0, length, 1.0)
    new[:, :, 0], new[:, force, 1] = state / length, 1.0
    back[:, :, 0] = a / length
    return new, back, np.ones(lanes)
