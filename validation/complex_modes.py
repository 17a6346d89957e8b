"""Random beams with dashpots, feedback and following forces (validation/complex_modes.md).

python validation/complex_modes.py [beams]
"""

import sys
from pathlib import Path

import numpy as np

TESTS = Path(__file__).resolve().parents[1] / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "exact")]

from damped_beams import compared, random_beam  # noqa: E402


def main(beams):
    """Compare so many beams; print what is missing, too many, not proven, and the errors."""
    missing = spurious = open_ = 0
    over, worst = 0.0, 0.0
    for seed in range(beams):
        beam = random_beam(np.random.default_rng(5000 + seed))
        lost, extra, share, far, proven = compared(beam)
        if lost or extra or not proven or share > 1:
            print(
                f"seed {5000 + seed}: {lost} missing, {extra} spurious, proven: {proven}, "
                f"error over the stated one {share:.2g}",
                flush=True,
            )
        missing, spurious, open_ = missing + lost, spurious + extra, open_ + (not proven)
        over, worst = max(over, share), max(worst, far)
    print(
        f"{beams} beams: {missing} missing, {spurious} spurious, {open_} not proven; largest error "
        f"over the stated one {over:.1e}, relative {worst:.1e}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 300)
