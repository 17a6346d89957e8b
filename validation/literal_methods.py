"""The determinants of the paper as printed, beside the frames: where their digits go.

A uniform free-free beam, closed form cos z cosh z = 1. Three functions of omega^2 have the same
zeros: the transfer matrix determinant (equation 66), det S with its product of signs (equation 80),
and the minor of the frame that antinode uses. Each is halved down to its sign change near every
known root. A root counts as lost where the signs a little below and above it do not differ. The
last table carries a mode along the beam by equation 81 and by antinode's two sweeps.

    python validation/literal_methods.py
"""

import math
import sys
from itertools import pairwise
from pathlib import Path

import mpmath
import numpy as np

from antinode import Beam, solve_modes
from antinode.riccati.chain import Chain, evaluate, segment_transfers, split_long
from antinode.riccati.laws import BENDING
from antinode.riccati.literal import riccati_characteristic, tmm_characteristic

MODES = 40
ASIDE = 0.01  # distance in z at which the signs beside a root are taken
FUNCTIONS = {
    "TMM, eq. 66": tmm_characteristic,
    "det S, eq. 80": riccati_characteristic,
    "frame": lambda chain, omega2: evaluate(chain, omega2).characteristic,
}


def uniform(segments):
    """Free-free beam with EI = m = L = 1."""
    one = np.ones(segments)
    columns = BENDING.named(one, one, 0 * one)
    return Chain(BENDING, one / segments, columns)


def roots(count):
    """Return the first roots z > 0 of cos z cosh z = 1."""
    values = []
    for k in range(1, count + 1):
        with mpmath.workdps(40):
            start = (k + 0.5) * mpmath.pi
            values.append(mpmath.findroot(lambda z: mpmath.cos(z) - mpmath.sech(z), start))
    return values


def relative_errors(function, chain, count=MODES):
    """Relative error of each frequency by the function's sign change; NaN where it is lost."""
    return np.array([_error(function, chain, float(z)) for z in roots(count)])


def _error(function, chain, z):
    low, high = (z - ASIDE) ** 4, (z + ASIDE) ** 4
    at_low, at_high = (_sign(function, chain, w) for w in (low, high))
    if at_low * at_high >= 0:
        return math.nan
    while low < (middle := (low + high) / 2) < high:
        sign = _sign(function, chain, middle)
        if sign == 0:
            break
        low, high = (middle, high) if sign == at_low else (low, middle)
    return abs(middle / z**4 - 1) / 2


def _sign(function, chain, omega2):
    return float(np.sign(function(chain, np.array([omega2]))[0]))


def false_roots(function, chain, count=MODES):
    """Gaps between neighbouring roots in which the function changes its sign all the same."""
    z = [float(root) for root in roots(count)]
    pairs = [(_sign(function, chain, (a + ASIDE) ** 4), _sign(function, chain, (b - ASIDE) ** 4))
             for a, b in pairwise(z)]  # fmt: skip
    return [k for k, (a, b) in enumerate(pairs, 1) if a != b]


def shape_errors(segments, modes):
    """Largest error of a shape (largest |Y| = 1) by equation 81, and by antinode."""
    x = np.linspace(0, 1, segments + 1)
    ours = solve_modes(Beam.from_stations(x, 1, 1), max(modes)).at(x)[..., 0]
    rows = []
    for k, z in enumerate(roots(max(modes)), 1):
        if k in modes:
            exact = _exact_shape(z, x)
            literal = _equation_81(uniform(segments), float(z) ** 4)
            rows.append((k, *(np.max(np.abs(Y / Y[0] - exact)) for Y in (literal, ours[:, k + 1]))))
    return rows


def _exact_shape(z, x):
    """Closed form of a free-free mode, 1 at the left end, in enough digits."""
    with mpmath.workdps(150):
        z = mpmath.findroot(lambda s: mpmath.cos(s) - mpmath.sech(s), z)
        s = (mpmath.cosh(z) - mpmath.cos(z)) / (mpmath.sinh(z) - mpmath.sin(z))

        def shape(t):
            return mpmath.cosh(t) + mpmath.cos(t) - s * (mpmath.sinh(t) + mpmath.sin(t))

        return np.array([float(shape(z * mpmath.mpf(t)) / 2) for t in x])


def _equation_81(chain, omega2):
    """Displacements at the nodes from the null vector of U_all, multiplied along the chain."""
    fine = split_long(chain, omega2)
    U = segment_transfers(fine, np.array([omega2]))[:, 0]
    U_all = np.eye(4)
    for step in U:
        U_all = step @ U_all
    state = np.concatenate([np.linalg.svd(U_all[2:, :2])[2][-1], [0.0, 0.0]])
    Y = [state[0]]
    for step in U:
        state = step @ state
        Y.append(state[0])
    return np.array(Y)[:: len(U) // len(chain.length)]


def lines():
    """Yield the record line by line."""
    yield "# The paper's own determinants, beside the frames"
    yield ""
    yield "Written by `python validation/literal_methods.py`: relative errors of frequencies."
    yield ""
    yield "| segments | mode | " + " | ".join(FUNCTIONS) + " |"
    yield "|---|---|" + "---|" * len(FUNCTIONS)
    summary = []
    for segments in (1, 100, 1000):
        chain = uniform(segments)
        columns = [relative_errors(function, chain) for function in FUNCTIONS.values()]
        for k in (1, 2, 4, 6, 8, 9, 10, 11, 12, 20, 40):
            cells = ("lost" if math.isnan(c[k - 1]) else f"{c[k - 1]:.0e}" for c in columns)
            yield f"| {segments} | {k} | " + " | ".join(cells) + " |"
        for (name, function), column in zip(FUNCTIONS.items(), columns, strict=True):
            lost, false = np.flatnonzero(np.isnan(column)) + 1, false_roots(function, chain)
            first = [", ".join(map(str, each)) or "none" for each in (lost[:1], false[:3])]
            summary.append(f"| {segments} | {name} | {np.nanmax(column):.1e} | {lost.size} | "
                           f"{first[0]} | {first[1]} |")  # fmt: skip
    yield "\n| segments | method | worst | lost | the first lost | false roots after modes |"
    yield "|---|---|---|---|---|---|"
    yield from summary
    yield "\n| mode | eq. 81 | two sweeps |\n|---|---|---|"
    for k, literal, ours in shape_errors(100, (1, 2, 4, 6, 8, 10, 12, 20, 40)):
        yield f"| {k} | {literal:.0e} | {ours:.0e} |"


def main():
    kept = []
    for line in lines():
        print(line, flush=True)
        kept.append(line)
    Path(__file__).with_suffix(".md").write_text("\n".join(kept) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
