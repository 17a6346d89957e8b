"""Responses against pyYeti: `FreqDirect` on hp matrices, `SolveUnc`, `srs`."""

import numpy as np
import pytest

import antinode as an
from all_beams import draw
from antinode.response.frequency import Model
from antinode.response.histories import History, half_sine
from antinode.response.modal import basis
from antinode.response.transient import respond
from forced_beam import HpResponse

with np.printoptions():  # pyYeti sets how every array of the process prints
    ode = pytest.importorskip("pyyeti.ode")
    peer_srs = pytest.importorskip("pyyeti.srs")


@pytest.mark.parametrize("index", range(0, 30, 3))
def test_freqdirect_on_hp_matrices(index):
    beam = draw(1818, index)
    place, seen = 0.37 * beam.length, 0.81 * beam.length
    beam = beam.with_breakpoints([place, seen])
    unit = np.sqrt(np.mean(beam.bending_stiffness) / np.mean(beam.mass_per_length))
    hertz = unit / beam.length**2 * np.array([0.4, 1.7, 6.0, 17.0])
    drives, outputs = [an.Force(place)], [an.Output(seen, "displacement")]
    ours = an.frequency_response(beam, hertz, drives, outputs, damping=an.Damping(0.02))
    mesh = HpResponse(beam, 0.02, degree=11, phase=2.0)
    free = mesh.free
    K, M = (A[np.ix_(free, free)] for A in (mesh.K, mesh.M))
    d = 1 / np.sqrt(np.abs(np.diag(K).real) + (2 * np.pi * hertz[-1]) ** 2 * np.diag(M))
    scale = np.outer(d, d)
    force = np.zeros((len(free), len(hertz)), complex)
    force[np.searchsorted(free, mesh.dof(place))] = 1.0
    found = ode.FreqDirect(M * scale, 0 * scale, K * scale).fsolve(d[:, None] * force, hertz)
    u, at_force = (
        (d[:, None] * found.d)[np.searchsorted(free, mesh.dof(x))] for x in (seen, place)
    )
    size = max(np.max(np.abs(u)), 1e-9 * np.max(np.abs(at_force)))
    assert np.max(np.abs(u - ours.values[0, 0])) < 1e-5 * size


def test_solveunc_on_the_same_modes():
    """The exact recurrence for straight pieces, on the same modes and damping."""
    beam = an.Beam.from_stations([0, 1.0], 1.0, 1.0, ends=an.Ends("clamped"))
    drives, outputs = (an.Force(1.0),), (an.Output(0.5, "velocity"),)
    own = basis(beam.with_breakpoints([0.5]), "bending", 12, drives, outputs, an.Damping(0.04))
    time = np.linspace(0, 2.0, 2001)
    pulse = half_sine(1.0, 0.3, 0.0, 1e-5)
    force = np.interp(time, pulse.time_s, pulse.value, right=0.0)
    peer = ode.SolveUnc(np.ones(12), np.diag(own.damping), own.omega2, time[1])
    v = peer.tsolve(own.drives @ force[None]).v
    model = Model(beam, drives, outputs, an.Damping(0.04), 1.0)
    ours, *_ = respond(model, (History(time, force),), time, 12)
    rest = own.outputs @ v
    assert np.max(np.abs(ours[0] - rest[0])) < 1e-3 * np.max(np.abs(rest))


def test_shock_spectra():
    time = np.linspace(0, 2.0, 4001)
    record = np.sin(np.pi * time) * (time < 0.7)
    hertz = np.array([1.0, 3.0, 7.0, 20.0])
    ours = an.srs(time, record, hertz, 0.05)
    peer = peer_srs.srs(
        record, 1 / time[1], hertz, 10, ic="zero", stype="absacce", eqsine=0, ppc=40, rolloff="none"
    )
    np.testing.assert_allclose(ours, peer, rtol=1e-5)
