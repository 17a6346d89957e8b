r"""Oscillators that ride on outputs of linear motion: exact, whatever the points in time.

An oscillator ``w'' + 2 zeta omega w' + omega^2 w = -a`` on an output a of coordinates x = (q, q')
that move by ``x' = A x + B f``, ``a = r x + d f + e f'``. With

    w = p x + v,   p (A^2 + 2 zeta omega A + omega^2) = -r,
    v'' + 2 zeta omega v' + omega^2 v = -(d + p A B + 2 zeta omega p B) f - (e + p B) f',

v is one first-order equation under forces that run straight between points (`recurrence`), and the
whole is known at every point without a record of a. It feels ``-(2 zeta omega w' + omega^2 w)``.
Between points cubics run through values and rates; how far these may be off is stated.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers

from .recurrence import phi

_APART = 1e-7  # relative, of an oscillator and a mode that would be one
_SLOW = 3.0  # of an oscillator's frequency, up to which modes count as slow
_ONCE = 2_000_000  # numbers of an array
_RINGS = 161  # points in a period after the record


class Linear(NamedTuple):
    """Coordinates ``q'' + C q' + K q = into f`` over time.

    Attributes
    ----------
    stiffness, damping : array, shape (n, n)
    into : array, shape (n, forces)
    time_s : array, shape (t,)
    q, rate : array, shape (t, n)
    start, end : array, shape (t - 1, forces)
        f at the beginning and the end of every step.
    """

    stiffness: Array
    damping: Array
    into: Array
    time_s: Array
    q: Array
    rate: Array
    start: Array
    end: Array

    @property
    def slope(self) -> Array:
        """F' in every step."""
        return np.asarray((self.end - self.start) / np.diff(self.time_s)[:, None])

    @property
    def jump(self) -> Array:
        """Jumps of f at all points, (t, forces)."""
        before = np.vstack([np.zeros((1, self.start.shape[1])), self.end])
        return np.vstack([self.start, self.end[-1:]]) - before

    @property
    def pace(self) -> Array:
        """How fast each coordinate changes by itself [1/s]."""
        return np.asarray(np.sqrt(np.abs(np.diag(self.stiffness))) + np.abs(np.diag(self.damping)))


class Seen(NamedTuple):
    """What an output takes of coordinates, of their rates, of forces and of the slopes of these."""

    q: Array
    rate: Array
    force: Array
    slope: Array


class Ridden(NamedTuple):
    """The largest that oscillators feel, and how much larger it may be between points, (f,)."""

    largest: Array
    off: Array


def ride(motion: Linear, seen: Seen, frequency_hz: Array, ratio: float) -> Ridden:
    """Return the largest that oscillators feel, during the record and after it."""
    many = max(1, _ONCE // len(motion.time_s))
    parts = [
        _ride(motion, seen, frequency_hz[k : k + many], ratio)
        for k in range(0, len(frequency_hz), many)
    ]
    return Ridden(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _ride(motion: Linear, seen: Seen, frequency_hz: Array, ratio: float) -> Ridden:
    omega, nudged = _apart(motion, 2 * np.pi * frequency_hz, ratio)
    p = _weights(motion, seen, omega, ratio)
    (pq, pr), B, C = p, motion.into, motion.damping
    by_force = -seen.force - (pq @ B - pr @ C @ B) - 2 * ratio * omega[:, None] * (pr @ B)
    by_slope = -seen.slope - pr @ B
    z = _carried(motion, omega, ratio, by_force, by_slope)
    v = z.imag / (omega * np.sqrt(1 - ratio**2))
    w = v + motion.q @ pq.T + motion.rate @ pr.T
    force = np.vstack([motion.start, motion.end[-1:]])
    rate = z.real - ratio * omega * v - motion.q @ (pr @ motion.stiffness).T
    rate += motion.rate @ (pq - pr @ C).T + force @ (pr @ B).T
    a = (motion.q @ seen.q + motion.rate @ seen.rate)[:, None]
    by = motion.slope @ seen.slope
    first, last = (
        a[part] + (f @ seen.force + by)[:, None]
        for part, f in ((slice(None, -1), motion.start), (slice(1, None), motion.end))
    )
    early = rate[1:] + (motion.jump[1:] @ seen.slope)[:, None]  # w' just before a jump
    x0, r0 = _felt(w[:-1], rate[:-1], first, omega, ratio)
    x1, r1 = _felt(w[1:], early, last, omega, ratio)
    h = np.diff(motion.time_s)[:, None]
    largest = np.maximum(cubic_peak(x0, x1, h * r0, h * r1), _after(w[-1], rate[-1], omega, ratio))
    size = np.max(np.abs(rate - (-ratio - 1j * np.sqrt(1 - ratio**2)) * omega * w), axis=0)
    off = _between(motion, seen, p, omega, ratio, size)
    return Ridden(largest, off + (nudged / max(ratio, 1e-3) + 1e-12) * largest)


def _apart(motion: Linear, omega: Array, ratio: float) -> tuple[Array, Array]:
    """Return frequencies of oscillators none of which is a mode, and by how much they were moved.

    Where dashpots couple the modes none is one by accident.
    """
    k, c = np.diag(motion.stiffness), np.diag(motion.damping)
    drag, stiff = 2 * ratio * omega[:, None] - c, omega[:, None] ** 2 - k
    size = stiff * (stiff - drag * c) + drag**2 * k
    met = np.any(np.abs(size) < (2 * _APART) ** 2 * omega[:, None] ** 4, axis=1)
    return np.where(met, omega * (1 + 10 * _APART), omega), np.where(met, 20 * _APART, 0.0)


def _weights(motion: Linear, seen: Seen, omega: Array, ratio: float) -> tuple[Array, Array]:
    """Return p, shape (f, n), of coordinates and of rates."""
    K, C = motion.stiffness, motion.damping
    if not (np.any(K - np.diag(np.diag(K))) or np.any(C - np.diag(np.diag(C)))):
        k, c = np.diag(K), np.diag(C)
        drag, stiff = 2 * ratio * omega[:, None] - c, omega[:, None] ** 2 - k
        size = stiff * (stiff - drag * c) + drag**2 * k
        pq = -(seen.q * (stiff - drag * c) + seen.rate * drag * k) / size
        return pq, (seen.q * drag - seen.rate * stiff) / size
    n = len(K)
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:], A[n:, :n], A[n:, n:] = np.eye(n), -K, -C
    twice, row = A @ A, -np.concatenate([seen.q, seen.rate])
    p = np.array(
        [np.linalg.solve((twice + 2 * ratio * o * A + o**2 * np.eye(2 * n)).T, row) for o in omega]
    )
    return p[:, :n], p[:, n:]


def _carried(
    motion: Linear, omega: Array, ratio: float, by_force: Array, by_slope: Array
) -> Numbers:
    """Return ``z = v' - conj(root) v`` just after all points, (t, f)."""
    root = omega * (-ratio + 1j * np.sqrt(1 - ratio**2))
    h = np.diff(motion.time_s)[:, None]
    e, one, two = phi(root * h)
    held = motion.slope @ by_slope.T
    step = (one - two) * (motion.start @ by_force.T + held)
    step = h * (step + two * (motion.end @ by_force.T + held))
    jump = motion.jump @ by_slope.T
    z = np.empty((len(motion.time_s), len(omega)), dtype=complex)
    now = z[0] = jump[0]
    for k in range(len(h)):
        now = e[k] * now + step[k] + jump[k + 1]
        z[k + 1] = now
    return z


def _felt(w: Array, rate: Array, a: Array, omega: Array, ratio: float) -> tuple[Array, Array]:
    """Return what oscillators feel and its rate, of their motion and that of their place."""
    x = 2 * ratio * omega * rate + omega**2 * w
    return x, omega**2 * rate - 2 * ratio * omega * (a + x)


def _after(w: Array, rate: Array, omega: Array, ratio: float) -> Array:
    """Return the largest that is felt once the place rests."""
    damped = omega * np.sqrt(1 - ratio**2)
    root = -ratio * omega + 1j * damped
    phase = np.linspace(0, 2 * np.pi, _RINGS)[:, None]
    z = (rate - np.conj(root) * w) * np.exp(root / omega * phase)
    w, rate = z.imag / damped, (root * z).imag / damped
    x, change = _felt(w, rate, np.zeros(1), omega, ratio)
    change = change * (2 * np.pi / (_RINGS - 1) / omega)
    return cubic_peak(x[:-1], x[1:], change[:-1], change[1:])


def _between(
    motion: Linear,
    seen: Seen,
    p: tuple[Array, Array],
    omega: Array,
    ratio: float,
    size: Array,
) -> Array:
    """Return how far cubics may be off, (f,): by ``h^4/384`` of the largest fourth derivative.

    Modes much faster than an oscillator stand by themselves, as far as they are felt.
    """
    (pq, pr), pace, o = p, motion.pace, omega[:, None]
    force = np.vstack([motion.start, motion.end[-1:]])
    pull = force @ motion.into.T - motion.rate @ motion.damping.T - motion.q @ motion.stiffness.T
    D, V, A = (np.max(np.abs(part), axis=0) for part in (motion.q, motion.rate, pull))
    most, steep = np.max(np.abs(force), axis=0), np.max(np.abs(motion.slope), axis=0)
    fast, fourth = pace > _SLOW * o, np.max(np.diff(motion.time_s)) ** 4 / 384
    own = np.where(fast, 0.0, np.abs(seen.q) * D + np.abs(seen.rate) * V)
    S = [np.sum(own * pace**k, axis=1) for k in range(4)]
    S[0] = S[0] + np.abs(seen.force) @ most + np.abs(seen.slope) @ steep
    S[1] = S[1] + np.abs(seen.force) @ steep
    apart = np.abs(pq) * (V + o * D) + np.abs(pr) * (A + o * V)
    z = size + np.sum(np.where(fast, apart, 0.0), axis=1)
    weight = omega * abs(1 + 2 * ratio * (-ratio + 1j * np.sqrt(1 - ratio**2)))
    weight = weight / np.sqrt(1 - ratio**2)
    slow = weight * fourth * (omega**4 * z + sum(omega ** (3 - k) * S[k] for k in range(4)))
    felt_q = np.abs(o**2 * pq - 2 * ratio * o * (pr @ motion.stiffness))
    felt_rate = np.abs(o**2 * pr + 2 * ratio * o * (pq - pr @ motion.damping))
    each = felt_q * np.minimum(fourth * pace**2 * A, 2 * D)
    each = each + felt_rate * np.minimum(fourth * pace**3 * A, 2 * V)
    return np.asarray(slow + np.sum(np.where(fast, each, 0.0), axis=1))


def cubic_peak(x0: Array, x1: Array, r0: Array, r1: Array) -> Array:
    """Return the largest modulus of cubics through values and rates times steps, over axis 0."""
    best = np.maximum(np.max(np.abs(x0), axis=0), np.max(np.abs(x1), axis=0))
    c2, c3 = 3 * (x1 - x0) - 2 * r0 - r1, 2 * (x0 - x1) + r0 + r1
    with np.errstate(all="ignore"):
        root = np.sqrt(c2**2 - 3 * c3 * r0)
        by = c2 + np.where(c2 >= 0, root, -root)
        places = -r0 / by, -by / (3 * c3)
    for place in places:
        p = np.where((place > 0) & (place < 1), place, 0.0)
        best = np.maximum(best, np.max(np.abs(x0 + p * (r0 + p * (c2 + p * c3))), axis=0))
    return np.asarray(best)


class Gains(NamedTuple):
    """What an oscillator makes at most of a place of a given largest acceleration, or of others.

    Integrals of the modulus of its impulse response, and of that one's derivatives, (f,) each.
    """

    level: Array
    """Of the acceleration."""
    rate: Array
    """Of the velocity in its place."""
    edge: Array
    twice: Array
    """Of velocity and displacement in its place, together."""

    @classmethod
    def over(cls, frequency_hz: Array, ratio: float, duration_s: float) -> Gains:
        """Return them for a place that moves for so long."""
        omega = 2 * np.pi * frequency_hz
        damped = omega * np.sqrt(1 - ratio**2)
        root = -ratio * omega + 1j * damped
        size = 2 * ratio * omega - 1j * omega**2 * (1 - 2 * ratio**2) / damped
        fall = -np.expm1(-np.pi * ratio / np.sqrt(1 - ratio**2))
        swings = 2 * (damped * duration_s / np.pi + 2)
        swings = 1 + (np.minimum(2 / fall, swings) if fall > 0 else swings)
        whole, edge = np.abs(size) * swings / damped, 2 * ratio * omega
        turned = np.abs((size * root).real)
        return cls(whole, edge + omega * whole, edge, turned + omega**2 * whole)

    def of(self, acceleration: Array, velocity: Array, displacement: Array) -> Array:
        """Return what is felt at most, (f, n), of motions (n,)."""
        level, rate, edge, twice = (part[:, None] for part in self)
        both = edge * velocity + twice * displacement
        return np.asarray(np.minimum(np.minimum(level * acceleration, rate * velocity), both))
