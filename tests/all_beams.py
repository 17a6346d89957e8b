"""Random beams of every kind, for checks of every way of solving: `draw(seed, index)`.

By index: properties by steps, linear or logarithmic (`index % 3`); the axial force (`FORCES`,
`index // 3 % 8`); then drawn: 1 to 40 intervals with jumps between them, cells steep by up to three
decades, all pairs of ends, what is attached (`_attach`), and an axial acceleration.
"""

import numpy as np

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring

ENDS = ("free", "clamped", "pinned", "sliding")
INTERPOLATIONS = ("step", "linear", "log")
FORCES = (
    "none",
    "compression",
    "past buckling",
    "tension",
    "strong tension",
    "short compressed part",
    "both signs",
    "acceleration",
)


def kind_of(index):
    """Return interpolation and axial force of beam number `index`."""
    return INTERPOLATIONS[index % 3], FORCES[index // 3 % len(FORCES)]


def draw(seed, index):
    """Beam number `index` of the set `seed`; depends on nothing else."""
    rng = np.random.default_rng([seed, index, 7])
    interpolation, force = kind_of(index)
    n = int(np.exp(rng.uniform(0, np.log(41))))
    x = np.concatenate([[0], np.cumsum(np.exp(rng.uniform(-1.5, 1.5, n)))])
    x *= np.exp(rng.uniform(-1, 4)) / x[-1]
    m, EI, EA = (size * _table(rng, n, interpolation) for size in np.exp(rng.uniform(0, 6, 3)))
    EI, EA = EI * 1e4, EA * 1e7
    L, flexibility = x[-1], np.diff(x) @ (1 / EI).mean(axis=1)
    euler = np.pi**2 / (L * flexibility)
    N = euler * _force(rng, force, n, interpolation)
    own = {"axial_acceleration": _acceleration(rng, euler, x, m)} if force == "acceleration" else {}
    beam = an.Beam(
        x, m, EI, EA, N, interpolation=interpolation, name=f"{index}",
        ends=an.Ends(*map(str, rng.choice(ENDS, 2))), **own
    )  # fmt: skip
    return _attach(rng, beam, euler) if rng.random() < 0.5 else beam


def _table(rng, n, interpolation):
    """Values at both ends of every interval, about 1: by stations, or with a jump at each."""
    spread = rng.choice([0.0, 0.2, 1.0, 2.0], p=[0.15, 0.35, 0.3, 0.2])
    stations = np.exp(np.cumsum(rng.normal(0, spread, n + 1)) if rng.random() < 0.5
                      else rng.normal(0, spread, n + 1))  # fmt: skip
    table = np.stack([stations[:-1], stations[1:]], axis=1)
    if rng.random() < 0.4:
        table *= np.exp(rng.normal(0, spread, (n, 1)))
    if interpolation != "step" and rng.random() < 0.3:
        k = int(rng.integers(n))  # one steep cell
        table[k, int(rng.integers(2))] *= 10 ** rng.uniform(-3, 3)
    if rng.random() < 0.15:
        table *= 10 ** (rng.uniform(0, 4) * (rng.random((n, 1)) < 0.3))
    table = np.clip(table / np.exp(np.mean(np.log(table))), 1e-4, 1e4)
    return table[:, :1] * np.ones(2) if interpolation == "step" else table


def _force(rng, kind, n, interpolation):
    """In Euler loads, at both ends of every interval."""
    if kind in ("none", "acceleration"):
        return np.zeros((n, 2))
    size = np.exp(rng.uniform(-3, 0))
    values = np.linspace(1, rng.uniform(0.2, 1), n + 1)
    if kind == "past buckling":
        size = np.exp(rng.uniform(0.5, 4))
    elif kind == "tension":
        size = -np.exp(rng.uniform(-2, 5))
    elif kind == "strong tension":
        size = -(10 ** rng.uniform(2.5, 5))
        values = np.linspace(1, rng.choice([1.0, 0.99, 0.5, 0.01]), n + 1)
    elif kind == "short compressed part":
        share = 10 ** rng.uniform(-3, -1)
        values = np.interp(np.linspace(0, 1, n + 1), [0, 1], [-1, share])
        if rng.random() < 0.5:
            values = values[::-1]
        size = 10 ** rng.uniform(-1, 1)
    elif kind == "both signs":
        values, size = rng.uniform(-1, 1, n + 1), np.exp(rng.uniform(-1, 2))
    table = size * np.stack([values[:-1], values[1:]], axis=1)
    flat = interpolation == "step" or rng.random() < 0.15
    return table.mean(axis=1, keepdims=True) * np.ones(2) if flat else table


def _acceleration(rng, euler, x, m):
    """Some Euler loads over the mass, of either sign; large ones among those in tension."""
    sign = rng.choice([-1, 1])
    size = np.exp(rng.uniform(-2, 5 if sign < 0 else 2))
    return float(sign * size * euler / (np.diff(x) @ m.mean(axis=1)))


def _attach(rng, beam, euler):
    """Point masses (centre off the station), springs soft to 1e12, supports, spans, joints."""
    L, kind = beam.length, rng.integers(6)
    if kind == 5:  # many spans
        number = int(rng.integers(2, 9))
        turned = rng.choice([0.0, 1e-2, 1e6, 1e12]) * euler * L
        places = np.linspace(0, 1, number + 1)[1:-1] * L
        return beam.with_attachments(
            *(Spring(float(x), translational=np.inf, rotational=float(turned)) for x in places)
        )
    items = []
    for _ in range(rng.integers(1, 4)):
        x = float(rng.choice([rng.choice(beam.x), rng.uniform(0.02, 0.98) * L]))
        mass = float(beam.mass * 10 ** rng.uniform(-3, 1.5))
        which = rng.integers(5)
        if which == 0:
            offset = float(rng.uniform(-0.2, 0.2) * L * rng.choice([0.05, 1.0]))
            items.append(PointMass(x, mass, mass * (0.05 * L) ** 2 * rng.choice([0, 1]), offset))
        elif which == 1:
            k = euler / L * 10 ** rng.uniform(-3, 12)
            items.append(Spring(x, float(k), float(k * L * L * rng.choice([0, 1e-3, 1]))))
        elif which == 2:
            items.append(Spring(x, 0.0, float(euler * L * 10 ** rng.uniform(-3, 12))))
        elif which == 3:
            held = rng.integers(3)
            items.append(Spring(x, np.inf if held < 2 else 0.0, np.inf if held > 0 else 0.0))
        elif 0 < x < L:
            items.append(Joint(x, rotational=float(10 ** rng.uniform(-3, 2) / (euler * L))))
    return beam.with_attachments(*items)
