"""A tower of BModes with a head beside its axis: the published frequencies, and what they hold.

NREL BModes, CertTest/Test03_tower: the WindPACT 1.5 MW tower, 82.39 m, 12 elements with properties
of their middles, and a head whose centre stands 3.3 m beside and 1.1 m above the tower's top. The
published output is that of a head 1.1 m beside the top and at its height, without rotary inertia
of the tower: `BModes.f90` reads the line of cm_axial into cm_loc. Shown here by plane elements
with axial and torsional freedoms, which give the published digits for that head; for the head of
the file they give what antinode gives.
"""

import math

import numpy as np
import pytest
from scipy.linalg import eigh

from antinode import Beam, Ends, natural_frequencies
from antinode.beam.attachments import PointMass

HEIGHT, MASS = 82.39, 78055.8
IXX, IYY, IZZ, IZX = 2960437.0, 3253223.0, 3264220.0, -18400.0
NODES = np.array([0, 0.08, 0.16, 0.24, 0.32, 0.40, 0.48, 0.56, 0.64, 0.72, 0.80, 0.90, 1.0])
AT = np.linspace(0, 1, 10).round(5)
M = [
    *(2549.742, 2275.820, 2017.460, 1774.662, 1547.425),
    *(1335.750, 1139.637, 959.085, 794.095, 644.666),
]
EI = [243.058, 193.660, 152.204, 117.790, 89.570, 66.753, 48.601, 34.430, 23.610, 15.566]  # 1e9
GJ = [186.968, 148.969, 117.080, 90.608, 68.900, 51.349, 37.386, 26.485, 18.162, 11.974]  # 1e9
EA = [61.868, 55.222, 48.953, 43.061, 37.548, 32.411, 27.653, 23.272, 19.268, 15.643]  # 1e9
RI = [9540.03, 7601.16, 5974.02, 4623.25, 3515.63, 2620.07, 1907.59, 1351.37, 926.69, 610.96]
FORE_AFT = [0.42074, 2.4718, 5.1412, 11.107, 20.845]  # bending, of Test03_tower.out
SIDE = [0.42099, 1.9573, 2.5392, 5.2958, 11.115, 20.872]  # the second one twists


def middles(table, scale=1.0):
    return scale * np.interp((NODES[1:] + NODES[:-1]) / 2, AT, table)


def frequencies(beside, above, plane, split=1):
    """Frequencies in Hz of w, w', u, twist at the nodes, without rotary inertia of the tower."""
    size = 4 * (len(NODES) - 1) * split + 4
    K, G = np.zeros((size, size)), np.zeros((size, size))
    rows = zip(
        np.diff(NODES) * HEIGHT / split, middles(M), middles(EI, 1e9), middles(EA, 1e9),
        middles(GJ, 1e9), middles(RI), strict=True,
    )  # fmt: skip
    elements = [row for row in rows for _ in range(split)]
    for n, (h, m, ei, ea, gj, inertia) in enumerate(elements):
        a, b = 4 * n, 4 * n + 4
        bend, pair = np.ix_([a, a + 1, b, b + 1], [a, a + 1, b, b + 1]), [a + 2, b + 2]
        K[bend] += ei / h**3 * np.array(
            [[12, 6*h, -12, 6*h], [6*h, 4*h*h, -6*h, 2*h*h],
             [-12, -6*h, 12, -6*h], [6*h, 2*h*h, -6*h, 4*h*h]]
        )  # fmt: skip
        G[bend] += m * h / 420 * np.array(
            [[156, 22*h, 54, -13*h], [22*h, 4*h*h, 13*h, -3*h*h],
             [54, 13*h, 156, -22*h], [-13*h, -3*h*h, -22*h, 4*h*h]]
        )  # fmt: skip
        for k, stiff, mass in ((0, ea, m), (1, gj, 2 * inertia)):
            at = np.ix_([p + k for p in pair], [p + k for p in pair])
            K[at] += stiff / h * np.array([[1, -1], [-1, 1]])
            G[at] += mass * h / 6 * np.array([[2, 1], [1, 2]])
    w, turn, u, twist = range(size - 4, size)
    for at, value in (((w, w), MASS), ((u, u), MASS), ((twist, twist), IZZ + MASS * beside**2)):
        G[at] += value
    head = [(w, turn, MASS * above)]
    if plane == "fore-aft":  # the centre lies in the plane: a turn moves it along the tower
        G[turn, turn] += IYY + MASS * (beside**2 + above**2)
        head += [(u, turn, -MASS * beside)]
    else:  # the centre lies beside the plane: twist moves it across
        G[turn, turn] += IXX + MASS * above**2
        head += [(w, twist, MASS * beside), (turn, twist, MASS * beside * above - IZX)]
    for i, j, value in head:
        G[i, j] += value
        G[j, i] += value
    return np.sqrt(eigh(K[4:, 4:], G[4:, 4:], eigvals_only=True)) / math.tau


def nearest(found, wanted):
    return np.array([found[np.argmin(np.abs(found - f))] for f in wanted])


@pytest.mark.parametrize(("plane", "published"), [("fore-aft", FORE_AFT), ("side", SIDE)])
def test_the_published_output_is_of_a_head_1_1_m_beside_the_top(plane, published):
    found = nearest(frequencies(1.1, 0.0, plane), published)
    np.testing.assert_allclose(found, published, rtol=4e-5)  # five digits, the last one rounded


def test_it_is_not_of_the_head_that_the_file_describes():
    found = frequencies(-3.3, 1.1, "fore-aft")
    assert found[0] == pytest.approx(0.41072, abs=1e-5)  # 2.4 % below the published 0.42074


def tower(inertia, offset):
    columns = [np.append(a, a[-1]) for a in (middles(M), middles(EI, 1e9), middles(EA, 1e9))]
    beam = Beam.from_stations(NODES * HEIGHT, *columns, ends=Ends(left="clamped"))
    return beam.with_attachments(PointMass(HEIGHT, MASS, inertia, offset=offset))


def test_the_head_of_the_file_as_antinode_has_it():
    """Its moment about the top's height, m cm_loc^2 counted: the tower hardly stretches."""
    beam = tower(IYY + MASS * 3.3**2, 1.1)
    found = natural_frequencies(beam, 2).frequencies_hz
    wanted = nearest(frequencies(-3.3, 1.1, "fore-aft", split=4), found)
    error = np.abs(found / wanted - 1)
    assert error[0] < 2e-5
    assert error[1] < 2.5e-3  # the axial mode of the head, 10 Hz, is no longer far above


def test_without_an_offset_beside_the_axis_both_agree():
    beam = tower(IYY, 1.1)
    found = natural_frequencies(beam, 4).frequencies_hz
    wanted = nearest(frequencies(0.0, 1.1, "fore-aft", split=8), found)
    np.testing.assert_allclose(found, wanted, rtol=2e-7)
