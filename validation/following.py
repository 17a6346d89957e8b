"""Random beams under following forces: none missing, none too many (validation/following.md).

python validation/following.py [beams]
python validation/following.py tables [beams]
"""

import sys
from pathlib import Path

import numpy as np

TESTS = Path(__file__).resolve().parents[1] / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "exact")]

from following_beams import random_beam  # noqa: E402
from test_following_random import compared, distances, solved  # noqa: E402


def main(beams):
    """Compare so many beams, and print what is missing, too many, and the largest distance."""
    missing = spurious = flutter = failed = 0
    worst = 0.0
    for seed in range(beams):
        rng = np.random.default_rng(1000 + seed)
        beam = random_beam(rng, load=[2.0, 8.0, 20.0, 40.0, 80.0, 150.0][seed % 6])
        try:
            lost, extra, far = compared(beam)
            flutter += bool(np.any(solved(beam)[0].imag))
        except AssertionError as error:
            failed += 1
            print(f"seed {1000 + seed}: {error}", flush=True)
            continue
        if lost or extra:
            print(f"seed {1000 + seed}: {lost} missing, {extra} spurious", flush=True)
        missing, spurious, worst = missing + lost, spurious + extra, max(worst, far)
    print(
        f"{beams} beams, {flutter} with flutter: {missing} missing, {spurious} spurious, "
        f"{failed} not proven; largest relative distance {worst:.1e}"
    )


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


if __name__ == "__main__":
    number = sys.argv[-1]
    run = tables if "tables" in sys.argv else main
    run(int(number) if number.isdigit() else 100 if run is tables else 300)
