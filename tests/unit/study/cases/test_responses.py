"""What the response of each case comes to, in sweeps and sensitivities: equal to cases alone."""

import json

import numpy as np
import pytest

from antinode.beam.file import load_beam
from antinode.errors import InputError
from antinode.response.file import load_response
from antinode.response.solve import response_numbers
from antinode.study.cases.warned import RESPONSE_MESSAGES
from antinode.study.design.loading import load_study
from antinode.study.sensitivity.sensitivity import sensitivity
from antinode.study.sweep.sweep import sweep
from cli_run import run

BEAM = """
[beam]
ends = { left = "clamped", right = "free" }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [2, 2]
"""
RESPONSE = """
[response]
of = "beam.toml"
kind = "KIND"
[damping]
loss_factor = 0.02
[frequency]
from = "0.3 Hz"
to = "12 Hz"
points = 9
[time]
to = 1
step = 0.01
[[forces]]
x = 1
amplitude = "1 N"
psd = "psd.csv"
history = "force.csv"
[[outputs]]
x = 1
quantity = "displacement"
[[outputs]]
x = 0
quantity = "bending_moment"
"""
EQUIPMENT = '[[equipment]]\nname = "gyro"\nx = 1\nmass = 0.1\nallowed = "allowed.csv"\n'
STUDY = """
case = "beam.toml"
response = "response.toml"
[solve]
modes = 2
[[inputs]]
key = "bending_stiffness"
factor = true
INPUT
"""


def study(folder, kind="random", given="values = [0.5, 1, 2]", more=""):
    (folder / "beam.toml").write_text(BEAM)
    (folder / "response.toml").write_text(RESPONSE.replace("KIND", kind) + more)
    (folder / "psd.csv").write_text("frequency [Hz], psd [N^2/Hz]\n0.1, 1\n30, 2\n")
    (folder / "force.csv").write_text("time [s], force [N]\n0, 0\n0.2, 1\n0.4, 0\n")
    (folder / "allowed.csv").write_text("frequency [Hz], level [m/s^2]\n0.1, 9\n30, 9\n")
    if kind == "random":
        (folder / "allowed.csv").write_text("frequency [Hz], psd [g^2/Hz]\n0.1, 9\n30, 9\n")
    (folder / "study.toml").write_text(STUDY.replace("INPUT", given))
    return load_study(folder / "study.toml")


def numbers_at(folder, stiffness):
    """Of one case, solved alone."""
    beam = load_beam(folder / "beam.toml", [f"beam.stations.bending_stiffness={[stiffness] * 2}"])
    return response_numbers(load_response(folder / "response.toml"), beam.beam())


@pytest.mark.parametrize("kind", ["random", "transient"])  # all four: response/test_numbers.py
def test_a_sweep_holds_what_each_case_alone_comes_to(tmp_path, kind):
    own = study(tmp_path, kind, more="" if kind == "transient" else EQUIPMENT)
    for name in ("psd.csv", "force.csv", "allowed.csv"):
        (tmp_path / name).write_text("gone")  # what is kept travels without its files
    data = sweep(own)
    study(tmp_path, kind, more="" if kind == "transient" else EQUIPMENT)
    for i, factor in enumerate((0.5, 1, 2)):
        alone = numbers_at(tmp_path, 2 * factor)
        for one in alone.headlines:
            name = one.key.replace(".", "_")
            assert data[name].values[i] == pytest.approx(one.value, rel=1e-9)
            assert data[name].attrs["units"] == one.unit
            np.testing.assert_allclose(data[f"{name}_error"].values[i], one.error, rtol=0.5)


def test_tables_json_and_sensitivities_have_them(tmp_path):
    study(tmp_path, more=EQUIPMENT)
    shown = run("sweep", tmp_path / "study.toml")
    assert "rms displacement at 1 m" in shown.out
    assert "margin of gyro" in shown.out
    told = json.loads(run("sweep", tmp_path / "study.toml", "--json").out)["responses"]
    assert [r["name"] for r in told] == ["outputs_0_rms", "outputs_1_rms", "equipment_0_margin"]
    assert told[0]["largest_error"] > 0
    own = study(tmp_path, given='distribution = "normal"\nsd = 0.01')
    rows = sensitivity(own, 16).responses
    nominal = response_numbers(load_response(tmp_path / "response.toml")).headlines
    assert [r.name for r in rows] == ["outputs_0_rms", "outputs_1_rms"]
    for row, one in zip(rows, nominal, strict=True):
        assert row.nominal == pytest.approx(one.value, rel=1e-6)
        assert row.indices.total[0] == pytest.approx(1, abs=0.2)
    below, above = (numbers_at(tmp_path, v).headlines[0].value for v in (1.99, 2.01))
    assert rows[0].slope[0] == pytest.approx((above - below) / 0.01, rel=1e-3)
    text = run("sensitivity", tmp_path / "study.toml", "--samples", "8")
    assert "rms displacement" in text.out


def test_what_a_case_warns_of_is_counted(tmp_path):
    own = study(tmp_path, "harmonic")
    damping = own.response.damping_table.model_copy(update={"loss_factor": 0.0})
    bare = own.response.model_copy(update={"damping_table": damping})
    (told,) = sweep(own.model_copy(update={"response": bare})).attrs["warnings"]
    assert told["message"] == RESPONSE_MESSAGES[2][1]
    assert told["count"] == 3


def test_a_response_of_another_beam_is_refused(tmp_path):
    study(tmp_path)
    (tmp_path / "other.toml").write_text(BEAM)
    text = (tmp_path / "study.toml").read_text().replace("beam.toml", "other.toml")
    (tmp_path / "study.toml").write_text(text)
    with pytest.raises(InputError, match="name the same file in both"):
        load_study(tmp_path / "study.toml")
