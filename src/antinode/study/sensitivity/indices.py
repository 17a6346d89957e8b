"""Sobol indices from samples in Saltelli's arrangement, with bootstrap intervals.

With f at the samples A, B, and at A with column i taken from B, and the variance V of f,

    first order  S_i = mean(f_B (f_ABi - f_A)) / V      (Saltelli 2010)
    total        T_i = mean((f_A - f_ABi)^2) / (2 V)    (Jansen 1999)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array


@dataclass(frozen=True)
class Indices:
    """First and total indices of one quantity, with 95 % intervals.

    Attributes
    ----------
    first, total : array, shape (inputs,)
    first_band, total_band : array, shape (inputs, 2)
    """

    first: Array
    total: Array
    first_band: Array
    total_band: Array


def sobol_indices(f: Array, inputs: int, resamples: int = 400, seed: int = 0) -> Indices:
    """Estimate the Sobol indices of a quantity.

    Parameters
    ----------
    f : array, shape (number * (inputs + 2),)
        At A, then B, then A with each column of B; samples with a NaN are left out.
    inputs : int
    resamples : int
        Of the bootstrap.
    seed : int
    """
    blocks = f.reshape(inputs + 2, -1)
    blocks = blocks[:, np.all(np.isfinite(blocks), axis=0)]
    n = blocks.shape[1]
    nothing = np.full(inputs, np.nan)
    if n < 2 or np.ptp(blocks) <= 1e-12 * np.max(np.abs(blocks)):
        band = np.full((inputs, 2), np.nan)
        return Indices(nothing, nothing, band, band)
    first, total = _estimate(blocks[None])
    rng = np.random.default_rng(seed)
    many = [_estimate(blocks[:, rng.integers(0, n, n)][None]) for _ in range(resamples)]
    bands = [
        np.quantile(np.concatenate([m[k] for m in many]), [0.025, 0.975], axis=0).T for k in (0, 1)
    ]
    return Indices(first[0], total[0], *bands)


def _estimate(blocks: Array) -> tuple[Array, Array]:
    """Return first and total indices, shape (sets, inputs), of blocks (sets, inputs + 2, n)."""
    A, B, AB = blocks[:, :1], blocks[:, 1:2], blocks[:, 2:]
    both = np.concatenate([A, B], axis=2)
    mean = both.mean(axis=2, keepdims=True)
    variance = both.var(axis=2)
    first = np.mean((B - mean) * (AB - A), axis=2) / variance
    total = np.mean((A - AB) ** 2, axis=2) / (2 * variance)
    return first, total
