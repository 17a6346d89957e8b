"""Designs: grids, tables and samples, and studies that are refused in one sentence."""

import tomllib

import numpy as np
import pytest

import antinode as an
from antinode.study.design.file import Study
from antinode.study.design.points import points_of
from antinode.study.design.samples import SobolSamples, latin_column
from cli_run import contents, refused, run


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starter")
    run("init", folder)
    return an.load_case(folder / "case.toml")


def study(case, text):
    return Study.model_validate({**tomllib.loads(text), "case": case})


def values(points):
    return np.concatenate([points.values(k) for k in range(points.chunks)])


GRID = """
inputs = [
  { key = "speed", low = "60 m/s", high = "80 m/s", number = 3 },
  { key = "thrust", values = ["1 kN", 2000] },
]
run.chunk = 4
"""


def test_a_grid_runs_through_every_combination_the_last_input_fastest(case):
    points = points_of(study(case, GRID))
    assert (points.cases, points.shape, points.chunks) == (6, (3, 2), 2)
    speeds, thrusts = values(points).T
    assert speeds.tolist() == [60, 60, 70, 70, 80, 80]
    assert thrusts.tolist() == [1000, 2000] * 3


def test_a_zip_goes_side_by_side(case):
    points = points_of(
        study(
            case,
            """
            inputs = [{ key = "time", values = [0, "1 min"] }, { key = "speed", values = [60, 90] }]
            design.kind = "zip"
            """,
        )
    )
    assert values(points).tolist() == [[0, 60], [60, 90]]
    assert [v.unit for v in points.variables] == ["s", "m/s"]


def test_logarithmic_spacing(case):
    text = 'inputs = [{ key = "thrust", low = 10, high = 1000, number = 3, spacing = "log" }]'
    assert values(points_of(study(case, text)))[:, 0] == pytest.approx([10, 100, 1000])


SAMPLES = """
inputs = [
  { key = "speed", low = 60, high = 80 },
  { key = "thrust", distribution = "normal", mean = "50 kN", sd = "5 kN", low = "45 kN" },
  { key = "cavitator.diameter", distribution = "lognormal", sd = 0.1 },
  { key = "condition.cavitation_number", distribution = "loguniform", low = 0.01, high = 0.1 },
  { key = "fin_position", distribution = "triangular", low = 4, mean = 5, high = 5.5 },
]
design = { kind = "KIND", number = 3000, seed = 7 }
run.chunk = 700
"""


@pytest.mark.parametrize("kind", ["random", "latin_hypercube", "sobol"])
def test_samples_follow_their_distributions(case, kind):
    v = values(points_of(study(case, SAMPLES.replace("KIND", kind))))
    allowed = 0.05 if kind == "random" else 0.01
    assert v[:, 0].mean() == pytest.approx(70, rel=allowed)
    assert 60 <= v[:, 0].min() < v[:, 0].max() <= 80
    # a normal distribution cut one deviation below its mean: mean + sd phi(1)/Phi(1)
    assert v[:, 1].min() >= 45_000
    assert v[:, 1].mean() == pytest.approx(50_000 + 5_000 * 0.24197 / 0.84134, rel=allowed)
    assert np.median(v[:, 2]) == pytest.approx(0.08, rel=allowed)
    assert np.log(v[:, 2]).std() == pytest.approx(0.1, rel=5 * allowed)
    assert np.median(v[:, 3]) == pytest.approx(np.sqrt(0.001), rel=5 * allowed)
    assert v[:, 4].mean() == pytest.approx((4 + 5 + 5.5) / 3, rel=allowed)


@pytest.mark.parametrize("kind", ["random", "latin_hypercube", "sobol"])
def test_a_chunk_is_made_by_itself(case, kind):
    points = points_of(study(case, SAMPLES.replace("KIND", kind)))
    whole = values(points)
    again = points_of(study(case, SAMPLES.replace("KIND", kind)))
    assert np.array_equal(again.values(3), whole[2100:2800])
    other = study(case, SAMPLES.replace("KIND", kind).replace("seed = 7", "seed = 8"))
    assert not np.any(values(points_of(other))[:, 0] == whole[:, 0])


def test_sobol_chunks_do_not_depend_on_their_size(case):
    text = SAMPLES.replace("KIND", "sobol")
    small = values(points_of(study(case, text)))
    large = values(points_of(study(case, text.replace("chunk = 700", "chunk = 3000"))))
    assert np.array_equal(small, large)


def test_a_latin_hypercube_has_one_sample_in_each_layer(case):
    v = values(points_of(study(case, SAMPLES.replace("KIND", "latin_hypercube"))))
    layers = np.floor((v[:, 0] - 60) / 20 * 3000).astype(int)
    assert sorted(layers.tolist()) == list(range(3000))


def test_control_points_are_factors_on_a_column(case):
    points = points_of(
        study(
            case,
            """
            inputs = [{ key = "bending_stiffness", control_points = 3, low = 0.9, high = 1.1 }]
            design = { kind = "sobol", number = 4 }
            """,
        )
    )
    assert [v.name for v in points.variables] == [
        f"bending_stiffness at {x} m" for x in ("0", "3", "6")
    ]
    total = sum(v.weights for v in points.variables)
    assert total == pytest.approx(1)  # the same factor everywhere is that factor


HEAD = 'case = "case.toml"\n'
REFUSED = {
    "unknown input": ('[[inputs]]\nkey = "sped"\nvalues = [1]', ("sped", "speed")),
    "unknown key": ('[[inputs]]\nkey = "speed"\nvalue = [1]', ("inputs.0.value", "values")),
    "empty range": (
        '[[inputs]]\nkey = "speed"\nlow = 80\nhigh = 60\nnumber = 3',
        ("speed", "80", "60", "empty"),
    ),
    "no values": ('[[inputs]]\nkey = "speed"\nvalues = []', ("values", "empty")),
    "wrong unit": ('[[inputs]]\nkey = "speed"\nvalues = ["3 kg"]', ("speed", "3 kg")),
    "unequal zip": (
        "inputs = [{ key = 'speed', values = [60, 70] }, { key = 'thrust', values = [1] }]\n"
        "design.kind = 'zip'",
        ("speed 2", "thrust 1"),
    ),
    "a design of 1e12 cases": (
        "inputs = [{ key = 'speed', low = 60, high = 61, number = 1000000 },"
        "{ key = 'thrust', low = 60, high = 61, number = 1000000 }]",
        ("1e+12", "cases"),
    ),
    "too many samples": (
        "inputs = [{ key = 'speed', low = 60, high = 61 }]\n"
        "design = { kind = 'sobol', number = 1000000000000 }",
        ("1e+12", "cases"),
    ),
    "samples without a number": (
        "inputs = [{ key = 'speed', low = 60, high = 61 }]\ndesign.kind = 'sobol'",
        ("design.number",),
    ),
    "samples of values": (
        "inputs = [{ key = 'speed', values = [60] }]\ndesign = { kind = 'random', number = 3 }",
        ("speed", "range"),
    ),
    "no inputs": ("name = 'x'", ("inputs", "empty")),
    "twice": (
        "inputs = [{ key = 'speed', values = [60] },"
        "{ key = 'condition.speed', name = 'again', values = [60] }]",
        ("condition.speed", "twice"),
    ),
    "a choice": ("inputs = [{ key = 'model.planing', values = [1] }]", ("model.planing",)),
    "no table": ("design = { kind = 'zip', table = 'none.csv' }", ("none.csv",)),
    "a name that leads out of the store": (
        "inputs = [{ key = 'speed', name = '../x', values = [60] }]",
        ("../x", "letters"),
    ),
    "a name of an output": (
        "inputs = [{ key = 'speed', name = 'error_hz', values = [60] }]",
        ("error_hz", "taken"),
    ),
    "a family twice": (
        "inputs = [{ key = 'speed', values = [60] }]\nsolve.families = ['bending', 'bending']",
        ("solve", "families", "once"),
    ),
    "times that go back": (
        "inputs = [{ key = 'time', values = [0, 2, 1] }, { key = 'speed', values = [60, 61, 62] }]"
        "\ndesign.kind = 'zip'",
        ("time", "1 s comes after 2 s", "sort"),
    ),
    "a factor on nothing": (
        "inputs = [{ key = 'condition.body_angle', factor = true, values = [1, 2] }]",
        ("body_angle", "no factor changes"),
    ),
    "an axis that is no input": (
        "inputs = [{ key = 'speed', values = [60] }]\nfigure.x = 'sped'",
        ("figure.x", "sped", "did you mean speed"),
    ),
    "a scheduler that is not there": (
        "inputs = [{ key = 'speed', values = [60] }]",
        ("tcp://127.0.0.1:9", "scheduler"),
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_bad_study_gets_one_sentence_and_writes_nothing(tmp_path, name, monkeypatch):
    monkeypatch.setattr("antinode.study.sweep.cluster._SECONDS", 1)
    text, words = REFUSED[name]
    run("init", tmp_path)
    (tmp_path / "study.toml").write_text(HEAD + text)
    before = contents(tmp_path)
    more = ["--scheduler", "tcp://127.0.0.1:9"] if "scheduler" in name else []
    refused(run("sweep", tmp_path / "study.toml", "-o", tmp_path / "s.zarr", *more), *words)
    assert contents(tmp_path) == before


def test_a_case_file_is_no_study(tmp_path):
    run("init", tmp_path)
    refused(run("sweep", tmp_path / "case.toml"), "this is a case file")


def test_sobol_chunks_are_entered_anywhere(case):
    from scipy.stats import qmc

    samples = SobolSamples(7, 5)
    assert samples._is_known
    engine = qmc.Sobol(5, scramble=True, rng=7)
    engine.fast_forward(999_999)
    assert np.array_equal(samples.rows(999_999, 1_000_100), engine.random(101))
    assert samples.rows(10**9, 10**9 + 10).shape == (10, 5)  # drawn one by one: minutes


def test_without_the_inside_of_scipy_sobol_chunks_are_the_same():
    samples = SobolSamples(7, 5)
    found = samples.rows(1000, 1010)
    samples._is_known = False
    assert np.array_equal(samples.rows(1000, 1010), found)


@pytest.mark.parametrize("number", [1, 7, 12, 64, 96])
def test_a_latin_hypercube_is_the_first_half_of_one_twice_as_large(number):
    column, double = (latin_column(3, 1, n) for n in (number, 2 * number))
    assert np.array_equal(double[:number], column)
    for found in (column, double):
        layers = np.floor(found * len(found)).astype(int)
        assert sorted(layers.tolist()) == list(range(len(found)))
    assert not np.any(latin_column(3, 0, number) == column)


@pytest.mark.parametrize("kind", ["random", "sobol", "latin_hypercube"])
def test_a_larger_design_begins_with_the_smaller_one(case, kind):
    text = SAMPLES.replace("KIND", kind)
    small = points_of(study(case, text))
    large = points_of(study(case, text.replace("3000", "6000")))
    assert large.extends(3000)
    assert not small.extends(6000)
    assert np.array_equal(values(large)[:3000], values(small))
