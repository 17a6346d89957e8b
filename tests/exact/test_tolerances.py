"""What varies inside segments: tolerances kept, estimates honest, order as stated."""

import numpy as np
import pytest
from validation.tolerances import faults, judge, ratios

import antinode as an
import hp_beam
from antinode.beam.ends import Ends
from antinode.riccati.roots import find_eigenvalues
from law_chains import bending_chain
from tables import draw_beam

SEED, CASES = 2027, 10
STEEP_ENDS = (("clamped", "free"), ("free", "free"), ("pinned", "pinned"), ("sliding", "clamped"))


@pytest.fixture(scope="module")
def rows():
    """Every mode of some random steep tables at three tolerances, beside hp elements."""
    return [row for case in range(CASES) for row in judge(SEED, case)]


def test_every_mode_keeps_the_tolerance_and_its_error_bound(rows):
    assert len(rows) > 300
    assert list(faults(rows)) == []


def test_estimates_are_neither_timid_nor_wild(rows):
    ratio = ratios(rows)
    assert len(ratio) > 250
    assert 0.5 < np.median(ratio) < 10


def test_the_reference_has_converged(rows):
    assert max(row.spread for row in rows) < 1e-11


@pytest.mark.parametrize("interpolation", ["log", "linear"])
@pytest.mark.parametrize("ends", STEEP_ENDS)
def test_three_decades_of_m_EI_and_N_to_1e_8(interpolation, ends):
    x = np.array([0, 1.0, 2.5, 3.1, 4.9, 6.2, 7.5, 9.0])  # eight control points
    m = 10 ** np.array([3, 2.2, 2.6, 1.0, 0.4, 0.9, 0.0, 1.1])
    EI = 1e4 * 10 ** np.array([2.6, 3, 1.8, 2.1, 1.0, 0, 0.7, 0.2])
    N = 10 ** np.array([3, 2.5, 2.9, 1.8, 1.2, 0.8, 0.3, 0.0])
    N = -N if ends[0] == "free" else N
    beam = an.Beam.from_stations(
        x, m, EI, axial_force=N, interpolation=interpolation, ends=Ends(*ends)
    )
    result = an.solve_modes(beam, 6, tolerance=1e-8)
    modes = sorted(result.modes, key=lambda mode: mode.bracket_omega2)
    exact = hp_beam.reference(beam, len(modes))
    elastic = [k for k, mode in enumerate(modes) if mode.omega2 != 0.0]
    assert len(elastic) >= 6
    for k in elastic:
        error = abs(modes[k].omega2 / exact.omega2[k] - 1) / 2
        assert exact.spread[k] < 1e-11
        assert error <= 1e-8
        assert abs(modes[k].omega2 - exact.omega2[k]) <= modes[k].error_omega2


def _midpoint_chain(beam, steps):
    """The same beam as uniform segments with the values at their middles."""
    n = len(beam.x) - 1
    k, t = np.repeat(np.arange(n), steps), np.tile((np.arange(steps) + 0.5) / steps, n)
    return bending_chain(
        length=np.diff(beam.x)[k] / steps,
        mass=beam.column_at("mass_per_length", k, t),
        stiffness=beam.column_at("bending_stiffness", k, t),
        force=beam.axial_force_at(k, t),
        left=beam.ends.left,
        right=beam.ends.right,
    )


@pytest.mark.parametrize("interpolation", ["log", "linear"])
def test_order_two_for_midpoint_segments_and_four_for_two_halves(interpolation):
    beam = an.Beam.from_stations(
        [0, 2, 5], [30, 10, 20], [4e4, 1e4, 3e4], axial_force=[500, 0, -800],
        interpolation=interpolation, ends=Ends("clamped", "free"),
    )  # fmt: skip
    exact = hp_beam.eigenvalues(beam, 4)

    def orders(chains):
        found = [[v.omega2 for v in find_eigenvalues(c, 4, width=1e-11)] for c in chains]
        errors = np.abs(np.array(found) / exact - 1)
        return np.log2(errors[:-1] / errors[1:])

    midpoint = orders([_midpoint_chain(beam, steps) for steps in (16, 32, 64)])
    halves = orders([beam.chain("bending", refinement) for refinement in (1, 2, 4)])
    assert np.all(np.abs(midpoint - 2) < 0.1)
    assert np.all(np.abs(halves - 4) < 0.25)


@pytest.mark.parametrize(
    ("interpolation", "ratio"),
    [
        ("log", 14.0),
        ("log", 1e3),
        ("log", 1e18),
        ("linear", 14.0),
        ("linear", 1e3),
        ("linear", 1e9),
    ],
)
def test_averages_stay_positive_however_steep(interpolation, ratio):
    beam = an.Beam.from_stations(
        [0, 1, 2], [1, ratio, 1], [ratio, 1, ratio], [1, ratio, 1], interpolation=interpolation
    )
    for family in ("bending", "longitudinal"):
        chain = beam.chain(family)
        assert np.all(chain.mass > 0)
        assert np.all(chain.stiffness > 0)
        assert np.sum(chain.length) == pytest.approx(beam.length, rel=1e-12)
        assert len(chain.length) < 600
        finer = beam.chain(family, 2)
        assert np.sum(finer.mass * finer.length) == pytest.approx(beam.mass, rel=1e-2)


def test_only_what_varies_is_refined():
    beam = an.Beam.from_stations([0, 1, 2, 3], [1, 1, 8, 8], 1.0, interpolation="linear")
    chain, finer = (beam.chain("bending", refinement) for refinement in (1, 4))
    inside = chain.nodes[1:-1]
    assert not np.any((inside > 0) & (inside < 0.999))
    assert not np.any(inside > 2.001)
    assert len(finer.length) - 2 == 4 * (len(chain.length) - 2)


@pytest.mark.parametrize("modes", [1, 60])
def test_an_extreme_tolerance_ends_with_an_answer_or_a_warning(modes):
    beam = draw_beam(SEED, 2)
    result = an.solve_modes(beam, modes, tolerance=1e-12, families=("bending",))
    elastic = [mode for mode in result.modes if mode.number]
    worst = max(mode.error_hz / mode.frequency_hz for mode in elastic if mode.omega2 > 0)
    warned = any("do not reach the tolerance" in text for text in result.warnings)
    assert len(elastic) >= modes
    assert worst < 1e-9 or warned
