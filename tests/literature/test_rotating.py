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
from antinode.beam.attachments import PointMass
from antinode.beam.rotation import Rotation, apply_rotation
from antinode.exchange.outputs import write_beam
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


def blade(eta, plane, axis=0.0, c=0.0, **more):
    x = np.array([0.0, 1.0])
    m = EI = 1 - c * x
    beam = an.Beam.from_stations(
        x, m, EI, interpolation="linear", ends=an.Ends("clamped", "free"), **more
    )
    return apply_rotation(beam, Rotation(eta, axis, plane))


@pytest.mark.parametrize(("eta", "printed"), rows(WRIGHT)[1:])
def test_wright_by_the_rate_alone(eta, printed):
    """The same table by `[beam.rotation]`: N is the polynomial that it is."""
    found = np.sqrt(an.natural_frequencies(blade(float(eta), "out_of_plane"), 3).omega2)
    check_printed(found, printed)


def test_in_the_plane_of_rotation_a_beam_is_softer():
    """omega^2 in plane = omega^2 out of plane - Omega^2, exactly; masses included."""
    for axis in (0.0, -0.5):
        flap, lag = (
            an.natural_frequencies(blade(3.0, plane, axis), 3, tolerance=1e-9).omega2
            for plane in ("out_of_plane", "in_plane")
        )
        assert lag == pytest.approx(flap - 9.0, rel=1e-8)
    tip = [
        apply_rotation(
            an.Beam.from_stations([0, 1], 1.0, 1.0, ends=CANTILEVER).with_attachments(
                PointMass(1.0, 0.7)
            ),
            Rotation(3.0, -0.2, plane),
        )
        for plane in ("out_of_plane", "in_plane")
    ]
    flap, lag = (an.natural_frequencies(beam, 3, tolerance=1e-9).omega2 for beam in tip)
    assert lag == pytest.approx(flap - 9.0, rel=1e-8)


def test_the_centrifugal_force_is_the_integral():
    """m = 1 - x/2, axis at -e: N = -eta^2 int over the rest of m (x + e); a mass at the tip."""
    beam = an.Beam.from_stations(
        [0, 1], [1, 0.5], 1.0, interpolation="linear", ends=CANTILEVER
    ).with_attachments(PointMass(1.0, 0.7))
    turned = apply_rotation(beam, Rotation(2.0, -0.3))
    s = np.polynomial.Polynomial([0, 1])
    pull = (4 * (1 - 0.5 * s) * (s + 0.3)).integ()
    for t in (0.0, 0.4, 1.0):
        exact = -(pull(1) - pull(t)) - 4 * 0.7 * 1.3
        found = turned.axial_force_at(np.array([0]), np.array([t]))[0]
        assert found == pytest.approx(exact, rel=1e-14)


ROTOR = """
[beam]
interpolation = "linear"
[beam.stations]
x = [0, 20]
width = ["300 mm", "150 mm"]
height = ["1.2 m", "400 mm"]
[beam.material]
youngs_modulus = "70 GPa"
density = "2700 kg/m^3"
[beam.ends]
left = "clamped"
[beam.rotation]
rate = "30 rpm"
axis = "-1.5 m"
plane = "in_plane"
[[beam.point_masses]]
x = 12
mass = "80 kg"
"""


def test_rotation_in_a_file(tmp_path):
    path = tmp_path / "blade.toml"
    path.write_text(ROTOR)
    beam = an.load_beam(path).beam()
    assert beam.rotation == Rotation(np.pi, -1.5, "in_plane")
    flap = an.load_beam(path, ["beam.rotation.plane=out_of_plane"]).beam()
    f, g = (an.natural_frequencies(b, 2, tolerance=1e-9).omega2 for b in (flap, beam))
    assert g == pytest.approx(f - np.pi**2, rel=1e-4)  # but for rotary inertia
    write_beam(tmp_path / "again.toml", beam, "toml")
    again = an.load_beam(tmp_path / "again.toml").beam()
    assert again.rotation == beam.rotation
    assert an.natural_frequencies(again, 2).omega2 == pytest.approx(g, rel=1e-7)
    assert again.drawing == beam.drawing
    with pytest.raises(an.InputError, match=r"write a \.toml"):
        write_beam(tmp_path / "again.csv", beam, "csv")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("beam.ends.right_axial=fixed", "2 places hold"),
        ("beam.ends.left_axial=free", "0 places hold"),
        ("beam.point_masses.0.offset=1", "offset"),
        ("beam.rotation.rate=-3", "greater than 0"),
        ("beam.rotation.plane=sideways", "in_plane"),
    ],
)
def test_rotation_is_refused_in_a_sentence(change, words, tmp_path):
    path = tmp_path / "blade.toml"
    path.write_text(ROTOR)
    with pytest.raises(an.InputError, match=words):
        an.load_beam(path, [change]).beam()
