"""What the data say of the unknowns: covariance, intervals, and what they leave open.

With the scaled Jacobian J of the data and P of priors and smoothness at the solution the
covariance is ``s^2 (J^T J + P^T P)^-1``; s is 1 where the standard deviations of the frequencies
are known, else ``s^2 = r^T r / (n - effective number of parameters)``. The singular values of J,
in the unknowns' natural sizes, tell which directions the data determine: along a direction of
singular value d the data alone leave a standard deviation of s/d sizes. Below 1 the size (the
prior's standard deviation where there is one) is narrower than what the data say.

An unknown at a bound is held there and has no standard deviation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array

from .unknowns import Unknowns

Flags = npt.NDArray[np.bool_]
_NEAR_BOUND = 1e-6  # sizes
_OPEN = 1e-9  # of the largest singular value: below, nothing determines a direction
_LEVER = 1e-6  # of a frequency's weight that does not determine parameters, at the least
_PART = 0.35  # of the largest part of a direction, to be named
STRONG = 0.95


@dataclass(frozen=True)
class Direction:
    """A combination of unknowns that the data do not determine.

    Attributes
    ----------
    singular_value : float
        Of the scaled Jacobian.
    entries : tuple of int
        Its main parts, the largest first.
    parts : tuple of float
        Their shares, in sizes; the first one is positive.
    """

    singular_value: float
    entries: tuple[int, ...]
    parts: tuple[float, ...]


@dataclass(frozen=True)
class Estimates:
    """Standard deviations and what follows from them, for the entries of the vector.

    Attributes
    ----------
    unknowns : Unknowns
    vector : array, shape (n,)
    jacobian, prior_jacobian : array
        Of the data, and of priors and smoothness.
    residuals : array
        Of the data.
    known_noise : bool
        Whether residuals are in true standard deviations.
    """

    unknowns: Unknowns
    vector: Array
    jacobian: Array
    prior_jacobian: Array
    residuals: Array
    known_noise: bool

    @cached_property
    def at_bound(self) -> Flags:
        """Whether an entry ends at one of its bounds."""
        low, high = self.unknowns.bounds
        return (self.vector - low < _NEAR_BOUND) | (high - self.vector < _NEAR_BOUND)

    @cached_property
    def _free(self) -> npt.NDArray[np.int64]:
        return np.flatnonzero(~self.at_bound)

    @cached_property
    def _inverse(self) -> tuple[Array, Array]:
        """Return (J^T J + P^T P)^-1 of the free entries, and the part of each that is open."""
        stacked = np.concatenate([self.jacobian, self.prior_jacobian])[:, self._free]
        norm = np.linalg.norm(stacked, axis=0)
        scale = np.where(norm > 0, norm, 1.0)
        _, size, basis = np.linalg.svd(stacked / scale, full_matrices=True)
        size = np.append(size, np.zeros(len(self._free) - len(size)))
        closed = size > _OPEN * max(size.max(initial=0.0), 1e-300)
        kept = basis[closed] / size[closed, None]
        open_part = np.linalg.norm(basis[~closed], axis=0)
        return (kept.T @ kept) / np.outer(scale, scale), open_part

    @cached_property
    def noise(self) -> float:
        """Factor s on the standard deviations of the frequencies."""
        if self.known_noise:
            return 1.0
        return math.sqrt(float(self.residuals @ self.residuals) / max(self.freedoms, 1e-9))

    @cached_property
    def freedoms(self) -> float:
        """Number of frequencies less the effective number of parameters."""
        data = self.jacobian[:, self._free]
        used = float(np.sum((data @ self._inverse[0]) * data))
        return max(len(self.residuals) - used, 0.0)

    def without(self, left_out: Flags) -> float:
        """Return by how much the sum of squares would fall without some frequencies.

        Priors included, to first order; frequencies that alone determine something take nothing
        along but what they add.
        """
        J, r = self.jacobian[left_out][:, self._free], self.residuals[left_out]
        kept = np.eye(len(r)) - J @ self._inverse[0] @ J.T
        size, basis = np.linalg.eigh((kept + kept.T) / 2)
        parts = basis.T @ r
        return float(np.sum(parts**2 / np.maximum(size, _LEVER)))

    @cached_property
    def covariance(self) -> Array:
        """Of the entries, shape (n, n); NaN where at a bound, infinite variance where open."""
        full = np.full((len(self.vector), len(self.vector)), np.nan)
        inverse, open_part = self._inverse
        inside = inverse * self.noise**2
        np.fill_diagonal(inside, np.where(open_part > 1e-4, np.inf, np.diag(inside)))
        full[np.ix_(self._free, self._free)] = inside
        return full

    @cached_property
    def deviation(self) -> Array:
        """Standard deviations of the entries; NaN where at a bound, infinite where open."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    @cached_property
    def correlation(self) -> Array:
        """Correlations of the entries; NaN where there is none."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self.covariance / np.outer(self.deviation, self.deviation))

    @cached_property
    def quantile(self) -> float:
        """How many standard deviations a 95 % interval reaches to either side."""
        from scipy.special import ndtri, stdtrit

        return float(ndtri(0.975) if self.known_noise else stdtrit(max(self.freedoms, 1), 0.975))

    def interval(self, entry: int) -> tuple[float, float]:
        """Return the 95 % interval of a value."""
        item = self.unknowns.items[entry]
        half = self.quantile * float(self.deviation[entry])
        if not math.isfinite(half):
            low = 0.0 if item.log else -math.inf
            return (math.nan, math.nan) if math.isnan(half) else (low, math.inf)
        middle = float(self.vector[entry])
        return item.value(middle - half), item.value(middle + half)

    @cached_property
    def prior_deviation(self) -> Array:
        """Standard deviations of the entries by their own priors alone; infinite without one."""
        found = []
        for item, slope in zip(self.unknowns.items, self.unknowns.slopes(self.vector), strict=True):
            by_log = item.prior_sd / item.size if item.log else math.inf
            found.append(by_log if item.lognormal else item.prior_sd / slope)
        return np.array(found)

    @cached_property
    def determined(self) -> Array:
        """Share of the prior's variance that the data removed, 0 to 1; 1 without a prior."""
        with np.errstate(invalid="ignore"):
            left = np.where(
                np.isfinite(self.deviation), (self.deviation / self.prior_deviation) ** 2, 1.0
            )
        return np.asarray(np.where(self.at_bound, 0.0, np.clip(1 - left, 0, 1)))

    @cached_property
    def _svd(self) -> tuple[Array, Array]:
        """Singular values of the data's Jacobian, all of them, and the directions as rows."""
        _, size, basis = np.linalg.svd(self.jacobian[:, self._free], full_matrices=True)
        return np.append(size, np.zeros(len(basis) - len(size))), basis

    @property
    def singular_values(self) -> Array:
        """Of the Jacobian of the data in the unknowns' natural sizes, descending."""
        return self._svd[0]

    @cached_property
    def undetermined(self) -> tuple[Direction, ...]:
        """Directions along which the data leave more than a natural size, the worst first."""
        size, basis = self._svd
        rows = [k for k in range(len(size)) if size[k] < self.noise]
        return tuple(self._direction(float(size[k]), basis[k]) for k in reversed(rows))

    def _direction(self, size: float, row: Array) -> Direction:
        order = np.argsort(-np.abs(row))
        main = [k for k in order if abs(row[k]) >= _PART * abs(row[order[0]])]
        parts = tuple(float(row[k] * np.sign(row[main[0]])) for k in main)
        return Direction(size, tuple(int(self._free[k]) for k in main), parts)

    @cached_property
    def strong_correlations(self) -> tuple[tuple[int, int, float], ...]:
        """Pairs of entries whose correlation is beyond 0.95 either way, the strongest first."""
        table = np.nan_to_num(np.triu(self.correlation, 1))
        pairs = [
            (int(i), int(j), float(table[i, j])) for i, j in np.argwhere(np.abs(table) > STRONG)
        ]
        return tuple(sorted(pairs, key=lambda p: -abs(p[2])))
