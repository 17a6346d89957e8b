"""Frequencies of eigenvalues: one formula, one meaning past buckling."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import antinode
from antinode.modes.hertz import (
    error_hz,
    growth_rate,
    hertz,
    signed_hertz,
    signed_hertz_slope,
)

FORMULA = re.compile(r"sqrt\([^)]*omega2.*\) */ *\(2 \* (np|math)\.pi\)|\(w ?\*\* ?0\.5\)")


def test_a_frequency_is_the_root_over_two_pi_and_none_where_the_motion_grows():
    values = np.array([39.47841760435743, 0.0, -4.0, np.nan])
    np.testing.assert_allclose(hertz(values), [1.0, 0.0, np.nan, np.nan])
    assert [hertz(v) for v in (39.47841760435743, 0.0)] == [1.0, 0.0]
    assert math.isnan(hertz(-4.0))
    assert growth_rate(-4.0) == 2.0
    assert math.isnan(growth_rate(4.0))
    np.testing.assert_array_equal(growth_rate(np.array([-9.0, 1.0])), [3.0, np.nan])


@pytest.mark.parametrize(("omega2", "error"), [(100.0, 1e-9), (100.0, 60.0), (1.0, 1.5), (1.0, 9)])
def test_the_error_of_a_frequency_covers_both_sides(omega2, error):
    ends = [math.sqrt(max(omega2 + side * error, 0.0)) / (2 * math.pi) for side in (-1, 1)]
    off = max(abs(end - hertz(omega2)) for end in ends)
    assert error_hz(omega2, float(error)) == pytest.approx(off, rel=1e-6)
    pair = error_hz(np.array([omega2, -1.0]), np.array([error, 1.0]))
    assert pair[0] == error_hz(omega2, float(error))
    assert math.isnan(pair[1])


def test_an_unknown_error_stays_unknown():
    assert math.isnan(error_hz(4.0, math.nan))
    assert np.isnan(error_hz(np.array([4.0]), np.array([np.nan]))).all()


def test_no_error_is_no_error():
    assert error_hz(0.0, 0.0) == 0.0
    np.testing.assert_array_equal(error_hz(np.array([0.0, 4.0]), np.zeros(2)), [0.0, 0.0])


def test_a_fit_runs_through_buckling_on_a_signed_frequency():
    omega2 = np.array([-16.0, 25.0])
    np.testing.assert_allclose(signed_hertz(omega2) * 2 * np.pi, [-4.0, 5.0])
    step = 1e-6
    slope = (signed_hertz(omega2 + step) - signed_hertz(omega2 - step)) / (2 * step)
    np.testing.assert_allclose(signed_hertz_slope(omega2), slope, rtol=1e-8)


def test_the_formula_stands_in_one_file():
    root = Path(antinode.__file__).parent
    own = {
        path.relative_to(root).as_posix()
        for path in root.rglob("*.py")
        if FORMULA.search(path.read_text())
    }
    assert own - {"modes/hertz.py"} == set()
