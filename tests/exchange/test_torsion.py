"""Torsion through the formats: what is written is read again, or is said to be left out."""

import numpy as np
import pytest
from pyNastran.bdf.bdf import read_bdf

from antinode import InputError, load_beam, solve_modes
from antinode.cli.run import main
from exchange.deck_solver import Deck
from exchange.solvers import expected, needs_mystran, run_mystran, worst

SHAFT = """\
[beam]
name = "shaft"
interpolation = "{how}"
[beam.stations]
x = [0, 2, 5]
mass_per_length = [100, 80, 60]
bending_stiffness = ["1 MN m^2", "0.8 MN m^2", "0.8 MN m^2"]
axial_stiffness = ["1 GN", "0.9 GN", "0.9 GN"]
torsional_stiffness = ["0.7 MN m^2", "0.6 MN m^2", "0.5 MN m^2"]
polar_inertia_per_length = ["0.25 kg m", "20 g m", 0.2]
[beam.ends]
left = "pinned"
right_torsion = "fixed"
[[beam.point_masses]]
x = 1
mass = 20
polar_inertia = "3 kg m^2"
[[beam.springs]]
x = 3
torsional = "10 kN m/rad"
[[beam.joints]]
x = 2
torsional = 1e-6
"""


def hertz(path):
    return solve_modes(load_beam(path).beam(), 4).frequencies_hz("torsion")


@pytest.fixture(params=["step", "linear", "log"])
def shaft(request, tmp_path):
    path = tmp_path / "shaft.toml"
    path.write_text(SHAFT.format(how=request.param))
    return path


def convert(source, target, *options):
    with pytest.raises(SystemExit) as ended:
        main(["convert", str(source), str(target), *options])
    assert ended.value.code == 0


@pytest.mark.parametrize("ending", ["toml", "xlsx"])
def test_a_beam_is_read_again(shaft, ending, tmp_path):
    convert(shaft, target := tmp_path / f"again.{ending}")
    assert hertz(target) == pytest.approx(hertz(shaft), rel=1e-12)


def test_a_table_keeps_its_columns(shaft, tmp_path):
    convert(shaft, target := tmp_path / "again.csv")
    before, after = load_beam(shaft).beam(), load_beam(target).beam()
    k, t = np.repeat([0, 1], 2), np.tile([0.1, 0.9], 2)
    for name in ("torsional_stiffness", "polar_inertia_per_length"):
        x = before.x[k] + np.diff(before.x)[k] * t
        old = np.searchsorted(after.x, x) - 1
        again = after.column_at(name, old, (x - after.x[old]) / np.diff(after.x)[old])
        assert again == pytest.approx(before.column_at(name, k, t), rel=1e-12)


def test_measured_torsion_modes_of_a_universal_file(shaft, tmp_path):
    convert(shaft, modes := tmp_path / "modes.uff", "--modes", "3")
    convert(modes, rows := tmp_path / "rows.csv")
    header, values = rows.read_text().splitlines()
    table = dict(zip(header.split(","), values.split(","), strict=True))
    found = [float(table[f"torsion:{k} [Hz]"]) for k in (1, 2, 3)]
    assert found == pytest.approx(hertz(shaft)[:3], rel=2e-6)


@pytest.mark.parametrize("units", ["SI", "mm-t-s", "in-lbf-s"])
def test_a_deck_there_and_back(shaft, units, tmp_path):
    convert(shaft, deck := tmp_path / "deck.bdf", "--units", units)
    convert(deck, target := tmp_path / "again.toml", "--units", units)
    before, after = load_beam(shaft).beam(), load_beam(target).beam()
    assert after.ends.of("torsion") == before.ends.of("torsion")
    assert sum(getattr(item, "polar_inertia", 0) for item in after.attachments) == pytest.approx(3)
    assert polar_inertia(after) == pytest.approx(polar_inertia(before), rel=1e-6)
    assert hertz(target) == pytest.approx(hertz(shaft), rel=2e-4)


def polar_inertia(beam):
    """Of the shaft itself [kg m^2]."""
    t = np.arange(0.005, 1, 0.01)
    rows = [beam.column_at("polar_inertia_per_length", k, t) for k in range(len(beam.x) - 1)]
    return np.sum(np.mean(rows, axis=1) * np.diff(beam.x))


def test_another_reader_finds_torsion_in_a_deck(shaft, tmp_path):
    convert(shaft, deck := tmp_path / "deck.bdf", "--modes", "3")
    model = read_bdf(str(deck), debug=None)
    beam = load_beam(shaft).beam()
    bars = [model.elements[k] for k in sorted(model.elements) if model.elements[k].type == "CBAR"]
    assert bars[0].G() * bars[0].J() == pytest.approx(beam.torsional_stiffness[0, 0], rel=2e-3)
    assert bars[-1].G() * bars[-1].J() == pytest.approx(beam.torsional_stiffness[-1, 1], rel=2e-3)
    rows = [row for row in expected(deck) if row[0].startswith("torsion")]
    assert len(rows) == 3
    assert worst(Deck(deck).modes(1)[2], rows) < 2e-6
    assert np.sqrt([beam for _, _, beam in rows]) / (2 * np.pi) == pytest.approx(hertz(shaft)[:3])


@needs_mystran
def test_mystran_finds_torsion(shaft, tmp_path):
    convert(shaft, deck := tmp_path / "deck.bdf", "--modes", "2")
    assert worst(run_mystran(deck), expected(deck)) < 2e-6


@pytest.mark.parametrize("options", [("deck.inp",), ("deck.bdf", "--analysis", "statsub")])
def test_a_deck_says_that_it_leaves_torsion_out(shaft, options, tmp_path, capsys):
    text = shaft.read_text().replace("[beam.ends]", "axial_force = [9, 9, 9]\n[beam.ends]")
    shaft.write_text(text)
    convert(shaft, deck := tmp_path / options[0], *options[1:])
    assert "torsion is left out" in capsys.readouterr().err + deck.read_text()
    assert " bending 1" in deck.read_text()
    assert " torsion 1" not in deck.read_text()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("polar_inertia_per_length", "#", "polar_inertia_per_length is missing: give both"),
        ("torsional_stiffness", "#", "torsional_stiffness is missing: give both"),
        ('"20 g m"', "-1", "polar_inertia_per_length, row 2, is -1; it must be greater than 0"),
        ('"20 g m"', '"20 kg"', "20 kg"),
        ('"fixed"', '"clamped"', "right_torsion"),
    ],
)
def test_what_a_file_may_not_say(tmp_path, old, new, message):
    path = tmp_path / "wrong.toml"
    path.write_text(SHAFT.format(how="linear").replace(old, new, 1))
    with pytest.raises(InputError, match=message.replace("(", r"\(")) as caught:
        load_beam(path)
    assert "\n" not in str(caught.value)


BLADE = """\
--- a tower of two sections ---
2 n_secs: number of sections
sec_loc str_tw tw_iner mass_den flp_iner edge_iner flp_stff edge_stff tor_stff axial_stff
(-) (deg) (deg) (kg/m) (kg-m) (kg-m) (Nm^2) (Nm^2) (Nm^2) (N)
0.0 0 0 500 {inertia} 900 6e9 6e9 4e9 2e10
1.0 0 0 300 300 400 2e9 2e9 1e9 1e10
"""


@pytest.mark.parametrize(("inertia", "families"), [(700, 3), (0, 2)])
def test_sections_with_torsional_stiffness_and_both_inertias(tmp_path, inertia, families):
    path, target = tmp_path / "tower.dat", tmp_path / "tower.toml"
    path.write_text(BLADE.format(inertia=inertia))
    convert(path, target, "--length", "10m")
    beam = load_beam(target).beam()
    assert len(beam.families) == families
    if families == 3:
        assert beam.polar_inertia_per_length == pytest.approx(np.array([[1600.0, 700.0]]))
        assert beam.torsional_stiffness == pytest.approx(np.array([[4e9, 1e9]]))
