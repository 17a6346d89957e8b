"""`antinode stability`: what it prints and writes, and what it refuses in one sentence."""

import csv
import json

import pytest

from cli_run import refused, run

BECK = """
[beam]
name = "Beck's column"
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [F, F]
"""


@pytest.fixture
def beck(tmp_path):
    path = tmp_path / "beck.toml"
    path.write_text(BECK.replace("F", "1"))
    return path


def test_json_is_as_others_rely_on(beck):
    ended = run("stability", beck, "--json")
    assert ended.code == 0
    data = json.loads(ended.out)
    assert data["schema_version"] == 1
    (only,) = data["critical"]
    assert data["range"] == [0, only["bracket"][1]]
    assert only["kind"] == "flutter"
    assert only["load_factor"] == pytest.approx(20.0509536190, rel=1e-11)
    assert only["bracket"][0] < only["load_factor"] < only["bracket"][1]
    assert only["frequency_hz"] == pytest.approx(1.75318, rel=1e-6)
    assert only["modes"] == ["bending 1", "bending 2"]
    assert only["change"] == "lost"
    assert only["certificate"] == {"kind": "winding", "unstable": [0, 2], "eigenvalues": [6, 6]}


def test_the_table_says_what_is_proven_and_what_is_left_out(beck, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    out = tmp_path / "critical.csv"
    ended = run("stability", beck, "-o", out)
    assert ended.code == 0
    for word in ("20.0509536", "flutter", "bending 1 with bending 2", "winding number", "damping"):
        assert word in ended.out
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert [row["kind"] for row in rows] == ["flutter"]
    assert float(rows[0]["load_factor"]) == pytest.approx(20.0509536190)


def test_a_range_below_the_first_change_is_stable(beck):
    data = json.loads(run("stability", beck, "--to", "5", "--json").out)
    assert data["critical"] == []
    assert data["range"] == [0, 5]
    assert "stable" in run("stability", beck, "--to", "5").out


def test_no_compression_is_stable_whatever_the_factor(tmp_path):
    path = tmp_path / "pulled.toml"
    path.write_text(BECK.replace("F", "-1").replace("1.0", "0.0"))
    data = json.loads(run("stability", path, "--json").out)
    assert data["critical"] == []
    assert data["range"] == [0, None]


def test_a_case_is_told_by_its_rotation_and_flutter(tmp_path):
    run("init", tmp_path)
    ended = run("stability", tmp_path / "case.toml", "--to", "11", "--tolerance", "1e-6", "--json")
    (first,) = json.loads(ended.out)["critical"]
    assert first["modes"] == ["rigid rotation"]
    assert first["kind"] == "divergence"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--to", "-3"], ["-3", "must be positive"]),
        (["--to", "0"], ["must be positive"]),
        (["--tolerance", "2"], ["tolerance is 2", "0.1"]),
        (["-o", "found.nc"], [".json", ".csv"]),
        (["--set", "beam.stations.axial_force=[0, 0]"], ["no axial force", "axial_force"]),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(beck, more, words):
    refused(run("stability", beck, *more), *words)
