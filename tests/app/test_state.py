"""A state is a value: changes, undo, links and files, without a browser."""

import json
import tomllib
import zlib
from base64 import urlsafe_b64encode
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from antinode import load_case, solve_modes
from antinode.app.compute import full_answer, quick_answer
from antinode.app.controls.equipment import equipment
from antinode.app.controls.fields import swapped_cavitation
from antinode.app.curve import curve_key, grow_curve
from antinode.app.display import SYSTEMS, number_text, shown_unit
from antinode.app.inputs import find_input, numbers, sliders
from antinode.app.panels.frequencies import baseline_of, frequencies_data
from antinode.app.panels.numbers import short_list
from antinode.app.quick import quick_cases, quick_modes, quick_omega2
from antinode.app.save import case_toml, report_file, result_file
from antinode.app.source import read_dropped, read_example, read_file
from antinode.app.state import File, History, State, fields_of, packed, unpacked
from antinode.app.station_table import CellError, StationTable, block_of, columns_of
from antinode.errors import InputError
from antinode.examples import EXAMPLES, write_example
from antinode.inputs.toml_writing import plain
from cli_run import run


def starter(**changes):
    """The starter vehicle with changes by path, dots written as __."""
    state = State(File(read_example("starter").tables, "starter.toml"))
    return state.changed({path.replace("__", "."): value for path, value in changes.items()})


@pytest.mark.parametrize("example", EXAMPLES)
def test_every_example_can_be_shown_saved_and_linked(example, tmp_path):
    state = State(read_example(example))
    saved = tmp_path / "saved.toml"
    saved.write_text(case_toml(state), encoding="utf-8")
    again = State(read_file(saved))
    linked = starter().from_query(state.query())
    for other in (again, linked):
        assert other.problem.model_dump_json() == state.problem.model_dump_json()


def test_changes_are_those_of_the_command_line(tmp_path):
    write_example("starter", tmp_path)
    path = tmp_path / "case.toml"
    by_hand = load_case(path, ["condition.speed=100 m/s", "vehicle.fins.0.thickness=20mm"])
    changes = {"condition.speed": "100 m/s", "vehicle.fins.0.thickness": "20mm"}
    assert State(read_file(path)).changed(changes).problem == by_hand
    with pytest.raises(InputError) as wrong:
        load_case(path, ["condition.speed=100 kg"])
    with pytest.raises(InputError) as shown:
        _ = State(read_file(path)).changed({"condition.speed": "100 kg"}).problem
    assert str(shown.value) == str(wrong.value).replace(f"{tmp_path}/", "")


def test_undo_takes_gestures_as_one_step_and_leaves_the_view():
    history = History(starter())
    for speed in (81.0, 82.0, 83.0):
        history.put(history.state.changed({"condition.speed": speed}), gesture="condition.speed")
    history.end_gesture()
    history.put(history.state.changed({"condition.speed": 90.0}), gesture="condition.speed")
    history.put(history.state)  # nothing new is no step
    history.look(history.state.viewed(units="US"))
    assert history.undo().problem.condition.speed == 83.0
    assert history.undo().problem.condition.speed == 80.0
    assert history.state.view.units == "US"
    assert not history.can_undo
    assert history.undo() is history.state


def test_a_link_brings_view_and_values_back():
    state = starter(condition__speed="95 m/s", condition__depth=None).viewed(
        units="mm-t-s", modes=(1, 4), band=(10.0, 20.0), lines=(25.0,), curve="condition.speed"
    )
    query = state.query()
    assert json.loads(query["set"])["condition.speed"] == "95 m/s"
    back = starter().from_query(query)
    assert back.view == state.view
    assert back.problem == state.problem


BOMB = urlsafe_b64encode(zlib.compress(b" " * 50_000_000, 9)).decode()


@pytest.mark.parametrize(
    "query",
    [
        {"set": "{"},
        {"set": "[1]"},
        {"set": "abc"},
        {"units": '"furlong"'},
        {"modes": "1"},
        {"band": "[" * 100_000},
        {"case": "abc"},
        {"case": packed({"tables": 3})},
        {"case": packed([1])},
        {"case": BOMB},
    ],
)
def test_a_damaged_link_is_refused_with_a_sentence(query):
    with pytest.raises(InputError, match="link is damaged"):
        starter().from_query(query)


def test_what_is_packed_comes_back():
    data = {"a": [1.5, "b"], "c": {"d": None}}
    assert unpacked(packed(data)) == data


def test_a_case_too_large_for_a_link_says_so():
    table = {"x": np.linspace(0, 6, 3000).tolist()}
    rng = np.random.default_rng(1)
    table |= {name: rng.random(3000).tolist() for name in ("mass_per_length", "radius")}
    with pytest.raises(InputError, match="too large for a link"):
        starter().changed({"vehicle.stations": table}).query()


def test_a_link_cannot_name_a_file_of_the_server(tmp_path):
    secret = tmp_path / "secret.csv"
    secret.write_text("x [m]\n1\n", encoding="utf-8")
    state = starter().from_query({"set": json.dumps({"vehicle.stations": str(secret)})})
    with pytest.raises(InputError, match=r"vehicle\.stations"):
        _ = state.problem


# --- dropped files ------------------------------------------------------------------------------


def dropped_starter(tmp_path):
    write_example("starter", tmp_path)
    return {name: (tmp_path / name).read_bytes() for name in ("case.toml", "stations.csv")}


def test_a_dropped_case_with_its_table(tmp_path):
    files = dropped_starter(tmp_path)
    assert State(read_dropped(files)).problem == load_case(tmp_path / "case.toml")


@pytest.mark.parametrize("name", ["../../stations.csv", "/etc/passwd", "other.csv"])
def test_a_dropped_case_reads_no_file_that_was_not_dropped(tmp_path, name):
    text = dropped_starter(tmp_path)["case.toml"].replace(b"stations.csv", name.encode())
    with pytest.raises(InputError, match="was not dropped"):
        read_dropped({"case.toml": text})


@pytest.mark.parametrize(
    ("files", "say"),
    [
        ({}, "drop one TOML file"),
        ({"a.csv": b"x"}, "drop one TOML file"),
        ({"a.toml": b"", "b.toml": b""}, "drop one TOML file"),
        ({"a.toml": b"\xe9\xff"}, "UTF-8"),
        ({"a.toml": b"x = ["}, "not valid TOML"),
        ({"a.toml": b"x = 1"}, "unknown key"),
        ({"a.toml": b"[beam]\nstations = 3"}, "stations"),
        ({"../../a.toml": b"[[["}, r"^a\.toml"),
        ({"a.toml": b"#" * 3_000_000}, "more than"),
    ],
)
def test_a_wrong_file_ends_in_a_sentence_without_paths(files, say):
    with pytest.raises(InputError, match=say) as error:
        read_dropped(files)
    assert "/tmp" not in str(error.value)


# --- numbers ------------------------------------------------------------------------------------


@pytest.mark.parametrize("example", EXAMPLES)
def test_quick_modes_are_within_a_ten_thousandth(example):
    state = State(read_example(example))
    quick = quick_answer(state).quick
    result = solve_modes(state.problem, len(quick.omega2), families=["bending"])
    exact = np.array([m.omega2 for m in result.modes if m.number][: len(quick.omega2)])
    assert np.abs(np.sqrt(quick.omega2 / exact) - 1).max() < 1e-4
    for k, mode in enumerate([m for m in result.modes if m.number][:3]):
        shape = np.interp(result.x, quick.x, quick.states[:, k, 0])
        assert np.abs(shape - mode.shape).max() < 5e-3


def test_quick_modes_past_buckling():
    state = State(read_example("beam"))
    force = 3 * 9.87 * 7e4
    columns = columns_of(state.problem)
    table = {name: column.tolist() for name, column in columns.items()}
    EI, L = min(table["bending_stiffness"]), table["x"][-1] - table["x"][0]
    force = 30 * EI / L**2
    table["axial_force"] = [force] * len(table["x"])
    beam = state.changed({"beam.stations": table}).problem.beam()
    quick = quick_modes(beam, 3)
    exact = [m.omega2 for m in solve_modes(beam, 3, families=["bending"]).modes if m.number]
    assert quick.omega2 == pytest.approx(exact[:3], rel=1e-4)


def test_the_full_answer_is_what_the_command_line_computes():
    state = starter()
    answer = full_answer(state)
    result = solve_modes(state.problem, 6, unloaded=True)
    omega2 = [m.omega2 for m in result.modes]
    assert [m.omega2 for m in answer.full.modes] == pytest.approx(omega2, rel=1e-9)
    assert answer.full.modes[2].shift == pytest.approx(result.modes[2].shift, rel=1e-9)
    assert full_answer(starter()) is answer  # kept


def test_the_curve_grows_and_knows_what_it_depends_on():
    state = starter(condition__thrust=60e3)
    item = find_input(state.problem, state.original, "condition.thrust")
    curves = list(grow_curve(state, item))
    assert [len(c.values) for c in curves] == [5, 33]
    assert np.all(np.diff(curves[-1].values) > 0)
    at = starter(condition__thrust=float(curves[0].values[2])).problem
    exact = solve_modes(at, 6, families=["bending"])
    first = [m.omega2 for m in exact.modes if m.number]
    assert curves[0].omega2[2] == pytest.approx(first, rel=1e-4)
    assert curve_key(state.changed({"condition.thrust": 1.0}), item) == curves[0].key
    assert curve_key(state.changed({"condition.speed": 81.0}), item) != curves[0].key


@pytest.mark.parametrize(
    ("path", "most", "alone", "changes"),
    [
        ("condition.speed", 1, [], {"model__fin_added_mass": "plate"}),
        ("condition.burn_fraction", 1, [], {"model__axial_force": "element_midpoint"}),
        ("condition.thrust", 20, [2, 3, 4], {}),  # flutters
        ("condition.thrust", 20, [], {"model__end_force": "fixed_direction"}),  # past buckling
        ("vehicle.fins.0.tip_radius", 1, [], {"model__theory": "euler_bernoulli"}),  # one refused
    ],
)
def test_cases_side_by_side_are_those_solved_one_by_one(path, most, alone, changes):
    state = starter(**changes)
    item = find_input(state.problem, state.original, path)
    values = np.linspace(item.low, most * item.high, 5)
    keys = tuple(int(key) if key.isdigit() else key for key in path.split("."))
    omega2, by_themselves = quick_cases(state.problem, keys, values, 6)
    assert by_themselves.tolist() == alone
    for row in set(range(5)) - set(alone):
        one = state.changed({path: float(values[row])})
        if np.isnan(omega2[row, 0]):
            with pytest.raises(InputError, match="tip_radius"):
                _ = one.beam
        else:
            assert omega2[row] == pytest.approx(quick_omega2(one.beam, 6), rel=1e-5)


def test_a_curve_leaves_gaps_where_the_input_is_refused():
    state = starter()
    item = find_input(state.problem, state.original, "vehicle.fins.0.tip_radius")
    coarse = next(grow_curve(state, item._replace(low=0.05, high=0.4)))
    assert np.isnan(coarse.omega2[0]).all()
    assert np.isfinite(coarse.omega2[-1]).all()


def test_cavitation_number_and_depth_say_the_same():
    case = starter().problem
    by_depth = starter().changed(swapped_cavitation(case, "condition.depth"))
    assert by_depth.problem.loads.sigma == pytest.approx(0.02, rel=1e-6)
    back = by_depth.changed(swapped_cavitation(by_depth.problem, "condition.cavitation_number"))
    assert back.problem.condition.depth is None
    assert back.problem.loads.sigma == pytest.approx(0.02, rel=1e-6)
    fast = starter(condition__speed=30.0).problem
    deep = starter(condition__speed=30.0).changed(swapped_cavitation(fast, "condition.depth"))
    assert deep.problem.loads.sigma == pytest.approx(0.02, rel=1e-5)


def test_inputs_have_units_ranges_and_labels():
    state = starter()
    items = {item.path: item for item in sliders(state.problem, state.original)}
    assert list(items) == [
        "condition.speed",
        "condition.cavitation_number",
        "condition.cavitator_angle",
        "condition.thrust",
        "condition.fin_position",
        "condition.burn_fraction",
    ]
    assert items["condition.thrust"].unit == "N"
    assert items["condition.fin_position"].high == 6.0
    for item in numbers(state.problem):
        assert item.low <= item.value <= item.high, item
        assert item.label
    units = {item.path: item.unit for item in numbers(State(read_example("tower")).problem)}
    assert units["beam.point_masses.0.rotary_inertia"] == "kg m^2"
    assert units["beam.loads.gravity"] == "m/s^2"


def test_a_value_outside_widens_its_slider():
    state = starter(condition__speed=200.0)
    speed = sliders(state.problem, state.original)[0]
    assert (speed.low, speed.high) == (40.0, 200.0)


# --- equipment, units, files --------------------------------------------------------------------


def test_modes_near_band_and_lines_are_flagged():
    view = {"band": (18.0, 25.0), "lines": (60.0,), "margin": 0.05}
    state = starter().viewed(**view)
    rows = frequencies_data(full_answer(state), state.view)["rows"]
    assert [row["flag"] for row in rows] == [
        "",
        "",
        "in the equipment band",
        "",
        "",
        "within 5% of 60 Hz",
    ]


def test_a_baseline_shows_the_change():
    fixed = starter().changed({"model.end_force": "fixed_direction"})
    pinned = fixed.viewed(baseline=baseline_of(full_answer(fixed)))
    rows = frequencies_data(full_answer(pinned), pinned.view)["rows"]
    assert {row["change"] for row in rows} == {"0.00%"}
    faster = pinned.changed({"condition.speed": 120.0})
    rows = frequencies_data(full_answer(faster), faster.view)["rows"]
    assert rows[0]["change"] == "-3.70%"


@pytest.mark.parametrize(
    ("typed", "read"),
    [
        (("", "", "", "5"), {"band": None, "lines": (), "margin": 0.05}),
        (("10", "20", "25; 50", "10 %"), {"band": (10, 20), "lines": (25, 50), "margin": 0.1}),
    ],
)
def test_equipment_as_typed(typed, read):
    assert equipment(*typed) == read


@pytest.mark.parametrize(
    "typed",
    [
        ("10", "", "", "5"),
        ("20", "10", "", "5"),
        ("a", "b", "", ""),
        ("", "", "-3", ""),
        ("", "", "", "80"),
    ],
)
def test_wrong_equipment_is_a_sentence(typed):
    with pytest.raises(InputError, match=r"equipment|excitation|margin"):
        equipment(*typed)


@pytest.mark.parametrize("system", SYSTEMS)
def test_stations_survive_their_units(system):
    columns = columns_of(starter().problem)
    table = StationTable.of(columns, system).columns()
    for name, column in columns.items():
        assert table[name] == pytest.approx(column.tolist(), rel=1e-8)


def small_table(system="SI"):
    columns = {"x": [0.0, 1.0, 3.0], "axial_stiffness": [1e6, 2e6, 3e6]}
    return StationTable.of(columns, system)


@pytest.mark.parametrize(
    ("text", "metres"),
    [("90 mm", 0.09), ("1,5", 1.5), ("0.25", 0.25), ("2 ft", 0.6096), ("150cm", 1.5)],
)
def test_a_cell_takes_a_number_with_or_without_a_unit(text, metres):
    assert small_table().typed(1, "x", text).columns()["x"] == [0.0, pytest.approx(metres), 3.0]


@pytest.mark.parametrize(
    ("text", "why"), [("90 kg", "no unit of m"), ("", "number"), ("1,500", "1500 or 1.500")]
)
def test_a_cell_says_what_it_refuses(text, why):
    with pytest.raises(CellError, match=f"row 2, x: received '{text}'.*{why}") as caught:
        small_table().typed(1, "x", text).columns()
    assert small_table().shown(caught.value)[1]["wrong"] == "x"


def test_a_plain_number_in_a_cell_is_in_the_unit_of_its_heading():
    assert small_table().typed(0, "axial_stiffness", "5").columns()["axial_stiffness"][0] == 5e3
    metric = small_table("mm-t-s").typed(2, "x", "2500")
    assert metric.columns()["x"] == [0.0, 1.0, 2.5]


def test_a_block_from_a_spreadsheet_fills_cells_and_adds_rows():
    block = block_of("2\t4,5\r\n4\t5 MN\r\n")
    columns = small_table().pasted(2, "x", block).columns()
    assert columns["x"] == [0.0, 1.0, 2.0, 4.0]
    assert columns["axial_stiffness"] == [1e6, 2e6, 4500.0, 5e6]
    assert len(small_table().pasted(0, "axial_stiffness", [["1", "2", "3"]]).rows) == 3


def test_rows_are_added_and_removed_where_they_were_clicked():
    table = small_table()
    assert table.added(0).columns()["x"] == [0.0, 0.5, 1.0, 3.0]
    assert table.added(2).columns()["x"] == [0.0, 1.0, 3.0, 5.0]
    assert table.removed(1).columns()["x"] == [0.0, 3.0]
    assert table.removed(1).removed(0).rows == table.removed(1).rows


def test_shown_units():
    assert shown_unit("m/s", "US").of(30.48) == pytest.approx(100.0)
    assert shown_unit("N", "US").of(4.4482216152605) == pytest.approx(1.0)
    assert shown_unit("kg/m", "mm-t-s").of(1e6) == pytest.approx(1.0)
    assert shown_unit("Hz", "US").of(3.0) == 3.0
    assert number_text(23000000.0) == "23000000"
    assert number_text(0.02) == "0.02"
    assert short_list([0.0, 1 / 3, -123456.0, np.nan]) == [0.0, 0.3333, -123500.0, None]


def test_results_as_files(tmp_path):
    answer = full_answer(starter())
    assert result_file(answer, ".csv").startswith(b"family,number,name,kind,frequency_hz [Hz]")
    assert json.loads(result_file(answer, ".json"))["condition"]["speed_m_per_s"] == 80.0
    pytest.importorskip("h5netcdf", reason="h5netcdf is not installed (extra dataset)")
    assert result_file(answer, ".nc")[1:4] == b"HDF"


def test_the_report_of_a_state():
    pytest.importorskip("jinja2", reason="jinja2 is not installed (extra report)")
    page = report_file(starter(condition__speed=90.0), ".html").decode()
    assert "<html" in page
    assert "starter" in page


def test_awkward_names_are_saved():
    state = starter(vehicle__name='a "b"\\c\n☃')
    assert tomllib.loads(case_toml(state))["vehicle"]["name"] == 'a "b"\\c\n☃'
    assert "mass_per_length:burnt" in tomllib.loads(case_toml(state))["vehicle"]["stations"]


def test_an_error_finds_its_field():
    paths = ("condition.speed", "condition.thrust")
    assert fields_of("case.toml: condition.thrust is 'x'; no", paths) == "condition.thrust"
    assert fields_of("something else", paths) == ""


def test_a_saved_case_keeps_the_comments_of_its_file(tmp_path):
    assert run("init", "--beam", tmp_path).code == 0
    text = (tmp_path / "beam.toml").read_text(encoding="utf-8")
    state = State(read_file(tmp_path / "beam.toml"))
    assert case_toml(state) == text
    saved = case_toml(state.changed({"beam.ends.left": "pinned"}))
    pairs = zip(text.splitlines(), saved.splitlines(), strict=True)
    assert [new.partition(" ")[0] for old, new in pairs if old != new] == ["left"]
    again = state.from_query(replace(state, file=replace(state.file, own=False)).query())
    assert case_toml(again) == text


def test_a_link_with_a_text_that_is_no_toml_saves_the_tables(tmp_path):
    state = starter()
    for text in ("a = ", "a." * 5000 + "a = 1", 7):
        data = {"origin": "x", "tables": plain(state.file.tables), "text": text}
        opened = state.from_query({"case": packed(data)})
        assert opened.file.text == ""
        assert tomllib.loads(case_toml(opened)) == data["tables"]


def test_the_larger_error_stands_beside_the_smaller_one():
    """The sixth frequency is known to 1e-6 Hz; what shear takes of it is a ninth."""
    plain = starter().changed({"model.theory": "euler_bernoulli"})
    rows = frequencies_data(full_answer(plain), plain.view)["rows"]
    modes = [m for m in full_answer(plain).full.family("bending") if m.number]
    assert [row["shear"] for row in rows] == [f"{m.model_error:+.1%}" for m in modes]
    assert rows[5]["shear"] == "-11.5%"
    assert float(rows[5]["error"]) < 1e-5
    assert {r["shear"] for r in frequencies_data(quick_answer(plain), plain.view)["rows"]} == {""}
