"""The paper's determinants: right where they can be, and where they are not enough."""

import numpy as np
import pytest
from validation.literal_methods import relative_errors, roots
from validation.literal_methods import uniform as uniform_chain

from antinode import Beam, Ends, solve_modes
from antinode.riccati.chain import evaluate, segment_transfers
from antinode.riccati.literal import riccati_characteristic, tmm_characteristic
from antinode.riccati.points import Point
from law_chains import bar_chain


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


def test_states_no_error_that_it_has_not():
    """Between lost roots it lists 232.31 Hz, where the 12th mode is at 245.44 Hz."""
    result = solve_modes(uniform(), 12, method="tmm")
    assert all(np.isnan(mode.error_hz) for mode in result.modes if mode.number)
    assert result.mode("bending", 1).error_hz is not None
    assert all(entry["error_hz"] is None for entry in result.to_dict()["modes"] if entry["number"])
    assert str(result).count("+-") == 2  # the exact zeros


def test_keeps_what_it_finds_in_divergence():
    beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, 15.0, ends=Ends("pinned", "pinned"))
    result = solve_modes(beam, 2, method="tmm")
    assert result.modes[0].kind == "divergent"


def det_S(chain, omega2):
    """det S_n of equation 79 alone, for a chain of short segments with two free ends."""
    S = np.zeros((len(omega2), 2, 2))
    for U in segment_transfers(chain, omega2):
        S = (U[:, 2:, :2] + U[:, 2:, 2:] @ S) @ np.linalg.inv(U[:, :2, :2] + U[:, :2, 2:] @ S)
    return np.linalg.det(S)


def sign_changes(values):
    return int(np.sum(np.sign(values[1:]) != np.sign(values[:-1])))


FREE_CLAMPED = (1.8751040687119611, 4.694091132974175, 7.854757438237613, 10.995540734875467)


def test_det_S_alone_changes_its_sign_at_poles_as_well():
    """S has a pole wherever the beam with its right end clamped would resonate.

    cos z cosh z = -1 there, and = 1 at the free-free roots. The product of signs (equation 80)
    takes the poles away.
    """
    chain = uniform_chain(100)
    for places, whole_changes in ((FREE_CLAMPED, False), (roots(3), True)):
        for z in places:
            beside = float(z) ** 4 * np.array([1 - 1e-6, 1 + 1e-6])
            assert sign_changes(det_S(chain, beside)) == 1
            assert sign_changes(riccati_characteristic(chain, beside)) == whole_changes


def test_near_free_ends_a_scan_of_det_S_loses_roots_that_equation_80_keeps():
    """The pole closes in on the root as exp(-z): 5 % apart at first, 6e-6 at the third mode.

    A scan that steps over both sees no change; equation 80 shows each root once.
    """
    third = float(roots(3)[2])
    assert third - FREE_CLAMPED[3] < 1e-4
    chain, scan = uniform_chain(100), np.linspace(0.5, 12.0, 2001) ** 4
    near = scan[np.searchsorted(scan, third**4) + np.array([-1, 0])]
    assert sign_changes(det_S(chain, near)) == 0
    assert sign_changes(riccati_characteristic(chain, near)) == 1
    assert sign_changes(riccati_characteristic(chain, scan)) == 3


def test_an_exact_pole_is_no_number_and_no_failure():
    """A mass and a joint at the left end of a bar: 1 - f omega^2 m_p vanishes at omega^2 = 3."""
    one = np.ones(1)
    point = Point(0, mass=1.0, compliance=1 / 3)
    chain = bar_chain(one, one, one, points=(point,))
    values = riccati_characteristic(chain, [1.0, 3.0])
    assert np.isfinite(values[0])
    assert np.isnan(values[1])


@pytest.mark.parametrize("segments", [1, 100, 400])
def test_the_transfer_matrix_determinant_drowns_and_the_frame_does_not(segments):
    """The product grows as exp(beta L): past 1e16, near mode 12, the sign of (66) is noise."""
    chain = uniform_chain(segments)
    literal = relative_errors(tmm_characteristic, chain, 20)
    frame = relative_errors(lambda c, w: evaluate(c, w).characteristic, chain, 20)
    assert np.all(frame < 1e-12)
    assert np.all(literal[:4] < 1e-9)
    assert np.nanmax(literal[5:]) > 1e-8
    assert np.any(np.isnan(literal))
