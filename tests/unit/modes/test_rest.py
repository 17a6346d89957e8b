"""Rigid motions of damped beams: which rest, how often they count, and what their dashpots do."""

import pytest

import antinode as an

SOFT = 1e-2
"""Of dashpots so weak that the beam moves rigidly where it creeps."""
CASES = {
    "in the middle": ("free", [(0.5, SOFT)], [], ["translation", "rotation"], 3, [SOFT]),
    "at a tip": ("free", [(1.0, SOFT)], [], ["translation", "rotation"], 3, [4 * SOFT]),
    "at both": ("free", [(0.0, SOFT), (1.0, SOFT)], [], ["translation", "rotation"], 2, [2, 6]),
    "beside a spring": ("free", [(1.0, SOFT)], [0.0], ["rotation"], 1, [3 * SOFT]),
    "with a spring": ("free", [(0.5, SOFT)], [0.5], ["rotation"], 2, []),
    "sliding": ("sliding", [(1.0, SOFT)], [], ["translation"], 1, [SOFT]),
}


@pytest.mark.parametrize("name", CASES)
def test_what_rests_is_named_rigid(name):
    """By hand: a unit bar, m = 1, J = 1/12; about its end 1/3."""
    left, dashpots, springs, rigid, at_zero, creeps = CASES[name]
    ends = an.Ends(left, left)
    items = [an.Dashpot(x, translational=c) for x, c in dashpots]
    items += [an.Spring(x, translational=3.0) for x in springs]
    beam = an.Beam.from_stations([0, 0.5, 1], [1, 1, 1], [1, 1, 1], ends=ends)
    found = an.solve_modes(beam.with_attachments(*items), 2, families=["bending"])
    assert [m.name for m in found.modes if m.kind == "rigid"] == [f"rigid {r}" for r in rigid]
    assert found.certificate["kind"] == "winding"
    assert found.certificate["record"]["at_zero"] == at_zero
    slow = sorted(-m.growth_rate_per_s for m in found.modes if m.kind == "overdamped")
    wanted = [c if c < 1 else c * SOFT for c in creeps]
    assert slow == pytest.approx(wanted, rel=1e-2)
