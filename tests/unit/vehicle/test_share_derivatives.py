"""Derivatives by the shares of thrust and drag that turn with the body, against differences."""

import pytest

import antinode as an
from antinode.study.eigenvalues import eigenvalues_of
from antinode.vehicle.effects import effect_of_number
from antinode.vehicle.numbers import replaced
from antinode.vehicle.paths import find_place
from cli_run import run

STEP = 1e-3


def solved(case):
    (found,) = eigenvalues_of([case], [{"bending": 3, "longitudinal": 1}], 2)
    return found


@pytest.mark.parametrize("name", ["thrust_follows", "cavitator_follows"])
def test_by_a_share(name, tmp_path):
    run("init", tmp_path)
    shares = ["model.thrust_follows=0.7", "model.cavitator_follows=0.6"]
    case = an.load_case(tmp_path / "case.toml", shares)
    place = find_place(case, f"model.{name}")
    effect = effect_of_number(case, place)
    value = getattr(case.model, name)
    low, high = (
        solved(replaced(case, place.keys, value + sign * STEP)).modes["bending"].omega2
        for sign in (-1, 1)
    )
    slope = effect.slope(solved(case).sensitivity("bending"))
    assert slope == pytest.approx((high - low) / (2 * STEP), rel=1e-5)
    assert min(slope) > 10
    assert effect.slope(solved(case).sensitivity("longitudinal")) == pytest.approx(0)
