"""Count the eigenvalues of random beams with all columns of the lateral law, and compare.

    python -m validation.counting_lateral [beams] [pedestals]

Shear in either form, rotary inertia, a foundation and added mass on random stepped beams, N past
buckling included, every pair of ends; with `pedestals` masses between two springs stand on them:
their stiffness, and one more above each pole. Counted are negative pivots of a dynamic stiffness in
60 digits: the exact stiffness matrices of halved segments, so short that none has a clamped-clamped
eigenvalue of its own, by mpmath's matrix exponential and no code of the package.
"""

from __future__ import annotations

import sys

import mpmath
import numpy as np

from antinode import Beam, Ends, Pedestal
from antinode.riccati.chain import count_below
from antinode.riccati.lanes.calls import evaluate

ENDS = ("free", "clamped", "pinned", "sliding")
HELD = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,)}
DIGITS = 60


def random_beam(rng: np.random.Generator) -> Beam:
    """Return a stepped beam with some of the columns, up to some times its buckling load."""
    n = int(rng.integers(1, 7))

    def column(low: float, high: float) -> np.ndarray:
        return 10 ** rng.uniform(low, high, n + 1)

    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.2, 1.0, n))])
    N = rng.choice([0.0, 1.0]) * (rng.uniform(-40, 40) + rng.uniform(-5, 5, n + 1))
    stiff = np.maximum(column(0.5, 4), 1.3 * np.abs(N))
    maybe = {
        "shear_stiffness": stiff,
        "rotary_inertia_per_length": column(-4, -1.5),
        "foundation_stiffness": column(0, 4) * rng.choice([0, 1], n + 1),
        "added_mass_per_length": column(-1, 0.5),
    }
    more = {name: values for name, values in maybe.items() if rng.uniform() < 0.7}
    return Beam.from_stations(
        x / x[-1],
        column(-1, 1),
        column(-1, 1),
        axial_force=N,
        ends=Ends(*rng.choice(ENDS, 2).tolist()),
        shear_form=str(rng.choice(["haringx", "engesser"])),
        theory="timoshenko",
        **more,
    )


def with_pedestals(beam: Beam, rng: np.random.Generator) -> Beam:
    """Return the beam with masses between springs where stations can move."""
    ends = ((beam.ends.left, 0), (beam.ends.right, len(beam.x) - 1))
    held = {k for end, k in ends if end in ("clamped", "pinned")}
    for k in range(len(beam.x)):
        if k not in held and rng.uniform() < 0.5:
            mass, upper, lower = (10 ** rng.uniform(*e) for e in ((-3, 0.5), (-1, 5), (-1, 5)))
            lower *= rng.choice([0, 1])
            beam = beam.with_attachments(Pedestal(float(beam.x[k]), mass, upper, lower))
    return beam


def _matrix(beam: Beam, k: int, omega2: mpmath.mpf) -> mpmath.matrix:
    """Return A of an interval at omega^2, from the equations of docs/theory/beam.md."""

    def of(name: str) -> mpmath.mpf:
        table = getattr(beam, name)
        return mpmath.mpf(0) if table is None else mpmath.mpf(float(table[k, 0]))

    N, EI = of("axial_force"), of("bending_stiffness")
    mu = (of("mass_per_length") + of("added_mass_per_length")) * omega2 - of("foundation_stiffness")
    alpha, s = mpmath.mpf(1), mpmath.mpf(0)
    if beam.shear_stiffness is not None:
        S = of("shear_stiffness")
        alpha, s = (
            (1 + N / S, 1 / S) if beam.shear_form == "haringx" else (S / (S - N), 1 / (S - N))
        )
    beta = alpha * N + of("rotary_inertia_per_length") * omega2
    return mpmath.matrix(
        [[0, alpha, 0, -s], [0, 0, 1 / EI, 0], [0, -beta, 0, alpha], [mu, 0, 0, 0]]
    )


def _exponential(A: mpmath.matrix, h: mpmath.mpf) -> mpmath.matrix:
    """Return exp(A h) by its series: h is short."""
    term, total = mpmath.eye(4), mpmath.eye(4)
    for k in range(1, 200):
        term = term * A * (h / k)
        total += term
        if mpmath.mnorm(term, "inf") < mpmath.mpf(10) ** (-DIGITS - 5):
            break
    return total


def _stiffness(U: mpmath.matrix) -> mpmath.matrix:
    """Return the dynamic stiffness of (Y, psi) at both ends: forces (-Q, M) on the right."""
    U11, U12, U21, U22 = (U[a : a + 2, b : b + 2] for a, b in ((0, 0), (0, 2), (2, 0), (2, 2)))
    inverse = U12**-1
    left_by_left, left_by_right = -inverse * U11, inverse
    right_by_left, right_by_right = U21 - U22 * inverse * U11, U22 * inverse
    out, back = mpmath.matrix([[0, -1], [1, 0]]), mpmath.matrix([[0, 1], [-1, 0]])
    K = mpmath.zeros(4)
    parts = (back * left_by_left, back * left_by_right, out * right_by_left, out * right_by_right)
    for place, part in zip(((0, 0), (0, 2), (2, 0), (2, 2)), parts, strict=True):
        for i in range(2):
            for j in range(2):
                K[place[0] + i, place[1] + j] = part[i, j]
    return K


def reference_count(beam: Beam, omega2: float) -> int:
    """Return the number of eigenvalues below omega^2, by pivots in 60 digits."""
    with mpmath.workdps(DIGITS):
        w = mpmath.mpf(omega2)
        pieces, places = [], [0]
        for k in range(len(beam.x) - 1):
            A = _matrix(beam, k, w)
            wave = 0.0
            for sign in (1, -1):  # the largest modulus of a root bounds the wave number
                a = _matrix(beam, k, sign * abs(w))
                b = a[0, 3] * -a[3, 0] + a[1, 2] * -a[2, 1]
                c = a[1, 2] * a[3, 0] * (a[0, 1] ** 2 - a[0, 3] * a[2, 1])
                wave = max(wave, float(mpmath.sqrt(abs(b) / 2 + mpmath.sqrt(b * b / 4 + abs(c)))))
            h = mpmath.mpf(float(beam.x[k + 1])) - mpmath.mpf(float(beam.x[k]))
            number = max(1, int(np.ceil(float(h) * wave / 0.8)))
            pieces += [_stiffness(_exponential(A, h / number))] * number
            places.append(len(pieces))
        size = 2 * (len(pieces) + 1)
        held = set(HELD[beam.ends.left]) | {size - 2 + i for i in HELD[beam.ends.right]}
        springs, poles = {}, 0
        for item in beam.attachments:
            assert isinstance(item, Pedestal)
            node = places[int(np.argmin(np.abs(beam.x - item.x)))]
            m, k1, k2 = (mpmath.mpf(v) for v in (item.mass, *_stiffnesses(item)))
            springs[node] = k1 * (k2 - m * w) / (k1 + k2 - m * w)
            poles += bool(m * w > k1 + k2)
        return poles + _negative_pivots(pieces, size, held, springs)


def _stiffnesses(item: Pedestal) -> tuple[float, float]:
    return item.beam_stiffness, item.ground_stiffness


def _negative_pivots(
    pieces: list[mpmath.matrix], size: int, held: set[int], springs: dict[int, mpmath.mpf]
) -> int:
    """Count the negative pivots of the assembled band, node after node."""
    count, carried = 0, mpmath.zeros(2)
    for node in range(len(pieces) + 1):
        last = node == len(pieces)
        own = carried + (mpmath.zeros(2) if last else pieces[node][0:2, 0:2])
        if node in springs:
            own[0, 0] += springs[node]
        free = [i for i in range(2) if 2 * node + i not in held]
        block = mpmath.matrix(len(free) + 2) if not last else mpmath.matrix(len(free))
        for a, i in enumerate(free):
            for b, j in enumerate(free):
                block[a, b] = own[i, j]
            for j in range(0 if last else 2):
                block[a, len(free) + j] = pieces[node][i, 2 + j]
                block[len(free) + j, a] = pieces[node][2 + j, i]
        if not last:
            for i in range(2):
                for j in range(2):
                    block[len(free) + i, len(free) + j] = pieces[node][2 + i, 2 + j]
        for a in range(len(free)):
            pivot = block[a, a]
            count += pivot < 0
            for i in range(a + 1, block.rows):
                factor = block[i, a] / pivot
                for j in range(a + 1, block.rows):
                    block[i, j] -= factor * block[a, j]
        if not last:
            carried = block[len(free) :, len(free) :]
    return count


def samples(rng: np.random.Generator) -> np.ndarray:
    """Return omega^2 of either sign, near zero and beyond cut-offs."""
    return np.concatenate([-(10 ** rng.uniform(-2, 4, 2)), 10 ** rng.uniform(-1, 6.5, 5)])


def compare(rng: np.random.Generator, *, pedestals: bool = False) -> tuple[int, int]:
    """Return how many counts of one random beam were compared, and how many differ."""
    beam, omega2 = random_beam(rng), samples(rng)
    if pedestals:
        beam = with_pedestals(beam, rng)
    chain = beam.chain("bending")
    exact = np.array([reference_count(beam, w) for w in omega2.tolist()])
    wrong = 0
    for found in (count_below(chain, omega2), evaluate(chain, omega2).below):
        wrong += int(np.sum(found != exact))
    return 2 * len(omega2), wrong


def main(beams: int, *, pedestals: bool) -> None:
    """Compare random beams, and print how many counts differ."""
    total = wrong = 0
    for seed in range(beams):
        compared, different = compare(np.random.default_rng([16, seed]), pedestals=pedestals)
        total, wrong = total + compared, wrong + different
        if different:
            print(f"beam {seed}: {different} of {compared} counts differ")
    print(f"{beams} beams, {total} counts, {wrong} mismatches")


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    main(numbers[0] if numbers else 1000, pedestals="pedestals" in sys.argv)
