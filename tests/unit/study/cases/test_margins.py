"""Margins of stability as outputs of a study: those that `stability` gives each case."""

import numpy as np
import pytest

import antinode as an

ROCKET = """
[beam]
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [1, 1]
"""
STUDY = """
case = "beck.toml"
outputs = ["frequency_hz", "divergence_factor", "flutter_factor"]
[solve]
modes = 2
[[inputs]]
key = "ends.right_follower"
values = [0.0, 1.0]
[[inputs]]
key = "bending_stiffness"
values = [1.0, 2.0]
"""


def test_margins_of_every_case(tmp_path):
    (tmp_path / "beck.toml").write_text(ROCKET)
    (tmp_path / "study.toml").write_text(STUDY)
    found = an.sweep(an.load_study(tmp_path / "study.toml"))
    flutter, divergence = (found[f"{kind}_factor"].values for kind in ("flutter", "divergence"))
    assert flutter[2:] == pytest.approx([20.0509536190, 40.101907238], rel=1e-9)
    assert np.all(np.isnan(flutter[:2]))
    assert divergence[:2] == pytest.approx([np.pi**2 / 4, np.pi**2 / 2], rel=1e-9)
    assert np.all(np.isnan(divergence[2:]))
    assert found["flutter_factor"].attrs["units"] == "1"
