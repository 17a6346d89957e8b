"""What once was silent says so: options and inputs without effect, numbers cut off."""

import errno
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from antinode.modes.solve import solve_modes
from antinode.show import printing
from antinode.study.design.points import points_of
from antinode.study.identify.fit import Search
from antinode.vehicle.case import load_case
from cli_run import python, refused, run
from study_text import study

SPEEDS = 'inputs = [{ key = "speed", values = [60, 80] }]\nsolve.modes = 1\n'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run("init", ".")
    run("init", "--beam", ".")
    (tmp_path / "study.toml").write_text('case = "case.toml"\n' + SPEEDS)
    return tmp_path


@pytest.mark.parametrize(
    ("options", "name"),
    [
        (("--length", "3m"), "--length"),
        (("--elements", "1:3"), "--elements"),
        (("--plane", "2"), "--plane"),
        (("--analysis", "buckling"), "--analysis"),
        (("--modes", "3"), "--modes"),
        (("--units", "mm-t-s"), "--units"),
    ],
)
def test_options_of_convert_without_effect_are_told(folder, options, name):
    ended = run("convert", "beam.toml", "b.xlsx", *options)
    assert ended.code == 0
    assert f"note: {name} has no effect here" in ended.err


def test_options_with_effect_are_not(folder):
    for target, options in (("b.bdf", ("--units", "mm-t-s", "--analysis", "buckling")),
                            ("b.uff", ("--modes", "2"))):  # fmt: skip
        assert "no effect" not in run("convert", "beam.toml", target, *options).err
    ended = run("convert", "beam.toml", "b.uff", "--units", "mm-t-s")
    assert "--units has no effect" in ended.err


def test_a_sweep_makes_no_folder_with_the_ending_of_a_file(folder):
    for name in ("s.xlsx", "s.json", "s.mat", "case.txt"):
        refused(run("sweep", "study.toml", "-o", name), ".nc, .csv", ".zarr")
        assert not (folder / name).exists()


def test_a_curve_of_the_axial_force_comes_with_its_error(folder):
    text = (folder / "beam.toml").read_text()
    taper = text.replace('"step"', '"linear"')
    assert taper != text
    (folder / "t.toml").write_text(taper)
    note = run("convert", "t.toml", "t.csv", "--set", "beam.loads.gravity=-9.81").err
    off, share = re.search(r"up to (\S+) N off, (\S+) of the largest", note).groups()
    assert 0 < float(share) < 1e-3
    assert float(off) > 0


@pytest.mark.parametrize(("EI", "digits"), [(1e-12, 6), (1.0, 4)])
def test_frequencies_near_zero_keep_their_digits(folder, EI, digits):
    """0.000000 +- 4e-18 says less than is known."""
    (folder / "soft.toml").write_text(
        "beam.stations = { x = [0, 10], mass_per_length = [9, 9], bending_stiffness = "
        f"[{EI}, {EI}] }}\nbeam.ends.left = 'clamped'"
    )
    ended = run("beam", "soft.toml", "--modes", "1")
    row = next(line.split() for line in ended.out.splitlines() if "bending 1" in line)
    true = 3.5160152685 / (2 * np.pi * 100) * np.sqrt(EI / 9)
    assert float(row[3]) == pytest.approx(true, rel=10.0 ** (1 - digits))


def test_a_zero_with_an_error_is_not_exact(folder):
    """A spring of 1e-12 N m/rad gives 1.7e-9 Hz; only 0 +- 5e-9 Hz is known of it."""
    (folder / "held.toml").write_text(
        "beam.stations = { x = [0, 10], mass_per_length = [100, 100], bending_stiffness = [1e7, "
        "1e7] }\n[[beam.springs]]\nx = 0\nrotational = 1e-12"
    )
    rows = run("beam", "held.toml", "--modes", "1").out.splitlines()
    rigid, held = (next(r.split() for r in rows if n in r) for n in ("rigid tr", "bending 1"))
    assert rigid[3:5] == ["0", "exact"]
    assert held[3] == "0"
    assert float(held[4]) >= 1.7434550e-9


BECK = """
[beam]
ends = { left = "clamped", right_follower = 1.0 }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [1, 1]
"""


@pytest.mark.parametrize("width", [10, 40, 60])
@pytest.mark.parametrize(
    "line",
    [
        "sweep study.toml",
        "verify",
        "sensitivity case.toml --uncertain thrust=9% --samples 8",
        "modes case.toml",
        "loads case.toml",
        "beam beam.toml --buckling",
        "stability beck.toml",
        "ask study.toml --smallest f1 --quantiles f1 --where speed>9 --share f1>3",
        "response equipment/response.toml",
    ],
)
def test_no_table_cuts_its_numbers(folder, monkeypatch, width, line):
    run("init", "--example", "response", "equipment")
    Path("beck.toml").write_text(BECK)
    monkeypatch.setenv("COLUMNS", str(width))
    ended = run(*line.split())
    assert ended.code == 0
    assert "\u2026" not in ended.out
    assert max(map(len, ended.out.splitlines())) <= 60
    for name in ("acceleration", "gyro", "battery") if "response" in line else ():
        assert name in ended.out.partition("rms")[2]  # the names of rows are left to none


@pytest.mark.parametrize("closed", ["stdout", "stderr"])
def test_a_closed_stream_is_no_bug(folder, closed):
    """A service starts programs so (`>&-`): they have nobody to talk to."""
    arguments = python("modes", "case.toml", "--modes", "1" if closed == "stdout" else "x")
    number = {"stdout": 1, "stderr": 2}[closed]
    script = f"import os, sys; os.close({number}); os.execv(sys.argv[1], sys.argv[1:])"
    ended = subprocess.run(
        [sys.executable, "-c", script, *arguments], capture_output=True, text=True, check=False
    )
    assert ended.returncode == (0 if closed == "stdout" else 2)
    assert "bug" not in ended.stdout + ended.stderr


def test_fins_are_named_where_there_are_any(folder):
    case = load_case("case.toml")
    assert "fins at 5 m" in printing._condition_text(case)
    bare = case.model_copy(update={"vehicle": case.vehicle.model_copy(update={"fins": ()})})
    assert "fins" not in printing._condition_text(bare)


def test_a_full_disk_is_no_bug(folder, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device", "b.toml")

    monkeypatch.setattr("antinode.examples.write_example", full)
    monkeypatch.setattr("antinode.cli.modal.solve", full)
    monkeypatch.setattr("antinode.cli.commands.beam.solve", full)
    refused(run("beam", "beam.toml"), "'b.toml'", "No space left on device", "make room", code=1)


def test_an_interruption_before_anything_is_found(folder, monkeypatch):
    (folder / "o.csv").write_text("cavitator_angle [deg], bending:1 [Hz]\n10, 3.2\n12, 3.25\n")
    (folder / "i.toml").write_text(
        'case = "case.toml"\nobservations = "o.csv"\n[[parameters]]\nkey = "thrust"\n'
    )

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Search, "residuals", interrupt)
    refused_by = run("identify", "i.toml")
    assert refused_by.code == 130
    assert refused_by.err.endswith("antinode: interrupted\n")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('inputs = [{ key = "depth", values = [1, 2] }]', "cavitation_number"),
        ('inputs = [{ key = "water.vapour_pressure", values = [1, 2] }]', "cavitation_number"),
        ('inputs = [{ key = "extra_drag_position", values = [1, 2] }]', "no extra_drag"),
        ('inputs = [{ key = "speed", values = [60] }]\nsolve.families = ["torsion"]',
         "polar_inertia_per_length"),
        ('inputs = [{ key = "speed", distribution = "normal", sd = 2 }]', "kind = 'sobol'"),
        ('design.kind = "zip"\ninputs = [{ key = "time", values = [0, 2, 1] }, '
         '{ key = "speed", values = [60, 70, 80] }]', "sort the rows by time"),
        ('inputs = [{ key = "condition.burn_fraction", factor = true, values = [1, 2] }]',
         "the case has 0 there"),
        ('inputs = [{ key = "EI", values = [1, 2] }]', "did you mean bending_stiffness?"),
    ],
)  # fmt: skip
def test_inputs_of_studies_that_change_nothing(folder, text, words):
    (folder / "s.toml").write_text('case = "case.toml"\n' + text)
    refused(run("sweep", "s.toml"), words)


def test_what_an_input_changes_is_let_through(folder):
    case = load_case("case.toml")
    deep = ["condition.depth=90 m", "condition.speed=60"]
    text = (folder / "case.toml").read_text()
    assert "cavitation_number = " in text
    (folder / "deep.toml").write_text(
        "\n".join(line for line in text.splitlines() if not line.startswith("cavitation_number"))
    )
    points_of(
        study(load_case("deep.toml", deep), 'inputs = [{ key = "depth", values = [80, 90] }]')
    )
    points_of(study(case, 'inputs = [{ key = "burn_fraction", values = [0, 1] }]'))
    points_of(study(case, 'inputs = [{ key = "fin_position", values = [4, 5] }]'))


def test_a_figure_of_no_input_is_refused_before_the_work(folder):
    (folder / "s.toml").write_text('case = "case.toml"\nfigure.x = "spd"\n' + SPEEDS)
    ended = run("sweep", "s.toml", "--plot", "p.png")
    refused(ended, "did you mean speed?")
    assert "cases" not in ended.err


def test_a_depth_beside_the_cavitation_number_is_told(folder):
    told = load_case("case.toml", ["condition.depth=10 m"]).loads.warnings
    assert any("the depth changes nothing" in text for text in told)
    case = load_case("case.toml")
    assert not any("depth" in text for text in case.loads.warnings)
    assert solve_modes(case, 1).mode("bending", 1).omega2 > 0


def test_water_in_another_unit_is_doubted(folder):
    told = load_case("case.toml", ["water.density=1"]).loads.warnings
    assert any("water.density [kg/m^3]" in text for text in told)
    assert not any(
        "water" in t for t in load_case("case.toml", ["water.density=1025"]).loads.warnings
    )
