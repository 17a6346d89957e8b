"""What drives a beam, as files have it: motion of supports that are not there, steps, units."""

import json

import pytest

from cli_run import refused, run

BEAM = """
[beam]
ends = { left = "LEFT" }
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }
"""
BASE = """
[response]
of = "beam.toml"
kind = "harmonic"
DAMPING
[frequency]
from = "0.2 Hz"
to = "2 Hz"
points = 20
[base]
amplitude = "1 g"
[[outputs]]
x = 1
quantity = "acceleration"
"""
STEP = """
[response]
of = "beam.toml"
kind = "transient"
[time]
to = "1 s"
step = "0.1 s"
[damping]
loss_factor = 0.02
[[forces]]
x = 1
history = HISTORY
[[outputs]]
x = 1
quantity = "displacement"
"""
RANDOM = """
[response]
of = "beam.toml"
kind = "random"
[damping]
loss_factor = 0.02
[frequency]
from = "0.2 Hz"
to = "2 Hz"
[[forces]]
x = 1
psd = { frequency = ["0.1 Hz", "9 Hz"], level = "LEVEL", slope = [0] }
[[outputs]]
x = 1
quantity = "displacement"
"""


def asked(folder, text, left="clamped", more="", *arguments):
    (folder / "beam.toml").write_text(BEAM.replace("LEFT", left) + more)
    (folder / "response.toml").write_text(text)
    return run("response", folder / "response.toml", *arguments)


@pytest.mark.parametrize("left", ["free", "sliding"])
def test_supports_that_are_not_there_move_nothing(tmp_path, left):
    ended = asked(tmp_path, BASE.replace("DAMPING", ""), left)
    refused(ended, "nothing holds this beam along 'lateral'")


@pytest.mark.parametrize(
    "held",
    [
        "[[beam.springs]]\nx = 0.5\ntranslational = 3",
        "[[beam.dashpots]]\nx = 0.5\ntranslational = 3",
    ],
)
def test_a_spring_or_a_dashpot_alone_moves_a_beam(tmp_path, held):
    assert asked(tmp_path, BASE.replace("DAMPING", ""), "free", held).code == 0


def test_a_peak_without_damping_has_no_error(tmp_path):
    for damping, known in (("", False), ("[damping]\nloss_factor = 0.02", True)):
        ended = asked(tmp_path, BASE.replace("DAMPING", damping), "clamped", "", "--json")
        (output,) = json.loads(ended.out)["outputs"]
        assert output["peaks"][0]["frequency_hz"] == pytest.approx(0.5596, rel=1e-3)
        assert (output["peak_error"] is not None) == known
        assert output["error"] < 1e-3


def test_a_step_has_no_duration(tmp_path):
    short = asked(tmp_path, STEP.replace("HISTORY", '{ shape = "step", height = 2 }'))
    assert short.code == 0
    long = STEP.replace("HISTORY", '{ shape = "step", height = 2, duration = 5 }')
    assert asked(tmp_path, long).out == short.out
    missing = STEP.replace("HISTORY", '{ shape = "ramp", height = 2 }')
    refused(asked(tmp_path, missing), "history.duration is missing; give it, e.g. '1 s'")


def test_spectra_have_the_unit_that_people_write(tmp_path):
    ended = asked(tmp_path, RANDOM.replace("LEVEL", "3 N/Hz"))
    refused(ended, "'N/Hz' is no unit of N^2/Hz; write e.g. '1 N^2/Hz'")
    told = asked(tmp_path, RANDOM.replace("LEVEL", "3 N^2/Hz"), "clamped", "", "--json")
    assert json.loads(told.out)["outputs"][0]["psd_unit"] == "m^2/Hz"


def test_a_direction_that_a_quantity_has_not_is_refused(tmp_path):
    text = BASE.replace("DAMPING", "")
    for quantity, direction in (("slope", "axial"), ("axial_force", "lateral")):
        output = f'{quantity}"\ndirection = "{direction}"'
        wrong = text.replace('acceleration"', output)
        refused(asked(tmp_path, wrong), f"{quantity} is no quantity of the direction '{direction}'")
    assert asked(tmp_path, text.replace('acceleration"', 'slope"\ndirection = "lateral"')).code == 0
