"""Frequency responses against closed forms and against hp finite elements.

Closed forms of uniform beams and bars with EI (1 + i eta): Bishop and Johnson, The Mechanics of
Vibration (1960), receptances; beta^4 = m omega^2/(EI (1 + i eta)).
"""

import numpy as np
import pytest

from all_beams import draw
from antinode.beam.attachments import Dashpot, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.response.damping import Damping, Rayleigh
from antinode.response.frequency import frequency_response
from antinode.response.quantities import Base, Force, Output
from forced_beam import HpResponse

ETA = 0.02
LOSSY = Damping(ETA)


def uniform(segments=1, **ends):
    x = np.linspace(0, 1, segments + 1)
    return Beam.from_stations(
        x, 1.0, 1.0, 1.0, ends=Ends(**ends), torsional_stiffness=1.0, polar_inertia_per_length=1.0
    )


def hertz(omega):
    return np.asarray(omega, float) / (2 * np.pi)


def values(beam, omega, drive, output, damping=LOSSY):
    response = frequency_response(beam, hertz(omega), [drive], [output], damping=damping)
    return response.values[0, 0], response.error[0, 0]


def beta(omega):
    return (np.asarray(omega) ** 2 / (1 + 1j * ETA)) ** 0.25


TIP = {  # 25 to 40 digits, rounded
    1: 0.3616568037 - 0.007852848224j,
    3: 1.193166173 - 0.08720992302j,
    3.516015268: 0.009985609606 - 16.17834053j,
    10: -0.033711173 - 0.0004218058799j,
    22: 0.05610628684 - 0.4021354724j,
}
FREE = {
    10: -0.02845753748 - 0.0002813048467j,
    22: 0.1703074939 - 0.1069419298j,
    23: -0.1310013297 - 0.04410038124j,
    61: 0.02447428303 - 0.02416950901j,
}
ACROSS = {10: 0.02910520792 - 0.00023138306j, 22: 0.1800153418 - 0.1068810762j}


@pytest.mark.parametrize("segments", [1, 7])
@pytest.mark.parametrize(
    ("table", "ends", "force", "at"),
    [(TIP, {"left": "clamped"}, 1.0, 1.0), (FREE, {}, 1.0, 1.0), (ACROSS, {}, 1.0, 0.0)],
)
def test_receptances_in_ten_digits(segments, table, ends, force, at):
    omega = list(table)
    drive, output = Force(force), Output(at, "displacement")
    H, _ = values(uniform(segments, **ends), omega, drive, output)
    np.testing.assert_allclose(H, list(table.values()), rtol=1e-9)


@pytest.mark.parametrize("omega", [0.3, 1.0, 3.516, 22.0, 61.7, 400.0, 5000.0])
def test_cantilever_and_free_beam_by_their_formulas(omega):
    b = beta(omega)
    s, c, S, C, k = np.sin(b), np.cos(b), np.sinh(b), np.cosh(b), 1 + 1j * ETA
    drive, tip, nose = Force(1.0), Output(1.0, "displacement"), Output(0.0, "displacement")
    formulas = (
        (uniform(left="clamped"), tip, (s * C - c * S) / (k * b**3 * (1 + c * C))),
        (uniform(), tip, -(s * C - c * S) / (k * b**3 * (1 - c * C))),
        (uniform(), nose, (S - s) / (k * b**3 * (1 - c * C))),
    )
    for beam, output, exact in formulas:
        H, error = values(beam, [omega], drive, output)
        assert abs(H[0] - exact) <= max(error, 1e-12 * abs(exact))
        assert error < 1e-8 * abs(exact)


@pytest.mark.parametrize(
    ("direction", "force"), [("axial", "axial_force"), ("torsional", "torque")]
)
@pytest.mark.parametrize("omega", [0.5, 1.57, 4.7, 40.0])
def test_bars_and_shafts(direction, force, omega):
    k = 1 + 1j * ETA
    q = omega / np.sqrt(k)
    ends = {"left_axial": "fixed", "left_torsion": "fixed"}
    beam, drive = uniform(3, **ends), Force(1.0, direction)
    H, _ = values(beam, [omega], drive, Output(1.0, "displacement", direction))
    np.testing.assert_allclose(H, [np.tan(q) / (k * q)], rtol=1e-11)
    inner, _ = values(beam, [omega], drive, Output(0.0, force))
    sign = -1 if direction == "axial" else 1  # compression is positive, and the force pulls
    np.testing.assert_allclose(inner, [sign / np.cos(q)], rtol=1e-11)
    moved, _ = values(beam, [omega], Base(direction), Output(1.0, "acceleration", direction))
    np.testing.assert_allclose(moved, [1 / np.cos(q)], rtol=1e-11)


@pytest.mark.parametrize("omega", [0.5, 3.5, 22.0, 61.7])
def test_a_shaken_cantilever(omega):
    """Y(0) = 1, Y'(0) = 0, M(1) = Q(1) = 0, solved for the four constants."""
    b = beta(omega)
    s, c, S, C = np.sin(b), np.cos(b), np.sinh(b), np.cosh(b)
    exact = (c + C) / (1 + c * C)  # at the tip
    H, _ = values(uniform(left="clamped"), [omega], Base(), Output(1.0, "acceleration"))
    np.testing.assert_allclose(H, [exact], rtol=1e-10)
    moment, _ = values(
        uniform(left="clamped"),
        [omega],
        Base("lateral", "displacement"),
        Output(0.0, "bending_moment"),
    )
    np.testing.assert_allclose(moment, [(1 + 1j * ETA) * b**2 * s * S / (1 + c * C)], rtol=1e-10)


def test_forces_inside_and_statics():
    """At a low frequency: a cantilever's moments and shear, and what the wall does to it."""
    beam, drive = uniform(2, left="clamped"), Force(0.5)
    omega = [1e-4]
    for output, exact in (
        (Output(0.0, "bending_moment"), 0.5),
        (Output(0.0, "shear_force"), -1.0),
        (Output(0.5, "shear_force"), -1.0),
        (Output(0.5, "shear_force", side="right"), 0.0),
        (Output(0.0, "reaction"), -1.0),
        (Output(0.0, "reaction_moment"), -0.5),
        (Output(0.5, "displacement"), 0.125 / 3),
        (Output(1.0, "slope"), 0.125),
    ):
        H, _ = values(beam, omega, drive, output, Damping())
        assert H[0] == pytest.approx(exact, abs=1e-7), output
    turned, _ = values(beam, omega, Force(1.0, "moment"), Output(1.0, "slope"), Damping())
    assert turned[0] == pytest.approx(1.0, rel=1e-6)
    spread, _ = values(beam, omega, Force(0.0, to=1.0), Output(1.0, "displacement"), Damping())
    assert spread[0] == pytest.approx(1 / 8, rel=1e-6)


def test_one_mode_of_a_mass_on_a_spring():
    """A stiff pinned-pinned beam is none: a sliding one with spring and dashpot has one freedom."""
    m, k, c = 3.0 + 2.0, 500.0, 7.0
    beam = Beam.from_stations([0, 1], 3.0, 1e12, ends=Ends("sliding", "sliding"))
    beam = beam.with_attachments(PointMass(1.0, 2.0), Spring(0.0, k), Dashpot(0.0, c))
    omega = np.array([0.5, 9.9, 10.0, 30.0])
    H, _ = values(beam, omega, Force(0.5), Output(0.3, "displacement"), Damping())
    np.testing.assert_allclose(H, 1 / (k - m * omega**2 + 1j * omega * c), rtol=1e-6)
    moved, _ = values(beam, omega, Base(), Output(0.3, "acceleration"), Damping())
    s = k + 1j * omega * c
    np.testing.assert_allclose(moved, s / (s - m * omega**2), rtol=1e-6)
    pushed, _ = values(beam, omega, Base(), Output(0.0, "reaction"), Damping())
    exact = m * moved  # all that moves the beam
    np.testing.assert_allclose(pushed, exact, rtol=1e-6)


def test_rayleigh_damping_is_that_of_each_mode():
    """At a mode's own frequency the response is all but 1/(2 i zeta) of its static share."""
    damping = Damping(rayleigh=Rayleigh.fitted((0.01, 0.03), (hertz(3.516), hertz(22.03))))
    for omega, zeta in ((3.5160152685, 0.01), (22.0344915647, 0.03)):
        near = np.linspace(omega * (1 - 3 * zeta), omega * (1 + 3 * zeta), 400)
        H, _ = values(
            uniform(left="clamped"), near, Force(1.0), Output(1.0, "displacement"), damping
        )
        half = near[np.abs(H) ** 2 > np.max(np.abs(H) ** 2) / 2]
        assert np.ptp(half) / (2 * omega) == pytest.approx(zeta, rel=0.03)


def _all_of(index):
    """A random beam that is not past buckling, with dashpots, and frequencies among its modes."""
    beam = draw(18, index)
    rng = np.random.default_rng([18, index])
    places = rng.uniform(0.05, 0.95, 3) * beam.length
    unit = np.sqrt(float(np.mean(beam.bending_stiffness)) * float(np.mean(beam.mass_per_length)))
    beam = beam.with_attachments(
        Dashpot(float(places[0]), translational=0.3 * unit / beam.length),
        Dashpot(float(places[1]), rotational=0.01 * unit * beam.length),
    ).with_breakpoints([float(places[2])])
    top = (20.0 / beam.length) ** 2 * unit / float(np.mean(beam.mass_per_length))
    return beam, places, np.sort(top * rng.uniform(0.02, 1.0, 5))


@pytest.mark.parametrize("index", range(30))
def test_random_beams_against_finite_elements(index):
    beam, places, omega = _all_of(index)
    drives = [Force(places[2]), Force(places[1], "moment"), Base()]
    outputs = [Output(places[0], "displacement"), Output(places[2], "slope")]
    response = frequency_response(
        beam, hertz(omega), drives, outputs, damping=LOSSY, tolerance=1e-6
    )
    meshes = [HpResponse(beam, ETA, degree=d, phase=p) for d, p in ((11, 2.0), (13, 2.4))]
    found = np.empty((2, *response.values.shape), complex)
    for own, mesh in zip(found, meshes, strict=True):
        seen = [mesh.dof(places[0]), mesh.dof(places[2], 1)]
        for k, w in enumerate(omega):
            own[:, 0, k] = mesh.by_force(w, places[2])[seen]
            own[:, 1, k] = mesh.by_force(w, places[1], 1)[seen]
            own[:, 2, k] = mesh.by_ground(w)[seen] / -(w**2)
    spread = np.max(np.abs(found[0] - found[1]), axis=-1)
    away = np.max(np.abs(response.values - found[1]), axis=-1)
    size = np.max(np.abs(response.values), axis=-1)
    assert np.all(spread < 1e-5 * size)
    slack = 4 * spread + 1e-9 * size
    slack[:, 2] += 2e-9 / omega[0] ** 2  # the elements' motion is relative, and may cancel
    assert np.all(away <= response.error + slack)
