"""Stepped beams under following ends, all their eigenvalues in 40 digits.

A dense solver of p-elements says where they are, Muller's method on a determinant of matrix
exponentials (balls of python-flint, far more digits than doubles have) where exactly. Masses and
springs at the breakpoints are jumps of Q.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from flint import acb, acb_mat, arb, ctx
from following_beams import elements

import antinode as an
from antinode.beam.attachments import PointMass, Spring
from antinode.modes.backends import choose
from antinode.modes.rigid import exact_zeros
from antinode.modes.solve import solve_modes
from antinode.riccati.following.ratio import Following
from antinode.riccati.following.roots import turns_along

_BITS = 140


def stepped(rng, kind, load):
    """A stepped beam under a load in units of its own bending."""
    n = int(rng.integers(2, 6))
    x = np.concatenate([[0.0], np.sort(rng.uniform(0.1, 0.9, n - 1)), [1.0]])
    m, EI = (np.exp(rng.uniform(-0.9, 0.9, n)) for _ in range(2))
    if kind == "uneven":  # a drag that keeps its direction, ahead of a heavy nose or tail
        m *= np.exp(np.linspace(0, rng.uniform(-2, 2), n))
        P = load * rng.uniform(0.2, 1.0)
        N = P * (rng.uniform(0.1, 0.9) + (1 - 0.9) * np.cumsum(m) / np.sum(m))
        shares = {"right_follower": 1.0, "left_follower": 0.0}
        return an.Beam(x, m, EI, axial_force=N, ends=an.Ends("free", "free", **shares))
    left = str(rng.choice(["free", "free", "clamped", "pinned"]))
    N = load * rng.uniform(0.3, 1.0) * rng.uniform(0.2, 1.0, n)
    shares = {"right_follower": float(rng.uniform(0.3, 1.0))}
    if left == "free" and rng.random() < 0.5:
        shares["left_follower"] = float(rng.uniform(0.0, 1.0))
    beam = an.Beam(x, m, EI, axial_force=N, ends=an.Ends(left, "free", **shares))
    if rng.random() < 0.4:
        beam = beam.with_attachments(PointMass(float(rng.choice(x)), rng.uniform(0.05, 0.5)))
    if rng.random() < 0.3:
        beam = beam.with_attachments(Spring(float(x[1]), translational=rng.uniform(1, 50)))
    return beam


class Determinant:
    """D(omega^2) of a stepped beam, by exponentials."""

    def __init__(self, beam):
        ctx.prec = _BITS
        self.beam = beam
        self.mass, self.spring = np.zeros((2, len(beam.x)))
        for each in beam.attachments:
            node = int(np.argmin(np.abs(beam.x - each.x)))
            if isinstance(each, PointMass):
                self.mass[node] += each.mass
            else:
                self.spring[node] += each.translational

    def __call__(self, z):
        """Return D and nothing else: states Y, psi, M, Q through segments and jumps."""
        beam = self.beam
        left, right = (acb(float(v)) for v in beam.following())
        start = {
            "free": [[1, 0], [0, 1], [0, 0], [0, left]],
            "clamped": [[0, 0], [0, 0], [1, 0], [0, 1]],
            "pinned": [[0, 0], [1, 0], [0, 0], [0, 1]],
        }[beam.ends.left]
        state = acb_mat(start)
        for k in range(len(beam.x)):
            state = self._jump(k, z) * state
            if k < len(beam.x) - 1:
                state = self._segment(k, z) * state
        rows = [state[2, j] for j in (0, 1)], [state[3, j] - right * state[1, j] for j in (0, 1)]
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]

    def _jump(self, k, z):
        jump = z * float(self.mass[k]) - float(self.spring[k])
        return acb_mat([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [jump, 0, 0, 1]])

    def _segment(self, k, z):
        beam = self.beam
        m, EI, N = (
            float(v[k, 0]) for v in (beam.mass_per_length, beam.bending_stiffness, beam.axial_force)
        )
        h = arb(float(beam.x[k + 1])) - arb(float(beam.x[k]))
        rows = [[0, 1, 0, 0], [0, 0, acb(1) / EI, 0], [0, -N, 0, 1], [z * m, 0, 0, 0]]
        return (acb_mat(rows) * acb(h)).exp()

    def refined(self, guess, known=()):
        """Return a zero next to a guess, none of those known; None where steps do not settle."""
        roots = [acb(complex(root)) for root in known]

        def value(at):
            y = self(at)
            for root in roots:
                y /= at - root
            return y

        z = [acb(complex(guess) * (1 + d)) for d in (0.0, 1e-7, -1e-7)]
        y = [value(v) for v in z]
        for _ in range(60):
            h1, h2 = z[1] - z[0], z[2] - z[1]
            d1, d2 = (y[1] - y[0]) / h1, (y[2] - y[1]) / h2
            a = (d2 - d1) / (h1 + h2)
            b = a * h2 + d2
            root = (b * b - 4 * a * y[2]).sqrt()
            below = max((b + root, b - root), key=lambda v: float(abs(v)))
            step = -2 * y[2] / below
            new = _middle(z[2] + step)
            size = float(abs(step)) / max(float(abs(new)), 1e-30)
            z, y = [*z[1:], new], [*y[1:], value(new)]
            if size < 1e-20:
                return complex(float(new.real), float(new.imag))
            if not size < 1e6:
                return None
        return None


def _middle(z):
    return acb(z.real.mid(), z.imag.mid())


def under(beam, factor):
    """The same beam with all of its axial force times a factor."""
    return replace(beam, axial_force=factor * np.asarray(beam.axial_force))


def all_roots(beam, below, number):
    """Every eigenvalue of real part up to `below`, zeros apart, in 40 digits."""
    value = Determinant(beam)
    guesses = elements(beam, 4, shift=-0.1 * below)
    guesses = guesses[(guesses.real < 1.2 * below) & (np.abs(guesses) > 1e-9 * below)]
    roots = []
    for guess in guesses[: number + 12]:
        near = [r for r in roots if abs(r - guess) < 0.05 * abs(guess)]
        start = guess * (1 + 1e-9)
        root = value.refined(start, near) if near else value.refined(start)
        if root is not None and abs(root) > 1e-9 * below and not _known(root, roots):
            roots.append(root)
    whole = [*roots, *(r.conjugate() for r in roots if r.imag and not _known(r.conjugate(), roots))]
    return np.array([r for r in whole if r.real < below])


def _known(root, roots):
    return any(abs(root - r) <= 1e-14 * abs(root) for r in roots)


def near_flutter(beam, shares=(-1e-2, -1e-5, -1e-9, 1e-9, 1e-5, 1e-2)):
    """The beam under loads by such shares off the one at which it begins to flutter, if it does."""
    critical = [c for c in an.stability(beam).critical if c.kind == "flutter"]
    if not critical:
        return []
    return [under(beam, critical[0].load_factor * (1 + share)) for share in shares]


class Compared(NamedTuple):
    """What a certified list lacks, has too many, and how far it errs."""

    missing: int
    spurious: int
    over: float
    """Largest error over the stated one."""
    flutters: bool
    diverges: bool


def compared(beam, modes=4):
    """Compare the certified list of a beam, its number and its stated errors, with 40 digits."""
    result = solve_modes(beam, modes, families=["bending"], damping="none", tolerance=1e-9)
    assert result.certificate["kind"] == "winding", result.warnings
    below = result.certificate["region"]["real_part_of_omega2_below"]
    number = result.certificate["record"]["eigenvalues"]
    left = list(all_roots(beam, below, number))
    zeros = sum(mode.omega2 == 0.0 for mode in result.modes)
    missing, spurious = max(len(left) + zeros - number, 0), max(number - len(left) - zeros, 0)
    own = [-(mode.eigenvalue_per_s**2) for mode in result.modes if mode.omega2 != 0.0]
    errors = [mode.error_omega2 for mode in result.modes if mode.omega2 != 0.0]
    over, flutters = 0.0, any(abs(value.imag) > 1e-9 * abs(value) for value in own)
    for value, error in zip(own, errors, strict=True):
        k = int(np.argmin(np.abs(np.array(left) - value))) if left else -1
        if k < 0 or abs(left[k] - value) > 1e-4 * abs(value):
            spurious += 1
        else:
            over = max(over, abs(left.pop(k) - value) / error)
    highest = max(_order(value) for value in own)
    missing += sum(_order(value) < highest * (1 - 1e-9) for value in left)
    diverges = any(value.real < 0 and abs(value.imag) < 1e-9 * abs(value) for value in own)
    return Compared(missing, spurious, over, flutters, diverges)


def _order(value):
    """(Im s)^2, or omega^2 where it does not oscillate: what modes are numbered by."""
    return value.real if value.imag == 0 else (np.sqrt(-complex(value)).imag) ** 2


def edges(beam, modes=4):
    """Lines that graze an eigenvalue: how many are proven, and how many of these are wrong."""
    chain = beam.chain("bending")
    poles = choose("numpy").find_eigenvalues(chain.fixed, modes + 4, zeros=0)
    roots = all_roots(beam, poles[modes + 2].omega2, modes + 8)
    following, proven, wrong = Following(chain), 0, 0
    lowest = poles[0].omega2
    for root in sorted(r.real for r in roots if r.real > 0)[:modes]:
        for share in np.array([1e-2, 1e-4, 1e-7, 1e-10, -1e-10, -1e-7, -1e-4, -1e-2]):
            line = root * (1 + share)
            below = sum(p.omega2 < line for p in poles)
            low, high = max(poles[below - 1].omega2, 0.0) if below else 0.0, poles[below].omega2
            if not low < line < high:
                continue
            turns = turns_along(following, line, low, high, lowest)
            if turns.proven:
                proven += 1
                zeros = below + turns.number - np.sum(roots.real < line)
                wrong += zeros != _at_zero(beam)
    return proven, wrong


def _at_zero(beam):
    """Eigenvalues at zero: the translation of a free beam, and a turn that nothing turns back."""
    return exact_zeros(beam, "bending")
