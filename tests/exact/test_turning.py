"""Loads along a beam that turn with its section: figures of other codes, and Taylor series.

Hauger's column, tapered and sheared critical loads are in validation/turning.py.
"""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mpf
from stability_digits import Digits

import antinode as an
from antinode.beam.axial import AxialLoads, apply_loads
from antinode.beam.file import BeamFile
from antinode.beam.loads.turning import turning_load, turning_load_left
from antinode.errors import InputError
from antinode.exchange.beam_toml import beam_tables
from antinode.inputs.explain import validate
from antinode.modes.loading import loading
from antinode.riccati.damped.chain import Damped
from antinode.riccati.segment import following_transfer, lateral_transfer
from antinode.stability.circles import sums

CLAMPED = an.Ends("clamped")


def column(m, EI, load, ends=CLAMPED, **more):
    return an.Beam.from_stations(
        [0, 1], m, EI, tangential_load=load, ends=ends, interpolation="linear", **more
    )


@pytest.mark.parametrize(
    ("load", "critical", "omega"),
    [([-1, -1], 40.0537365149, 11.0302169954), ([-1, 0], 150.641595404, 11.4857136111)],
)
def test_leipholz_and_hauger(load, critical, omega):
    """Two eigenvalues meet within 1e-9 of the load; validation/turning.py finds it by stability."""
    on = loading(column([1, 1], [1, 1], load), 32, translates=False)
    before, after = (
        sums(on(critical * (1 + side * 1e-9)), omega**2, 0.5 * omega**2) for side in (-1, 1)
    )
    assert before.number == after.number == 2
    assert before.apart > 0 > after.apart
    assert before.centre + before.first / 2 == pytest.approx(omega**2, rel=2e-9)


CASES = {
    "tapered": column([2, 1], [3, 1], [-30, -12]),
    "past flutter": column([1, 1], [1, 1], [-45, -45]),
    "follower as well": column(
        [1, 1.5], [2, 1], [-6, -3], an.Ends("clamped", right_follower=1.0), axial_force=[9, 4.5]
    ),
    "sheared": column(
        [1, 1],
        [1, 1],
        [-20, 0],
        shear_stiffness=[100, 100],
        rotary_inertia_per_length=[0.002, 0.001],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_modes_against_many_digits(name):
    beam, backend = CASES[name], "numpy"
    found = an.solve_modes(beam, 2, tolerance=1e-5, families=["bending"], backend=backend)
    assert found.certificate["kind"] == "winding"
    assert 0 < found.certificate["record"]["turning"] < 1
    assert all("flutter" in told for told in found.warnings)
    digits = Digits(beam, 30)
    for mode in found.modes:
        exact = _root(digits, mode.eigenvalue)
        assert abs(complex(exact) - mode.eigenvalue) <= mode.error_per_s
        assert mode.error_per_s < 2e-5 * abs(mode.eigenvalue)
        assert mode.residual < 1e-9
    growing = [m for m in found.modes if m.kind == "flutter"]
    assert len(growing) == (name == "past flutter")


def _root(digits, start):
    """A root of D(s) by secants from a place of which it is a small part off."""
    a, b = mpf(1) * start, start * (1 + mpf("1e-9"))
    at_a, at_b = (digits(-s * s, mpf(1)) for s in (a, b))
    for _ in range(4):
        a, b, at_a = b, b - at_b * (b - a) / (at_b - at_a), at_b
        at_b = digits(-b * b, mpf(1))
    return b


def test_a_free_body_whose_loads_all_turn_rests_in_its_turn():
    """N is zero throughout: loads and inertia balance; the turn accelerates it sideways."""
    beam = column([1, 1], [1, 1], [20, 20], an.Ends())
    assert np.max(np.abs(beam.axial_force_at(np.zeros(3, int), np.array([0.2, 0.5, 1])))) < 1e-13
    found = an.solve_modes(beam, 2, tolerance=1e-7, families=["bending"], backend="numpy")
    assert found.certificate["record"]["at_zero"] == 4
    assert found.certificate["kind"] == "winding"
    assert [m.name for m in found.modes[:3]] == ["rigid translation", "rigid rotation", "bending 1"]
    # z'''' - 20 z' = omega^2 z, free: four roots of the quartic in 60 digits, worked out once
    assert found.modes[2].eigenvalue.imag == pytest.approx(_free(22.4037, 20), rel=1e-8)


def _free(guess, load):
    """Circular frequency of a free beam with Q' = omega^2 Y + load psi, N = 0, by its quartic."""

    def D(omega):
        k = np.roots([1, 0, 0, -load, -(omega**2)])
        rows = [k**2, k**2 * np.exp(k), k**3, k**3 * np.exp(k)]  # M and Q = M'
        scale = np.linalg.det(np.array([np.ones(4), k, k**2, k**3]))
        return (np.linalg.det(np.array(rows)) / scale).real

    a, b = guess, guess * (1 + 1e-6)
    for _ in range(6):
        a, b = b, b - D(b) * (b - a) / (D(b) - D(a))
        if abs(b - a) < 1e-12 * b:
            break
    return b


def test_the_series_of_the_quartic():
    """Against steps that are ten times shorter, and the biquadratic where nothing turns."""
    numbers = [np.array(v) for v in (0.5, 1.7, 2.0, 3.0, 1.3, 0.02, 1.1)]
    whole = following_transfer(*numbers)
    step = following_transfer(numbers[0] / 10, *numbers[1:])
    assert np.linalg.matrix_power(step, 10) == pytest.approx(whole, abs=1e-14)
    plain = [*numbers[:4], *numbers[5:]]
    still = following_transfer(*numbers[:4], np.array(0.0), *numbers[5:])
    assert still == pytest.approx(lateral_transfer(*plain), abs=1e-15)


def test_left_eigenvectors_have_the_same_eigenvalues():
    damped = Damped(CASES["sheared"].chain("bending"))
    s = np.array([0.3 + 4j, -1 + 15j])
    values = [d.characteristic(s) for d in (damped, damped.transposed)]
    a, b = (value * np.exp(size - values[0][1]) for value, size in values)
    assert a == pytest.approx(b, rel=1e-11)


def test_the_axial_force_that_they_make():
    hauger = column([1, 1], [1, 1], [-2, 0])
    t = np.array([0.0, 0.3, 1.0])
    N = hauger.axial_force_at(np.zeros(3, int), t)
    assert pytest.approx((1 - t) ** 2, abs=1e-15) == N
    assert turning_load(hauger) == pytest.approx(-1)
    assert turning_load_left(hauger, np.zeros(3, int), t) == pytest.approx((1 - t) ** 2 - 1)
    turned = hauger.reversed()
    assert turned.axial_force_at(np.zeros(3, int), 1 - t) == pytest.approx(N, abs=1e-15)
    assert turned.tangential_load == pytest.approx(np.array([[0.0, 2.0]]))
    with pytest.raises(InputError, match="held axially at 2 places; give the axial_force"):
        column([1, 1], [1, 1], [1, 1], an.Ends("clamped", "clamped"))


def test_a_file_and_back():
    stations = {
        "x": [0, 1],
        "mass_per_length": [1, 1],
        "bending_stiffness": [1, 1],
        "tangential_load": ["-40 N/m", "-20 N/m"],
    }
    table = {"interpolation": "linear", "ends": {"left": "clamped"}, "stations": stations}
    beam = validate(BeamFile, {"beam": table}, "file").beam()
    assert beam.axial_force == pytest.approx(np.array([[30.0, 10.0, 0.0]]))
    table["stations"] = stations | {"axial_force": [30, 5]}
    kept = validate(BeamFile, {"beam": table}, "file").beam()
    assert kept.axial_force == pytest.approx(np.array([[30.0, 5.0]]))
    again = validate(BeamFile, {"beam": beam_tables(kept)[0]}, "file").beam()
    assert again.tangential_load == pytest.approx(kept.tangential_load)
    assert again.axial_force == pytest.approx(kept.axial_force)
    heavy = apply_loads(beam, AxialLoads(gravity=-2.0))
    assert heavy.axial_force_at(np.zeros(1, int), np.zeros(1)) == pytest.approx(32.0)


@pytest.mark.parametrize(
    "ask",
    [
        an.natural_frequencies,
        an.buckling,
        lambda beam: an.solve_modes(beam, damping="none"),
        lambda beam: an.solve_modes(beam, method="tmm"),
    ],
)
def test_what_counts_refuses_them(ask):
    with pytest.raises(InputError, match=r"tangential_load.* turns with the section"):
        ask(CASES["tapered"])
