"""Decks there and back; pyNastran reads them, and plane beam elements find what they announce."""

import re
from dataclasses import replace

import numpy as np
import pytest

from antinode import InputError, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.ends import Ends
from antinode.exchange.nastran.cards import card_text, real_text
from antinode.exchange.nastran.deck import read_deck
from antinode.exchange.nastran.reader import read_nastran
from antinode.exchange.nastran.writer import nastran_text, write_nastran
from antinode.exchange.units import MM_T_S, SI
from cli_run import refused, run
from exchange.conversions import solved, without_shear
from exchange.deck_solver import Deck
from exchange.solvers import expected, worst

NAMES = ("starter", "tower", "shaft", "everything")
BAR = """\
SOL 103
CEND
SPC = 7
METHOD = 1
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,3.,0.,0.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,1.-3,2.-6,3.-6,,0.5
MAT1,1,2.1+11,,.3,7850.
CONM2,9,3,,12.5,.1
SPC1,7,12,1,3
EIGRL,1,,,3
ENDDATA
"""


def deck(tmp_path, text):
    path = tmp_path / "deck.bdf"
    path.write_text(text)
    return path


def fields(*cells):
    """A card in fields of eight characters."""
    return f"{cells[0]:<8}" + "".join(f"{cell:>8}" for cell in cells[1:])


def families(path, subcase):
    """What a deck expects, and what plane elements find in a subcase, by family."""
    bending, longitudinal, *torsion = Deck(path).modes(subcase)
    rows = expected(path)
    along = [row for row in rows if row[0].startswith(("longitudinal", "rigid axial"))]
    about = [row for row in rows if row[0].startswith(("torsion", "rigid axial rotation"))]
    along = [row for row in along if row not in about]
    others = [row for row in rows if row not in (*along, *about)]
    return [(others, bending), (along, longitudinal), *((about, found) for found in torsion)]


ANALYSES = [(name, analysis) for name in NAMES for analysis in ("modes", "unloaded", "statsub")]
ANALYSES.remove(("shaft", "statsub"))


@pytest.mark.parametrize(("name", "analysis"), ANALYSES)
def test_finite_elements_find_the_expected_frequencies(name, analysis, tmp_path):
    path = tmp_path / "deck.bdf"
    result = without_shear(name) if name == "starter" else solved(name)
    write_nastran(path, result, SI, analysis)
    for rows, found in families(path, 2 if analysis == "statsub" else 1):
        assert worst(found, rows) < 2e-6


@pytest.mark.parametrize("name", NAMES)
def test_the_mesh_is_near_the_beam(name, tmp_path):
    path = tmp_path / "deck.bdf"
    write_nastran(path, solved(name))
    rows = expected(path)
    assert len(rows) == len(solved(name).modes)
    scale = min(abs(beam) for _, _, beam in rows if beam)
    for _, mesh, beam in rows:
        assert abs(mesh - beam) < 4e-4 * max(abs(beam), scale)


@pytest.mark.parametrize("analysis", ["statsub", "buckling"])
def test_a_deck_for_a_force_needs_one(analysis, tmp_path):
    with pytest.raises(InputError, match="under no axial force"):
        write_nastran(tmp_path / "deck.bdf", solved("shaft"), SI, analysis)


def test_a_beam_that_nothing_holds_has_no_buckling_deck(tmp_path):
    with pytest.raises(InputError, match="rigid body"):
        write_nastran(tmp_path / "deck.bdf", solved("starter"), SI, "buckling")


@pytest.mark.parametrize(("name", "analysis"), ANALYSES)
def test_a_deck_gives_the_beam_back(name, analysis, tmp_path):
    result, system = solved(name), SI if analysis == "statsub" else MM_T_S
    write_nastran(tmp_path / "deck.bdf", result, system, analysis)
    beam, notes = read_nastran(tmp_path / "deck.bdf", system)
    assert system.words in notes[0]
    in_plane = ["bending", "longitudinal"]
    again = solve_modes(beam, 3, tolerance=1e-7, families=in_plane)
    ends = replace(result.beam.ends, left_follower=0.0, right_follower=0.0)  # as a deck has them
    weight = replace(result.beam, offset_weight=False, ends=ends)
    weight = weight.without_axial_force() if analysis == "unloaded" else weight
    wanted = solve_modes(weight, 3, tolerance=1e-7, families=in_plane)
    scale = wanted.mode("bending", 1).omega2
    for a, b in zip(again.modes, wanted.modes, strict=True):
        assert abs(a.omega2 - b.omega2) < 1e-4 * max(abs(b.omega2), scale), b.name


def test_a_string_across_an_element_is_its_axial_force(tmp_path):
    text = BAR.replace("SPC1", "CELAS2,50,-1.+3,1,2,2,2\nSPC1")
    beam, _ = read_nastran(deck(tmp_path, text))
    np.testing.assert_allclose(beam.axial_force, [[1e3, 1e3], [0, 0]])
    other = BAR.replace("SPC1", "CELAS2,50,-1.+3,1,2,3,2\nSPC1")
    with pytest.raises(InputError, match="join one grid to the ground"):
        read_nastran(deck(tmp_path, other))


def test_a_grid_that_is_held_is_ground(tmp_path):
    text = BAR.replace("SPC1", "GRID,70,,1.,0.,0.,,123456\nCELAS2,50,1.+3,2,2,70,2\nSPC1")
    beam, _ = read_nastran(deck(tmp_path, text))
    assert Spring(1.0, 1e3) in beam.attachments


def test_stepped_beams_come_back_to_all_digits(tmp_path):
    result = solved("everything")
    write_nastran(tmp_path / "deck.bdf", result)
    beam, _ = read_nastran(tmp_path / "deck.bdf")
    again = solve_modes(beam, 3, tolerance=1e-7)
    for a, b in zip(again.modes, result.modes, strict=True):
        assert a.omega2 == pytest.approx(b.omega2, rel=1e-8)


def test_fields_small_large_and_free(tmp_path):
    large = BAR.replace(
        "PBAR,1,1,1.-3,2.-6,3.-6,,0.5\n",
        "PBAR*                  1               1          1.0D-3          2.0E-6*A\n"
        "*A                3.0E-6                              .5\n",
    )
    small = BAR.replace("CBAR,1,1,1,2,0.,1.,0.", fields("CBAR", 1, 1, 1, 2, "0.", "1.", "0."))
    small = small.replace("CONM2,9,3,,12.5,.1", fields("CONM2", 9, 3, "", "12.5", ".1"))
    beams = [read_nastran(deck(tmp_path, text))[0] for text in (BAR, large, small)]
    for beam in beams:
        assert beam.bending_stiffness[0, 0] == pytest.approx(2.1e11 * 2e-6)
        assert beam.mass_per_length[0, 0] == pytest.approx(7.85 + 0.5)
        assert beam.axial_stiffness[1, 1] == pytest.approx(2.1e8)
        assert beam.attachments == (PointMass(3.0, 12.5, 0.0, 0.1),)
        assert beam.ends == Ends("pinned", "pinned", "fixed", "fixed")


def test_plane_2_bends_about_the_other_axis(tmp_path):
    text = BAR.replace("SPC1,7,12,1,3", "SPC1,7,13,1,3")
    beam, _ = read_nastran(deck(tmp_path, text), plane=2)
    assert beam.bending_stiffness[0, 0] == pytest.approx(2.1e11 * 3e-6)
    assert beam.ends.left == "pinned"


def test_a_tapered_pbeam(tmp_path):
    text = BAR.replace("CBAR", "CBEAM").replace(
        "PBAR,1,1,1.-3,2.-6,3.-6,,0.5",
        "PBEAM,1,1,1.-3,2.-6,3.-6,,,0.5\n,0.,0.,0.,0.,0.,0.,0.,0.\n"
        ",YES,.5,2.-3,4.-6,3.-6\n,,,,,,,,\n,NO,1.,1.-3,2.-6,,,,.7\n,0.,0.",
    )
    beam, notes = read_nastran(deck(tmp_path, text))
    np.testing.assert_allclose(beam.x, [0, 0.5, 1, 2, 3])
    np.testing.assert_allclose(beam.bending_stiffness[0], [4.2e5, 8.4e5])
    np.testing.assert_allclose(beam.mass_per_length[1], [15.7 + 0.6, 7.85 + 0.7])
    assert beam.interpolation == "linear"
    assert not any("shear" in note for note in notes)
    sheared = text.replace("\n,0.,0.\n", "\n")
    assert any("shear" in note for note in read_nastran(deck(tmp_path, sheared))[1])


def test_a_beam_that_runs_against_an_axis_and_elements_that_run_back(tmp_path):
    text = BAR.replace("GRID,2,,1.,", "GRID,2,,-1.,").replace("GRID,3,,3.,", "GRID,3,,-3.,")
    text = text.replace("CBAR,2,1,2,3", "CBAR,2,1,3,2")
    beam, _ = read_nastran(deck(tmp_path, text))
    np.testing.assert_allclose(beam.x, [-3, -1, 0])
    assert beam.attachments[0].x == -3
    assert beam.attachments[0].offset == 0.1


def test_springs_supports_and_joints_by_their_cards(tmp_path):
    text = BAR.replace("CBAR,2,1,2,3", "GRID,4,,1.,0.,0.\nCBAR,2,1,4,3").replace(
        "EIGRL", "RBE2,50,2,12,4\nCELAS2,51,1.+5,2,6,4,6\nCELAS2,52,3.+4,2,2\nSPC1,7,1,2\nEIGRL"
    )
    beam, _ = read_nastran(deck(tmp_path, text))
    assert set(beam.attachments) == {
        PointMass(3.0, 12.5, 0.0, 0.1),
        Spring(1.0, 3e4),
        Spring(1.0, axial=np.inf),
        Joint(1.0, 1e-5),
    }


WRONG = {
    "a card that is not known": (
        ("CONM2,9", "GENXY,9,1,1,3\nCONM2,9"),
        ("line 13: GENXY", "not understood"),
    ),
    "an element of another kind": (
        ("CONM2,9", "CROD,9,1,1,3\nCONM2,9"),
        ("line 13: CROD", "no element of a beam", "--elements 100:140"),
    ),
    "a word for a number": (("2.-6", "two"), ("line 11: PBAR: field 4 is 'two'", "number")),
    "a grid that is missing": (("1,2,0.,1.,0.", "1,8,0.,1.,0."), ("CBAR", "no GRID 8")),
    "a grid off the line": (
        ("2,,1.,0.,0.", "2,,1.,.1,0."),
        ("line 9: CBAR", "grid 2", "line of the others", "--elements"),
    ),
    "a gap": (("CBAR,2,1,2,3,0.,1.,0.\n", "GRID,4,,4.,0.,0.\nCBAR,2,1,3,4,0.,1.,0.\n"), ("gap",)),
    "two beside each other": (("PBAR,", "CBAR,3,1,2,1,0.,1.,0.\nPBAR,"), ("line 11", "beside")),
    "one past a grid": (("CBAR,1,1,1,2", "CBAR,1,1,1,3"), ("line 9: CBAR", "past another grid")),
    "an orientation along the beam": (
        ("1,1,1,2,0.,1.,0.", "1,1,1,2,1.,0.,0."),
        ("line 9", "across it"),
    ),
    "a turned element": (("2,1,2,3,0.,1.,0.", "2,1,2,3,0.,1.,1."), ("line 10", "turned")),
    "a pin flag": (
        ("1,1,1,2,0.,1.,0.", "1,1,1,2,0.,1.,0.,\n,56"),
        ("line 9: CBAR", "releases 6"),
    ),
    "another one": (("GRID,2,,1.", "GRID,1,,1."), ("line 7: GRID", "another one")),
    "no property": (("CBAR,1,1,", "CBAR,1,6,"), ("line 9: CBAR", "PBAR or PBEAM 6")),
    "no material": (("PBAR,1,1,", "PBAR,1,5,"), ("PBAR", "no MAT1 5")),
    "a coordinate system": (("GRID,3,,3.", "GRID,3,4,3."), ("GRID", "coordinate system")),
    "a mass off the axis": ((",.1\nSPC1", ",.1,.2\nSPC1"), ("CONM2", "off the axis")),
    "no bulk": (("BEGIN BULK\n", ""), ("no BEGIN BULK",)),
    "fields behind a mark": (
        ("GRID,1,,0.,0.,0.", "GRID,1,,0.,0.,0.,,,,+A,7"),
        ("line 6", "the next line"),
    ),
    "a superelement": (("CONM2,9", "BEGIN SUPER=1\nCONM2,9"), ("line 13", "superelement")),
    "a continuation alone": (("GRID,1", "+,1\nGRID,1"), ("line 6", "none is before it")),
    "a name that is none": (("GRID,1", "GR-D,1"), ("line 6", "no name of a card")),
}
WRONG["no mass"] = (
    (",,0.5\nMAT1,1,2.1+11,,.3,7850.\nCONM2,9,3,,12.5,.1", "\nMAT1,1,2.1+11,,.3"),
    ("mass per length", "no CONM2", "RHO"),
)


@pytest.mark.parametrize("what", WRONG)
def test_what_is_not_understood_is_refused(what, tmp_path):
    (old, new), words = WRONG[what]
    assert old in BAR
    path = deck(tmp_path, BAR.replace(old, new, 1))
    refused(run("convert", path, tmp_path / "beam.toml"), str(path), *words)
    assert not (tmp_path / "beam.toml").exists()


def test_several_sets_of_supports_without_case_control(tmp_path):
    bulk = BAR.partition("BEGIN BULK\n")[2].replace("SPC1,7,12,1,3", "SPC1,7,12,1\nSPC1,8,2,3")
    with pytest.raises(InputError, match="SPC sets 7, 8"):
        read_nastran(deck(tmp_path, bulk))
    one = bulk.replace("SPC1,8", "SPC1,7")
    assert read_nastran(deck(tmp_path, one))[0].ends == Ends("pinned", "pinned", "fixed", "free")


def test_a_preload_that_does_not_balance(tmp_path):
    text = nastran_text(solved("starter"), analysis="statsub")
    assert "STATSUB(PRELOAD) = 1" in text
    text = text.replace("SPC1*                  1             126               1\n", "")
    text = text.replace("  SPC = 1\n", "")
    text = re.sub(r"(?m)^FORCE\*.*\n\*.*\n", "", text, count=1)
    with pytest.raises(InputError, match="add up to"):
        read_nastran(deck(tmp_path, text))


def test_case_control_that_names_no_static_subcase(tmp_path):
    text = BAR.replace("METHOD = 1\n", "METHOD = 1\nSTATSUB = 5\n")
    with pytest.raises(InputError, match="STATSUB names subcase 5"):
        read_nastran(deck(tmp_path, text))


@pytest.mark.parametrize("value", [1.0, -1.5, 1 / 3, -2e-300, 6.02214076e23, 123456.789, 0.0])
def test_reals_keep_their_digits(value, tmp_path):
    text = real_text(value)
    assert len(text) <= 16
    assert "." in text
    path = deck(tmp_path, card_text("PARAM", "X", value))
    assert read_deck(path).cards[0].real(2) == pytest.approx(value, rel=1e-8)
