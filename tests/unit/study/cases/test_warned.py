"""Warnings of many cases: as each case by itself would say, counted, in every output."""

import json

import numpy as np
import pytest

import antinode as an
from antinode.modes.warnings import (
    LOWEST_DIVERGES,
    PAST_BUCKLING,
    ROTATION_DIVERGES,
    SHEAR_LOWERS,
)
from antinode.study.cases.bending import lowest_diverges, solve_free
from antinode.study.cases.values import Cases
from antinode.study.cases.warned import counted_warnings, messages
from antinode.study.design.points import points_of
from antinode.study.sweep.sweep import sweep
from antinode.vehicle.many_beams import Chains
from cli_run import run
from study_text import study

SMALL_CAVITY = """
inputs = [{ key = "cavitation_number", low = 0.015, high = 0.06, number = 7 }]
solve.modes = 3
"""
HEAVY = """
inputs = [
  { key = "thrust", low = 1e5, high = 4.5e5 },
  { key = "speed", low = 60, high = 140 },
  { key = "vehicle.fins.0.tip_radius", low = 0.195, high = 0.35 },
  { key = "cavitator.diameter", low = 0.06, high = 0.12 },
]
design = { kind = "sobol", number = 32 }
solve.modes = 2
run.chunk = 10
"""
ONE_BY_ONE = """
inputs = [
  { key = "model.planing_drag_factor", values = [0, 1] },
  { key = "cavitation_number", values = [0.02, 0.04] },
]
solve.modes = 2
"""


ODD_BODIES = """
inputs = [
  { key = "axial_stiffness", values = [1e-9, 1e-3, 1, 1e5] },
  { key = "bending_stiffness", values = [1, 100] },
]
solve.modes = 2
"""

STRAINED = """
inputs = [
  { key = "vehicle.stations.axial_stiffness.3", values = [58e6, 0.4e6, 20e3] },
  { key = "condition.thrust", values = [50e3, 300e3] },
]
solve.modes = 2
tracking.track = false
"""
STRAINED_ONE_BY_ONE = """
inputs = [
  { key = "vehicle.stations.axial_stiffness.7", values = [150e6, 1e6, 100e3] },
  { key = "model.planing_drag_factor", values = [0, 1] },
]
solve.modes = 2
tracking.track = false
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("warned")
    run("init", folder)
    return an.load_case(
        folder / "case.toml", ["model.end_force=fixed_direction", "model.theory=euler_bernoulli"]
    )


def told(dataset, i):
    """The sentences of one case of a sweep."""
    about = dataset.warned.attrs
    pairs = zip(about["flag_masks"], about["flag_meanings"], strict=True)
    return [text for mask, text in pairs if int(dataset.warned[i]) & mask]


def alike(message, sentence):
    """Whether a message is the sentence of one case, but for the numbers in it."""
    skeleton = [w for w in message.split() if w.strip(".,:;()").isalpha()]
    words = iter(sentence.split())
    return all(any(w == other for other in words) for w in skeleton)


@pytest.mark.parametrize(
    "text",
    [SMALL_CAVITY, HEAVY, ONE_BY_ONE, ODD_BODIES, STRAINED, STRAINED_ONE_BY_ONE],
)
def test_every_case_warns_as_it_does_alone(case, text):
    made = study(case, text)
    found, points = sweep(made), points_of(made)
    start = 0
    for chunk in range(points.chunks):
        cases = Cases(made, points.variables, points.values(chunk))
        for i in range(len(cases)):
            one, own = cases.case(i), told(found, start + i)
            modes = an.solve_modes(one, made.solve.modes, families=["bending"])
            alone = [*modes.warnings, *one.loads.warnings]
            assert len(own) == len(alone)
            for sentence in alone:
                last = sentence.rpartition(": ")[2]
                assert any(alike(m, sentence) or m.endswith(last) for m in own), sentence
        start += len(cases)
    strained = [w for w in found.attrs["warnings"] if "N/EA > 10%" in w["message"]]
    assert bool(strained) == (text in (STRAINED, STRAINED_ONE_BY_ONE))
    assert found.attrs["warnings"] == counted_warnings(
        messages(made), [found.warned.values], points.cases
    )


def test_counts_shares_and_first_cases():
    bits = [np.array([0, 1, 3]), np.array([2, 0])]
    found = counted_warnings(("a", "b", "c"), bits, 5)
    assert found == [
        {"message": "a", "count": 2, "share": 0.4, "first_case": 1},
        {"message": "b", "count": 2, "share": 0.4, "first_case": 2},
    ]


def test_the_kinds_are_told(case):
    found = sweep(study(case, HEAVY))
    texts = [w["message"] for w in found.attrs["warnings"]]
    assert any(text.endswith(PAST_BUCKLING) for text in texts)
    assert ROTATION_DIVERGES in texts
    assert any(text.endswith(SHEAR_LOWERS) for text in texts)
    assert any("planing force" in text for text in texts)
    assert any("closes ahead of the tail" in text for text in texts)
    assert any("Fin set 1" in text for text in texts)
    assert any("forebody" in text for text in texts)


def test_a_compressed_part_buckles_in_net_tension():
    """The lowest eigenvalue is then counted as rigid rotation: as `solve_modes` warns."""
    EI = np.array([1e6, 1e6, 1e6, 1e6, 2e2, 2e2])
    N = np.array([[-4e3, -4e3, -4e3, -4e3, 1e3, 1e3], [-4e3] * 5 + [1e3], [4e3] * 6])
    ones = np.ones((1, 6))
    chains = Chains(np.arange(3), ones, ones, EI[None], N)
    omega2 = solve_free(chains, 3)[0]
    found = lowest_diverges(chains, omega2, N.sum(axis=1))
    closed = [np.append(row, row[-1]) for row in (EI, *N)]
    alone = [
        an.solve_modes(an.Beam.from_stations(np.arange(7.0), 1.0, closed[0], None, force), 3)
        for force in closed[1:]
    ]
    assert found.tolist() == [LOWEST_DIVERGES in result.warnings for result in alone]
    assert found.tolist()[::2] == [True, False]


def test_cases_that_failed_warn_of_nothing(case):
    text = 'inputs = [{ key = "speed", values = [-1, 80] }]\nsolve.modes = 2'
    found = sweep(study(case, text))
    assert found.reason.values.tolist() == [10, 0]
    assert int(found.warned[0]) == 0
    assert found.attrs["warnings"][0]["first_case"] == 1
    assert found.attrs["warnings"][0]["share"] == 0.5


def test_a_store_carries_them(case, tmp_path):
    made = study(case, HEAVY)
    here, there = sweep(made), sweep(made, tmp_path / "s.zarr")
    assert there.attrs["warnings"] == here.attrs["warnings"]
    assert np.array_equal(there.warned, here.warned)
    assert there.warned.attrs["flag_meanings"] == list(messages(made))


def test_json_terminal_csv_and_netcdf_say_them(tmp_path):
    import xarray

    run("init", tmp_path / "v")
    (tmp_path / "v" / "study.toml").write_text('case = "case.toml"\n' + SMALL_CAVITY)
    file = tmp_path / "v" / "study.toml"
    data = json.loads(run("sweep", file, "--json").out)
    entry = next(w for w in data["warnings"] if "alpha_p" in w["message"])
    assert set(entry) == {"message", "count", "share", "first_case"}
    assert entry["share"] == pytest.approx(entry["count"] / 7)
    ended = run("sweep", file, "-o", tmp_path / "s.nc")
    text = " ".join(ended.out.split())
    assert f"({entry['count']} of 7 cases, first case {entry['first_case']})" in text
    with xarray.open_dataset(tmp_path / "s.nc") as found:
        assert json.loads(found.attrs["warnings"]) == data["warnings"]
    run("sweep", file, "-o", tmp_path / "s.csv")
    assert "warned" in (tmp_path / "s.csv").read_text().split("\n")[0]


def test_flutter_is_not_lost_among_cases(case):
    """Thrust that follows makes bending 1 and 2 meet: their frequency alone says nothing of it."""
    follows = case.model_copy(update={"model": an.Model(end_force="follows_body")})
    text = 'inputs = [{ key = "thrust", values = [5e4, 1.1e6, 1.4e6] }]\nsolve.modes = 3'
    data = an.sweep(study(follows, text))
    (told,) = [w for w in data.attrs["warnings"] if "flutter, by end forces" in w["message"]]
    assert (told["count"], told["first_case"]) == (2, 1)
    assert np.all(np.isfinite(data.frequency_hz))


def test_a_last_row_that_one_case_alone_has_otherwise(case):
    """It closes a stepped table; the sentence that tells so is counted as one of its own."""
    text = STRAINED_ONE_BY_ONE.replace("axial_stiffness.7", "axial_stiffness.19")
    found = sweep(study(case, text))
    assert found.attrs["failed"] == 0
    own = [w for w in found.attrs["warnings"] if "of its own" in w["message"]]
    assert [w["count"] for w in own] == [6]
