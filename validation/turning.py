"""Critical loads of columns under loads along them that turn with the section; see turning.md.

python validation/turning.py
"""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path

import antinode as an

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "exact"))
from stability_digits import Digits

CLAMPED = an.Ends("clamped")


def column(m: list[float], EI: list[float], load: list[float], **more: list[float]) -> an.Beam:
    """Return a column of length 1, clamped at x = 0, under loads toward it."""
    return an.Beam.from_stations(
        [0, 1], m, EI, tangential_load=load, ends=CLAMPED, interpolation="linear", **more
    )


CASES = {
    "Leipholz": (column([1, 1], [1, 1], [-1, -1]), 40.0537365149, 11.0302169954),
    "Hauger": (column([1, 1], [1, 1], [-1, 0]), 150.641595404, 11.4857136111),
    "tapered": (column([2, 1], [3, 1], [-1, -0.4]), None, None),
    "sheared": (
        column(
            [1, 1],
            [1, 1],
            [-1, -1],
            shear_stiffness=[100, 100],
            rotary_inertia_per_length=[0.002, 0.002],
        ),
        None,
        None,
    ),
}


def main() -> None:
    """Print each critical load beside its reference."""
    for name, (beam, load, omega) in CASES.items():
        start = time.process_time()
        found = an.stability(beam)
        seconds = time.process_time() - start
        flutter = found.flutter
        assert flutter is not None
        assert flutter.proven, found.warnings
        if load is None:
            load, omega2 = Digits(beam).flutter(flutter.load_factor, flutter.omega2)
            omega = math.sqrt(omega2)
        off, spin = flutter.load_factor / load - 1, 2 * math.pi * flutter.frequency_hz / omega - 1
        print(
            f"{name:9} {flutter.load_factor:.12g} (reference {load:.12g}, {off:+.1e}), omega "
            f"{2 * math.pi * flutter.frequency_hz:.12g} ({spin:+.1e}), stated "
            f"{flutter.error:.1e}, {seconds:.1f} s"
        )


if __name__ == "__main__":
    main()
