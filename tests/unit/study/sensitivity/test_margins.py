"""Margins of stability in sensitivities: over the samples, and their exact derivatives."""

import numpy as np
import pytest

import antinode as an
from cli_run import run

COLUMN = """
[beam]
name = "column"
ends = { left = "clamped" }
[beam.stations]
x = [0, 0.5, 1]
mass_per_length = [1, 1, 1]
bending_stiffness = [1, 2, 2]
axial_force = [1, 1, 1]
"""
STUDY = """
case = "column.toml"
outputs = ["frequency_hz", "divergence_factor"]
[solve]
modes = 1
[[inputs]]
key = "bending_stiffness"
distribution = "normal"
sd = 0.05
mean = 1.0
[[inputs]]
key = "mass_per_length"
distribution = "normal"
sd = 0.05
mean = 1.0
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("margins")
    (folder / "column.toml").write_text(COLUMN)
    (folder / "study.toml").write_text(STUDY)
    return folder / "study.toml"


def test_a_divergence_goes_with_the_stiffness_and_not_with_the_mass(study):
    result = an.sensitivity(an.load_study(study), 16)
    (margin,) = result.responses
    assert margin.name == "divergence_factor"
    column = an.load_study(study).case.beam()
    assert margin.nominal == pytest.approx(column.stability().first.load_factor, rel=1e-7)
    assert margin.elasticity == pytest.approx([1.0, 0.0], abs=1e-6)
    assert margin.slope[0] == pytest.approx(margin.nominal, rel=1e-6)
    # the factor is the nominal one times the factor on the stiffness, sample by sample
    assert margin.sd / margin.nominal == pytest.approx(0.05, rel=0.5)
    assert margin.indices.total[0] > 0.8  # 1 but for 16 samples
    assert abs(margin.indices.total[1]) < 1e-6


def test_the_terminal_has_them(study):
    ended = run("sensitivity", study, "--samples", 8)
    assert ended.code == 0, ended
    assert "divergence factor" in ended.out
    assert np.isfinite(float(ended.out.split("divergence factor")[1].split()[0]))


def test_margins_of_axial_forces_are_refused_on_the_waters_stiffness(tmp_path):
    run("init", "--example", "sweep", tmp_path / "sweep")
    case = an.load_case(tmp_path / "sweep" / "case.toml", ["model.hydrodynamic_stiffness=tangent"])
    inputs = [{"key": "condition.speed", "values": [80.0]}]
    study = an.Study(case=case, inputs=inputs, outputs=("flutter_factor",))
    with pytest.raises(an.InputError, match="flutter_factor is a factor on axial forces alone"):
        an.sweep(study)
