"""The paper's two characteristic functions as written: transfer matrices and Riccati recursion.

Equations 63-66 multiply the transfer matrices of all segments; equations 67-80 carry S instead.
They serve `--method tmm`, figures, and the comparison with the frames of `antinode.riccati.chain`,
which compute the same zeros without overflow (63) and without poles (74).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .arrays import Array
from .chain import (
    Chain,
    evaluate,
    make_steps,
    omega2_scale,
    segment_transfers,
    split_long,
)
from .roots import CountingError, Eigenvalue


def _left_partition(chain: Chain) -> tuple[list[int], list[int]]:
    """Return the state components that the left end leaves free (Z_a) and sets to zero (Z_b)."""
    zero = chain.law.zeros(chain.left)
    return [i for i in range(chain.law.size) if i not in zero], zero


def _all_steps(fine: Chain, lanes: Array) -> Array:
    """Return the matrices of all segments and points from left to right, (steps, k, s, s)."""
    steps = make_steps(fine, lanes, segment_transfers(fine, lanes), np.arange(len(fine.length)))
    if "support" in steps.kind:
        raise CountingError(
            "a support inside the span has no transfer matrix; use the default method"
        )
    if steps.pedestals:
        raise CountingError(
            "a mass between two springs has a stiffness with a pole; use the default method"
        )
    return steps.U


def tmm_characteristic(chain: Chain, omega2: npt.ArrayLike) -> Array:
    """Return the characteristic determinant of the transfer matrix method (equations 63-66).

    Parameters
    ----------
    chain : Chain
    omega2 : array_like, shape (k,)
        [rad^2/s^2].

    Returns
    -------
    array, shape (k,)
        Scaled by a positive factor. It loses its sign to rounding, without a warning, where the
        growth exp(lambda L) of the solutions nears 1e16.
    """
    lanes = np.atleast_1d(np.asarray(omega2, dtype=float))
    fine = split_long(chain, float(np.max(np.abs(lanes))))
    U_all = np.eye(chain.law.size)
    for U in _all_steps(fine, lanes):
        U_all = U @ U_all
        U_all = U_all / np.max(np.abs(U_all), axis=(-2, -1), keepdims=True)
    free, _ = _left_partition(chain)
    rows = chain.law.zeros(chain.right)
    return np.asarray(np.linalg.det(U_all[:, rows][:, :, free]))


def riccati_characteristic(chain: Chain, omega2: npt.ArrayLike) -> Array:
    """Return the Riccati characteristic function with its product of signs (equations 74, 79, 80).

    Parameters
    ----------
    chain : Chain
    omega2 : array_like, shape (k,)
        [rad^2/s^2].

    Returns
    -------
    array, shape (k,)
        ``prod sgn det(U11 + U12 S_i) * det(rows of [1; S_n] that the right end sets to zero)``,
        with the state split as the left end asks (Z_b is what it sets to zero); for two free
        ends exactly equation 80. NaN where a step meets a pole of S exactly.
    """
    lanes = np.atleast_1d(np.asarray(omega2, dtype=float))
    fine = split_long(chain, float(np.max(np.abs(lanes))))
    a, b = _left_partition(chain)
    S = np.zeros((len(lanes), len(b), len(a)))
    sign = np.ones(len(lanes))  # NaN from a pole on
    for U in _all_steps(fine, lanes):
        U11, U12 = U[:, a][:, :, a], U[:, a][:, :, b]
        U21, U22 = U[:, b][:, :, a], U[:, b][:, :, b]
        denominator = U11 + U12 @ S
        determinant = np.linalg.det(denominator)
        sign *= np.where(determinant == 0.0, np.nan, np.sign(determinant))
        denominator[determinant == 0.0] = np.eye(len(a))
        S = (U21 + U22 @ S) @ np.linalg.inv(denominator)
    state = np.empty((len(lanes), len(a) + len(b), len(a)))
    state[:, a], state[:, b] = np.eye(len(a)), S
    return np.asarray(sign * np.linalg.det(state[:, chain.law.zeros(chain.right)]))


def find_eigenvalues_tmm(
    chain: Chain, wanted: int, *, below: float, above: float, zeros: int = 0
) -> list[Eigenvalue]:
    """Return what a scan of the transfer matrix determinant finds, as its users do it.

    Parameters
    ----------
    chain : Chain
    wanted : int
        Stop after so many eigenvalues.
    below, above : float
        Range of omega^2 to scan [rad^2/s^2].
    zeros : int
        How many exact zeros the supports leave; they are not looked for.

    Returns
    -------
    list of Eigenvalue
        Brackets by sign change; `counts` are true counts at their ends, so that a missed or a false
        root shows: they then do not step by one.
    """
    floor = 1e-9 * omega2_scale(chain)
    spread = np.linspace(0.0, 1.0, 40 * (wanted + 1))[1:]
    scan = np.concatenate([below * spread[::-1] ** 2, floor * np.array([-1, 1]), above * spread**4])
    scan = np.unique(scan)
    values = tmm_characteristic(chain, scan)
    change = np.flatnonzero((values[1:] * values[:-1] < 0) & ~((scan[:-1] < 0) & (scan[1:] > 0)))
    low, high = _bisect(chain, scan[change], scan[change + 1], values[change])
    at_zero = int(np.sum(low < 0)) if len(low) else 0
    counts = evaluate(chain, np.concatenate([low, high, [-floor, floor]])).below
    pairs = zip(low, high, counts[: len(low)], counts[len(low) : -2], strict=True)
    found = [((a + b) / 2, (float(a), float(b)), (int(m), int(n))) for a, b, m, n in pairs]
    rigid = [(0.0, (-floor, floor), (int(counts[-2]), int(counts[-1])))] * zeros
    listed = [*found[:at_zero], *rigid, *found[at_zero:]][:wanted]
    return [Eigenvalue(k + 1, float(w), ends, n) for k, (w, ends, n) in enumerate(listed)]


def _bisect(chain: Chain, low: Array, high: Array, value: Array) -> tuple[Array, Array]:
    """Halve all brackets of a sign change together, to 1e-9 of omega^2."""
    for _ in range(60):
        if not len(low) or np.all(high - low <= 1e-9 * np.maximum(np.abs(low), np.abs(high))):
            break
        middle = (low + high) / 2
        here = tmm_characteristic(chain, middle)
        right = here * value > 0
        low, high = np.where(right, middle, low), np.where(right, high, middle)
        value = np.where(right, here, value)
    return low, high
