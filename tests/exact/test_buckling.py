"""Critical loads against 32 digits and closed forms: short compressed parts, steep cells."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends
from antinode.modes.buckling import buckling
from antinode.modes.rigid import rigid_modes
from antinode.riccati.roots import narrow
from many_digits import critical_load

PAIRS = [(a, b) for a in ("free", "clamped", "pinned", "sliding") for b in ("clamped", "free")]


def check(beam, tolerance=1e-6):
    found = buckling(beam, tolerance)
    true = critical_load(beam, rigid_modes(beam, "bending"), found.load_factor)
    assert abs(found.load_factor - true) <= found.error
    assert found.error <= 1.01 * tolerance * true + 1e-10 * true
    assert found.bracket[0] <= found.load_factor <= found.bracket[1]
    return found.load_factor


def pulled(ends, share=0.01, interpolation="linear", EI=(1e5, 1e5)):
    """Drawn at one end, and compressed over a small part at the other."""
    return Beam.from_stations(
        [0, 10], 10.0, EI, None, [-50e3, 50e3 * share],
        interpolation=interpolation, ends=Ends(*ends),
    )  # fmt: skip


def test_a_force_that_compresses_one_percent_of_an_interval():
    beam = pulled(("pinned", "pinned"))
    assert check(beam) == pytest.approx(63_808, abs=1)
    assert check(beam.reversed()) == pytest.approx(63_808, abs=1)
    assert check(replace(beam, interpolation="log")) == pytest.approx(63_808, abs=1)


@pytest.mark.parametrize("ends", PAIRS)
@pytest.mark.parametrize("interpolation", ["linear", "log"])
def test_short_compressed_parts_at_all_ends(ends, interpolation):
    check(pulled(ends, 0.03, interpolation, (1e5, 3e5)))


@pytest.mark.parametrize("ends", [("pinned", "pinned"), ("clamped", "free"), ("sliding", "pinned")])
def test_one_steep_cell_and_a_force_of_both_signs(ends):
    beam = Beam.from_stations(
        [0, 1], 1.0, [1.0, 100.0], None, [1.0, -1.0], interpolation="linear", ends=Ends(*ends)
    )
    found = check(beam)
    if ends == ("pinned", "pinned"):
        assert found == pytest.approx(831.833160313, rel=1e-6)


def test_a_long_drawn_segment_beside_a_short_compressed_one():
    """Its waves at the critical factor are many: it is cut for shapes and their energies."""
    beam = Beam.from_stations(
        [0, 100, 101], 1.0, 1.0, None, [-1.0, 1.0], ends=Ends("pinned", "pinned")
    )
    check(beam)
    mast = Beam.from_stations(
        [0, 30, 30.5, 60], 100.0, 2e6, None, [-50e3, 40e3, -50e3], ends=Ends("pinned", "pinned")
    )
    assert check(mast) == pytest.approx(596.69494516, rel=1e-9)


def test_rounding_is_no_compression():
    """A force that is zero but for the last digits does not buckle a beam in tension."""
    beam = Beam.from_stations(
        [0, 1, 2], 1.0, 1.0, None, [-7.0, -3.0, 1e-15], interpolation="linear"
    )
    assert buckling(beam) is None


def test_a_bracket_closes_on_a_root_that_counts():
    asked = []

    def evaluate(x):
        asked.append(x)
        return int(x > np.pi), float(np.cos(x / 2))

    low, high, root = narrow(evaluate, 0, 1.0, 5.0, 1e-12)
    assert low <= root <= high
    assert high - low <= 1e-12 * high
    assert root == pytest.approx(np.pi, rel=1e-14)
    assert len(asked) < 20


def test_a_double_root_is_halved():
    low, high, _ = narrow(lambda x: (2 * int(x > 2.0), (x - 2.0) ** 2), 0, 0.1, 9.0, 1e-10)
    assert low <= 2.0 <= high
    assert high - low <= 1e-10 * high
