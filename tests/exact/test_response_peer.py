"""Responses against pyYeti: `FreqDirect` on hp matrices, `SolveUnc`, `srs`."""

import numpy as np
import pytest
from scipy.linalg import eigh

import antinode as an
from all_beams import draw
from antinode.response.damping import Rayleigh
from antinode.response.frequency import Model
from antinode.response.histories import History, half_sine
from antinode.response.modal import basis
from antinode.response.transient import respond
from forced_beam import HpResponse
from shear_elements import ShearElements

with np.printoptions():  # pyYeti sets how every array of the process prints
    ode = pytest.importorskip("pyyeti.ode")
    peer_srs = pytest.importorskip("pyyeti.srs")


_LOST = (4, 22, 29)
"""Whose elements have a condition beyond 1e15: in float64 they know less than 1e-5 themselves."""


@pytest.mark.parametrize("index", [k for k in range(30) if k not in _LOST])
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


PAIRS = (
    ("clamped", "free"),
    ("free", "free"),
    ("pinned", "pinned"),
    ("clamped", "sliding"),
    ("free", "pinned"),
)


def sheared(index):
    """A random beam with shear, rotary inertia, N of either sign, masses and springs."""
    rng = np.random.default_rng([1819, index])
    n, length = int(rng.integers(2, 6)), float(np.exp(rng.uniform(-1, 2)))
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.5, 1.5, n))])
    x *= length / x[-1]
    tables = [np.exp(rng.normal(0, 0.4, n + 1)) for _ in range(4)]
    m, EI, kGA, rho = (a * b for a, b in zip((3.0, 40.0, 1.0, 1.0), tables, strict=True))
    kGA = kGA * np.exp(rng.uniform(3, 7)) * np.mean(EI) / length**2
    rho = rho * np.exp(rng.uniform(-8, -4)) * np.mean(m) * length**2
    N = rng.uniform(-1.5, 0.6) * np.min(EI) / length**2 * rng.uniform(0.5, 1.0, n + 1)
    beam = an.Beam.from_stations(
        x,
        m,
        EI,
        shear_stiffness=kGA,
        rotary_inertia_per_length=rho,
        axial_force=N,
        interpolation="linear",
        ends=an.Ends(*PAIRS[index % len(PAIRS)]),
    )
    k = np.mean(EI) / length**3
    return beam.with_attachments(
        an.PointMass(float(x[1]), float(rng.uniform(0.1, 1) * length)),
        an.Spring(float(x[-2]), translational=float(k * rng.uniform(1, 30))),
    )


@pytest.mark.parametrize("index", range(30))
def test_freqdirect_on_elements_with_shear(index):
    beam = sheared(index)
    place, seen = float(beam.x[1]), float(beam.x[-2])
    unit = np.sqrt(np.mean(beam.bending_stiffness) / np.mean(beam.mass_per_length))
    hertz = unit / beam.length**2 * np.array([0.3, 1.1, 4.0, 9.0, 17.0])
    ours = an.frequency_response(
        *(beam, hertz, [an.Force(place)]),
        [an.Output(seen, "displacement"), an.Output(place, "slope")],
        damping=an.Damping(0.02),
    )
    mesh = ShearElements(beam, 0.02)
    M, K, d, where = mesh.scaled()
    force = np.zeros((len(d), len(hertz)), complex)
    force[where[mesh.dof(place)]] = d[where[mesh.dof(place)]]
    found = d[:, None] * ode.FreqDirect(M, 0 * M, K).fsolve(force, hertz).d
    for row, dof in enumerate((mesh.dof(seen), mesh.dof(place, 1))):
        u = found[where[dof]]
        assert np.max(np.abs(u - ours.values[row, 0])) < 1e-6 * np.max(np.abs(u))


@pytest.mark.parametrize("index", range(0, 30, 6))
def test_solveunc_on_elements_with_shear(index):
    """A history by Rayleigh damping, which is of all of M and K, over time on all elements."""
    beam = sheared(index)
    place, seen = float(beam.x[1]), float(beam.x[-2])
    mesh = ShearElements(beam, 0.0)
    M, K, d, where = mesh.scaled()
    K = K.real
    w2, phi = eigh(K, M)
    slowest = np.sqrt(w2[3])  # of those that vibrate
    damping = an.Damping(rayleigh=Rayleigh(0.03 * slowest, 0.01 / slowest))
    time = np.linspace(0, 12 / slowest, 601)
    value = np.sin(np.pi * np.minimum(time / time[120], 1.0)) ** 2
    model = Model(beam, [an.Force(place)], [an.Output(seen, "displacement")], damping, slowest / 6)
    ours, error, *_ = respond(model, (History(time, value),), time, None)
    force = np.zeros((len(d), len(time)))
    force[where[mesh.dof(place)]] = d[where[mesh.dof(place)]] * value
    C = damping.rayleigh.alpha + damping.rayleigh.beta * w2
    peer = ode.SolveUnc(np.ones(len(w2)), C, w2, time[1])
    u = (d[:, None] * (phi @ peer.tsolve(phi.T @ force).d))[where[mesh.dof(seen)]]
    size = np.max(np.abs(u))
    assert np.max(np.abs(ours[0] - u)) <= error[0] + 1e-6 * size
    assert error[0] < 1e-2 * size


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
