"""`antinode beam --prove`: the certificate, the sentence, the exit code; a missing extra."""

import json
import sys

import pytest

import antinode as an
from antinode.proof import prove as module
from cli_run import refused, run

BEAM = """
[beam]
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 0.5, 1]
mass_per_length = [1, 1, 1]
bending_stiffness = [1, 1, 1]
axial_force = [18, 18, 18]
[[beam.dashpots]]
x = 1.0
translational = 0.5
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    return path


@pytest.mark.parametrize("how", [(), ("--damping", "none")])
def test_the_certificate_gains_balls(file, how):
    pytest.importorskip("flint")
    ended = run("beam", file, "--prove", "--json", "--modes", "3", *how)
    assert ended.code == 0
    data = json.loads(ended.out)
    certificate = data["certificate"]
    assert certificate["kind"] == "winding"
    assert certificate["balls"] is True
    assert certificate["balls_verdict"] == "proven"
    assert certificate["precision_bits"] > 100
    assert certificate["arcs"] > 16
    region = certificate["ball_regions"]["bending"]
    if how:
        assert region["eigenvalues"] == 3
    else:
        assert region["abs_s_below"] == certificate["region"]["abs_s_below"]
        assert region["eigenvalues"] == certificate["record"]["eigenvalues"]


def test_the_sentence(file):
    pytest.importorskip("flint")
    ended = run("beam", file, "--prove")
    assert ended.code == 0
    assert "Proven in ball arithmetic (" in ended.out


def test_what_is_not_proven_ends_with_3(file, monkeypatch):
    pytest.importorskip("flint")
    monkeypatch.setattr("antinode.proof.lists._BITS", (-80,))
    ended = run("beam", file, "--prove")
    assert ended.code == 3
    assert "undecided" in ended.out
    ended = run("beam", file, "--prove", "--json")
    assert ended.code == 3
    certificate = json.loads(ended.out)["certificate"]
    assert certificate["balls"] is False
    assert "too wide" in certificate["balls_reason"]


def test_what_varies_is_refused(file):
    pytest.importorskip("flint")
    file.write_text(
        BEAM.replace("[18, 18, 18]", "[0, 9, 18]").replace(
            "[beam]", '[beam]\ninterpolation = "linear"'
        )
    )
    refused(run("beam", file, "--prove"), "from x = 0 to 0.5 m", "--prove")


def test_a_missing_extra_is_one_sentence(file, monkeypatch):
    monkeypatch.setitem(sys.modules, "flint", None)
    refused(run("beam", file, "--prove"), "pip install 'antinode[prove]'")


def test_a_proof_is_a_method_and_a_function():
    assert an.prove is module.prove
    assert an.Proof is module.Proof
