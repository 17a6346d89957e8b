"""Random chains of uniform beam segments for checks of eigenvalue counts: `draw_case(seed, index)`.

Every case depends on its seed and index alone. By index a half of them have a step of 1e5 to 1e6 in
EI, a third 100 to 300 segments, a third an axial force within 5 % of buckling; the rest is drawn:
ends, lengths, stiffness, mass, tension or compression, and where omega^2 lies among the eigenvalues.
omega^2 is drawn in the middle (log) of a gap between two eigenvalues, or below the first one.
"""

import math
from dataclasses import dataclass

import numpy as np

from reference import BeamChain, count_below, scale

ENDS = ("free", "clamped", "pinned", "sliding")
NARROWEST_GAP = 1e-7  # relative distance of two eigenvalues with omega^2 drawn between them
NEAR = 0.05  # of buckling
_LIMIT = (1e-30, 1e40)  # moduli of omega^2 in units of `scale`


@dataclass(frozen=True)
class Case:
    """A chain and an omega^2 [rad^2/s^2]; load_factor is its axial force by the critical one."""

    index: int
    chain: BeamChain
    omega2: float
    target: str
    load_factor: float = math.nan

    @property
    def segments(self):
        return len(self.chain.h)

    @property
    def step_EI(self):
        return _largest_step(self.chain.EI)

    @property
    def step_m(self):
        return _largest_step(self.chain.m)

    @property
    def near_buckling(self):
        return abs(self.load_factor - 1) <= NEAR

    @property
    def net_force(self):
        """Mean axial force [N], positive in compression."""
        return math.fsum(map(math.prod, zip(self.chain.h, self.chain.N, strict=True)))


def _largest_step(values):
    if len(values) == 1:
        return 1.0
    logs = np.log(values)
    return float(np.exp(np.abs(np.diff(logs)).max()))


def draw_case(seed, index):
    """Case number `index` of the set `seed`."""
    rng = np.random.default_rng([seed, index])
    steep, near, long = index % 2 == 0, index // 2 % 3 == 0, index // 6 % 3 == 0
    chain = _draw_chain(rng, _draw_size(rng, long, steep), steep, near)
    factor = math.nan
    if near:
        factor = rng.uniform(1 - 0.95 * NEAR, 1 + 0.95 * NEAR)
        chain = chain.scaled(factor * critical_load(chain))
    target, omega2 = _draw_omega2(rng, chain, near)
    return Case(index, chain, omega2, target, factor)


# --- the chain -------------------------------------------------------------------------------


def _draw_size(rng, long, steep):
    if long:
        return int(rng.integers(100, 301))
    return max(1 + steep, int(_log_uniform(rng, 1, 100)))


def _log_uniform(rng, lo, hi, size=None):
    return np.exp(rng.uniform(math.log(lo), math.log(hi), size))


def _draw_chain(rng, n, steep, near):
    h = np.ones(n) if rng.random() < 0.3 else _log_uniform(rng, 1, 30, n)
    h *= _log_uniform(rng, 0.3, 30) / h.sum()
    EI = _log_uniform(rng, 1e3, 1e7) * (_steep(rng, n) if steep else _mild(rng, n))
    m = _log_uniform(rng, 1, 1e3) * (
        _two_levels(rng, n, 1e6) if rng.random() < 0.3 else _mild(rng, n)
    )
    N = _draw_force(rng, h, EI, near)
    ends = (str(end) for end in rng.choice(ENDS, 2))
    return BeamChain(*(tuple(values.tolist()) for values in (h, EI, m, N)), *ends)


def _mild(rng, n):
    """Uniform, a random walk, or scattered over a decade and a half."""
    walk = np.exp(np.cumsum(rng.normal(0, 0.2, n)))
    kinds = (np.ones(n), np.clip(walk, 0.03, 30), _log_uniform(rng, 0.2, 6, n))
    return kinds[rng.integers(3)]


def _steep(rng, n):
    """With a step of 1e5 to 1e6: two levels, or scattered over six decades."""
    if rng.random() < 0.6:
        return _two_levels(rng, n, 1e5, 1e6)
    values = _log_uniform(rng, 1, 1e6, n)
    at = int(rng.integers(n - 1))
    values[at : at + 2] = rng.permutation([1.0, _log_uniform(rng, 1e5, 1e6)])
    return values


def _two_levels(rng, n, *ratio):
    """Two levels: one step, one odd segment, or blocks."""
    ratio = _log_uniform(rng, *ratio) if len(ratio) == 2 else _log_uniform(rng, 1, *ratio)
    high = np.zeros(n, bool)
    kind = rng.integers(3)
    if kind == 0:
        high[: rng.integers(1, max(2, n))] = True
    elif kind == 1:
        high[rng.integers(n)] = True
    else:
        high = np.cumsum(rng.random(n) < rng.choice([0.1, 0.5, 1.0])) % 2 == 1
        high[0] = not high[-1] if high.all() or not high.any() else high[0]
    return np.where(high ^ (rng.random() < 0.5), ratio, 1.0)


def _draw_force(rng, h, EI, near):
    """Axial force: a pattern of largest value 1 times up to ten Euler loads; net push if `near`."""
    n, x = len(h), np.cumsum(h) / h.sum()
    constant, linear = np.ones(n), np.linspace(1, rng.uniform(-1, 1), n)
    wave, random = np.sin(2 * np.pi * (x + rng.random())), rng.uniform(-1, 1, n)
    kind = rng.integers(4 if near else 5)
    pattern = (constant, linear, wave, random, np.zeros(n))[kind]
    if near and h @ pattern < 0:
        pattern = -pattern
    euler = math.pi**2 / (h.sum() * (h / EI).sum())
    size = 1 if near else rng.choice([-1, 1, 1]) * _log_uniform(rng, 0.01, 10)
    return size * euler * pattern


def critical_load(chain):
    """Load factor (to 1e-3) at which the first supported or elastic mode passes omega^2 = 0.

    Rigid rotation in net compression is negative at any load: the count is compared with that at
    a vanishing load.
    """
    slightly = -1e-12 * scale(chain)

    def buckled(load):
        return _count(chain.scaled(load), slightly) > start

    lo, start = 1e-6, 0
    start = _count(chain.scaled(lo), slightly)
    hi = 0.1
    while not buckled(hi):
        lo, hi = hi, 4 * hi
    while hi > 1.001 * lo:
        middle = math.sqrt(lo * hi)
        lo, hi = (lo, middle) if buckled(middle) else (middle, hi)
    return math.sqrt(lo * hi)


def _count(chain, omega2):
    """Cheap reference count: relative error about 1e-10."""
    return count_below(chain, omega2, tolerance=1e-10, digits=40)


# --- omega^2 ---------------------------------------------------------------------------------


def _draw_omega2(rng, chain, near):
    """(where, omega^2): below the first eigenvalue, among negative ones, near zero, or above."""
    spectrum = _Spectrum(chain)
    negative, rigid = spectrum.negative, spectrum.zeros
    kinds = ("below", "negative", "about zero", "between", "between", "high")
    target = str(rng.choice(kinds[:4] if near else kinds))
    sign = rng.choice([-1, 1])
    if target == "below":
        count, sign = 0, (-1 if negative + rigid else sign)
    elif target == "negative":
        count, sign = int(rng.integers(negative + 1)), -1
    elif target == "about zero":
        count = negative + (rigid if sign > 0 else 0)
    else:
        count = negative + rigid + int(rng.integers(1, 13 if target == "between" else 61))
        sign = 1
    return target, spectrum.draw(rng, count, sign)


class _Spectrum:
    """Counts of a chain's eigenvalues along the axis of omega^2, remembered."""

    def __init__(self, chain):
        self.chain, self.unit = chain, scale(chain)
        self.known = {}
        self.negative = self.count(-1, _LIMIT[0])
        self.zeros = self.count(1, _LIMIT[0]) - self.negative

    def count(self, sign, modulus):
        """Eigenvalues below sign * modulus * unit."""
        key = sign, modulus
        if key not in self.known:
            self.known[key] = _count(self.chain, float(sign * modulus * self.unit))
        return self.known[key]

    def draw(self, rng, count, sign):
        """omega^2 of that sign with `count` eigenvalues below it, or the next count with room."""
        step = 1 if sign > 0 or count < self.negative else -1
        while (modulus := self._middle(rng, count, sign)) is None:
            count += step
        return float(sign * modulus * self.unit)

    def _middle(self, rng, count, sign):
        """Modulus in the middle of the gap, or None where the gap is too narrow."""
        rank = count - self.negative - self.zeros if sign > 0 else self.negative - count
        inner = self._bracket(sign, rank) if rank > 0 else None
        outer = self._bracket(sign, rank + 1) if sign > 0 or count > 0 else None
        if inner is None and outer is None:
            return _log_uniform(rng, 1e-4, 1e6)
        if inner is None:
            return outer[0] / _log_uniform(rng, 1.2, 1e4)
        if outer is None:
            return inner[1] * _log_uniform(rng, 1.2, 1e4)
        while not _apart(inner, outer):
            if outer[1] < inner[0] * (1 + NARROWEST_GAP):
                return None
            inner, outer = self._halve(sign, rank, inner), self._halve(sign, rank + 1, outer)
        return (inner[0] * inner[1] * outer[0] * outer[1]) ** 0.25

    def _rank(self, sign, modulus):
        """Eigenvalues of that sign of smaller modulus."""
        count = self.count(sign, modulus)
        return count - self.negative - self.zeros if sign > 0 else self.negative - count

    def _bracket(self, sign, rank):
        """(lo, hi) about the modulus of the rank-th eigenvalue of that sign, counted from zero."""
        lo, hi = _LIMIT[0], 1.0
        while self._rank(sign, hi) < rank:
            lo, hi = hi, hi * 256
        while self._rank(sign, lo) >= rank:
            lo, hi = lo / 256, lo
        while hi > 2 * lo:
            lo, hi = self._halve(sign, rank, (lo, hi))
        return lo, hi

    def _halve(self, sign, rank, bracket):
        lo, hi = bracket
        middle = math.sqrt(lo * hi)
        return (lo, middle) if self._rank(sign, middle) >= rank else (middle, hi)


def _apart(inner, outer):
    """The brackets are narrower than the gap between them."""
    return outer[0] / inner[1] > max(inner[1] / inner[0], outer[1] / outer[0])
