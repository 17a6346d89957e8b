"""Every way of solving against 32 digits (record: validation/all_ways.md), and the reference."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from validation.all_ways import Row, faults, judge, study_rows

import antinode as an
from all_beams import FORCES, INTERPOLATIONS, draw, kind_of
from many_digits import ManyDigits, critical_load, eigenvalue
from reference import BeamChain, uniform_beam_roots
from reference import eigenvalue as proven

CASES = range(0, 1000, 19)  # 19 shares no divisor with the periods of the kinds
BLOCKS = 4  # so that two processes share the work


@pytest.mark.parametrize("block", range(BLOCKS))
def test_every_nineteenth_of_the_record(block):
    """13 or 14 of 53 beams: no error above the stated one, no mode missing or made up."""
    rows = [row for case in CASES[block::BLOCKS] for row in judge(2026, case)]
    assert list(faults(rows)) == []
    assert len(rows) > 200
    ways = {row.way for row in rows if not row.words}
    assert ways >= {
        "solve_modes, numpy",
        "natural_frequencies, numba",
        "solve_many, numba",
        "buckling",
    }


def test_the_part_has_beams_of_every_kind():
    assert {kind_of(case) for case in CASES} == set(product(INTERPOLATIONS, FORCES))


def test_an_error_that_is_too_small_is_a_fault():
    row = Row(0, "way", 1, 1e-6, 2.0, 0.1, 2.2)
    assert row.ratio == pytest.approx(2.0)
    assert len(list(faults([row, row._replace(error=0.3)]))) == 1
    assert len(list(faults([row._replace(error=0.0, value=2.2)]))) == 0


@pytest.mark.parametrize(("left", "right"), [("clamped", "clamped"), ("free", "pinned")])
def test_the_reference_meets_closed_forms(left, right):
    one = an.Beam.from_stations([0, 1], 1.0, 1.0, interpolation="linear", ends=an.Ends(left, right))
    roots = [x for x in uniform_beam_roots(left, right, 6) if x > 0]
    rigid = 6 - len(roots)
    exact = ManyDigits(one, 2e6)
    for k, root in enumerate(roots):
        found = eigenvalue(exact, rigid + k + 1, float(root) ** 4 * (1 + 1e-9))
        assert found == pytest.approx(float(root**4), rel=3e-16)


@pytest.mark.parametrize("index", [3, 18, 36])
def test_the_reference_meets_proven_eigenvalues_of_chains(index):
    beam = replace(draw(2026, index), attachments=())
    tables = (beam.bending_stiffness, beam.mass_per_length, beam.axial_force)
    chain = BeamChain(
        tuple(np.diff(beam.x).tolist()), *(tuple(t[:, 0].tolist()) for t in tables),
        beam.ends.left, beam.ends.right
    )  # fmt: skip
    for k in (3, 5):
        true = float(proven(chain, k))
        exact = ManyDigits(beam, 1.1 * abs(true))
        assert eigenvalue(exact, k, true * (1 + 1e-8)) == pytest.approx(true, rel=1e-15)


@pytest.mark.parametrize("index", [7, 13, 22, 38, 46])
def test_the_reference_agrees_with_itself_on_finer_pieces(index):
    beam = draw(2026, index)
    first = eigenvalue(ManyDigits(beam, _top(beam)), 5, _top(beam) / 2)
    finer = eigenvalue(ManyDigits(beam, _top(beam), fineness=1.7), 5, _top(beam) / 2)
    assert finer == pytest.approx(first, rel=4e-16)


def _top(beam):
    result = an.solve_modes(beam, 4, families=("bending",))
    return 2 * max(abs(mode.omega2) for mode in result.modes)


def test_the_reference_of_a_column_is_Euler():
    one = an.Beam.from_stations([0, 2], 1.0, 3.0, None, 5.0, ends=an.Ends("pinned", "pinned"))
    euler = math.pi**2 * 3.0 / 4 / 5.0
    assert critical_load(one, (), euler * (1 + 1e-5)) == pytest.approx(euler, rel=1e-15)


def test_a_sweep_states_true_errors():
    rows = study_rows(number=8)
    assert len(rows) > 20
    assert list(faults(rows)) == []
