"""Which eigenvalue is the rotation: against small steps of all forces from no load."""

import sys
from pathlib import Path

import numpy as np
import pytest

import antinode as an
from antinode.modes import rotation
from antinode.modes.following import eigenvalues_alone, translates_freely
from antinode.modes.loading import loaded_chain
from antinode.modes.rigid import pivot_of
from antinode.modes.rotation import elastic, rigid_rotation, rotation_among, trace
from antinode.riccati import readable

sys.path.append(str(Path(__file__).parents[2] / "exact"))

from following_beams import random_beam


def lowest(chain, number=6):
    return eigenvalues_alone(readable, chain, number, int(translates_freely(chain)), 1e-9)


def nonzero(chain):
    return [value for value in lowest(chain) if value.omega2 != 0.0]


def drawn(seed, load):
    return random_beam(np.random.default_rng(seed), load=load)


@pytest.mark.parametrize(("seed", "load"), [(5000, 2.0), (5001, 8.0), (5002, 20.0), (5003, 40.0)])
def test_below_divergence_it_is_the_lowest(seed, load):
    beam = drawn(seed, load)
    chain = beam.chain("bending")
    assert chain.left in ("free", "pinned")
    found = nonzero(chain)
    place = trace(chain, pivot_of(beam), nonzero)
    assert found[rotation_among(found, chain, pivot_of(beam))].value == pytest.approx(place)
    assert rotation_among(found, chain, pivot_of(beam)) == 0


@pytest.mark.parametrize(
    ("seed", "load", "place"), [(5027, 40.0, 0), (5034, 80.0, 0), (5052, 80.0, 1)]
)
def test_where_the_lowest_is_not_next_to_a_rigid_body_it_is_traced(monkeypatch, seed, load, place):
    beam = drawn(seed, load)
    chain, pivot = beam.chain("bending"), pivot_of(beam)
    found = nonzero(chain)
    values = np.array([v.value for v in found])
    near = int(np.argmin(np.abs(values - rigid_rotation(chain, pivot))))
    assert near != int(np.argmin(values.real))
    monkeypatch.setattr(rotation, "_STEP", 1 / 40)
    assert values[place] == pytest.approx(trace(chain, pivot, nonzero))
    monkeypatch.undo()
    assert rotation_among(found, chain, pivot) == place


def test_a_share_of_the_forces_scales_all_of_them():
    ends = an.Ends(right_follower=0.5)
    beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1], axial_force=[4, 4], ends=ends)
    half = loaded_chain(beam.chain("bending"), 0.5)
    assert half.following == (0.0, 1.0)
    assert np.all(half.axial_force == 2.0)


def test_the_rotation_is_left_out_of_elastic_modes():
    ends = an.Ends(right_follower=1.0)
    beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1], axial_force=[4, 4], ends=ends)
    chain = beam.chain("bending")
    found = lowest(chain, 4)
    rest = elastic(found, 2, chain)
    assert [v.index for v in rest] == [3, 4]
