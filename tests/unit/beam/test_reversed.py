"""A beam read from the other end: the same frequencies, or a sentence."""

import numpy as np
import pytest

from antinode import Beam, Ends, InputError, natural_frequencies
from antinode.beam.attachments import Joint, PointMass, Spring


def beam(*items):
    bare = Beam.from_stations(
        [0, 0.7, 1.5, 2], [1, 2, 3], [5, 1, 2], [7, 8, 9], [3, -2, 1], ends=Ends("clamped", "free")
    )
    return bare.with_attachments(*items)


@pytest.mark.parametrize(
    "items",
    [
        (PointMass(0.7, 1.0, 0.3), Joint(0.7, rotational=0.5)),
        (PointMass(0.7, 1.0, 0.0, 0.1), Joint(0.7, rotational=0.5)),
        (Spring(1.5, rotational=2.0), Joint(1.5, rotational=0.5)),
        (PointMass(0.7, 1.0), Joint(0.7, axial=0.5)),
        (Spring(1.5, axial=2.0), Joint(1.5, axial=0.5)),
    ],
)
def test_what_moves_with_one_side_of_a_joint_is_refused(items):
    with pytest.raises(InputError, match="left of a joint"):
        beam(*items).reversed()


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
