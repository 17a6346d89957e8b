"""Histories where forces depend on motion, against hp elements integrated over time directly.

The reference has no modes and no chains: Hermite elements with bubbles on two meshes, the force of
an end and the feedback as entries of their matrices, the exponential of all of it from point to
point of the force.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from antinode.beam.attachments import Dashpot, PointFeedback, PointMass
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.modes.solve import solve_modes
from antinode.response.damping import Damping
from antinode.response.frequency import Model
from antinode.response.histories import History
from antinode.response.motion.loops import Closed, summed
from antinode.response.quantities import Force, Output
from antinode.response.transient import respond
from forced_beam import HpResponse

PLACE, SEEN, END = 0.6, 0.25, 1.2
OUTPUTS = [
    Output(END, "displacement"),
    Output(SEEN, "slope"),
    Output(SEEN, "velocity"),
    Output(END, "acceleration"),
]


def beams():
    free = {"x": [0.0, SEEN, PLACE, END], "mass_per_length": 1.3, "bending_stiffness": 2.0}
    rising = np.array([0.0, SEEN, PLACE, END]) / END
    follows = Ends("clamped", right_follower=1.0)
    column = Beam.from_stations(**free, axial_force=9.0, ends=follows)
    flying = Beam.from_stations(
        **free, axial_force=6.0 * rising, interpolation="linear", ends=Ends(right_follower=1.0)
    ).with_attachments(PointMass(SEEN, 0.2))
    pushed = Beam.from_stations(
        **free, axial_force=[4.0] * 4, ends=Ends(left_follower=1.0, right_follower=0.5)
    )
    fed = Beam.from_stations(**free, ends=Ends("clamped")).with_attachments(
        PointFeedback.of(PLACE, [[9.0, 4.0], [-3.0, 0.5]], [[0.4, 0.1], [-0.05, 0.02]]),
        Dashpot(SEEN, 0.5),
    )
    return {"column": column, "flying": flying, "pushed": pushed, "fed": fed}


def matrices(beam, count):
    """The hp elements' matrices with what depends on motion as entries."""
    fed = [item for item in beam.attachments if isinstance(item, PointFeedback)]
    rest = tuple(item for item in beam.attachments if item not in fed)
    ends = replace(beam.ends, left_follower=0.0, right_follower=0.0)
    mesh = HpResponse(replace(beam, attachments=rest, ends=ends), 0.0, count=count)
    K, C, M = mesh.K.real.copy(), mesh.C.copy(), mesh.M
    for x, force, sign in zip((0.0, END), beam.following(), (-1, 1), strict=True):
        K[mesh.dof(x), mesh.dof(x, 1)] += sign * force
    for item in fed:
        dofs = [mesh.dof(item.x), mesh.dof(item.x, 1)]
        K[np.ix_(dofs, dofs)] += item.stiffness
        C[np.ix_(dofs, dofs)] += item.damping
    some = np.ix_(mesh.free, mesh.free)
    return mesh, K[some], C[some], M[some]


def integrated(beam, load, count):
    """Outputs at the times of the load: the elements' own exponential from point to point."""
    mesh, K, C, M = matrices(beam, count)
    d = 1 / np.sqrt(np.diag(M))
    K, C, M = (A * np.outer(d, d) for A in (K, C, M))
    n, h = len(K), load.time_s[1] - load.time_s[0]
    where = {i: int(np.searchsorted(mesh.free, i)) for i in mesh.free}
    b = np.zeros(n)
    b[where[mesh.dof(PLACE)]] = d[where[mesh.dof(PLACE)]]
    A = np.zeros((2 * n + 2, 2 * n + 2))  # (q, rate, force, change of the force in a step)
    A[:n, n : 2 * n] = np.eye(n) * h
    A[n : 2 * n, : 2 * n + 1] = h * np.linalg.solve(M, np.hstack([-K, -C, b[:, None]]))
    A[2 * n, 2 * n + 1] = 1.0
    E = expm(A)[: 2 * n]
    z = np.zeros((len(load.time_s), 2 * n))
    for k, (u, change) in enumerate(zip(load.value[:-1], np.diff(load.value), strict=True)):
        z[k + 1] = E[:, : 2 * n] @ z[k] + E[:, 2 * n] * u + E[:, 2 * n + 1] * change
    a = np.linalg.solve(M, b[:, None] * load.value - C @ z[:, n:].T - K @ z[:, :n].T)
    e, s, r = where[mesh.dof(END)], where[mesh.dof(SEEN, 1)], where[mesh.dof(SEEN)]
    return np.array([d[e] * z[:, e], d[s] * z[:, s], d[r] * z[:, n + r], d[e] * a[e]])


def push(end):
    """A smooth push, as a table whose chords are what both solve."""
    time = np.linspace(0, end, 161)
    shape = np.where(time < 0.5 * end, np.sin(2 * np.pi * time / end) ** 4, 0.0)
    return History(time, shape)


@pytest.mark.parametrize("name", list(beams()))
def test_histories_against_direct_integration(name):
    """The stated error covers the distance, and is small."""
    beam, end = beams()[name], 2.0
    load = push(end)
    coarse, exact = (integrated(beam, load, count) for count in (10, 20))
    doubt = np.max(np.abs(exact - coarse), axis=1)
    model = Model(beam, [Force(PLACE)], OUTPUTS, Damping(), 10.0)
    for modes in (6, 12, 24):
        y, error, _, driven, _, _ = respond(model, (load,), load.time_s, modes)
        away = np.max(np.abs(y[:, driven.asked] - exact), axis=1)
        assert np.all(away <= error + doubt), (modes, away, error, doubt)
    size = np.max(np.abs(exact), axis=1)
    assert np.all(away[:3] < 1e-3 * size[:3] + doubt[:3])
    assert np.all(error < np.array([1e-2, 1e-2, 2e-2, 0.2]) * size)


@pytest.mark.parametrize("name", list(beams()))
def test_its_zeros_are_the_complex_modes(name):
    beam = beams()[name]
    model = Model(beam, [Force(PLACE)], OUTPUTS, Damping(), 10.0)
    closed = summed(model, "bending", 20)
    assert isinstance(closed, Closed)
    found = solve_modes(beam, 3, families=["bending"], damping="complex", tolerance=1e-9)
    exact = [m.eigenvalue for m in found.modes if m.kind == "elastic" and m.number]
    for s in exact[:3]:
        # rates are summed without a rest: feedback of a rate converges more slowly
        assert np.min(np.abs(closed.poles - s)) < (1e-4 if name == "fed" else 1e-6) * abs(s)
