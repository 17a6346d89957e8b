"""Chains at complex s in compiled code: every answer against numpy's, which is the form to read."""

from dataclasses import replace

import numpy as np
import pytest
from damped_beams import random_beam

import antinode as an
from antinode.riccati.chain import Chain, omega2_scale
from antinode.riccati.damped.chain import Damped
from antinode.riccati.damped.compiled import Compiled
from antinode.riccati.damped.energies import products
from antinode.riccati.damped.ratio import Ratio
from antinode.riccati.damped.search import Search
from antinode.riccati.damped.shapes import complex_states
from antinode.riccati.laws import BENDING
from antinode.riccati.points import Point
from law_chains import bar_chain

ENDS = "free", "clamped", "pinned", "sliding"


def drawn(seed):
    """A chain with all that a chain may have, in numpy and compiled."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 9))
    m, EI, s = np.exp(rng.normal(0, 0.5, (3, n)))
    N, s = rng.uniform(-3, 3, n), 1e-3 * s
    columns = {"mass": m, "stiffness": EI, "axial_force": N}
    if seed % 2:
        more = {"shear": s, "shear_turn": s * N, "shear_work": s * N * N}
        columns |= more | {"rotary_inertia": 1e-3 * m, "foundation": rng.uniform(0, 50, n)}
    lossy = columns | {"stiffness": EI * (1 + 1j * rng.uniform(0, 0.05, n))}
    left, right = rng.choice(ENDS, 2).tolist()
    K, C = rng.normal(size=(2, 4))
    node = int(rng.integers(1, n))
    points = [
        Point(
            *(node, 0.4, 0.05, 0.01, 30.0, 4.0, 2.0),
            compliance=0.05,
            own_load=1.5,
            dashpot=0.7,
            rotational_dashpot=0.1,
            feedback=tuple(K.tolist()),
            feedback_damping=tuple((0.1 * C).tolist()),
        )
    ]
    if seed % 3:
        held = (0,), (1,), (0, 1)
        points.append(Point(min(node + 1, n), holds=held[seed % 3] if node + 1 < n else ()))
    if left == "free":
        points.insert(0, Point(0, mass=0.3, spring=20.0, dashpot=0.5))
    follows = tuple(float(end == "free") * rng.uniform(0, 2) for end in (left, right))
    chain = Chain(
        BENDING, rng.uniform(0.1, 0.4, n), columns, left, right, tuple(points), following=follows
    )
    own = Damped(chain, lossy if seed % 4 == 3 else None)
    return own, replace(own, form=Compiled), rng


def places(chain, rng, number=13):
    """Places s all over the upper half plane."""
    size = np.sqrt(omega2_scale(chain)) * np.exp(rng.uniform(0, 5, number))
    return size * np.exp(1j * rng.uniform(0, np.pi, number))


@pytest.mark.parametrize("seed", range(16))
def test_the_characteristic_function(seed):
    own, fast, rng = drawn(seed)
    s = places(own.chain, rng)
    (value, size), (other, other_size) = own.characteristic(s), fast.characteristic(s)
    np.testing.assert_allclose(other / value * np.exp(other_size - size), 1.0, rtol=1e-11)
    assert fast.other.characteristic(s) is not None  # it was compiled code that answered


@pytest.mark.parametrize("seed", range(8))
def test_zeros_shapes_and_forms(seed):
    own, fast, _ = drawn(seed)
    unit = 60 * np.sqrt(omega2_scale(own.chain))
    starts = 1j * unit * np.array([0.05, 0.2, 0.4, 0.9]) + 1e-3 * unit
    mirrored = own.columns is None
    found, step = Search(own, 0, unit, mirrored).run(starts, [])
    same, other_step = Search(fast, 0, unit, mirrored).run(starts, [])
    good = np.isfinite(step) & (np.abs(found) < 2 * unit)
    assert good.sum() > 1
    np.testing.assert_allclose(same[good], found[good], rtol=1e-9)
    assert np.isfinite(other_step[good]).all()
    known = [complex(found[good][0])]
    left_out, _ = Search(fast, 0, unit, mirrored).run(starts[good][:1], known)
    assert abs(left_out[0] - known[0]) > 1e-3 * abs(known[0])
    s = found[good]
    right, states = complex_states(own, s), complex_states(fast, s)
    parted = any(len(point.holds) > 1 for point in own.points)
    assert (fast.other.states(s) is None) == parted  # else it was compiled code that answered
    scale = np.sum(states.conj() * right, axis=(0, 2)) / np.sum(np.abs(states) ** 2, axis=(0, 2))
    size = np.max(np.abs(right), axis=0)
    off = np.abs(states * scale[:, None] - right) / size
    assert np.max(off) < 1e-7
    left = complex_states(own.transposed, s)
    chain = replace(own.chain, columns=own.columns or own.chain.columns)
    forms = products(own, chain, s, right, left)[:4]
    for a, b in zip(forms, forms_of(fast, s, right, left), strict=True):
        np.testing.assert_allclose(b, a, rtol=1e-9, atol=1e-12 * np.max(np.abs(a)))


def forms_of(fast, s, right, left):
    assert fast.other.products(s, right, left) is not None
    chain = replace(fast.chain, columns=fast.columns or fast.chain.columns)
    return products(fast, chain, s, right, left)[:4]


@pytest.mark.parametrize("seed", range(8))
def test_samples_of_the_ratio_and_their_bounds(seed):
    own, fast, rng = drawn(seed)
    scale = omega2_scale(own.chain)
    s = places(own.chain, rng)
    s[0], s[1] = abs(s[0]), 1j * abs(s[1])  # on the axes omega^2 is real
    poles = scale * np.sort(np.exp(rng.uniform(0, 9, 7)))
    a, b = Ratio(own, poles).samples(s), Ratio(fast, poles).samples(s)
    assert type(b) is not type(a)
    for mine, other in zip(a, b, strict=True):
        np.testing.assert_allclose(other, mine, rtol=1e-8, atol=1e-9 * np.max(np.abs(mine)))
    far = rng.uniform(0, 1e-2, len(s)) * np.abs(s)
    np.testing.assert_allclose(b.spread(far), a.spread(far), rtol=1e-7)
    np.testing.assert_allclose(Ratio(fast, poles).values(s), a.value, rtol=1e-9)
    omega2 = -s * s
    G = Ratio(own, poles).receptances(omega2)
    np.testing.assert_allclose(
        Ratio(fast, poles).receptances(omega2), G, rtol=1e-8, atol=1e-10 * np.max(np.abs(G))
    )


@pytest.mark.parametrize("seed", range(6))
def test_lists_of_both_backends_agree(seed):
    beam = random_beam(np.random.default_rng(7000 + seed))
    fast, slow = (
        an.solve_modes(beam, 4, families=("bending",), backend=name, damping="complex")
        for name in ("numba", "numpy")
    )
    assert fast.certificate["kind"] == slow.certificate["kind"] == "winding"
    assert [m.name for m in fast.modes] == [m.name for m in slow.modes]
    for a, b in zip(fast.modes, slow.modes, strict=True):
        assert abs(a.eigenvalue - b.eigenvalue) <= a.error_per_s + b.error_per_s
        assert a.modal_mass == pytest.approx(b.modal_mass, rel=1e-6)


def test_what_a_list_says_does_not_depend_on_what_was_asked_before():
    _, fast, rng = drawn(2)
    s = places(fast.chain, rng)
    fresh = replace(fast).characteristic(s[:3])
    fast.characteristic(100 * s)
    for a, b in zip(fast.characteristic(s[:3]), fresh, strict=True):
        assert np.array_equal(a, b)


def test_bars_and_loads_that_turn_are_for_numpy():
    bar = bar_chain(np.ones(2), np.ones(2), np.ones(2))
    assert Damped(bar, form=Compiled).other.characteristic(np.array([1j])) is None
    own, _, _ = drawn(0)
    columns = dict(own.chain.columns) | {"tangential": np.ones(len(own.chain.length))}
    turning = Damped(replace(own.chain, columns=columns), form=Compiled)
    assert turning.other.states(np.array([1j])) is None
