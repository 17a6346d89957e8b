"""Rotating cantilevers: the tension is a table of stations.

Tension T(x), rotation rate Omega, mode frequencies omega, all made dimensionless with m, EI and L
at the root: eta = Omega sqrt(m L^4/EI). Between stations at a distance h a table is straight.
For a uniform beam T is concave, so the table lies below T, by at most m Omega^2 h^2/8. More tension
raises every frequency (Rayleigh): the table as it is and the table raised by that bound enclose the
beam with the curved T.
"""

import numpy as np
import pytest

import antinode as an
from literature.published import check_printed, extrapolated, last_digit, omegas

CANTILEVER = an.Ends("clamped", "free")

WRIGHT = """
 0   3.5160  22.0345  61.6972
 1   3.6816  22.1810  61.8418
 2   4.1373  22.6149  62.2732
 3   4.7973  23.3203  62.9850
 4   5.5850  24.2734  63.9668
 5   6.4495  25.4461  65.2050
 6   7.3604  26.8091  66.6839
 7   8.2996  28.3341  68.3860
 8   9.2568  29.9954  70.2930
 9  10.2257  31.7705  72.3867
10  11.2023  33.6404  74.6493
11  12.1843  35.5890  77.0638
12  13.1702  37.6031  79.6145
"""

HODGES = """
 0   3.82379  18.3173  47.2648
 1   3.98662  18.4740  47.4173
 2   4.43680  18.9366  47.8717
 3   5.09267  19.6839  48.6190
 4   5.87877  20.6852  49.6457
 5   6.74340  21.9053  50.9339
 6   7.65514  23.3093  52.4632
 7   8.59558  24.8647  54.2124
 8   9.55395  26.5437  56.1595
 9  10.5239   28.3227
10  11.5015   30.1827  60.5639
11  12.4845   32.1085  62.9829
12  13.4711   34.0877  65.5237
"""


def rows(table):
    return [tuple(line.split(maxsplit=1)) for line in table.strip().splitlines()]


def uniform(eta, intervals, raised=0.0):
    x = np.linspace(0.0, 1.0, intervals + 1)
    T = eta**2 * ((1 - x**2) / 2 + raised / (8 * intervals**2))
    return an.Beam.from_stations(x, 1.0, 1.0, None, -T, interpolation="linear", ends=CANTILEVER)


def tapered(eta, intervals, c=0.5):
    """Depth 1 - c x: m = 1 - c x, EI = (1 - c x)^3, T = eta^2 times the moment of m beyond x."""
    x = np.linspace(0.0, 1.0, intervals + 1)
    T = eta**2 * ((1 - x**2) / 2 - c * (1 - x**3) / 3)
    return an.Beam.from_stations(
        x, 1 - c * x, (1 - c * x) ** 3, None, -T, interpolation="linear", ends=CANTILEVER
    )


@pytest.mark.parametrize(("eta", "printed"), rows(WRIGHT))
def test_wright_1982_uniform_hingeless(eta, printed):
    """A. D. Wright, C. E. Smith, R. W. Thresher, J. L. C. Wang, Vibration modes of centrifugally
    stiffened beams, Journal of Applied Mechanics 49 (1982) 197-202: uniform beam, clamped.
    """
    low = omegas(uniform(float(eta), 500), 3)
    high = omegas(uniform(float(eta), 500, raised=1.0), 3)
    assert np.all(low <= high * (1 + 1e-9))
    for a, b, text in zip(low, high, printed.split(), strict=True):
        assert a - last_digit(text) <= float(text) <= b + last_digit(text)
        assert b - a <= last_digit(text) / 2


@pytest.mark.parametrize(("eta", "printed"), rows(HODGES))
def test_hodges_rutkowski_1981_tapered(eta, printed):
    """D. H. Hodges, M. J. Rutkowski, Free-vibration analysis of rotating beams by a variable-order
    finite-element method, AIAA Journal 19 (1981) 1459-1466: taper 0.5, no hub. EI and T are
    curved here; the limit of many stations is extrapolated. The third value at eta = 9 is left out:
    our transcript has 58.2834, antinode 58.2833, and there was no copy to settle it.
    """
    modes = len(printed.split())
    check_printed(extrapolated(lambda n: omegas(tapered(float(eta), n), modes), 100), printed)
