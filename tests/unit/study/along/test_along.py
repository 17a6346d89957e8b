"""`antinode stability --along` and `--map`: inputs as studies name them."""

import json

import numpy as np
import pytest

import antinode as an
from antinode.study.along.along import loci_along
from cli_run import refused, run

BECK = """
[beam]
name = "column"
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [16, 16]
"""


@pytest.fixture
def column(tmp_path):
    path = tmp_path / "column.toml"
    path.write_text(BECK)
    return path


def test_json_along_an_input(column, tmp_path):
    loci, table = tmp_path / "loci.svg", tmp_path / "found.csv"
    range_ = "axial_force = 0.8 .. 1.5"
    ended = run(
        "stability", column, "--along", range_, "--points", 4, "--json", "--plot", loci, "-o", table
    )
    assert ended.code == 0
    data = json.loads(ended.out)
    assert data["along"] == {
        "input": "beam.stations.axial_force",
        "name": "axial_force",
        "unit": "1",
    }
    (change,) = data["critical"]
    assert change["kind"] == "flutter"
    assert change["value"] == pytest.approx(20.0509536190 / 16, rel=1e-8)
    assert data["range"] == [0.8, change["bracket"][1]]
    assert loci.read_text().count("<svg") == 1
    assert table.read_text().splitlines()[1].startswith("flutter,1.2531")


def test_a_map_of_the_load_factor(column, tmp_path):
    figure = tmp_path / "map.svg"
    over = "ends.right_follower = 0 .. 1"
    ended = run("stability", column, "--map", over, "--rows", 3, "--json", "--plot", figure)
    data = json.loads(ended.out)
    assert data["over"]["values"] == [0.0, 0.5, 1.0]
    assert data["divergence"][0] == pytest.approx(np.pi**2 / 64, rel=1e-8)
    assert data["flutter"][1:] == pytest.approx([16.0524615772 / 16, 20.0509536190 / 16], rel=1e-8)
    assert figure.exists()


def test_a_map_of_two_inputs(column):
    problem = an.load_beam(column)
    found = an.stability_map(
        problem,
        ("axial_force", 0.8, 1.5),
        ("bending_stiffness", 0.9, 1.1),
        rows=2,
        points=3,
    )
    assert found.boundary("flutter") == pytest.approx(
        np.array([0.9, 1.1]) * 20.0509536190 / 16, rel=1e-8
    )
    assert np.isnan(found.boundary("divergence")).all()


def test_units_and_a_vehicle(tmp_path):
    run("init", tmp_path / "demo")
    case = an.load_case(tmp_path / "demo" / "case.toml")
    found = an.stability_along(case, "thrust", "400 kN", "520 kN", points=3)
    (change,) = found.critical
    assert (change.kind, change.modes) == ("divergence", ("rigid rotation",))
    assert found.line.unit == "N"
    assert 4e5 < change.value < 5.2e5
    assert list(found.to_dataframe()["kind"]) == ["divergence"]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--along", "axial_force"], "write an input and its range"),
        (["--along", "axial_forse = 1 .. 2"], "axial_force"),
        (["--along", "axial_force = 2 .. 1"], "is empty"),
        (["--along", "ends.right_follower = 0 m .. 1"], "without a unit"),
        (["--along", "ends.right_follower = 0 .. 2"], "no further than|outside the range|0 to 1"),
        (["--along", "axial_force = 1 .. 2", "--to", "3"], "--to is for the load factor"),
        (["--along", "axial_force = 1 .. 2", "--points", "1"], "give 2"),
        (["--points", "5"], "--points is for --along"),
        (["--along", "axial_force=1..2", "--map", "axial_force=1..2"], "both axes"),
    ],
)
def test_bad_input_is_one_sentence(column, options, says):
    if "0 .. 2" in options[1]:
        ended = run("stability", column, *options, "--points", 3)
        assert ended.code == 0
        assert "no further than" in ended.out + ended.err
        return
    refused(run("stability", column, *options), says)


def test_what_is_left_out_stands_beside_the_numbers(column):
    """Dampers count along an input; along the factor they do not, and a map of it says so."""
    column.write_text(column.read_text() + "[[beam.dashpots]]\nx = 1\ntranslational = 0.1\n")
    along = run("stability", column, "--along", "axial_force = 0.5 .. 0.6", "--json", "--points", 2)
    map_ = ("stability", column, "--map", "dashpots.0.translational = 0.1 .. 1", "--rows", 2)
    left = [json.loads(ended.out)["not_modelled"] for ended in (along, run(*map_, "--json"))]
    assert "damping" not in left[0]
    assert not any("dashpots" in words for words in left[0])
    assert "dashpots and loss factors of the beam" in left[1][0]
    assert "dashpots and loss factors of the beam" in " ".join(run(*map_).out.split())


def test_loci_run_into_the_change(column):
    """Where a damped mode has just stopped to diverge it creeps back: two on the real axis."""
    column.write_text(column.read_text() + "[[beam.dashpots]]\nx = 1\ntranslational = 0.05\n")
    found = an.stability_along(an.load_beam(column), "ends.right_follower", 0, 1, points=9)
    loci = loci_along(found)
    change = found.critical[0]
    assert change.change == "regained"
    k = np.argmin(np.abs(loci.factor - change.value))
    assert abs(loci.growth_per_s[k]).min() < 1e-3
    assert np.nanmax(np.abs(np.diff(loci.frequency_hz[:, 1]))) < 0.5
