"""Counts and eigenvalues with masses, springs, supports and joints, against many digits."""

import math
from itertools import pairwise

import numpy as np
import pytest

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.riccati.chain import count_below
from reference import BarChain, BeamChain, Node, certain_count, enclose

ENDS = ("free", "clamped", "pinned", "sliding")
AXIAL_HELD = ("clamped", "pinned")
MODES = 4


def draw(seed):
    """A stepped beam with one to six attachments, any ends, tension or compression."""
    rng = np.random.default_rng([2028, seed])
    n = int(rng.integers(1, 8))
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 1.0, n))])
    m, EI, EA = (10.0 ** rng.uniform(-1, decades, n) for decades in (1, 3, 2))
    euler = math.pi**2 / (x[-1] * float(np.sum(np.diff(x) / EI)))
    N = rng.uniform(-1, 1, n) * 10.0 ** rng.uniform(-1, 1) * euler
    left, right = (str(end) for end in rng.choice(ENDS, 2))
    beam = an.Beam.from_stations(x, m, EI, EA, N, ends=an.Ends(left, right))
    items = [attachment(rng, beam, euler) for _ in range(rng.integers(1, 7))]
    if seed % 3 == 0 and n > 1:
        items += joint_at_a_support(rng, float(rng.choice(x[1:-1])), 1 / (euler * x[-1]))
    return beam.with_attachments(*items)


def joint_at_a_support(rng, x, compliance):
    held = [{"translational": math.inf, "axial": math.inf}, {"rotational": math.inf}]
    return [Joint(x, compliance * rng.uniform(), 1.0), Spring(x, **held[rng.integers(2)])]


def attachment(rng, beam, euler):
    x, L = float(rng.choice(beam.x)), beam.length
    a, b, c = 10.0 ** rng.uniform(-2, 2, 3)
    kind = rng.integers(6)
    if kind == 3 and 0 < x < beam.x[-1]:
        return Joint(x, a / (euler * L), b * L / 10.0)
    if kind == 4:
        return Spring(x, math.inf, rotational=a * euler * L, axial=b)
    if kind == 5:
        return Spring(x, a * euler / L, rotational=math.inf)
    if kind == 2:
        return Spring(x, a * euler / L, b * euler * L, c)
    offset = float(rng.uniform(-0.2, 0.2)) * L
    return PointMass(x, a * beam.mass, b * beam.mass * (0.1 * L) ** 2, offset)


def _node(beam, item, axial):
    at = int(np.flatnonzero(beam.x == item.x)[0])
    if isinstance(item, PointMass):
        return Node(at, item.mass, item.offset, item.rotary_inertia)
    if isinstance(item, Joint):
        return Node(at, compliance=item.axial if axial else item.rotational)
    values = (item.axial, 0.0) if axial else (item.translational, item.rotational)
    holds = tuple(i for i, value in enumerate(values) if value == math.inf)
    spring, rotational = (0.0 if value == math.inf else value for value in values)
    return Node(at, spring=spring, rotational_spring=rotational, holds=holds)


def exact_chain(beam, family):
    """The same beam for the reference, its numbers exactly as they are."""
    nodes = tuple(_node(beam, item, family == "longitudinal") for item in beam.attachments)
    h = tuple(_difference(a, b) for a, b in pairwise(beam.x))
    m, EI, EA, N = (
        tuple(values[:, 0].tolist())
        for values in (
            beam.mass_per_length, beam.bending_stiffness, beam.axial_stiffness, beam.axial_force
        )
    )  # fmt: skip
    if family == "bending":
        return BeamChain(h, EI, m, N, beam.ends.left, beam.ends.right, nodes)
    ends = ("fixed" if end in AXIAL_HELD else "free" for end in (beam.ends.left, beam.ends.right))
    return BarChain(h, EA, m, *ends, nodes)


def _difference(a, b):
    return float(b) - float(a)  # the solver's own rounding, so that both have one chain


@pytest.mark.parametrize("family", ["bending", "longitudinal"])
@pytest.mark.parametrize("seed", range(30))
def test_eigenvalues_lie_in_their_brackets_and_counts_between_them_agree(seed, family):
    beam = draw(seed)
    chain = exact_chain(beam, family)
    modes = an.solve_modes(beam, MODES, families=(family,)).modes
    modes = sorted(modes, key=lambda mode: mode.bracket_omega2)[:MODES]
    roots = [enclose(chain, k) for k in range(1, MODES + 1)]
    for mode, root in zip(modes, roots, strict=True):
        low, high = mode.bracket_omega2
        assert low <= root.value <= high
        assert abs(mode.omega2 - root.value) <= mode.error_omega2 or mode.omega2 == 0.0
        assert abs(mode.omega2 - root.value) <= 1e-10 * abs(root.value) or root.value == 0
    _same_counts(beam.chain(family), chain, [float(root.value) for root in roots])


def _same_counts(ours, chain, roots):
    """Below the first root and inside the gaps."""
    points = [roots[0] - abs(roots[0]) - abs(roots[-1]) / 100]
    points += [a + (b - a) * 0.3 for a, b in pairwise(roots) if b - a > 1e-8 * abs(b)]
    expected = [certain_count(chain, point).count for point in points]
    assert expected[0] == 0
    np.testing.assert_array_equal(count_below(ours, np.array(points)), expected)
