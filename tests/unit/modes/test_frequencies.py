"""Frequencies without shapes: compiled and in numpy, against full solves and hp elements."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import antinode as an
import hp_beam
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.modes.backends import choose
from antinode.modes.frequencies import _directly

ENDS = ("free", "clamped", "pinned", "sliding")


def steep(seed, ends=None):
    """Log-linear between eight stations, m and EI over a decade, under compression."""
    rng, x = np.random.default_rng(seed), np.linspace(0, 6, 8)
    m, EI = (300 * np.exp(0.5 * rng.standard_normal(8)) * scale for scale in (1, 1e3))
    N = rng.uniform(2e3, 9e3) * (1 + x)
    return an.Beam.from_stations(x, m, EI, None, N, interpolation="log", ends=ends)


def stepped(ends=None):
    rng = np.random.default_rng(3)
    m, EI, N = rng.uniform(1, 3, 30), rng.uniform(1e3, 3e3, 30), rng.uniform(-50, 90, 30)
    return an.Beam.from_stations(np.linspace(0, 3, 31), m, EI, None, N, ends=ends)


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
def test_frequencies_are_those_of_the_modes(left, right):
    beam = stepped(an.Ends(left, right))
    fast, full = an.natural_frequencies(beam, 5), an.solve_modes(beam, 5)
    modes = [mode for mode in full.modes if mode.number]
    assert fast.omega2 == pytest.approx([mode.omega2 for mode in modes], rel=1e-10)
    assert fast.counts.tolist() == [list(mode.counts) for mode in modes]
    assert fast.frequencies_hz == pytest.approx(full.frequencies_hz(), rel=1e-10)
    low, high = fast.bracket_omega2.T
    assert np.all((low <= fast.omega2) & (fast.omega2 <= high))
    assert np.all(fast.error_hz < 2e-10 * fast.frequencies_hz)


@pytest.mark.parametrize("tolerance", [1e-5, 1e-7])
@pytest.mark.parametrize("seed", range(4))
def test_smooth_beams_keep_their_error(seed, tolerance):
    beam = steep(seed)
    exact = hp_beam.eigenvalues(beam, 8)[2:]
    result = an.natural_frequencies(beam, 6, tolerance=tolerance)
    assert np.all(np.abs(result.omega2 - exact) <= result.error_omega2)
    assert np.all(result.error_omega2 <= 2.01 * tolerance * exact)


def test_numpy_gives_the_same():
    result = an.natural_frequencies(steep(1), 4, backend="numpy")
    again = an.natural_frequencies(steep(1), 4, backend="numba")
    assert np.all(np.abs(again.omega2 - result.omega2) <= result.error_omega2)


@pytest.mark.parametrize("interpolation", ["log", "linear", "step"])
@pytest.mark.parametrize("acceleration", [0.0, -12.0])
def test_attachments_and_acceleration(interpolation, acceleration):
    beam = replace(steep(4, an.Ends("clamped", "free")), interpolation="linear")
    if interpolation == "step":
        tables = {name: getattr(beam, name)[:, [0, 0]] for name in STRUCTURE}
        beam = replace(beam, **tables)
    beam = replace(beam, interpolation=interpolation, axial_acceleration=acceleration)
    beam = beam.with_attachments(PointMass(3.3, 40.0, 2.0, 0.1), Spring(2.0, 5e4), Joint(4.5, 1e-7))
    fast, full = (solve(beam, 4, tolerance=1e-8) for solve in (an.natural_frequencies, modes_of))
    assert np.all(np.abs(fast.omega2 - full[0]) <= fast.error_omega2 + full[1])
    assert np.all(fast.error_omega2 <= 2.1e-8 * np.abs(fast.omega2))


@pytest.mark.parametrize("seed", range(6))
def test_the_error_holds_where_levels_agree_by_accident(seed):
    """300 short linear tables, coarse tolerances: where a quarter of the last change did not."""
    rng, ends = np.random.default_rng(seed), ("free", "clamped", "pinned", "sliding")
    for _ in range(50):
        n = int(rng.integers(2, 5))
        m, EI = rng.uniform(0.3, 6, n), rng.uniform(0.3, 6, n)
        held = an.Ends(*map(str, rng.choice(ends, 2)))
        x = np.linspace(0, 1, n)
        beam = an.Beam.from_stations(x, m, EI, interpolation="linear", ends=held)
        exact = an.natural_frequencies(beam, 6, tolerance=1e-10)
        found = an.natural_frequencies(beam, 6, tolerance=10 ** rng.uniform(-6, -3))
        distance = np.abs(found.omega2 - exact.omega2)
        assert np.all(distance <= found.error_omega2 + exact.error_omega2)


def test_sixty_modes_stay_compiled():
    """Roots that are found wait for the others without being halved for it."""
    rng, x = np.random.default_rng(0), np.linspace(0, 1, 6)
    tables = [rng.uniform(0.5, 2, (2, 6)) for _ in range(20)]
    for m, EI in tables:
        beam = an.Beam.from_stations(x, m, EI, interpolation="linear", ends=an.Ends("clamped"))
        found = _directly(choose("numba"), beam, 60, 1e-6)
        assert found is not None


STRUCTURE = ("mass_per_length", "bending_stiffness")


def modes_of(beam, modes, tolerance):
    """Return omega^2 of the elastic modes, and their errors."""
    found = an.solve_modes(beam, modes, tolerance=tolerance, families=("bending",)).modes
    elastic = [mode for mode in found if mode.number]
    return np.array([[mode.omega2, mode.error_omega2] for mode in elastic]).T


def test_tables_of_any_memory_layout_serve():
    """Views, read-only and Fortran-ordered tables: the same frequencies."""
    beam = steep(5)
    expected = an.natural_frequencies(beam).omega2
    tables = {name: np.asfortranarray(getattr(beam, name)) for name in STRUCTURE}
    x = np.repeat(beam.x, 2)[::2]
    x.flags.writeable = False
    again = an.natural_frequencies(replace(beam, x=x, **tables)).omega2
    assert again.tolist() == expected.tolist()


@pytest.mark.parametrize(("modes", "tolerance"), [(0, 1e-6), (6, 1.0)])
def test_arguments_outside_their_range(modes, tolerance):
    with pytest.raises(an.InputError, match="allowed"):
        an.natural_frequencies(stepped(), modes, tolerance=tolerance)


def test_no_call_imports_the_compiler():
    code = "import sys, antinode as an\n"
    code += "an.natural_frequencies(an.Beam.from_stations([0, 1, 2], [1.0] * 3, [1.0] * 3))\n"
    code += "assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_an_unknown_backend_is_refused():
    with pytest.raises(an.InputError, match="backend is 'fortran'; allowed are 'auto'"):
        an.natural_frequencies(steep(1), backend="fortran")


@pytest.mark.parametrize("N", [0.0, 3e6, -2e6])
def test_the_effect_of_shear_stands_beside_the_frequencies(N):
    """A short pipe, in compression past buckling, in tension: as of the modes."""
    beam = an.Beam.from_stations(
        [0, 0.3, 0.9], 12.0, [4e4, 9e4, 9e4], 3e8, N, ends=an.Ends("pinned")
    )
    fast, full = an.natural_frequencies(beam, 4), an.solve_modes(beam, 4, families=["bending"])
    wanted = [mode.model_error for mode in full.modes if mode.number][:4]
    np.testing.assert_array_equal(fast.model_error, np.array(wanted, dtype=float))
    assert abs(fast.model_error[-1]) > 0.02
    assert fast.warnings == full.warnings
    assert any("shear and rotary inertia" in text for text in fast.warnings)


def test_without_axial_stiffness_shear_is_unknown_not_zero():
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0)
    assert np.isnan(an.natural_frequencies(beam, 2).model_error).all()
