"""Results do not depend on history: on what was solved before, nor on whether the code was cached.

Every solve runs in a fresh process; what it found is compared to the last bit.
"""

import os
import subprocess
import sys

import pytest

from installed import SOLVE


def solved(before, **environment):
    """Solve in a fresh process; return what it says of its results, and what it told on stderr."""
    kept = {k: v for k, v in os.environ.items() if k != "ANTINODE_CACHE_DIR"}
    command = [sys.executable, "-c", SOLVE, before]
    done = subprocess.run(
        command, env=kept | environment, capture_output=True, text=True, check=True
    )
    return done.stdout, done.stderr


@pytest.mark.parametrize("before", ["nothing", "other solves", "numpy", "numba"])
def test_a_warm_cache_and_other_solves_change_no_bit(cold, before):
    found, told = solved(before, ANTINODE_CACHE_DIR=str(cold.cache))
    assert told == ""
    assert found == cold.found


def test_code_made_twice_gives_the_same(cold):
    """In another folder, by another process: that of all other tests."""
    assert solved("nothing")[0] == cold.found
