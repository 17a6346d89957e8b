"""Shapes and their integrals in compiled code against the readable form."""

from dataclasses import replace

import numpy as np
import pytest

from antinode.riccati import shapes
from antinode.riccati.following.roots import Finder
from antinode.riccati.lanes import calls as compiled
from antinode.riccati.points import Point
from antinode.riccati.roots import find_eigenvalues
from law_chains import bending_chain

ENDS = ("free", "clamped", "pinned", "sliding")


def chain_of(rng, left, right, points=True):
    """Some 40 segments with steps in everything, N of both signs, and a point of every kind."""
    n = int(rng.integers(2, 60))
    h = rng.uniform(0.2, 1.8, n)
    h /= h.sum()
    m, EI = 10 ** rng.uniform(-1, 1, n), 10 ** rng.uniform(-1.5, 1.5, n)
    N = rng.uniform(-1, 1, n) * rng.choice([0.0, 1.0, 20.0])
    what = ()
    if points:
        inner = rng.choice(np.arange(1, n), size=min(2, n - 1), replace=False)
        what = tuple(point(rng, node) for node in sorted({0, *map(int, inner), n}))
    return bending_chain(h, m, EI, N, left, right, points=what)


def point(rng, node):
    return Point(
        node,
        mass=rng.uniform(0, 1),
        offset=rng.uniform(-0.1, 0.1),
        inertia=rng.uniform(0, 0.01),
        spring=rng.uniform(0, 50),
        rotational_spring=rng.uniform(0, 1),
        compliance=rng.choice([0.0, 0.3]) if node else 0.0,
        own_load=rng.uniform(-1, 1),
    )


def alone(found):
    """Return the omega^2 of modes that are not rigid and not in clusters."""
    brackets = [value.bracket for value in found]
    single = [v.omega2 for v in found if abs(v.omega2) > 1e-6 and brackets.count(v.bracket) == 1]
    return np.array(single)


def same_up_to_sign(found, expected):
    for column, other in zip(np.moveaxis(found, 1, 0), np.moveaxis(expected, 1, 0), strict=True):
        size = np.max(np.abs(other), axis=0)
        mine = column / np.max(np.abs(column[:, 0])) * np.max(np.abs(other[:, 0]))
        sign = np.sign(np.sum(mine * other / size**2))
        assert np.max(np.abs(sign * mine - other) / size) < 2e-9


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
@pytest.mark.parametrize("points", [False, True])
def test_shapes_and_energies_agree_with_the_readable_form(left, right, points):
    rng = np.random.default_rng([ENDS.index(left), ENDS.index(right), points])
    for modes in (3, 11):
        chain = chain_of(rng, left, right, points)
        omega2 = alone(find_eigenvalues(chain, modes))
        one = np.ones(len(omega2), np.int64)
        states = compiled.mode_states(chain, omega2, one)
        expected = shapes.mode_states(chain, omega2, one)
        assert states.shape == expected.shape
        same_up_to_sign(states, expected)
        mine, theirs = (how.mode_energies(chain, expected, omega2) for how in (compiled, shapes))
        assert mine.mass == pytest.approx(theirs.mass, rel=1e-12)
        assert np.all(np.abs(mine.stiffness - theirs.stiffness) <= 1e-12 * theirs.size)
        for part, other in zip(mine.squares, theirs.squares, strict=True):
            assert part == pytest.approx(other, rel=1e-9, abs=1e-12 * np.max(other))


def test_a_mode_at_one_end_of_a_long_chain():
    """Stiff but for the right end, 4,000 segments: what decays keeps its digits."""
    n = 4000
    EI = np.where(np.arange(n) < 3800, 1e4, 1.0)
    chain = bending_chain(np.full(n, 1 / n), np.ones(n), EI, np.zeros(n))
    omega2 = np.array([v.omega2 for v in find_eigenvalues(chain, 9, zeros=2)[2:]])
    one = np.ones(len(omega2), np.int64)
    states = compiled.mode_states(chain, omega2, one)
    same_up_to_sign(states, shapes.mode_states(chain, omega2, one))
    energies = compiled.mode_energies(chain, states, omega2)
    assert energies.stiffness / energies.mass == pytest.approx(omega2, rel=1e-9)


def test_arrays_of_any_layout_serve():
    """More modes than lanes, read-only and strided tables: the same as of plain ones."""
    h, m, EI, N = np.broadcast_to(np.array([0.1, 1.0, 2.0, 0.3])[:, None], (4, 10))
    chain = bending_chain(h, m, EI, np.repeat(N, 2)[::2])
    plain = bending_chain(*(np.array(v) for v in (h, m, EI, N)))
    omega2 = np.array([v.omega2 for v in compiled.find_eigenvalues(chain, 14, zeros=1)[2:]])
    assert omega2.tolist() == [v.omega2 for v in compiled.find_eigenvalues(plain, 14, zeros=1)[2:]]
    one = np.ones(len(omega2), np.int64)
    states = compiled.mode_states(chain, omega2, one)
    assert np.array_equal(states, compiled.mode_states(plain, omega2, one))
    states.flags.writeable = False
    energies = compiled.mode_energies(chain, states, omega2)
    same = compiled.mode_energies(plain, states, omega2)
    assert np.array_equal(energies.squares.moment, same.squares.moment)


def test_supports_and_clusters_are_left_to_the_readable_form():
    n = 20
    h, one = np.full(n, 0.05), np.ones(n)
    chain = bending_chain(h, one, one, 0 * one, points=(Point(10, holds=(0,)),))
    omega2 = np.array([v.omega2 for v in find_eigenvalues(chain, 4, zeros=1)[1:]])
    single = np.ones(len(omega2), np.int64)
    same_up_to_sign(
        compiled.mode_states(chain, omega2, single), shapes.mode_states(chain, omega2, single)
    )


@pytest.mark.parametrize("adjoint", [False, True])
@pytest.mark.parametrize("following", [(0.0, 1.0), (2.0, 0.0), (2.0, 3.0)])
def test_ends_whose_force_follows(following, adjoint):
    n = 30
    x = (np.arange(n) + 0.5) / n
    h, m, EI, N = np.full(n, 1 / n), 1 + 0.5 * x, 1 + 0.3 * np.sin(4 * x), 1 + x
    fixed = bending_chain(h, m, EI, N, points=(Point(12, mass=0.3, spring=5.0),))
    chain = replace(fixed, following=following)

    def poles(number):
        return find_eigenvalues(fixed, number, zeros=0)

    found = Finder(chain, poles, 0, 1e-12).find(9).eigenvalues
    omega2 = np.array([v.omega2 for v in found])
    assert not any(v.imaginary for v in found)
    one = np.ones(len(omega2), np.int64)
    same_up_to_sign(
        compiled.mode_states(chain, omega2, one, adjoint=adjoint),
        shapes.mode_states(chain, omega2, one, adjoint=adjoint),
    )
