"""Ziegler's paradox: a dashpot, however small, lowers the flutter load of Beck's column.

At the limit s = i omega, and D + i omega c D_held = 0 with both determinants real: free and with
the dashpot's place held the column has one frequency, whatever c. Both are zeros in 30 digits.
"""

import math

import mpmath
import pytest

import antinode as an

BECK = an.Beam.from_stations(
    [0, 1], [1, 1], [1, 1], axial_force=[1, 1], ends=an.Ends("clamped", right_follower=1.0)
)


def determinant(P, omega, held=None):
    """Of a clamped column under a force that turns with its tip, whose Y or turn may be held."""
    half, c = P / 2, omega**2
    squares = [-half + sign * mpmath.sqrt(half**2 + c) for sign in (1, -1)]
    roots = [sign * mpmath.sqrt(mpmath.mpc(q)) for q in squares for sign in (1, -1)]
    rows = []
    for r in roots:
        e = mpmath.exp(r)
        Y, psi, M, V = e, r * e, r**2 * e, r**3 * e  # V = Q - P psi, which a follower leaves
        moment, force = (psi if held == "psi" else M), (Y if held == "Y" else V)
        rows.append([1, r, moment, force])
    return mpmath.det(mpmath.matrix(rows).T)


def limit(held, start):
    """The force at which free and held columns share a frequency."""
    with mpmath.workdps(30):
        found = mpmath.findroot(
            lambda P, w: [_real(determinant(P, w)), _real(determinant(P, w, held))],
            start,
            tol=1e-20,
        )
        return float(found[0]), float(found[1])


def _real(value):
    """A determinant with two real and two imaginary roots is imaginary, or real."""
    return value.real + value.imag


@pytest.mark.parametrize(
    ("kind", "held", "start"),
    [("translational", "Y", (16.05, 7.05)), ("rotational", "psi", (4.53, 3.9))],
)
@pytest.mark.parametrize("c", [1.0, 1e-2, 1e-5])
def test_a_dashpot_at_the_tip(kind, held, start, c):
    force, omega = limit(held, start)
    found = an.stability(BECK.with_attachments(an.Dashpot(1.0, **{kind: c})))
    assert found.flutter.load_factor == pytest.approx(20.0509536190, rel=1e-11)
    damped = found.damped
    assert damped.proven
    assert damped.load_factor == pytest.approx(force, rel=1e-8)
    assert damped.frequency_hz == pytest.approx(omega / (2 * math.pi), rel=1e-6)
    assert damped.load_factor < 20
