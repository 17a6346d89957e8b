"""Derivatives of critical loads against differences of critical loads, to 1e-6.

Everything that has a derivative changes at once, each by its own share of the step: a wrong part
moves the sum, and no two shares are so alike that one mistake could hide another.
"""

import json

import numpy as np
import pytest

import antinode as an
from antinode.stability.influence import critical_slopes
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
EI_SHARES, M_SHARES, SPRING_SHARE, TIP_SHARE = (1.0, -0.73), (-0.87, 0.61), 0.93, -0.52


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

    def moved(s):
        return beam(
            EI=tuple(1 + share * s for share in EI_SHARES),
            m=tuple(1 + share * s for share in M_SHARES),
            spring=3 * (1 + SPRING_SHARE * s),
            tip=0.2 * (1 + TIP_SHARE * s),
            **more,
        )

    low, high = (factor(moved(s), k, beyond) for s in (-step, step))
    expected = (
        influence.bending_stiffness @ EI_SHARES
        + influence.mass_per_length @ M_SHARES
        + SPRING_SHARE * influence.springs
        + TIP_SHARE * influence.point_masses
    )
    scale = 1 + np.max(np.abs(influence.mass_per_length))
    slope = (high - low) / (2 * step * critical.load_factor)
    assert expected == pytest.approx(slope, abs=1e-6 * scale)


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
    shares = {"kGA": 1.0, "rotary": -0.83, "k": 0.67}
    low, high = (
        factor(sheared(**{key: 1 + share * s for key, share in shares.items()}), 0, beyond)
        for s in (-step, step)
    )
    columns = influence.shear_stiffness, influence.rotary_inertia, influence.foundation_stiffness
    expected = sum(
        share * np.sum(column) for share, column in zip(shares.values(), columns, strict=True)
    )
    slope = (high - low) / (2 * step * critical.load_factor)
    assert expected == pytest.approx(slope, abs=3e-6)


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


@pytest.mark.parametrize("name", ["flutter", "divergence"])
def test_by_any_number_of_a_beam_against_differences(name):
    """The place of a spring, the share that turns, a stiffness: beams a little below and above."""
    more = CASES[name]
    problem = beam(**more)
    k, largest = 0, None
    critical = an.stability(problem, tolerance=1e-11).critical[k]
    largest = 1.01 * critical.load_factor

    def at(place=0.4, stiffer=1.0):
        found = beam(EI=(stiffer, 1.0), spring=0.0, **more)
        return found.with_attachments(an.Spring(place, translational=3.0))

    def slope(**given):
        (name, value), h = *given.items(), 1e-4
        low, high = (factor(at(**{name: value + s * h}), k, largest) for s in (-1, 1))
        return (high - low) / (2 * h)

    h = 2e-6
    sides = [
        (at(place=0.4 - h), at(place=0.4 + h), 2 * h),
        None,
        (at(stiffer=1 - h), at(stiffer=1 + h), 2 * h),
    ]
    exact = critical_slopes(problem, critical, sides)
    assert np.isnan(exact[1])
    assert exact[0] == pytest.approx(slope(place=0.4), rel=1e-5)
    assert exact[2] == pytest.approx(slope(stiffer=1.0), rel=1e-5)
    influence = an.critical_influence(problem, critical).bending_stiffness[0]
    assert exact[2] == pytest.approx(influence * critical.load_factor, rel=1e-6)
