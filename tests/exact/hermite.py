"""A second opinion on attachments: cubic Hermite finite elements with points, in float64.

Shares no code and no idea with the solver: energy matrices and `M v = mu (K + shift M) v`, which
keeps the digits of the low modes that `K v = lambda M v` loses on many short elements.
"""

from itertools import pairwise

import numpy as np
from scipy.linalg import eigh

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(6)


def beam_matrices(beam, elements=40):
    """K (less axial force) and M of a stepped beam with its attachments, and the kept freedoms.

    Joints get a second slope at their node; supports drop freedoms.
    """
    nodes = np.concatenate(
        [np.linspace(a, b, elements, endpoint=False) for a, b in pairwise(beam.x)] + [beam.x[-1:]]
    )
    joints = {}
    for item in beam.attachments:
        if type(item).__name__ == "Joint":
            at = int(np.argmin(np.abs(nodes - item.x)))
            joints[at] = joints.get(at, 0.0) + item.rotational
    size = 2 * len(nodes) + len(joints)
    right_slope = {at: 2 * len(nodes) + k for k, at in enumerate(joints)}
    K, M = np.zeros((size, size)), np.zeros((size, size))
    for e in range(len(nodes) - 1):
        k = e // elements
        index = [2 * e, right_slope.get(e, 2 * e + 1), 2 * e + 2, 2 * e + 3]
        values = (t[k, 0] for t in (beam.mass_per_length, beam.bending_stiffness, beam.axial_force))
        element_K, element_M = element(nodes[e + 1] - nodes[e], *values)
        K[np.ix_(index, index)] += element_K
        M[np.ix_(index, index)] += element_M
    held = _attach(beam, nodes, joints, right_slope, K, M)
    return K, M, [i for i in range(size) if i not in held]


def element(h, m, EI, N):
    K, M = np.zeros((4, 4)), np.zeros((4, 4))
    for p, w in zip(_POINTS, _WEIGHTS, strict=True):
        s = (p + 1) / 2
        f = np.array(
            [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3,
             h * (s**3 - s**2)]
        )  # fmt: skip
        f1 = np.array(
            [-6 * s + 6 * s**2, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2,
             h * (3 * s**2 - 2 * s)]
        ) / h  # fmt: skip
        f2 = np.array([-6 + 12 * s, h * (-4 + 6 * s), 6 - 12 * s, h * (6 * s - 2)]) / h**2
        K += w * h / 2 * (EI * np.outer(f2, f2) - N * np.outer(f1, f1))
        M += w * h / 2 * m * np.outer(f, f)
    return K, M


def _attach(beam, nodes, joints, right_slope, K, M):
    held = set()
    holds = {"free": (), "pinned": (0,), "sliding": (1,), "clamped": (0, 1)}
    last = 2 * (len(nodes) - 1)
    held |= set(holds[beam.ends.left]) | {last + i for i in holds[beam.ends.right]}
    for at, compliance in joints.items():
        a, b = 2 * at + 1, right_slope[at]
        K[np.ix_([a, b], [a, b])] += np.array([[1, -1], [-1, 1]]) / compliance
    for item in beam.attachments:
        at = 2 * int(np.argmin(np.abs(nodes - item.x)))
        if type(item).__name__ == "PointMass":
            d, J, mass = item.offset, item.rotary_inertia, item.mass
            M[at : at + 2, at : at + 2] += mass * np.array([[1, d], [d, d * d + J / mass]])
            if beam.offset_weight:
                K[at + 1, at + 1] += beam.axial_acceleration * mass * d
        elif type(item).__name__ == "Spring":
            K[at, at + 1] += item.coupling
            K[at + 1, at] += item.coupling
            for i, stiffness in enumerate((item.translational, item.rotational)):
                if np.isinf(stiffness):
                    held.add(at + i)
                else:
                    K[at + i, at + i] += stiffness
    return held


def eigenvalues(beam, count, elements=40, shift=100.0):
    """The lowest eigenvalues omega^2, negative (above -shift) and zero ones included."""
    K, M, keep = beam_matrices(beam, elements)
    K, M = K[np.ix_(keep, keep)], M[np.ix_(keep, keep)]
    K = K + shift * M
    d = 1 / np.sqrt(np.diag(K))
    K, M = K * np.outer(d, d), M * np.outer(d, d)
    n = len(keep)
    mu = eigh(M, K, eigvals_only=True, subset_by_index=[n - count, n - 1])
    return 1 / mu[::-1] - shift
