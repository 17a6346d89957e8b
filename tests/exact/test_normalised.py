"""Modes as they are given out: compiled against readable, and against quadrature."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends, Joint, PointMass, Spring, solve_modes
from antinode.riccati import readable, shapes
from antinode.riccati.lanes import calls as compiled
from antinode.riccati.laws import BAR, SHAFT
from antinode.riccati.normalised import Wanted
from antinode.riccati.points import Point
from law_chains import bending_chain

ENDS = ("free", "clamped", "pinned", "sliding")


def random_chain(rng, what):
    """Some segments with steps in all columns of a law, a point of every kind at some nodes."""
    n = int(rng.integers(2, 30))
    h = rng.uniform(0.2, 1.8, n) / n
    m, EI = 10 ** rng.uniform(-0.5, 0.5, n), 10 ** rng.uniform(-0.7, 0.7, n)
    N = rng.uniform(-3, 3, n)
    points = tuple(
        Point(
            k,
            mass=rng.uniform(0, 0.3),
            offset=rng.uniform(-0.1, 0.1),
            inertia=rng.uniform(0, 0.01),
            spring=rng.uniform(0, 50),
            rotational_spring=rng.uniform(0, 1),
            coupling=rng.uniform(0, 1),
            compliance=0.1 if 0 < k < n else 0.0,
            own_load=rng.uniform(-1, 1),
        )
        for k in (0, n // 2, n)
        if "points" in what and (k or n > 2)
    )
    chain = bending_chain(h, m, EI, N, *rng.choice(ENDS, 2), points=points)
    if "sheared" in what:
        s = 0.01 / EI
        more = {"shear": s, "shear_turn": s * N, "shear_work": s * N**2}
        more |= {"rotary_inertia": 0.003 * m, "foundation": rng.uniform(0, 9, n)}
        chain = chain.with_columns(**more)
    if "following" in what:
        chain = replace(chain, left="free", right="free", following=(0.7, 1.1))
    return chain


def some_states(rng, chain, modes):
    """Any states along a chain: solutions of its equations from states at the left end."""
    omega2 = np.sort(rng.uniform(-20, 900, modes))
    units = shapes.state_units(chain, omega2)
    z = [rng.uniform(-1, 1, (modes, chain.law.size)) * units]
    for k, U in enumerate(shapes.segment_transfers(chain, omega2)):
        z.append(np.einsum("kij,kj->ki", U, z[k] / units) * units)
    return omega2, np.array(z)


def places_of(rng, chain):
    """Positions between the nodes and at them, one doubled."""
    nodes = chain.nodes
    inner = nodes[1:-1][: max(len(nodes) - 3, 1)]
    return np.sort(np.concatenate([nodes, inner[:1], rng.uniform(0, nodes[-1], 20)]))


@pytest.mark.parametrize("what", ["", "points", "sheared", "sheared points", "following points"])
@pytest.mark.parametrize("by_mass", [False, True])
@pytest.mark.parametrize("modes", [3, 11])
def test_the_compiled_call_gives_what_the_readable_one_does(what, by_mass, modes):
    rng = np.random.default_rng([len(what), by_mass, modes])
    for _ in range(6):
        given = random_chain(rng, what)
        places = places_of(rng, given)
        omega2, states = some_states(rng, given, modes)
        chain = compiled.cut(given, places, omega2)
        same = readable.cut(given, places, omega2)
        assert chain.length == pytest.approx(same.length, rel=1e-13, abs=1e-15)
        assert all(np.array_equal(chain.columns[name], same.columns[name]) for name in same.columns)
        assert chain.points == same.points
        omega2, states = some_states(rng, chain, modes)
        left = some_states(rng, chain, modes)[1] if chain.follows else None
        wanted = Wanted(places, rng.uniform(0.1, 1, (2, len(chain.length))), by_mass)
        mine, theirs = (
            how.normalise(chain, states, omega2, wanted, left) for how in (compiled, readable)
        )
        for found, expected in zip(mine[:2], theirs[:2], strict=True):
            size = np.max(np.abs(expected), axis=(0, 1))
            assert np.max(np.abs(found - expected) / size) < 1e-12
        sizes = np.abs(theirs.forms.size) + np.abs(theirs.forms.mass)
        for name, found, expected in zip(mine.forms._fields, mine.forms, theirs.forms, strict=True):
            assert np.all(np.abs(found - expected) <= 1e-11 * (np.abs(expected) + sizes)), name


@pytest.mark.parametrize("what", ["", "points", "sheared"])
@pytest.mark.parametrize("modes", [3, 11])
def test_modes_are_solved_and_scaled_in_one_compiled_call(what, modes):
    """A rigid motion is given, whatever its chain: it is not solved for."""
    rng = np.random.default_rng([len(what), modes, 7])
    for turn in range(4):
        given = random_chain(rng, what)
        zero = [] if turn % 2 else [0.0]
        found = [value.omega2 for value in readable.find_eigenvalues(given, modes - len(zero))]
        omega2 = np.array(zero + found)
        motions = np.full((modes, 2), np.nan)
        motions[: len(zero)] = 0.3, -1.1
        places = np.unique(places_of(rng, given))  # at steps both sides of a mode, not of a motion
        chain = compiled.cut(given, places, omega2)
        wanted = Wanted(places, rng.uniform(0.1, 1, (2, len(chain.length))), False)
        mine, theirs = (
            how.normal_modes(chain, omega2, motions, wanted) for how in (compiled, readable)
        )
        for got, expected in zip(mine[:2], theirs[:2], strict=True):
            size = np.max(np.abs(expected), axis=(0, 1))
            assert np.max(np.abs(got - expected) / size) < 1e-8
        for got, expected in zip(mine.forms[:2], theirs.forms[:2], strict=True):
            assert got == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.max(np.abs(expected)))


def test_segments_too_long_for_the_series_are_cut():
    chain = bending_chain(np.ones(3), np.ones(3), np.ones(3), np.zeros(3))
    places = np.linspace(0, 3, 7)
    found, expected = (how.cut(chain, places, np.array([0.0, 4e3])) for how in (compiled, readable))
    assert found.length == pytest.approx(expected.length, rel=1e-14)
    assert np.max(shapes.largest_wave_number(found, 4e3) * found.length) <= 1.5
    assert len(compiled.cut(chain, places, np.array([1.0])).length) == 6


@pytest.mark.parametrize("law", [BAR, SHAFT])
def test_waves_are_normalised_by_the_readable_form(law):
    n = 5
    chain = replace(
        bending_chain(np.ones(n), np.ones(n), np.ones(n), np.zeros(n)),
        law=law,
        columns={"mass": np.ones(n), "stiffness": np.ones(n)},
    )
    omega2, states = some_states(np.random.default_rng(1), chain, 3)
    wanted = Wanted(np.linspace(0, n, 9), np.zeros((2, n)), False)
    mine, theirs = (how.normalise(chain, states, omega2, wanted) for how in (compiled, readable))
    assert np.array_equal(mine.at_places, theirs.at_places)


def beams():
    """Beams of every law and kind of point, with rigid, divergent and double modes."""
    n, x = 12, np.linspace(0.0, 6.0, 13)
    m, EI, N = np.full(n, 3.0), np.full(n, 4e3), np.linspace(50, 300, n)
    plain = Beam.from_stations(x, m, EI, EI * 100, N)
    yield "free", plain
    yield "pushed", Beam.from_stations(x, m, EI, None, 20 * N, ends=Ends("pinned", "pinned"))
    yield "follows", replace(plain, ends=Ends(left_follower=1.0, right_follower=1.0))
    sheared = Beam.from_stations(
        x,
        m * (1 + x[:-1]),
        EI,
        None,
        N,
        shear_stiffness=EI * 8,
        rotary_inertia_per_length=m * 0.01,
        foundation_stiffness=np.full(n, 90.0),
    )
    yield "sheared", sheared
    yield (
        "carries",
        plain.with_attachments(
            PointMass(2.2, 4.0, rotary_inertia=0.2, offset=0.3),
            Spring(6.0, translational=900.0, rotational=20.0, coupling=9.0),
            Joint(4.0, rotational=1e-4, axial=1e-6),
        ),
    )
    hinged = Joint(3.0, rotational=1e3)  # halves between which hardly anything is shared
    pinned = Beam.from_stations(x, m, EI, ends=Ends("pinned", "pinned"))
    stiff = Spring(3.0, translational=1e9)
    yield "double", pinned.with_attachments(stiff, hinged)
    yield (
        "twists",
        Beam.from_stations(x, m, EI, torsional_stiffness=EI, polar_inertia_per_length=m * 0.1),
    )


@pytest.mark.parametrize("normalisation", ["amplitude", "mass"])
@pytest.mark.parametrize("beam", [pytest.param(b, id=name) for name, b in beams()])
def test_both_backends_give_the_same_modes(beam, normalisation):
    numpy, numba = (
        solve_modes(beam, 9, normalisation=normalisation, backend=name)
        for name in ("numpy", "numba")
    )
    assert np.array_equal(numpy.x, numba.x)
    for one, other in zip(numpy.modes, numba.modes, strict=True):
        assert (one.name, one.kind) == (other.name, other.kind)
        assert abs(one.omega2 - other.omega2) <= one.error_omega2 + other.error_omega2
        if one.residual > 1e-9 or len({m.bracket_omega2 for m in numpy.modes}) < len(numpy.modes):
            continue
        assert other.modal_mass == pytest.approx(one.modal_mass, rel=1e-8)
        size = np.max(np.abs(one.states), axis=0)
        off = np.abs(one.states - other.states) / np.where(size > 0, size, 1.0)
        assert np.max(off) < 1e-7, one.name
        assert (one.model_error is None) == (other.model_error is None)
        if one.model_error is not None:
            assert other.model_error == pytest.approx(one.model_error, rel=1e-7)


def test_modal_mass_is_that_of_a_fine_quadrature():
    """The integral of m Y^2 over 24,000 places, and rho I psi^2 with it, of given shapes."""
    beam = dict(beams())["sheared"]
    found = solve_modes(beam, 5)
    solution = found.solutions["bending"]
    x = (np.arange(24_000) + 0.5) * (beam.length / 24_000)
    states = solution.at(x)
    k = np.minimum((x / beam.length * 12).astype(int), 11)
    m, rotary = beam.mass_per_length[k, 0], beam.rotary_inertia_per_length[k, 0]
    mass = (m @ states[..., 0] ** 2 + rotary @ states[..., 1] ** 2) * (beam.length / 24_000)
    assert [mode.modal_mass for mode in found.modes] == pytest.approx(mass, rel=1e-6)


def test_the_largest_displacement_is_one_between_nodes_too():
    """Three segments: a peak lies between the places of the grid, and is one there."""
    x = np.linspace(0.0, 1.0, 4)
    beam = Beam.from_stations(x, np.ones(3), np.array([1.0, 2.0, 1.5]))
    solution = solve_modes(beam, 8).solutions["bending"]
    fine = solution.at(np.linspace(0.0, 1.0, 200_001))
    assert np.max(np.abs(fine[..., 0]), axis=0) == pytest.approx(1.0, abs=1e-9)
