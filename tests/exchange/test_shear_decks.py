"""Decks with shear, rotary inertia, foundations and added mass: solved, and read again."""

import numpy as np
import pytest

from antinode import solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.exchange.calculix import write_calculix
from antinode.exchange.inputs import Choices, read_beam
from antinode.exchange.nastran.writer import write_nastran
from antinode.exchange.units import IN_LBF_S, MM_T_S, SI
from exchange.solvers import expected, needs_ccx, needs_mystran, run_ccx, run_mystran, worst
from exchange.test_decks_of_others import BARS, CLAMP, GRIDS, MAT1, PBAR, read
from exchange.test_solvers import off

SHEAR = {"shear_stiffness": [2e5, 2e5]}
ROTARY = {"rotary_inertia_per_length": [0.048, 0.048]}
BED = {"foundation_stiffness": [3e3, 3e3]}
WATER = {"added_mass_per_length": [5.0, 5]}
EVERY = SHEAR | ROTARY | BED | WATER
COLUMNS = {
    "shear": SHEAR,
    "shear by Engesser": SHEAR | {"shear_form": "engesser"},
    "rotary inertia": ROTARY,
    "foundation and water": BED | WATER,
    "all": EVERY,
}
ANALYSES = ["modes", "unloaded", "buckling"]
TWIST = {"torsional_stiffness": [1e4, 1e4], "polar_inertia_per_length": [0.03, 0.03]}


def column(force=2000.0, **columns):
    """A clamped column of 4 m; shear takes 1 % of mode 1, and 20 % of mode 3."""
    beam = Beam.from_stations(
        [0.0, 4.0], [8.0, 8], [4e4, 4e4], [2e7, 2e7], [force, force],
        ends=Ends("clamped", "free"), **columns,
    )  # fmt: skip
    return solve_modes(beam, 3, tolerance=1e-8, unloaded=True)


def stepped():
    """A beam of three spans in both, with a joint, springs and masses."""
    beam = Beam.from_stations(
        [0.0, 1.0, 2.5, 4.0], [8.0, 6, 9, 9], [4e4, 5e4, 3e4, 3e4], [2e7, 2e7, 1e7, 1e7],
        [900.0, 400, 700, 0], ends=Ends("pinned", "sliding", "fixed", "free"),
        shear_stiffness=[3e5, np.inf, 2e5, 2e5], rotary_inertia_per_length=[0.02, 0.0, 0.03, 0.03],
        foundation_stiffness=[0.0, 2e3, 1e3, 1e3], added_mass_per_length=[2.0, 0, 0, 0],
    )  # fmt: skip
    items = PointMass(0.7, 3.0, 0.02, 0.1), Spring(1.9, 2e4, 3e3, 1e5), Joint(2.2, 2e-5, 3e-8)
    return solve_modes(beam.with_attachments(*items), 3, unloaded=True)


@needs_mystran
class TestMystran:
    @pytest.mark.parametrize("analysis", ANALYSES)
    @pytest.mark.parametrize("what", COLUMNS)
    def test_finds_what_a_deck_expects(self, what, analysis, tmp_path):
        path = tmp_path / "deck.bdf"
        write_nastran(path, column(**COLUMNS[what]), MM_T_S, analysis)
        assert worst(run_mystran(path), expected(path)) < 2e-6

    @pytest.mark.parametrize("analysis", ["modes", "buckling"])
    def test_steps_joints_and_springs(self, analysis, tmp_path):
        path = tmp_path / "deck.bdf"
        write_nastran(path, stepped(), SI, analysis)
        assert worst(run_mystran(path), expected(path)) < 2e-6


@needs_ccx
class TestCalculix:
    @pytest.mark.parametrize("analysis", ANALYSES)
    @pytest.mark.parametrize("what", ["shear", "shear by Engesser", "foundation and water", "all"])
    def test_finds_what_a_deck_expects(self, what, analysis, tmp_path):
        path = tmp_path / "deck.inp"
        write_calculix(path, column(**COLUMNS[what]), IN_LBF_S, analysis)
        assert worst(run_ccx(path), expected(path)) < off(path)

    @pytest.mark.parametrize("analysis", ["modes", "buckling"])
    def test_steps_joints_and_springs(self, analysis, tmp_path):
        path = tmp_path / "deck.inp"
        write_calculix(path, stepped(), SI, analysis)
        assert worst(run_ccx(path), expected(path)) < off(path)

    def test_the_rotary_inertia_of_solids_is_said(self, tmp_path):
        notes = write_calculix(tmp_path / "deck.inp", column(**ROTARY))
        assert any("0.333 to 0.333 times the rotary inertia" in note for note in notes)
        same = column(rotary_inertia_per_length=[0.016, 0.016])
        assert not any("times" in note for note in write_calculix(tmp_path / "deck.inp", same))
        lossy = write_calculix(tmp_path / "deck.inp", column(loss_factor=[0.1, 0.1]))
        assert any("loss_factor is left out" in note for note in lossy)


@pytest.mark.parametrize("writer", [write_nastran, write_calculix])
def test_a_deck_states_the_modes_of_its_beam_nearly(writer, tmp_path):
    """The mesh, a computation of its own, agrees with the exact beam, shear and all."""
    for form in ("haringx", "engesser"):
        path = tmp_path / "deck"
        writer(path, column(shear_form=form, **SHEAR, rotary_inertia_per_length=[0.016] * 2))
        for name, mesh, beam in expected(path)[:3]:
            assert mesh == pytest.approx(beam, rel=4e-3 if writer is write_calculix else 2e-4), name
    for form in ("haringx", "engesser"):
        write_nastran(path, column(shear_form=form, **SHEAR), SI, "buckling")
        ((_, mesh, beam),) = expected(path)
        assert mesh == pytest.approx(beam, rel=5e-4)


@pytest.mark.parametrize("analysis", ["modes", "unloaded", "statsub"])
@pytest.mark.parametrize("what", COLUMNS)
def test_a_deck_comes_back(what, analysis, tmp_path):
    path = tmp_path / "deck.bdf"
    result = column(**COLUMNS[what], **TWIST, loss_factor=[0.02, 0.02])
    write_nastran(path, result, MM_T_S, analysis)
    beam = read_beam(path, "nastran", Choices(system=MM_T_S)).beam
    own = result.beam.without_axial_force() if analysis == "unloaded" else result.beam
    wanted = solve_modes(own, 3)
    np.testing.assert_allclose(beam.loss_factor, 0.02)
    assert beam.attachments == ()
    for family in ("bending", "longitudinal", *["torsion"] * (analysis != "statsub")):
        found = solve_modes(beam, 3, families=[family]).frequencies_hz(family)
        assert found == pytest.approx(wanted.frequencies_hz(family), rel=1e-9)


def test_a_stepped_deck_comes_back(tmp_path):
    path = tmp_path / "deck.bdf"
    write_nastran(path, stepped())
    beam = read_beam(path, "nastran", Choices()).beam
    assert len(beam.attachments) == 5  # the spring as one in each freedom
    found, wanted = (solve_modes(b, 3).frequencies_hz() for b in (beam, stepped().beam))
    assert found == pytest.approx(wanted, rel=5e-5)  # lumps are spread over elements


class TestDecksOfOthers:
    def test_shear_that_a_card_gives_counts(self, tmp_path):
        pbar = "PBAR,1,1,1.-3,2.-6,3.-6,,0.5\n,,,,,,,,\n,.4,.6\n"
        G = 2.1e11 / 2.6
        for plane, K, I in ((1, 0.4, 2e-6), (2, 0.6, 3e-6)):  # noqa: E741
            beam, notes = read(tmp_path, GRIDS, BARS, pbar, MAT1, CLAMP, plane=plane)
            np.testing.assert_allclose(beam.shear_stiffness, K * G * 1e-3)
            np.testing.assert_allclose(beam.rotary_inertia_per_length, 7850 * I)
            assert beam.is_timoshenko
            assert not any("K1" in note for note in notes)
        skew = pbar.replace(",.4,.6", ",.4,.6,1.-9")
        held = GRIDS.replace("GRID,1", "GRDSET,,,,,,,345\nGRID,1")
        assert read(tmp_path, held, BARS, skew, MAT1, CLAMP)[0].shear_stiffness is None

    def test_shear_by_default_stands_there(self, tmp_path):
        tube = "PBARL,1,1,,TUBE\n,0.1,0.09\n"
        beam, notes = read(tmp_path, GRIDS, BARS, tube, MAT1, CLAMP)
        area = np.pi * (0.1**2 - 0.09**2)
        np.testing.assert_allclose(beam.shear_stiffness, 0.5338 * 2.1e11 / 2.6 * area, rtol=2e-3)
        assert beam.theory == "euler_bernoulli"
        assert any("--set beam.theory=timoshenko" in note for note in notes)
        path = tmp_path / "deck.bdf"
        counted = read_beam(path, "nastran", Choices(("beam.theory=timoshenko",))).beam
        assert counted.is_timoshenko
        f = [solve_modes(b, 1).frequencies_hz()[0] for b in (beam, counted)]
        assert 0.98 < f[1] / f[0] < 0.999

    def test_a_loss_factor_of_the_material(self, tmp_path):
        beam, _ = read(tmp_path, GRIDS, BARS, PBAR, MAT1.replace("7850.", "7850.,,,.03"), CLAMP)
        np.testing.assert_allclose(beam.loss_factor, 0.03)

    def test_springs_at_every_grid_of_many_are_a_foundation(self, tmp_path):
        for n, spread in ((60, True), (10, False)):
            grids = "".join(f"GRID,{k + 1},,{k / n * 2:.12f}\n" for k in range(n + 1))
            bars = "".join(f"CBAR,{k},1,{k},{k + 1},0.,1.,0.\n" for k in range(1, n + 1))
            half = [0.5 if k in (0, n) else 1.0 for k in range(n + 1)]
            beds = "".join(
                f"CELAS2,{k + 500},{h * 2e4 / n:.6f},{k + 1},2\n" for k, h in enumerate(half)
            )
            beam, _ = read(tmp_path, grids, bars, PBAR, MAT1, CLAMP, beds)
            assert (beam.foundation_stiffness is not None) == spread
            if spread:
                np.testing.assert_allclose(beam.foundation_stiffness, 1e4, rtol=1e-6)
            else:
                assert len(beam.attachments) == n + 1
