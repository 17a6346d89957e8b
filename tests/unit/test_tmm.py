"""The transfer matrix method: right where it can be, and told when it is not."""

import numpy as np
import pytest

from antinode import Beam, Ends, solve_modes


def uniform(segments=10):
    one = np.ones(segments + 1)
    return Beam.from_stations(np.linspace(0, 1, segments + 1), one, one, None)


def test_agrees_on_low_modes():
    certified, scanned = (solve_modes(uniform(), 4, method=m) for m in ("riccati", "tmm"))
    for a, b in zip(certified.modes, scanned.modes, strict=True):
        assert b.omega2 == pytest.approx(a.omega2, rel=1e-7)
        assert b.name == a.name
    assert not any("scan" in warning for warning in scanned.warnings)


def test_fails_on_high_modes_and_says_so():
    """exp(beta L) passes 1e16 near mode 12: the scan loses roots, the counts show it."""
    result = solve_modes(uniform(), 25, method="tmm")
    assert any("use the default method" in warning for warning in result.warnings)


def test_keeps_what_it_finds_in_divergence():
    beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, 15.0, ends=Ends("pinned", "pinned"))
    result = solve_modes(beam, 2, method="tmm")
    assert result.modes[0].kind == "divergent"
