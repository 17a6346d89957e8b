"""Names, kinds, numbers, certificates, errors and the other faces of a modal result."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest

from antinode import Beam, ComputationError, Ends, InputError, solve_modes
from antinode.modes.buckling import buckling
from antinode.show.writing import to_json

ENDS = ("free", "clamped", "pinned", "sliding")
RIGID = {
    frozenset(["free"]): ["rigid translation", "rigid rotation"],
    frozenset(["free", "pinned"]): ["rigid rotation"],
    frozenset(["free", "sliding"]): ["rigid translation"],
    frozenset(["sliding"]): ["rigid translation"],
}


def uniform(left="free", right="free", N=0.0, segments=5):
    one = np.ones(segments + 1)
    return Beam.from_stations(
        np.linspace(0, 1, segments + 1), one, one, 1e4 * one, N * one, ends=Ends(left, right)
    )


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
@pytest.mark.parametrize("N", [0.0, 1.0, -1.0])
def test_rigid_modes_are_named_by_the_supports(left, right, N):
    modes = solve_modes(uniform(left, right, N), 3).family("bending")
    rigid = [m.name for m in modes if m.number == 0]
    assert sorted(rigid) == sorted(RIGID.get(frozenset([left, right]), []))
    assert [m.number for m in modes if m.number] == [1, 2, 3]
    for mode in modes:
        if mode.name == "rigid translation" or (mode.number == 0 and N == 0):
            assert (mode.omega2, mode.kind, mode.frequency_hz) == (0.0, "rigid", 0.0)
        elif mode.number == 0:
            assert mode.kind == ("divergent" if N > 0 else "rigid")


def test_numbers_do_not_shift_when_compression_buckles_a_free_beam():
    """Free-free under N: elastic mode n diverges at N = (n pi)^2 but keeps its number."""
    below, above = (solve_modes(uniform(N=f * math.pi**2), 3) for f in (0.99, 1.01))
    assert [m.name for m in below.family("bending")][:3] == [
        "rigid rotation",
        "rigid translation",
        "bending 1",
    ]
    first = above.mode("bending", 1)
    assert first.kind == "divergent"
    assert above.mode("bending", 2).kind == "elastic"
    assert [m.number for m in above.family("bending") if m.number] == [1, 2, 3]


def test_all_divergent_modes_come_along():
    result = solve_modes(uniform("pinned", "pinned", 30 * math.pi**2), 2)
    numbers = [m.number for m in result.family("bending")]
    assert numbers == [1, 2, 3, 4, 5]  # N > (n pi)^2 for n up to 5
    assert all(m.kind == "divergent" for m in result.family("bending"))


def test_certificates_follow_each_other():
    result = solve_modes(uniform(N=3.0), 6)
    for family in ("bending", "longitudinal"):
        counts = [m.counts for m in result.family(family)]
        assert counts[0][0] == 0
        assert all(a[1] == b[0] for a, b in pairwise(counts))
    for mode in result.modes:
        low, high = mode.bracket_omega2
        assert low <= mode.omega2 <= high
        if mode.number:
            assert (high - low) <= 1e-10 * abs(mode.omega2) * 1.001
            assert mode.error_omega2 >= max(mode.omega2 - low, high - mode.omega2)


def test_what_varies_is_refined_and_its_error_reported():
    """A cone-like cantilever: the error bound holds against a solution 1e6 times tighter."""
    x = np.linspace(0, 1, 4)
    beam = Beam.from_stations(
        x, 1 + x, (1 + x) ** 3, None, 2 * x, interpolation="linear", ends=Ends("free", "clamped")
    )
    fine = solve_modes(beam, 6, tolerance=1e-12).frequencies_hz()
    for tolerance in (1e-4, 1e-6, 1e-8):
        result = solve_modes(beam, 6, tolerance=tolerance)
        for mode, exact in zip(result.modes, fine, strict=True):
            true = abs(mode.frequency_hz - exact)
            assert true <= tolerance * exact
            assert true <= mode.error_hz + 1e-12 * exact
            assert mode.error_hz <= 1.01 * tolerance * exact


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_a_layer_at_the_end_of_a_strong_tension_is_resolved(tolerance):
    """N alone varies, to 1000 EI/L^2: two representations that miss the layer agree by accident."""
    N = np.array([[0.0, 0.0], [0.0, -1000.0]])
    one = np.ones((2, 2))
    beam = Beam(np.array([0, 0.5, 1.0]), one, one, axial_force=N, ends=Ends("clamped", "free"))
    exact = solve_modes(beam, 2, tolerance=1e-9)
    for mode, truth in zip(
        solve_modes(beam, 2, tolerance=tolerance).modes, exact.modes, strict=True
    ):
        assert abs(mode.omega2 - truth.omega2) <= mode.error_omega2 + truth.error_omega2


def test_a_beam_keeps_its_own_numbers():
    """Changing the caller's arrays afterwards changes nothing; the beam's own are read-only."""
    x, m = np.array([0.0, 1.0, 2.0]), np.array([[1.0, 2.0], [2.0, 3.0]])
    more = {"interpolation": "linear", "axial_acceleration": 0.3, "ends": Ends("clamped", "free")}
    beam = Beam(x, m, m.copy(), **more)
    before = solve_modes(beam, 2).frequencies_hz()
    m *= 2
    x *= 2
    assert solve_modes(beam, 2).frequencies_hz().tolist() == before.tolist()
    with pytest.raises(ValueError, match="read-only"):
        beam.mass_per_length[0, 0] = 5.0


def test_fourth_order_of_the_half_segments():
    x = np.linspace(0, 1, 3)
    beam = Beam.from_stations(
        x, 1 + x, (1 + x) ** 3, None, 2 * x, interpolation="linear", ends=Ends("free", "clamped")
    )
    from antinode.riccati.roots import find_eigenvalues

    found = np.array(
        [[v.omega2 for v in find_eigenvalues(beam.chain("bending", r), 6)] for r in (2, 4, 8, 64)]
    )
    error = np.abs(found[:3] - found[3])
    order = np.log2(error[:-1] / error[1:])
    assert np.all((order > 3.7) & (order < 4.6))


def test_effect_of_the_axial_force():
    result = solve_modes(uniform("pinned", "pinned", 0.19 * math.pi**2), 1, unloaded=True)
    assert result.mode("bending", 1).shift == pytest.approx(math.sqrt(0.81) - 1, rel=1e-10)


def test_model_column_of_a_pinned_beam():
    """Timoshenko but for a term in (r k)^4: 1/sqrt(1 + (r k)^2 (1 + EA/kGA)), k = n pi / L."""
    result = solve_modes(uniform("pinned", "pinned"), 3)
    r2 = 1e-4
    for n in (1, 2, 3):
        expected = 1 / math.sqrt(1 + r2 * (n * math.pi) ** 2 * (1 + 4.9)) - 1
        assert result.mode("bending", n).model_error == pytest.approx(expected, rel=1e-9)


def test_dictionary_is_strict_json():
    data = json.loads(to_json(solve_modes(uniform(N=3.0), 2, unloaded=True).to_dict()))
    rotation = data["modes"][0]
    assert rotation["frequency_hz"] is None
    assert rotation["growth_rate_per_s"] > 0
    assert rotation["bracket_hz"] == [None, None]
    first = data["modes"][2]
    assert (first["family"], first["number"], first["kind"]) == ("bending", 1, "elastic")
    assert first["bracket_hz"][0] < first["frequency_hz"] < first["bracket_hz"][1]


def test_result_prints_and_finds_modes():
    result = solve_modes(uniform(), 2)
    assert "bending 2" in str(result)
    assert "rigid rotation" in str(result)
    with pytest.raises(InputError, match="no mode bending 7"):
        result.mode("bending", 7)
    with pytest.raises(InputError, match="must lie on the beam"):
        result.at([1.5])


@pytest.mark.parametrize(("name", "value"), [("modes", 0), ("modes", 501), ("tolerance", 0.0)])
def test_arguments_out_of_range(name, value):
    with pytest.raises(InputError, match=name):
        solve_modes(uniform(), **{name: value})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": [0.0, 1.0, 1.0]}, "row 3"),
        ({"mass_per_length": [1.0, -2.0, 1.0]}, "mass_per_length must be positive"),
        ({"bending_stiffness": [1.0, math.nan, 1.0]}, "bending_stiffness must be positive"),
        ({"axial_force": [1.0, math.inf, 1.0]}, "axial_force must be finite"),
    ],
)
def test_bad_beams(change, message):
    good = {"x": [0.0, 1.0, 2.0], "mass_per_length": [1.0] * 3, "bending_stiffness": [1.0] * 3}
    with pytest.raises(InputError, match=message):
        Beam.from_stations(**{**good, **change})


@pytest.mark.parametrize("EI", [1e-300, 1.0, 1e300])
@pytest.mark.parametrize("N", [0.0, 1e300, -1e300])
@pytest.mark.parametrize("length", [1e-200, 1.0, 1e100, 1e300])
@pytest.mark.parametrize("solve", [solve_modes, buckling])
def test_absurd_numbers_give_a_result_or_an_error_but_no_warning(solve, length, N, EI):
    beam = Beam.from_stations([0, length], 1.0, EI, EI, N, ends=Ends("pinned", "pinned"))
    try:
        found = solve(beam)
    except (ComputationError, InputError):
        return
    modes = found.modes if found and solve is solve_modes else []
    assert all(math.isfinite(mode.omega2) for mode in modes)
