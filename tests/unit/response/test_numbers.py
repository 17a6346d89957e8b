"""The few numbers that a response comes to, of a file's beam and of others."""

import numpy as np
import pytest

from antinode.beam.file import load_beam
from antinode.modes.backends import for_one
from antinode.response.file import load_response
from antinode.response.solve import response_numbers, size_of, solve_response

BEAM = """
[beam]
ends = { left = "clamped", right = "free" }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [EI, EI]
"""
RESPONSE = """
[response]
of = "beam.toml"
kind = "KIND"
[damping]
loss_factor = 0.02
[frequency]
from = "0.2 Hz"
to = "20 Hz"
points = 20
[time]
to = 2
step = 0.01
[[forces]]
x = 1
amplitude = "1 N"
psd = { frequency = [0.1, 30], level = [1, 1] }
history = { shape = "half_sine", height = "1 N", duration = "0.3 s" }
[[outputs]]
x = 1
quantity = "displacement"
"""
EQUIPMENT = '[[equipment]]\nname = "gyro"\nx = 1\nmass = 0.1\nallowed = "allowed.csv"\n'


def asked(folder, kind, EI=1.0, more=""):
    (folder / "beam.toml").write_text(BEAM.replace("EI, EI", f"{EI}, {EI}"))
    (folder / "allowed.csv").write_text("frequency [Hz], amplitude [m/s^2]\n0.1, 100\n30, 100\n")
    (folder / "response.toml").write_text(RESPONSE.replace("KIND", kind) + more)
    return load_response(folder / "response.toml")


@pytest.mark.parametrize("kind", ["harmonic", "random", "transient", "shock"])
def test_they_are_those_of_the_result(tmp_path, kind):
    problem = asked(tmp_path, kind)
    result = solve_response(problem)
    ((number,), warnings) = response_numbers(problem)
    assert warnings == result.warnings
    assert number.unit == "m"
    assert 0 < number.error < 1e-2 * number.value
    row = result.to_dict()["outputs"][0]
    told = {
        "harmonic": lambda: ("largest", row["peaks"][0]["magnitude"], row["peak_error"]),
        "random": lambda: ("rms", row["rms"], row["error"]),
        "transient": lambda: ("peak", row["peak"], row["peak_error"]),
        "shock": lambda: ("srs", max(row["srs"]), number.error),
    }[kind]()
    if kind == "shock":  # at the largest, no more than anywhere
        assert row["srs_error"][int(np.argmax(row["srs"]))] <= number.error <= row["error"]
    assert number.key == f"outputs.0.{told[0]}"
    assert (number.value, number.error) == pytest.approx(told[1:], rel=1e-12)


def test_another_beam_under_the_same_forces_with_the_same_equipment(tmp_path):
    problem = asked(tmp_path, "harmonic", 1.0, EQUIPMENT)
    stiff = asked(tmp_path, "harmonic", 3.0, EQUIPMENT)
    other = load_beam(tmp_path / "beam.toml").beam()
    numbers = response_numbers(problem, other).headlines
    assert [n.key for n in numbers] == ["outputs.0.largest", "equipment.0.margin"]
    same = response_numbers(stiff).headlines
    np.testing.assert_equal([n.value for n in numbers], [n.value for n in same])
    assert numbers[0].value != response_numbers(problem).headlines[0].value
    assert numbers[1].unit == "dB"
    verdict = solve_response(problem._replace(beam=stiff.beam)).verdicts[0]
    assert (numbers[1].value, numbers[1].error) == (verdict.margin_db, verdict.error_db)
    assert 0 < numbers[1].error < 1e-3


@pytest.mark.parametrize("kind", ["harmonic", "random", "transient", "shock"])
def test_a_small_problem_is_for_numpy_and_a_large_one_for_compiled_code(tmp_path, kind):
    problem = asked(tmp_path, kind)
    assert for_one(*size_of(problem)) == "numpy"
    many = np.linspace(0, 1, 1201)[1:-1]
    large = problem._replace(beam=problem.beam.with_breakpoints(list(many)))
    assert for_one(*size_of(large)) == "numba"
