"""Beams as beam files, CSV and workbooks, there and back; independent readers open them."""

import tomllib
from dataclasses import replace

import numpy as np
import openpyxl
import pytest

from antinode import InputError, load_beam
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.exchange.beam_toml import beam_file_text
from antinode.exchange.convert import Request, convert
from antinode.exchange.inputs import Choices, read_beam
from antinode.exchange.outputs import write_beam
from antinode.exchange.tabulated import Stations, tabulate
from antinode.inputs.reading import read_csv
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
    write_beam(path, beam_of(name), "csv")
    ends = beam_of(name).ends
    sets = (f"beam.ends.left={ends.left}", f"beam.ends.right={ends.right}")
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
    assert len(stations.columns["x"]) == 4
    assert np.diff(stations.columns["x"])[1] == pytest.approx(2e-9, rel=1e-6)
    assert "1 jump" in stations.notes[0]


def test_a_force_that_no_file_can_hold_is_refused():
    beam = Beam.from_stations(
        [0, 1, 2], [1, 1, 1], [4, 4, 4], [9, 9, 9], ends=Ends("clamped", "clamped")
    )
    beam = replace(beam, interpolation="linear", axial_force=np.array([[1.0, 2], [5, 6]]))
    with pytest.raises(InputError, match="several supports"):
        beam_file_text(beam)


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
