"""Results do not depend on history: on what was solved before, nor on whether the code was cached.

Every solve runs in a fresh process; what it found is compared to the last bit.
"""

import os
import subprocess
import sys

import pytest

SOLVE = """
import hashlib, sys
import numpy as np
import antinode as an

def first(rng, n=12, **more):
    x = np.sort(rng.uniform(0, 4, n))
    m, EI, EA = (s * np.exp(0.4 * rng.standard_normal(n)) for s in (300, 3e5, 1e7))
    return an.Beam.from_stations(x, m, EI, EA, 2e3 * x, **more)

def batch(rng, one, n=25, beams=150):
    h, m, EI = np.full(n, 0.1), rng.uniform(1, 3, (beams, n)), rng.uniform(1e3, 3e3, (beams, n))
    N = rng.uniform(-1, 1, (beams, 1)) * rng.uniform(0, 500, n)
    return an.BeamBatch(h, m[0] if one else m, EI[0] if one else EI, N, modes=5)

def everything(seed):
    rng = np.random.default_rng(seed)
    for beam in (first(rng, interpolation="log"), first(rng, ends=an.Ends("clamped", "free"))):
        yield an.natural_frequencies(beam, 5).omega2
        result = an.solve_modes(beam, 4)
        for mode in result.modes:
            yield np.array([mode.omega2, *mode.bracket_omega2, mode.modal_mass])
            yield mode.states
    for one in (True, False):
        result = an.solve_many(batch(rng, one))
        yield result.omega2
        yield result.bracket_omega2

def other_things():
    rng = np.random.default_rng(99)
    an.solve_many(batch(rng, False, n=3000, beams=3))
    an.natural_frequencies(first(rng, 40, interpolation="log"), 60, tolerance=1e-9)
    an.solve_modes(first(rng, 5), 20)
    an.solve_many(batch(rng, True, n=7, beams=900))

before = sys.argv[1]
if before == "other solves":
    other_things()
elif before == "numba":
    import numba
    numba.njit(lambda x: x + 1)(1)
elif before == "numpy":
    an.solve_modes(first(np.random.default_rng(5)), backend="numpy")
digest = hashlib.sha256()
for values in everything(7):
    digest.update(np.ascontiguousarray(values).tobytes())
from antinode.riccati.lanes.library import library
print(digest.hexdigest(), library().digest)
"""


def solved(cache, before):
    """Solve in a fresh process; return what it says of its results, and what it told on stderr."""
    environment = {**os.environ, "ANTINODE_CACHE_DIR": str(cache)}
    command = [sys.executable, "-c", SOLVE, before]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return done.stdout, done.stderr


@pytest.fixture(scope="module")
def cold(tmp_path_factory):
    """A folder without compiled code, and what the process that has it made there finds."""
    cache = tmp_path_factory.mktemp("cache")
    return cache, solved(cache, "nothing")[0]


@pytest.mark.parametrize("before", ["nothing", "other solves", "numpy", "numba"])
def test_a_warm_cache_and_other_solves_change_no_bit(cold, before):
    cache, expected = cold
    found, told = solved(cache, before)
    assert told == ""
    assert found == expected


def test_code_made_twice_gives_the_same(cold):
    """In another folder, by another process: that of all other tests."""
    environment = {k: v for k, v in os.environ.items() if k != "ANTINODE_CACHE_DIR"}
    command = [sys.executable, "-c", SOLVE, "nothing"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == cold[1]
