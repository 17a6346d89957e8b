"""What modes warn of: shear that buckles, springs that push, rotations that soften."""

import math

import pytest

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Spring
from antinode.beam.rotation import Rotation, apply_rotation
from antinode.modes.warnings import ROTATION_SOFTENS, SHEAR_BUCKLES, SHEAR_LOWERS, SPRINGS_PUSH

LENGTH, EI = 2.0, 3e4
STIFF = 4.9 * (math.pi / LENGTH) ** 2 * EI / 0.2  # EA for which k^2 EI / kGA is 0.2 in mode 1
EULER = math.pi**2 * EI / LENGTH**2


def told(share, ends=("pinned", "pinned"), unloaded=True, EA=STIFF, modes=1):
    """Warnings of a strut under a share of its Euler load."""
    N = None if share == 0 else share * EULER
    strut = Beam.from_stations([0.0, LENGTH], 12.0, EI, EA, N, ends=Ends(*ends))
    return solve_modes(strut, modes, families=["bending"], unloaded=unloaded).warnings


@pytest.mark.parametrize("share", [0.8, 0.82, 0.84, 0.86, 0.9, 0.97])
def test_a_strut_buckles_by_shear_at_engessers_load(share):
    """With shear it buckles at P_E/(1 + k^2 EI/kGA) (Engesser), here 0.8333 P_E."""
    assert any(text.endswith(SHEAR_BUCKLES) for text in told(share)) == (share > 1 / 1.2)


def test_without_the_unloaded_beam_it_is_known_too():
    for share in (0.82, 0.9):
        said = told(share, unloaded=False)
        assert any(text.endswith(SHEAR_BUCKLES) for text in said) == (share > 1 / 1.2)


def test_a_short_beam_without_load_does_not_buckle():
    said = told(0, ends=("free", "free"), modes=6)
    assert any("kappa = 0.53" in text and text.endswith(SHEAR_LOWERS) for text in said)
    assert not any("buckling" in text for text in said)


def test_a_slender_strut_near_its_load_is_told_nothing_of_shear():
    assert not any("buckling" in text for text in told(0.97, EA=1e3 * STIFF))


SPRUNG = [  # end springs K_x, K_theta, K_xtheta, and whether they push
    ([(1e6, 1e6, 2e6)], True),
    ([(1e6, 1e6, -2e6)], True),
    ([(0.0, 1e6, 1e3)], True),
    ([(1e6, 1e6, 9e5)], False),
    ([(1e6, 1e6, 1e6)], False),  # of rank one: a spring on a rigid arm
    ([(1e6, 1e6, 2e6), (4e6, 4e6, 0.0)], False),  # together they hold
]


@pytest.mark.parametrize(("springs", "push"), SPRUNG)
@pytest.mark.parametrize("x", [0.0, 4.0])
def test_springs_that_push_are_not_blamed_on_compression(springs, push, x):
    beam = Beam.from_stations([0.0, 10.0], 100.0, 1e7).with_attachments(
        *(Spring(x, a, b, coupling=c) for a, b, c in springs)
    )
    said = solve_modes(beam, 3, families=["bending"]).warnings
    assert any("K_xtheta^2 above K_x K_theta" in text for text in said) == push
    assert not any("compression" in text for text in said)
    assert any(text.endswith(SPRINGS_PUSH) for text in said) == push


def test_a_rotation_in_its_plane_is_not_blamed_on_compression():
    beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, ends=Ends(left="free", left_axial="fixed"))
    beam = beam.with_attachments(Spring(0.0, 0.5, 0.5))
    turning = apply_rotation(beam, Rotation(3.0, plane="in_plane"))
    said = solve_modes(turning, 2, families=["bending"]).warnings
    assert any(text.endswith(ROTATION_SOFTENS) for text in said)
