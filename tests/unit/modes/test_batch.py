"""Batches: against single solves and closed forms, past buckling, failures, certificates."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import antinode as an
from antinode.beam.families import FAMILIES
from antinode.modes.batch import REASONS
from antinode.riccati.reasons import INVALID

ENDS = ("free", "clamped", "pinned", "sliding")


def random_batch(rng, left, right, beams=12, segments=15, modes=5):
    h = rng.uniform(0.5, 1.5, segments)
    m = rng.uniform(1, 3, (beams, segments))
    EI = 1e3 * rng.uniform(1, 3, (beams, segments))
    N = rng.uniform(-1, 1, (beams, 1)) * rng.uniform(0, 4e3, (beams, segments)) / np.sum(h) ** 2
    return an.BeamBatch(h, m, EI, N, an.Ends(left, right), modes)


def single(batch, row):
    x = np.concatenate([[0.0], np.cumsum(batch.length[0])])
    tables = (batch.mass_per_length, batch.bending_stiffness, batch.axial_force)
    m, EI, N = (table[row] for table in tables)
    beam = an.Beam.from_stations(x, m, EI, None, N, ends=batch.ends)
    return an.solve_modes(beam, batch.modes)


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
def test_a_batch_is_its_single_solves(left, right):
    batch = random_batch(np.random.default_rng(7), left, right)
    result = an.solve_many(batch)
    assert not result.reason.any()
    for row in (0, 5, 11):
        modes = [mode for mode in single(batch, row).modes if mode.number > 0]
        expected = np.array([mode.omega2 for mode in modes[: batch.modes]])
        assert result.omega2[row] == pytest.approx(expected, rel=1e-10)
        assert result.counts[row].tolist() == [list(mode.counts) for mode in modes[: batch.modes]]


def test_certificates_and_brackets():
    result = an.solve_many(random_batch(np.random.default_rng(1), "free", "free", 300, 40, 8))
    index = np.arange(2, 10)
    assert np.all(result.counts == np.stack([index, index + 1], axis=1))
    low, high = np.moveaxis(result.bracket_omega2, -1, 0)
    assert np.all((low <= result.omega2) & (result.omega2 <= high))
    assert np.all(high - low <= 1e-10 * high)
    assert np.all(result.error_hz > 0)
    assert np.all(result.error_hz < 2e-10 * result.frequencies_hz)


@pytest.mark.parametrize("ends", [an.Ends(), an.Ends("clamped", "free", right_follower=0.5)])
def test_wide_brackets_hold_what_narrow_ones_hold(ends):
    """Found with fewer evaluations, and the root in them is as near."""
    batch = replace(random_batch(np.random.default_rng(3), "free", "free", 100, 30), ends=ends)
    narrow, wide = an.solve_many(batch), an.solve_many(batch, width=1e-6)
    low, high = np.moveaxis(wide.bracket_omega2, -1, 0)
    assert not narrow.reason.any()
    assert not wide.reason.any()
    assert np.all((low <= narrow.omega2) & (narrow.omega2 <= high))
    assert np.all(high - low <= 1e-6 * high)
    assert np.max(high / low - 1) > 1e-8
    assert np.mean(wide.evaluations) < 0.95 * np.mean(narrow.evaluations)
    np.testing.assert_allclose(wide.omega2, narrow.omega2, rtol=1e-10)


@pytest.mark.parametrize("width", [1e-11, 1e-5, np.nan, "narrow"])
def test_a_width_out_of_range_is_said(width):
    batch = random_batch(np.random.default_rng(3), "free", "free", 1)
    with pytest.raises(an.InputError, match=r"width is .*1e-10 \.\.\. 1e-06"):
        an.solve_many(batch, width=width)


@pytest.mark.parametrize("loads", [1, 2, 3])
def test_loads_alone_vary(loads):
    """Guesses between a few solves hold in every case; the answers are those of full solves."""
    rng, n = np.random.default_rng(loads), 30
    h, m, EI = np.full(n, 0.1), rng.uniform(1, 3, n), rng.uniform(1e3, 3e3, n)
    N = rng.uniform(-1, 1, (1600, loads)) @ rng.uniform(0, 700, (loads, n))
    fast = an.solve_many(an.BeamBatch(h, m, EI, N, modes=4))
    full = an.solve_many(an.BeamBatch(h, np.repeat(m[None], 1600, 0), EI, N, modes=4))
    solved = np.isfinite(full.omega2).all(axis=1)
    assert np.sum(solved) > 1500
    assert fast.omega2[solved] == pytest.approx(full.omega2[solved], rel=1e-11)
    assert np.array_equal(fast.counts[solved], full.counts[solved])
    assert np.all(fast.bracket_omega2[solved, :, 0] <= full.omega2[solved])
    assert np.all(full.omega2[solved] <= fast.bracket_omega2[solved, :, 1])
    if loads < 3:
        assert np.mean(fast.evaluations == 8) > 0.9


def test_three_numbers_of_a_large_batch():
    """Points along each as its coefficients need; the guesses hold, and strangers are solved."""
    rng, n = np.random.default_rng(3), 20
    h, m, EI = np.full(n, 0.1), rng.uniform(1, 3, n), rng.uniform(1e3, 3e3, n)
    courses = np.array([np.linspace(0, 300, n), 40 * np.sin(np.arange(n)), np.full(n, 15.0)])
    N = rng.uniform(0.2, 1, (8000, 3)) @ courses
    N[[5, 4000]] *= rng.uniform(0.9, 1.1, n)
    fast = an.solve_many(an.BeamBatch(h, m, EI, N, modes=4))
    some = np.array([0, 5, 77, 4000, 7999])
    full = an.solve_many(an.BeamBatch(h, np.repeat(m[None], len(some), 0), EI, N[some], modes=4))
    assert not fast.reason.any()
    assert np.mean(fast.evaluations == 8) > 0.99
    assert fast.omega2[some] == pytest.approx(full.omega2, rel=1e-11)
    assert np.array_equal(fast.counts[some], full.counts)


def test_a_load_that_is_no_number_touches_no_other():
    one = np.ones(8)
    N = np.linspace(0, 5, 200)[:, None] * one
    N[77, 3] = np.nan
    result = an.solve_many(an.BeamBatch(one / 8, one, one, N, modes=2))
    assert np.flatnonzero(result.reason).tolist() == [77]
    assert "finite" in result.why(77)


def test_uniform_beams_have_their_closed_form():
    """Free-free, lambda L = 4.73004074486, 7.85320462410, ... and omega^2 = lambda^4 EI/m."""
    EI = np.array([[1.0], [16.0], [5.0]]) * np.ones((3, 20))
    result = an.solve_many(an.BeamBatch(np.full(20, 0.05), np.ones(20), EI, modes=3))
    roots = np.array([4.730040744862704, 7.853204624095838, 10.995607838001671])
    assert result.omega2 == pytest.approx(EI[:, :1] * roots**4, rel=1e-13)


def test_one_failure_touches_no_other():
    h, m = np.full(10, 0.1), np.ones((5, 10))
    EI = np.ones((5, 10))
    m[1, 3], EI[3, 0] = np.nan, -1.0
    EI[2] = 1e-9
    N = np.zeros((5, 10))
    N[2] = 1e20
    result = an.solve_many(an.BeamBatch(h, m, EI, N))
    assert [result.why(k) != "" for k in range(5)] == [False, True, True, True, False]
    assert "positive" in result.why(1)
    assert "reach" in result.why(2)
    assert np.isnan(result.frequencies_hz[1:4]).all()
    assert result.frequencies_hz[0] == pytest.approx(result.frequencies_hz[4], rel=1e-10)


def test_past_buckling_is_said_with_the_negative_omega2():
    """Pinned ends: omega_1^2 = pi^4 (1 - N/N_cr) with EI = m = L = 1, N_cr = pi^2."""
    load = np.array([0.5, 0.99, 1.5, 3.0, 5.0, 0.1])
    N = load[:, None] * np.pi**2 * np.ones(8)
    one = np.ones(8)
    result = an.solve_many(an.BeamBatch(one / 8, one, one, N, an.Ends("pinned", "pinned"), 3))
    assert result.omega2[:, 0] == pytest.approx(np.pi**4 * (1 - load), rel=1e-9)
    assert result.omega2[:, 1] == pytest.approx(np.pi**4 * (16 - 4 * load), rel=1e-9)
    assert [result.why(k) for k in range(6)] == ["", "", REASONS[6], REASONS[6], REASONS[6], ""]
    assert np.isnan(result.frequencies_hz[2, 0])
    assert np.isfinite(result.frequencies_hz[2, 1:]).all()


@pytest.mark.parametrize("ends", [("free", "free"), ("free", "sliding"), ("sliding", "sliding")])
def test_past_buckling_where_the_beam_can_translate(ends):
    """Elastic modes lie below the translation's omega^2 = 0, which no count sees as their index."""
    rng = np.random.default_rng(4)
    batch = random_batch(rng, *ends, beams=30)
    load = rng.uniform(0.5, 12, (30, 1)) * np.pi**2 * 1e3 / np.sum(batch.length) ** 2
    parts = batch.length[0], batch.mass_per_length, batch.bending_stiffness
    batch = an.BeamBatch(*parts, load * rng.uniform(0.5, 1, (30, 15)), an.Ends(*ends), 5)
    result = an.solve_many(batch)
    assert set(result.reason) == {0, 6}
    for row in range(0, 30, 3):
        modes = [mode for mode in single(batch, row).modes if mode.number]
        assert result.omega2[row] == pytest.approx([m.omega2 for m in modes[:5]], rel=1e-9)
        assert result.counts[row].tolist() == [list(m.counts) for m in modes[:5]]


@pytest.mark.parametrize("crossing", [5, 10, 13])
@pytest.mark.parametrize("many", [False, True])
def test_brackets_hold_where_modes_all_but_coincide(crossing, many):
    """Pinned ends under N = (i^2 + j^2 + delta) N_cr: modes i and j, delta from 1e-16 to 1e-3."""
    rng, n = np.random.default_rng([crossing, many]), 10
    delta = rng.choice([-1, 1], 160) * 10 ** rng.uniform(-16, -3, 160)
    load = np.concatenate([rng.uniform(0.9, 1.1, 80), 1 + delta]) * crossing
    rng.shuffle(load)
    m = np.ones((len(load), n) if not many else n)
    N = load[:, None] * np.pi**2 * np.ones(n)
    result = an.solve_many(
        an.BeamBatch(np.full(n, 1 / n), m, np.ones(n), N, an.Ends("pinned", "pinned"), 4)
    )
    assert set(result.reason) <= {0, 6}
    k = np.arange(1, 9)
    exact = np.sort(np.pi**4 * (k**4 - load[:, None] * k**2))[:, :4]
    low, high = np.moveaxis(result.bracket_omega2, -1, 0)
    assert np.all(low - 2e-12 * np.pi**4 <= exact)
    assert np.all(exact <= high + 2e-12 * np.pi**4)


@pytest.mark.parametrize("load", [20.0, 45.0, 60.0, 100.0])
@pytest.mark.parametrize("modes", [1, 2, 20])
def test_the_first_modes_are_the_first_where_several_diverge(load, modes):
    """Free-free under constant N: with one mode asked for, the second must not take its place."""
    one = np.ones(4)
    batch = an.BeamBatch(one / 4, one, one, load * one, modes=modes)
    result, full = an.solve_many(batch), single(batch, 0)
    elastic = [mode for mode in full.modes if mode.number][:modes]
    assert result.omega2[0] == pytest.approx([mode.omega2 for mode in elastic], rel=1e-9)
    assert result.counts[0].tolist() == [list(mode.counts) for mode in elastic]
    alone = an.natural_frequencies(full.beam, modes)
    assert alone.omega2 == pytest.approx(result.omega2[0], rel=1e-9)


def test_one_segment_close_to_buckling():
    """Its rounding comes from shapes, for which one segment is too long as it stands."""
    one = np.ones(1)
    result = an.solve_many(
        an.BeamBatch(one, one, one, np.pi**2 / 4 * (1 - 1e-7) * one, an.Ends("clamped"), 20)
    )
    assert result.why(0) == ""
    assert 0 < result.omega2[0, 0] < 1e-4


@pytest.mark.filterwarnings("error")
def test_numbers_beyond_reach_warn_nobody():
    N, one = np.zeros((100, 5)), np.ones(5)
    N[3, 0], N[4, 0] = np.inf, -np.inf
    assert np.count_nonzero(an.solve_many(an.BeamBatch(one, one, np.ones((100, 5)), N)).reason) == 2
    tiny = an.solve_many(an.BeamBatch(1e-80 * one, one, one))
    assert "not finite" in tiny.why(0)
    assert np.isnan(tiny.omega2).all()


@pytest.mark.parametrize("modes", [1, 3, 7, 20])
@pytest.mark.parametrize("beams", [20, 200])
def test_neighbours_of_any_kind_give_the_same(modes, beams):
    """Unlike neighbours, like ones, and the same beam alone: the guess leaves no trace."""
    batch = random_batch(np.random.default_rng(modes), "free", "clamped", beams, 25, modes)
    result = an.solve_many(batch)
    assert not result.reason.any()
    for row in (0, beams // 2, beams - 1):
        parts = (getattr(batch, name)[row] for name in ("mass_per_length", "bending_stiffness"))
        alone = an.BeamBatch(batch.length, *parts, batch.axial_force[row], batch.ends, modes)
        assert result.omega2[row] == pytest.approx(an.solve_many(alone).omega2[0], rel=3e-13)


def test_any_number_of_modes():
    one = np.ones(4)
    for modes in (1, 9, 60):
        result = an.solve_many(an.BeamBatch(one / 4, one, one, modes=modes))
        n = np.arange(4, modes + 1)
        assert result.omega2[0, 3:] ** 0.25 == pytest.approx((n + 0.5) * np.pi, rel=1e-5)


def test_a_step_of_a_million_and_strong_compression():
    rng = np.random.default_rng(5)
    EI = 10.0 ** rng.uniform(0, 6, (40, 30))
    batch = an.BeamBatch(np.full(30, 0.1), rng.uniform(1, 9, (40, 30)), EI, modes=4)
    result = an.solve_many(batch)
    assert not result.reason.any()
    modes = [mode for mode in single(batch, 39).modes if mode.number > 0]
    assert result.omega2[39] == pytest.approx([mode.omega2 for mode in modes[:4]], rel=1e-9)


def test_shapes_that_do_not_go_together():
    with pytest.raises(an.InputError, match="shapes"):
        an.BeamBatch(np.ones(3), np.ones((2, 4)), np.ones((2, 4)))
    with pytest.raises(an.InputError, match="modes is 0"):
        an.BeamBatch(np.ones(3), np.ones((2, 3)), np.ones((2, 3)), modes=0)


@pytest.mark.parametrize(("left", "right"), [("free", "free"), ("pinned", "clamped")])
def test_numpy_gives_the_same(left, right):
    batch = random_batch(np.random.default_rng(11), left, right, beams=6)
    fast, slow = (an.solve_many(batch, backend=name) for name in ("numba", "numpy"))
    assert slow.reason.tolist() == fast.reason.tolist() == [0] * 6
    assert slow.omega2 == pytest.approx(fast.omega2, rel=1e-11)
    assert np.array_equal(slow.counts, fast.counts)


def test_numpy_says_why_as_well():
    one, N = np.ones((4, 5)), np.zeros((4, 5))
    EI = one.copy()
    EI[1, 2], N[2], EI[3], N[3] = -1.0, np.nan, 1e-9, 1e20
    result = an.solve_many(an.BeamBatch(one, one, EI, N), backend="numpy")
    assert [result.why(k)[:7] for k in range(4)] == ["", "invalid", "invalid", "out of "]


WAVES = sorted(name for name, family in FAMILIES.items() if not family.law.has_axial_force)
WAVE_ENDS = [(a, b) for a in ("free", "fixed") for b in ("free", "fixed")]


def ends_of(family, left, right):
    """Ends of a family, the lateral ones of another kind."""
    return an.Ends(
        "sliding", "sliding", **dict(zip(FAMILIES[family].ends, (left, right), strict=True))
    )


def wave_batch(family, length, mass, stiffness, ends, modes=5):
    columns = FAMILIES[family].columns
    tables = {columns["mass"]: mass, columns["stiffness"]: stiffness}
    return an.BeamBatch(length, ends=ends, modes=modes, family=family, **tables)


@pytest.mark.parametrize("backend", ["numba", "numpy"])
@pytest.mark.parametrize("ends", WAVE_ENDS)
@pytest.mark.parametrize("family", WAVES)
def test_uniform_bars_and_shafts_have_their_closed_form(family, ends, backend):
    """omega = k pi c/L, with k = 1, 2, ... for like ends, 1/2, 3/2, ... else; c^2 = K/m."""
    one, K = np.ones((3, 7)), np.array([[1.0], [16.0], [5e9]])
    batch = wave_batch(family, 3 * one[0] / 7, 2 * one, K * one, ends_of(family, *ends), 6)
    result = an.solve_many(batch, backend=backend)
    k = np.arange(1, 7) - (0.0 if ends[0] == ends[1] else 0.5)
    exact = K / 2 * (k * np.pi / 3) ** 2
    assert not result.reason.any()
    assert result.omega2 == pytest.approx(exact, rel=1e-12)
    assert result.frequencies_hz == pytest.approx(np.sqrt(exact) / (2 * np.pi), rel=1e-12)
    low, high = np.moveaxis(result.bracket_omega2, -1, 0)
    assert np.all((low <= exact) & (exact <= high))
    index = np.arange(6) + (ends == ("free", "free"))
    assert np.all(result.counts == np.stack([index, index + 1], axis=1))


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("ends", WAVE_ENDS)
@pytest.mark.parametrize("family", WAVES)
def test_stepped_bars_and_shafts_are_their_single_solves(family, ends, shared):
    rng, n = np.random.default_rng([WAVE_ENDS.index(ends), shared]), 12
    h, m = rng.uniform(0.5, 1.5, n), rng.uniform(1, 3, n if shared else (90, n))
    K = 10 ** rng.uniform(3, 5, (90, n))
    batch = wave_batch(family, h, m, K, ends_of(family, *ends))
    result, some = an.solve_many(batch), (0, 40, 89)
    assert len(batch) == len(result) == 90
    assert not result.reason.any()
    for row in some:
        tables = {FAMILIES[family].columns["stiffness"]: K[row]}
        tables |= {FAMILIES[family].columns["mass"]: m if shared else m[row]}
        x, one = np.concatenate([[0.0], np.cumsum(h)]), np.ones(n)
        given = {"mass_per_length": one, "bending_stiffness": one} | tables
        beam = an.Beam.from_stations(x, **given, ends=batch.ends)
        found = an.solve_modes(beam, 5, families=[family], backend="numpy").modes
        modes = [mode for mode in found if mode.number]
        assert result.omega2[row] == pytest.approx([mode.omega2 for mode in modes], rel=2e-10)
        assert result.counts[row].tolist() == [list(mode.counts) for mode in modes]
    few = wave_batch(family, h, m if shared else m[:4], K[:4], batch.ends)
    slow = an.solve_many(few, backend="numpy")
    assert not slow.reason.any()
    assert slow.omega2 == pytest.approx(result.omega2[:4], rel=2e-10)
    assert np.array_equal(slow.counts, result.counts[:4])


@pytest.mark.parametrize("backend", ["numba", "numpy"])
@pytest.mark.parametrize("family", WAVES)
def test_one_bar_or_shaft_that_fails_touches_no_other(family, backend):
    m, K = np.ones((2, 5, 6))
    m[1, 3], K[3, 0] = np.nan, -1.0
    h, ends = np.full(6, 0.2), ends_of(family, "free", "free")
    result = an.solve_many(wave_batch(family, h, m, K, ends, 2), backend=backend)
    assert result.reason.tolist() == [0, INVALID, 0, INVALID, 0]
    assert "positive" in result.why(1)
    assert np.isnan(result.omega2[[1, 3]]).all()
    assert result.omega2[[0, 2, 4], 0] == pytest.approx((np.pi / 1.2) ** 2, rel=1e-12)


def test_ends_of_a_family_follow_the_lateral_ones_where_none_are_given():
    """Pinned ends hold a bar and let a shaft turn; clamped ones hold both."""
    one = np.ones(4)
    for end, held in (("pinned", {"longitudinal"}), ("clamped", {"longitudinal", "torsion"})):
        for family in WAVES:
            batch = wave_batch(family, one / 4, one, one, an.Ends(end, "free"), 1)
            share = 0.5 if family in held else 1.0
            assert an.solve_many(batch).omega2[0, 0] == pytest.approx((share * np.pi) ** 2)


def test_the_family_of_old_is_bending():
    batch = random_batch(np.random.default_rng(2), "free", "clamped")
    parts = batch.length, batch.mass_per_length, batch.bending_stiffness, batch.axial_force
    named = an.BeamBatch(*parts, batch.ends, batch.modes, "bending")
    assert named == batch
    assert an.solve_many(named) == an.solve_many(batch)
    unloaded = an.BeamBatch(*parts[:3])
    assert np.array_equal(unloaded.axial_force, np.zeros((12, 15)))


@pytest.mark.parametrize(
    ("family", "given", "told"),
    [
        ("bending", ["mass_per_length"], "bending_stiffness is missing; its arrays are length, "),
        ("longitudinal", ["mass_per_length"], "axial_stiffness is missing"),
        ("torsion", ["torsional_stiffness"], "polar_inertia_per_length is missing"),
        (
            "longitudinal",
            ["mass_per_length", "axial_stiffness", "axial_force"],
            "axial_force is given, of another family: leave it out",
        ),
        (
            "torsion",
            ["torsional_stiffness", "mass_per_length"],
            "polar_inertia_per_length is missing; mass_per_length is given",
        ),
        (
            "bending",
            ["mass_per_length", "bending_stiffness", "axial_stiffness"],
            "axial_stiffness is given",
        ),
        ("shear", [], "family is 'shear'; allowed are 'bending', 'longitudinal', 'torsion'"),
    ],
)
def test_a_batch_has_the_arrays_of_its_family(family, given, told):
    with pytest.raises(an.InputError, match=told):
        an.BeamBatch(np.ones(3), family=family, **dict.fromkeys(given, np.ones(3)))


def test_no_solve_imports_numba():
    code = "import sys, antinode as an, numpy as np; one = np.ones(3)\n"
    code += "an.solve_modes(an.Beam.from_stations([0, 1, 2], one, one))\n"
    code += "an.solve_many(an.BeamBatch(one, one, one))\n"
    code += "assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
