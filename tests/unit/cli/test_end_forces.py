"""End forces that follow, as commands print them, sweep them and report them."""

import json
import re

import pytest

import antinode as an
from cli_run import refused, run

BEAM = """
[beam]
ends = { left = "clamped", right = "free", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [10, 10]
"""


@pytest.fixture
def silent(tmp_path):
    """The starter, whose file does not say what the ends do."""
    run("init", tmp_path)
    path = tmp_path / "case.toml"
    path.write_text(re.sub(r"\nend_force = .*", "", path.read_text()))
    return path


def test_modes_prints_every_choice_and_says_once_what_the_file_leaves_open(silent, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    ended = run("modes", silent, "--set", "solve.modes=2")
    assert ended.code == 0
    words = " ".join(ended.out.split())
    for name in ("thrust and cavitator follow (this file)", "fixed directions", "thrust follows"):
        assert f" {name} " in words
    assert words.count("does not say what the end forces do") == 1
    told = json.loads(run("modes", silent, "--set", "solve.modes=2", "--json").out)
    assert len([w for w in told["warnings"] if "what the end forces do" in w]) == 1
    own = next(choice for choice in told["end_forces"] if choice["stated"])
    assert own["name"] == "thrust and cavitator follow"
    first = next(mode for mode in told["modes"] if mode["name"] == "bending 1")
    assert own["frequencies_hz"][0] == first["frequency_hz"]
    assert told["certificate"]["kind"] == "winding"
    stated = run("modes", silent, "--set", 'model.end_force="follows_body"', "--json")
    assert "what the end forces do" not in stated.out


def test_the_other_choices_are_what_the_file_would_give_with_them(silent):
    told = json.loads(run("modes", silent, "--set", "solve.modes=2", "--json").out)
    fixed = run(
        "modes", silent, "--set", "solve.modes=2", "--set", "model.end_force=fixed_direction"
    )
    assert fixed.code == 0
    case = an.load_case(silent, ["model.end_force=fixed_direction"])
    alone = an.solve_modes(case, 2, families=["bending"]).frequencies_hz()
    beside = next(c for c in told["end_forces"] if c["name"] == "fixed directions")
    for one, other, error in zip(beside["frequencies_hz"], alone, beside["error_hz"], strict=True):
        assert abs(one - other) <= 2 * error


def test_beam_tells_its_certificate_and_refuses_a_share_at_a_held_end(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    told = json.loads(run("beam", path, "--modes", "2", "--json").out)
    assert told["certificate"]["kind"] == "winding"
    assert told["certificate"]["record"]["eigenvalues"] >= 2
    assert run("beam", path, "--modes", "2").code == 0
    refused(run("beam", path, "--set", "beam.ends.left_follower=0.5"), "left_follower")
    refused(run("beam", path, "--set", "beam.ends.right_follower=1.5"), "right_follower")


def test_a_flutter_is_named_with_its_growth(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM.replace("[10, 10]", "[25, 25]"))
    told = json.loads(run("beam", path, "--modes", "2", "--json").out)
    decays, grows = told["modes"][:2]
    assert grows["kind"] == "flutter"
    assert decays["kind"] == "elastic"
    assert grows["frequency_hz"] == decays["frequency_hz"]
    assert grows["growth_rate_per_s"] == pytest.approx(-decays["growth_rate_per_s"])


def test_a_choice_whose_first_mode_diverges_is_solved_as_well(silent, monkeypatch):
    """Under 300 kN of fixed direction bending 1 diverges; the others vibrate, proven by counts."""
    thrust = ("--set", "condition.thrust=300kN", "--set", "solve.modes=3")
    told = json.loads(run("modes", silent, *thrust, "--json").out)
    beside = next(c for c in told["end_forces"] if c["name"] == "fixed directions")
    assert beside["proven"]
    assert beside["frequencies_hz"][0] is None
    assert beside["error_hz"][0] is None
    case = an.load_case(silent, ["model.end_force=fixed_direction", "condition.thrust=300kN"])
    exact = [m for m in an.solve_modes(case, 3, tolerance=1e-10).family("bending") if m.number]
    for mode, one, error in zip(exact, beside["frequencies_hz"], beside["error_hz"], strict=True):
        assert mode.kind == ("divergent" if one is None else "elastic")
        assert one is None or abs(one - mode.frequency_hz) <= error
    monkeypatch.setenv("COLUMNS", "120")
    words = " ".join(run("modes", silent, *thrust).out.split())
    assert "fixed directions diverges 7.9701 17.9956" in words
