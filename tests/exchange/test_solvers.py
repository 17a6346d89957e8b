"""Every kind of deck, solved by MYSTRAN and by CalculiX: they find what the deck's head says."""

import numpy as np
import pytest

from antinode import solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.exchange.calculix import write_calculix
from antinode.exchange.nastran.writer import write_nastran
from antinode.exchange.units import IN_LBF_S, MM_T_S, SI
from exchange.conversions import EXAMPLES, solved
from exchange.solvers import expected, needs_ccx, needs_mystran, run_ccx, run_mystran, worst

NAMES = (*EXAMPLES, "everything")
HELD = ("tower", "beam", "drill_string", "everything")
KINDS = [(name, "modes") for name in NAMES] + [(name, "buckling") for name in HELD]
KINDS += [("starter", "unloaded"), ("tower", "unloaded")]


def column(*attachments, ends=("clamped", "free"), force=2000.0):
    """A uniform beam under a constant force."""
    beam = Beam.from_stations(
        [0.0, 4.0], [8.0, 8], [4e4, 4e4], [2e7, 2e7], [force, force], ends=Ends(*ends)
    )
    return solve_modes(beam.with_attachments(*attachments), 3, unloaded=True)


COLUMNS = {
    "a spring sideways": (Spring(1.9, 2e4),),
    "a spring that turns": (Spring(1.9, rotational=3e3),),
    "a spring along x": (Spring(1.9, axial=1e5),),
    "a mass": (PointMass(0.7, 3.0),),
    "a mass with inertia beside its station": (PointMass(4.0, 3.0, 0.02, -0.1),),
    "a hinge": (Joint(2.2, 2e-5),),
    "a joint that gives along x": (Joint(2.2, 0.0, 3e-8),),
    "an inner support": (Spring(3.1, translational=np.inf),),
    "a support at a joint": (Joint(2.2, 2e-5), Spring(2.2, translational=np.inf)),
}
ENDS = [
    ("pinned", "pinned"),
    ("pinned", "pinned", "free", "fixed"),
    ("clamped", "clamped", "fixed", "fixed"),
    ("clamped", "sliding"),
    ("free", "clamped"),
]


@needs_mystran
class TestMystran:
    @pytest.mark.parametrize(("name", "analysis"), KINDS)
    def test_finds_what_a_deck_expects(self, name, analysis, tmp_path):
        path = tmp_path / "deck.bdf"
        write_nastran(path, solved(name), SI, analysis)
        assert worst(run_mystran(path), listed(path)) < 2e-6

    @pytest.mark.parametrize("what", COLUMNS)
    @pytest.mark.parametrize("analysis", ["modes", "buckling"])
    def test_each_attachment(self, what, analysis, tmp_path):
        path = tmp_path / "deck.bdf"
        write_nastran(path, column(*COLUMNS[what]), MM_T_S, analysis)
        assert worst(run_mystran(path), expected(path)) < 2e-6

    @pytest.mark.parametrize("ends", ENDS)
    def test_each_end(self, ends, tmp_path):
        path = tmp_path / "deck.bdf"
        write_nastran(path, column(ends=ends), IN_LBF_S)
        assert worst(run_mystran(path), expected(path)) < 2e-6


@needs_ccx
class TestCalculix:
    @pytest.mark.parametrize(("name", "analysis"), KINDS)
    def test_finds_what_a_deck_expects(self, name, analysis, tmp_path):
        path = tmp_path / "deck.inp"
        write_calculix(path, solved(name), SI, analysis)
        assert worst(run_ccx(path), listed(path)) < off(path)

    @pytest.mark.parametrize("what", COLUMNS)
    @pytest.mark.parametrize("analysis", ["modes", "unloaded", "buckling"])
    def test_each_attachment(self, what, analysis, tmp_path):
        path = tmp_path / "deck.inp"
        write_calculix(path, column(*COLUMNS[what]), MM_T_S, analysis)
        assert worst(run_ccx(path), expected(path)) < off(path)

    @pytest.mark.parametrize("ends", ENDS)
    def test_each_end(self, ends, tmp_path):
        path = tmp_path / "deck.inp"
        write_calculix(path, column(ends=ends), IN_LBF_S)
        assert worst(run_ccx(path), expected(path)) < off(path)


def listed(path):
    """What a deck expects of the modes that it asks for."""
    text = path.read_text()
    beyond = [line for line in text.splitlines() if "that are asked for:" in line]
    names = beyond[0].partition("for: ")[2].split(", ") if beyond else []
    return [row for row in expected(path) if row[0] not in names]


def off(path):
    """How far CalculiX may be off: what the deck says of the strain, besides its own digits."""
    said = [line for line in path.read_text().splitlines() if "be off by its strain" in line]
    return 3e-5 + (float(said[0].split()[-1]) if said else 0.0)
