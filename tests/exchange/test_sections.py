"""Tables of sections of wind-turbine programs, with numbers worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import InputError, solve_modes
from antinode.beam.attachments import PointMass
from antinode.exchange.inputs import Choices, read_beam
from cli_run import refused, run

TOWER = """\
------- ELASTODYN V1.00.* TOWER INPUT FILE -------------------------------
A tower of two pieces
---------------------- TOWER PARAMETERS ----------------------------------------
          3   NTwInpSt    - Number of input stations to specify tower geometry
          1   TwrFADmp(1) - Tower 1st fore-aft mode structural damping ratio (%)
---------------------- TOWER ADJUSTMUNT FACTORS --------------------------------
          1   FAStTunr(1) - Tower fore-aft modal stiffness tuner, 1st mode (-)
          2   AdjTwMa     - Factor to adjust tower mass density (-)
          1   AdjFASt     - Factor to adjust tower fore-aft stiffness (-)
        0.5   AdjSSSt     - Factor to adjust tower side-to-side stiffness (-)
---------------------- DISTRIBUTED TOWER PROPERTIES ----------------------------
  HtFract       TMassDen         TwFAStif       TwSSStif
   (-)           (kg/m)           (Nm^2)         (Nm^2)
0.0000000E+00 5.5908700E+03 6.1434300E+11 6.1434300E+11
0.5000000E+00 4.0000000E+03 4.0000000E+11 4.2000000E+11
1.0000000E+00 3.0000000E+03 2.0000000E+11 2.1000000E+11
---------------------- TOWER FORE-AFT MODE SHAPES ------------------------------
     0.7004   TwFAM1Sh(2) - Mode 1, coefficient of x^2 term
"""
BMODES = """\
Tower section properties
2        n_secs:     number of blade or tower sections at which properties are specified (-)

 sec_loc  str_tw  tw_iner   mass_den flp_iner  edge_iner  flp_stff  edge_stff   tor_stff   axial_stff cg_offst sc_offst tc_offst
  (-)     (deg)    (deg)    (kg/m)   (kg-m)    (kg-m)     (Nm^2)     (Nm^2)     (Nm^2)     (N)       (m)      (m)      (m)
 0.00000  0.000    0.000    100.0    400.0     900.0      1.0d9      2.0e9      1.0e9      5.0e9     0.000    0.000    0.000
 1.00000  0.000    3.000    100.0    400.0     900.0      1.0e9      2.0e9      1.0e9      5.0e9     0.000    0.000    0.000
"""  # noqa: E501


@pytest.fixture
def tower(tmp_path):
    path = tmp_path / "tower.dat"
    path.write_text(TOWER)
    return path


def test_a_tower_of_elastodyn(tower):
    choices = Choices(("beam.ends.left=clamped",), length=80.0)
    found = read_beam(tower, "sections", choices)
    beam = found.beam
    np.testing.assert_allclose(beam.x, [0, 40, 80])
    np.testing.assert_allclose(beam.mass_per_length, [[11181.74, 8000], [8000, 6000]])
    np.testing.assert_allclose(beam.bending_stiffness[1], [4e11, 2e11])
    assert beam.interpolation == "linear"
    assert beam.ends.left == "clamped"
    side = read_beam(tower, "sections", Choices(plane=2, length=80.0)).beam
    np.testing.assert_allclose(side.bending_stiffness[1], [2.1e11, 1.05e11])


def test_sections_of_bmodes_and_their_closed_form(tmp_path):
    path = tmp_path / "secs.dat"
    path.write_text(BMODES)
    found = read_beam(path, "sections", Choices(("beam.ends.left=clamped",), length=20.0))
    np.testing.assert_allclose(found.beam.rotary_inertia_per_length, 400.0)
    edge = read_beam(path, "sections", Choices(plane=2, length=20.0)).beam
    np.testing.assert_allclose(edge.rotary_inertia_per_length, 900.0)
    np.testing.assert_allclose(found.beam.axial_stiffness, 5e9)
    assert any("tw_iner" in note for note in found.notes)
    assert any("flp_iner counts" in note for note in found.notes)
    f1 = solve_modes(replace(found.beam, theory="euler_bernoulli"), 1).frequencies_hz()[0]
    # a uniform cantilever: 1.8751041^2 / (2 pi L^2) sqrt(EI/m)
    assert f1 == pytest.approx(1.875104069**2 / (2 * np.pi * 400) * np.sqrt(1e9 / 100), rel=1e-8)
    # rotary inertia takes (r/L)^2/2 Int Y'^2/Int Y^2 in first order: 4.6478 for Y of mode 1, L = 1
    with_rotary = solve_modes(found.beam, 1).frequencies_hz()[0]
    assert with_rotary / f1 - 1 == pytest.approx(-0.5 * 4.6478 * 4 / 400, rel=0.05)


CONCENTRATED = """\
---------------------- TOWER CONCENTRATED MASSES ------------------------------
          2   NTwCMass    - Number of tower concentrated masses
  HtFract       TwCMass
   (-)            (kg)
  0.5           9000
  1.0           60000
"""


def test_concentrated_masses(tower):
    tower.write_text(TOWER + CONCENTRATED)
    choices = Choices(("beam.ends.left=clamped",), length=80.0)
    masses = read_beam(tower, "sections", choices).beam.attachments
    assert masses == (PointMass(40.0, 9000.0), PointMass(80.0, 60000.0))
    tower.write_text(TOWER + CONCENTRATED.replace("(kg)", "(t)").replace("0.5 ", "0.0 "))
    masses = read_beam(tower, "sections", choices).beam.attachments
    assert masses == (PointMass(0.0, 9e6), PointMass(80.0, 6e7))
    for change, words in (
        (("2   NTwCMass", "3   NTwCMass"), "2 rows below it, but 3 are announced"),
        (("TwCMass\n", "TwDrag\n"), "a second table, of twdrag"),
        (("1.0           6", "1.2           6"), "60000 at 1.2"),
    ):
        tower.write_text(TOWER + CONCENTRATED.replace(*change))
        with pytest.raises(InputError, match=words):
            read_beam(tower, "sections", choices)
    none = "0 NTwCMass - number\n  HtFract       TwCMass\n   (-)            (kg)\n"
    tower.write_text(TOWER + none)
    assert read_beam(tower, "sections", choices).beam.attachments == ()


def test_rotary_and_axial_columns_of_a_tower(tower):
    head = "HtFract TMassDen TwFAStif TwSSStif TwGJStif TwEAStif TwFAIner TwSSIner\n"
    units = "(-) (kg/m) (Nm^2) (Nm^2) (Nm^2) (N) (kg m) (kg-m)\n"
    rows = "0 4000 4e11 4e11 3e11 6e10 1e5 2e5\n1 2000 2e11 2e11 1e11 3e10 5e4 1e5\n"
    tower.write_text("2 NTwInpSt\n" + head + units + rows)
    for plane, inertia in ((1, [1e5, 5e4]), (2, [2e5, 1e5])):
        found = read_beam(tower, "sections", Choices(plane=plane, length=80.0))
        np.testing.assert_allclose(found.beam.rotary_inertia_per_length, [inertia])
        np.testing.assert_allclose(found.beam.axial_stiffness, [[6e10, 3e10]])
        np.testing.assert_allclose(found.beam.torsional_stiffness, [[3e11, 1e11]])
        np.testing.assert_allclose(found.beam.polar_inertia_per_length, [[3e5, 1.5e5]])
    tower.write_text("2 NTwInpSt\n" + head + units + rows.replace("5e4", "0"))
    found = read_beam(tower, "sections", Choices(length=80.0))
    np.testing.assert_allclose(found.beam.rotary_inertia_per_length, [[1e5, 0.0]])


def test_units_are_read(tmp_path):
    path = tmp_path / "secs.dat"
    path.write_text(BMODES.replace("(Nm^2)     (Nm^2)     (Nm^2)", "(kNm^2)    (MNm^2)    (Nm^2)"))
    beam = read_beam(path, "sections", Choices(length=20.0)).beam
    assert beam.bending_stiffness[0, 0] == pytest.approx(1e12)


WRONG = {
    "the length": ((), (), ("--length 87.6m",)),
    "cut off": (("1.0000000E+00 3.0", "# "), ("--length", "80"), ("2 sections", "says 3")),
    "no stiffness": (("TwFAStif", "TwFASt"), ("--length", "80"), ("line 12", "no column twfastif")),
    "a unit": (("(kg/m)", "(kg)"), ("--length", "80"), ("line 13", "tmassden")),
    "a factor": (("2   AdjTwMa", "x   AdjTwMa"), ("--length", "80"), ("line 8", "AdjTwMa")),
    "no table": (("HtFract", "Height"), ("--length", "80"), ("no table of sections",)),
    "fractions that fall": (
        ("0.5000000E+00 4.0", "1.5000000E+00 4.0"),
        ("--length", "80"),
        ("x must increase",),
    ),
    "a table that ends before the top": (
        ("1.0000000E+00 3.0", "0.9000000E+00 3.0"),
        ("--length", "80"),
        ("line 12", "htfract runs from 0 to 0.9", "from 0 to 1"),
    ),
    "a table that begins above the foot": (
        ("0.0000000E+00 5.5", "0.1000000E+00 5.5"),
        ("--length", "80"),
        ("htfract runs from 0.1 to 1",),
    ),
    "more rows than announced": (
        ("3   NTwInpSt", "2   NTwInpSt"),
        ("--length", "80"),
        ("3 sections from line 14", "ntwinpst says 2"),
    ),
    "a negative mass": (("3.0000000E+03 2", "-3.000000E+03 2"), ("--length", "80"), ("row 3",)),
    "a length without sense": ((), ("--length", "80kg"), ("--length '80kg'",)),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_said(what, tower):
    change, options, words = WRONG[what]
    if change:
        assert change[0] in TOWER
        tower.write_text(TOWER.replace(*change))
    refused(run("convert", tower, tower.with_suffix(".toml"), *options), *words)
