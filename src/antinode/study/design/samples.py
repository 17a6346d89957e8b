"""Samples: numbers between 0 and 1, any rows of a design by themselves.

A design that grows keeps its first rows. Random and Sobol ones do so as they are. A Latin hypercube
of N = n 2^k samples, n odd, is one of n samples that was doubled k times: of the two halves of each
layer one has a sample already, and the new samples take the other halves in random order. So every
design of N samples has one in each of N layers, and is the first half of the design of 2 N.

Sobol points start anywhere: point i is the exclusive or of the direction numbers of the bits that
are set in the Gray code of i.
"""

from __future__ import annotations

import warnings
from functools import partial
from typing import Any

import numpy as np

from antinode.arrays import Array


def random_samples(seed: int, chunk: int, rows: int, dimensions: int) -> Array:
    """Return the samples of a chunk, shape (rows, dimensions); fewer rows are the first ones."""
    return np.random.default_rng([seed, 1, chunk]).random((rows, dimensions))


def latin_column(seed: int, dimension: int, number: int) -> Array:
    """Return one column of a Latin hypercube, shape (number,)."""
    doublings = (number & -number).bit_length() - 1
    odd = number >> doublings
    rng = np.random.default_rng([seed, 2, dimension, odd])
    column = (rng.permutation(odd) + rng.random(odd)) / odd
    for _ in range(doublings):
        layers = 2 * len(column)
        free = np.ones(layers, dtype=bool)
        free[np.minimum((column * layers).astype(np.int64), layers - 1)] = False
        places = rng.permutation(np.flatnonzero(free))
        more = (places + rng.random(len(places))) / layers
        column = np.concatenate([column, more])
    return np.asarray(column)


class SobolSamples:
    """A scrambled Sobol sequence that is entered anywhere.

    Parameters
    ----------
    seed, dimensions : int
    """

    def __init__(self, seed: int, dimensions: int) -> None:
        from scipy.stats import qmc

        sobol: Any = qmc.Sobol
        self._new = partial(sobol, dimensions, scramble=True, rng=seed)
        self._engine = self._new()
        self._shift = np.array(getattr(self._engine, "_quasi", 0))
        self._is_known = self._knows_engine()

    def rows(self, start: int, stop: int) -> Array:
        """Return points, shape (stop - start, dimensions)."""
        engine = self._entered(start) if self._is_known and start else self._forwarded(start)
        return _drawn(engine, stop - start)

    def _knows_engine(self) -> bool:
        """Tell whether entering scipy's engine gives what going forward through it gives."""
        try:
            found, wanted = (_drawn(e, 2) for e in (self._entered(37), self._forwarded(37)))
        except (AttributeError, TypeError, ValueError, IndexError):
            return False
        return bool(np.array_equal(found, wanted))

    def _forwarded(self, start: int) -> Any:
        engine = self._new()
        return engine.fast_forward(start) if start else engine

    def _entered(self, start: int) -> Any:
        """Return scipy's engine as it is after so many points: its state is the last of them."""
        engine, state, last = self._engine, self._shift.copy(), start - 1
        gray = last ^ last >> 1
        for bit in range(gray.bit_length()):
            if gray >> bit & 1:
                state ^= engine._sv[:, bit]
        engine._quasi, engine.num_generated = state, start
        return engine


def _drawn(engine: Any, number: int) -> Array:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a number of points that is no power of two
        return np.asarray(engine.random(number))
