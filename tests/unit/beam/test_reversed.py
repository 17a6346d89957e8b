"""A beam read from the other end has the same frequencies."""

import numpy as np
import pytest

from antinode import Beam, Ends, natural_frequencies, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring


def beam(*items):
    bare = Beam.from_stations(
        [0, 0.7, 1.5, 2], [1, 2, 3], [5, 1, 2], [7, 8, 9], [3, -2, 1], ends=Ends("clamped", "free")
    )
    return bare.with_attachments(*items)


AT_JOINTS = [
    (PointMass(0.7, 1.0, 0.3), Joint(0.7, rotational=0.5)),
    (PointMass(0.7, 1.0, 0.0, 0.1), Joint(0.7, rotational=0.5)),
    (Spring(1.5, rotational=2.0), Joint(1.5, rotational=0.5)),
    (Spring(1.5, np.inf, rotational=np.inf), PointMass(1.5, 1.0, 2.0), Joint(1.5, rotational=0.5)),
    (PointMass(0.7, 1.0), Joint(0.7, axial=0.5)),
    (Spring(1.5, axial=2.0), Joint(1.5, axial=0.5), Joint(0.7, 0.3), PointMass(0.7, 2.0, 1.0)),
]


def found(one, modes=4):
    result = solve_modes(one, modes, backend="numpy")
    return [mode.omega2 for mode in result.modes], [mode.error_omega2 for mode in result.modes]


@pytest.mark.parametrize("items", AT_JOINTS)
def test_what_moves_with_one_side_of_a_joint_moves_with_it(items):
    """From either end, and twice: a mass that changed its side would not."""
    there = beam(*items)
    back = there.reversed()
    (own, error), (turned, more), (again, most) = map(found, (there, back, back.reversed()))
    np.testing.assert_allclose(turned, own, atol=max(error) + max(more), rtol=1e-9)
    np.testing.assert_allclose(again, own, atol=max(error) + max(most), rtol=1e-9)
    swapped = beam(*items).reversed().attachments
    joint = next(item for item in swapped if isinstance(item, Joint))
    moved = [item for item in swapped if not isinstance(item, Joint)]
    assert all(item.x > joint.x for item in moved if abs(item.x - joint.x) < 1e-9)


def test_the_other_side_would_be_another_beam():
    items = PointMass(0.7, 1.0, 0.3), Joint(0.7, rotational=0.5)
    there = beam(*items)
    wrong = beam(PointMass(0.7 + 1e-9, 1.0, 0.3), Joint(0.7, rotational=0.5))
    assert found(wrong)[0][1] != pytest.approx(found(there)[0][1], rel=1e-3)


@pytest.mark.parametrize(
    "items",
    [
        (PointMass(0.7, 1.0), Joint(0.7, rotational=0.5)),
        (PointMass(0.7, 1.0, 0.3), Joint(1.5, rotational=0.5)),
        (Spring(1.5, translational=2.0), Joint(1.5, rotational=0.5)),
    ],
)
def test_the_rest_reads_the_same_from_either_end(items):
    there = beam(*items)
    found = [natural_frequencies(b, 4).omega2 for b in (there, there.reversed())]
    np.testing.assert_allclose(found[1], found[0], rtol=1e-9)
