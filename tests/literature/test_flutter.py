"""Published flutter loads of columns under forces that follow, each with its source."""

import numpy as np
import pytest

import antinode as an


def column(share=1.0, **columns):
    """Beck's column of EI = m = L = 1 under a unit force, of which a share follows."""
    ends = an.Ends("clamped", right_follower=share)
    given = {name: [value, value] for name, value in columns.items()}
    return an.Beam.from_stations([0, 1], [1, 1], [1, 1], axial_force=[1, 1], ends=ends, **given)


def flutter(beam):
    return an.stability(beam, dampers=False).flutter


@pytest.mark.parametrize("k", [1.0, 50.0, 400.0])
def test_smith_and_herrmann_1972(k):
    """T. E. Smith, G. Herrmann, Stability of a beam on an elastic foundation subjected to a
    follower force, J. Appl. Mech. 39 (1972) 628: the flutter load of Beck's column is 20.05 on any
    uniform Winkler foundation; as retold in T. M. Atanackovic et al., arXiv:1408.2686.

    The foundation adds k/m to every omega^2, which only moves the frequency.
    """
    bare, found = flutter(column()), flutter(column(foundation_stiffness=k))
    assert round(found.load_factor, 2) == 20.05
    assert found.load_factor == pytest.approx(bare.load_factor, rel=1e-9)
    omega = 2 * np.pi * np.array([found.frequency_hz, bare.frequency_hz])
    assert omega[0] ** 2 == pytest.approx(omega[1] ** 2 + k, rel=1e-7)


def test_a_foundation_moves_the_load_where_rotary_inertia_counts():
    """The paradox belongs to inertia and foundation in proportion: rho I psi_tt has none."""
    rotary = {"rotary_inertia_per_length": 0.01}
    bare, found = flutter(column(**rotary)), flutter(column(foundation_stiffness=50.0, **rotary))
    assert abs(found.load_factor / bare.load_factor - 1) > 1e-3


QUOTED = {
    "Beck 1952, Z. angew. Math. Phys. 3, 225": (column(), "20.05"),
    "half of the force follows": (column(share=0.5), "16.05"),
}


@pytest.mark.parametrize("name", QUOTED)
def test_loads_as_they_are_quoted_since(name):
    """To the digits that textbooks give: M. A. Langthjem, Y. Sugiyama, Dynamic stability of columns
    subjected to follower loads: a survey, J. Sound Vib. 238 (2000) 809.
    """
    beam, printed = QUOTED[name]
    assert f"{flutter(beam).load_factor:.2f}" == printed
