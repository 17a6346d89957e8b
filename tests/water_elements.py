"""A vehicle on the water's stiffness as dense matrices of hp elements, put together by hand."""

from dataclasses import replace

import numpy as np
import scipy.linalg

import antinode as an
from forced_beam import HpResponse


def case_of(path, speed=None, **model):
    wanted = {"theory": "euler_bernoulli", "hydrodynamic_stiffness": "tangent"} | model
    given = [f"model.{key}={value}" for key, value in wanted.items()]
    return an.load_case(path, [*given, *([f"condition.speed={speed}"] if speed else [])])


def dense(case):
    """Eigenvalues of hp matrices with every tangent and end force put in by hand, im >= 0."""
    return lowest(*matrices(case))


def matrices(case, off=()):
    """K, C and M of hp elements with every tangent and end force put in by hand; some are off."""
    loads = case.loads
    beam = replace(case.beam(), attachments=(), ends=an.Ends())
    beam = beam.with_breakpoints([t.x for t in case.tangents])
    mesh = HpResponse(beam, 0.0, count=7, degree=7)
    K, C, M = mesh.K.real.copy(), mesh.C.copy(), mesh.M
    for t in (t for t in case.tangents if t.name not in off):
        own = [mesh.dof(t.x, 0), mesh.dof(t.x, 1)]
        K[np.ix_(own, own)] += t.stiffness
        C[np.ix_(own, own)] += t.damping
    F_x0 = np.hypot(loads.F_CX, loads.F_CY) / np.cos(loads.cavity.alpha)
    # the disk's pressure turns with the nose and pushes up, the thrust with the tail and down
    K[mesh.dof(0.0, 0), mesh.dof(0.0, 1)] -= F_x0 * np.cos(2 * loads.cavity.alpha)
    K[mesh.dof(beam.x[-1], 0), mesh.dof(beam.x[-1], 1)] += case.model.follow[1] * loads.thrust
    return K, C, M


def lowest(K, C, M, shift=20.0):
    """Eigenvalues near a shift, im >= 0, by what is inverted: meshes this fine leave no other."""
    d = 1 / np.sqrt(np.abs(np.diag(K)) + shift**2 * np.diag(M))
    K, C, M = (A * np.outer(d, d) for A in (K, C, M))
    P = scipy.linalg.lu_factor(K + shift * C + shift**2 * M)
    # (s^2 M + s C + K) u = 0 as theta (u, s u) = T (u, s u), theta = 1/(s - shift)
    top = -scipy.linalg.lu_solve(P, np.hstack([C + shift * M, M]))
    one = np.eye(len(K))
    T = np.vstack([top, np.hstack([one, 0 * one]) + shift * top])
    theta = scipy.linalg.eigvals(T)
    s = shift + 1 / theta[np.abs(theta) > 1e-4]
    s = s[s.imag > -1e-6]
    return s[np.argsort(np.abs(s))]
