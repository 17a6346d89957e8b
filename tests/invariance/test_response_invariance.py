"""What a frequency response must keep to: reciprocity, the balance of energy, and splitting."""

import numpy as np
import pytest

from all_beams import draw
from antinode.beam.attachments import Dashpot
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.response.damping import Damping
from antinode.response.frequency import frequency_response
from antinode.response.quantities import Base, Force, Output


def timoshenko(**more):
    """Shear, rotary inertia, a soil on a part, a loss that varies, an axial force that varies."""
    x = [0.0, 1.0, 2.5, 4.0]
    values = {
        "mass_per_length": [3.0, 2.0, 2.0, 1.0],
        "bending_stiffness": [5e4, 5e4, 2e4, 1e4],
        "axial_stiffness": [1e6, 1e6, 8e5, 8e5],
        "axial_force": [0.0, 2e3, 3e3, 5e3],
        "shear_stiffness": [1e5, 1e5, 6e4, 6e4],
        "rotary_inertia_per_length": [0.02, 0.02, 0.01, 0.01],
        "foundation_stiffness": [0.0, 3e4, 3e4, 0.0],
        "loss_factor": [0.01, 0.05, 0.02, 0.02],
    }
    return Beam.from_stations(x, **(values | more), interpolation="linear", ends=Ends("pinned"))


HERTZ = np.array([3.0, 11.0, 25.0, 60.0, 140.0])


@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_reciprocity(form):
    """What a force at A does at B is what one at B does at A; moments and turns likewise."""
    beam = timoshenko(shear_form=form).with_attachments(Dashpot(1.7, 20.0, 5.0))
    drives = [Force(0.7), Force(3.1, "moment"), Force(4.0)]
    outputs = [Output(0.7, "displacement"), Output(3.1, "slope"), Output(4.0, "displacement")]
    response = frequency_response(beam, HERTZ, drives, outputs, damping=Damping(0.01))
    for i in range(3):
        for j in range(i):
            a, b = response.values[i, j], response.values[j, i]
            allowed = response.error[i, j] + response.error[j, i]
            assert np.max(np.abs(a - b)) <= allowed
            assert allowed < 1e-5 * np.max(np.abs(a))


@pytest.mark.parametrize("index", range(0, 24, 3))
def test_reciprocity_of_random_beams(index):
    beam = draw(181, index)
    a, b = 0.31 * beam.length, 0.83 * beam.length
    unit = np.sqrt(np.mean(beam.bending_stiffness) / np.mean(beam.mass_per_length))
    hertz = unit / beam.length**2 * np.array([0.3, 2.0, 9.0, 40.0])
    drives = [Force(a), Force(b)]
    outputs = [Output(a, "displacement"), Output(b, "displacement")]
    response = frequency_response(beam, hertz, drives, outputs, damping=Damping(0.01))
    away = np.max(np.abs(response.values[0, 1] - response.values[1, 0]))
    assert away <= response.error[0, 1] + response.error[1, 0]


def test_energy_that_a_force_puts_in_is_what_a_dashpot_takes():
    """Per cycle: pi Im(conj(F) Y) goes in, pi c omega |Y_d|^2 is lost."""
    beam = timoshenko(loss_factor=None).with_attachments(Dashpot(1.7, 20.0))
    outputs = [Output(4.0, "displacement"), Output(1.7, "displacement")]
    response = frequency_response(beam, HERTZ, [Force(4.0)], outputs)
    omega = 2 * np.pi * HERTZ
    given = -response.values[0, 0].imag
    lost = 20.0 * omega * np.abs(response.values[1, 0]) ** 2
    np.testing.assert_allclose(given, lost, rtol=1e-5)


def test_energy_that_a_loss_factor_takes():
    """Uniform: eta int (M^2/EI + kGA gamma^2) dx, with kGA gamma = N psi - Q, by Gauss points."""
    beam = Beam.from_stations(
        [0, 2.0], 1.0, 300.0, axial_force=-50.0, shear_stiffness=4e3,
        rotary_inertia_per_length=0.01, ends=Ends("clamped"),
    )  # fmt: skip
    eta, hertz = 0.03, [4.1]
    points, weights = np.polynomial.legendre.leggauss(40)
    places = (points + 1).tolist()
    kinds = ("bending_moment", "slope", "shear_force")
    outputs = [Output(x, kind) for kind in kinds for x in places]
    response = frequency_response(
        beam, hertz, [Force(2.0)], [*outputs, Output(2.0, "displacement")], damping=Damping(eta)
    )
    M, psi, Q = response.values[:-1, 0, 0].reshape(3, -1)
    stretched = 1 + 1j * eta
    strain = np.abs(M) ** 2 / (300.0 * abs(stretched) ** 2)
    shear = np.abs(-50.0 * psi - Q) ** 2 / (4e3 * abs(stretched) ** 2)
    lost = eta * float(weights @ (strain + shear))
    assert -response.values[-1, 0, 0].imag == pytest.approx(lost, rel=1e-9)


def test_splitting_and_reading_from_the_other_end():
    beam = timoshenko()
    drives, outputs = [Force(3.1), Base()], [Output(0.7, "acceleration"), Output(0.7, "slope")]
    whole = frequency_response(beam, HERTZ, drives, outputs)
    split = frequency_response(beam.with_breakpoints([0.2, 1.9, 3.3]), HERTZ, drives, outputs)
    assert np.all(np.max(np.abs(whole.values - split.values), axis=-1) <= whole.error + split.error)
    turned = frequency_response(
        beam.reversed(), HERTZ, [Force(0.9), Base()], [Output(3.3, o.quantity) for o in outputs]
    )
    values = turned.values * np.array([1, -1])[:, None, None]
    assert np.all(np.max(np.abs(whole.values - values), axis=-1) <= whole.error + turned.error)


def test_a_shaken_beam_on_soil_moves_with_it_at_low_frequencies():
    beam = timoshenko()
    outputs = [Output(x, "displacement") for x in (0.3, 2.0, 4.0)]
    response = frequency_response(beam, [1e-3], [Base("lateral", "displacement")], outputs)
    np.testing.assert_allclose(response.values[:, 0, 0], 1.0, atol=1e-6)


@pytest.mark.parametrize("eta", [0.0, 0.5, 1.0])
def test_an_end_force_that_follows_is_a_spring_without_a_partner(eta):
    """Q = eta N psi at the end is a force -eta N psi there: it enters finite elements so."""
    from forced_beam import HpResponse

    beam = Beam.from_stations([0, 0.6, 1.0], 1.0, 1.0, axial_force=8.0,
                              ends=Ends("clamped", right_follower=eta))  # fmt: skip
    omega = np.array([1.0, 7.0, 21.0])
    outputs = [Output(0.6, "displacement"), Output(1.0, "slope")]
    found = frequency_response(
        beam, omega / 2 / np.pi, [Force(0.6)], outputs, damping=Damping(0.02)
    )
    mesh = HpResponse(beam, 0.02)
    end, turn = mesh.dof(1.0), mesh.dof(1.0, 1)
    mesh.K[end, turn] += eta * 8.0
    for k, w in enumerate(omega):
        u = mesh.by_force(w, 0.6)
        exact = [u[mesh.dof(0.6)], u[turn]]
        np.testing.assert_allclose(found.values[:, 0, k], exact, rtol=1e-7)


def test_a_coupled_spring_moves_with_the_ground():
    """Springs k, k_r, k_c on moving ground push by k (Y - g) + k_c psi, turn by k_c (Y - g)."""
    from antinode.beam.attachments import Spring

    beam = Beam.from_stations([0, 1.0], 2.0, 1e9)
    k, turn, couple = 50.0, 40.0, 9.0
    beam = beam.with_attachments(Spring(0.5, k, turn, coupling=couple))
    hertz = np.array([0.3, 0.9, 2.0])
    w2 = (2 * np.pi * hertz) ** 2
    outputs = [Output(0.5, "displacement"), Output(0.5, "slope")]
    found = frequency_response(beam, hertz, [Base("lateral", "displacement")], outputs)
    for row, w in enumerate(w2):
        D = np.array([[k - 2.0 * w, couple], [couple, turn - 2.0 / 12 * w]])
        exact = np.linalg.solve(D, [k, couple])
        np.testing.assert_allclose(found.values[:, 0, row], exact, rtol=1e-5)
