"""What shear does to the modes of many cases, solved: as each case alone has it."""

import numpy as np
import pytest

import antinode as an
from antinode.study.cases import bending
from antinode.study.cases.chunks import compute_chunk
from antinode.study.cases.values import Cases
from antinode.study.design.points import points_of
from cli_run import run
from study_text import study

LOADS = """
inputs = [
  { key = "speed", low = 60, high = 130 },
  { key = "thrust", low = 0, high = 2e5 },
  { key = "fin_position", low = 3.5, high = 5.9 },
  { key = "bending_stiffness", low = 0.8, high = 1.2 },
]
design = { kind = "sobol", number = 64 }
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("effect")
    run("init", folder)
    return an.load_case(folder / "case.toml")


@pytest.fixture(scope="module")
def points(case):
    return points_of(study(case, LOADS))


def test_effects_are_those_of_each_case_and_stated_errors_hold(points):
    found = compute_chunk(points, 0)
    cases = Cases(points.study, points.variables, points.values(0))
    for i in range(0, 64, 16):
        alone = an.solve_modes(cases.case(i), 6, families=["bending"], tolerance=1e-8)
        modes = [m for m in alone.modes if m.number]
        assert found["effect_of_shear"][i] == pytest.approx(
            [m.effect_of_shear for m in modes], abs=3e-7
        )
        hz = np.array([m.frequency_hz for m in modes])
        allowed = found["error_hz"][i] + [m.error_hz for m in modes]
        assert np.all(np.abs(found["frequency_hz"][i] - hz) <= allowed)
        assert np.all(found["error_hz"][i] <= 1e-6 * hz)


def test_a_root_that_a_prediction_missed_is_solved_again(points, monkeypatch):
    true = compute_chunk(points, 0)["effect_of_shear"]
    predict = bending.predict_many

    def missing(batch, width):
        omega2 = predict(batch, width)
        omega2[3, 4:] = 1.8 * omega2[3, 4:]
        omega2[5] = np.nan
        return omega2

    monkeypatch.setattr(bending, "predict_many", missing)
    assert compute_chunk(points, 0)["effect_of_shear"] == pytest.approx(true, abs=2e-7)
