"""What shear does to the modes of many cases: as `solve_modes` estimates of each."""

import numpy as np
import pytest

import antinode as an
from antinode.study.cases import shear
from antinode.study.cases.chunks import compute_chunk
from antinode.study.cases.values import Cases
from antinode.study.design.points import points_of
from cli_run import run
from study_text import study

LOADS = """
inputs = [
  { key = "speed", low = 60, high = 120 },
  { key = "thrust", low = 0, high = 2.5e5 },
  { key = "fin_position", low = 4, high = 5.9 },
]
"""
BODY = """
inputs = [
  { key = "bending_stiffness", low = 0.8, high = 1.2 },
  { key = "axial_stiffness", low = 0.5, high = 1.5 },
  { key = "mass_per_length", low = 0.9, high = 1.1 },
  { key = "thrust", low = 0, high = 1e5 },
]
"""
WIDE = """
inputs = [
  { key = "speed", low = 40, high = 150 },
  { key = "thrust", low = 0, high = 2e5 },
  { key = "cavitation_number", low = 0.01, high = 0.1 },
]
"""
HULL = 'inputs = [{ key = "radius", values = [1, 1.02] }, { key = "speed", values = [70, 90] }]\n'


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shear")
    run("init", folder)
    return an.load_case(
        folder / "case.toml", ["model.end_force=fixed_direction", "model.theory=euler_bernoulli"]
    )


def compared(case, text, every):
    """The estimates of a chunk beside those of cases solved alone."""
    points = points_of(study(case, text))
    own = compute_chunk(points, 0)["model_error"]
    cases = Cases(points.study, points.variables, points.values(0))
    alone = [
        [m.model_error for m in an.solve_modes(cases.case(i), 6, families=["bending"]).modes
         if m.number]
        for i in range(0, len(cases), every)
    ]  # fmt: skip
    return own[::every], np.array(alone, dtype=float)


@pytest.mark.parametrize(
    ("text", "allowed"),
    [(LOADS + 'design = { kind = "sobol", number = 512 }', 0.05),
     (BODY + 'design = { kind = "sobol", number = 512 }', 0.02),
     (WIDE + 'design = { kind = "sobol", number = 512 }', 0.15),
     (HULL, 0.005)],
)  # fmt: skip
def test_estimates_are_those_of_each_case(case, text, allowed):
    own, alone = compared(case, text, 16 if "512" in text else 1)
    assert np.array_equal(np.isnan(own), np.isnan(alone))
    known = np.isfinite(alone)
    apart = np.abs(own / alone - 1)
    assert np.max(apart[known]) < allowed
    assert np.median(apart[known]) < allowed / 10
    assert np.max(np.abs(own - alone)[known]) < 0.01  # of the frequency


def test_a_case_stands_for_itself(case, monkeypatch):
    """With as many samples as cases nothing is interpolated."""
    monkeypatch.setattr(shear, "_SAMPLE", 64)
    own, alone = compared(case, BODY + 'design = { kind = "sobol", number = 64 }', 8)
    assert own == pytest.approx(alone, rel=2e-3)


def test_longitudinal_modes_have_no_shear(case):
    text = 'inputs = [{ key = "speed", values = [70, 80] }]\n'
    text += 'solve = { modes = 2, families = ["bending", "longitudinal"] }'
    found = compute_chunk(points_of(study(case, text)), 0)["model_error"]
    assert np.isfinite(found[:, :2]).all()
    assert np.isnan(found[:, 2:]).all()


def test_a_force_far_beyond_the_stiffness_in_shear_is_no_beam(tmp_path):
    """As the case alone says it: EA a billion times too small, and with it kGA."""
    run("init", tmp_path)
    case = an.load_case(tmp_path / "case.toml")
    text = 'inputs = [{ key = "axial_stiffness", values = [1, 1e-14] }]\nsolve.modes = 1\n'
    found = an.sweep(study(case, text))
    assert found.reason.values.tolist() == [0, 16]
