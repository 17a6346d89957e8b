"""Responses of beams on which something feeds back: dense elements, histories, what is refused."""

import numpy as np
import pytest

import antinode as an
from forced_beam import HpResponse

HERTZ = [0.3, 0.9, 2.1, 5.0]
K, C = np.array([[40.0, -7.0], [3.0, 0.5]]), np.array([[0.6, 0.1], [-0.2, 0.05]])
ASKED = {
    "forces": [{"x": 1.0, "direction": "lateral", "amplitude": "1 N"}],
    "outputs": [{"x": 0.3, "quantity": "displacement"}],
    "frequency": {"values": HERTZ},
    "damping": {"loss_factor": 0.02},
}


def beam(share, *items):
    return an.Beam.from_stations(
        [0.0, 0.3, 0.6, 1.0],
        [1.0, 1.4, 0.8, 1.1],
        [1.0, 0.9, 1.3, 1.0],
        axial_force=[2.0, 2.0, 3.0, 3.0],
        interpolation="linear",
        ends=an.Ends("clamped", "free", right_follower=share),
    ).with_attachments(*items)


@pytest.mark.parametrize("share", [0.0, 0.7])
def test_a_feedback_of_any_matrix(share):
    feedback = an.PointFeedback.of(0.6, K, C)
    result = beam(share, feedback).response("harmonic", **ASKED)
    dense = HpResponse(beam(0.0), 0.02)
    node, tip = dense.dof(0.6), dense.dof(1.0)
    dense.K[node : node + 2, node : node + 2] += K
    dense.C[node : node + 2, node : node + 2] += C
    dense.K[tip, tip + 1] += share * 3.0
    wanted = [dense.by_force(2 * np.pi * f, 1.0)[dense.dof(0.3)] for f in HERTZ]
    assert np.max(np.abs(result.values[0] - wanted)) < 1e-6 * np.max(np.abs(wanted))
    assert np.all(np.abs(result.values[0] - wanted) <= result.error[0] + 1e-10)
    assert not result.warnings
    (own,) = result.modes  # what peaks are looked for by: the complex modes
    lossless = beam(share, feedback)
    found = an.solve_modes(lossless, 3, families=["bending"], damping="complex").modes
    exact = [mode.frequency_hz for mode in found if mode.kind == "elastic"]
    np.testing.assert_allclose(own.frequency_hz[: len(exact)], exact, rtol=1e-3)


def test_peaks_are_those_of_a_spring_and_a_dashpot():
    """Without cross terms a feedback is both, and is answered alike."""
    both = an.Spring(0.6, translational=40.0), an.Dashpot(0.6, translational=0.1)
    alone = an.PointFeedback.of(0.6, np.diag([40.0, 0.0]), np.diag([0.1, 0.0]))
    one, other = (beam(0.0, *items).response("harmonic", **ASKED) for items in (both, [alone]))
    assert one.values == pytest.approx(other.values, rel=1e-9)
    assert not one.warnings


STEP = {"shape": "half_sine", "height": 1.0, "duration": "0.1 s"}


def test_a_history_has_what_the_feedback_does():
    """A feedback that is a spring and a dashpot gives the history of these."""
    both = an.Spring(0.6, translational=40.0), an.Dashpot(0.6, translational=0.6)
    turned = an.PointFeedback.of(0.6, [[40.0, 1e-9], [0.0, 0.0]], [[0.6, 0.0], [0.0, 0.0]])
    asked = {
        "forces": [{"x": 1.0, "direction": "lateral", "history": STEP}],
        "outputs": ASKED["outputs"],
        "time": {"to": "1 s", "step": "0.01 s"},
    }
    one, other = (beam(0.0, *items).response("transient", **asked) for items in (both, [turned]))
    size = np.max(np.abs(one.values))
    assert np.max(np.abs(one.values - other.values)) < 1e-8 * size
    assert other.error[0] < 1e-3 * size


def test_moving_supports_are_refused_with_what_to_do():
    with pytest.raises(an.InputError, match=r"the supports move and something feeds back"):
        beam(0.0, an.PointFeedback.of(0.6, K, C)).response(
            "transient",
            base={"motion": "acceleration", "history": STEP},
            outputs=ASKED["outputs"],
            time={"to": "1 s", "step": "0.01 s"},
        )


def test_ratios_of_modes_are_refused_with_what_to_do():
    with pytest.raises(an.InputError, match=r"a feedback acts.*give a loss factor"):
        beam(0.0, an.PointFeedback.of(0.6, K, C)).response(
            "harmonic", **(ASKED | {"damping": {"modal": [0.01]}})
        )
