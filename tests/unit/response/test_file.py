"""Response files: what is read, and one sentence for what is wrong."""

import json

import numpy as np
import pytest

from antinode.errors import InputError
from antinode.examples import write_example
from antinode.response.file import load_response
from antinode.response.solve import solve_response
from cli_run import run

BEAM = """
[beam]
ends = { left = "clamped" }
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }
"""
HARMONIC = """
[response]
of = "beam.toml"
kind = "harmonic"
[damping]
loss_factor = 0.02
[frequency]
values = [0.15915494309189535, "1.5915494309189535 Hz"]
[[forces]]
x = "1 m"
direction = "lateral"
amplitude = "1 N"
[[outputs]]
x = 1.0
quantity = "displacement"
[[outputs]]
x = 0
quantity = "bending_moment"
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "beam.toml").write_text(BEAM)
    (tmp_path / "r.toml").write_text(HARMONIC)
    (tmp_path / "psd.csv").write_text("frequency [Hz], psd [N^2/Hz]\n0.1, 2\n10, 2\n")
    return tmp_path


def test_json_has_the_keys_that_others_read(folder):
    said = run("response", "r.toml", "--json")
    assert said.code == 0
    data = json.loads(said.out)
    assert data["schema_version"] == 1
    assert data["kind"] == "harmonic"
    assert data["frequency_hz"] == [0.15915494309189535, 1.5915494309189535]
    first, second = data["outputs"]
    assert (first["x"], first["quantity"], first["unit"]) == (1.0, "displacement", "m")
    assert second["unit"] == "N m"
    H = np.array(first["real"]) + 1j * np.array(first["imag"])
    exact = [0.3616568037 - 0.007852848224j, -0.033711173 - 0.0004218058799j]
    np.testing.assert_allclose(H, exact, rtol=1e-9)
    assert 0 < first["error"] < 1e-9


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("forces.0.x=2m", ("2 m is off the beam", "from 0 to 1 m")),
        ("outputs.1.quantity=torque", ("torsional_stiffness", "add the column")),
        ("outputs.0.quantity=colour", ("displacement",)),
        ("forces.0.amplitude=3m", ("forces.0.amplitude", "N")),
        ("forces.0.direction=up", ("lateral",)),
        ("frequency.values=[3, 2]", ("values must increase",)),
        ("frequency.values=[0, 2]", ("greater than 0",)),
        ("damping.modal=[0.01]", ("exclude each other",)),
        ("damping={modal = [2, 50]}", ("a ratio, not percent",)),
        ("response.kind=random", ("psd", "random")),
        ("response.kind=transient", ("table [time]",)),
        ("response.of=nothing.toml", ("no such file",)),
        ("forces=[]", ("nothing drives the beam",)),
        ("outputs=[]", ("nothing is asked for",)),
        ("base={direction = 'moment', amplitude = 1}", ("lateral, axial or torsional",)),
    ],
)
def test_one_sentence_for_what_is_wrong(folder, change, words):
    said = run("response", "r.toml", "--set", change)
    assert said.code == 2, said.err
    assert len(said.err.strip().splitlines()) == 1
    for word in words:
        assert word in said.err


RANDOM = ("--set", "response.kind=random", "--set", "forces.0.psd=psd.csv")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("frequency [Hz], psd [N^2/Hz]\n0.5, 2\n10, 2\n", ("runs from 0.5 to 10 Hz", "extend")),
        ("frequency [Hz], psd [N^2/Hz]\n0.1, 2\n10, -2\n", ("at 10 Hz is -2", "above 0")),
        ("frequency [Hz], psd [N^2/Hz]\n10, 2\n0.1, 2\n", ("sort the rows",)),
        ("frequency [Hz], psd [g^2/Hz]\n0.1, 2\n10, 2\n", ("column psd", "N")),
        ("0.1, 2\n10, 2\n20, 3\n", ("the first row holds numbers",)),
        ("frequency, psd\n0.1, two\n10, 2\n", ("line 2",)),
    ],
)
def test_spectra_that_are_none(folder, table, words):
    (folder / "psd.csv").write_text(table)
    said = run("response", "r.toml", *RANDOM)
    assert said.code == 2, said.err
    for word in words:
        assert word in said.err


def test_unsorted_times_of_a_history(folder):
    (folder / "f.csv").write_text("time [s], force [N]\n0, 1\n2, 1\n1, 0\n")
    more = ("--set", "response.kind=transient", "--set", "time={to = 1, step = 0.1}")
    said = run("response", "r.toml", *more, "--set", "forces.0.history=f.csv")
    assert said.code == 2
    assert "sort the rows by time" in said.err


def test_no_damping_is_an_answer_with_a_sentence(folder):
    more = ("--set", "damping.loss_factor=0", "--set", "frequency.values=[0.1, 1]")
    said = run("response", "r.toml", *more)
    assert said.code == 0
    assert "no damping" in said.out
    assert "bending 1" in said.out


def test_a_beam_file_is_no_response_file(folder):
    said = run("response", "beam.toml")
    assert said.code == 2
    assert "[response] of = 'beam.toml'" in said.err


def test_verdicts_and_exit_codes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_example("response", tmp_path)
    quick = ("--set", "random.envelope=false", "--set", "response.tolerance=1e-4")
    well = run("response", "response.toml", *quick, "--json")
    assert well.code == 0
    data = json.loads(well.out)
    gyro = data["equipment"][0]
    assert gyro["verdict"] == "yes"
    assert (gyro["mode"], gyro["force"]) == ("bending 3", "fins")
    assert data["outputs"][0]["rms"] / 9.80665 == pytest.approx(3.094, abs=2e-3)
    ill = run("response", "response.toml", *quick, "--set", "damping.loss_factor=0.01")
    assert ill.code == 3
    assert "NO" in ill.out


@pytest.mark.parametrize("kind", ["harmonic", "random", "transient", "shock"])
def test_every_kind_is_written_and_read_back(folder, kind):
    """By pyuff, which is none of ours, and as CSV."""
    pyuff = pytest.importorskip("pyuff")
    more = {
        "response.kind": kind,
        "forces.0.psd": "psd.csv",
        "forces.0.history": "{shape = 'half_sine', duration = 0.1}",
        "time": "{to = 1, step = 0.01}",
        "frequency": "{from = 0.2, to = 9, points = 30}",
    }
    changes = [word for key, value in more.items() for word in ("--set", f"{key}={value}")]
    assert run("response", "r.toml", *changes, "-o", "r.uff").code == 0
    assert run("response", "r.toml", *changes, "-o", "r.csv").code == 0
    problem = load_response("r.toml", [f"{key}={value}" for key, value in more.items()])
    result = solve_response(problem)
    sets = [s for s in pyuff.UFF("r.uff").read_sets() if s["type"] == 58]
    assert len(sets) == len(result.curves())
    for own, curve in zip(sets, result.curves(), strict=True):
        np.testing.assert_allclose(own["x"], curve[2], rtol=1e-5)
        np.testing.assert_allclose(own["data"], curve[3], rtol=1e-5, atol=1e-10)
    table = np.genfromtxt("r.csv", delimiter=",", skip_header=1)
    np.testing.assert_allclose(table[:, 0], result.columns()[0][1], rtol=1e-9)


def test_equipment_is_not_judged_over_time(folder):
    equipment = "equipment=[{name = 'a', x = 1, allowed = 'psd.csv'}]"
    with pytest.raises(InputError, match="shock"):
        load_response(
            "r.toml",
            ["response.kind=transient", "time={to = 1, step = 0.1}", equipment,
             "forces.0.history={shape = 'step', duration = 1}"],
        )  # fmt: skip
