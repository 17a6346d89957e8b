"""Cards that decks of other people have: sections, defaults, sets, offsets, systems, subsets."""

import numpy as np
import pytest

from antinode import InputError, solve_modes
from antinode.beam.attachments import PointMass, Spring
from antinode.beam.ends import Ends
from antinode.exchange.inputs import Choices, elements_of, read_beam
from antinode.exchange.nastran.reader import read_nastran
from antinode.exchange.units import FT_LBF_S, IN_LBF_S, MM_KG_MS, MM_T_S, SI, SYSTEMS
from cli_run import refused, run

HEAD = "SOL 103\nCEND\nSPC = 7\nMETHOD = 1\nBEGIN BULK\nEIGRL,1,,,3\n"
GRIDS = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n"
BARS = "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\n"
PBAR = "PBAR,1,1,1.-3,2.-6,3.-6,,0.5\n"
MAT1 = "MAT1,1,2.1+11,,.3,7850.\n"
CLAMP = "SPC1,7,123456,1\n"
# a clamped bar of 2 m, EI 4.2e5 N m^2, 8.35 kg/m: 1.8751040687^2/(2 pi 4) sqrt(EI/m)
FIRST = 1.8751040687119611**2 / (8 * np.pi) * np.sqrt(4.2e5 / 8.35)


def read(tmp_path, *parts, head=HEAD, plane=1, elements=()):
    path = tmp_path / "deck.bdf"
    path.write_text(head + "".join(parts) + "ENDDATA\n")
    return read_nastran(path, SI, plane, elements)


def first(beam):
    return solve_modes(beam, 1).frequencies_hz()[0]


def moved(places, *more):
    """The grids in another coordinate system, 9, which more cards define."""
    cards = "".join(f"GRID,{k},{place}\n" for k, place in enumerate(places, 1))
    return (GRIDS, cards + "\n".join(more) + "\n")


SAME = {
    "GRDSET": (GRIDS, "GRDSET,,,,,,,345\n" + GRIDS),
    "unused CORD2R": (GRIDS, GRIDS + "CORD2R,9,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"),
    "SPCADD of a set that is not there": (CLAMP, "SPCADD,7,5,6\nSPC1,5,123456,1\n"),
    "SPCADD of two": (CLAMP, "SPCADD,7,5,6\nSPC1,5,123,1\nSPC,6,1,456\n"),
    "blanks among freedoms": (CLAMP, "SPC1,7,12 3 456,1\n"),
    "BAROR": (BARS, "BAROR,,1,,,0.,1.,0.\nCBAR,1,,1,2\nCBAR,2,,2,3\n"),
    "old orientation": (BARS, BARS.replace("0.,1.,0.", "0.,1.,0.,1")),
    "basic orientation": (BARS, BARS.replace("0.,1.,0.", "0.,1.,0.,BGG")),
    "pins out of plane": (BARS, BARS.replace("0.,1.,0.", "0.,1.,0.,\n,45,45")),
    "harmless cards": (
        MAT1,
        MAT1 + "PSHELL,4,1,.01\nMATT1,1,8\nTABDMP1,1\nSET1,5,1,2\nDEQATN  7       F(A,B)=A\n",
    ),
    "E of G and nu": (MAT1, "MAT1,1,,8.0769230769+10,.3,7850.\n"),
    "CORD2R": moved(
        ("9,0.,0.,0.", "9,0.,-1.,0.", "9,0.,-2.,0."),
        "CORD2R,9,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.",
    ),
    "CORD2C": moved(
        (",0.,0.,0.", "9,1.,0.,4.", "9,2.,0.,4."), "CORD2C,9,,0.,0.,-4.,0.,0.,1.\n,1.,0.,0."
    ),
    "CORD1S": moved(
        (",0.,0.,0.", "9,1.,90.,0.", ",2.,0.,0."), "CORD1S,9,1,8,3", "GRID,8,,0.,0.,1."
    ),
}


@pytest.mark.parametrize("change", SAME.values(), ids=SAME)
def test_decks_that_mean_the_same_bar(change, tmp_path):
    text = GRIDS + BARS + PBAR + MAT1 + CLAMP
    assert change[0] in text
    beam, _ = read(tmp_path, text.replace(*change))
    assert beam.ends.left == "clamped"
    np.testing.assert_allclose(beam.x, [0, 1, 2], atol=1e-12)
    assert first(beam) == pytest.approx(FIRST, rel=1e-8)


def test_sections_by_their_type(tmp_path):
    tube = "PBARL,1,1,,TUBE\n,0.1,0.09\n"
    beam, _ = read(tmp_path, GRIDS, BARS, tube, MAT1, CLAMP)
    I, A = np.pi / 4 * (0.1**4 - 0.09**4), np.pi * (0.1**2 - 0.09**2)  # noqa: E741
    np.testing.assert_allclose(beam.bending_stiffness, 2.1e11 * I)
    np.testing.assert_allclose(beam.mass_per_length, 7850 * A)
    box = "PBARL,1,1,MSCBML0,BOX\n,.05,.08,.006,.004,3.\n"
    for plane, (b, h, s, t) in ((1, (0.05, 0.08, 0.004, 0.006)), (2, (0.08, 0.05, 0.006, 0.004))):
        beam, _ = read(tmp_path, GRIDS, BARS, box, MAT1, CLAMP, plane=plane)
        I = (b * h**3 - (b - 2 * s) * (h - 2 * t) ** 3) / 12  # noqa: E741
        np.testing.assert_allclose(beam.bending_stiffness, 2.1e11 * I)
        np.testing.assert_allclose(
            beam.mass_per_length, 7850 * (b * h - (b - 2 * s) * (h - 2 * t)) + 3
        )


def test_a_round_section_needs_no_plane(tmp_path):
    bars = "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,1.\n"
    beam, _ = read(tmp_path, GRIDS, bars, "PBARL,1,1,,ROD\n,0.02\n", MAT1, CLAMP)
    assert beam.ends.left == "clamped"
    with pytest.raises(InputError, match="turned"):
        read(tmp_path, GRIDS, bars, PBAR, MAT1, CLAMP)


BEAMS = BARS.replace("CBAR", "CBEAM")
PBEAM = "PBEAM,1,1,2.-3,4.-7,3.-7,0.,1.-7,1.5\n,,,,,,,,\n{}"
MIDDLE, END = ",NO,0.5,1.5-3,2.5-7,2.-7,0.,1.-7,1.0\n", ",NO,1.,1.-3,1.-7,1.-7,0.,1.-7,0.5\n"


@pytest.mark.parametrize("stations", [MIDDLE + END, END + MIDDLE, ",NO,0.5\n" + END, END])
def test_stations_of_a_pbeam_in_any_order_and_empty(stations, tmp_path):
    beam, notes = read(tmp_path, GRIDS, BEAMS, PBEAM.format(stations), MAT1, CLAMP)
    middle, _ = beam.with_breakpoints([0.5]).bending_stiffness[0:2, 1]
    assert middle == pytest.approx(2.1e11 * 2.5e-7)
    assert beam.bending_stiffness[-1, 1] == pytest.approx(2.1e4)
    assert beam.mass_per_length[-1, 1] == pytest.approx(8.35)
    assert any("shear (K1, K2)" in note for note in notes)


def test_the_same_station_twice_and_one_outside(tmp_path):
    for stations, words in (
        (MIDDLE + MIDDLE, "another station"),
        (",NO,1.5,1.-3\n", "between 0 and 1"),
    ):
        with pytest.raises(InputError, match=words):
            read(tmp_path, GRIDS, BEAMS, PBEAM.format(stations), MAT1, CLAMP)


def test_a_pbeaml_that_tapers(tmp_path):
    text = "PBEAML,1,1,,BAR\n,.04,.06,1.,NO,1.,.02,.03,2.\n"
    beam, _ = read(tmp_path, GRIDS, BEAMS, text, MAT1, CLAMP)
    # as PBEAM: A and I run linearly from end to end, not b and h
    assert beam.interpolation == "linear"
    E = 2.1e11
    np.testing.assert_allclose(
        beam.bending_stiffness[0], [E * 4e-2 * 6e-2**3 / 12, E * 2e-2 * 3e-2**3 / 12]
    )
    np.testing.assert_allclose(beam.mass_per_length[0], [7850 * 24e-4 + 1, 7850 * 6e-4 + 2])
    middle = "PBEAML,1,1,,BAR\n,.04,.06,1.,NO,.5,.03,.05,2.\n,NO,1.,.02,.03,2.\n"
    beam, _ = read(tmp_path, GRIDS, BEAMS, middle, MAT1, CLAMP)
    np.testing.assert_allclose(beam.x, [0, 0.5, 1, 1.5, 2])
    assert beam.bending_stiffness[0, 1] == pytest.approx(E * 3e-2 * 5e-2**3 / 12)
    alone = "PBEAML,1,1,,L\n,.04,.06,.004,.003\n"
    with pytest.raises(InputError, match="I12 bends the beam out of the plane"):
        read(tmp_path, GRIDS, BEAMS, alone, MAT1, CLAMP)
    _, notes = read(
        tmp_path, GRIDS.replace("GRID,1", "GRDSET,,,,,,,35\nGRID,1"), BEAMS, alone, MAT1, CLAMP
    )
    assert any("shear centre of L" in note for note in notes)


def test_a_set_that_does_not_exist(tmp_path):
    with pytest.raises(InputError, match="SPC = 8 is chosen, but no SPC card is of that set"):
        read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, head=HEAD.replace("SPC = 7", "SPC = 8"))
    mpc = "MPC,4,1,2,1.,2,2,-1.\n"
    read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, mpc)
    with pytest.raises(InputError, match="chooses MPC = 4"):
        read(
            tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, mpc, head=HEAD.replace("SPC", "MPC = 4\nSPC")
        )


class TestOffsets:
    BARS = BARS.replace("0.,1.,0.", "0.,1.,0.,\n,,,0.,{0},{1},0.,{0},{1}")

    def test_clamped_or_free_it_is_the_same_beam(self, tmp_path):
        for y, z in ((0.3, 0.0), (0.0, -0.2), (0.1, 0.1)):
            beam, _ = read(tmp_path, GRIDS, self.BARS.format(y, z), PBAR, MAT1, CLAMP)
            assert first(beam) == pytest.approx(FIRST, rel=1e-8)

    def test_supports_that_a_lever_would_couple_are_refused(self, tmp_path):
        lateral, pinned = "SPC1,7,2,1\nSPC1,7,2,3\n", "SPC1,7,12,1\n"
        beam, _ = read(tmp_path, GRIDS, self.BARS.format(0.3, 0.0), PBAR, MAT1, lateral)
        assert (beam.ends.left, beam.ends.right) == ("pinned", "pinned")
        for y, z, supports in ((0.3, 0.0, pinned), (0.0, 0.1, lateral)):
            with pytest.raises(InputError, match="beside the axis"):
                read(tmp_path, GRIDS, self.BARS.format(y, z), PBAR, MAT1, supports)

    def test_masses_count_with_their_centre(self, tmp_path):
        bars = self.BARS.format(0.3, 0.0)
        beam, _ = read(tmp_path, GRIDS, bars, PBAR, MAT1, CLAMP, "CONM2,9,3,,4.,.1,.3\n")
        (mass,) = beam.attachments
        assert mass == PointMass(2.0, 4.0, 0.0, mass.offset)
        assert mass.offset == pytest.approx(0.1)
        with pytest.raises(InputError, match="off the axis"):
            read(tmp_path, GRIDS, bars, PBAR, MAT1, CLAMP, "CONM2,9,3,,4.\n")

    def test_offsets_straighten_a_line_of_grids(self, tmp_path):
        grids = GRIDS.replace("GRID,3,,2.,0.,0.", "GRID,3,,2.,.5,0.")
        bars = BARS.replace("CBAR,2,1,2,3,0.,1.,0.", "CBAR,2,1,2,3,0.,1.,0.,\n,,,,,,0.,-.5,0.")
        beam, _ = read(tmp_path, grids, bars, PBAR, MAT1, CLAMP)
        assert first(beam) == pytest.approx(FIRST, rel=1e-8)
        bars = BARS.replace("CBAR,2,1,2,3,0.,1.,0.", "CBAR,2,1,2,3,0.,1.,0.,\n,,,0.1,0.,0.")
        with pytest.raises(InputError, match="at two places"):
            read(tmp_path, GRIDS, bars, PBAR, MAT1, CLAMP)

    def test_the_neutral_axis_of_a_pbeam(self, tmp_path):
        pbeam = PBEAM.format(",,,,,,,,\n,0.,0.\n,,,,,.2,0.,.2,0.\n").replace(
            ",,,,,,,,\n,,,,,,,,\n", ",,,,,,,,\n"
        )
        beam, _ = read(tmp_path, GRIDS, BEAMS, pbeam, MAT1, "SPC1,7,2,1\nSPC1,7,2,3\n")
        assert beam.ends == Ends("pinned", "pinned", "free", "free")
        with pytest.raises(InputError, match="beside the axis"):
            read(tmp_path, GRIDS, BEAMS, pbeam, MAT1, "SPC1,7,12,1\n")


def test_a_mass_on_an_arm_and_springs_by_their_cards(tmp_path):
    cards = (
        "GRID,9,,2.4,0.,0.\nRBE2,20,3,123456,9\nCONM2,21,9,,5.,,,,\n,.1,0.,.2,0.,0.,.3\n"
        "CELAS1,30,31,2,2\nPELAS,31,4.+3\nCBUSH,40,41,2\nPBUSH,41,K,,7.+3\n"
    )
    beam, _ = read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, cards)
    mass, lateral, bush = beam.attachments
    assert mass == PointMass(2.0, 5.0, 0.3, mass.offset)
    assert mass.offset == pytest.approx(0.4)
    assert (lateral, bush) == (Spring(1.0, 4e3), Spring(1.0, 7e3))
    rbar = cards.replace("RBE2,20,3,123456,9", "RBAR,20,3,9,123456")
    assert read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, rbar)[0].attachments == beam.attachments


class TestSubsets:
    OTHERS = (
        "GRID,11,,0.,5.,0.\nCBAR,70,1,1,11,1.,0.,0.\nCQUAD4,71,4,1,2,3,11\nCONM2,72,11,,9.\n"
        "CONM2,73,3,,4.\nSPC1,7,123,11\nRBE3,80,,11,123,1.,123,1,2\nCELAS2,74,1.+3,11,2\n"
    )

    def test_named_elements_of_a_larger_model(self, tmp_path):
        parts = GRIDS, BARS, PBAR, MAT1, CLAMP
        with pytest.raises(InputError, match="--elements"):
            read(tmp_path, *parts, self.OTHERS)
        beam, notes = read(tmp_path, *parts, self.OTHERS, elements=(range(1, 3),))
        alone, _ = read(tmp_path, *parts, "CONM2,73,3,,4.\n")
        np.testing.assert_array_equal(beam.bending_stiffness, alone.bending_stiffness)
        assert (beam.attachments, beam.ends) == (alone.attachments, alone.ends)
        for name in ("1 CBAR", "1 CQUAD4", "1 CONM2", "1 RBE3", "1 CELAS2"):
            assert any(name in note for note in notes), (name, notes)

    def test_by_the_command_line(self, tmp_path):
        path, out = tmp_path / "deck.bdf", tmp_path / "beam.toml"
        path.write_text(HEAD + GRIDS + BARS + PBAR + MAT1 + CLAMP + self.OTHERS + "ENDDATA\n")
        refused(run("convert", path, out), "CQUAD4", "--elements 100:140")
        assert run("convert", path, out, "--elements", "1:2").code == 0
        refused(run("convert", path, out, "--elements", "3:9"), "no CBAR or CBEAM of these numbers")
        refused(run("convert", path, out, "--elements", "1-2"), "'1-2'", "100:140")
        refused(run("convert", path, out, "--elements", "2:1"), "backwards")

    def test_lists(self):
        assert elements_of(" 7, 100:140") == (range(7, 8), range(100, 141))
        assert elements_of("") == ()


def test_files_that_include_others_and_continuations_by_name(tmp_path):
    (tmp_path / "more.inc").write_text(PBAR + MAT1 + CLAMP)
    beam, _ = read(tmp_path, GRIDS, BARS, "INCLUDE 'more.inc'\n")
    assert first(beam) == pytest.approx(FIRST, rel=1e-8)
    with pytest.raises(InputError, match="there is no file"):
        read(tmp_path, GRIDS, BARS, "INCLUDE 'gone.inc'\n")
    with pytest.raises(InputError, match="circle"):
        read(tmp_path, GRIDS, "INCLUDE 'deck.bdf'\n")
    rod = "PBARL,1,1,,ROD,,,,,+B\nPBARL,2,1,,ROD,,,,,+C\n+C,.05\n+B,.03\n"
    beam, _ = read(tmp_path, GRIDS, BARS, rod, MAT1, CLAMP)
    np.testing.assert_allclose(beam.bending_stiffness, 2.1e11 * np.pi / 4 * 0.03**4)
    with pytest.raises(InputError, match="continues as 'D'"):
        read(tmp_path, GRIDS, BARS, rod.replace("+B,.03", "+D,.03"), MAT1, CLAMP)


def test_a_file_without_enddata_is_read_with_a_note(tmp_path):
    path = tmp_path / "deck.bdf"
    path.write_text(HEAD + GRIDS + BARS + PBAR + MAT1 + CLAMP)
    _, notes = read_nastran(path)
    assert any("no ENDDATA" in note for note in notes)


def test_what_is_passed_over_is_listed(tmp_path):
    cards = "TABDMP1,1\nSET1,5,1,2\nASET1,3,1\nDAREA,2,3,2,1.\nDAREA,3,3,2,1.\n"
    cards += "CORD2R,9,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
    _, notes = read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, cards)
    assert any("1 ASET1, 1 CORD2R, 2 DAREA, 1 SET1, 1 TABDMP1" in note for note in notes)
    assert any("condense" in note for note in notes)


GJ, INERTIA = 2.1e11 / 2.6 * np.pi / 2 * (0.1**4 - 0.09**4), 7850 * np.pi / 2 * (0.1**4 - 0.09**4)
TUBE = "PBARL,1,1,,TUBE\n,0.1,0.09\n"


def torsion(beam, modes=3):
    return solve_modes(beam, modes).frequencies_hz("torsion")


class TestTorsion:
    def test_a_tube_that_one_end_holds(self, tmp_path):
        beam, notes = read(tmp_path, GRIDS, BARS, TUBE, MAT1, CLAMP)
        np.testing.assert_allclose(beam.torsional_stiffness, GJ)
        np.testing.assert_allclose(beam.polar_inertia_per_length, INERTIA)
        assert (beam.ends.left_torsion, beam.ends.right_torsion) == ("fixed", "free")
        wanted = (np.arange(3) + 0.5) * np.pi / 2 * np.sqrt(GJ / INERTIA) / (2 * np.pi)
        assert torsion(beam) == pytest.approx(wanted, rel=1e-10)
        assert not any("torsion" in note for note in notes)

    def test_a_disc_on_a_spring(self, tmp_path):
        cards = "CONM2,9,3,,4.\n,2.5+2,,.1,,,.2\nCELAS2,30,3.+6,3,4\nCBUSH,40,41,2\n"
        cards += "PBUSH,41,K,,,,7.+3\n"
        beam, _ = read(tmp_path, GRIDS, BARS, TUBE, MAT1, CLAMP, cards)
        assert beam.attachments == (
            PointMass(2.0, 4.0, 0.2, 0.0, 250.0),
            Spring(2.0, torsional=3e6),
            Spring(1.0, torsional=7e3),
        )
        beam, _ = read(tmp_path, GRIDS, BARS, TUBE, MAT1, CLAMP, cards.partition("CBUSH")[0])
        omega = 2 * np.pi * torsion(beam, 1)[0]
        b = omega * np.sqrt(INERTIA / GJ)
        assert GJ * b / np.tan(2 * b) == pytest.approx(250 * omega**2 - 3e6, rel=1e-8)

    def test_along_another_axis(self, tmp_path):
        grids = "GRID,1\nGRID,2,,0.,0.,1.\nGRID,3,,0.,0.,2.\n"
        disc = "CONM2,9,3,,4.\n,.1,,.1,,,25.\nSPC1,7,6,3\n"
        beam, _ = read(tmp_path, grids, BARS, TUBE, MAT1, CLAMP, disc)
        assert beam.attachments == (PointMass(2.0, 4.0, 0.1, 0.0, 25.0),)
        assert beam.ends.right_torsion == "fixed"

    def test_a_spring_and_a_support_on_an_arm(self, tmp_path):
        arm = "GRID,9,,2.4,0.,.3\nRBE2,20,3,123456,9\nCELAS2,30,3.+6,9,4\nSPC1,7,4,9\n"
        beam, _ = read(tmp_path, GRIDS, BARS, TUBE, MAT1, CLAMP, arm)
        assert beam.attachments == (Spring(2.0, torsional=3e6),)
        assert beam.ends.right_torsion == "fixed"

    def test_the_inertia_of_mass_that_carries_nothing(self, tmp_path):
        pbeam = PBEAM.format(",0.,0.,,,.25,.35\n")
        beam, _ = read(tmp_path, GRIDS, BEAMS, pbeam, MAT1, CLAMP)
        rho = 7850 * 7e-7
        np.testing.assert_allclose(
            beam.polar_inertia_per_length[0], [rho + 0.25, rho + 0.35], rtol=1e-12
        )

    @pytest.mark.parametrize(
        ("old", "new", "why"),
        [
            ("GRID,1", "GRDSET,,,,,,,4\nGRID,1", "freedom 4 is held at every grid"),
            ("SPC1,7,123456,1", "SPC1,7,123456,1\nSPC1,7,4,2,3", "freedom 4 is held at every"),
            (TUBE, PBAR, "J, or G, is not known"),
            (",,.3,", ",,,", "J, or G, is not known"),
            (TUBE, "PBARL,1,1,,HEXA\n,.01,.08,.06\n", "J, or G, is not known"),
            (".3,7850.\n", ".3\n", "rho (I1 + I2) is zero"),
            ("CBAR,2,1,2,3", "GRID,4,,1.\nRBE2,20,2,1236,4\nCBAR,2,1,4,3", "of a joint"),
        ],
    )
    def test_why_there_is_none(self, old, new, why, tmp_path):
        text = GRIDS + BARS + TUBE.replace(".09\n", ".09,3.\n") + MAT1 + CLAMP
        old = old.replace(".09\n", ".09,3.\n")
        assert old in text
        cards = "CELAS2,30,3.+6,3,4\n"
        beam, notes = read(tmp_path, text.replace(old, new, 1), cards)
        assert (beam.families, beam.attachments) == (("bending", "longitudinal"), ()) or "4" in new
        assert beam.torsional_stiffness is None
        assert beam.ends.left_torsion is None
        assert any(why in note for note in notes), notes


BUCKLING = """\
SOL 105
CEND
SPC = 7
SUBCASE 1
  LOAD = 2
SUBCASE 2
  METHOD = 1
BEGIN BULK
EIGRL,1,,,3
"""


def test_the_first_subcase_loads_a_deck_of_buckling(tmp_path):
    force = "LOAD,2,2.,1.,3,.5,4\nFORCE,3,3,,-100.,1.\nFORCE,4,2,,-60.,1.\n"
    beam, _ = read(tmp_path, GRIDS, BARS, PBAR, MAT1, CLAMP, force, head=BUCKLING)
    np.testing.assert_allclose(beam.axial_force, [[260, 260], [200, 200]])
    with pytest.raises(InputError, match="MOMENT: it loads the preload"):
        read(
            tmp_path,
            GRIDS,
            BARS,
            PBAR,
            MAT1,
            CLAMP,
            force,
            "MOMENT,3,3,,1.,0.,0.,1.\n",
            head=BUCKLING,
        )


def test_the_weight_of_a_preload(tmp_path):
    parts = GRIDS, BARS, PBAR, MAT1, CLAMP, "CONM2,9,3,,3.,.1\n", "GRAV,2,,-9.81,1.\n"
    beam, _ = read(tmp_path, *parts, head=BUCKLING)
    N = beam.axial_force_at(np.array([0, 1, 1]), np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(N, 9.81 * np.array([2 * 8.35 + 3, 8.35 + 3, 3]))
    assert not beam.offset_weight


@pytest.mark.parametrize("system", [MM_T_S, MM_KG_MS, IN_LBF_S, FT_LBF_S])
def test_units(system, tmp_path):
    assert SYSTEMS[system.name] is system
    L, m, F = system.length, system.mass, system.force
    scale = {"E": 2.1e11 * F / L**2, "rho": 7850 * m / L**3, "A": 1e-3 * L**2, "I": 2e-6 * L**4}
    text = (
        HEAD
        + f"GRID,1\nGRID,2,,{L!r}\nGRID,3,,{2 * L!r}\n"
        + BARS
        + "PBAR,1,1,{A:.9E},{I:.9E},1.\nMAT1,1,{E:.9E},,.3,{rho:.9E}\n".format(**scale)
        + CLAMP
        + f"CONM2,9,3,,{3 * m:.9E}\nCELAS2,5,{4e3 * F / L:.9E},3,2\nENDDATA\n"
    )
    path = tmp_path / "deck.bdf"
    path.write_text(text)
    beam = read_beam(path, "nastran", Choices(system=system)).beam
    np.testing.assert_allclose(beam.x, [0, 1, 2])
    np.testing.assert_allclose(beam.bending_stiffness, 4.2e5)
    np.testing.assert_allclose(beam.mass_per_length, 7.85)
    mass, spring = beam.attachments
    assert (mass.mass, spring.translational) == pytest.approx((3.0, 4e3))


def test_the_command_line_knows_all_units(tmp_path):
    (tmp_path / "deck.bdf").write_text(HEAD + GRIDS + BARS + PBAR + MAT1 + CLAMP + "ENDDATA\n")
    for name, system in SYSTEMS.items():
        ended = run("convert", tmp_path / "deck.bdf", tmp_path / "b.toml", "--units", name)
        assert ended.code == 0
        assert system.words in ended.err


def test_pounds_and_inches_are_exact():
    # 1 lbf s^2/in is 175.126835 kg, 1 slug 14.593903 kg; 1 lbf 4.4482216152605 N
    assert 1 / IN_LBF_S.mass == pytest.approx(175.12683524647636, rel=1e-14)
    assert 1 / FT_LBF_S.mass == pytest.approx(14.593902937206364, rel=1e-14)
    for system in (IN_LBF_S, FT_LBF_S):
        assert 1 / system.force == pytest.approx(4.4482216152605, rel=1e-14)
    assert 1 / MM_KG_MS.force == pytest.approx(1e3)
