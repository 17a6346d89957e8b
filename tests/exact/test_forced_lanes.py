"""Driven chains in compiled code: against 40 digits, and against the form that is read.

The reference knows no frames and no series: exponentials of the law's matrix in 40 digits carry
everything that is unknown - two states of the left end, reactions of supports - to the right end,
where it is solved for.
"""

import mpmath as mp
import numpy as np
import pytest

from antinode.riccati import forced, readable
from antinode.riccati.chain import Chain
from antinode.riccati.forced import Lanes, Loads, Sides
from antinode.riccati.lanes import calls
from antinode.riccati.laws import BENDING
from antinode.riccati.points import Point
from law_chains import bar_chain

HELD = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,)}


def drawn(seed):
    """A chain with all that a chain may have, its lossy columns, forces, and frequencies."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 9))
    m, EI, s = np.exp(rng.normal(0, 0.5, (3, n)))
    N, s = rng.uniform(-3, 3, n), 1e-3 * s * bool(seed % 2)
    eta = rng.uniform(0, 0.05, n)
    columns = {"mass": m, "stiffness": EI, "axial_force": N}
    if seed % 2:
        more = {"shear": s, "shear_turn": s * N, "shear_work": s * N * N}
        more["rotary_inertia"], more["foundation"] = 1e-3 * m, rng.uniform(0, 50, n)
        columns |= more
    lossy = {name: values.astype(complex) for name, values in columns.items()}
    lossy["stiffness"] = EI * (1 + 1j * eta)
    for name in ("shear", "shear_turn", "shear_work") if seed % 2 else ():
        lossy[name] = columns[name] / (1 + 1j * eta)
    nodes = sorted(rng.choice(np.arange(1, n), 2, replace=False).tolist())
    points = [
        Point(0, mass=0.3, spring=20.0, dashpot=0.5),
        Point(
            nodes[0],
            *(0.4, 0.05, 0.01, 30.0, 4.0, 2.0),
            compliance=0.05,
            own_load=1.5,
            dashpot=0.7,
            rotational_dashpot=0.1,
        ),
        Point(nodes[1], mass=0.2, holds=((), (0,), (1,), (0, 1))[seed % 4]),
    ]
    left, right = (list(HELD)[k] for k in rng.integers(0, 4, 2))
    points = points[1:] if left != "free" else points
    follows = tuple(float(end == "free") * rng.uniform(0, 2) for end in (left, right))
    chain = Chain(
        BENDING, rng.uniform(0.1, 0.4, n), columns, left, right, tuple(points), following=follows
    )
    along = np.zeros((n, 3))
    along[n // 2 :, 1] = 2.0
    at = {nodes[0]: np.array([[1.0, 0, 0], [0.5, 0, 0]]), n: np.array([[0.0, 0, 0], [0.2, 0, 0]])}
    loads = Loads(at, along, np.array([0.0, 0.0, 1.0]))
    return chain, lossy, loads


def lanes_of(omega):
    omega = np.asarray(omega, dtype=float)
    return Lanes(omega * (omega - 0.1j), 1j * omega)


def exact(chain, columns, omega2, dashpot, loads, case):
    """Return the states on both sides of every node, in 40 digits."""
    with mp.workdps(40):
        return _exact(chain, columns, mp.mpc(omega2), mp.mpc(dashpot), loads, case)


def _exact(chain, columns, w2, dash, loads, case):
    ground = mp.mpf(loads.ground[case])
    held = list(HELD[chain.left])
    free = [i for i in (0, 1) if i not in held]
    unknowns, most = 2, 2 + sum(len(p.holds) for p in chain.points)
    z = mp.zeros(4, most + 1)  # columns: unknowns, and what is known
    for column, row in enumerate([*free, *(3 - r for r in held)]):
        z[row, column] = 1
        if row == 1 and chain.following[0]:
            z[3, column] = mp.mpf(chain.following[0])
    if 0 in held:
        z[0, most] = ground
    at = {p.node: p for p in chain.points}
    sides, wanted = [], []
    for node in range(len(chain.length) + 1):
        before = z.copy()
        point = at.get(node)
        for row in () if point is None else point.holds:
            wanted.append([z[row, c] for c in range(most + 1)])
            wanted[-1][most] -= ground if row == 0 else 0
            for c in range(most + 1):  # what is held is known from here on
                z[row, c] = 0
            z[row, most] = ground if row == 0 else 0
            z[3 - row, unknowns] += 1
            unknowns += 1
        z = _jump(z, point, loads.at_nodes.get(node), case, w2, dash, ground, most)
        sides.append((before, z.copy()))
        if node < len(chain.length):
            z = _segment(z, chain, columns, node, w2, loads, case, ground, most)
    rows = [3 - r for r in (0, 1) if r not in HELD[chain.right]] + list(HELD[chain.right])
    for row in rows:
        wanted.append([z[row, c] for c in range(most + 1)])
        if row == 3 and chain.following[1]:
            for c in range(most + 1):
                wanted[-1][c] -= mp.mpf(chain.following[1]) * z[1, c]
        if row == 0:
            wanted[-1][most] -= ground
    A = mp.matrix([row[:most] for row in wanted])
    found = mp.lu_solve(A, mp.matrix([-row[most] for row in wanted]))
    full = mp.matrix([*found, 1])
    return [[np.array([complex(v) for v in side * full]) for side in both] for both in sides]


def _jump(z, point, force, case, w2, dash, ground, last):
    z = z.copy()
    if force is not None:
        z[3, last] += mp.mpf(force[0, case])
        z[2, last] -= mp.mpf(force[1, case])
    if point is None:
        return z
    m, d, J = (mp.mpf(v) for v in (point.mass, point.offset, point.inertia))
    spring = point.spring + dash * mp.mpf(point.dashpot)
    turning = point.rotational_spring + dash * mp.mpf(point.rotational_dashpot)
    Y, psi = z[0, :].copy(), z[1, :].copy()
    relative = Y.copy()
    relative[last] -= ground
    for c in range(z.cols):
        z[3, c] += w2 * m * (Y[c] + d * psi[c]) - spring * relative[c] - point.coupling * psi[c]
        z[2, c] += turning * psi[c] + point.coupling * relative[c] + point.own_load * d * psi[c]
        z[2, c] -= w2 * (m * d * (Y[c] + d * psi[c]) + J * psi[c])
        z[1, c] += point.compliance * z[2, c]
    return z


def _segment(z, chain, columns, k, w2, loads, case, ground, last):
    own = {name: mp.mpc(values[k]) for name, values in columns.items()}
    s, turn, work, rotary, soil = (own.get(name, mp.mpf(0)) for name in BENDING.more)
    beta = own["axial_force"] + work + rotary * w2
    A = mp.zeros(5, 5)
    A[0, 1], A[0, 3], A[1, 2] = 1 + turn, -s, 1 / own["stiffness"]
    A[2, 1], A[2, 3], A[3, 0] = -beta, 1 + turn, own["mass"] * w2 - soil
    A[3, 4] = mp.mpf(loads.along[k, case]) + soil * ground
    U = mp.expm(A * mp.mpf(chain.length[k]), method="taylor")
    new = U[:4, :4] * z
    for row in range(4):
        new[row, last] += U[row, 4]
    return new


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("backend", [calls, readable])
def test_states_in_forty_digits(seed, backend):
    chain, columns, loads = drawn(seed)
    nodes = np.arange(len(chain.length) + 1)
    omega = [0.7, 9.0, 60.0]
    lanes = lanes_of(omega)
    found = Sides(*map(np.array, backend.driven(chain, columns, loads, nodes).states(lanes)))
    for lane in range(len(omega)):
        for case in range(loads.cases):
            told = exact(chain, columns, lanes.omega2[lane], lanes.dashpot[lane], loads, case)
            both = np.array(told).transpose(1, 0, 2)  # sides, nodes, components
            size = np.max(np.abs(both), axis=(0, 1)) + 1e-300
            for side, name in enumerate(("left", "right")):
                away = getattr(found, name)[:, lane, :, case] - both[side]
                inner = slice(1, -1)  # outside of the ends is what they are fastened to
                assert np.max(np.abs(away[inner]) / size) < 2e-11, (lane, case, name)
            assert np.max(np.abs(found.left[-1, lane, :, case] - both[0, -1]) / size) < 2e-11


@pytest.mark.parametrize("seed", range(12, 24))
def test_both_backends_from_slow_to_fast(seed):
    """Nineteen frequencies fill two groups of lanes and part of a third."""
    chain, columns, loads = drawn(seed)
    nodes = np.array([0, 1, len(chain.length)])
    lanes = lanes_of(np.geomspace(1e-2, 3e3, 19))
    fast = calls.driven(chain, columns, loads, nodes).states(lanes)
    slow = readable.driven(chain, columns, loads, nodes).states(lanes)
    for one, other in zip(map(np.array, fast), map(np.array, slow), strict=True):
        size = np.max(np.abs(other), axis=(0, 3), keepdims=True)
        assert np.max(np.abs(one - other) / size) < 1e-9


def test_twice_the_same_is_the_same_to_the_last_bit():
    chain, columns, loads = drawn(3)
    lanes = lanes_of(np.linspace(1, 30, 16))
    nodes = np.array([0, 2])
    whole = calls.driven(chain, columns, loads, nodes).states(lanes)
    again = calls.driven(chain, columns, loads, nodes).states(lanes)
    np.testing.assert_array_equal(whole.left, again.left)
    np.testing.assert_array_equal(whole.right, again.right)


def test_bars_are_left_to_the_readable_form(monkeypatch):
    chain = bar_chain(np.ones(2), np.ones(2), np.ones(2), "fixed")
    columns = {name: values.astype(complex) for name, values in chain.columns.items()}
    loads = Loads({2: np.ones((1, 1))}, np.zeros((2, 1)), np.zeros(1))
    asked = []
    own = forced.forced_states

    def readable_form(*arguments):
        asked.append(arguments)
        return own(*arguments)

    monkeypatch.setattr(forced, "forced_states", readable_form)
    left, _ = calls.driven(chain, columns, loads, np.array([2])).states(lanes_of([0.3]))
    omega = np.sqrt(0.3 * (0.3 - 0.1j))
    np.testing.assert_allclose(left[0][0, 0, 0], np.tan(2 * omega) / omega, rtol=1e-12)
    assert asked
