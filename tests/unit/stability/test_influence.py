"""Derivatives of critical loads against differences of critical loads, to 1e-6."""

import json

import numpy as np
import pytest

import antinode as an
from cli_run import run

FOLLOWS = an.Ends("clamped", right_follower=1.0)
X = [0, 0.4, 1]


def beam(EI=(1.0, 1.0), m=(1.0, 1.0), N=(1.0, 0.6), ends=FOLLOWS, spring=3.0, tip=0.2, **more):
    held = an.Beam.from_stations(
        X, [*m, m[-1]], [*EI, EI[-1]], axial_force=[*N, N[-1]], ends=ends, **more
    )
    return held.with_attachments(an.Spring(0.4, translational=spring), an.PointMass(1.0, mass=tip))


def factor(problem, k, largest):
    return an.stability(problem, largest, tolerance=1e-11).critical[k].load_factor


CASES = {
    "flutter": {},
    "sub-tangential": {"ends": an.Ends("clamped", right_follower=0.75)},
    "divergence": {"ends": an.Ends("clamped")},
    "divergence of a share": {"ends": an.Ends("clamped", right_follower=0.3)},
    "free": {"ends": an.Ends("free", "free", right_follower=1.0)},
}


@pytest.mark.parametrize("name", CASES)
def test_against_differences(name):
    more = CASES[name]
    problem = beam(**more)
    found = an.stability(problem, tolerance=1e-11)
    k = next(i for i, c in enumerate(found.critical) if c.load_factor > 0)
    critical = found.critical[k]
    influence = an.critical_influence(problem, critical)
    assert influence.total == pytest.approx(1.0, abs=1e-8)
    step, beyond = 1e-4, 1.01 * critical.load_factor

    def slope(**changed):
        low, high = (
            factor(beam(**(more | {n: f(s) for n, f in changed.items()})), k, beyond)
            for s in (1 - step, 1 + step)
        )
        return (high - low) / (2 * step * critical.load_factor)

    scale = 1 + np.max(np.abs(influence.mass_per_length))
    for i in (0, 1):

        def one(s, i=i):
            return tuple(s if j == i else 1.0 for j in (0, 1))

        assert influence.bending_stiffness[i] == pytest.approx(slope(EI=one), abs=1e-6 * scale)
        assert influence.mass_per_length[i] == pytest.approx(slope(m=one), abs=1e-6 * scale)
    assert influence.springs == pytest.approx(slope(spring=lambda s: 3 * s), abs=1e-6 * scale)
    assert influence.point_masses == pytest.approx(slope(tip=lambda s: 0.2 * s), abs=1e-6 * scale)


def test_a_tapered_column():
    def tapered(s=1.0):
        return an.Beam.from_stations(
            [0, 1], [2, 1], [3, 1 * s], axial_force=[1, 1], ends=FOLLOWS, interpolation="linear"
        )

    critical = an.stability(tapered()).flutter
    influence = an.critical_influence(tapered(), critical)
    assert influence.total == pytest.approx(1.0, abs=1e-7)
    assert np.sum(influence.bending_stiffness) == pytest.approx(1.0, abs=1e-7)


LAWS = {
    "haringx, flutter": {"ends": FOLLOWS, "shear_form": "haringx"},
    "engesser, flutter": {"ends": FOLLOWS, "shear_form": "engesser"},
    "engesser, divergence": {"ends": an.Ends("clamped"), "shear_form": "engesser"},
}


@pytest.mark.parametrize("name", LAWS)
def test_shear_rotary_inertia_and_foundation_against_differences(name):
    def sheared(kGA=1.0, rotary=1.0, k=1.0):
        def column(value):
            return [value, value, value]

        return beam(
            **LAWS[name],
            theory="timoshenko",
            shear_stiffness=column(150.0 * kGA),
            rotary_inertia_per_length=column(0.004 * rotary),
            foundation_stiffness=column(9.0 * k),
        )

    problem = sheared()
    critical = next(c for c in an.stability(problem, tolerance=1e-11).critical if c.load_factor > 0)
    influence = an.critical_influence(problem, critical)
    assert influence.total == pytest.approx(1.0, abs=1e-8)
    step, beyond = 1e-3, 1.02 * critical.load_factor
    for key, column in (
        ("kGA", influence.shear_stiffness),
        ("rotary", influence.rotary_inertia),
        ("k", influence.foundation_stiffness),
    ):
        low, high = (factor(sheared(**{key: s}), 0, beyond) for s in (1 - step, 1 + step))
        slope = (high - low) / (2 * step * critical.load_factor)
        assert np.sum(column) == pytest.approx(slope, abs=3e-6)


def test_what_has_no_derivative_is_refused():
    rocket = an.Beam.from_stations([0, 1], [1, 3], [1, 1], axial_force=[0.2, 1])
    with pytest.raises(an.InputError, match="at once"):
        an.critical_influence(rocket, an.stability(rocket).critical[0])


def test_the_command_tells_it(tmp_path):
    path = tmp_path / "beck.toml"
    path.write_text(
        """
[beam]
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [1, 1]
"""
    )
    ended = run("stability", path, "--influence", "--json")
    (only,) = json.loads(ended.out)["critical"]
    assert only["influence"]["bending_stiffness"] == pytest.approx(1.0, abs=1e-9)
    assert only["influence"]["mass_per_length"] == pytest.approx(0.0, abs=1e-9)
    assert "EI" in run("stability", path, "--influence").out
