"""Shapes of complex modes: the states that both ends admit at an eigenvalue s.

Frames from the two ends are matched at the node where they come closest, as `riccati.shapes` does;
where a feedback is not symmetric no symplectic product tells that, but the smallest singular value
of both frames side by side.
"""

from __future__ import annotations

import numpy as np

from antinode.riccati.arrays import Complex, Numbers
from antinode.riccati.chain import Steps, end_frame, sweep
from antinode.riccati.shapes import carry_outwards, fill_blocks, kept_nodes

from .chain import Damped


def complex_states(damped: Damped, s: Complex) -> Complex:
    """Return the states of modes at every node, on its right side; at the last on its left.

    Parameters
    ----------
    damped : Damped
    s : array of complex, shape (k,)
        Eigenvalues [1/s].

    Returns
    -------
    array of complex, shape (n + 1, k, c)
        The law's components in SI, up to one factor for each mode.
    """
    found = damped.other.states(s)
    if found is not None:
        return found
    fine, U, starts, steps, units = damped.passed(s)
    left = sweep(steps, end_frame(fine, 0, units).astype(complex))
    back = sweep(_reversed(steps, damped.turns), end_frame(fine, -1, units).astype(complex))
    right = back._replace(F=back.F[::-1], R=back.R[::-1], back=back.back[::-1])
    both = np.concatenate([left.F, -right.F], axis=-1)
    _, gap, rows = np.linalg.svd(both)
    node = np.argmin(gap[..., -1], axis=0)
    lane, d = np.arange(len(s)), left.F.shape[-1]
    null = rows[node, lane, -1].conj()
    state = np.einsum("ksd,kd->ks", left.F[node, lane], null[:, :d])
    z: Numbers = carry_outwards(left, right, node, np.asarray(state))
    block = np.flatnonzero(np.array(steps.kind) == "block")
    states = fill_blocks(z[np.append(block, block[-1] + 1)], U, starts) * units
    return np.asarray(states[kept_nodes(damped.chain, fine)])


def _reversed(steps: Steps, turning: bool) -> Steps:
    """Return the steps as passed from the right; those of points are 1 + a square root of zero."""
    turned = steps.reversed()
    U = turned.U.copy()
    block = [i for i, kind in enumerate(turned.kind) if kind == "block"]
    if turning:  # J^T-inverses are of the adjoint
        U[block] = np.linalg.inv(steps.U[::-1][block])
    one = np.eye(U.shape[-1])
    for i, kind in enumerate(turned.kind):
        if kind in ("load", "joint"):
            U[i] = 2 * one - steps.U[len(U) - 1 - i]
    return turned._replace(U=U)
