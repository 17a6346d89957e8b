"""Single beams whose end forces follow: compiled code against frames and winding numbers."""

import numpy as np
import pytest
from following_beams import random_beam

import antinode as an
from antinode.modes.backends import choose
from antinode.modes.following import translates_freely
from antinode.modes.rigid import rigid_modes


def both(beam):
    """Modes by numpy and by compiled code."""
    settings = {"families": ["bending"], "tolerance": 1e-8}
    return [an.solve_modes(beam, 5, backend=name, **settings) for name in ("numpy", "numba")]


@pytest.mark.parametrize("seed", range(12))
def test_compiled_code_finds_what_frames_find(seed):
    load = [2.0, 8.0, 20.0, 40.0, 80.0, 150.0][seed % 6]
    readable, compiled = both(random_beam(np.random.default_rng(9000 + seed), load=load))
    assert [m.name for m in readable.modes] == [m.name for m in compiled.modes]
    assert [m.kind for m in readable.modes] == [m.kind for m in compiled.modes]
    assert compiled.certificate["kind"] == "winding"
    for one, other in zip(readable.modes, compiled.modes, strict=True):
        assert abs(one.omega2 - other.omega2) <= one.error_omega2 + other.error_omega2


def uneven(force, shares):
    """A free body of random table under N rising to `force`, past what it bears if it kept on."""
    x, rng = np.linspace(0, 1, 21), np.random.default_rng(3)
    m, EI = (np.exp(rng.uniform(-0.5, 0.5, 21)) for _ in range(2))
    left, right = shares
    N = force * (0.3 * left + x)
    ends = an.Ends(left_follower=left, right_follower=right)
    return an.Beam.from_stations(x, m, EI, axial_force=N, interpolation="linear", ends=ends)


@pytest.mark.parametrize("shares", [(0.0, 1.0), (1.0, 1.0)])
def test_a_load_past_buckling_of_fixed_directions_needs_no_winding_numbers(shares):
    beam = uneven(40.0, shares)
    fixed = an.solve_modes(uneven(40.0, (0.0, 0.0)), 1, families=["bending"])
    assert fixed.modes[0].kind == "divergent"
    chain, rigid = beam.chain("bending"), len(rigid_modes(beam, "bending"))
    zeros = int(translates_freely(chain))
    found = choose("numba").find_following(chain, rigid, 8, zeros=zeros, free=False, width=1e-10)
    assert found is not None
    assert found.certificate.proven
    assert found.certificate.below > found.eigenvalues[-1].omega2
    assert len(found.eigenvalues) == found.certificate.number


def test_what_flutters_or_diverges_is_left_to_winding_numbers():
    x = np.linspace(0, 1, 3)
    for force in (19.0, 21.0):
        ends = an.Ends("clamped", "free", right_follower=1.0)
        beam = an.Beam.from_stations(
            x, np.ones(3), np.ones(3), axial_force=force * np.ones(3), ends=ends
        )
        chain = beam.chain("bending")
        found = choose("numba").find_following(chain, 0, 3, zeros=0, free=False, width=1e-10)
        assert (found is None) == (force > 20.05)
