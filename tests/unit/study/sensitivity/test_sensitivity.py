"""Sensitivity: indices against closed forms and other code, derivatives against differences."""

import json

import numpy as np
import pytest
from scipy.stats import sobol_indices as scipy_indices

import antinode as an
from antinode.study.cases.values import Cases, case_of
from antinode.study.design.points import points_of
from antinode.study.sensitivity.command import read_uncertain
from antinode.study.sensitivity.indices import sobol_indices
from antinode.study.sensitivity.local import local_slopes
from antinode.study.sensitivity.sensitivity import sensitivity
from cli_run import refused, run


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    run("init", "--example", "sweep", folder)
    return folder


def study(folder, *uncertain, file="case.toml"):
    return read_uncertain(folder / file, (), uncertain)


def saltelli(folder, inputs, number):
    """Numbers between 0 and 1 in Saltelli's arrangement, shape (cases, inputs)."""
    names = ("speed", "thrust", "fin_position", "cavitator_angle")[:inputs]
    made = an.Study.model_validate(
        {
            "case": an.load_case(folder / "case.toml"),
            "inputs": [{"key": name, "low": 0, "high": 1} for name in names],
            "design": {"kind": "saltelli", "number": number},
            "run": {"chunk": 1000},
        }
    )
    points = points_of(made)
    return np.concatenate([points.values(k) for k in range(points.chunks)])


def ishigami(u):
    x = np.pi * (2 * u - 1)
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_indices_of_a_known_function(folder):
    """Ishigami and Homma (1990): S = 0.3139, 0.4424, 0; T = 0.5576, 0.4424, 0.2437."""
    found = sobol_indices(ishigami(saltelli(folder, 3, 4096)), 3)
    assert found.first == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)
    assert found.total == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.02)
    exact = np.array([0.5576, 0.4424, 0.2437])
    assert np.all((found.total_band[:, 0] < exact) & (exact < found.total_band[:, 1]))


def test_scipy_and_salib_agree(folder):
    f = ishigami(saltelli(folder, 3, 1024))
    own = sobol_indices(f, 3)
    blocks = f.reshape(5, 1024)
    theirs = scipy_indices(
        func={"f_A": blocks[:1], "f_B": blocks[1:2], "f_AB": blocks[2:, None]}, n=1024
    )
    assert own.total == pytest.approx(np.ravel(theirs.total_order), abs=1e-9)
    assert own.first == pytest.approx(np.ravel(theirs.first_order), abs=1e-9)
    sobol = pytest.importorskip("SALib.analyze.sobol")
    ordered = np.concatenate([blocks[:1], blocks[2:], blocks[1:2]]).T.ravel()
    problem = {"num_vars": 3, "names": ["a", "b", "c"], "bounds": [[0, 1]] * 3}
    other = sobol.analyze(problem, ordered, calc_second_order=False, seed=1)
    assert own.total == pytest.approx(other["ST"], abs=0.01)
    assert own.first == pytest.approx(other["S1"], abs=0.01)


def test_a_constant_has_no_indices():
    assert np.isnan(sobol_indices(np.ones(40), 2).total).all()


INPUTS = {
    "speed=1%": ("condition", "speed"),
    "thrust=1kN": ("condition", "thrust"),
    "cavitation_number=1%": ("condition", "cavitation_number"),
    "fin_position=1cm": ("condition", "fin_position"),
    "cavitator.diameter=1mm": ("vehicle", "cavitator", "diameter"),
    "bending_stiffness=1%": ("vehicle", "stations", "bending_stiffness"),
    "mass_per_length=1%": ("vehicle", "stations", "mass_per_length", "initial"),
}


def test_derivatives_are_those_of_differences(folder):
    made = study(folder, *INPUTS)
    design = an.Study.model_fields["design"].annotation(kind="saltelli", number=8)
    slopes = local_slopes(made, points_of(made.model_copy(update={"design": design})))
    for k, (text, keys) in enumerate(INPUTS.items()):
        node, step = made.case, 2e-5
        for key in keys:
            node = node[key] if isinstance(node, dict) else getattr(node, key)
        ends = []
        for sign in (-1, 1):
            one = case_of(made.case, {keys: [np.asarray(node) * (1 + sign * step)]}, 0)
            solved = an.solve_modes(one, 6, tolerance=1e-11, families=["bending"])
            ends.append(solved.frequencies_hz())
        size = 1.0 if "%" in text else float(node)  # a percentage is of a factor, which is 1
        difference = (ends[1] - ends[0]) / (2 * step * size)
        own = np.array([slopes[f"bending {m}"][1][k] for m in range(1, 7)])
        assert own == pytest.approx(difference, rel=2e-4, abs=2e-6 * np.abs(difference).max())


def test_the_rows_of_a_column_add_up_to_the_column(folder):
    rows = len(an.load_case(folder / "case.toml").vehicle.stations.x)
    keys = [f"stations.mass_per_length.{k}" for k in range(rows)]
    made = study(folder, *(f"{key}=1%" for key in keys), "mass_per_length=1%")
    inputs = [i.model_copy(update={"name": f"row {k}"}) for k, i in enumerate(made.inputs)]
    made = made.model_copy(update={"inputs": tuple(inputs)})
    design = an.Study.model_fields["design"].annotation(kind="saltelli", number=8)
    slopes = local_slopes(made, points_of(made.model_copy(update={"design": design})))
    for _, slope in slopes.values():
        assert slope[:-1].sum() == pytest.approx(slope[-1], rel=1e-9)


def test_small_deviations_follow_from_the_derivatives(folder):
    made = study(folder, "bending_stiffness=0.5%", "mass_per_length=0.5%", "thrust=0.5kN")
    result = sensitivity(made, 256)
    for mode in result.modes:
        parts = mode.slope * [0.005, 0.005, 500]
        assert mode.sd == pytest.approx(np.sqrt(np.sum(parts**2)), rel=0.05)
        assert mode.indices.total == pytest.approx(parts**2 / np.sum(parts**2), abs=0.08)
        assert mode.band[0] < mode.nominal < mode.band[1]
        assert mode.elasticity[1] == pytest.approx(-0.5, abs=1e-5)


def test_samples_that_diverge_are_counted_and_said(folder):
    made = study(folder, "thrust=20%", "bending_stiffness=5%")
    changed = made.case.condition.model_copy(update={"thrust": 190e3})
    fixed = {"condition": changed, "model": an.Model(end_force="fixed_direction")}
    made = made.model_copy(update={"case": made.case.model_copy(update=fixed)})
    result = sensitivity(made, 32)
    design = made.design.model_copy(update={"kind": "saltelli", "number": 32})
    points = points_of(made.model_copy(update={"design": design}))
    cases = Cases(made, points.variables, points.values(0))
    kinds = [an.solve_modes(cases.case(i), 1, families=["bending"]).mode("bending", 1).kind
             for i in range(len(cases))]  # fmt: skip
    diverges = np.array([kind == "divergent" for kind in kinds])
    first = result.modes[0]
    assert first.without == diverges.sum() > 0
    assert first.used == (~diverges.reshape(-1, 32).any(axis=0)).sum()
    (told,) = result.left_out
    assert (told["count"], told["first_case"]) == (diverges.sum(), np.flatnonzero(diverges)[0])
    assert told["share"] == pytest.approx(diverges.mean())
    assert f"the {first.used} of 32 samples" in told["message"]
    assert "ranking" in told["message"]
    assert result.warnings[0] is told
    assert any("past buckling" in w["message"] for w in result.warnings[1:])
    data = result.to_dict()
    assert data["modes"][0]["cases_without_frequency"] == diverges.sum()
    assert data["modes"][1]["samples_used"] == 32
    assert data["warnings"][0]["count"] == diverges.sum()


def test_the_command_prints_draws_and_stores(folder, tmp_path):
    arguments = ("sensitivity", folder / "samples.toml", "--samples", 64, "--plot",
                 tmp_path / "t.png", "--store", tmp_path / "s.zarr")  # fmt: skip
    ended = run(*arguments)
    assert ended.code == 0
    assert "64 samples, 448 cases, 0 failed" in ended.out
    assert (tmp_path / "t.png").stat().st_size > 20_000
    data = json.loads(run(*arguments, "--json").out)
    assert [m["name"] for m in data["modes"]] == [f"bending {k}" for k in range(1, 7)]
    assert len(data["modes"][0]["inputs"]) == 5


def test_what_is_wrong_is_said(folder):
    case = folder / "case.toml"
    refused(run("sensitivity", case), "--uncertain")
    refused(run("sensitivity", case, "--uncertain", "speed"), "standard deviation")
    refused(run("sensitivity", case, "--uncertain", "sped=1%"), "speed")
    refused(run("sensitivity", case, "--uncertain", "speed=1kg"), "1kg")
    refused(run("sensitivity", case, "--uncertain", "speed=x%"), "no number")
    refused(run("sensitivity", folder / "study.toml"), "range")
    ended = run("sensitivity", case, "--uncertain", "fin_position=20m", "--samples", "32")
    refused_words = ("of the samples", "narrow")
    assert ended.code == 1
    assert all(word in ended.err for word in refused_words)


def test_workers_and_a_scheduler_contradict(folder):
    both = ("--workers", "2", "--scheduler", "tcp://127.0.0.1:9")
    refused(run("sensitivity", folder / "samples.toml", *both), "--workers and --scheduler")


def test_a_store_of_another_study_is_replaced_where_that_is_wished(folder, tmp_path):
    store, few = tmp_path / "s.zarr", ("--samples", "8", "--set", "solve.modes=2")
    assert run("sensitivity", folder / "samples.toml", "--store", store, *few).code == 0
    other = ("sensitivity", folder / "samples.toml", "--store", store, "--samples", "16")
    refused(run(*other), "another study", "--overwrite")
    assert run(*other, "--overwrite").code == 0
