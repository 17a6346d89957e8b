r"""The characteristic function over that of the base chain, and how far it may move.

With the receptances G of the `base` chain between the displacements where something acts,

    g(s) = D(s)/D_base(-s^2) = det(I + G(-s^2) (K + s C))

has the eigenvalues s for zeros, and those of the base chain, s^2 = -lambda_k, for poles. In the
modes of the base chain ``G_ij = sum_k y_ki y_kj / (m_k (lambda_k - lambda))``, so that with
``S_i = sum_k y_ki^2 / (m_k |lambda_k - lambda|^2) = Im G_ii / Im lambda`` by Cauchy and Schwarz::

    |G_ij(lambda + d) - G_ij(lambda)| <= sqrt(S_i S_j) |d| / (1 - |d|/reach),

reach the distance to the nearest lambda_k. A determinant is at most the product of the sums of
its rows' moduli, a_i, and when entries move by X_ij it moves by no more than
``prod(a_i + sum_j |X_ij|) - prod(a_i)``: of the matrix itself, or over its value of what the
inverse makes of X. That bounds g around every sample.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers
from antinode.riccati.forced import Lanes, Loads, forced_states

from .chain import Damped

_BESIDE = 1e-3  # of the reach: nearer to the axis S is taken from beside
_LEAST = 1e-8  # of S, scaled: what rounding may hide of a combination


class RatioSamples(NamedTuple):
    """Values of g at some places, and how fast it may leave them; see `winding.Bounded`."""

    at: Complex
    value: Complex
    reach: Array
    """Of -s^2 to the nearest eigenvalue of the base chain."""
    matrix: Array
    """Of I + G (K + s C), moduli, scaled by the roots of S, shape (k, r, r)."""
    inverse: Array
    """Of I + G (K + s C), moduli, scaled by the roots of S, shape (k, r, r)."""
    receptance: Array
    """Of G, moduli, scaled."""
    stiffness: Array
    """Of K + s C, moduli, scaled."""
    damping: Array
    """Of C, moduli, scaled."""
    acting: Complex
    """(K + s C) times the inverse, scaled."""
    size: Array
    """The roots of S, shape (k, r)."""

    def spread(self, distance: Array) -> Array:
        """Return how far the function may be from its values within a distance of each."""
        t = distance
        moved = t * (2 * np.abs(self.at) + t)
        near = np.minimum(moved / self.reach, 1.0)
        with np.errstate(all="ignore"):
            tau = np.where(near < 1.0, moved / (1.0 - near), np.inf)[:, None, None]
            t_ = t[:, None, None]
            acting = np.sum(self.stiffness + t_ * self.damping, axis=-2, keepdims=True)
            change = tau * acting + t_ * (self.receptance @ self.damping)
            one = np.broadcast_to(np.eye(change.shape[-1]), change.shape)
            size = np.abs(self.value)
            bounds = [
                size * _moved(one, self.inverse @ change, -1),
                size * _moved(one, self.inverse @ change, -2),
                _moved(self.matrix, change, -1),
                _moved(self.matrix, change, -2),
            ]
            spread = np.nanmin(np.where(np.isnan(bounds), np.inf, bounds), axis=0)
        return np.where(near < 1.0, spread, np.inf)

    def some(self, rows: slice | Integers) -> RatioSamples:
        """Return some of them."""
        values: list[Any] = [column[rows] for column in self]
        return type(self)(*values)

    def joined(self, other: RatioSamples, order: Integers) -> RatioSamples:
        """Return both, in an order."""
        pairs = zip(self, other, strict=True)
        values: list[Any] = [np.concatenate(pair)[order] for pair in pairs]
        return type(self)(*values)


def remainder(most: Array, distance: Array, disc: Array) -> Array:
    """Return how far the function may be from its tangents within a distance of each place.

    By Cauchy's inequality from the bound `most` on a larger disc.
    """
    x = distance / disc
    with np.errstate(all="ignore"):
        return np.where(x < 1, most * x * x / (1 - x), np.inf)


@dataclass(frozen=True)
class Ratio:
    """g of a chain.

    Parameters
    ----------
    damped : Damped
    poles : array
        Eigenvalues of the base chain, ascending, up to one beyond every place asked for.
    """

    damped: Damped
    poles: Array

    @cached_property
    def _loads(self) -> tuple[Loads, Integers]:
        base, acting = self.damped.base, self.damped.acting
        number, d = len(acting.node), base.law.size // 2
        at: dict[int, Array] = {}
        for case, (node, freedom) in enumerate(zip(acting.node, acting.freedom, strict=True)):
            at.setdefault(node, np.zeros((d, number)))[freedom, case] = 1.0
        along = np.zeros((len(base.length), number))
        return Loads(at, along, np.zeros(number)), np.array(sorted(at), dtype=np.int64)

    def receptances(self, omega2: Complex) -> Complex:
        """Return G at omega^2 off the eigenvalues of the base chain, shape (k, r, r)."""
        base, acting = self.damped.base, self.damped.acting
        if not acting.node:
            return np.zeros((len(omega2), 0, 0), complex)
        found = self.damped.other.receptances(omega2)
        if found is not None:
            return found
        loads, nodes = self._loads
        z = forced_states(base, base.columns, Lanes(omega2, 0 * omega2), loads, nodes).left
        rows = np.searchsorted(nodes, acting.node)
        G = np.stack([z[row][:, i] for row, i in zip(rows, acting.freedom, strict=True)], axis=1)
        return np.asarray((G + np.swapaxes(G, -1, -2)) / 2)

    def inverse_norm(
        self, s: Complex, distance: float, sigma: float, *, inertia: bool = False
    ) -> Array:
        """Bound the inverse of A(s) within a distance of each place, in the energy of P.

        ``|| P^(1/2) A^-1 P^(1/2) ||`` with ``P = K_base + sigma M``, or, where `inertia` is asked
        for, ``|| P^(1/2) A^-1 M^(1/2) ||``; infinite where there is none.
        """
        here, omega2 = self.samples(s), -s * s
        moved = distance * (2 * np.abs(s) + distance)
        share = _largest_root if inertia else _largest_share
        base = share(omega2, self.poles, sigma, moved)
        r = here.matrix.shape[-1]
        if not r:
            return base
        energy = np.sqrt(self._energies(omega2, here.reach, sigma)) / here.size
        nearer = 1 - np.minimum(moved / here.reach, 1)[:, None]
        energy = energy / nearer
        other = np.ones(energy.shape) / nearer if inertia else energy
        with np.errstate(all="ignore"):
            tau = np.where(moved < here.reach, moved / (1 - moved / here.reach), np.inf)
            C, t = here.damping, distance
            Z = here.stiffness + t * C
            change = tau[:, None, None] * np.sum(Z, axis=-2, keepdims=True)
            change = change + t * here.receptance @ C
            X = here.inverse @ change
            x = np.sum(X, axis=-1).max(axis=-1)
            one = np.eye(r)
            X = np.where((x < 1)[:, None, None], X, 0.0)
            inverse = np.linalg.inv(one - X) @ here.inverse
            acting = np.abs(here.acting) + (t * C + np.abs(here.acting) @ change) @ inverse
            norm = np.linalg.norm(acting * energy[:, :, None] * other[:, None, :], axis=(-2, -1))
        return np.where((x < 1) & np.isfinite(norm), base + norm, np.inf)

    def _energies(self, omega2: Complex, reach: Array, sigma: float) -> Array:
        """Return T of every displacement, from beside the axis where it is near, (k, r)."""
        near = np.abs(omega2.imag) < _BESIDE * reach
        sign = np.where(omega2.imag < 0, -1.0, 1.0)
        at = np.where(near, omega2 + 1j * sign * _BESIDE * reach, omega2)
        G = np.diagonal(self.receptances(at), axis1=-2, axis2=-1)
        T = ((at[:, None] * G).imag + sigma * G.imag) / at.imag[:, None]
        return np.asarray(np.maximum(T, 0) * (1 + _BESIDE) ** 2)

    def values(self, s: Complex) -> Complex:
        """Return g alone."""
        found = self.damped.other.ratios(s)
        return self.samples(s).value if found is None else found

    def samples(self, s: Complex, *, turned: bool = False) -> RatioSamples:
        """Return g, bounded.

        Parameters
        ----------
        s : array of complex
        turned : bool
            Whether the displacements are combined to those in which S is diagonal.
        """
        found: RatioSamples | None
        found = None if turned else self.damped.other.samples(s, self.poles)
        if found is not None:
            return found
        omega2, acting = -s * s, self.damped.acting
        reach = np.min(np.abs(omega2[:, None] - self.poles), axis=1) * (1 - 1e-9)
        beside = np.abs(omega2.imag) < _BESIDE * reach
        sign = np.where(omega2.imag < 0, -1.0, 1.0)
        shifted = (omega2 + 1j * sign * _BESIDE * reach)[beside]
        G = self.receptances(np.concatenate([omega2, shifted]))
        G, there = G[: len(s)], G[len(s) :]
        imaginary, off = G.imag.copy(), omega2.imag.copy()
        imaginary[beside] = there.imag * (1 + _BESIDE) ** 2
        off[beside] = shifted.imag
        with np.errstate(all="ignore"):
            S = imaginary / off[:, None, None]
        basis = _combinations(S, turned=turned)
        size = np.abs(np.diagonal(basis, axis1=-2, axis2=-1))
        back = np.swapaxes(basis, -1, -2)
        forth = np.linalg.inv(basis)
        scaled = forth @ G @ np.swapaxes(forth, -1, -2)
        Z = back @ (acting.K + s[:, None, None] * acting.C) @ basis
        A = np.eye(len(acting.node)) + scaled @ Z
        with np.errstate(all="ignore"):
            inverse = _inverse(A)
            value, through = np.linalg.det(A), Z @ inverse
        C = np.abs(back @ acting.C @ basis)
        return RatioSamples(
            s,
            value,
            reach,
            np.abs(A),
            np.abs(inverse),
            np.abs(scaled),
            np.abs(Z),
            C,
            through,
            size,
        )


def _combinations(S: Array, *, turned: bool) -> Array:
    """Return B with S <= B B^T, shape (k, r, r): in its columns S is at most 1, and diagonal.

    Beside a pole one combination of the displacements moves much more than all others; a bound
    that takes each displacement by itself would count it as often as there are displacements.
    """
    size = np.sqrt(np.maximum(np.abs(np.diagonal(S, axis1=-2, axis2=-1)), 1e-300))
    number = S.shape[-1]
    if number < 2 or not turned or not np.all(np.isfinite(S)):
        return np.asarray(size[:, :, None] * np.eye(number))
    share, Q = np.linalg.eigh(S / (size[:, :, None] * size[:, None, :]))
    share = np.maximum(share, 0.0) + _LEAST * number
    return np.asarray(size[:, :, None] * Q * np.sqrt(share)[:, None, :])


def _largest_share(omega2: Complex, poles: Array, sigma: float, moved: Array) -> Array:
    """Return the largest ``(l_k + sigma)/(|l_k - l| - d)`` of all l_k, beyond the last too."""
    with np.errstate(over="ignore"):
        above = omega2.real + omega2.imag**2 / np.maximum(omega2.real + sigma, 1e-300)
    beyond = np.maximum(np.where(omega2.real + sigma > 0, above, 0.0), poles[-1])
    known = np.broadcast_to(poles, (len(omega2), len(poles)))
    places = np.concatenate([known, beyond[:, None]], axis=1)
    gap = np.abs(places - omega2[:, None]) - moved[:, None]
    with np.errstate(all="ignore"):
        share = np.where(gap > 0, np.maximum(places + sigma, 0.0) / gap, np.inf)
    far = 1 / (1 - np.minimum(moved / np.maximum(poles[-1], 1e-300), 1 - 1e-12))
    return np.asarray(np.maximum(np.max(share, axis=1), far))


def _largest_root(omega2: Complex, poles: Array, sigma: float, moved: Array) -> Array:
    """Return the largest ``sqrt(l_k + sigma)/(|l_k - l| - d)`` of all l_k, beyond the last too.

    Over l it has one top, at ``sqrt((Re l + sigma)^2 + (Im l)^2) - sigma``.
    """
    known = np.abs(poles - omega2[:, None]) - moved[:, None]
    last = float(poles[-1])
    top = np.hypot(omega2.real + sigma, omega2.imag) - sigma
    far = np.maximum(top, last)
    nearest = np.abs(np.maximum(omega2.real, last) - omega2)
    with np.errstate(all="ignore"):
        share = np.where(known > 0, np.sqrt(np.maximum(poles + sigma, 0)) / known, np.inf)
        beyond = np.sqrt(np.maximum(far + sigma, 0)) / np.abs(far - omega2)
        beyond = np.where(nearest > moved, beyond / (1 - moved / nearest), np.inf)
    return np.asarray(np.maximum(np.max(share, axis=1), beyond))


def _moved(matrix: Array, change: Array, axis: int) -> Array:
    """Bound the change of a determinant by the sums of moduli along an axis, shape (k,)."""
    own, more = np.sum(matrix, axis=axis), np.sum(change, axis=axis)
    with np.errstate(all="ignore"):
        return np.asarray(np.prod(own, axis=-1) * np.expm1(np.sum(np.log1p(more / own), axis=-1)))


def _inverse(A: Complex) -> Complex:
    try:
        return np.asarray(np.linalg.inv(A))
    except np.linalg.LinAlgError:
        return np.full_like(A, np.inf)
