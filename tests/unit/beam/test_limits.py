"""Guards against forces of a wrong unit let through what the world is built of."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends, InputError, natural_frequencies, solve_modes
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.beam.limits import check_limits
from antinode.riccati.chain import count_below

ENDS = Ends("pinned", "pinned", right_axial="free")


def string(length, bit=250e3, collars=300.0):
    """A drill string hanging from its top, its collars partly on bottom."""
    x = [0.0, length - collars, length]
    beam = Beam.from_stations(x, [31.0, 150, 150], [1.3e6, 8e6, 8e6], [0.75e9, 4e9, 4e9], ends=ENDS)
    return apply_loads(beam, AxialLoads(8.4, point_forces=(PointForce(length, -bit),)))


def test_a_string_of_9_km_with_eight_divergent_modes():
    """Eight by an LDL count of finite elements; the largest N along all the length gave 17."""
    beam = string(9000.0)
    check_limits(beam)
    assert count_below(beam.chain("bending"), 0.0).tolist() == [8]


@pytest.mark.parametrize("length", [3600.0, 6000.0])
def test_shorter_strings(length):
    check_limits(string(length))


def test_a_riser_in_tension_over_most_of_one_interval():
    """2 km of one interval: compressed in its lowest tenth only, by a force that looks like 20."""
    beam = Beam.from_stations(
        [0.0, 2000.0],
        [500.0, 500.0],
        [4e7, 4e7],
        axial_force=[-9 * 8e4, 8e4],
        interpolation="linear",
        ends=Ends("pinned", "pinned"),
    )
    check_limits(beam)
    stiff = Beam.from_stations(
        [0.0, 2000.0],
        [500.0, 500.0],
        [2e6, 2e8],
        axial_force=[-9 * 8e5, 8e5],
        interpolation="linear",
        ends=Ends("pinned", "pinned"),
    )
    check_limits(stiff)


def test_the_tensest_beam_allowed_is_solved():
    """Pinned-pinned in uniform tension, closed form (n pi)^4 + T (n pi)^2, in units of EI/L^2."""
    one, T = np.ones(2), 9.9e8
    beam = Beam.from_stations([0, 1], one, one, axial_force=-T * one, ends=Ends("pinned", "pinned"))
    check_limits(beam)
    mode = solve_modes(beam, 1).modes[0]
    assert mode.omega2 == pytest.approx(np.pi**4 + T * np.pi**2, rel=1e-9)


@pytest.mark.parametrize(("force", "said"), [(1e9, "modes diverge"), (-2e9, "is a string")])
def test_forces_of_a_wrong_unit_are_still_refused(force, said):
    one = np.ones(2)
    with pytest.raises(InputError, match=said):
        check_limits(Beam.from_stations([0, 1], one, one, axial_force=force * one))


@pytest.mark.parametrize(("T", "backend"), [(4e7, "numpy"), (4e7, "numba"), (2.2e8, "numba")])
def test_shapes_of_strings(T, backend):
    """Layers sqrt(EI/T) far thinner than the output grid: sin(k pi x), modal mass m L/2."""
    beam = Beam.from_stations([0, 1], 1.0, 1.0, None, -T, ends=Ends("pinned", "pinned"))
    found = solve_modes(beam, 2, backend=backend)
    for k, mode in enumerate(found.modes, 1):
        true = np.sqrt((k * np.pi) ** 4 + T * (k * np.pi) ** 2) / (2 * np.pi)
        assert abs(mode.frequency_hz - true) <= mode.error_hz < 1e-9 * true
        assert mode.modal_mass == pytest.approx(0.5, rel=1e-9)
        assert mode.residual < 1e-9
        assert np.abs(mode.shape) == pytest.approx(np.abs(np.sin(k * np.pi * found.x)), abs=1e-9)
    x = np.array([0.123, 0.9])
    assert np.abs(found.at(x)[:, 0, 0]) == pytest.approx(np.sin(np.pi * x), abs=1e-9)


@pytest.mark.parametrize("T", [2e9, 1e14])
def test_python_is_told_of_a_string_too(T):
    """Its shapes took minutes; frequencies alone are soon there."""
    beam = Beam.from_stations([0, 1], 1.0, 1.0, None, -T, ends=Ends("pinned", "pinned"))
    with pytest.raises(InputError, match=r"is a string.*natural_frequencies"):
        solve_modes(beam, 1)


def test_a_string_by_its_own_weight_is_told_of():
    """A wire of 100 km under its weight: no entry of its table is large, the weight makes N."""
    hung = Ends("pinned", "free", left_axial="fixed", right_axial="free")
    wire = Beam.from_stations([0, 1e5], 1e-3, 1e-4, 10.0, ends=hung)
    with pytest.raises(InputError, match="is a string"):
        solve_modes(apply_loads(wire, AxialLoads(9.81)), 1)


def test_frequencies_of_a_string_beyond_the_limit():
    T, k = 1e10, np.pi * np.arange(1, 4)
    beam = Beam.from_stations([0, 1], 1.0, 1.0, None, -T, ends=Ends("pinned", "pinned"))
    found = natural_frequencies(beam, 3)
    true = np.sqrt(k**4 + T * k**2) / (2 * np.pi)
    assert np.all(np.abs(found.frequencies_hz - true) <= found.error_hz)


def test_a_short_taut_piece_is_no_string():
    """The largest tension over the smallest stiffness times the whole length squared is 1e11."""
    beam = Beam.from_stations([0, 0.01, 1], 1.0, [1.0, 1e3, 1e3], None, [-1e11, 0, 0])
    solve_modes(beam, 1, families=["bending"])


def test_the_force_named_is_that_of_the_loads_too():
    """N of an acceleration alone stands in no column."""
    beam = Beam.from_stations([0, 1, 2], 1.0, 1.0, ends=Ends("free", "clamped"))
    loaded = replace(beam, axial_acceleration=1e6)
    with pytest.raises(InputError, match=r"the axial force of up to 1\.9\de\+06 N"):
        check_limits(loaded)


@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_a_force_far_beyond_the_stiffness_in_shear_is_refused_at_once(form):
    """N/kGA of a rubber bearing is some ten; of 1e8 the modes would take minutes to fail."""
    N = 1e-3 if form == "haringx" else -1e-3
    columns = {"shear_stiffness": [1e-11, 1e-11], "shear_form": form}
    for factor, refused in ((1.0, True), (1e-7, False)):
        force = [factor * N] * 2
        beam = Beam.from_stations([0, 1], 1.0, 1.0, None, force, **columns)
        if refused:
            with pytest.raises(InputError, match="1000 times the stiffness in shear of 1e-11 N"):
                check_limits(beam)
        else:
            check_limits(beam)
