"""Tapered cantilevers, stationary: breadth 1 - c_b x, depth 1 - c_h x."""

import numpy as np
import pytest

import antinode as an
from literature.published import check_printed, extrapolated, omegas

TAPERS = (0.0, 0.2, 0.4, 0.6, 0.8)

# rows c_h, columns c_b
FIRST = """
3.51602 3.76286 4.09698 4.58531 5.39759
3.60828 3.85512 4.18932 4.67816 5.49266
3.73708 3.98419 4.31878 4.80842 5.62552
3.93428 4.18235 4.51799 5.00903 5.82882
4.29249 4.54368 4.88244 5.37614 6.19639
"""
SECOND = """
22.0345 22.5018 23.1186 24.0211 25.6558
20.6210 21.0567 21.6327 22.4774 24.0153
19.1138 19.5166 20.0500 20.8343 22.2710
17.4879 17.8557 18.3441 19.0649 20.3952
15.7427 16.0725 16.5123 17.1657 18.3855
"""
THIRD = """
61.6972 62.1525 62.7763 63.7515 65.7470
56.1923 56.6303 57.2257 58.1466 60.0094
50.3537 50.7714 51.3346 52.1963 53.9173
44.0248 44.4175 44.9432 45.7384 47.3051
36.8846 37.2439 37.7223 38.4392 39.8336
"""


def entry(table, row, column):
    return table.strip().splitlines()[row].split()[column]


def truncated(c_b, c_h, intervals):
    x = np.linspace(0.0, 1.0, intervals + 1)
    b, h = 1 - c_b * x, 1 - c_h * x
    return an.Beam.from_stations(
        x, b * h, b * h**3, interpolation="linear", ends=an.Ends("clamped", "free")
    )


@pytest.mark.parametrize("row", range(5))
@pytest.mark.parametrize("column", range(5))
def test_ozgumus_kaya_2006_double_taper(row, column):
    """O. Ozdemir Ozgumus, M. O. Kaya, Flapwise bending vibration analysis of double tapered
    rotating Euler-Bernoulli beam by using the differential transform method, Meccanica 41 (2006)
    661-670: beam at rest. On the diagonal c_b = c_h it is a truncated cone or pyramid.

    As reprinted in Flapwise bending vibration analysis of functionally graded rotating
    double-tapered beams, Int. J. Mechanical and Materials Engineering 10 (2015) 21, Table 1. At
    c_b = c_h = 0.4 it reprints 38.4920 for the second frequency beside its own result, 20.0500;
    the latter is used.
    """
    printed = " ".join(entry(table, row, column) for table in (FIRST, SECOND, THIRD))

    def found(intervals):
        return omegas(truncated(TAPERS[column], TAPERS[row], intervals), 3)

    check_printed(extrapolated(found, 100), printed)


POINTED = {1: "5.3151 15.2072 30.0198 49.763", 2: "8.7193 21.1457 38.4538 60.680"}


@pytest.mark.parametrize("power", POINTED)
def test_naguleswaran_1994_pointed_wedge_and_cone(power):
    """S. Naguleswaran, A direct solution for the transverse vibration of Euler-Bernoulli wedge and
    cone beams, Journal of Sound and Vibration 172 (1994) 289-304 (first by G. Kirchhoff, 1879):
    a wedge, area as s and EI as s^3, and a cone, s^2 and s^4, s from the tip.

    A beam needs mass everywhere: the last 1e-4 of the length are cut off, which changes even the
    fourth frequency by less than 1e-5 of itself. Stations are spaced geometrically.
    """

    def found(intervals):
        s = np.geomspace(1.0, 1e-4, intervals + 1)
        ends = an.Ends("clamped", "free")
        return omegas(
            an.Beam.from_stations(
                1 - s, s**power, s ** (power + 2), interpolation="log", ends=ends
            ),
            4,
        )

    check_printed(extrapolated(found, 200), POINTED[power])
