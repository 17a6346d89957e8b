"""The command line: what it prints, writes and refuses, with its exit codes."""

import csv
import io
import json
import os
import subprocess
import sys
import tomllib
import warnings
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from antinode import ComputationError
from antinode.cli.commands import beam
from antinode.examples import EXAMPLES
from cli_run import contents, python, refused, replaced, run


@pytest.fixture
def starter(tmp_path, monkeypatch):
    """The starter case in the current folder, its end forces of fixed direction."""
    monkeypatch.chdir(tmp_path)
    assert run("init").code == 0
    path = tmp_path / "case.toml"
    path.write_text(path.read_text().replace('"follows_body"', '"fixed_direction"'))
    return tmp_path


@pytest.fixture
def mast(tmp_path, monkeypatch):
    """The beam example in the current folder."""
    monkeypatch.chdir(tmp_path)
    assert run("init", "--beam").code == 0
    return tmp_path


CASE, STATIONS = "case.toml", "stations.csv"
ROLL = 'roll_angles = ["45 deg", "135 deg", "225 deg", "315 deg"]'


def value(key, new):
    """An edit of the starter's case: `key` gets another value."""
    return CASE, f"\n{key} = ", f"\n{key} = {new}\n# was "


WRONG_VALUES = {
    "zero": (value("diameter", "0"), ["vehicle.cavitator.diameter is 0", "greater than 0"]),
    "negative": (value("diameter", "'-80 mm'"), ["diameter is '-80 mm'", "greater than 0"]),
    "nan": (value("diameter", "nan"), ["diameter is nan", "it must be a finite number"]),
    "inf": (value("diameter", "inf"), ["diameter is inf", "finite number"]),
    "1e400": (value("diameter", "1e400"), ["diameter is inf", "finite number"]),
    "10**400": (value("diameter", "1" + "0" * 400), ["diameter is 1000", "below 1e308"]),
    "10**5000": (value("diameter", "1" + "0" * 5000), ["thousands of digits"]),
    "boolean": (value("diameter", "true"), ["diameter is true", "needs a number"]),
    "empty text": (value("diameter", "''"), ["diameter is ''", "needs a number"]),
    "word": (value("diameter", "'big'"), ["diameter is 'big'", "'1 m'"]),
    "list": (value("diameter", "[1]"), ["diameter is [1]", "needs a number"]),
    "table": (value("diameter", "{ a = 1 }"), ["diameter is {'a': 1}", "needs a number"]),
    "date": (value("diameter", "1979-05-27"), ["diameter is 1979-05-27", "needs a number"]),
    "unicode": (value("diameter", "'é m'"), ["diameter is 'é m'"]),
    "wrong unit": (value("diameter", "'80 kg'"), ["diameter is '80 kg'", "'kg' is no unit of m"]),
    "long text": (value("diameter", f"'{'x' * 5000}'"), ["at most 80 characters"]),
    "sigma 0": (value("cavitation_number", "0"), ["cavitation_number is 0", "greater than 0"]),
    "sigma 1": (value("cavitation_number", "1"), ["cavitation_number is 1", "less than 1"]),
    "sigma < 0": (value("cavitation_number", "-0.1"), ["cavitation_number is -0.1"]),
    "sigma with unit": (value("cavitation_number", "'1 m'"), ["without a unit"]),
    "angle": (value("cavitator_angle", "10"), ["condition.cavitator_angle", "'10 deg'?"]),
    "body angle": (value("body_angle", "-5"), ["condition.body_angle", "'-5 deg'?"]),
    "roll angle": ((CASE, ROLL, "roll_angles = [45]"), ["roll_angles.0", "'45 deg'?"]),
    "no fin": ((CASE, ROLL, "roll_angles = []"), ["vehicle.fins.0.roll_angles is []", "one entry"]),
    "one fin": ((CASE, ROLL, "roll_angles = '1 deg'"), ["roll_angles is '1 deg'", "a list"]),
    "thickness": (value("thickness", "-1"), ["vehicle.fins.0.thickness is -1"]),
    "fins off": (value("fin_position", "'7 m'"), ["set 1", "7 m", "within 0 and 6 m"]),
    "fins ahead": (value("fin_position", "-1"), ["condition.fin_position is -1", "at least 0"]),
    "short fin": (value("tip_radius", "0.1"), ["tip_radius 0.1 m", "radius of 0.19 m"]),
    "burnt": (value("burn_fraction", "2"), ["condition.burn_fraction is 2", "at most 1"]),
    "choice": (value("interpolation", "'cubic'"), ["'cubic'", "'step', 'linear' or 'log'"]),
    "name": (value("name", "3"), ["vehicle.name is 3", "a text in quotes"]),
    "modes 0": (value("modes", "0"), ["solve.modes is 0", "at least 1"]),
    "modes text": (value("modes", "'6'"), ["solve.modes is '6'", "whole number"]),
    "modes true": (value("modes", "true"), ["solve.modes is true", "whole number"]),
    "modes 2.5": (value("modes", "2.5"), ["solve.modes is 2.5", "whole number"]),
    "no table": (value("stations", "'no.csv'"), ["no.csv: no such file"]),
    "near table": (value("stations", "'station.csv'"), ["did you mean stations.csv?"]),
    "folder": (value("stations", "'.'"), ["this is a folder"]),
    "device": (value("stations", "'/dev/zero'"), ["/dev/zero", "no regular file"]),
    "number": (value("stations", "3"), ["vehicle.stations is 3", "CSV file"]),
    "empty name": (value("stations", "''"), ["vehicle.stations is ''", "CSV file"]),
    "empty table": (value("stations", "{}"), ["vehicle.stations.x is missing"]),
    "column": (value("stations", "{ y = [1] }"), ["vehicle.stations", "unknown column 'y'"]),
    "cells": (value("stations", "{ x = [[0], [1]] }"), ["vehicle.stations.x: row 1", "'[0]'"]),
    "text column": (value("stations", "{ x = 'a' }"), ["vehicle.stations.x", "list of numbers"]),
}

WRONG_KEYS = {
    "near": ("\nspeed", "\nsped", ["unknown key condition.sped", "did you mean speed?"]),
    "far": ("\nspeed", "\nzzz = 1\nspeed", ["unknown key condition.zzz", "allowed are body_angle"]),
    "table": ("[condition]", "[conditions]", ["unknown key conditions", "did you mean condition?"]),
    "in a list": ("thickness", "thicknes", ["vehicle.fins.0.thicknes;", "mean thickness?"]),
    "missing": ("\nspeed", "\n# speed", ["condition.speed is missing", "antinode schema"]),
    "no table": ("[vehicle.cavitator] ", "[water] #", ["unknown key water.diameter"]),
    "control": ("\nspeed", '\n"\\u001b[31mx" = 1\nspeed', ["unknown key condition. [31mx"]),
}

WRONG_STATIONS = {
    "negative mass": ("0.4,215", "0.4,-215", ["mass_per_length, row 4", "-215", "greater than 0"]),
    "zero mass": ("0.4,215", "0.4,0", ["mass_per_length, row 4", "received 0", "greater than 0"]),
    "stiffness": ("185,58", "-185,58", ["bending_stiffness, row 4", "-185000"]),
    "unsorted": ("0.4,215", "0.1,215", ["rows 3 and 4", "received 0.2, then 0.1", "sort the rows"]),
    "duplicate": ("0.4,215", "0.2,215", ["rows 3 and 4", "duplicate"]),
    "nan": ("0.4,215", "0.4,nan", ["line", "mass_per_length", "'nan'", "finite"]),
    "empty cell": ("0.4,215", "0.4,", ["line", "mass_per_length", "''"]),
    "column": ("radius [mm],", "", ["cells, but 6 in the header"]),
    "unit": ("[kN m^2]", "[kN]", ["bending_stiffness", "'kN' is no unit of N m^2", "[N m^2]"]),
}


@pytest.mark.parametrize("name", WRONG_VALUES)
def test_wrong_value(starter, name):
    (file, old, new), words = WRONG_VALUES[name]
    replaced(starter / file, old, new)
    refused_untouched(starter, words)


@pytest.mark.parametrize("name", WRONG_KEYS)
def test_wrong_key(starter, name):
    old, new, words = WRONG_KEYS[name]
    replaced(starter / CASE, old, new)
    refused_untouched(starter, [CASE, *words])


@pytest.mark.parametrize("name", WRONG_STATIONS)
def test_wrong_stations(starter, name):
    old, new, words = WRONG_STATIONS[name]
    replaced(starter / STATIONS, old, new)
    refused_untouched(starter, [STATIONS, *words])


def refused_untouched(folder, words):
    """Every command that reads the case refuses it, and no file changes or appears."""
    before = contents(folder)
    refused(run("modes", CASE, "-o", "new.csv", "--plot", "new.png"), *words)
    refused(run("loads", CASE, "-o", "new.json"), *words)
    assert contents(folder) == before


@pytest.mark.parametrize(
    ("sets", "words"),
    [
        (["cavity_pressure=1kPa", "depth=10m"], ["imply a cavity pressure", "leave out one"]),
        (["cavity_pressure=1kPa"], ["below the atmosphere's 101325 Pa"]),
        (["cavitation_number=0.9", "depth=0"], ["cavity pressure of -2.7", "leave out the depth"]),
    ],
)
def test_contradictory_pressures(starter, sets, words):
    options = [part for one in sets for part in ("--set", f"condition.{one}")]
    refused(run("modes", CASE, *options), CASE, *words)


WRONG_BEAMS = {
    "unsorted": ("x=[0, 2, 1]", ["x must increase: row 2 has 2 m and row 3 1 m", "sort"]),
    "duplicate": ("x=[0, 1, 1]", ["x must increase", "duplicate"]),
    "nan": ("x=[0, nan, 1]", ["x, row 2, is nan", "finite"]),
    "one row": ("x=[0]", ["x has 1 row;", "at least two"]),
    "empty": ("x=[]", ["x has 0 rows"]),
    "mass": ("mass_per_length=[1, 0, 1]", ["mass_per_length, row 2, is 0", "greater than 0"]),
    "stiffness": ("bending_stiffness=[1, -1, 1]", ["bending_stiffness, row 2, is -1"]),
    "rows": ("axial_force=[1, 2]", ["axial_force has 2 rows, but x has 3"]),
    "huge": ("bending_stiffness=[1e300, 1e300, 1e300]", ["bending_stiffness runs from 1e+300"]),
    "long": ("x=[0, 1e12, 2e12]", ["x runs from 0 to 2e+12 m", "unit of x"]),
    "pressed": ("axial_force=[1e20, 1e20, 1e20]", ["about 6366197724 modes diverge"]),
    "column": ("mas_per_length=[1, 1, 1]", ["did you mean mass_per_length?"]),
}


@pytest.mark.parametrize("name", WRONG_BEAMS)
def test_wrong_beam(tmp_path, name):
    file = tmp_path / "beam.toml"
    file.write_text(
        "[beam.stations]\nx = [0, 1, 2]\nmass_per_length = [1, 1, 1]\n"
        "bending_stiffness = [1, 1, 1]\naxial_force = [0, 0, 0]\n"
    )
    assert run("beam", file).code == 0
    setting, words = WRONG_BEAMS[name]
    refused(run("beam", file, "--set", f"beam.stations.{setting}"), str(file), *words)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--modes", "0"], ["modes is 0", "at least 1"]),
        (["--modes", "-5"], ["modes is -5", "at least 1"]),
        (["--modes", "10000"], ["modes is 10000", "at most 500"]),
        (["--modes", "abc"], ["--modes", "'abc' is no whole number"]),
        (["--modes", "2.5"], ["--modes", "'2.5' is no whole number"]),
        (["--modes", "9" * 5000], ["--modes", "no whole number"]),
        (["--tolerance", "0"], ["tolerance is 0", "at least 1e-12"]),
        (["--tolerance", "nan"], ["tolerance is nan", "finite"]),
        (["--tolerance", "1"], ["tolerance is 1", "at most 0.1"]),
        (["--method", "magic"], ["magic", "riccati", "tmm"]),
        (["--shapes", "round"], ["round", "amplitude"]),
        (["--jso"], ["--jso", "--json"]),
        (["extra"], ["'extra' is one argument too many", "antinode modes --help"]),
        (["--set"], ["--set"]),
        (["--set", "x"], ["--set: received 'x'", "condition.speed=100m/s"]),
        (["--set", "condition.sped=1"], ["with --set", "condition.sped", "did you mean speed?"]),
        (["--set", "condition.speed=fast"], ["condition.speed is 'fast'"]),
        (["--set", "vehicle.fins.0.thickness=-1"], ["vehicle.fins.0.thickness is -1"]),
        (["--set", "vehicle.fins.7.thickness=1"], ["from 0 to 0"]),
        (["-o"], ["-o"]),
        (["-o", "x.txt"], ["x.txt", ".csv, .json, .nc"]),
        (["-o", "no/x.csv"], ["no/x.csv", "no folder no"]),
        (["-o", "case.toml/x.csv"], ["no folder case.toml"]),
        (["-o", "."], ["the ending"]),
        (["-o", "x" * 300 + ".csv"], ["too long"]),
        (["-o", "stations.csv"], ["stations.csv", "an input"]),
        (["--plot", "x.bmp"], ["x.bmp", ".png, .svg, .pdf"]),
        (["--plot", "no/x.png"], ["no/x.png", "no folder no"]),
    ],
)
def test_wrong_options(starter, arguments, words):
    before = contents(starter)
    refused(run("modes", CASE, *arguments), *words)
    assert contents(starter) == before


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["modes"], ["CASE"]),
        (["modes", "no.toml"], ["no.toml: no such file", "antinode init"]),
        (["modes", "."], ["this is a folder"]),
        (["frobnicate"], ["frobnicate", "modes"]),
        (["mode", "x"], ["modes"]),
        (["schema", "vehicle"], ["'vehicle'", "case, beam"]),
        (["init", "--example", "no"], ["'no'", "starter"]),
        (["init", "--beam", "--example", "tower"], ["contradict"]),
        (["init", "a", "b"], ["'b' is one argument too many"]),
    ],
)
def test_wrong_commands(tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    refused(run(*arguments), *words)
    assert contents(tmp_path) == {}


def test_the_other_kind_of_file(starter):
    refused(run("beam", CASE), "antinode modes case.toml")
    run("init", "--beam")
    refused(run("modes", "beam.toml"), "antinode beam beam.toml")
    refused(run("loads", "beam.toml"), "antinode beam beam.toml")


class TestInit:
    @pytest.mark.parametrize("name", EXAMPLES)
    def test_the_command_that_it_names_runs(self, tmp_path, monkeypatch, name):
        monkeypatch.chdir(tmp_path)
        said = run("init", "--example", name, "a folder")
        assert said.code == 0
        command = said.out.splitlines()[-1].removeprefix("next: antinode ")
        done = subprocess.run(
            f"{sys.executable} -c 'from antinode.cli import main; main()' {command}",
            shell=True,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        assert "bending 1" in done.stdout

    def test_never_overwrites_and_writes_all_or_nothing(self, tmp_path):
        (tmp_path / STATIONS).write_text("mine")
        refused(run("init", tmp_path), STATIONS, "exists already and is kept")
        assert contents(tmp_path) == {STATIONS: b"mine"}

    def test_removes_what_it_wrote_when_a_later_file_fails(self, tmp_path, monkeypatch):
        os.mkdir(tmp_path / "x")
        monkeypatch.setattr(
            "antinode.examples._texts", lambda name: {"a.toml": "a = 1", "no/b.toml": "b = 1"}
        )
        refused(run("init", tmp_path / "x"), "cannot be written")
        assert contents(tmp_path) == {}

    def test_a_file_in_the_way(self, tmp_path):
        (tmp_path / "file").write_text("")
        refused(run("init", tmp_path / "file"), "cannot be written")
        refused(run("init", tmp_path / "file" / "x"), "cannot be written")


MODE_KEYS = {
    "family",
    "number",
    "kind",
    "frequency_hz",
    "omega2",
    "bracket_omega2",
    "counts",
    "bracket_hz",
    "error_hz",
    "growth_rate_per_s",
    "model_error",
}


def strict_json(text):
    """Parse JSON that has neither NaN nor Infinity."""

    def no(constant):
        raise AssertionError(f"{constant} is no JSON")

    return json.loads(text, parse_constant=no)


class TestJson:
    def test_modes(self, starter):
        ended = run("modes", CASE, "--json")
        assert (ended.code, ended.err) == (0, "")
        data = strict_json(ended.out)
        assert data["schema_version"] == 1
        assert set(data["modes"][0]) >= MODE_KEYS
        assert all(set(mode) == set(data["modes"][0]) for mode in data["modes"])
        assert {m["kind"] for m in data["modes"]} == {"rigid", "elastic", "divergent"}
        for mode in data["modes"]:
            low, high = mode["bracket_omega2"]
            assert low <= mode["omega2"] <= high
            assert mode["counts"][1] - mode["counts"][0] == 1
            if mode["kind"] == "divergent":
                assert mode["frequency_hz"] is None
                assert mode["growth_rate_per_s"] == pytest.approx((-mode["omega2"]) ** 0.5)
            else:
                assert mode["growth_rate_per_s"] is None
                assert mode["frequency_hz"] == pytest.approx(mode["omega2"] ** 0.5 / (2 * np.pi))

    def test_the_loads_within_modes(self, starter):
        data = strict_json(run("modes", CASE, "--json").out)
        loads = data["loads"]
        drag = sum(force["drag_N"] for force in loads["forces"])
        forward = (loads["thrust_N"] - drag) / loads["mass_kg"]
        assert loads["acceleration_forward_m_per_s2"] == pytest.approx(forward)
        assert loads["axial_force_nose_N"] == pytest.approx(loads["forces"][0]["drag_N"])
        assert loads["axial_force_tail_N"] == pytest.approx(50e3)
        assert max(map(abs, loads["checks"].values())) < 1e-9
        assert data["condition"]["speed_m_per_s"] == 80
        assert data["condition"]["depth_m"] is None
        everything = strict_json(run("loads", CASE, "--json").out)
        assert everything["schema_version"] == 1
        assert loads.items() <= everything.items()
        assert set(everything["internal"]) >= {"x_m", "N_N", "Q_N", "M_N_m"}

    def test_infinity_is_null(self, starter):
        validity = strict_json(run("loads", CASE, "--json").out)["validity"]
        assert None in [row["high"] for row in validity]

    def test_beam(self, mast):
        data = strict_json(run("beam", "beam.toml", "--json", "--modes", "3").out)
        assert [m["number"] for m in data["modes"] if m["family"] == "bending"] == [1, 2, 3]
        assert data["modes"][0]["frequency_hz"] > 0
        assert "buckling" not in data
        data = strict_json(run("beam", "beam.toml", "--json", "--buckling").out)
        assert data["buckling"]["load_factor"] > 1

    def test_verify(self):
        data = strict_json(run("verify", "--json").out)
        assert data["schema_version"] == 1
        assert all(check["passed"] for check in data["checks"])
        assert max(c["worst_relative_error"] for c in data["checks"]) <= data["allowed"]

    def test_warnings_of_the_loads_come_with_those_of_the_modes(self, starter):
        ended = run("modes", CASE, "--json", "--set", "condition.cavitation_number=0.2")
        text = " ".join(strict_json(ended.out)["warnings"])
        assert "The cavity closes" in text
        assert "rotation is divergent" in text


class TestSchema:
    @pytest.mark.parametrize("of", ["case", "beam", "response"])
    def test_is_a_schema_with_a_description_for_every_key(self, of):
        schema = strict_json(run("schema", of).out)
        jsonschema.Draft202012Validator.check_schema(schema)
        for where in [schema, *schema["$defs"].values()]:
            for key, entry in where["properties"].items():
                text = described(schema, entry)
                assert len(text) > 3, key
                assert entry.get("unit", "1") in ("1", "rad") or f"[{entry['unit']}]" in text, key

    @pytest.mark.parametrize("name", EXAMPLES)
    def test_accepts_the_examples(self, tmp_path, name):
        run("init", "--example", name, tmp_path)
        for file in tmp_path.glob("*.toml"):
            known = {CASE: "case", "beam.toml": "beam", "response.toml": "response"}
            of = known.get(file.name, "study")
            jsonschema.validate(tomllib.loads(file.read_text()), strict_json(run("schema", of).out))

    @pytest.mark.parametrize(
        ("key", "wrong"),
        [("speed", True), ("speed", 0), ("sped", 1), ("cavitation_number", 1.0), ("thrust", [1])],
    )
    def test_refuses_what_the_loader_refuses(self, starter, key, wrong):
        tables = tomllib.loads((starter / CASE).read_text())
        tables["condition"][key] = wrong
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(tables, strict_json(run("schema", "case").out))

    def test_stations_may_be_a_table_with_mass_states(self, starter):
        tables = tomllib.loads((starter / CASE).read_text())
        two = [1.0, "2"]
        names = ("x", "bending_stiffness", "axial_stiffness", "radius", "mass_per_length:full")
        tables["vehicle"]["stations"] = dict.fromkeys(names, two)
        schema = strict_json(run("schema", "case").out)
        jsonschema.validate(tables, schema)
        tables["vehicle"]["stations"]["colour"] = two
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(tables, schema)


def described(schema, entry):
    """Return the description of a key, or of the table that it refers to."""
    if "description" in entry:
        return entry["description"]
    return schema["$defs"][entry["$ref"].rpartition("/")[2]]["description"]


def table(path):
    """Return the rows of a CSV file."""
    return list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))


class TestFiles:
    def test_csv(self, starter):
        ended = run("modes", CASE, "-o", "modes.csv", "--modes", "2")
        assert ended.err == "wrote modes.csv\n"
        rows = table(starter / "modes.csv")
        assert [r["name"] for r in rows if r["number"] != "0"] == [
            "bending 1",
            "bending 2",
            "longitudinal 1",
            "longitudinal 2",
        ]
        assert float(rows[2]["frequency_hz [Hz]"]) == pytest.approx(3.2192, abs=1e-3)
        assert rows[0]["frequency_hz [Hz]"] == ""

    def test_json_is_what_json_prints(self, starter):
        printed = run("modes", CASE, "--json", "-o", "modes.json")
        assert (starter / "modes.json").read_text() == printed.out
        assert printed.err == "wrote modes.json\n"

    def test_netcdf(self, starter):
        import xarray

        run("modes", CASE, "-o", "modes.nc", "--modes", "2")
        with xarray.open_dataset(starter / "modes.nc", engine="h5netcdf") as data:
            assert data["frequency_hz"].attrs["units"] == "Hz"
            assert data["M"].attrs["units"] == "N m"
            assert data.sizes["mode"] == 7
            assert float(data["frequency_hz"].sel(mode="bending 1")) == pytest.approx(3.2192, 1e-4)
            assert float(abs(data["Y"].sel(mode="bending 1")).max()) == pytest.approx(1)

    def test_loads(self, starter):
        import xarray

        for ending in ("csv", "json", "nc"):
            assert run("loads", CASE, "-o", f"loads.{ending}").code == 0
        rows = table(starter / "loads.csv")
        assert float(rows[-1]["N [N]"]) == pytest.approx(50e3)
        assert strict_json((starter / "loads.json").read_text())["thrust_N"] == 50e3
        with xarray.open_dataset(starter / "loads.nc", engine="h5netcdf") as data:
            assert data["N"].attrs["units"] == "N"
            assert float(data["N"][-1]) == pytest.approx(50e3)

    @pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
    def test_plot(self, mast, ending):
        assert run("beam", "beam.toml", "--plot", f"x.{ending}").code == 0
        start = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[ending]
        assert (mast / f"x.{ending}").read_bytes().startswith(start)

    def test_a_result_is_replaced_and_nothing_else_is_left(self, mast):
        (mast / "x.json").write_text("old")
        before = set(contents(mast))
        assert run("beam", "beam.toml", "-o", "x.json").code == 0
        assert set(contents(mast)) == before
        assert strict_json((mast / "x.json").read_text())["name"] == "mast"

    def test_a_folder_without_permission(self, mast):
        folder = mast / "locked"
        folder.mkdir(mode=0o500)
        if os.geteuid() == 0:  # root may write everywhere but where the system itself refuses
            folder = Path("/proc")
        refused(run("beam", "beam.toml", "-o", folder / "x.csv"), "x.csv", "cannot be written")


@pytest.mark.parametrize(
    ("module", "option", "pip"),
    [
        ("matplotlib", ["--plot", "x.png"], "pip install 'antinode[plot]'"),
        ("xarray", ["-o", "x.nc"], "pip install 'antinode[dataset]'"),
        ("h5netcdf", ["-o", "x.nc"], "pip install 'antinode[dataset]'"),
    ],
)
def test_a_missing_extra(mast, monkeypatch, module, option, pip):
    monkeypatch.setitem(sys.modules, module, None)
    before = contents(mast)
    refused(run("beam", "beam.toml", *option), module, pip)
    assert contents(mast) == before
    assert run("beam", "beam.toml", "-o", "x.csv").code == 0


class TestFailures:
    def broken(self, monkeypatch, error):
        def fail(*_):
            raise error

        monkeypatch.setattr(beam, "solve", fail)

    def test_a_bug_is_one_sentence(self, mast, monkeypatch):
        self.broken(monkeypatch, RuntimeError("on a\nsecond line"))
        ended = run("beam", "beam.toml")
        assert (ended.code, ended.out, ended.err.count("\n")) == (1, "", 1)
        for word in ("RuntimeError: on a second line", "bug in antinode", "ANTINODE_DEBUG=1"):
            assert word in ended.err

    def test_its_traceback_is_there_on_request(self, mast, monkeypatch):
        self.broken(monkeypatch, RuntimeError("why"))
        monkeypatch.setenv("ANTINODE_DEBUG", "1")
        with pytest.raises(RuntimeError, match="why"):
            run("beam", "beam.toml")

    def test_a_failed_computation(self, mast, monkeypatch):
        self.broken(monkeypatch, ComputationError("the eigenvalues could not be certified"))
        refused(run("beam", "beam.toml"), "could not be certified", code=1)

    def test_no_memory(self, mast, monkeypatch):
        self.broken(monkeypatch, MemoryError())
        refused(run("beam", "beam.toml"), "not enough memory", code=1)

    def test_interrupted(self, mast, monkeypatch):
        self.broken(monkeypatch, KeyboardInterrupt())
        assert run("beam", "beam.toml") == (130, "", "antinode: interrupted\n")

    def test_loads_beyond_numbers(self, starter):
        for setting in ("condition.speed=1e300", "water.density=1e305"):
            for command in ("modes", "loads"):
                ended = run(command, CASE, "--set", setting)
                refused(ended, CASE, "too large or too small", code=1)

    def test_numpy_does_not_chatter(self, mast, monkeypatch):
        solve = beam.solve

        def noisy(*arguments):
            warnings.warn("overflow encountered", RuntimeWarning, stacklevel=1)
            return solve(*arguments)

        monkeypatch.setattr(beam, "solve", noisy)
        assert run("beam", "beam.toml")[::2] == (0, "")


class TestTerminal:
    @pytest.mark.parametrize("width", [120, 104, 80, 60, 40])
    @pytest.mark.parametrize("command", ["modes", "loads"])
    def test_tables_stay_within_the_width(self, starter, monkeypatch, width, command):
        monkeypatch.setenv("COLUMNS", str(width))
        lines = run(command, CASE).out.splitlines()
        assert max(map(len, lines)) <= max(width, 60)
        assert [line for line in lines if "bending 1" in line or "cavitator " in line]

    def test_eighty_columns_hold_all_columns_on_one_line(self, starter, monkeypatch):
        monkeypatch.setenv("COLUMNS", "80")
        lines = run("modes", CASE).out.splitlines()
        for words in (
            "mode kind f [Hz] +- [Hz] by N by shear",
            "rigid translation rigid 0 exact",
            "rigid axial translation rigid 0 exact",
        ):
            assert words in [" ".join(line.split()) for line in lines]
        assert any(line.split()[:3] == ["rigid", "rotation", "divergent"] for line in lines)

    def test_warnings_of_loads_come_first_and_what_is_left_out_last(self, starter):
        out = run("modes", CASE, "--set", "condition.cavitation_number=0.025").out
        places = [
            out.index(words) for words in ("cavity closes", "omega^2 < 0", "Not in the model")
        ]
        assert places == sorted(places)

    def test_the_scan_shows_no_error_and_no_shift(self, mast):
        out = run("beam", "beam.toml", "--method", "tmm", "--modes", "1").out
        row = next(line.split() for line in out.splitlines() if "bending 1" in line)
        assert row == ["bending", "1", "elastic", "1.747433", "-0.275", "%"]
        assert "no error bound" in out

    def test_a_beam_says_what_is_attached(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)
        run("init", "--example", "tower")
        one = "beam.point_masses=[{x=%s, mass=1}]"
        many = "beam.point_masses=[" + ", ".join(f"{{x={k}, mass=1}}" for k in range(5)) + "]"
        texts = [run("beam", "beam.toml", "--set", text).out for text in (one % 40, many)]
        lines = [line for text in texts for line in text.splitlines() if "attached" in line]
        assert lines == ["attached: point mass at 40 m", "attached: 5 point masses"]
        assert ", 2 intervals (" in run("beam", "beam.toml", "--set", one % 40).out
        assert ", 1 interval (" in run("beam", "beam.toml").out

    def test_headings_keep_their_units(self, starter):
        text = " ".join(run("loads", CASE).out.split())
        assert "force x [m] drag, aft [N] lift, up [N]" in text
        assert "x [m] N [kN] Q [kN] M [kN m]" in text

    @pytest.mark.parametrize(
        "name", ["[red]x[/red] [/]", "é \\u001b[31m", "n" * 150, "", "[bold", "a\\nb"]
    )
    def test_any_name_is_printed_as_plain_text(self, mast, name):
        ended = run("beam", "beam.toml", "--set", f'beam.name="{name}"')
        assert (ended.code, ended.err) == (0, "")
        assert "\x1b" not in ended.out
        assert ended.out.splitlines()[0].startswith(name[:50].replace("\\u001b", "").split("\\")[0])

    @pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
    def test_any_encoding(self, mast, encoding):
        environment = {**os.environ, "PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"}
        command = python("beam", "beam.toml", "--set", "beam.name=é─ж")
        done = subprocess.run(command, capture_output=True, env=environment, check=False)
        assert (done.returncode, done.stderr) == (0, b"")
        assert b"bending 1" in done.stdout

    def test_a_reader_that_goes_away(self, mast):
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        with subprocess.Popen(python("schema", "case"), **pipes) as process:
            process.stdout.close()
            assert process.stderr.read() == ""
        assert process.returncode == 0

    def test_a_full_disk(self, mast):
        if not os.path.exists("/dev/full"):
            pytest.skip("there is no /dev/full here")
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                python("schema", "case"),
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
                check=False,
            )
        assert done.returncode == 1
        assert done.stderr.startswith("antinode: ")
        assert done.stderr.count("\n") == 1


class TestHelp:
    def test_names_every_command(self):
        text = run("--help").out
        for command in ("init", "modes", "loads", "beam", "schema", "verify"):
            assert f" {command} " in text
        assert "antinode init" in text
        assert '"10 deg"' in text

    @pytest.mark.parametrize("command", ["init", "modes", "loads", "beam", "schema", "verify"])
    def test_every_command_has_an_example_that_names_it(self, command):
        ended = run(command, "--help")
        assert ended.code == 0
        assert f"Example: antinode {command}" in " ".join(ended.out.split())
        assert max(map(len, ended.out.splitlines())) <= 80

    def test_version(self):
        from antinode import __version__

        assert run("--version").out.strip() == __version__
