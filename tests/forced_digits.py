"""Forced beams of uniform intervals in sixty digits: transfer matrices multiplied as they are.

Nothing is shared with the solver: no basis is taken anew, no unit is chosen, and exponentials of
the law's own matrix stand for its series. Sixty digits outlast what grows along some thirty waves.
"""

from __future__ import annotations

import mpmath as mp

import antinode as an

DIGITS = 60


def _rates(beam, k, omega, eta):
    """Return A of z' = A z, z = [Y, psi, M, Q], with shear by Haringx, in one interval."""

    def column(name, absent=0.0):
        table = getattr(beam, name)
        return mp.mpf(absent if table is None else float(table[k, 0]))

    w2, N = mp.mpf(omega) ** 2, column("axial_force")
    loss = 1 + 1j * (mp.mpf(eta) + column("loss_factor"))
    EI, kGA = column("bending_stiffness") * loss, column("shear_stiffness", mp.inf) * loss
    m = column("mass_per_length") + column("added_mass_per_length")
    alpha, s = (1, mp.mpf(0)) if mp.isinf(kGA.real) else (1 + N / kGA, 1 / kGA)
    beta = alpha * N + column("rotary_inertia_per_length") * w2
    mu = m * w2 - column("foundation_stiffness")
    return mp.matrix([[0, alpha, 0, -s], [0, 0, 1 / EI, 0], [0, -beta, 0, alpha], [mu, 0, 0, 0]])


def _jumps(items, omega):
    """Return what masses, springs and dashpots at a node do: M+ = M- + ..., Q+ = Q- + ..."""
    w2, T = mp.mpf(omega) ** 2, mp.eye(4)
    for item in items:
        if isinstance(item, an.PointMass):
            m, d, J = (mp.mpf(v) for v in (item.mass, item.offset, item.rotary_inertia))
            T[3, 0] += m * w2
            T[3, 1] += m * w2 * d
            T[2, 0] -= m * w2 * d
            T[2, 1] -= w2 * (m * d * d + J)
        elif isinstance(item, an.Spring):
            T[3, 0] -= mp.mpf(item.translational)
            T[2, 1] += mp.mpf(item.rotational)
        elif isinstance(item, an.Dashpot):
            T[3, 0] -= 1j * mp.mpf(omega) * mp.mpf(item.translational)
            T[2, 1] += 1j * mp.mpf(omega) * mp.mpf(item.rotational)
    return T


_FREE = {"free": (0, 1), "clamped": (2, 3), "pinned": (1, 3), "sliding": (0, 2)}


def states(beam, omega, eta, force, moment=0.0):
    """Return states left and right of every breakpoint under a unit force at `force` [m]."""
    with mp.workdps(DIGITS):
        free = _FREE[beam.ends.left]
        z = mp.zeros(4, 3)
        for column, row in enumerate(free):
            z[row, column] = 1
        follow = [mp.mpf(v) for v in beam.following("bending")]
        if follow[0]:
            z[3, 1] = follow[0]  # Q = kappa psi
        left, right = [], []
        for node, x in enumerate(beam.x.tolist()):
            if node:
                A = _rates(beam, node - 1, omega, eta)
                z = mp.expm(A * mp.mpf(x - beam.x[node - 1]), method="taylor") * z
            left.append(z.copy())
            here = [item for item in beam.attachments if item.x == x]
            z = _jumps(here, omega) * z
            if x == force:
                z[3, 2] += mp.mpf(1) - mp.mpf(moment)
                z[2, 2] -= mp.mpf(moment)
            for joint in (item for item in here if isinstance(item, an.Joint)):
                for column in range(3):
                    z[1, column] += z[2, column] * mp.mpf(joint.rotational)
            right.append(z.copy())
        zero = [row for row in range(4) if row not in _FREE[beam.ends.right]]
        C, r = mp.zeros(2, 2), mp.zeros(2, 1)
        for i, row in enumerate(zero):
            values = [z[row, k] for k in range(3)]
            if row == 3 and follow[1]:
                values = [value - follow[1] * z[1, k] for k, value in enumerate(values)]
            C[i, 0], C[i, 1], r[i] = values[0], values[1], -values[2]
        a = mp.lu_solve(C, r)
        full = mp.matrix([a[0], a[1], 1])
        return [[complex(v) for v in z * full] for z in left], [
            [complex(v) for v in z * full] for z in right
        ]
