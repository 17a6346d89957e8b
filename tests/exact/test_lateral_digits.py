"""All columns of the lateral law against eigenvalues in 40 digits; the order where they vary."""

from itertools import product

import mpmath
import numpy as np
import pytest
from validation.counting_lateral import ENDS, HELD, _exponential, _matrix

from antinode import Beam, Ends, natural_frequencies, solve_modes

PAIRS = list(product(ENDS, ENDS))


def uniform(left, right, form):
    return Beam.from_stations(
        [0.0, 1.0], 1.3, 0.9, axial_force=1.5, ends=Ends(left, right), shear_form=form,
        shear_stiffness=60.0, rotary_inertia_per_length=0.004, foundation_stiffness=40.0,
        added_mass_per_length=0.2,
    )  # fmt: skip


def determinant(beam, omega2):
    """The determinant of what the right end wants to vanish, by the exponential of A."""
    U = _exponential(_matrix(beam, 0, omega2), mpmath.mpf(1))
    held = [HELD[end] for end in (beam.ends.left, beam.ends.right)]
    zero = [{*h, *(3 - i for i in range(2) if i not in h)} for h in held]
    rows, columns = sorted(zero[1]), [i for i in range(4) if i not in zero[0]]
    return mpmath.det(mpmath.matrix([[U[i, j] for j in columns] for i in rows]))


@pytest.mark.parametrize("form", ["haringx", "engesser"])
@pytest.mark.parametrize("ends", PAIRS, ids="-".join)
def test_all_ends_against_40_digits(ends, form):
    beam = uniform(*ends, form)
    found = {
        b: solve_modes(beam, 5, backend=b, families="bending").modes for b in ("numpy", "numba")
    }
    for both in zip(*found.values(), strict=True):
        with mpmath.workdps(40):
            exact = _root_next_to(beam, both[0].omega2)
            offs = [float(abs(exact - mpmath.mpf(mode.omega2))) for mode in both]
        for mode, off in zip(both, offs, strict=True):
            assert off <= mode.error_omega2
            assert off <= 1e-12 * abs(mode.omega2)
            assert mode.bracket_omega2[0] <= float(exact) <= mode.bracket_omega2[1]


def _root_next_to(beam, omega2):
    bounds = [omega2 * (1 + sign * mpmath.mpf(10) ** -9) for sign in (-1, 1)]
    return mpmath.findroot(lambda w: determinant(beam, w), bounds, solver="anderson", tol=1e-40)


def varying(how, form, ends):
    return Beam.from_stations(
        [0.0, 0.4, 1.0], [1.0, 2.0, 1.5], [1.0, 3.0, 2.0], axial_force=[5.0, -3.0, 2.0],
        shear_stiffness=[60.0, 150.0, 80.0], rotary_inertia_per_length=[0.0, 0.005, 0.002],
        foundation_stiffness=[0.0, 900.0, 100.0], added_mass_per_length=[0.0, 1.0, 0.5],
        interpolation=how, shear_form=form, ends=ends,
    )  # fmt: skip


@pytest.mark.parametrize("how", ["linear", "log"])
@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_what_varies_is_of_fourth_order_and_within_its_error(how, form):
    from antinode.riccati.lanes.calls import find_eigenvalues

    beam = varying(how, form, Ends("clamped", "free"))
    levels = np.array(
        [
            [v.omega2 for v in find_eigenvalues(beam.chain("bending", 2**k), 4, width=1e-13)]
            for k in range(6)
        ]
    )
    exact = levels[-1] + (levels[-1] - levels[-2]) / 15
    error = np.abs(levels[:3] - exact)
    order = np.log2(error[:-1] / error[1:])
    assert np.median(order) > 3.7
    for tolerance in (1e-4, 1e-6, 1e-8):
        for result in (
            natural_frequencies(beam, 4, tolerance=tolerance),
            natural_frequencies(beam, 4, tolerance=tolerance, backend="numpy"),
        ):
            assert np.all(np.abs(result.omega2 - exact) <= result.error_omega2 + 1e-11 * exact)
            assert np.all(result.error_omega2 <= 2.2 * tolerance * result.omega2)
