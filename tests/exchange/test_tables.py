"""Beams as beam files, CSV and workbooks, there and back; independent readers open them."""

import json
import tomllib
from dataclasses import replace

import numpy as np
import openpyxl
import pytest

from antinode import InputError, load_beam, solve_modes
from antinode.beam.attachments import PointMass, Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.file import BeamFile
from antinode.exchange.beam_toml import beam_file_text
from antinode.exchange.convert import Request, convert
from antinode.exchange.inputs import Choices, read_beam
from antinode.exchange.outputs import write_beam
from antinode.exchange.tabulated import Stations, tabulate
from antinode.inputs.explain import validate
from antinode.inputs.reading import read_csv
from antinode.modes.buckling import buckling
from cli_run import refused, run
from exchange.conversions import EXAMPLES, difference, everything, example, solved

NAMES = (*EXAMPLES, "everything")


def beam_of(name):
    return solved(name).beam


@pytest.mark.parametrize("name", NAMES)
def test_a_beam_file_gives_the_beam_back(name, tmp_path):
    path = tmp_path / "beam.toml"
    write_beam(path, beam_of(name), "toml")
    assert tomllib.loads(path.read_text())["beam"]["name"] == beam_of(name).name
    assert difference(load_beam(path).beam(), name) < 3e-9


@pytest.mark.parametrize("name", NAMES)
def test_a_workbook_gives_the_beam_back(name, tmp_path):
    path = tmp_path / "beam.xlsx"
    write_beam(path, beam_of(name), "xlsx")
    assert difference(read_beam(path, "xlsx", Choices()).beam, name) < 3e-9
    sheet = openpyxl.load_workbook(path)["stations"]
    assert sheet["A1"].value == "x [m]"
    assert sheet["A2"].value == beam_of(name).x[0]


@pytest.mark.parametrize("name", ["starter", "beam", "rocket"])
def test_csv_gives_the_stations_back(name, tmp_path):
    path = tmp_path / "stations.csv"
    notes = write_beam(path, beam_of(name), "csv")
    ends = beam_of(name).ends
    turning = f"left_follower = {ends.left_follower:g}, right_follower = {ends.right_follower:g}"
    assert any(turning in note for note in notes) == (name == "starter")
    keys = ("left", "right", "left_follower", "right_follower")
    sets = tuple(f"beam.ends.{key}={getattr(ends, key)}" for key in keys)
    beam = read_beam(path, "csv", Choices(sets)).beam
    again = replace(beam, attachments=())
    if not beam_of(name).attachments:
        assert difference(again, name) < 1e-7
    else:
        assert again.length == pytest.approx(beam_of(name).length, rel=1e-12)


def test_a_stepped_table_is_kept_as_it_is():
    beam = Beam.from_stations([0, 1, 3], [2, 1, 1], [5, 4, 4], axial_force=[7, 8, 0])
    stations = tabulate(beam)
    assert stations.interpolation == "step"
    assert stations.columns["axial_force"].tolist() == [7, 8, 8]
    assert stations.columns["x"].tolist() == [0, 1, 3]


def test_a_jump_among_straight_columns_is_two_rows():
    beam = Beam(
        np.array([0.0, 1, 2]),
        np.array([[1.0, 2], [2, 3]]),
        np.array([[4.0, 4], [5, 5]]),
        interpolation="linear",
    )
    stations = tabulate(beam)
    assert stations.columns["x"].tolist() == [0, 1, 1, 2]
    assert stations.columns["bending_stiffness"].tolist() == [4, 4, 5, 5]
    assert stations.notes == ()


def shared_weight(how, ends=("clamped", "clamped"), offset_weight=True):
    """A force of its own, weight, an offset mass, and several supports that share the load."""
    beam = Beam.from_stations(
        [0, 1, 2, 3], [9.0, 7, 8, 8], [4e3, 5e3, 4e3, 4e3], [9e6, 7e6, 8e6, 8e6],
        [900.0, 300, 500, 500], interpolation=how, ends=Ends(*ends),
    )  # fmt: skip
    beam = beam.with_attachments(PointMass(1.4, 30.0, 0.2, 0.3), Spring(2.2, axial=4e5))
    return apply_loads(beam, AxialLoads(9.81, 0.0, (PointForce(0.5, 700.0),), offset_weight))


@pytest.mark.parametrize("ending", ["toml", "xlsx"])
@pytest.mark.parametrize("offset_weight", [True, False])
@pytest.mark.parametrize(
    ("how", "ends"),
    [("step", ("clamped", "clamped")), ("linear", ("pinned", "free")), ("log", ("free", "pinned"))],
)
def test_a_force_beside_weight_that_supports_share(how, ends, offset_weight, ending, tmp_path):
    beam = shared_weight(how, ends, offset_weight)
    path = tmp_path / f"b.{ending}"
    write_beam(path, beam, ending)
    again = read_beam(path, ending, Choices()).beam
    wanted, got = (buckling(one, backend="numpy") for one in (beam, again))
    assert got.load_factor == pytest.approx(wanted.load_factor, rel=1e-9)
    assert (again.axial_acceleration, again.offset_weight) == (9.81, offset_weight)
    if offset_weight:
        light = buckling(replace(beam, offset_weight=False), backend="numpy")
        assert abs(light.load_factor / wanted.load_factor - 1) > 1e-4


def test_what_acts_on_no_support_is_a_column():
    beam = Beam.from_stations(
        [0, 1, 2], [1, 1, 1], [4, 4, 4], [9, 9, 9], ends=Ends("clamped", "clamped")
    )
    beam = replace(beam, interpolation="linear", axial_acceleration=3.0)
    text, _ = beam_file_text(beam)
    again = validate(BeamFile, tomllib.loads(text), "it").beam()
    np.testing.assert_allclose(again.axial_force, beam.axial_force, atol=1e-12)
    assert again.axial_acceleration == 3.0


def test_without_axial_stiffness_shared_weight_is_refused():
    beam = Beam.from_stations([0, 1, 2], [1, 1, 1], [4, 4, 4], ends=Ends("clamped", "clamped"))
    with pytest.raises(InputError, match="axial_stiffness is missing"):
        beam_file_text(replace(beam, axial_acceleration=3.0))


@pytest.mark.parametrize(
    ("sheet", "words"),
    [
        ("Beam", "did you mean beam?"),  # which openpyxl calls Beam1 beside beam
        ("Masses", "did you mean point_masses?"),
        ("stations (2)", "did you mean stations?"),
        ("Spring", "did you mean springs?"),
        ("notes of mine", "# before the name of a sheet"),
    ],
)
def test_a_sheet_that_nobody_would_read_is_refused(sheet, words, tmp_path):
    write_beam(tmp_path / "b.xlsx", everything(), "xlsx")
    book = openpyxl.load_workbook(tmp_path / "b.xlsx")
    added = book.create_sheet(sheet)
    added.append(["x [m]", "mass [kg]"])
    book.save(tmp_path / "b.xlsx")
    refused(run("beam", tmp_path / "b.xlsx"), "unknown sheet", words)
    added.title = "# left out"
    book.create_sheet("Sheet2")
    book.save(tmp_path / "b.xlsx")
    assert run("beam", tmp_path / "b.xlsx", "--modes", "1").code == 0


def test_capitals_and_spaces_in_the_names_of_sheets_do_not_count(tmp_path):
    write_beam(tmp_path / "b.xlsx", everything(), "xlsx")
    book = openpyxl.load_workbook(tmp_path / "b.xlsx")
    for name, other in (("beam", "#"), ("point_masses", "Point Masses"), ("#", "Beam")):
        book[name].title = other
    book.save(tmp_path / "b.xlsx")
    again = read_beam(tmp_path / "b.xlsx", "xlsx", Choices()).beam
    assert (again.mass, again.ends) == (everything().mass, everything().ends)
    book.create_sheet("point_masses").append(["x [m]", "mass [kg]"])
    book.save(tmp_path / "b.xlsx")
    refused(run("beam", tmp_path / "b.xlsx"), "'point_masses'", "'Point Masses' already")


def test_results_in_a_workbook_are_not_read_again(tmp_path):
    run("init", "--beam", tmp_path)
    assert run("beam", tmp_path / "beam.toml", "-o", tmp_path / "b.xlsx").code == 0
    assert run("beam", tmp_path / "b.xlsx", "--modes", "1").code == 0


def test_the_sheet_of_keys_needs_its_heading(tmp_path):
    path = flange_file(tmp_path, ".xlsx")
    book = openpyxl.load_workbook(path)
    book["beam"].delete_rows(1)
    book.save(path)
    refused(run("beam", path), "sheet beam", "'interpolation'", "key, value")


FLANGE = {
    "x": [0, 40, 40, 80],
    "mass_per_length": [3300, 2750, 2000, 1800],
    "bending_stiffness": [2.4e11, 1.5e11, 1.1e11, 0.6e11],
}
CLAMPED = ("beam.ends.left=clamped",)


def flange_file(folder, ending):
    """The same tower with a jump in a format."""
    path = folder / f"flange{ending}"
    if ending == ".dat":
        rows = np.column_stack([np.divide(FLANGE["x"], 80), *list(FLANGE.values())[1:]])
        rows = np.column_stack([rows, rows[:, -1]])
        path.write_text(
            "4 NTwInpSt\nHtFract TMassDen TwFAStif TwSSStif\n(-) (kg/m) (Nm^2) (Nm^2)\n"
            + "\n".join(" ".join(f"{value:.6e}" for value in row) for row in rows)
        )
    elif ending == ".toml":
        columns = "\n".join(f"{name} = {column}" for name, column in FLANGE.items())
        path.write_text(f'[beam]\ninterpolation = "linear"\n[beam.stations]\n{columns}\n')
    elif ending == ".csv":
        rows = "\n".join(",".join(map(str, row)) for row in zip(*FLANGE.values(), strict=True))
        path.write_text('# interpolation = "linear"\n' + ",".join(FLANGE) + f"\n{rows}\n")
    else:
        book = openpyxl.Workbook()
        sheet, settings = book.active, book.create_sheet("beam")
        for row in (list(FLANGE), *zip(*FLANGE.values(), strict=True)):
            sheet.append(row)
        for row in (("key", "value"), ("interpolation", "linear")):
            settings.append(row)
        book.save(path)
    return path


@pytest.mark.parametrize("ending", [".toml", ".csv", ".xlsx", ".dat"])
def test_two_rows_at_one_x_are_a_jump_in_every_format(ending, tmp_path):
    path = flange_file(tmp_path, ending)
    how = {".dat": "sections"}.get(ending, ending[1:])
    beam = read_beam(path, how, Choices(CLAMPED, length=80.0)).beam
    assert beam.x.tolist() == [0, 40, 80]
    found = solve_modes(beam, 2).frequencies_hz()[:2]
    # Hermite elements, 40 and 80, extrapolated: 4.29546441, 4.29546391 -> 4.29546388
    assert found == pytest.approx([0.88541444, 4.29546388], abs=2e-8)


def test_exponential_columns_jump_too():
    x, m, EI = [0, 1, 1, 3], [1, 2, 8, 4], [4, 2, 3, 9]
    beam = Beam.from_stations(x, m, EI, axial_force=[1, 2, 7, 5], interpolation="log")
    assert beam.x.tolist() == [0, 1, 3]
    assert beam.mass_per_length.tolist() == [[1, 2], [8, 4]]
    assert beam.axial_force.tolist() == [[1, 2], [7, 5]]
    assert tabulate(beam).columns["axial_force"].tolist() == [1, 2, 7, 5]


@pytest.mark.parametrize(
    ("x", "how", "words"),
    [
        ([0, 1, 1, 1], "linear", "rows 2 and 3"),
        ([0, 0, 1, 2], "linear", "rows 1 and 2"),
        ([0, 1, 2, 2], "log", "rows 3 and 4"),
        ([0, 1, 1, 2], "step", "interpolation = 'linear'"),
        ([0, 2, 1, 3], "linear", "sort the rows"),
    ],
)
def test_rows_at_one_x_that_are_no_jump(x, how, words, tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(
        f"[beam]\ninterpolation = '{how}'\n[beam.stations]\nx = {x}\n"
        "mass_per_length = [1, 1, 1, 1]\nbending_stiffness = [1, 1, 1, 1]\n"
    )
    with pytest.raises(InputError, match=words):
        load_beam(path)


def test_a_force_that_jumps_between_supports_is_a_column(tmp_path):
    beam = Beam.from_stations(
        [0, 1, 2], [1, 1, 1], [4, 4, 4], [9, 9, 9], ends=Ends("clamped", "clamped")
    )
    beam = replace(beam, interpolation="linear", axial_force=np.array([[1.0, 2], [5, 6]]))
    for ending in ("toml", "csv", "xlsx"):
        path = tmp_path / f"b.{ending}"
        write_beam(path, beam, ending)
        again = read_beam(path, ending, Choices()).beam
        assert again.axial_force.tolist() == [[1, 2], [5, 6]]


def test_a_hull_jumps_where_the_beam_does_not():
    hull = {"x": np.array([0.0, 1, 1, 2]), "radius": np.array([1.0, 2, 3, 4])}
    stations = Stations("linear", {"x": np.array([0.0, 1, 2]), "m": np.array([5.0, 6, 7])})
    columns = stations.with_hull(hull).columns
    assert columns["x"].tolist() == [0, 1, 1, 2]
    assert columns["m"].tolist() == [5, 6, 6, 7]
    assert columns["radius"].tolist() == [1, 2, 3, 4]


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
def test_a_table_stands_where_a_beam_file_is_expected(ending, tmp_path):
    path = flange_file(tmp_path, ending)
    beam = load_beam(path, CLAMPED).beam()
    assert (beam.ends.left, beam.name, beam.interpolation) == ("clamped", "flange", "linear")
    found = []
    for file in (path, flange_file(tmp_path, ".toml")):
        ended = run("beam", file, "--set", CLAMPED[0], "--modes", "2", "--json")
        assert ended.code == 0, ended
        found.append([mode["omega2"] for mode in json.loads(ended.out)["modes"]])
    assert found[0] == found[1]
    report = tmp_path / "report.html"
    assert run("report", path, "--set", CLAMPED[0], "-o", report).code == 0
    refused(run("beam", path, "--set", "beam.ends.lft=clamped"), "lft", "(with --set)")
    refused(run("beam", tmp_path / f"gone{ending}"), "no such file")


def test_names_with_quotes_and_formulas(tmp_path):
    for name in ('a "b" \\ c', "=1+1", "ä\tb"):
        beam = replace(example("beam"), name=name)
        text, _ = beam_file_text(beam)
        assert tomllib.loads(text)["beam"]["name"] == name
        write_beam(tmp_path / "b.xlsx", beam, "xlsx")
        cell = openpyxl.load_workbook(tmp_path / "b.xlsx")["beam"]["B2"]
        assert (cell.value, cell.data_type) == (name, "s")


def test_everything_is_in_the_workbook(tmp_path):
    write_beam(tmp_path / "b.xlsx", everything(), "xlsx")
    book = openpyxl.load_workbook(tmp_path / "b.xlsx")
    assert book.sheetnames == ["stations", "beam", "point_masses", "springs", "joints"]
    assert book["springs"]["B3"].value == "inf"


def test_a_hull_goes_from_table_to_table(tmp_path):
    given = tmp_path / "hull.csv"
    given.write_text(
        "x [m], mass_per_length, bending_stiffness [kN m^2], radius [mm], wall [mm]\n"
        "0, 5, 4, 40, 2\n1, 6, 5, 80, 3\n2, 6, 5, 80, 3\n"
    )
    book, table = tmp_path / "hull.xlsx", tmp_path / "again.csv"
    assert convert(Request(given, book)) == convert(Request(book, table)) == ()
    columns = read_csv(table, ("x", "mass_per_length", "bending_stiffness", "radius", "wall"))
    assert columns["radius"] == [0.04, 0.08, 0.08]
    assert columns["wall"] == [0.002, 0.003, 0.003]
    (note,) = convert(Request(table, tmp_path / "beam.toml"))
    assert "a beam has none: radius, wall" in note


def test_a_hull_stands_at_the_rows_of_the_beam():
    hull = {"x": np.array([0.0, 2, 4]), "radius": np.array([1.0, 2, 3])}
    for interpolation, radius in (("step", [1, 1, 2, 3]), ("linear", [1, 1.5, 2, 3])):
        stations = Stations(interpolation, {"x": np.array([0.0, 1, 2, 4])}).with_hull(hull)
        assert stations.columns["radius"].tolist() == radius
