"""Arguments of compiled functions: what may be passed, and how it arrives."""

import numpy as np
import pytest

from antinode.riccati.lanes import library
from antinode.riccati.lanes.structures import Kept, words_of
from antinode.riccati.lanes.workspace import Task, new_chain, new_lanes


def test_words_are_arrays_and_numbers_in_order():
    array, task = np.zeros(3), Task(2, 1e-10, True)
    kept = Kept(task)
    assert words_of((array, task, kept, 7)) == [id(array), 2, 1e-10, True, kept.address, 7]


def chain_of(length):
    chain = new_chain(0, 0, 0, 8)
    for values in chain[4:7]:
        values[:] = 1.0
    return chain._replace(length=length)


def test_a_read_only_array_is_read():
    chain = chain_of(np.full(8, 0.5))
    for name in ("mass", "stiffness"):
        getattr(chain, name)[:] = 2.0
    table = np.empty((24, 40))
    pieces = library.library().call("prepare", chain, 1.0, table)[0]
    chain.length.flags.writeable = False
    assert library.library().call("prepare", chain, 1.0, table)[0] == pieces >= 8


@pytest.mark.parametrize("cut", [np.s_[::2], np.s_[::-1]])
def test_an_array_with_gaps_is_refused_before_anything_is_read(cut):
    chain, table = chain_of(np.full(16, 0.5)[::2]), np.full((24, 40), 3.0)
    with pytest.raises(ValueError, match="prepare takes is not contiguous"):
        library.library().call("prepare", chain, 1.0, table)
    assert np.all(table == 3.0)
    good = chain_of(np.full(8, 0.5))
    with pytest.raises(ValueError, match="not contiguous"):
        library.library().call("prepare", good, 1.0, np.zeros((48, 40))[cut])


def test_what_is_kept_is_looked_into_as_well():
    lanes = new_lanes()._replace(value=np.zeros(16)[::2])
    with pytest.raises(ValueError, match="not contiguous"):
        library.library().call(
            "repeat", chain_of(np.full(8, 0.5)), np.zeros((24, 40)), Kept(lanes), 1, 1
        )
