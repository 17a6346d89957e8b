"""The peers of the benchmarks answer what antinode answers; the table shows what was measured."""

import json

import numpy as np
import pytest
from benchmarks import table
from benchmarks.beams import (
    DASHPOTS,
    LENGTH,
    MODES,
    SEGMENTS,
    damped_beam,
    smooth_case,
    steep_stations,
)
from benchmarks.peers import dense, figures, hp, packages
from benchmarks.peers.reduced_basis import ReducedBasis
from benchmarks.peers.state_space import StateSpace
from benchmarks.peers.subspace import Subspace
from benchmarks.peers.timoshenko import TimoshenkoSubspace

import antinode as an

KEYS = {"work", "against", "ratio", "target", "met", "antinode_s", "peer_s", "machine"}
BEAMS = 3


@pytest.fixture(scope="module")
def beams():
    """Arrays of a few beams, and their certified frequencies."""
    h, m, EI, N = smooth_case(np.random.default_rng(7), BEAMS)
    return h[0], m, EI, N, np.array([certified(h, m[k], EI[k], N[k]) for k in range(BEAMS)])


def certified(h, m, EI, N):
    x = np.concatenate([[0.0], np.cumsum(h)])
    beam = an.Beam.from_stations(x, m, EI, None, N)
    return an.natural_frequencies(beam, MODES).omega2


def hermite_peers(h):
    """Solvers (m, EI, N, modes) with Hermite elements; the packages where they are installed."""
    solver = Subspace(SEGMENTS)
    return {
        "dense": lambda *case: dense.omega2(h, *case),
        "subspace": lambda *case: solver.omega2(h, *case),
        **packages.installed(LENGTH, SEGMENTS)[0],
    }


def test_hermite_elements_agree(beams):
    h, m, EI, N, expected = beams
    for name, solve in hermite_peers(h).items():
        found = np.array([solve(m[k], EI[k], N[k], MODES) for k in range(BEAMS)])
        assert np.max(np.abs(found / expected - 1)) < 1e-5, name


def test_elements_with_dashpots_agree():
    beam = damped_beam(3)
    modes, peer = an.solve_modes(beam, MODES, families=("bending",)), StateSpace(beam, DASHPOTS)
    assert modes.certificate["kind"] == "winding"
    s = np.array([mode.eigenvalue for mode in modes.modes])
    for values, _ in (peer.dense(), peer.inverted(MODES)):
        found = np.array(sorted(values[values.imag > 0], key=abs)[:MODES])
        assert np.max(np.abs(found / s - 1)) < 1e-5


def test_the_subspace_starts_cold(beams):
    h, m, EI, N, expected = beams
    solver = Subspace(SEGMENTS, vectors=14, sweeps=3)
    for k in range(BEAMS):
        solver.restart()
        found = solver.omega2(h, m[k], EI[k], N[k], MODES)
        assert np.max(np.abs(found / expected[k] - 1)) < 5e-6


def test_elements_with_shear_converge_to_what_is_certified(beams):
    h, m, EI, N, _ = beams
    shear, rotary = EI * 100, m / 200
    batch = an.BeamBatch(
        np.full(SEGMENTS, h), m, EI, N, shear_stiffness=shear, rotary_inertia_per_length=rotary
    )
    exact = an.solve_many(batch).omega2[0]
    off = []
    for pieces in (1, 2):
        fine = [np.repeat(values[0], pieces) for values in (m, EI, N, shear, rotary)]
        solver = TimoshenkoSubspace(SEGMENTS * pieces)
        for _ in range(6):
            found = solver.omega2(h / pieces, *fine[:3], MODES, *fine[3:])
        off.append(np.max(np.abs(found / exact - 1)))
    assert off[0] < 1e-3
    assert off[0] / off[1] == pytest.approx(4, rel=0.01)


def test_the_reduced_basis_agrees(beams):
    _, m, EI, N, _ = beams
    h = np.full(SEGMENTS, LENGTH / SEGMENTS)
    basis = ReducedBasis(h, m[0], EI[0], N[0], (0.3, 0.9, 1.5))
    factors = np.array([0.5, 1.2])
    expected = np.array([certified(h, m[0], EI[0], factor * N[0]) for factor in factors])
    assert np.max(np.abs(basis.omega2(factors, MODES) / expected - 1)) < 2e-8


def test_hp_elements_agree():
    x, m, EI, N = steep_stations(0)
    beam = an.Beam.from_stations(x, m, EI, None, N, interpolation="log")
    expected = an.natural_frequencies(beam, MODES, tolerance=1e-9).omega2
    assert np.max(np.abs(hp.omega2(x, m, EI, N, MODES) / expected - 1)) < 1e-7


def test_a_package_that_is_missing_is_named(monkeypatch):
    def without(length, segments):
        raise ImportError("No module named skfem")

    monkeypatch.setattr(packages, "_scikit_fem", without)
    found, missing = packages.installed(LENGTH, SEGMENTS)
    assert "scikit-fem" not in found
    assert missing["scikit-fem"] == "No module named skfem"


def test_limits_follow_the_machine():
    twice = {name: 2 * taken for name, taken in figures.REFERENCE.items()}
    row = {"peer_s": 5e-3, "figure": "dense"}
    assert not figures.judge(dict(row), figures.REFERENCE)["peer_within"]
    judged = figures.judge(dict(row), twice)
    assert judged["peer_within"]
    assert judged["peer_scaled_limit_s"] == pytest.approx(2 * 1.3 * 2.0e-3)
    assert judged["machine_scale"] == 2
    assert "figure" not in judged


def test_every_row_is_whole():
    rows = json.loads(table.RESULTS.read_text(encoding="utf-8"))
    assert rows
    for row in rows:
        assert set(row) >= KEYS
        assert {"date", "processor", "versions", "calibration_s"} <= set(row["machine"])


def test_the_table_shows_the_results():
    rows = json.loads(table.RESULTS.read_text(encoding="utf-8"))
    assert table.shown() == table.text(rows)
