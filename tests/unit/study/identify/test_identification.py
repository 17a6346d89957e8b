"""Identification: derivatives against differences, twins, pairing, what stays open, outputs."""

import json
import math
import tomllib

import numpy as np
import pytest
from validation.identification import (
    BOUNDS,
    MODES,
    draw,
    identifiable,
    identify_twin,
    problem,
)

import antinode as an
from antinode.study.eigenvalues import eigenvalues_of
from antinode.study.identify.columns import second_differences
from antinode.study.identify.fit import Search, robust_cost
from antinode.study.identify.fitted_case import case_toml, stations_csv, write_identification
from antinode.study.identify.identification import prepare
from antinode.study.identify.observations import pair
from antinode.vehicle.columns import hats, interpolation_matrix
from cli_run import run

FIXED = an.Model(end_force="fixed_direction")
"""A thrust that turned with the body would tell itself from a drag that does not."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("starter")
    assert run("init", path).code == 0
    return path


@pytest.fixture(scope="module")
def case(folder):
    return an.load_case(folder / "case.toml")


# --- derivatives ------------------------------------------------------------------------------

EVERYTHING = {
    "parameters": [
        {"key": "vehicle.cavitator.diameter", "prior": {"sd": "2 mm"}},
        {"key": "thrust", "scale": "log"},
        {"key": "fins.0.thickness"},
        {"key": "fins.0.tip_radius"},
        {"key": "fins.0.position", "start": "5.1 m"},
        {"key": "model.gravity_rise_factor"},
        {"key": "model.thrust_follows"},
        {"key": "model.cavitator_follows"},
        {"key": "vehicle.stations.axial_stiffness.9"},
        {"key": "extra_drag", "start": "0.5 kN", "per_row": True},
    ],
    "distributions": [
        {"column": "mass_per_length", "control_points": 3},
        {"column": "mass_per_length:burnt", "control_points": 2, "relative_to": "mass_per_length"},
        {"column": "bending_stiffness", "control_points": [0.5, 2.0, 3.5, 5.5], "fitted": "value"},
        {"column": "radius", "control_points": 1},
    ],
    "fit": {"frequency_tolerance": 1e-9},
}
ROWS = [
    {"bending": [3.2, 10.5, 20.7], "longitudinal": [56.0, 113.0]},
    {"cavitation_number": 0.023, "burn_fraction": 0.4, "bending": [3.2] * 6},
    {"speed": 110, "mass_state": "burnt", "bending": [3.2, math.nan, 20.0]},
    {"speed": 60, "cavitator_angle": "5 deg", "bending": [3.2] * 6},
    *({"speed": v, "bending": [3.2] * 6} for v in (70, 90, 120)),
]


def everything(case, **changed):
    return prepare(an.IdentificationProblem(case=case, observations=ROWS, **EVERYTHING, **changed))


def differences(misfit, vector, entry):
    """Central differences of the residuals of the whole computation, of fourth order."""

    def difference(step):
        low, high = vector.copy(), vector.copy()
        low[entry], high[entry] = low[entry] - step, high[entry] + step
        return (
            misfit.residuals(misfit.evaluate(high)) - misfit.residuals(misfit.evaluate(low))
        ) / (2 * step)

    step = 5e-5 * max(abs(vector[entry]), 0.3)  # short of the kinks of the loads
    return (4 * difference(step / 2) - difference(step)) / 3


@pytest.mark.parametrize(
    ("interpolation", "axial_force"),
    [("step", "exact"), ("step", "element_midpoint"), ("linear", "exact"), ("log", "exact")],
)
def test_the_jacobian_is_that_of_the_whole_computation(folder, interpolation, axial_force):
    wet = ["model.fin_added_mass=plate", "model.planing_added_mass=wedge"]
    shares = [*(wet if interpolation == "linear" else [])]
    shares += ["model.thrust_follows=0.9", "model.cavitator_follows=0.8"]
    chosen = [f"vehicle.interpolation={interpolation}", f"model.axial_force={axial_force}", *shares]
    misfit = everything(an.load_case(folder / "case.toml", chosen))
    random = np.random.default_rng(3)
    vector = misfit.unknowns.start * (1 + 2e-3 * random.normal(size=len(misfit.unknowns.items)))
    jacobian = misfit.jacobian(misfit.evaluate(vector))
    for k, item in enumerate(misfit.unknowns.items):
        size = np.abs(jacobian[:, k]).max()
        if item.label == "fins.0.position" and axial_force == "element_midpoint":
            continue  # between elements the step of N does not move
        assert size > 0, item.label
        error = np.abs(differences(misfit, vector, k) - jacobian[:, k]).max() / size
        assert error < 1e-6, (item.label, error)


def test_priors_and_smoothness_have_their_derivatives(case):
    distributions = [{"column": "bending_stiffness", "segments": True, "smoothness": 3.0}]
    parameters = [
        {"key": "thrust", "prior": {"mean": "45 kN", "sd": "5 kN"}, "scale": "log"},
        {"key": "vehicle.cavitator.diameter", "prior": {"kind": "lognormal", "sd": 0.05}},
        {"key": "fins.0.thickness", "prior": {"sd": "1 mm"}},
    ]
    unknowns = prepare(
        an.IdentificationProblem(
            case=case, observations=ROWS, parameters=parameters, distributions=distributions
        )
    ).unknowns
    vector = unknowns.start * 1.01
    jacobian = unknowns.prior_jacobian(vector)
    assert jacobian.shape == (3 + 17, 3 + 19)
    for k in range(len(vector)):
        step = np.zeros(len(vector))
        step[k] = 1e-6
        low, high = unknowns.prior_residuals(vector - step), unknowns.prior_residuals(vector + step)
        assert (high - low) / 2e-6 == pytest.approx(jacobian[:, k], rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("how", ["step", "linear", "log"])
def test_hats_are_derivatives_of_a_column_and_of_its_integral(how):
    from antinode.beam.mass import MassDistribution

    stations, column = np.array([0.0, 1.0, 3.0, 4.0]), np.array([2.0, 5.0, 1.0, 3.0])
    x = np.array([0.3, 1.7, 3.9])
    found = hats(x, stations, column, how)

    def distribution(values):
        after = values[:-1] if how == "step" else values[1:]
        return MassDistribution(stations, np.stack([values[:-1], after], axis=1), how)

    for k in range(4):
        step = np.zeros(4)
        step[k] = 1e-5
        low, high = distribution(column - step), distribution(column + step)
        assert found.value[:, k] == pytest.approx((high.at(x) - low.at(x)) / 2e-5, abs=1e-9)
        ahead = (high.moments(np.append(x, 4.0))[0] - low.moments(np.append(x, 4.0))[0]) / 2e-5
        assert found.ahead[:, k] == pytest.approx(ahead, abs=1e-9)


def test_columns_interpolate_and_second_differences_vanish_on_lines():
    points, x = np.array([0.0, 1.0, 3.0, 4.0]), np.linspace(0, 4, 9)
    for how in ("linear", "cubic"):
        assert interpolation_matrix(points, x, how) @ (2 * points + 1) == pytest.approx(2 * x + 1)
    assert second_differences(points) @ (2 * points + 1) == pytest.approx(0, abs=1e-12)
    even = second_differences(np.arange(4.0))
    assert even @ np.arange(4.0) ** 2 == pytest.approx(2.0)


def test_the_response_agrees_with_solve_modes(case):
    (found,) = eigenvalues_of([case], [{"bending": 6, "longitudinal": 2}], 4)
    result = an.solve_modes(case, 6, tolerance=1e-9)
    for family, number in (("bending", 6), ("longitudinal", 2)):
        exact = result.frequencies_hz(family)[:number]
        assert found.frequencies_hz(family) == pytest.approx(exact, rel=1e-8)


# --- fits -------------------------------------------------------------------------------------


@pytest.mark.parametrize("twin", [0, 1])
def test_a_twin_is_found_within_its_intervals(case, twin):
    pairs, result = identify_twin(case, 2026, twin)
    known = identifiable(pairs)
    assert len(known) >= 8
    assert np.mean([p.covered for p in known]) >= BOUNDS[0] - 0.1
    assert result.rms_relative < 1.2e-4
    assert not result.interrupted


def exact_problem(case, **fit):
    """Two parameters and exact data."""
    parameters = [
        {"key": "thrust", "lower": "20 kN", "upper": "90 kN", "start": "40 kN"},
        {"key": "vehicle.cavitator.diameter", "scale": "log", "start": "78 mm"},
    ]
    rows = [
        {"cavitation_number": s, "bending": bending(case, s), "name": f"sigma {s}"}
        for s in (0.016, 0.02)
    ]
    return an.IdentificationProblem(
        case=case, observations=rows, parameters=parameters, fit={"relative_sd": 1e-6, **fit}
    )


def bending(case, sigma):
    condition = case.condition.model_copy(update={"cavitation_number": sigma})
    changed = an.Case(vehicle=case.vehicle, condition=condition)
    result = an.solve_modes(changed, MODES, tolerance=1e-9, families=["bending"])
    return result.frequencies_hz().tolist()


def test_exact_data_give_the_exact_parameters(case):
    result = an.identify(exact_problem(case, starts=3, seed=1))
    assert result.parameter("thrust").value == pytest.approx(50e3, rel=1e-6)
    assert result.parameter("cavitator.diameter").value == pytest.approx(0.08, rel=1e-7)
    assert len(result.starts) == 3
    assert result.worst_relative < 1e-8
    assert result.case.condition.thrust == result.parameter("thrust").value
    row = an.solve_modes(result.row_case(1), 2)
    assert row.frequencies_hz() == pytest.approx(bending(case, 0.016)[:2], rel=1e-7)
    with pytest.raises(an.InputError, match="no parameter"):
        result.parameter("trust")


def test_starts_repeat_with_their_seed(case):
    first, second, other = (
        an.identify(exact_problem(case, starts=2, seed=s, max_evaluations=2)) for s in (1, 1, 2)
    )
    assert [s.cost for s in first.starts] == [s.cost for s in second.starts]
    assert first.starts[0].cost == other.starts[0].cost
    assert first.starts[1].cost != other.starts[1].cost


def test_noise_is_estimated_where_none_is_given(case):
    given = exact_problem(case).model_copy(update={"fit": type(exact_problem(case).fit)()})
    noise = np.random.default_rng(1).normal(size=(2, MODES))
    rows = [
        {
            "cavitation_number": s,
            "bending": (np.array(bending(case, s)) * (1 + 1e-3 * r)).tolist(),
        }
        for s, r in zip((0.016, 0.02), noise, strict=True)
    ]
    result = an.identify(
        an.IdentificationProblem(
            case=case, observations=rows, parameters=given.parameters, fit=given.fit
        )
    )
    assert not result.estimates.known_noise
    assert result.estimates.freedoms == pytest.approx(10, abs=1e-6)
    assert 0.5e-3 < 1e-3 * result.estimates.noise < 2e-3
    low, high = result.parameter("thrust").interval
    assert low < 50e3 < high
    assert result.estimates.quantile == pytest.approx(2.228, abs=1e-3)


def test_an_interruption_keeps_the_best_so_far(case, monkeypatch):
    calls = []
    plain = Search.residuals

    def interrupt(self, vector):
        calls.append(1)
        if len(calls) > 4:
            raise KeyboardInterrupt
        return plain(self, vector)

    monkeypatch.setattr(Search, "residuals", interrupt)
    lines = []
    result = an.identify(exact_problem(case), progress=lines.append)
    assert result.interrupted
    assert "interrupted" in result.warnings[0]
    assert lines[-1].startswith("interrupted")
    assert result.worst_relative < 1e-2  # better than the start


def test_a_trade_off_is_named(case):
    """Thrust and a drag at the tail cancel in N: the data cannot tell them apart."""
    case = case.model_copy(update={"model": FIXED})
    parameters = [
        {"key": "thrust", "prior": {"sd": "5 kN"}},
        {"key": "extra_drag", "start": "0 kN", "name": "tail drag", "prior": {"sd": "5 kN"}},
    ]
    at_tail = an.Case(
        vehicle=case.vehicle,
        condition=case.condition.model_copy(update={"extra_drag_position": case.vehicle.length}),
        model=FIXED,
    )
    rows = [{"bending": bending(case, 0.02)}]
    result = an.identify(
        an.IdentificationProblem(
            case=at_tail, observations=rows, parameters=parameters, fit={"relative_sd": 1e-4}
        )
    )
    (direction,) = result.estimates.undetermined
    assert direction.singular_value < 1e-6
    assert len(direction.entries) == 2
    words = result.to_dict()["words"]
    assert any("thrust and tail drag trade off" in w or "tail drag and thrust" in w for w in words)
    assert result.estimates.strong_correlations[0][2] > 0.99


def test_without_a_prior_what_is_open_has_no_interval(case):
    case = case.model_copy(update={"model": FIXED})
    parameters = [
        {"key": "thrust"},
        {"key": "extra_drag", "start": "0 kN"},
    ]
    at_tail = an.Case(
        vehicle=case.vehicle,
        condition=case.condition.model_copy(update={"extra_drag_position": case.vehicle.length}),
        model=FIXED,
    )
    result = an.identify(
        an.IdentificationProblem(
            case=at_tail,
            observations=[{"bending": bending(case, 0.02)}],
            parameters=parameters,
            fit={"relative_sd": 1e-4},
        )
    )
    assert math.isinf(result.parameter("thrust").sd)
    assert result.to_dict()["parameters"][0]["sd"] is None


def test_a_bound_is_said(case):
    given = exact_problem(case)
    tight = given.parameters[0].model_copy(update={"upper": "42 kN"})
    result = an.identify(
        an.IdentificationProblem(
            case=case,
            observations=given.observations,
            parameters=[tight, given.parameters[1]],
            fit=given.fit,
        )
    )
    thrust = result.parameter("thrust")
    assert thrust.value == pytest.approx(42e3, rel=1e-6)
    assert thrust.at_bound
    assert math.isnan(thrust.sd)
    assert any("at a bound" in w and "thrust" in w for w in result.warnings)


def test_shapes_pair_modes_by_mac(case):
    result = an.solve_modes(case, 4, families=["bending"])
    x = np.linspace(0.2, 5.8, 12)
    names = [m.name for m in result.family("bending")]
    shapes = result.at(x)[..., 0]
    one, three = (shapes[:, names.index(f"bending {k}")] for k in (1, 3))
    hz = result.frequencies_hz()
    row = {
        "bending": [hz[0], hz[2]],
        "shapes": [
            {"number": 1, "x": x.tolist(), "displacement": one.tolist()},
            {"number": 2, "x": x.tolist(), "displacement": (-3 * three).tolist()},
        ],
    }
    problem = an.IdentificationProblem(
        case=case, observations=[row], parameters=[{"key": "thrust", "start": "49 kN"}]
    )
    misfit = prepare(problem)
    (solved,) = misfit.evaluate(misfit.unknowns.start).solved
    found = pair(misfit.rows[0].families["bending"], solved.modes["bending"])
    assert found.index.tolist() == [0, 2]
    assert np.all(found.mac > 0.999)
    fitted = an.identify(problem)
    assert fitted.parameter("thrust").value == pytest.approx(50e3, rel=1e-4)
    assert [c.paired for c in fitted.comparisons] == [1, 3]


def test_robust_costs_are_those_of_scipy():
    from scipy.optimize import least_squares

    r = np.array([0.1, -0.7, 2.0, 30.0])
    for loss in ("linear", "soft_l1", "huber", "cauchy", "arctan"):
        found = least_squares(lambda x: r + 0 * x[0], [0.0], loss=loss, max_nfev=1)
        assert robust_cost(r, loss) == pytest.approx(found.cost)


def test_validation_draws_are_those_of_the_problem(case):
    values, noisy = draw(case, 2026, 0)
    assert noisy.shape == (12, MODES)
    assert len(values) == len(prepare(problem(case)).unknowns.items)


# --- files ------------------------------------------------------------------------------------


def test_a_case_survives_being_written(case, tmp_path):
    strange = case.model_copy(
        update={
            "vehicle": case.vehicle.model_copy(update={"name": 'a "quoted" \\ name\n'}),
            "model": an.Model(planing="none", gravity_rise_factor=0.5),
        }
    )
    (tmp_path / "case.toml").write_text(case_toml(strange, "# x\n"), encoding="utf-8")
    text = stations_csv(strange)
    (tmp_path / "stations.csv").write_text(text, encoding="utf-8")
    back = an.load_case(tmp_path / "case.toml")
    assert back.condition == case.condition
    assert back.model == strange.model
    assert back.vehicle.name == strange.vehicle.name
    assert back.vehicle.fins == case.vehicle.fins
    assert [c[0] for c in back.vehicle.stations.columns()] == [
        c[0] for c in case.vehicle.stations.columns()
    ]
    for (_, a, _), (_, b, _) in zip(
        back.vehicle.stations.columns(), case.vehicle.stations.columns(), strict=True
    ):
        assert np.array_equal(a[:-1], b[:-1])


def test_results_are_written_and_never_over_others(case, tmp_path):
    result = an.identify(exact_problem(case))
    written = write_identification(result, tmp_path / "out")
    assert {p.name for p in written} == {p.name for p in (tmp_path / "out").iterdir()}
    fitted = an.load_case(tmp_path / "out" / "case.toml")
    assert fitted.condition.thrust == result.case.condition.thrust
    data = json.loads((tmp_path / "out" / "identification.json").read_text())
    assert data["schema_version"] == 1
    assert data["rows"][0]["observed_hz"] == pytest.approx(bending(case, 0.016)[0])
    tomllib.loads((tmp_path / "out" / "case.toml").read_text())
    with pytest.raises(an.InputError, match="exists already"):
        write_identification(result, tmp_path / "out")
    write_identification(result, tmp_path / "out", overwrite=True)


def test_a_fitted_case_keeps_the_comments_of_its_file(case, folder, tmp_path):
    text = (folder / "case.toml").read_text(encoding="utf-8")
    problem = exact_problem(case).model_copy(update={"case_text": text})
    result = an.identify(problem)
    write_identification(result, tmp_path / "out")
    kept = (tmp_path / "out" / "case.toml").read_text(encoding="utf-8").splitlines()
    assert kept[0].startswith("# identified from observed frequencies")
    changed = [line for line in text.splitlines() if line not in kept]
    assert [line.partition(" ")[0] for line in changed] == ["diameter", "thrust"]
    assert any(line.startswith("thrust = ") and "# T at the tail" in line for line in kept)
    fitted = an.load_case(tmp_path / "out" / "case.toml")
    assert fitted.condition == result.case.condition


def test_an_extra_drag_steps_n_where_it_acts(case):
    at_fins, behind = (
        an.Case(
            vehicle=case.vehicle,
            condition=case.condition.model_copy(
                update={"extra_drag": 3e3, "extra_drag_position": x}
            ),
        )
        for x in (None, 5.5)
    )
    for changed, x in ((at_fins, 5.0), (behind, 5.5)):
        force = changed.loads.forces[-1]
        assert (force.name, force.x, force.F_X) == ("extra drag", x, 3e3)
        assert changed.loads.a_X == pytest.approx(case.loads.a_X - 3e3 / case.loads.mass)
        assert changed.loads.checks.worst < 1e-12
    off = case.condition.model_copy(update={"extra_drag": 1.0, "extra_drag_position": 7.0})
    with pytest.raises(an.InputError, match="extra_drag_position"):
        an.compute_loads(case.vehicle, off)
