"""Certified lists of beams under following ends against 40 digits, near flutter and at its edges.

The first of `python validation/following.py`; none missing, none too many, no error beyond that
stated, and no line next to an eigenvalue whose proof is wrong.
"""

import numpy as np
import pytest

pytest.importorskip("flint")

from following_digits import (
    Determinant,
    all_roots,
    compared,
    edges,
    near_flutter,
    stepped,
    under,
)

LOADS = (2.0, 8.0, 20.0, 40.0, 80.0, 150.0)


@pytest.mark.parametrize("seed", range(18))
def test_random_beams_below_and_past_flutter(seed):
    rng = np.random.default_rng(1000 + seed)
    beam = stepped(rng, ("any", "any", "uneven")[seed % 3], LOADS[seed // 3])
    found = compared(beam)
    assert (found.missing, found.spurious) == (0, 0)
    assert found.over <= 1
    assert edges(beam)[1] == 0


@pytest.mark.parametrize("seed", [5002])
def test_next_to_flutter(seed):
    kind = ("any", "any", "uneven")[(seed - 5000) % 3]
    beams = near_flutter(stepped(np.random.default_rng(seed), kind, LOADS[0]))
    assert len(beams) == 6
    found = [compared(beam) for beam in beams]
    assert [(each.missing, each.spurious) for each in found] == [(0, 0)] * 6
    assert [each.flutters for each in found] == [False] * 3 + [True] * 3
    assert max(each.over for each in found) <= 1


def test_a_body_whose_rotation_diverges_first_is_among_them():
    rows = [compared(stepped(np.random.default_rng(s), "uneven", 8.0)) for s in range(1000, 1004)]
    assert any(row.diverges and not row.flutters for row in rows)


def test_the_reference_tells_another_beam_apart():
    """The roots of a beam under 1.001 of the load are farther off than any stated error."""
    beam = stepped(np.random.default_rng(1001), "any", 8.0)
    exact, other = (all_roots(b, 3e3, 6) for b in (beam, under(beam, 1.001)))
    assert len(exact) == len(other)
    assert np.min(np.abs(exact[:, None] - other) / np.abs(exact[:, None])) > 1e-6
    value = Determinant(beam)
    assert abs(value.refined(exact[0] * (1 + 1e-5)) - exact[0]) < 1e-14 * abs(exact[0])
