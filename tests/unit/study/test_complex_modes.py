"""Derivatives of complex modes on the water's stiffness, and what studies make of them."""

import numpy as np
import pytest

import antinode as an
from antinode.study.complex_modes import Beside, complex_modes
from antinode.study.design.file import Design
from antinode.study.design.points import points_of
from antinode.study.identify.identification import prepare
from antinode.study.sensitivity import sensitivity
from antinode.study.sensitivity.local import local_slopes
from antinode.vehicle.numbers import replaced, value_at
from cli_run import run
from water_elements import case_of

KEYS = [
    ("condition", "speed"),
    ("condition", "fin_position"),
    ("condition", "cavitator_angle"),
    ("condition", "burn_fraction"),
]


GROWN = Design(kind="saltelli", number=8)


@pytest.fixture(scope="module")
def starter(tmp_path_factory):
    folder = tmp_path_factory.mktemp("water")
    run("init", "--example", "sweep", folder)
    return folder / "case.toml"


@pytest.fixture(scope="module")
def wet(starter):
    return case_of(starter, theory="timoshenko")


@pytest.mark.parametrize("keys", KEYS, ids=lambda keys: keys[-1])
def test_exact_derivatives_are_those_of_eigenvalues_solved_anew(wet, keys):
    size = value_at(wet, keys) or 0.1
    middle = value_at(wet, keys) or 2e-3

    def beam(x):
        return replaced(wet, keys, x).beam()

    modes, h = complex_modes(beam(middle), 4, 1), 2e-6 * size
    exact = modes.slopes([Beside(beam(middle - h), beam(middle + h), 2 * h)])[:, 0]
    h = 3e-5 * size
    low, high = (complex_modes(beam(x), 4, 1).s for x in (middle - h, middle + h))
    np.testing.assert_allclose(
        exact, (high - low) / (2 * h), rtol=3e-6, atol=3e-6 * abs(exact).max()
    )


def observed(case, speed):
    """Frequencies of a case at a speed, None for modes that do not oscillate."""
    found = an.solve_modes(replaced(case, ("condition", "speed"), speed), 2, families=["bending"])
    modes = [m for m in found.modes if m.number]
    return {
        "speed": speed,
        "bending": [m.frequency_hz if m.frequency_hz > 0 else None for m in modes],
    }


@pytest.fixture(scope="module")
def twin(wet):
    column = ("vehicle", "stations", "bending_stiffness")
    stiffer = replaced(wet, column, np.asarray(wet.vehicle.stations.bending_stiffness) * 1.06)
    truth = replaced(stiffer, ("condition", "fin_position"), 5.05)
    return an.IdentificationProblem(
        case=wet,
        observations=[observed(truth, speed) for speed in (75.0, 95.0)],
        parameters=[{"key": "condition.fin_position", "lower": 4.8, "upper": 5.3}],
        distributions=[{"column": "bending_stiffness", "control_points": 1}],
        fit={"relative_sd": 1e-3, "tries": 0, "frequency_tolerance": 1e-5},
    )


def test_a_twin_on_the_waters_stiffness_is_recovered(twin):
    result = an.identify(twin)
    fin, stiffness = (p.value for p in result.parameters)
    assert fin == pytest.approx(5.05, rel=1e-4)
    assert stiffness == pytest.approx(1.06, rel=1e-4)
    assert any("touches on one side" in warning for warning in result.warnings)
    assert not any("hydrodynamic stiffness" in each for each in result.to_dict()["not_modelled"])


def test_its_jacobian_is_that_of_residuals(twin):
    misfit = prepare(twin)
    x = misfit.unknowns.start + np.array([0.01, -0.02])
    exact, h = misfit.jacobian(misfit.evaluate(x)), 1e-4
    for k in range(len(x)):
        away = h * np.eye(len(x))[k]
        low, high = (misfit.residuals(misfit.evaluate(x + sign * away)) for sign in (-1, 1))
        np.testing.assert_allclose(
            exact[:, k], (high - low) / (2 * h), atol=1e-5 * np.abs(exact).max()
        )


def test_a_mode_that_does_not_oscillate_has_no_frequency_to_observe(twin, wet):
    wrong = an.IdentificationProblem(
        case=wet,
        observations=[{"speed": 80.0, "bending": [1.887]}],
        parameters=twin.parameters[:1],
        fit=twin.fit,
    )
    with pytest.raises(an.InputError, match="bending 1 does not oscillate on the water"):
        an.identify(wrong)


def test_local_derivatives_of_a_study_are_exact(wet):
    study = an.Study(
        case=wet,
        inputs=[{"key": "condition.speed", "distribution": "normal", "sd": 0.005, "factor": True}],
        solve={"modes": 3},
    )
    slopes = local_slopes(study, points_of(study.model_copy(update={"design": GROWN})))
    assert not np.isfinite(slopes["bending 1"][0])  # overdamped: no frequency, no derivative
    hz, (by_factor,) = slopes["bending 3"]
    speeds = 80.0 * np.array([0.9999, 1.0, 1.0001])
    low, own, high = (complex_modes(replaced(wet, KEYS[0], v).beam(), 3, 4) for v in speeds)
    assert hz == pytest.approx(own.frequencies_hz[2], rel=1e-8)
    difference = (high.frequencies_hz[2] - low.frequencies_hz[2]) / 2e-4
    assert by_factor == pytest.approx(difference, rel=1e-4)


def test_modes_without_frequencies_are_left_out_of_sensitivities_and_said(wet):
    study = an.Study(case=wet, inputs=[{"key": "condition.speed", "values": [80.0]}])
    hz = np.array([[np.nan, 1.9], [np.nan, 1.8], [0.1, 1.9]])
    assert sensitivity.kept_modes(study, hz) == [1]
    assert "bending 1 does not oscillate in most cases" in sensitivity.left_out_mode(
        "bending 1", hz[:, 0]
    )["message"]  # fmt: skip
    with pytest.raises(an.ComputationError, match="narrow"):
        sensitivity.kept_modes(study, hz[:, :1])
