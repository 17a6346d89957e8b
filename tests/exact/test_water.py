"""A vehicle on the water's stiffness: its complex modes against a dense quadratic eigenproblem."""

import numpy as np
import pytest

import antinode as an
from antinode.show.water import bending_off_contact, contact_ends
from antinode.stability.along import follow
from cli_run import run
from water_elements import case_of, dense, lowest, matrices


@pytest.fixture(scope="module")
def starter(tmp_path_factory):
    folder = tmp_path_factory.mktemp("water")
    run("init", "--example", "sweep", folder)
    return folder / "case.toml"


@pytest.mark.parametrize("end_force", ["fixed_direction", "follows_body"])
def test_the_starter_on_its_water(starter, end_force):
    case = case_of(starter, end_force=end_force)
    result = an.solve_modes(case, 4, families=["bending"])
    exact = dense(case)
    for mode in result.modes:
        s = mode.eigenvalue_per_s
        nearest = exact[np.argmin(np.abs(exact - s))]
        assert abs(s - nearest) <= 2e-7 * abs(exact[5])
    below = exact[np.abs(exact) < 0.99 * abs(result.modes[-1].eigenvalue_per_s)]
    assert len(below) == len(result.modes) - 1


def test_contact_on_and_off_and_where_it_ends(starter):
    case = case_of(starter, end_force="follows_body")
    result = an.solve_modes(case, 3, families=["bending"])
    exact = lowest(*matrices(case, off=["planing"]))
    found = bending_off_contact(case, result)
    hertz = np.sort(exact.imag[exact.imag > 1e-3])[:3] / (2 * np.pi)
    assert [m.frequency_hz for m in found[:3]] == pytest.approx(hertz, rel=1e-6)
    planing = next(t for t in case.tangents if t.name == "planing")
    for end in contact_ends(case, result):
        mode = next(m for m in result.modes if m.name == end.name)
        # at this amplitude of the tail the wetted depth of the steady state is just undone
        assert end.amplitude == case.loads.planing.h * case.vehicle.radius_at(np.array([6.0]))[0]
        assert end.acceleration == pytest.approx(
            (2 * np.pi * mode.frequency_hz) ** 2 * planing.room
        )
        deflection = np.abs(mode.phasors[:, 0])
        assert end.largest / end.amplitude == pytest.approx(deflection.max() / deflection[-1])


def test_a_spring_at_the_tail_alone(starter):
    """Contact of the starter as a spring and a dashpot, without what turns or the fins' lift."""
    case = case_of(starter, hydrodynamic_stiffness="none", end_force="fixed_direction")
    tangent = next(t for t in case_of(starter).tangents if t.name == "planing")
    spring = an.Spring(tangent.x, translational=tangent.spring)
    dashpot = an.Dashpot(tangent.x, translational=tangent.dashpot)
    result = an.solve_modes(case.beam().with_attachments(spring, dashpot), 4, families=["bending"])
    hertz = [m.frequency_hz for m in result.modes if m.frequency_hz > 0]
    assert hertz[:3] == pytest.approx([2.11, 8.25, 16.67], abs=0.01)


def test_it_stands_first_among_what_is_left_out_until_it_is_solved(starter):
    plain = an.solve_modes(
        case_of(starter, hydrodynamic_stiffness="none"), 2, families=["bending"]
    ).to_dict()
    solved = an.solve_modes(case_of(starter), 2, families=["bending"]).to_dict()
    assert plain["not_modelled"][0].startswith("hydrodynamic stiffness")
    assert not any("hydrodynamic" in words for words in solved["not_modelled"])
    assert "damping" not in solved["not_modelled"]


# a pair that is about to meet beside s = 0; two real ones there; a pole of g next to a real one;
# the contact gone, so that a translation rests
SPEEDS = [68.80147, 68.8015, 72.0, 95.0]


@pytest.mark.parametrize("speed", SPEEDS)
def test_lists_are_proven_beside_the_crossing_of_zero(starter, speed):
    case = case_of(starter, speed)
    result = an.solve_modes(case, 3, families=["bending"], tolerance=1e-3)
    assert result.certificate["kind"] == "winding"
    exact = dense(case)
    for mode in (m for m in result.modes if m.eigenvalue_per_s):
        s = mode.eigenvalue_per_s
        off = 2e-7 * abs(exact[5]) * max(1.0, 1 / abs(s))  # of the elements
        assert np.min(np.abs(exact - s)) <= mode.error_per_s + off
        assert mode.error_per_s <= 2e-3 * abs(s)


def on_two_forces(following):
    """A free beam on what is like a fin and a planing tail, both damped."""
    fin = an.PointFeedback.of(0.2, np.diag([2.0, 0.0]), np.diag([0.05, 0.0]))
    tail = np.array([[3.0, following], [0.0, 0.0]])
    planing = an.PointFeedback.of(1.0, tail, np.array([[0.3, 0.0], [0.0, 0.0]]))
    return an.Beam.from_stations([0, 1], 1.0, 1.0).with_attachments(fin, planing)


def test_a_real_root_passes_zero():
    """A pair meets on the real axis, and one of the two passes s = 0.

    At rest both forces vanish, whatever the beam's stiffness: Y = 0 at 0.2, 3 Y + following psi at
    1, so that following = -3 * 0.8.
    """
    found = follow(on_two_forces, -4.0, -1.0, points=2)
    (change,) = found.critical
    assert (change.kind, change.change) == ("divergence", "regained")
    assert change.proven
    assert not found.warnings
    assert change.value == pytest.approx(-2.4, abs=1e-9)
    assert change.bracket[0] < -2.4 < change.bracket[1]
    assert change.bracket[1] - change.bracket[0] < 1e-8
    beside = [
        an.solve_modes(on_two_forces(v), 2, families=["bending"]) for v in (-2.39, -2.4 + 1e-7)
    ]
    assert all(result.certificate["kind"] == "winding" for result in beside)
    assert beside[1].modes[1].eigenvalue_per_s.real == pytest.approx(0.0, abs=1e-5)
