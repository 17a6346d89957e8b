"""Buckling: columns under their own weight, distributed loads, stepped columns, two forces."""

import math

import numpy as np
import pytest

import antinode as an
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.modes.buckling import buckling
from literature.published import check_printed, extrapolated

HEAVY = {
    ("clamped", "free"): "7.837",
    ("pinned", "pinned"): "18.57",
    ("clamped", "pinned"): "52.50",
    ("pinned", "clamped"): "30.01",
    ("clamped", "clamped"): "74.63",
}

MIDDLE = {  # I_1/I_2: m for a/l = 0.2, 0.4, 0.6, 0.8
    0.01: "0.15 0.27 0.60 2.26",
    0.1: "1.47 2.40 4.50 8.59",
    0.2: "2.80 4.22 6.69 9.33",
    0.4: "5.09 6.68 8.51 9.67",
    0.6: "6.98 8.19 9.24 9.78",
    0.8: "8.55 9.18 9.63 9.84",
}

DISTRIBUTED = {  # (n, p): m
    (0, 0): "7.84",
    (1, 0): "5.78",
    (2, 0): "3.67",
    (0, 1): "16.1",
    (1, 1): "13.0",
    (2, 1): "9.87",
    (3, 1): "6.59",
}

TWO_FORCES = {1.25: "0.95", 1.5: "0.91", 1.75: "0.89", 2.0: "0.87", 3.0: "0.82"}


def test_greenhill_1881_own_weight():
    """A. G. Greenhill, Determination of the greatest height consistent with stability that a
    vertical pole or mast can be made, Proc. Cambridge Phil. Soc. 4 (1881) 65-73: q L^3/EI of a
    mast, 7.8373 as it is quoted since. Own weight by gravity, not by a table of N.
    """
    mast = an.Beam.from_stations([0.0, 2.0], 3.0, 5.0, ends=an.Ends("clamped", "free"))
    found = buckling(apply_loads(mast, AxialLoads(gravity=-9.80665)), 1e-8)
    check_printed([found.load_factor * 3.0 * 9.80665 * 2.0**3 / 5.0], "7.8373")


@pytest.mark.parametrize("ends", HEAVY)
def test_heavy_columns_wang_2005(ends):
    """C. M. Wang, C. Y. Wang, J. N. Reddy, Exact Solutions for Buckling of Structural Members
    (CRC 2005), Chapter 2, columns under self-weight: q L^3/EI, ends (bottom, top), the weight
    carried by the bottom. To the four digits that are usually quoted.
    """
    column = an.Beam.from_stations(
        [0.0, 1.0], 1.0, 1.0, None, [1.0, 0.0], interpolation="linear", ends=an.Ends(*ends)
    )
    check_printed([buckling(column, 1e-8).load_factor], HEAVY[ends])


@pytest.mark.parametrize("ratio", MIDDLE)
def test_timoshenko_gere_1961_stiffer_middle(ratio):
    """S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed. (1961), art. 2.14: pinned
    bar, I_2 over the middle length a, I_1 outside; P_cr = m E I_2/l^2.
    """
    found = []
    for a in (0.2, 0.4, 0.6, 0.8):
        x = [0.0, (1 - a) / 2, (1 + a) / 2, 1.0]
        bar = an.Beam.from_stations(
            x, 1.0, [ratio, 1.0, ratio], None, [1.0, 1.0, 1.0], ends=an.Ends("pinned", "pinned")
        )
        found.append(buckling(bar).load_factor)
    check_printed(found, MIDDLE[ratio])


@pytest.mark.parametrize(("n", "p"), DISTRIBUTED)
def test_timoshenko_gere_1961_distributed_load(n, p):
    """The same book, art. 2.12 (after A. N. Dinnik): fixed-free bar, s from the top, EI as s^n,
    load as s^p; the whole load at buckling is m EI/l^2 with EI at the base.

    The stations are spaced geometrically toward the top, where EI vanishes; the last hundredth is
    cut off, which moves m by up to 0.1 %, less than the printed digits. The table's values for
    p = 2 are left out: one of them, 18.9, is 18.96 by Bessel functions.
    """

    def found(intervals):
        s = np.geomspace(1.0, 0.01, intervals + 1)
        ends = an.Ends("clamped", "free")
        bar = an.Beam.from_stations(
            1 - s, 1.0, s**n, None, s ** (p + 1), interpolation="linear", ends=ends
        )
        return buckling(bar, 1e-4).load_factor

    check_printed([extrapolated(found, 25)], DISTRIBUTED[n, p])


@pytest.mark.parametrize("ratio", TWO_FORCES)
def test_timoshenko_gere_1961_force_at_midspan(ratio):
    """The same book, art. 2.11: uniform pinned bar, P_1 at its end, P_2 more at midspan; the sum at
    buckling is pi^2 EI/L'^2. Reduced length L'/l by (P_1 + P_2)/P_1.
    """
    ends = an.Ends("pinned", "pinned", right_axial="free")
    bar = an.Beam.from_stations([0.0, 1.0], 1.0, 1.0, ends=ends)
    forces = (PointForce(1.0, -1.0), PointForce(0.5, -(ratio - 1)))
    found = buckling(apply_loads(bar, AxialLoads(point_forces=forces)))
    check_printed([math.pi / math.sqrt(found.load_factor * ratio)], TWO_FORCES[ratio])
