"""Beams whose dimensions taper, against 30 digits: the error is never above the one stated.

The numbers are those of `drawn_beams`, Taylor series of textbook formulas: both theories
under axial force, down to a wall that fills its tube, and cones of a thousandth of their foot.
"""

from dataclasses import replace

import numpy as np
import pytest

import antinode as an
from antinode.beam.sections import Material, drawn_beam
from drawn_beams import DrawnBeam, tube

STEEL = Material(youngs_modulus=210e9, density=7850)
CASES = {
    "tower": ({"outer_diameter": [4, 2.5], "wall": [0.04, 0.02]}, 80, ("clamped", "free"), 0),
    "tube that ends solid": (
        {"outer_diameter": [0.5, 0.3], "wall": [0.01, 0.15]},
        *(10, ("free", "free"), 2e5),
    ),
    "cone": ({"outer_diameter": [1, 0.001]}, 10, ("clamped", "free"), 0),
    "spike": ({"outer_diameter": [1, 0.02], "wall": [0.01, 0.01]}, 10, ("clamped", "free"), 0),
    "bar": ({"width": [0.04, 0.01], "height": [0.04, 0.01]}, 1, ("pinned", "clamped"), -1e4),
    "box": (
        {"width": [0.4, 0.1], "height": [0.3, 0.5], "wall": [0.04, 0.01]},
        *(10, ("clamped", "free"), 1e5),
    ),
}
EULER = {
    "tower": (26.128318332051387, 544.14335984151854, 3530.5444251153964),
    "tube that ends solid": (23193.237900928553, 156893.92863749977, 567430.82480088862),
    "cone": (12660.497684419622, 74461.954916564779, 246246.75835761727),
    "spike": (8911.0655125650351, 73505.015256340753, 290632.09914902661),
    "bar": (163220.58264275685, 2693437.9430906062, 12159687.614301477),
    "box": (1103.1814016786457, 31289.919871998235, 217797.6004438856),
}
TIMOSHENKO = {
    "tower": (25.90839610928951, 522.54491570785535, 3221.7439666126015),
    "tube that ends solid": (22854.408279194627, 150570.56165979133, 524565.39255033713),
    "cone": (12485.151626149321, 72437.381292399884, 235461.62149678077),
    "spike": (8682.2733772231601, 69126.316888570279, 260986.61234807855),
    "bar": (162606.76752745456, 2667035.5284207307, 11921668.75194111),
}
"""omega^2 [rad^2/s^2] of modes 1 to 3."""


def beam_of(name, theory):
    dimensions, length, ends, N = CASES[name]
    return drawn_beam(
        *([0, length], STEEL), axial_force=N, ends=an.Ends(*ends), theory=theory, **dimensions
    )


@pytest.mark.parametrize(
    ("theory", "name"),
    [("euler_bernoulli", name) for name in EULER] + [("timoshenko", name) for name in TIMOSHENKO],
)
def test_the_stated_error_holds(theory, name):
    exact = np.array((EULER if theory == "euler_bernoulli" else TIMOSHENKO)[name])
    beam = beam_of(name, theory)
    for tolerance in (1e-3, 1e-6, 1e-9):
        found = an.natural_frequencies(beam, 3, tolerance=tolerance)
        off = np.abs(found.omega2 - exact)
        assert np.all(off <= found.error_omega2), (tolerance, off / found.error_omega2)
        assert np.all(off <= 2 * tolerance * exact)
    result = an.solve_modes(beam, 3, families=("bending",), tolerance=1e-7)
    modes = [result.mode("bending", k) for k in (1, 2, 3)]
    off = np.abs([mode.omega2 for mode in modes] - exact)
    assert np.all(off <= [mode.error_omega2 for mode in modes])


@pytest.mark.parametrize("name", ["tube that ends solid", "box"])
def test_cut_or_reversed_it_is_the_same_beam(name):
    beam = beam_of(name, "euler_bernoulli")
    found = an.natural_frequencies(beam, 3, tolerance=1e-9).omega2
    cut = beam.with_breakpoints([0.3, 7.7])
    assert an.natural_frequencies(cut, 3, tolerance=1e-9).omega2 == pytest.approx(found, rel=3e-9)
    turned = beam.reversed()
    assert an.natural_frequencies(turned, 3, tolerance=1e-9).omega2 == pytest.approx(
        found, rel=3e-9
    )
    assert turned.drawing.reversed() == beam.drawing


def test_a_straight_diameter_is_no_straight_stiffness():
    """What a table of the same two stations would say is far off."""
    beam = beam_of("cone", "euler_bernoulli")
    ends = {n: getattr(beam, n)[:, [0, -1]] for n in ("mass_per_length", "bending_stiffness")}
    straight = an.Beam(beam.x, **ends, interpolation="linear", ends=beam.ends)
    f, g = (an.natural_frequencies(b, 1).frequencies_hz[0] for b in (beam, straight))
    assert abs(g / f - 1) > 0.1


def test_the_reference_itself():
    """A thin tapered tube, mode 1; and the reference against a uniform beam's closed form."""
    D, t = CASES["tower"][0].values()
    again = DrawnBeam(tube, (D, t), 210e9, 7850, length=80).omega2(EULER["tower"][0] * (1 + 1e-10))
    assert float(again) == pytest.approx(EULER["tower"][0], rel=1e-15)
    uniform = DrawnBeam(tube, ((1, 1), (0.1, 0.1)), 210e9, 7850, length=10)
    d2 = 1 + 0.8**2
    guess = 1.875104068711961**4 * 210e9 * d2 / 16 / (7850 * 10**4)
    assert float(uniform.omega2(guess * (1 + 1e-10))) == pytest.approx(guess, rel=1e-14)


@pytest.mark.parametrize("shear_form", ["haringx", "engesser"])
def test_shear_forms_agree_with_many_short_uniform_pieces(shear_form):
    """Stepped tables at the middles, halved: second order, extrapolated."""
    beam = replace(beam_of("bar", "timoshenko"), shear_form=shear_form)
    exact = an.natural_frequencies(beam, 2, tolerance=1e-9).omega2
    found = []
    for n in (200, 400):
        x = np.linspace(0, 1, n + 1)
        side = np.append(0.04 - 0.03 * (x[1:] + x[:-1]) / 2, 0.01)
        steps = drawn_beam(
            *(x, STEEL), width=side, height=side, axial_force=-1e4, interpolation="step",
            ends=beam.ends, shear_form=shear_form,
        )  # fmt: skip
        found.append(an.natural_frequencies(steps, 2).omega2)
    assert (4 * found[1] - found[0]) / 3 == pytest.approx(exact, rel=2e-7)
