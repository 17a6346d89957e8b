r"""End forces that turn with a free end: the characteristic function beside that of fixed ones.

At an end whose force N turns with the section by a share eta, ``M = 0`` and ``Q = kappa psi`` with
``kappa = eta N``; nothing else changes. The problem is not self-adjoint, and no count of negative
eigenvalues holds. But beside the same chain with fixed directions (kappa = 0) it is small: with the
turns psi_i of the following ends under unit forces Q_j there, G_ij = psi_i/Q_j,

    D = D_fixed g,   g = det(I - G diag(kappa))

so that g has the eigenvalues wanted for zeros, and those of fixed directions for poles. These are
real and known with proof (`riccati.chain`). In their modes

    G_ij = +- sum_k psi_k(x_i) Y_k(x_j) / (m_k (lambda_k - lambda))

and by Cauchy and Schwarz ``|G_ij'|^2 <= S_psi S_Y`` with ``S_Y = sum Y_k^2/(m_k |lambda_k -
lambda|^2) = Im(Y/Q) / Im lambda`` of the end's own receptance, and S_psi likewise: each sample
bounds g around it, which makes its winding number a proof (`riccati.winding`). Far off on the left,
``abs(lambda_k - lambda) >= (lambda_k + abs(lambda)) sin(theta/2)``, theta its argument, and
g is as near to 1 as receptances at -abs(lambda) tell.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers
from antinode.riccati.chain import (
    Chain,
    Steps,
    block_starts,
    end_frame,
    force_for_turn,
    make_steps,
    multiply_groups,
    right_conditions,
    segment_transfers,
    split_long,
    state_units,
    sweep,
)
from antinode.riccati.frames import determinant, turning
from antinode.riccati.winding import Samples

_LARGEST_STACK = 2_000_000  # matrix entries held at once


class Receptances(NamedTuple):
    """What unit forces and moments at the following ends do there, with fixed directions."""

    displacement: Complex
    """Y/Q of each end, shape (ends, k)."""
    turn: Complex
    """psi/M of each end, shape (ends, k)."""
    across: Complex
    """psi of one end for Q of another, shape (ends, ends, k)."""


Kept = dict[bytes, Receptances]
"""Receptances by their omega^2, of chains that differ in nothing but the forces that follow."""


@dataclass(frozen=True)
class Following:
    """A chain with ends whose force follows.

    Parameters
    ----------
    chain : Chain
    kept : dict, optional
        What chains under other end forces, and free at both ends, have asked for already.
    """

    chain: Chain
    kept: Kept | None = None

    @cached_property
    def ends(self) -> tuple[int, ...]:
        """Sides of the ends that follow: 0 and -1."""
        shared = self.kept is not None
        return tuple(side for side in (0, -1) if shared or self.chain.following[side])

    @cached_property
    def kappa(self) -> Array:
        """Of these ends [N]."""
        return np.array([self.chain.following[side] for side in self.ends])

    def values(self, omega2: Array) -> Array:
        """Return the characteristic function at real omega^2, up to a positive factor, (k,)."""
        which = np.zeros(len(omega2), dtype=np.int64)
        return values_under(self.chain, omega2, np.array([self.chain.following]), which)

    def receptances(self, omega2: Array | Complex) -> Receptances:
        """Return the receptances of the chain with fixed directions."""
        kept, key = self.kept, np.asarray(omega2).tobytes()
        if kept is not None and key in kept:
            return kept[key]
        parts = _split(self.chain, omega2, self._receptances)
        found = Receptances(*(np.concatenate(v, axis=-1) for v in zip(*parts, strict=True)))
        if kept is not None:
            kept[key] = found
        return found

    def samples(self, omega2: Complex, reach: Array) -> Samples:
        """Return g off the real axis, bounded within the distance `reach` of any fixed eigenvalue.

        Parameters
        ----------
        omega2 : array of complex, shape (k,)
        reach : array, shape (k,)
            Distance to the nearest eigenvalue of the chain with fixed directions, at the most.
        """
        Y, psi, G = self.receptances(omega2)
        H = G * self.kappa[None, :, None]
        off = np.abs(omega2.imag)
        size_Y, size_psi = np.abs(Y.imag) / off, np.abs(psi.imag) / off
        slope = np.sqrt(size_psi[:, None] * size_Y[None]) * np.abs(self.kappa)[None, :, None]
        if len(self.ends) == 1:
            return Samples(omega2, 1 - H[0, 0], slope[0, 0], 0 * off, reach)
        value = (1 - H[0, 0]) * (1 - H[1, 1]) - H[0, 1] * H[1, 0]
        first = slope[0, 0] * np.abs(1 - H[1, 1]) + slope[1, 1] * np.abs(1 - H[0, 0])
        first = first + slope[0, 1] * np.abs(H[1, 0]) + slope[1, 0] * np.abs(H[0, 1])
        second = slope[0, 0] * slope[1, 1] + slope[0, 1] * slope[1, 0]
        return Samples(omega2, value, first, second, reach)

    def ratio(self, omega2: Complex) -> Complex:
        """Return g."""
        H = self.receptances(omega2).across * self.kappa[None, :, None]
        if len(self.ends) == 1:
            return np.asarray(1 - H[0, 0])
        return np.asarray((1 - H[0, 0]) * (1 - H[1, 1]) - H[0, 1] * H[1, 0])

    def far_off(self, distance: Array) -> Array:
        """Return q, for abs(g - 1) on all that is as far off zero: `beyond`.

        Parameters
        ----------
        distance : array, shape (k,)
            Beyond -distance there is no eigenvalue with fixed directions.
        """
        Y, psi, _ = self.receptances(-distance)
        size = np.sqrt(np.abs(Y.real) * np.abs(psi.real)) * np.abs(self.kappa)[:, None]
        return np.asarray(size)

    def _receptances(
        self, fine: Chain, rows: slice, steps: Steps, units: Array
    ) -> tuple[Complex, Complex, Complex]:
        fixed, number, lanes = fine.fixed, len(self.ends), len(units)
        Y, psi = np.zeros((2, number, lanes), complex)
        across = np.zeros((number, number, lanes), complex)
        for j, side in enumerate(self.ends):
            from_other = sweep(
                steps if side else steps.reversed(), end_frame(fixed, -1 - side, units)
            )
            F = from_other.F[-1]
            own = _receptance(F[:, :2], F[:, 2:])
            Y[j] = own[:, 0, 1] * units[:, 0] / units[:, 3]
            psi[j] = own[:, 1, 0] * units[:, 1] / units[:, 2]
            across[j, j] = own[:, 1, 1] * units[:, 1] / units[:, 3]
            if number > 1:
                there = _receptance(_product(from_other.back), F[:, 2:])
                across[1 - j, j] = there[:, 1, 1] * units[:, 1] / units[:, 3]
        return Y, psi, across


def values_under(chain: Chain, omega2: Array, following: Array, which: Integers) -> Array:
    """Return the characteristic function under several end forces, up to positive factors, (k,).

    Parameters
    ----------
    chain : Chain
    omega2 : array, shape (k,)
        Real [rad^2/s^2].
    following : array, shape (c, 2)
        The part of the forces at both ends that turns with them [N].
    which : array of int, shape (k,)
        The end forces under which each omega^2 is asked about.
    """
    kappa = following[which]

    def each(fine: Chain, rows: slice, steps: Steps, units: Array) -> Array:
        fixed, turns = fine.fixed, force_for_turn(kappa[rows], units)
        frames = sweep(steps, turning(end_frame(fixed, 0, units), turns[:, 0], adjoint=False))
        conditions = right_conditions(fixed, units).copy()
        conditions[:, -1, 1] -= turns[:, 1]
        return np.asarray(frames.factor * determinant(conditions @ frames.F[-1]))

    return np.concatenate(_split(chain, omega2, each))


def _split(chain: Chain, omega2: Any, function: Callable[..., Any]) -> list[Any]:
    """Return what a function makes of the steps of a chain, so many lanes at once."""
    largest = float(np.max(np.abs(omega2)))
    fine = split_long(chain, largest)
    starts = block_starts(fine, largest)
    together = max(1, _LARGEST_STACK // (16 * len(fine.length)))
    found = []
    for i in range(0, len(omega2), together):
        rows = slice(i, i + together)
        lanes = omega2[rows]
        units = state_units(fine, lanes)
        blocks = multiply_groups(segment_transfers(fine, lanes), starts)
        found.append(function(fine, rows, make_steps(fine, lanes, blocks, starts), units))
    return found


def beyond(q: Array, sine: float) -> Array:
    """Return a bound on abs(g - 1) where ``sin(theta/2)`` is at least so much, from `far_off`."""
    h = q / sine
    return np.asarray(np.sum(h, axis=0) + (2 * np.prod(h, axis=0) if len(h) > 1 else 0.0))


def _receptance(displacement: Complex, force: Complex) -> Complex:
    """Return displacements for unit forces, shape (k, 2, 2)."""
    a, b, c, d = force[:, 0, 0], force[:, 0, 1], force[:, 1, 0], force[:, 1, 1]
    adjugate = np.stack([np.stack([d, -b], -1), np.stack([-c, a], -1)], -2)
    with np.errstate(all="ignore"):
        return np.asarray(displacement @ adjugate / (a * d - b * c)[:, None, None])


def _product(back: Any) -> Complex:
    """Return the coefficients at the start for those at the end, shape (k, 2, 2)."""
    total = back[1]
    for matrix in back[2:]:
        total = total @ matrix
    return np.asarray(total)
