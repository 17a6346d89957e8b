"""Random beams under following forces: none missing, none too many (validation/following.md).

python validation/following.py [beams]
python validation/following.py near [beams]
python validation/following.py tables [beams]
"""

import sys
from pathlib import Path

import numpy as np

TESTS = Path(__file__).resolve().parents[1] / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "exact")]

from following_beams import random_beam  # noqa: E402
from following_digits import compared, edges, near_flutter, stepped  # noqa: E402
from test_following_random import distances  # noqa: E402

LOADS = (2.0, 8.0, 20.0, 40.0, 80.0, 150.0)
KINDS = ("any", "any", "uneven")


def main(beams):
    """Compare so many stepped beams with 40 digits, and lines that graze their eigenvalues."""
    found, lines = [], []
    for seed in range(beams):
        rng = np.random.default_rng(1000 + seed)
        beam = stepped(rng, KINDS[seed % 3], LOADS[(seed // 3) % 6])
        found += _tried(1000 + seed, beam, lines)
    _tell(f"{beams} beams", found, lines, beams - len(found))


def near(beams):
    """The same next to flutter: from 1e-2 to 1e-9 below and above the load where it begins."""
    found, lines, tried = [], [], 0
    for seed in range(beams):
        beam = stepped(np.random.default_rng(5000 + seed), KINDS[seed % 3], LOADS[0])
        for each in near_flutter(beam):
            tried += 1
            found += _tried(5000 + seed, each, lines)
    _tell(f"{tried} beams next to flutter", found, lines, tried - len(found))


def _tried(seed, beam, lines):
    try:
        one = compared(beam)
    except AssertionError as error:
        print(f"seed {seed}: {error}", flush=True)
        return []
    lines.append(edges(beam))
    if one.missing or one.spurious or one.over > 1 or lines[-1][1]:
        print(f"seed {seed}: {one}, lines {lines[-1]}", flush=True)
    return [one]


def _tell(what, found, lines, failed):
    missing, spurious, over, flutters, diverges = np.array(found, dtype=float).T
    print(
        f"{what}, {flutters.sum():.0f} flutter, of {diverges.sum():.0f} something diverges: "
        f"{missing.sum():.0f} missing, {spurious.sum():.0f} spurious, {failed} not proven; "
        f"largest error over the stated one {over.max():.1e}"
    )
    proven, wrong = np.sum(lines, axis=0)
    print(f"lines that graze an eigenvalue: {proven} proven, {wrong} of them wrong")


def tables(beams):
    """Compare tables at a tolerance of 1e-11 with elements of high degree, value by value."""
    rows = []
    for seed in range(beams):
        rng = np.random.default_rng(20000 + seed)
        rows.append(distances(random_beam(rng, load=[2.0, 8.0, 20.0, 40.0][seed % 4])))
    far, own = np.concatenate(rows).T
    print(
        f"{beams} tables, {len(far)} eigenvalues: farthest {np.max(far):.1e}; two meshes of "
        f"elements differ by {np.max(own):.1e} at most"
    )


RUNS = {"near": (near, 30), "tables": (tables, 100)}

if __name__ == "__main__":
    words = sys.argv[1:]
    run, number = next((RUNS[w] for w in words if w in RUNS), (main, 300))
    run(next((int(w) for w in words if w.isdigit()), number))
