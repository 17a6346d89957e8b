"""The compiled chain against the readable one, lane by lane, and against many digits."""

import numpy as np
import pytest

from antinode.beam.beam import Beam
from antinode.beam.representation import LIMITS
from antinode.riccati import chain as readable
from antinode.riccati import roots
from antinode.riccati.chain import omega2_scale
from antinode.riccati.chains import Chains
from antinode.riccati.lanes import bending, levels, pieces, workspace
from antinode.riccati.lanes import calls as compiled
from antinode.riccati.laws import BAR, SHAFT
from antinode.riccati.points import Point
from antinode.riccati.segment import fundamental
from chains import draw_resonance, kept_case
from law_chains import bar_chain, bending_chain, shaft_chain
from reference import certain_count

ENDS = tuple(bending.ENDS)


def random_chain(rng, points):
    """1 to 200 segments, steps up to 1e6 in EI, N from strong tension to far past buckling."""
    n = int(np.exp(rng.uniform(0, np.log(200))))
    h = np.exp(rng.uniform(-1.5, 1.5, n))
    h *= 10 ** rng.uniform(-1, 2) / h.sum()
    EI = 10 ** rng.uniform(2, 8) * 10 ** (rng.uniform(-3, 3, n) * rng.choice([0, 0.2, 1]))
    m = 10 ** rng.uniform(0, 3) * 10 ** (rng.uniform(-2, 2, n) * rng.choice([0, 0.3, 1]))
    N = rng.uniform(-1, 1, n) * 10 ** rng.uniform(-2, 2.5) * np.median(EI) / h.sum() ** 2
    left, right = map(str, rng.choice(ENDS, 2))
    at = rng.choice(np.arange(n + 1), size=min(n, 3), replace=False) if points else []
    total = float(np.sum(m * h)), float(np.sum(h)), float(np.median(EI))
    what = tuple(random_point(rng, int(node), 0 < node < n, *total) for node in sorted(at))
    return bending_chain(h, m, EI, N, left, right, points=what)


def random_point(rng, node, inner, M, L, EI):
    mass = rng.choice([0, 0.3]) * M
    return Point(
        node,
        mass=mass,
        offset=rng.uniform(-0.1, 0.1) * L,
        inertia=rng.choice([0, 0.01]) * M * L * L,
        spring=rng.choice([0, 0, 1, 1e4, -5]) * EI / L**3,
        rotational_spring=rng.choice([0, 0, 1, 1e4]) * EI / L,
        holds=[(), (), (0,), (1,), (0, 1)][rng.integers(5)] if inner else (),
        compliance=rng.choice([0, 0.1, 3]) * L / EI if inner else 0.0,
        own_load=rng.choice([0, 5]) * EI / L**2 if mass else 0.0,
    )


WAVE_ENDS = [(left, right) for left in ("free", "fixed") for right in ("free", "fixed")]


def random_wave(rng, make, ends, points):
    chain = random_chain(rng, False)
    n, L = len(chain.length), float(np.sum(chain.length))
    M, EA = float(chain.mass @ chain.length), float(np.median(chain.stiffness))
    at = sorted(rng.choice(np.arange(n + 1), size=min(n, 3), replace=False)) if points else []
    what = tuple(
        Point(
            int(node),
            mass=rng.choice([0, 0.3]) * M,
            spring=rng.choice([0, 1, 1e4]) * EA / L,
            compliance=rng.choice([0, 0.1, 3]) * L / EA if 0 < node < n else 0.0,
        )
        for node in at
    )
    return make(chain.length, chain.mass, chain.stiffness, *ends, what)


NUMBERS = ("length", "mass", "stiffness", "axial_force")


@pytest.mark.parametrize("points", [False, True])
@pytest.mark.parametrize("ends", WAVE_ENDS)
@pytest.mark.parametrize("make", [bar_chain, shaft_chain])
def test_bars_and_shafts_agree_with_the_readable_form(make, ends, points):
    rng = np.random.default_rng([WAVE_ENDS.index(ends), points])
    for _ in range(30):
        bar = random_wave(rng, make, ends, points)
        size = omega2_scale(bar)
        omega2 = size * np.concatenate(
            [10 ** rng.uniform(-2, 4, 11), -(10 ** rng.uniform(-2, 3, 6))]
        )
        fast, slow = compiled.evaluate(bar, omega2), readable.evaluate(bar, omega2)
        assert fast.below.tolist() == slow.below.tolist()
        assert np.sign(fast.characteristic).tolist() == np.sign(slow.characteristic).tolist()
        held = ends != ("free", "free") or any(p.spring for p in bar.points)
        found, expected = (
            how.find_eigenvalues(bar, 7, zeros=0 if held else 1) for how in (compiled, roots)
        )
        assert [v.index for v in found] == [v.index for v in expected]
        for mine, theirs in zip(found, expected, strict=True):
            assert mine.counts == theirs.counts
            assert mine.omega2 == pytest.approx(theirs.omega2, rel=1e-10, abs=1e-12 * size)


@pytest.mark.parametrize("ends", WAVE_ENDS)
@pytest.mark.parametrize("law", [BAR, SHAFT])
def test_batches_of_bars_and_shafts_are_those_of_each_by_itself(law, ends):
    rng, below = np.random.default_rng(WAVE_ENDS.index(ends)), int(ends == ("free", "free"))
    h, (m, stiffness) = rng.uniform(0.5, 1.5, (1, 9)), rng.uniform(0.5, 1.5, (2, 70, 9))
    m[3, 2], stiffness[5] = np.nan, 1e-9
    chains = Chains(law, h, m, stiffness, np.zeros((70, 9)), *ends)
    found = compiled.solve_chains(chains, below, 5, 1e-10)
    assert np.flatnonzero(found.reason).tolist() == [3]
    for row in (0, 1, 2, 4, 5, 6, 69):
        expected = roots.find_eigenvalues(chains[row], below + 5, zeros=below)[below:]
        assert found.omega2[row] == pytest.approx([v.omega2 for v in expected], rel=1e-10)
        assert found.counts[row].tolist() == [list(v.counts) for v in expected]


@pytest.mark.parametrize("points", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_counts_and_signs_agree_with_the_readable_form(seed, points):
    """100 chains of 17 lanes each: no difference."""
    rng = np.random.default_rng([seed, points])
    for _ in range(100):
        chain = random_chain(rng, points)
        size = omega2_scale(chain)
        omega2 = size * np.concatenate(
            [10 ** rng.uniform(-2, 5.5, 11), -(10 ** rng.uniform(-2, 5, 6))]
        )
        fast, slow = compiled.evaluate(chain, omega2), readable.evaluate(chain, omega2)
        assert fast.below.tolist() == slow.below.tolist()
        assert np.sign(fast.characteristic).tolist() == np.sign(slow.characteristic).tolist()


def as_chain(case):
    given = case.chain
    h, EI, m, N = (np.array(column) for column in (given.h, given.EI, given.m, given.N))
    return bending_chain(h, m, EI, N, given.left, given.right)


@pytest.mark.parametrize("index", range(60))
def test_counts_agree_with_many_digits(index):
    """omega^2 in gaps between eigenvalues, below the first, and below zero."""
    case = kept_case(515, index)
    below = compiled.evaluate(as_chain(case), [case.omega2]).below[0]
    assert below == certain_count(case.chain, case.omega2).count


@pytest.mark.parametrize("index", range(20))
def test_counts_at_resonances_of_parts(index):
    """Where det A of a part vanishes to the last digit, and one step beside it."""
    for case in draw_resonance(515, index):
        below = compiled.evaluate(as_chain(case), [case.omega2]).below[0]
        assert below == certain_count(case.chain, case.omega2).count


def test_the_series_are_products_of_the_readable_ones():
    """The minors of a transfer matrix, from g: ``2 G0 = g'^2 - g g''`` and so on."""
    rng = np.random.default_rng(3)
    limit = pieces.STEP
    n = rng.uniform(-1, 1, 200) * limit**2 / 2
    c = rng.uniform(-1, 1, 200) * (limit**2 / 2) ** 2
    powers = (2 * c[:, None]) ** np.arange(pieces.IN_C), n[:, None] ** np.arange(pieces.IN_N)
    G = np.einsum("mji,kj,ki->mk", pieces.SERIES, *powers)
    g, g1, g2, g3 = fundamental(np.ones(200), n, c)
    assert np.allclose(2 * G[0], g1**2 - g * g2, rtol=3e-14, atol=0)
    assert np.allclose(2 * G[1], g1 * g2 - g * g3, rtol=3e-14, atol=0)
    assert np.allclose(G[3] + n * G[1], g2 * g3 - c * g * g1 + n * g1 * g2, rtol=3e-14, atol=0)


def test_a_hopeless_omega2_is_refused():
    one = np.ones(3)
    with pytest.raises(FloatingPointError, match="out of reach"):
        compiled.evaluate(bending_chain(one, one, one * 1e-9, one), [1e30])


def test_bars_and_held_ends_go_the_readable_way():
    one = np.ones(3)
    bar = bar_chain(one, one, one)
    assert (
        compiled.evaluate(bar, [2.0]).below.tolist() == readable.evaluate(bar, [2.0]).below.tolist()
    )
    held = bending_chain(one, one, one, 0 * one, points=(Point(0, holds=(0,)),))
    expected = readable.evaluate(held, [2.0, 50.0]).below.tolist()
    assert compiled.evaluate(held, [2.0, 50.0]).below.tolist() == expected


@pytest.mark.parametrize("interpolation", ["log", "linear"])
@pytest.mark.parametrize("refinement", [1, 3])
@pytest.mark.parametrize("acceleration", [0.0, 30.0])
def test_half_segments_are_those_of_the_beam(interpolation, refinement, acceleration):
    rng, n = np.random.default_rng(8), 9
    x = np.cumsum(rng.uniform(0.1, 2, n + 1))
    m, EI = 10 ** rng.uniform(0, 2, (n, 2)), 10 ** rng.uniform(3, 6, (n, 2))
    m[2], EI[2] = m[2, 0], EI[2, 0]
    N = rng.uniform(-5, 5, (n, 2))
    N[2] = N[2, 0]
    more = {"interpolation": interpolation, "axial_acceleration": acceleration}
    beam = Beam(x, m, EI, axial_force=N, **more)
    own = workspace.new_levels(0, n, 999, np.empty((0, 0)), 1)
    own.x[:], own.mass[:], own.stiffness[:], own.force[:] = x, m, EI, N
    own.mass_left[:] = beam.mass_left
    interior = workspace.Interior(0, 0, acceleration, 0.0, 0.0, interpolation == "log", *LIMITS)
    levels.mark_varying(own, acceleration)
    number = levels.coarsest_steps(own, interior)
    found = levels.make_halves(own, interior, number, refinement)
    chain = beam.chain("bending", refinement)
    assert found == len(chain.length)
    mine = own.chain.length, own.chain.mass, own.chain.stiffness, own.chain.force
    for values, name in zip(mine, NUMBERS, strict=True):
        assert values[:found] == pytest.approx(getattr(chain, name), rel=1e-13)
    ends = x[0] + np.concatenate([[0.0], np.cumsum(chain.length)])
    assert ends[own.first] == pytest.approx(x, rel=1e-12)
