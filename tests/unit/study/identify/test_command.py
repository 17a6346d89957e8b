"""`antinode identify`: runs, outputs, and one clear sentence for what is wrong."""

import json
import os
import signal
import subprocess
import time
import tomllib

import jsonschema
import pytest

import antinode as an
from cli_run import contents, python, refused, replaced, run

FILE = """
case = "case.toml"
observations = "observations.csv"

[fit]
relative_sd = 1e-4

[[parameters]]
key = "thrust"
lower = "20 kN"
upper = "90 kN"
start = "45 kN"

[[parameters]]
key = "vehicle.cavitator.diameter"
name = "cavitator"
prior = { sd = "2 mm" }
"""
TABLE = """# frequencies of the starter vehicle
name, cavitator_angle [deg], mass_state, bending:1 [Hz], bending:2 [Hz], bending:3 [Hz]
level, 10, , 3.219179, 10.247941, 19.777385
steep, 15, burnt, 3.592436, , 23.5
"""


@pytest.fixture
def folder(tmp_path):
    assert run("init", tmp_path).code == 0
    path = tmp_path / "case.toml"
    path.write_text(path.read_text().replace('"follows_body"', '"fixed_direction"'))
    (tmp_path / "identify.toml").write_text(FILE)
    (tmp_path / "observations.csv").write_text(TABLE)
    return tmp_path


def test_a_run_prints_tables_and_writes_a_runnable_case(folder):
    ended = run("identify", folder / "identify.toml", "-o", folder / "out")
    assert ended.code == 0, ended
    for word in ("5 frequencies in 2 rows", "cavitator", "level", "steep", "the data determine"):
        assert word in ended.out
    assert "evaluation 1" in ended.err
    assert "wrote" in ended.err
    fitted = an.load_case(folder / "out" / "case.toml")
    assert fitted.vehicle.cavitator.diameter != 0.08
    assert run("modes", folder / "out" / "case.toml").code == 0
    names = {"case.toml", "stations.csv", "observed_and_fitted.csv", "parameters.csv"}
    assert names | {"identification.json"} == set(contents(folder / "out"))
    before = contents(folder)
    refused(run("identify", folder / "identify.toml", "-o", folder / "out"), "exists already")
    assert contents(folder) == before
    assert run("identify", folder / "identify.toml", "-o", folder / "out", "--overwrite").code == 0


def test_json_holds_everything(folder):
    ended = run("identify", folder / "identify.toml", "--json", "--set", "fit.starts=2")
    data = json.loads(ended.out)
    assert data["schema_version"] == 1
    assert [p["name"] for p in data["parameters"]] == ["thrust", "cavitator"]
    assert [(r["row"], r["number"]) for r in data["rows"]] == [
        (1, 1),
        (1, 2),
        (1, 3),
        (2, 1),
        (2, 3),
    ]
    assert len(data["starts"]) == 2
    assert len(data["correlation"]) == 2
    assert data["parameters"][0]["interval_95"][0] < data["parameters"][0]["value"]


def test_an_interrupt_gives_the_best_so_far(folder):
    """The child takes SIGINT even where these tests run in a shell's background, ignoring it."""
    (folder / "identify.toml").write_text(FILE.replace("[fit]", "[fit]\nstarts = 1000"))
    command = python("identify", folder / "identify.toml", "--json", "-o", folder / "out")
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        for line in process.stderr:
            if line.startswith("start "):
                break
        time.sleep(0.5)
        os.kill(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=300)
    assert process.returncode == 130, err
    data = json.loads(out)
    assert data["interrupted"]
    assert "interrupted" in err
    assert "Traceback" not in err
    assert (folder / "out" / "case.toml").exists()
    assert "best values so far" in (folder / "out" / "case.toml").read_text()


IN_FILE = {
    "unknown key": ("[fit]", "[fit]\nstrats = 3", ["fit.strats", "starts"]),
    "unknown table": ("[fit]", "[fits]", ["unknown key fits", "fit"]),
    "no case": ('case = "case.toml"\n', "", ["case is missing"]),
    "case gone": ("case.toml", "cse.toml", ["no such file", "case.toml"]),
    "table gone": ("observations.csv", "observation.csv", ["no such file", "observations.csv"]),
    "no rows": ('"observations.csv"', "[]", ["observations", "one row"]),
    "a row's frequency": ('"observations.csv"', "[{ bending = [3] }, { bending = [3, -10] }]",
                          ["identify.toml: observations, row 2: bending 2 is -10"]),
    "a row's key": ('"observations.csv"', "[{ bending = [3] }, { speeed = 3 }]",
                    ["observations, row 2: unknown key speeed", "speed"]),
    "no table": ('"observations.csv"', "[3]", ["observations, row 1: this is 3", "a table"]),
    "path leads nowhere": ("vehicle.cavitator.diameter", "vehicle.cavitator.diametre",
                           ["'vehicle.cavitator.diametre'", "did you mean diameter"]),
    "path to a choice": ("vehicle.cavitator.diameter", "model.planing", ["choice", "number"]),
    "path to a table": ("vehicle.cavitator.diameter", "vehicle.cavitator", ["a table", "number"]),
    "path to positions": ("vehicle.cavitator.diameter", "vehicle.stations.x.3", ["positions"]),
    "path to a missing fin": ("vehicle.cavitator.diameter", "fins.3.thickness", ["index from 0"]),
    "bounds exclude the start": ('start = "45 kN"', 'start = "95 kN"', ["95000", "exclude"]),
    "bounds the wrong way": ('upper = "90 kN"', 'upper = "10 kN"', ["lower must be below upper"]),
    "bounds beyond the case": ('lower = "20 kN"', 'lower = "-20 kN"', ["allows 0"]),
    "unit": ('"90 kN"', '"90 km"', ["upper", "90 km"]),
    "prior without sd": ('{ sd = "2 mm" }', '{ mean = "80 mm" }', ["prior.sd is missing"]),
    "prior of no width": ('{ sd = "2 mm" }', "{ sd = 0 }", ["prior.sd", "above 0"]),
    "twice": (
        "[fit]", '[[parameters]]\nkey = "condition.thrust"\n[fit]', ["thrust", "two entries"],
    ),
    "row sets it": ('"vehicle.cavitator.diameter"', '"cavitator_angle"', ["per_row = true"]),
    "no value": ('"vehicle.cavitator.diameter"', '"extra_drag"', ["no value", "start"]),
    "log of zero": (
        'lower = "20 kN"', 'scale = "log"\nlower = 0\nprior = { mean = 0, sd = 1 }', ["above 0"],
    ),
}  # fmt: skip
IN_TABLE = {
    "unknown column": ("mass_state", "mas_state", ["mas_state", "mass_state"]),
    "unknown family": ("bending:2", "twist:2", ["twist:2", "bending:1"]),
    "mode 0": ("bending:2", "bending:0", ["bending:0", "from 1"]),
    "mode without a number": ("bending:2", "bending:two", ["bending:two", "from 1"]),
    "column twice": ("bending:2", "bending:1", ["bending:1", "twice"]),
    "unit": ("bending:1 [Hz]", "bending:1 [kg]", ["Hz"]),
    "negative": ("23.5", "-3.2", ["observations.csv, row 2: bending 3 is", "greater than 0"]),
    "text": ("3.219179", "about 3", ["about 3"]),
    "infinite": ("3.219179", "inf", ["finite"]),
    "cells": ("19.777385", "19.777385, 5", ["7 cells", "6 in the header"]),
    "unknown state": ("burnt", "burned", ["burned", "burnt"]),
    "repeated": ("steep, 15, burnt, 3.592436, ", "steep, 10, , 3.592436, ", ["row 2", "row 1"]),
    "empty row": ("3.592436, , 23.5", ", ,", ["row 2", "no frequency"]),
    "angle": ("steep, 15", "steep, 75", ["row 2: cavitator_angle", "75 deg", "60 deg"]),
}


@pytest.mark.parametrize("what", IN_FILE)
def test_what_is_wrong_in_the_file(folder, what):
    old, new, words = IN_FILE[what]
    replaced(folder / "identify.toml", old, new)
    before = contents(folder)
    refused(run("identify", folder / "identify.toml", "-o", folder / "out"), *words)
    assert contents(folder) == before


@pytest.mark.parametrize("what", IN_TABLE)
def test_what_is_wrong_in_the_table(folder, what):
    old, new, words = IN_TABLE[what]
    replaced(folder / "observations.csv", old, new)
    refused(run("identify", folder / "identify.toml"), *words)


DISTRIBUTIONS = {
    "more parameters than data": ('column = "bending_stiffness"\nsegments = true', ["frequencies"]),
    "unknown column": ('column = "bending"\nsegments = true', ["'bending'", "bending_stiffness"]),
    "neither": ('column = "bending_stiffness"', ["one of the two"]),
    "bounds": (
        'column = "bending_stiffness"\nsegments = true\nlower = 1.1\nprior_sd = 0.1', ["exclude"],
    ),
    "off the body": (
        'column = "radius"\ncontrol_points = [1, 9]\nprior_sd = 0.1', ["on the body"],
    ),
    "unsorted": ('column = "radius"\ncontrol_points = [3, 1]', ["increase"]),
    "relative to itself": (
        'column = "radius"\ncontrol_points = 1\nrelative_to = "radius"', ["itself"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", DISTRIBUTIONS)
def test_what_is_wrong_in_a_distribution(folder, what):
    text, words = DISTRIBUTIONS[what]
    path = folder / "identify.toml"
    path.write_text(f"{path.read_text()}\n[[distributions]]\n{text}\n")
    refused(run("identify", path), *words)


def test_other_files_and_folders_are_told_apart(folder):
    refused(run("identify", folder / "case.toml"), "this is a case file")
    refused(run("identify", folder / "none.toml"), "no such file")
    refused(run("identify", folder / "identify.toml", "-o", folder / "case.toml"), "no folder")
    refused(run("identify", folder / "identify.toml", "--set", "fit.starts=many"), "fit.starts")
    (folder / "observations.csv").write_text("")
    refused(run("identify", folder / "identify.toml"), "empty")


def test_a_row_that_cannot_be_computed_is_named(folder):
    replaced(folder / "observations.csv", "name, cav", "fin_position [m], cav")
    replaced(folder / "observations.csv", "level, 10", "5.0, 10")
    replaced(folder / "observations.csv", "steep, 15", "9.0, 15")
    refused(run("identify", folder / "identify.toml"), "row 2", "9 m", "on the body")


def test_the_schema_describes_every_key_and_takes_the_file(folder):
    schema = json.loads(run("schema", "identify").out)
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(tomllib.loads(FILE), schema)
    inline = tomllib.loads(FILE) | {"observations": [{"speed": "80 m/s", "bending": [3.2]}]}
    jsonschema.validate(inline, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(inline | {"starts": 3}, schema)
    for where in [schema, *schema["$defs"].values()]:
        for name, entry in where.get("properties", {}).items():
            described = entry.get("description") or "$ref" in entry
            assert described, name
