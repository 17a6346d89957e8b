"""Sixty mistakes of newcomers: each ends in one sentence that names the way out."""

import shlex

import pytest

from cli_run import refused, run

BEAM = """[beam]
name = "b"
interpolation = "linear"
[beam.stations]
x = [0, 2, 4]
mass_per_length = [10, 8, 6]
bending_stiffness = [4e4, 3e4, 2e4]
axial_stiffness = [4e7, 3e7, 2e7]
axial_force = [100, 50, 0]
[beam.ends]
left = "clamped"
[[beam.point_masses]]
x = 4
mass = 5
[[beam.springs]]
x = 2
translational = 1000
[beam.loads]
gravity = -9.81
"""
CSV = "x [m],mass_per_length [kg/m],bending_stiffness [N m^2]\n0,10,4e4\n2,8,3e4\n4,8,3e4\n"
STUDY = 'case = "case.toml"\ninputs = [{ key = "speed", values = [60, 80] }]\nsolve.modes = 2\n'

IN_BEAM_FILES = [
    ("x = [0, 2, 4]", "x = [4, 2, 0]", "sort the rows"),
    ("x = [0, 2, 4]", "x = [0, 2, 2]", "a jump inside the beam"),
    ("x = [0, 2, 4]", "x = [0, 2000, 4000]", "check the units"),
    ("x = [0, 2, 4]", 'x = [0, "2 kg", 4]', "'kg' is no unit of m"),
    ("mass_per_length = [10, 8, 6]", "mass = [10, 8, 6]", "did you mean mass_per_length?"),
    ("mass_per_length = [10, 8, 6]", "mass_per_length = [10, 8]", "one value a row"),
    ("mass_per_length = [10, 8, 6]", "mass_per_length = 10", "needs a list of numbers"),
    ("mass_per_length = [10, 8, 6]", 'mass_per_length = ["10 kg", 8, 6]', "'kg' is no unit"),
    ("mass_per_length = [10, 8, 6]", "mass_per_length = [10, 0, 6]", "row 2, is 0"),
    ("bending_stiffness", "stiffness", "did you mean bending_stiffness?"),
    ("axial_force", "tension", "compression is positive and tension negative"),
    ("axial_force", "N", "did you mean axial_force"),
    ('"clamped"', '"fixed"', "did you mean 'clamped'?"),
    ('"clamped"', '"hinged"', "did you mean 'pinned'?"),
    ('"clamped"', '"Clamped"', "did you mean 'clamped'?"),
    ('"clamped"', "clamped", "a text stands in quotes"),
    ('"clamped"', '"clamped"\nleft_axial = "pinned"', "did you mean 'fixed'?"),
    ("[beam.ends]\nleft", "[beam.ends]\nbase", "did you mean left?"),
    ("[beam.ends]", "[ends]", "did you mean beam.ends?"),
    ('"linear"', '"Linear"', "did you mean 'linear'?"),
    ("[[beam.point_masses]]", "[[beam.point_mass]]", "did you mean point_masses?"),
    (
        "[[beam.point_masses]]",
        "[beam.point_masses]",
        "write [[beam.point_masses]], in double brackets",
    ),
    ("[[beam.springs]]", "[beam.springs]", "write [[beam.springs]]"),
    ("[[beam.point_masses]]", "[[point_masses]]", "did you mean beam.point_masses?"),
    ("x = 4\n", "x = 5\n", "off the beam, which runs from 0 to 4 m"),
    ("mass = 5", 'mass = "5 N"', "'N' is no unit of kg"),
    ("mass = 5", "mass = 5\ninertia = 3", "did you mean rotary_inertia?"),
    ("translational", "stiffness", "did you mean translational?"),
    ("gravity", "g", "did you mean gravity?"),
    ("gravity = -9.81", "gravity = -9.81\nacceleration = '1 g'", "'g' is no unit of m/s^2"),
]
IN_TABLES = [
    ("x [m]", "x [kg]", "'kg' is no unit of m"),
    ("2,8,3e4", "2,-8,3e4", "mass_per_length"),
    ("bending_stiffness [N m^2]", "bending_stiffness [N m]", "'N m' is no unit of N m^2"),
    ("x [m]", "x m", "brackets: x [m]"),
    ("x [m]", "x [m", "not closed"),
    ("kg/m", "kg", "'kg' is no unit of kg/m"),
    ("4e4", "4e4 N m^2", "its unit stands in the header"),
    ("4e4", "n/a", "received 'n/a'"),
    ("2,8,", "2,8", "one number for each column"),
]
ON_THE_LINE = [
    ("beam", "requires an argument"),
    ("beam t.csv extra", "one argument too many"),
    ("beam nofile.toml", "no such file"),
    ("beam case.toml", "antinode modes"),
    ("beam deck.bdf", "antinode convert deck.bdf beam.toml"),
    ("beam t.toml --mode 3", "--modes"),
    ("beam t.toml --method TMM", "tmm"),
    ("beam t.toml --set left=pinned", "did you mean beam.ends.left?"),
    ("beam t.toml -o out.txt", "allowed are .csv"),
    ("modes t.toml", "antinode beam"),
    ("modes stations.csv", "vehicle.stations = 'stations.csv'"),
    ("modes case.toml --set speed=100", "did you mean condition.speed?"),
    ("modes case.toml --set condition.cavitator_angle=10", "did you mean '10 deg'?"),
    ("modes case.toml --set condition.speed=80000", "check the units"),
    ("sweep case.toml", "in a study file with case = 'case.toml'"),
    ("sweep t.toml", "name it in a study file with case = 't.toml'"),
    ("sweep s.toml -o s.xlsx", ".zarr"),
    ("sensitivity case.toml", "--uncertain speed=2%"),
    ("sensitivity case.toml --uncertain burn_fraction=10%", "the case has 0 there"),
    ("sensitivity case.toml --uncertain depth=1m", "changes nothing"),
    ("identify t.toml", "this is a beam file"),
    ("convert t.toml t.xyz", "the ending says the format"),
    ("report t.toml", "requires an argument"),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mistakes")
    run("init", folder)
    (folder / "t.toml").write_text(BEAM)
    (folder / "s.toml").write_text(STUDY)
    (folder / "deck.bdf").write_text("GRID,1,,0.,0.,0.\n")
    return folder


def test_there_are_sixty():
    assert len(IN_BEAM_FILES) + len(IN_TABLES) + len(ON_THE_LINE) >= 60


@pytest.mark.parametrize(("old", "new"), [("bending_stiffness", "EI"), ("axial_stiffness", "EA")])
def test_symbols_are_read_as_columns(folder, old, new):
    (folder / "u.toml").write_text(BEAM.replace(old, new, 1))
    assert run("beam", folder / "u.toml").out == run("beam", folder / "t.toml").out


@pytest.mark.parametrize(("old", "new"), [("x [m]", "position [m]"), ("mass_per_length", "mu")])
def test_other_words_are_read_as_columns(folder, old, new):
    (folder / "u.csv").write_text(CSV)
    plain = run("beam", folder / "u.csv").out
    (folder / "u.csv").write_text(CSV.replace(old, new, 1))
    assert run("beam", folder / "u.csv").out == plain


def test_what_is_spoilt_is_right_before(folder, monkeypatch):
    monkeypatch.chdir(folder)
    (folder / "u.csv").write_text(CSV)
    for arguments in ("beam t.toml", "beam u.csv", "modes case.toml"):
        assert run(*arguments.split(), "--modes", "1").code == 0


@pytest.mark.parametrize(("old", "new", "word"), IN_BEAM_FILES)
def test_in_beam_files(folder, old, new, word):
    assert old in BEAM
    (folder / "u.toml").write_text(BEAM.replace(old, new, 1))
    refused(run("beam", folder / "u.toml"), word)


@pytest.mark.parametrize(("old", "new", "word"), IN_TABLES)
def test_in_tables(folder, old, new, word):
    assert old in CSV
    (folder / "u.csv").write_text(CSV.replace(old, new, 1))
    refused(run("beam", folder / "u.csv"), word)


@pytest.mark.parametrize(("line", "word"), ON_THE_LINE)
def test_on_the_line(folder, line, word, monkeypatch):
    monkeypatch.chdir(folder)
    refused(run(*shlex.split(line)), word)
