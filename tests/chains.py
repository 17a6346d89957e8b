"""Random chains of uniform beam segments for checks of eigenvalue counts: `draw_case(seed, index)`.

Every case depends on its seed and index alone. By index a half of them have a step of 1e5 to 1e6
in EI, a third 100 to 300 segments, a third an axial force within 5 % of buckling; the rest is
drawn: ends, lengths, stiffness, mass, tension or compression (to many times buckling), mirrored
and periodic chains with their clusters, and where omega^2 lies among the eigenvalues. That is the
middle (log) of a gap between two eigenvalues, or below the first one, or between zero and the next
one, or, away from eigenvalues, where a segment's own formulas or the stiffness of a part of the
chain are singular.

Where omega^2 lies and what buckles is found by counts in many digits, which takes nine tenths of
the time of a test: `kept_case` has it from a file. `python tests/chains.py` draws that anew.
"""

import json
import math
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from reference import BeamChain, count_below, eigenvalue, scale

ENDS = ("free", "clamped", "pinned", "sliding")
NARROWEST_GAP = 1e-7  # relative distance of two eigenvalues with omega^2 drawn between them
NEAR = 0.05  # of buckling
STEEP = 1e5  # step in EI
LONG = 100  # segments
KEPT = Path(__file__).with_name("kept_chains.json")
NUMBERS = {515: 60, 2026: 100}
"""Cases that are kept, by seed."""
_ZERO = 1e-30  # modulus of omega^2 in units of `scale` below which an eigenvalue is an exact zero


@dataclass(frozen=True)
class Case:
    """A chain and an omega^2 [rad^2/s^2].

    No eigenvalue lies within the relative distance `room` of omega2, `negative` of them are below
    zero, and `load_factor` is the axial force by the critical one where that was looked for.
    """

    index: int
    chain: BeamChain
    omega2: float
    target: str
    room: float
    negative: int
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
    return _drawn(seed, index)[0]


def _drawn(seed, index):
    """The case, and the factor on the axial force of its chain that was looked for."""
    rng, chain, near = _draw_start(seed, index)
    factor, load = math.nan, 1.0
    if near:
        factor = _draw_factor(rng)
        load = factor * critical_load(chain)
        chain = chain.scaled(load)
    spectrum = _Spectrum(chain)
    target, omega2, room = _draw_omega2(rng, spectrum, near)
    return Case(index, chain, omega2, target, room, spectrum.negative, factor), load


def _draw_start(seed, index):
    rng = np.random.default_rng([seed, index])
    steep, near, long = index % 2 == 0, index // 2 % 3 == 0, index // 6 % 3 == 0
    return rng, _draw_chain(rng, _draw_size(rng, long, steep), steep, near), near


def _draw_factor(rng):
    return rng.uniform(1 - 0.95 * NEAR, 1 + 0.95 * NEAR)


def kept_case(seed, index):
    """`draw_case`, with what the reference took nine tenths of the time to find from KEPT."""
    load, omega2, target, room, negative = _kept()[str(seed)][index]
    rng, chain, near = _draw_start(seed, index)
    factor = _draw_factor(rng) if near else math.nan
    chain = chain.scaled(load) if near else chain
    return Case(index, chain, omega2, target, room, negative, factor)


@cache
def _kept():
    return json.loads(KEPT.read_text("utf-8"))


def keep():
    """Draw all kept cases anew."""
    found = {}
    for seed, number in NUMBERS.items():
        drawn = [_drawn(seed, index) for index in range(number)]
        found[seed] = [[load, c.omega2, c.target, c.room, c.negative] for c, load in drawn]
    rows = [
        f'"{seed}": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]" for seed, rows in found.items()
    ]
    KEPT.write_text("{\n" + ",\n".join(rows) + "\n}\n", "utf-8")


def draw_resonance(seed, index):
    """Three cases: a chain of up to 20 segments at a `_singular` omega^2 and at its two neighbours.

    A recursion divides by nearly nothing there, though no eigenvalue is near: the neighbours are
    those in double precision.
    """
    rng = np.random.default_rng([seed, index, 1])
    steep, found = index % 2 == 0, None
    while found is None:
        chain = _draw_chain(rng, max(1 + steep, int(_log_uniform(rng, 1, 21))), steep, False)
        spectrum = _Spectrum(chain)
        found = _singular(rng, spectrum)
    omega2, room = found
    points = (math.nextafter(omega2, -math.inf), omega2, math.nextafter(omega2, math.inf))
    return [Case(index, chain, x, "resonance", room, spectrum.negative) for x in points]


# --- the chain -------------------------------------------------------------------------------


def _draw_size(rng, long, steep):
    if long:
        return int(rng.integers(LONG, 301))
    return max(1 + steep, int(_log_uniform(rng, 1, LONG)))


def _log_uniform(rng, lo, hi, size=None):
    return np.exp(rng.uniform(math.log(lo), math.log(hi), size))


def _draw_chain(rng, n, steep, near):
    h = np.ones(n) if rng.random() < 0.3 else _log_uniform(rng, 1, 30, n)
    h *= _log_uniform(rng, 0.3, 30) / h.sum()
    EI = _log_uniform(rng, 1e3, 1e7) * (_steep(rng, n) if steep else _mild(rng, n))
    two_masses = rng.random() < 0.4
    m = _log_uniform(rng, 1, 1e3) * (_two_levels(rng, n, 10, 1e6) if two_masses else _mild(rng, n))
    N = _draw_force(rng, h, EI, near)
    order = _draw_order(rng, n)
    if steep and _largest_step(EI[order]) < STEEP:
        order = np.arange(n)
    if near and h[order] @ N[order] < 0:
        N = -N
    left, right = map(str, rng.choice(ENDS, 2))
    if n > 1 and order[-1] == 0:  # two like halves, if not steep with a rigid, heavy middle
        right, middle, contrast = left, slice(n // 3, n - n // 3), _log_uniform(rng, 1, 1e4)
        EI[middle] *= 1 if steep else contrast
        m[middle] *= 1 if two_masses else contrast**0.7
    return BeamChain(*(tuple(values[order].tolist()) for values in (h, EI, m, N)), left, right)


def _draw_order(rng, n):
    """Segments as drawn, mirrored about the middle, or in periods: for close eigenvalues."""
    at, kind = np.arange(n), rng.random()
    if kind < 0.2:
        return np.minimum(at, at[::-1])
    return at % rng.integers(2, 9) if kind < 0.3 else at


def _mild(rng, n):
    """Uniform, a random walk, or scattered over a decade and a half."""
    walk = np.exp(np.cumsum(rng.normal(0, 0.2, n)))
    kinds = (np.ones(n), np.clip(walk, 0.03, 30), _log_uniform(rng, 0.2, 6, n))
    return kinds[rng.integers(3)]


def _steep(rng, n):
    """With a step of 1e5 to 1e6: two levels, or scattered over six decades."""
    if rng.random() < 0.6:
        return _two_levels(rng, n, STEEP, 1e6)
    values = _log_uniform(rng, 1, 1e6, n)
    at = int(rng.integers(n - 1))
    values[at : at + 2] = rng.permutation([1.0, _log_uniform(rng, STEEP, 1e6)])
    return values


def _two_levels(rng, n, lo, hi):
    """Two levels, their ratio between lo and hi: one step, one odd segment, or blocks."""
    kind, high = rng.integers(3), np.zeros(n, bool)
    if kind == 0:
        high[: rng.integers(1, max(2, n))] = True
    elif kind == 1:
        high[rng.integers(n)] = True
    else:
        high = np.cumsum(rng.random(n) < rng.choice([0.1, 0.5, 1.0])) % 2 == 1
        high[0] = not high[-1] if high.all() or not high.any() else high[0]
    return np.where(high ^ (rng.random() < 0.5), _log_uniform(rng, lo, hi), 1.0)


def _draw_force(rng, h, EI, near):
    """Axial force: a pattern times an Euler load; not zero, and of any size, if `near`."""
    n, x = len(h), np.cumsum(h) / h.sum()
    constant, linear = np.ones(n), np.linspace(1, rng.uniform(-1, 1), n)
    wave, random = np.sin(2 * np.pi * (x + rng.random())), rng.uniform(-1, 1, n)
    kind = rng.integers(4 if near else 5)
    pattern = (constant, linear, wave, random, np.zeros(n))[kind]
    euler = math.pi**2 / (h.sum() * (h / EI).sum())
    usual = _log_uniform(rng, 0.01, 10) if rng.random() < 0.6 else _log_uniform(rng, 1, 300)
    size = 1 if near else rng.choice([-1, 1, 1]) * usual
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


def _draw_omega2(rng, spectrum, near):
    """(where, omega^2, room): see `_KINDS`."""
    target = str(rng.choice(_KINDS[:5] if near else _KINDS))
    if _is_symmetric(spectrum.chain) and rng.random() < 0.6:
        target = "narrow"
    if target == "singular":
        if found := _singular(rng, spectrum):
            return target, *found
        target = "between"
    negative, rigid = spectrum.negative, spectrum.zeros
    sign = int(rng.choice([-1, 1]))
    if target == "below the first":
        count, sign = 0, (-1 if negative + rigid else sign)
    elif target == "negative":
        count, sign = int(rng.integers(min(1, negative), negative + 1)), -1
    elif target == "about zero":
        count = negative + (rigid if sign > 0 else 0)
    elif target == "narrow":
        count, sign = negative + rigid + spectrum.narrowest(1, 10), 1
    else:
        count = negative + rigid + int(rng.integers(1, 61 if target == "high" else 13))
        sign = 1
    return target, *spectrum.draw(rng, count, sign)


_KINDS = ("below the first", "negative", "about zero", "narrow", "singular", "high", "between")


def _is_symmetric(chain):
    h, EI = chain.h, chain.EI
    return len(h) > 1 and h == h[::-1] and EI[::-1] == EI and chain.left == chain.right


def _singular(rng, spectrum):
    """omega^2 where a recursion meets an infinity or a zero inside the chain, and room around."""
    omega2 = (_coincidence, _clamped_root, _partial_root, _partial_root)[rng.integers(4)](
        rng, spectrum.chain
    )
    if omega2 == 0 or _waves(spectrum.chain, omega2) > 100:
        return None
    around = {_count(spectrum.chain, omega2 * (1 + side * NARROWEST_GAP)) for side in (-1, 1)}
    return (omega2, NARROWEST_GAP) if len(around) == 1 else None


def _coincidence(rng, chain):
    """Both wave numbers of a segment coincide."""
    _, EI, m, N = chain.segments[rng.integers(len(chain.h))]
    return -(N**2) / (4 * EI * m)


def _clamped_root(rng, chain):
    """A segment resonates between clamped ends."""
    segment = chain.segments[rng.integers(len(chain.h))]
    alone = BeamChain(*((value,) for value in segment), "clamped", "clamped")
    return float(eigenvalue(alone, int(rng.integers(1, 4)), digits=17))


def _partial_root(rng, chain):
    """What lies left of a joint, or of a point in a segment, resonates by itself."""
    last, part = int(rng.integers(len(chain.h))), rng.choice([1, 1, 1 / 2, 1 / 4, 3 / 4, 1 / 3])
    h, EI, m, N = (list(values[: last + 1]) for values in (chain.h, chain.EI, chain.m, chain.N))
    h[last] *= float(part)
    left = BeamChain(*map(tuple, (h, EI, m, N)), chain.left, str(rng.choice(ENDS)))
    return float(eigenvalue(left, int(rng.integers(1, 7)), digits=17))


def _waves(chain, omega2):
    """Half waves along the chain, roughly: how much work a count is."""
    return math.fsum(
        h * math.sqrt(abs(N) / EI + math.sqrt(m * abs(omega2) / EI)) / math.pi
        for h, EI, m, N in chain.segments
    )


class _Spectrum:
    """Counts of a chain's eigenvalues along the axis of omega^2, remembered.

    On each side of zero an eigenvalue has a rank, from 1, and a modulus in units of `scale`.
    """

    def __init__(self, chain):
        self.chain, self.unit = chain, scale(chain)
        self.known = {}
        self.negative = self._count(-1, _ZERO)
        self.zeros = self._count(1, _ZERO) - self.negative

    def _count(self, sign, modulus):
        key = sign, modulus
        if key not in self.known:
            self.known[key] = _count(self.chain, float(sign * modulus * self.unit))
        return self.known[key]

    def draw(self, rng, count, sign):
        """(omega^2, room) with `count` eigenvalues below, or more where the gap is too narrow."""
        step = 1
        while (found := self._middle(rng, count, sign)) is None:
            count, step = count + step, 2 * step
            count = count if sign > 0 else min(count, self.negative)
        modulus, room = found
        return float(sign * modulus * self.unit), float(room)

    def narrowest(self, first, last):
        """Rank of the positive eigenvalue with its next one relatively the closest."""
        brackets = [self._bracket(1, rank, 1.001) for rank in range(first, last + 2)]
        gaps = [outer[0] / inner[0] for inner, outer in pairwise(brackets)]
        return first + int(np.argmin(gaps))

    def _middle(self, rng, count, sign):
        """(modulus, room) in the middle of the gap, or None where the gap is too narrow."""
        rank = count - self.negative - self.zeros if sign > 0 else self.negative - count
        inner = self._bracket(sign, rank) if rank > 0 else None
        outer = self._bracket(sign, rank + 1) if sign > 0 or count > 0 else None
        far = _log_uniform(rng, 1.2, 1e4)
        if inner is None and outer is None:
            return _log_uniform(rng, 1e-4, 1e6), math.inf
        if inner is None:
            return outer[0] / far, far - 1
        if outer is None:
            return inner[1] * far, 1 - 1 / far
        return self._between(sign, rank, inner, outer)

    def _between(self, sign, rank, inner, outer):
        while outer[0] / inner[1] <= max(inner[1] / inner[0], outer[1] / outer[0]) ** 8:
            if outer[1] < inner[0] * (1 + NARROWEST_GAP):
                return None
            inner, outer = self._halve(sign, rank, inner), self._halve(sign, rank + 1, outer)
        modulus = (inner[0] * inner[1] * outer[0] * outer[1]) ** 0.25
        return modulus, min(1 - inner[1] / modulus, outer[0] / modulus - 1)

    def _rank(self, sign, modulus):
        """Eigenvalues of that sign of smaller modulus."""
        count = self._count(sign, modulus)
        return count - self.negative - self.zeros if sign > 0 else self.negative - count

    def _bracket(self, sign, rank, width=1.2):
        """(lo, hi) about the modulus of the rank-th eigenvalue of that sign."""
        lo, hi = _ZERO, 1.0
        while self._rank(sign, hi) < rank:
            lo, hi = hi, hi * 256
        while hi > width * lo:
            lo, hi = self._halve(sign, rank, (lo, hi))
        return lo, hi

    def _halve(self, sign, rank, bracket):
        lo, hi = bracket
        middle = math.sqrt(lo * hi)
        return (lo, middle) if self._rank(sign, middle) >= rank else (middle, hi)


if __name__ == "__main__":
    keep()
