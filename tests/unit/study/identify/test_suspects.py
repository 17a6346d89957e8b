"""What makes a fit poor is named: an unlikely misfit, one row, values far from their priors."""

import math

import numpy as np
import pytest

import antinode as an
from antinode.errors import InputError
from antinode.study.identify.identification import prepare
from antinode.study.identify.suspects import quality
from cli_run import run

SPEEDS = (70, 80, 90, 100, 110, 120)
SD = 2e-4
BODY = {"column": "bending_stiffness", "control_points": 3, "prior_sd": 0.2}
NOZZLE = {"key": "thrust", "prior": {"sd": "5 kN"}}


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("starter")
    run("init", path)
    return an.load_case(path / "case.toml", ["model.end_force=fixed_direction"])


@pytest.fixture(scope="module")
def observed(case):
    """Frequencies of the case itself with noise, by speed."""
    rng, found = np.random.default_rng(3), {}
    for speed in SPEEDS:
        condition = case.condition.model_copy(update={"speed": float(speed)})
        one = case.model_copy(update={"condition": condition})
        hz = an.solve_modes(one, 4, families=["bending"]).frequencies_hz("bending")
        found[speed] = (hz * (1 + SD * rng.standard_normal(4))).tolist()
    return found


def fitted(case, observed, fit=None, parameters=(NOZZLE,), distributions=(BODY,)):
    rows = [{"speed": v, "bending": hz} for v, hz in observed.items()]
    return an.identify(
        an.IdentificationProblem(
            case=case,
            observations=rows,
            parameters=list(parameters),
            distributions=list(distributions),
            fit={"relative_sd": SD} if fit is None else fit,
        )
    )


def with_word(result, word):
    return [text for text in result.warnings if word in text]


def test_a_good_fit_has_no_suspects(case, observed):
    result = fitted(case, observed)
    assert result.warnings == ()
    assert not quality(result.estimates).is_poor


def test_one_false_frequency_is_named(case, observed):
    false = {**observed, 100: [observed[100][0] * 1.2, *observed[100][1:]]}
    for fit in ({"relative_sd": SD}, {}):
        (text,) = with_word(fitted(case, false, fit), "alone spoils")
        assert text.startswith("row 4 alone")
        assert "bending 1 is farthest off" in text
    right = fitted(case, {v: hz for v, hz in observed.items() if v != 100})
    assert right.warnings == ()


def test_what_goes_with_a_row_is_what_a_fit_without_it_has_less(case, observed):
    """The first-order formula against the fit itself, where the model is all but linear."""
    off = {**observed, 90: [hz * (1 + 8 * SD) for hz in observed[90]]}
    whole = fitted(case, off)
    part = fitted(case, {v: hz for v, hz in off.items() if v != 90})
    rows = np.array([c.row for c in whole.comparisons])
    gone = whole.estimates.without(rows == SPEEDS.index(90) + 1)
    assert gone == pytest.approx(2 * (whole.cost - part.cost), rel=0.02)


def test_a_false_condition_is_named(case, observed):
    moved = {(97 if v == 120 else v): hz for v, hz in observed.items()}
    (text,) = with_word(fitted(case, moved), "alone spoils")
    assert text.startswith("row 6 alone")


def test_the_whole_misfit_says_what_was_to_be_expected(case, observed):
    rng = np.random.default_rng(5)
    rough = {v: [hz * (1 + 3 * SD * rng.standard_normal()) for hz in row]
             for v, row in observed.items()}  # fmt: skip
    result = fitted(case, rough)
    judged = quality(result.estimates)
    (text,) = with_word(result, "would be expected")
    r = result.estimates.residuals
    assert judged.rms == pytest.approx(math.sqrt(np.mean(r**2)))
    assert f"{judged.rms:.2g} of their standard deviations" in text
    assert not with_word(result, "alone spoils")


def test_few_freedoms_are_no_reason_to_warn(case, observed):
    """Nearly as many parameters as frequencies: a small rms is neither multiplied nor warned of."""
    few = dict(list(observed.items())[:2])
    result = fitted(case, few, distributions=[{**BODY, "control_points": 6, "prior_sd": 2.0}])
    judged = quality(result.estimates)
    assert judged.expected < 0.6
    assert judged.rms < 1
    assert not with_word(result, "expected")


def test_a_value_far_from_its_prior_is_named(case, observed):
    stiff = {v: [1.6 * hz for hz in row] for v, row in observed.items()}
    (text,) = with_word(fitted(case, stiff), "far from their priors")
    assert "bending stiffness at" in text
    assert "sd of the logarithm 0.2" in text


def test_a_speed_beyond_reason_is_a_sentence(case, observed):
    rows = [{"speed": v, "bending": hz} for v, hz in observed.items()]
    rows[2]["speed"] = 80_000
    for theory, match in (("euler_bernoulli", "modes diverge"), ("timoshenko", "kGA [+] N > 0")):
        model = case.model.model_copy(update={"theory": theory})
        own = case.model_copy(update={"model": model})
        problem = an.IdentificationProblem(case=own, observations=rows, parameters=[NOZZLE])
        with pytest.raises(InputError, match=f"row 3.*{match}"):
            prepare(problem)
