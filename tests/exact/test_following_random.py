"""Random beams under following forces, below flutter and past it: none missing, none too many.

The list left of the line that the certificate names is held against finite elements, whose dense
eigenvalues have no order and no certificate, and against 40 digits. More of the same:
validation/following.py.
"""

import numpy as np
import pytest
from following_beams import Exponentials, elements, nearest, random_beam

from antinode.modes.backends import choose
from antinode.modes.following import Following
from antinode.modes.refinement import solve_family
from antinode.modes.rigid import exact_zeros
from antinode.modes.solvers import Counting
from antinode.riccati.following.roots import Finder

BACKEND = choose("numpy")


def solved(beam, modes=4):
    """Eigenvalues of a beam to 1e-9, and the region in which they are all."""
    found = solve_family(beam, "bending", modes, 1e-9, Following(BACKEND))
    assert found.certificate["kind"] == "winding", found.warnings
    values = np.array([v.value for v in found.eigenvalues])
    return values, found.certificate["region"]["real_part_of_omega2_below"]


def compared(beam):
    """Missing and spurious eigenvalues, and the largest relative distance of pairs."""
    mine, below = solved(beam)
    theirs = elements(beam, len(mine) + 4, shift=-0.1 * below)
    theirs = theirs[theirs.real < below]
    scale = np.abs(mine).max() * 1e-7
    far = 0.0
    for value in mine:
        k = int(np.argmin(np.abs(theirs - value))) if len(theirs) else -1
        if k >= 0 and abs(theirs[k] - value) < 1e-3 * abs(value) + scale:
            far = max(far, abs(theirs[k] - value) / (abs(value) + 1e3 * scale))
            theirs = np.delete(theirs, k)
        else:
            return len(theirs), 1, far
    return len(theirs), 0, far


def distances(beam, modes=4):
    """Relative distances from elements of high degree next to each, and how two meshes differ."""
    found = solve_family(beam, "bending", modes, 1e-11, Counting(choose("numba")))
    assert found.certificate["kind"] == "winding", found.warnings
    rows = []
    for value in (v.value for v in found.eigenvalues if v.omega2 != 0.0):
        one, other = (nearest(beam, count, shift=1.003 * value) for count in (3, 6))
        rows.append((abs(other - value) / abs(value), abs(other - one) / abs(value)))
    return np.array(rows)


@pytest.mark.parametrize("seed", [1, 2, 4, 5])
def test_tables_against_elements_in_double_precision(seed):
    rng = np.random.default_rng(20000 + seed)
    far, own = distances(random_beam(rng, load=[2.0, 8.0, 20.0, 40.0][seed % 4])).T
    assert np.max(own) < 1e-11
    assert np.max(far) < 1e-10


@pytest.mark.parametrize("seed", range(24))
def test_nothing_is_missing_and_nothing_too_many(seed):
    rng = np.random.default_rng(seed)
    beam = random_beam(rng, load=[4.0, 15.0, 40.0, 90.0][seed % 4])
    missing, spurious, far = compared(beam)
    assert (missing, spurious) == (0, 0)
    assert far < 1e-6


@pytest.mark.parametrize("seed", range(10))
def test_eigenvalues_in_forty_digits(seed):
    beam = random_beam(np.random.default_rng(100 + seed), load=[6.0, 60.0][seed % 2], uniform=True)
    chain = beam.chain("bending")
    zeros = min(exact_zeros(beam, "bending"), 1)

    def fixed(number):
        return BACKEND.find_eigenvalues(chain.fixed, number, zeros=zeros)

    found = Finder(chain, fixed, zeros, 1e-10).find(4)
    assert found.complete
    assert found.certificate.proven
    exact = Exponentials(beam)
    for value in found.eigenvalues:
        if abs(value.value) > 1e-6:
            true = exact.refined(value.value)
            half = (value.bracket[1] - value.bracket[0]) / 2
            assert abs(true - value.value) <= 2.1 * half + 1e-12 * abs(true)
