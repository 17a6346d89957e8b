"""Frequencies without shapes: compiled and in numpy, against full solves and hp elements."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import antinode as an
import hp_beam
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.modes import kernel
from antinode.modes.frequencies import _by_kernel

ENDS = ("free", "clamped", "pinned", "sliding")


@pytest.fixture
def compiled():
    kernel.kernel()


@pytest.fixture
def in_numpy(monkeypatch):
    monkeypatch.setattr(kernel, "_ready", [])


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


@pytest.mark.usefixtures("compiled")
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


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("tolerance", [1e-5, 1e-7])
@pytest.mark.parametrize("seed", range(4))
def test_smooth_beams_keep_their_error(seed, tolerance):
    beam = steep(seed)
    exact = hp_beam.eigenvalues(beam, 8)[2:]
    result = an.natural_frequencies(beam, 6, tolerance=tolerance)
    assert np.all(np.abs(result.omega2 - exact) <= result.error_omega2)
    assert np.all(result.error_omega2 <= 2.01 * tolerance * exact)


@pytest.mark.usefixtures("in_numpy")
def test_numpy_gives_the_same():
    result = an.natural_frequencies(steep(1), 4)
    assert kernel._ready == []
    kernel.kernel()
    again = an.natural_frequencies(steep(1), 4)
    assert np.all(np.abs(again.omega2 - result.omega2) <= result.error_omega2)


@pytest.mark.usefixtures("compiled")
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


@pytest.mark.usefixtures("compiled")
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


@pytest.mark.usefixtures("compiled")
def test_sixty_modes_stay_compiled():
    """Roots that are found wait for the others without being halved for it."""
    rng, x = np.random.default_rng(0), np.linspace(0, 1, 6)
    tables = [rng.uniform(0.5, 2, (2, 6)) for _ in range(20)]
    for m, EI in tables:
        beam = an.Beam.from_stations(x, m, EI, interpolation="linear", ends=an.Ends("clamped"))
        found = _by_kernel(kernel.kernel(), beam, 60, 1e-6)
        assert found is not None


STRUCTURE = ("mass_per_length", "bending_stiffness")


def modes_of(beam, modes, tolerance):
    """Return omega^2 of the elastic modes, and their errors."""
    found = an.solve_modes(beam, modes, tolerance=tolerance, families=("bending",)).modes
    elastic = [mode for mode in found if mode.number]
    return np.array([[mode.omega2, mode.error_omega2] for mode in elastic]).T


def test_a_compiled_solve_keeps_tables_of_any_memory_layout():
    """Views, read-only and Fortran-ordered tables must not make the kernel compile again."""
    compiled = kernel.kernel()
    beam = steep(5)
    expected = an.natural_frequencies(beam).omega2
    number = len(compiled.lanes.solve_levels.signatures)
    tables = {name: np.asfortranarray(getattr(beam, name)) for name in STRUCTURE}
    x = np.repeat(beam.x, 2)[::2]
    x.flags.writeable = False
    again = an.natural_frequencies(replace(beam, x=x, **tables)).omega2
    assert again.tolist() == expected.tolist()
    assert len(compiled.lanes.solve_levels.signatures) == number


@pytest.mark.parametrize(("modes", "tolerance"), [(0, 1e-6), (6, 1.0)])
def test_arguments_outside_their_range(modes, tolerance):
    with pytest.raises(an.InputError, match="allowed"):
        an.natural_frequencies(stepped(), modes, tolerance=tolerance)


def test_a_single_call_loads_no_compiler():
    code = "import sys, antinode as an\n"
    code += "an.natural_frequencies(an.Beam.from_stations([0, 1, 2], [1.0] * 3, [1.0] * 3))\n"
    code += "assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("cached", [False, True])
def test_numba_is_not_waited_for_where_numpy_is_done_sooner(cached, tmp_path):
    """A large beam loads the kernel from its cache, and does not have it compiled."""
    code = """
import sys
from antinode.modes.kernel import kernel_if_worthwhile
print(kernel_if_worthwhile(200, 8) is None, kernel_if_worthwhile(10_000, 8) is None)
"""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    if cached:
        fill = [sys.executable, "-c", "from antinode.modes.kernel import kernel; kernel()"]
        subprocess.run(fill, env=environment, check=True, capture_output=True)
    command = [sys.executable, "-c", code]
    told = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    assert told.stdout.split() == ["True", str(not cached)]


def test_a_cache_folder_where_the_package_is_read_only(monkeypatch, tmp_path):
    """Numba finds no place for its cache: one is made among the temporary files."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    code = """
import numba
from numba.core import caching
caching.CacheImpl._locator_classes = [caching.UserProvidedCacheLocator]
from antinode.modes.kernel import _import_kernel
_import_kernel()
print(numba.config.CACHE_DIR)
"""
    environment = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    command = [sys.executable, "-c", code]
    told = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    assert told.stdout.strip() == str(tmp_path / "antinode-numba")
