"""Random beams with steep tables for checks of tolerances: `draw_beam(seed, index)`.

Three to ten stations, m, EI and EA over up to three decades, logarithmic or linear between the
stations, any ends, axial force from a table (to beyond buckling, or strong tension) and from an
acceleration or gravity, in a third of the cases point masses, springs, supports and joints.
"""

import numpy as np

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads

ENDS = ("free", "clamped", "pinned", "sliding")


def draw_beam(seed, index):
    """Beam number `index` of the set `seed`; depends on nothing else."""
    rng = np.random.default_rng([seed, index])
    n = int(rng.integers(3, 11))
    x = np.concatenate([[0], np.cumsum(rng.uniform(0.2, 1, n - 1))])
    x *= np.exp(rng.uniform(0, 4)) / x[-1]
    decades = rng.uniform(0, 3) if index % 4 else 3.0
    m, EI, EA = (
        size * _table(rng, n, decades) for size in np.exp(rng.uniform(0, 6, 3)) * [1, 1e4, 1e6]
    )
    ends = an.Ends(*map(str, rng.choice(ENDS, 2)))
    euler = np.pi**2 / (x[-1] * np.trapezoid(1 / EI, x))
    N = _force(rng, n) * euler
    beam = an.Beam.from_stations(
        x, m, EI, EA, N, interpolation=("log", "linear")[index % 2], ends=ends, name=f"{index}"
    )
    if index % 3 == 0:
        beam = beam.with_attachments(*_attachments(rng, beam, euler))
    if rng.random() < 0.6:
        weight = rng.choice([-1, 1]) * euler * np.exp(rng.uniform(-3, 1))
        beam = _loaded(rng, beam, weight)
    return beam


def _table(rng, n, decades):
    """Scattered, a random walk, or a taper, over some decades."""
    kind = rng.integers(3)
    logs = rng.uniform(0, 1, n)
    if kind == 1:
        logs = np.cumsum(rng.normal(0, 1, n))
    elif kind == 2:
        logs = np.linspace(0, rng.choice([-1, 1]), n)
    spread = np.ptp(logs)
    return 10 ** (logs / spread * decades)


def _force(rng, n):
    """In Euler loads: nothing, compression to beyond buckling, tension, or both signs."""
    size = np.exp(rng.uniform(-3, 1))
    shapes = (
        np.zeros(n),
        size * np.linspace(1, rng.uniform(-0.5, 1), n),
        -size * rng.uniform(1, 10) * rng.uniform(0.2, 1, n),
        size * rng.uniform(-1, 1, n),
    )
    return shapes[rng.integers(4)]


def _loaded(rng, beam, weight):
    """The beam with an axial body force of total `weight`, carried as its axial ends allow."""
    if "fixed" not in beam.ends.of("longitudinal"):
        end = PointForce(float(beam.x[rng.choice([0, -1])]), float(weight))
        return apply_loads(beam, AxialLoads(point_forces=(end,)))
    kind = str(rng.choice(["gravity", "acceleration"]))
    return apply_loads(beam, AxialLoads(**{kind: float(weight / beam.mass)}))


def _attachments(rng, beam, euler):
    L, items = beam.length, []
    for _ in range(rng.integers(1, 4)):
        x = float(rng.choice([rng.choice(beam.x), rng.uniform(0.05, 0.95) * L]))
        mass = float(beam.mass * np.exp(rng.uniform(-4, 0.5)))
        kind = rng.integers(4)
        if kind == 0:
            offset = float(rng.uniform(-0.1, 0.1) * L)
            items.append(PointMass(x, mass, mass * (0.05 * L) ** 2 * rng.uniform(), offset))
        elif kind == 1:
            k = euler / L * np.exp(rng.uniform(-2, 6))
            items.append(Spring(x, float(k), float(k * L * L * rng.uniform(0, 0.3))))
        elif kind == 2:
            items.append(Spring(x, translational=np.inf))
        elif 0 < x < L:
            items.append(Joint(x, rotational=float(rng.uniform(0.01, 1) / (euler * L))))
    return items
