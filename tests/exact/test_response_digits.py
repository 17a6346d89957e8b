"""Frequency responses of odd beams against sixty digits: no error is stated too small.

Drawn: intervals of a ten-millionth of the beam, loss of their own, shear, rotary inertia, soil,
water, N, following ends; masses up to 1e9 times the beam's, off their nodes too, stiff springs,
dashpots, joints, all at one place, with force and output there as well; loss factors of 0.5 to 0,
frequencies from a standstill to far above, and on resonances.
"""

import numpy as np
import pytest

import antinode as an
from forced_digits import states

QUANTITIES = "displacement", "slope", "bending_moment", "shear_force"
ENDS = (
    ("clamped", "free"),
    ("free", "free"),
    ("pinned", "pinned"),
    ("clamped", "clamped"),
    ("free", "pinned"),
    ("sliding", "free"),
    ("free", "sliding"),
)


def two(values):
    return np.repeat(np.asarray(values)[:, None], 2, axis=1)


def drawn(rng):
    n, length = int(rng.integers(1, 6)), 10 ** rng.uniform(-2, 3)
    width = rng.uniform(0.3, 1, n)
    if rng.random() < 0.4:
        width[rng.integers(n)] *= 10 ** rng.uniform(-7, -2)
    x = np.concatenate([[0], np.cumsum(width)])
    x *= length / x[-1]
    m, EI = (
        10 ** rng.uniform(*ends) * np.exp(rng.normal(0, rng.choice([0.3, 2.0]), n))
        for ends in ((-1, 3), (-1, 9))
    )
    tables = {"axial_force": np.zeros(n)}
    if rng.random() < 0.5:
        tables["shear_stiffness"] = np.exp(rng.uniform(3.1, 8, n)) * np.mean(EI) / length**2
        tables["rotary_inertia_per_length"] = m * (length * np.exp(rng.uniform(-5, -2))) ** 2
    if rng.random() < 0.3:
        tables["foundation_stiffness"] = 10 ** rng.uniform(-1, 3, n) * np.mean(EI) / length**4
        tables["added_mass_per_length"] = m * rng.uniform(0, 2, n)
        tables["loss_factor"] = rng.uniform(0, 0.1, n)
    left, right = ENDS[rng.integers(len(ENDS))]
    shares = {}
    if rng.random() < 0.6:
        N = rng.uniform(-20, 1) * np.min(EI) / length**2
        tables["axial_force"] = N * rng.uniform(0.2, 1, n)
        shares["right_follower"] = float(right == "free" and rng.random() < 0.5)
        shares["left_follower"] = 0.3 * (left == "free" and rng.random() < 0.5)
    beam = an.Beam(
        x=x,
        mass_per_length=two(m),
        bending_stiffness=two(EI),
        axial_stiffness=two(1e4 * EI / length**2),
        ends=an.Ends(left, right, **shares),
        **{name: two(table) for name, table in tables.items()},
    )
    K, M = np.mean(EI) / length**3, np.mean(m) * length
    return beam.with_attachments(*attached(rng, beam, K, M))


def attached(rng, beam, K, M):
    """Return up to three parts, mostly at one place."""
    at, inner, L = float(rng.choice(beam.x)), beam.x[1:-1], beam.length
    drag = np.sqrt(K * M)
    for _ in range(int(rng.integers(0, 4))):
        size = float(10 ** rng.uniform(-2, 2))
        kind = rng.integers(4)
        if kind == 0:
            heavy = float(M * 10 ** rng.choice([-2.0, 0.0, 4.0, 9.0]))
            yield an.PointMass(at, heavy, M * L**2 * size / 1e3, float(rng.choice([0, L / 30])))
        elif kind == 1:
            yield an.Spring(at, K * size**4, K * L**2 * size)
        elif kind == 2:
            yield an.Dashpot(at, drag * size, drag * L**2 * size / 100)
        elif at in inner:
            yield an.Joint(at, size / (K * L**2))
            return


@pytest.mark.parametrize("seed", range(24))
def test_no_error_is_below_the_true_one(seed):
    rng = np.random.default_rng([1820, seed])
    beam = drawn(rng)
    unit = np.sqrt(np.mean(beam.bending_stiffness) / np.mean(beam.mass_per_length))
    hertz = unit / beam.length**2 * np.sort(10 ** rng.uniform(-4, 2.3, 3))
    modes = an.solve_modes(beam, 2, families=["bending"], damping="none").modes
    hertz = np.unique([*hertz, *(m.frequency_hz for m in modes if m.frequency_hz > 1e-6 * unit)])
    force, seen = (float(rng.choice(beam.x)) for _ in range(2))
    eta, side = float(rng.choice([0, 1e-4, 0.02, 0.5])), str(rng.choice(["left", "right"]))
    outputs = [an.Output(seen, quantity, side=side) for quantity in QUANTITIES]
    found = an.frequency_response(
        beam,
        hertz,
        [an.Force(force)],
        outputs,
        damping=an.Damping(eta),
        backend=("numba", "numpy")[seed % 2],
    )
    node = beam.x.tolist().index(seen)
    on_left = node == len(beam.x) - 1 or (side == "left" and node > 0)
    for k, f in enumerate(hertz.tolist()):
        exact = np.array(states(beam, 2 * np.pi * f, eta, force)[not on_left][node])
        away = np.abs(found.values[:, 0, k] - exact)
        assert np.all(away <= found.error[:, 0]), (f, away, found.error[:, 0])


def test_a_pole_has_an_answer_without_a_certain_digit():
    """A uniform pinned beam without damping, driven on its first resonance to the last bit."""
    beam = an.Beam.from_stations([0, 0.5, 1], 1.0, 1.0, ends=an.Ends("pinned", "pinned"))
    places = an.Force(0.5), an.Output(0.5, "displacement")
    for backend in ("numba", "numpy"):
        found = an.frequency_response(beam, [np.pi / 2, 3.0], *places, backend=backend)
        assert np.isfinite(found.values).all()
        assert abs(found.values[0, 0, 0]) > 1e10
        assert found.error[0, 0] == np.inf
        beside = an.frequency_response(beam, [np.pi / 2 * (1 + 1e-6), 3.0], *places)
        assert beside.error[0, 0] < 1e-6 * abs(beside.values[0, 0, 0])
