"""Sweeps: results against single solves, failures, tracking, executors, figures, the command."""

import json
import subprocess
import sys
import tomllib

import numpy as np
import pytest

import antinode as an
from antinode.study.cases.values import case_of
from antinode.study.design.file import Tracking
from antinode.study.design.points import points_of
from antinode.study.sweep.contents import final_attributes
from antinode.study.sweep.figures import crossings, plot_sweep
from antinode.study.sweep.sweep import sweep
from antinode.study.sweep.tracking import neighbours, track
from cli_run import refused, run
from study_text import study


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    run("init", "--example", "sweep", folder)
    return folder


@pytest.fixture(scope="module")
def case(folder):
    return an.load_case(folder / "case.toml")


def each(case, points, names):
    """The cases of a study, one after the other."""
    for chunk in range(points.chunks):
        for values in points.values(chunk):
            keys = {v.keys: [x] for v, x in zip(points.variables, values, strict=True)}
            assert set(names) == {v.name for v in points.variables}
            yield case_of(case, keys, 0)


MIXED = """
inputs = [
  { key = "speed", low = 60, high = 120 },
  { key = "thrust", low = 0, high = 2e5 },
  { key = "fin_position", low = 4, high = 5.9 },
]
outputs = ["frequency_hz", "error_hz", "omega2", "a_X", "cavity_length"]
design = { kind = "sobol", number = 24 }
solve.modes = 4
run.chunk = 10
"""


def test_frequencies_are_those_of_single_solves_within_the_error(case):
    made = study(case, MIXED)
    result = sweep(made)
    assert result.attrs["failed"] == 0
    ones = each(case, points_of(made), ["speed", "thrust", "fin_position"])
    for i, one in enumerate(ones):
        exact = an.solve_modes(one, 4, tolerance=1e-10, families=["bending"])
        difference = np.abs(result.frequency_hz[i].values - exact.frequencies_hz())
        assert np.all(difference <= result.error_hz[i].values + 1e-9)
        assert float(result.a_X[i]) == pytest.approx(one.loads.a_X, rel=1e-12)
        assert float(result.speed[i]) == one.condition.speed


def test_the_dataset_says_what_it_is(case):
    result = sweep(study(case, MIXED))
    assert dict(result.sizes) == {"case": 24, "mode": 4}
    assert list(result.mode.values) == [f"bending {k}" for k in range(1, 5)]
    for name in (*result.data_vars, "speed", "thrust"):
        assert result[name].attrs.get("units") or name in ("reason", "warned")
    assert {"antinode_version", "case_hash", "study_hash", "seed", "tolerance"} <= set(result.attrs)
    other = sweep(study(case, MIXED + "figure.band = [1, 2]"))
    assert other.attrs["study_hash"] == result.attrs["study_hash"]
    other = sweep(study(case, MIXED.replace("120", "121")))
    assert other.attrs["study_hash"] != result.attrs["study_hash"]


SLOW = """
inputs = [
  { key = "model.planing_drag_factor", values = [0, 1, 2] },
  { key = "radius", values = [1, 1.02] },
]
solve.modes = 3
"""


def test_inputs_that_arrays_do_not_cover_are_solved_one_by_one(case):
    result = sweep(study(case, SLOW))
    assert result.attrs["failed"] == 0
    plain = an.solve_modes(case, 3, families=["bending"]).frequencies_hz()
    assert result.frequency_hz[2].values == pytest.approx(plain, rel=1e-6)
    assert len(np.unique(result.frequency_hz[:, 0])) > 4


@pytest.fixture
def fixed(folder):
    """The starter whose ends keep their direction: strong thrust buckles it."""
    return an.load_case(folder / "case.toml", ["model.end_force=fixed_direction"])


def test_what_fails_is_nan_with_a_reason_and_leaves_the_others_alone(fixed):
    text = """
    inputs = [
      { key = "fin_position", values = [5, 9, 5, 5, 5, 5] },
      { key = "speed", values = [80, 80, -1, 80, 80, 80] },
      { key = "cavitation_number", values = [0.02, 0.02, 0.02, 3, 0.02, 0.02] },
      { key = "thrust", values = [5e4, 5e4, 5e4, 5e4, 4e5, 1e12] },
    ]
    design.kind = "zip"
    outputs = ["frequency_hz", "growth_rate_per_s", "F_CX"]
    solve.modes = 3
    """
    result = sweep(study(fixed, text))
    assert result.reason.values.tolist() == [0, 12, 10, 10, 6, 15]
    assert result.attrs["failed"] == 4
    words = dict(
        zip(result.reason.attrs["flag_values"], result.reason.attrs["flag_meanings"], strict=True)
    )
    assert "fin" in words[12]
    assert np.isnan(result.frequency_hz[[1, 2, 3, 5]]).all()
    assert np.isnan(result.F_CX[[1, 2, 3, 5]]).all()
    fine = an.solve_modes(fixed, 3, families=["bending"])
    assert result.frequency_hz[0].values == pytest.approx(fine.frequencies_hz(), rel=1e-7)


def test_a_case_past_buckling_has_its_growth_rate(fixed):
    text = """
    inputs = [{ key = "thrust", values = [3e5, 4e5, 5e5] }]
    outputs = ["frequency_hz", "omega2", "growth_rate_per_s"]
    solve.modes = 3
    """
    result = sweep(study(fixed, text))
    for i, thrust in enumerate((3e5, 4e5, 5e5)):
        one = case_of(fixed, {("condition", "thrust"): [thrust]}, 0)
        modes = [m for m in an.solve_modes(one, 3, families=["bending"]).modes if m.number]
        exact = [m.omega2 for m in modes]
        assert result.omega2[i].values == pytest.approx(exact, rel=1e-5, abs=1e-4 * exact[1])
        assert int(result.reason[i]) == (6 if exact[0] < 0 else 0)


def test_chunks_change_nothing_beyond_rounding(case):
    whole = sweep(study(case, MIXED.replace("run.chunk = 10", "")))
    parts = sweep(study(case, MIXED))
    assert parts.frequency_hz.values == pytest.approx(whole.frequency_hz.values, rel=1e-7)


def test_longitudinal_modes_stand_beside_the_bending_ones(case):
    text = """
    inputs = [{ key = "axial_stiffness", values = [0.05, 1] }, { key = "speed", values = [70, 80] }]
    solve = { modes = 2, families = ["bending", "longitudinal"] }
    """
    result = sweep(study(case, text))
    plain = an.solve_modes(case, 2)
    names = ["bending 1", "bending 2", "longitudinal 1", "longitudinal 2"]
    assert list(result.mode.values) == names
    exact = [*plain.frequencies_hz("bending"), *plain.frequencies_hz("longitudinal")]
    assert result.frequency_hz[3].values == pytest.approx(exact, rel=1e-7)
    slower = result.frequency_hz[1, 2:] / result.frequency_hz[3, 2:]
    assert slower.values == pytest.approx(np.sqrt(0.05), rel=1e-9)


def test_a_family_that_fails_in_one_case_leaves_the_others_alone(case):
    text = """
    inputs = [{ key = "axial_stiffness", values = [1, 1e290, 2] }]
    solve = { modes = 2, families = ["bending", "longitudinal"] }
    """
    result = sweep(study(case, text))
    assert result.reason.values.tolist() == [0, 17, 0]
    assert np.isnan(result.frequency_hz[1]).all()
    assert np.isnan(result.effect_of_shear[1]).all()
    alone = sweep(study(case, text.replace("1e290, ", "")))
    for name in ("frequency_hz", "effect_of_shear"):
        known = result[name][[0, 2]].values
        assert known == pytest.approx(alone[name].values, rel=1e-8, nan_ok=True)


# --- tracking ---


def test_neighbours_of_a_grid_stand_one_step_back():
    assert neighbours((2, 3)).tolist() == [-1, 0, 1, 0, 3, 4]
    assert neighbours((4,)).tolist() == [-1, 0, 1, 2]


def oscillators(coupling):
    """Two oscillators that pass each other: exact crossing, or veering where they are coupled."""
    shapes, omega2 = [], []
    for t in np.linspace(-1, 1, 41):
        w, v = np.linalg.eigh([[2 + t, coupling], [coupling, 2 - t]])
        shapes.append(v.T)
        omega2.append(w)
    return np.array(shapes), np.array(omega2)


def test_modes_cross_where_they_do_not_touch():
    shapes, omega2 = oscillators(0.0)
    found = track(shapes, omega2, neighbours((41,)), np.ones(2), 2)
    own = np.take_along_axis(omega2, found.mode, axis=1)
    assert own[:, 0] == pytest.approx(np.linspace(1, 3, 41))
    assert own[:, 1] == pytest.approx(np.linspace(3, 1, 41))
    assert np.nanmin(found.mac) > 0.999


def test_modes_veer_where_they_are_coupled():
    shapes, omega2 = oscillators(0.3)
    found = track(shapes, omega2, neighbours((41,)), np.ones(2), 2)
    assert np.all(found.mode == [0, 1])
    assert np.nanmin(found.mac) > 0.9


def test_a_failed_case_does_not_break_a_track():
    shapes, omega2 = oscillators(0.0)
    shapes[20] = np.nan
    found = track(shapes, omega2, neighbours((41,)), np.ones(2), 2)
    assert found.mode[20].tolist() == [-1, -1]
    assert found.mode[40].tolist() == [1, 0]


def test_a_track_through_modes_without_frequencies_says_nothing(recwarn):
    """Past buckling all frequencies may be NaN: no warning of numpy comes through."""
    shapes = np.stack([np.eye(3)] * 3)
    hz = np.array([[1.0, 2, 3], [np.nan] * 3, [1, 2, 3]])
    found = track(shapes, hz, np.array([-1, 0, 1]), np.ones(3), 3)
    assert found.mode.tolist() == [[0, 1, 2]] * 3
    assert not [w for w in recwarn if issubclass(w.category, RuntimeWarning)]


def test_families_are_tracked_apart():
    shapes, omega2 = oscillators(0.0)
    found = track(shapes, omega2, neighbours((41,)), np.ones(2), 1)
    assert np.all(found.mode == [0, 1])


def test_a_history_is_tracked_over_time(folder):
    result = an.sweep(an.load_study(folder / "history.toml"))
    assert result.time.attrs["units"] == "s"
    assert np.all(result.tracked_mode.values == np.arange(4))
    assert float(result.tracked_mac.min()) > 0.9
    first = an.load_case(folder / "case.toml", ["condition.speed=60", "condition.thrust=90kN"])
    case = case_of(first, {("condition", "cavitation_number"): [0.03]}, 0)
    hz = an.solve_modes(case, 4, families=["bending"]).frequencies_hz()
    assert result.tracked_frequency_hz[0].values == pytest.approx(hz, rel=1e-6)


def test_modes_keep_their_numbers_up_to_flutter_and_past_it(case):
    """The end forces follow: bending 1 and 2 meet, then decay and grow as they do solved alone."""
    follows = case.model_copy(
        update={"model": case.model.model_copy(update={"end_force": "follows_body"})}
    )
    text = (
        'inputs = [{ key = "thrust", low = 1e4, high = 1.6e6, number = 6 }]\n'
        'outputs = ["frequency_hz", "growth_rate_per_s"]\nsolve.modes = 3\n'
    )
    result = sweep(study(follows, text))
    assert np.all(result.tracked_mode.values == np.arange(3))
    grow = np.asarray(result.growth_rate_per_s)
    flutters = np.flatnonzero(grow[:, 1] > 0)
    assert 0 < len(flutters) < 6
    assert np.all(grow[flutters, 0] == -grow[flutters, 1])
    assert np.all(np.isnan(np.delete(grow, flutters, axis=0)))
    assert np.all(np.isnan(grow[:, 2]))
    condition = follows.condition.model_copy(update={"thrust": 1.6e6})
    last = follows.model_copy(update={"condition": condition})
    alone = [m for m in an.solve_modes(last, 3, families=["bending"]).modes if m.number]
    hz = np.asarray(result.tracked_frequency_hz)
    assert hz[-1] == pytest.approx([m.frequency_hz for m in alone], rel=1e-6)
    assert grow[-1, :2] == pytest.approx([m.growth_rate_per_s for m in alone[:2]], rel=1e-5)


def test_doubtful_tracks_are_marked_counted_and_drawn(case):
    import matplotlib

    matplotlib.use("Agg")
    text = 'inputs = [{ key = "thrust", values = [0, 1e5, 2e5, 4e5] }]\nsolve.modes = 3\n'
    limit = 0.999
    made = study(case, text + f"tracking.doubtful = {limit}")
    result = sweep(made)
    assert np.array_equal(result.tracked_doubtful == 1, result.tracked_mac < limit)
    doubtful = np.asarray(result.tracked_doubtful)
    assert 0 < doubtful.sum() < doubtful.size
    (told,) = [w for w in result.attrs["warnings"] if "tracking.doubtful" in w["message"]]
    assert told["count"] == doubtful.any(axis=1).sum()
    assert told["first_case"] == np.flatnonzero(doubtful.any(axis=1))[0]
    assert "0.999" in told["message"]
    crosses = [line for line in plot_sweep(made, result).axes[0].lines if line.get_marker() == "x"]
    assert len(crosses[0].get_xdata()) == doubtful.sum()
    usual = sweep(study(case, text + "tracking.doubtful = 0"))
    assert int(usual.tracked_doubtful.sum()) == 0
    assert not [w for w in usual.attrs["warnings"] if "tracking" in w["message"]]


def test_a_veering_jumped_over_whole_is_marked():
    """Two beams side by side, weakly coupled: far from the veering shapes are those of either."""

    def shapes(detuning):
        _, vectors = np.linalg.eigh([[1 + detuning, 0.01], [0.01, 1 - detuning]])
        return vectors.T

    def tracked(values):
        each = np.stack([shapes(v) for v in values])
        order = np.tile([1.0, 2.0], (len(values), 1))
        return track(each, order, neighbours((len(values),)), np.ones(2), 2)

    coarse, fine = tracked([-0.5, 0.5]), tracked(np.linspace(-0.5, 0.5, 2001))
    assert coarse.mac.min() > 0.99
    assert coarse.swapped.tolist() == [[False, False], [True, True]]
    assert not fine.swapped.any()
    assert fine.mac.min() > 0.95


def test_order_that_changes_is_counted(case):
    points = points_of(study(case, "inputs = [{ key = 'speed', values = [70, 80, 90] }]"))
    doubtful = np.array([[0, 0], [2, 2], [1, 0]], dtype=np.int8)
    none = [np.zeros(3, dtype=np.int64)]
    unlike, swapped = final_attributes(points, none, none, doubtful)["warnings"]
    assert "tracking.doubtful" in unlike["message"]
    assert (unlike["count"], unlike["first_case"]) == (1, 2)
    assert "change their order" in swapped["message"]
    assert (swapped["count"], swapped["first_case"]) == (1, 1)


def test_a_veering_crossed_in_one_coarse_step_is_doubtful_by_default():
    """Two modes that turn by 0.76 in the square of the cosine between neighbours."""
    turn = np.arccos(np.sqrt(0.76))
    shapes = np.array([[[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]] for a in (0, turn)])
    omega2 = np.array([[1.0, 2.0], [1.0, 2.0]])
    found = track(shapes, omega2, neighbours((2,)), np.ones(2), 2)
    assert found.mac[1] == pytest.approx([0.76, 0.76])
    assert Tracking().doubtful > 0.76


# --- executors ---


def test_a_pool_of_processes_gives_the_same_numbers(case):
    import xarray

    here, there = (sweep(study(case, MIXED), workers=n) for n in (1, 2))
    xarray.testing.assert_identical(here.drop_attrs(deep=False), there.drop_attrs(deep=False))


def start(*arguments):
    """Start a server of Dask on loopback, which ends by itself."""
    command = ["timeout", "600", sys.executable, "-m", "dask", *arguments]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def test_dask_gives_the_same_numbers(case):
    pytest.importorskip("distributed")
    import socket

    import xarray

    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    servers = [
        start("scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"),
        start("worker", address, "--host", "127.0.0.1", "--nworkers", "1", "--nthreads", "1",
              "--no-dashboard"),
    ]  # fmt: skip
    try:
        result = sweep(study(case, MIXED), scheduler=address)
    finally:
        for server in servers:
            server.terminate()
            server.communicate(timeout=120)
    here = sweep(study(case, MIXED))
    xarray.testing.assert_identical(here.drop_attrs(deep=False), result.drop_attrs(deep=False))


# --- the command and its figure ---


def test_crossings_are_where_lines_meet():
    x, hz = np.array([0.0, 1.0, 2.0]), np.array([[1.0, 9.0], [2.0, 9.0], [np.nan, 9.0]])
    found = crossings(x, hz, 1.5, 0.0)
    assert [(c.x, c.hz, c.mode) for c in found] == [(0.5, 1.5, 0)]


def test_the_command_prints_ranges_and_draws(folder, tmp_path):
    ended = run("sweep", folder / "study.toml", "--plot", tmp_path / "s.png")
    assert ended.code == 0
    assert "142 of 142 cases solved" in ended.out
    assert (tmp_path / "s.png").stat().st_size > 20_000
    ended = run("sweep", folder / "samples.toml", "--set", "design.number=300", "--json",
                "--plot", tmp_path / "c.svg", "-o", tmp_path / "s.csv")  # fmt: skip
    data = json.loads(ended.out)
    assert (data["cases"], data["failed"], len(data["modes"])) == (300, 0, 6)
    assert len((tmp_path / "s.csv").read_text().splitlines()) == 301


def test_netcdf_holds_a_sweep(folder, tmp_path):
    import xarray

    assert run("sweep", folder / "history.toml", "-o", tmp_path / "h.nc").code == 0
    with xarray.open_dataset(tmp_path / "h.nc") as found:
        assert found.tracked_frequency_hz.shape == (41, 4)


def test_failures_are_counted_and_told(folder):
    ended = run("sweep", folder / "study.toml", "--set", "inputs.0.low=-100")
    assert ended.code == 0
    assert "of 142 cases solved" in ended.out
    assert "outside the range" in ended.out
    ended = run("sweep", folder / "study.toml", "--set", "inputs.1.values=[-1]")
    assert ended.code == 1
    assert "all 71 cases failed" in ended.err


def test_the_schema_knows_the_study_file(folder):
    import jsonschema

    schema = json.loads(run("schema", "study").out)
    for name in ("study", "history", "samples"):
        jsonschema.validate(tomllib.loads((folder / f"{name}.toml").read_text()), schema)


def test_a_missing_library_says_how_to_add_it(folder, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "zarr", None)
    refused(run("sweep", folder / "study.toml", "-o", tmp_path / "s.zarr"), "antinode[sweep]")
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "zarr")
    refused(
        run("sweep", folder / "study.toml", "--scheduler", "tcp://127.0.0.1:1"), "antinode[dask]"
    )
