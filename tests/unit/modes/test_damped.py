"""Complex modes as they are asked for, printed and refused."""

import json

import numpy as np
import pytest

import antinode as an
from antinode.beam.attachments import attachment_dict
from antinode.errors import InputError
from cli_run import run

FILE = """
[beam]
name = "mast"
[beam.ends]
left = "clamped"
[beam.stations]
x = [0, 2, 4]
mass_per_length = [20, 20, 20]
bending_stiffness = [1e6, 1e6, 1e6]
[[beam.dashpots]]
x = 4
translational = "300 N s/m"
"""
FEEDBACK = """
[[beam.point_feedbacks]]
x = 2
translational = "2 kN/m"
force_of_turn = "500 N"
rotational_damping = "-1 N m s/rad"
"""


@pytest.fixture(autouse=True)
def wide(monkeypatch):
    """A terminal on which headings stand in full."""
    monkeypatch.setenv("COLUMNS", "120")


@pytest.fixture
def beam():
    one = np.ones(3)
    return an.Beam.from_stations([0, 1, 2], one, one, one, ends=an.Ends(left="clamped"))


def test_the_terminal_and_json_tell_damping_and_growth(tmp_path):
    path = tmp_path / "mast.toml"
    path.write_text(FILE + FEEDBACK)
    done = run("beam", str(path), "--modes", "2")
    assert done.code == 0
    assert "damping ratio" in done.out
    assert "gives energy" in done.out
    data = json.loads(run("beam", str(path), "--modes", "2", "--json").out)
    first = data["modes"][0]
    re, im = first["eigenvalue_per_s"]
    assert first["frequency_hz"] == pytest.approx(im / (2 * np.pi), rel=1e-15)
    assert first["damping_ratio"] == pytest.approx(-re / np.hypot(re, im), rel=1e-15)
    assert first["growth_rate_per_s"] == re
    assert data["certificate"]["kind"] == "winding"
    assert data["certificate"]["region"]["abs_s_below"] > im
    assert "damping" not in data["not_modelled"]


def test_a_dashpot_can_be_left_out_and_a_feedback_cannot(tmp_path):
    path = tmp_path / "mast.toml"
    path.write_text(FILE)
    plain = json.loads(run("beam", str(path), "--damping", "none", "--json").out)
    assert plain["certificate"] == {"kind": "counts"}
    assert "eigenvalue_per_s" not in plain["modes"][0]
    path.write_text(FILE + FEEDBACK)
    done = run("beam", str(path), "--damping", "none")
    assert done.code == 2
    assert "a point feedback acts on the beam" in done.err


def test_what_counts_on_energies_refuses_a_feedback(beam):
    fed = beam.with_attachments(an.PointFeedback(1.0, force_of_turn=1.0))
    for call in (an.natural_frequencies, an.buckling):
        with pytest.raises(InputError, match="point feedback"):
            call(fed, backend="numpy")
    with pytest.raises(InputError, match="tmm"):
        an.solve_modes(beam, method="tmm", damping="complex", backend="numpy")


def test_a_feedback_by_its_matrices(beam):
    K, C = [[1, 2], [3, 4]], [[5, 6], [7, 8]]
    item = an.PointFeedback.of(1.0, K, C)
    np.testing.assert_array_equal(item.stiffness, K)
    np.testing.assert_array_equal(item.damping, C)
    assert attachment_dict(item)["moment_of_displacement_N"] == 3
    with pytest.raises(InputError, match=r"\(2, 2\) is wanted"):
        an.PointFeedback.of(1.0, [1, 2])


def test_a_feedback_survives_reversal_and_a_beam_file(beam, tmp_path):
    from antinode.exchange.beam_toml import beam_file_text

    fed = beam.with_attachments(
        an.PointFeedback.of(0.5, [[3, 2], [-1, 0.5]], [[0.1, 0.02], [0.05, 0.1]])
    )
    path = tmp_path / "beam.toml"
    path.write_text(beam_file_text(fed)[0])

    def found(b):
        result = an.solve_modes(b, 3, families=["bending"], backend="numpy")
        return np.array([m.eigenvalue_per_s for m in result.modes])

    np.testing.assert_allclose(found(an.load_beam(path).beam()), found(fed), rtol=1e-12)
    np.testing.assert_allclose(found(fed.reversed()), found(fed), rtol=1e-10)


def test_shear_that_is_left_out_is_warned_of(beam):
    soft = an.Beam.from_stations([0, 1], [1, 1], [1, 1], [300, 300], ends=an.Ends(left="clamped"))
    damped = soft.with_attachments(an.Dashpot(1.0, translational=1e-8))
    both = [
        an.solve_modes(b, 3, families=["bending"], backend="numpy", damping=how)
        for b, how in ((soft, "auto"), (damped, "auto"))
    ]
    plain, complex_ = ([m.model_error for m in r.modes] for r in both)
    np.testing.assert_allclose(complex_, plain, rtol=1e-6)
    assert any("shear and rotary inertia" in w for w in both[1].warnings)


def test_flutter_by_a_feedback_is_called_so(beam):
    fed = beam.with_attachments(an.PointFeedback(2.0, translational_damping=-0.1))
    result = an.solve_modes(fed, 2, families=["bending"], backend="numpy")
    assert all(m.kind == "flutter" and m.growth_rate_per_s > 0 for m in result.modes)
    assert any("flutter: the motion grows" in w for w in result.warnings)
    assert any("gives energy" in w for w in result.warnings)
