"""Answers of sweeps against numpy on the whole, searches against a scan, the command."""

import json

import numpy as np
import pytest

import antinode as an
from antinode.study.answers import answers as module
from cli_run import refused, run
from study_text import study

TEXT = """
inputs = [
  { key = "speed", low = 60, high = 130 },
  { key = "thrust", low = 0, high = 4e5 },
]
design = { kind = "sobol", number = 128 }
solve.modes = 3
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    run("init", "--example", "sweep", folder)
    return folder


@pytest.fixture(scope="module")
def made(folder):
    fixed = ["model.end_force=fixed_direction"]  # with it strong thrust buckles some of them
    return study(an.load_case(folder / "case.toml", fixed), TEXT)


@pytest.fixture(scope="module")
def data(made):
    return an.sweep(made)


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch):
    monkeypatch.setattr(module, "_BLOCK", 50)


def test_shares_leave_out_what_is_not_known(data):
    f1 = data.frequency_hz.values[:, 0]
    known = np.isfinite(f1)
    found = an.Answers(data).share("f1 > 2.5")
    assert 0 < known.sum() < 128
    assert (found.holds, found.counted, found.unknown) == (
        np.sum(f1[known] > 2.5),
        known.sum(),
        (~known).sum(),
    )
    assert found.share == found.holds / found.counted
    slow = an.Answers(data, where="speed < 90").share("f1 > 2.5")
    rows = known & (data.speed.values < 90)
    assert (slow.holds, slow.counted) == (np.sum(f1[rows] > 2.5), rows.sum())
    assert np.isnan(an.Answers(data, where="speed > 1e9").share("f1 > 2.5").share)


def test_what_cannot_be_worked_out_is_not_counted(data):
    """A division by zero held in every comparison with `>`."""
    found = an.Answers(data).share("f1 / (speed - speed) > 1")
    assert (found.holds, found.counted, found.unknown) == (0, 0, 128)
    ratio = an.Answers(data).worst("1 / (f2 - f2)", largest=True)
    assert (ratio.cases, ratio.unknown) == ((), 128)


def test_worst_cases_come_with_their_inputs(data):
    f1 = data.frequency_hz.values[:, 0]
    found = an.Answers(data, define={"gap": "f2 - f1"}).worst("gap", 4, largest=True)
    gap = np.where(np.isfinite(f1), data.frequency_hz.values[:, 1] - f1, -1)
    assert list(found.cases) == np.argsort(-gap, kind="stable")[:4].tolist()
    assert found.values == pytest.approx(np.sort(gap)[::-1][:4])
    assert found.inputs[0]["speed"] == float(data.speed[found.cases[0]])
    assert (found.unit, found.units["speed"]) == ("Hz", "m/s")


def test_quantiles_are_those_of_numpy(data):
    found = an.Answers(data, where="thrust < 1e5").quantiles("f2", (0.1, 0.5))
    f2 = data.frequency_hz.values[data.thrust.values < 1e5, 1]
    assert found.values == pytest.approx(np.quantile(f2, [0.1, 0.5]))
    assert (found.counted, found.unknown) == (len(f2), 0)


def test_a_search_finds_what_a_fine_scan_finds(folder):
    """A smallest frequency inside the range of the speed, not at its ends."""
    text = """
    inputs = [{ key = "speed", low = 60, high = 130 }, { key = "thrust", low = 0, high = 1e5 }]
    design = { kind = "sobol", number = 16 }
    solve.modes = 2
    """
    case = an.load_case(folder / "case.toml", ["model.end_force=fixed_direction"])
    made = study(case, text)
    aim = "(f1 - 2.9) ** 2 + ((speed - 90) / 100) ** 2"
    found = an.search(made, an.sweep(made), aim)
    grid = study(
        case,
        """
        inputs = [
          { key = "speed", low = 60, high = 130, number = 71 },
          { key = "thrust", low = 0, high = 1e5, number = 201 },
        ]
        solve.modes = 2
        tracking.track = false
        """,
    )
    scan = an.Answers(an.sweep(grid)).worst(aim, 1)
    assert found.value <= scan.values[0]
    assert found.value <= found.design
    assert found.inputs["speed"] == pytest.approx(90, abs=0.1)
    assert found.at_bounds == ()
    top = an.search(made, an.sweep(made), "f1", largest=True)
    assert "thrust" in top.at_bounds
    assert top.value >= top.design


def test_a_table_has_a_row_for_each_case(data):
    table = an.case_table(data)
    assert list(table)[:3] == ["case", "speed", "thrust"]
    assert {len(column) for column in table.values()} == {128}
    column = table["frequency_hz: bending 2"]
    assert np.array_equal(column, data.frequency_hz.values[:, 1], equal_nan=True)


def test_the_command_answers_of_a_store_and_of_a_study(folder, tmp_path):
    store = tmp_path / "s.zarr"
    number = ("--set", "design.number=256")
    assert run("sweep", folder / "samples.toml", "-o", store, *number).code == 0
    asked = ("--share", "f1 > 2.5", "--smallest", "f1", "--quantiles", "f2 - f1", "--json")
    one = json.loads(run("ask", store, *asked, "-o", tmp_path / "s.csv").out)
    two = json.loads(run("ask", folder / "samples.toml", *number, *asked).out)
    assert one == two
    assert len(one["worst"][0]["cases"]) == 5
    assert len((tmp_path / "s.csv").read_text().splitlines()) == 257
    ended = run("ask", store, "--map", "speed, thrust, f1", "--plot", tmp_path / "m.png")
    assert ended.code == 0
    assert (tmp_path / "m.png").stat().st_size > 20_000
    shown = run("ask", store, *asked[:-1]).out
    assert "f1 > 2.5: " in shown
    assert "smallest f1" in shown


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--share", "f1"), "it is no condition"),
        (("--smallest", "f1 > 1"), "a condition, and no number"),
        (("--where", "f1"), "it is no condition"),
        (("--define", "speed = f1"), "there already"),
        (("--define", "gap"), "--define 'gap = f2 - f1'"),
        (("--map", "speed, f1", "--plot", "m.png"), "two axes"),
        (("--plot", "m.png"), "--map"),
        (("--number", "0"), "--number"),
    ],
)
def test_wrong_questions_get_a_sentence(folder, tmp_path, arguments, words, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sets = ("--set", "design.number=8", "--set", "solve.modes=2")
    refused(run("ask", folder / "samples.toml", *sets, *arguments), words)
    assert not (tmp_path / "m.png").exists()
