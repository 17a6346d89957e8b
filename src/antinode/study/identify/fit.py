"""Least squares from one or several starts, which can be interrupted."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.errors import ComputationError

from .file import Fit
from .misfit import Evaluation, Misfit, try_evaluate
from .unknowns import Unknown

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult

Progress = Callable[[str], None]
_SPREAD = 2.0  # standard deviations, or sizes, over which further starts are drawn
_SMALLEST_STEP = 1e-6  # natural sizes, nearly
_JAMMED = 3  # status of a fit that ends for want of a step
_ASIDE = 0.5  # standard deviations
_WORTH = 1e-6  # relative fall of the cost that a further try must have brought
_UNKNOWN_SPREAD = 0.2  # ... of the natural size where neither prior nor bounds are given


class Start(NamedTuple):
    """How the fit from one start ended.

    Attributes
    ----------
    number : int
        From 1.
    cost : float
        Half the sum of squares; infinite if the start could not be computed.
    evaluations : int
    reason : str
    """

    number: int
    cost: float
    evaluations: int
    reason: str


@dataclass
class Search:
    """The best vector so far, and how the starts ended."""

    misfit: Misfit
    fit: Fit
    progress: Progress
    best: Array
    best_cost: float = math.inf
    evaluations: int = 0
    interrupted: bool = False
    starts: tuple[Start, ...] = ()
    _last: Evaluation | None = None
    _start: int = 1
    _since: int = 0

    def run(self) -> None:
        """Fit from every start, until done or interrupted."""
        try:
            for number, vector in enumerate(start_vectors(self.misfit, self.fit), 1):
                self._start, self._since = number, 0
                self.starts = (*self.starts, self._from(number, vector))
        except KeyboardInterrupt:
            self.interrupted = True
            self.progress("interrupted: the best values so far are kept")

    def _from(self, number: int, vector: Array) -> Start:
        if number > 1 and not np.all(np.isfinite(self.residuals(vector))):
            return Start(number, math.inf, self._since, "the start cannot be computed")
        found, tries = self._descend(vector), 0
        random = np.random.default_rng([self.fit.seed, number])
        while (
            found.status == _JAMMED
            and tries < self.fit.tries
            and self._since < self.fit.max_evaluations
        ):
            tries += 1
            further = self._descend(self._beside(found, random))
            if further.cost < found.cost * (1 - _WORTH):
                found, tries = further, 0
        best, cost, reason = found.x, float(found.cost), _REASONS[int(found.status)]
        if cost <= self.best_cost * (1 + 1e-12):
            self.best, self.best_cost = best, cost
        return Start(number, cost, self._since, reason)

    def _beside(self, found: OptimizeResult, random: np.random.Generator) -> Array:
        """Return a vector about half a standard deviation off, to leave a kink of the loads."""
        _, size, basis = np.linalg.svd(found.jac, full_matrices=False)
        parts = random.normal(size=len(size)) / np.maximum(size, 1.0)
        low, high = self.misfit.unknowns.bounds
        return np.asarray(np.clip(found.x + _ASIDE * parts @ basis, low, high))

    def _descend(self, vector: Array) -> OptimizeResult:
        """Go down from a vector until nothing changes any more.

        The loads have kinks, where a fin leaves the cavity or planing sets in. There the region
        of trust can shrink to nothing before a minimum is reached.
        """
        from scipy.optimize import least_squares

        tolerance = self.fit.tolerance
        return least_squares(
            self.residuals,
            vector,
            jac=self.jacobian,
            bounds=self.misfit.unknowns.bounds,
            loss=self.fit.loss,
            max_nfev=max(self.fit.max_evaluations - self._since, 1),
            ftol=tolerance,
            xtol=_SMALLEST_STEP,
            gtol=tolerance * 1e-2,
        )

    def residuals(self, vector: Array) -> Array:
        """Return residuals of data, priors and smoothness; NaN where the model has no value."""
        self.evaluations += 1
        self._since += 1
        at = try_evaluate(self.misfit, vector)
        prior = self.misfit.unknowns.prior_residuals(vector)
        if at is None:
            return np.full(self.misfit.number + len(prior), np.nan)
        self._last = at
        data = self.misfit.residuals(at)
        residuals = np.concatenate([data, prior])
        self._note(vector, residuals, data)
        return residuals

    def _note(self, vector: Array, residuals: Array, data: Array) -> None:
        cost = robust_cost(residuals, self.fit.loss)
        if cost < self.best_cost:
            self.best, self.best_cost = vector.copy(), cost
        rms = math.sqrt(float(data @ data) / len(data))
        self.progress(
            f"start {self._start} of {self.fit.starts}, evaluation {self._since}: "
            f"cost {cost:.6g}, rms of the residuals {rms:.3g} standard deviations"
        )

    def jacobian(self, vector: Array) -> Array:
        """Return the derivatives of `residuals`."""
        if self._last is None or not np.array_equal(self._last.vector, vector):
            self._last = self.misfit.evaluate(vector)
        prior = self.misfit.unknowns.prior_jacobian(vector)
        return np.concatenate([self.misfit.jacobian(self._last), prior])


_REASONS = {
    0: "the largest number of evaluations was reached",
    1: "the gradient vanished",
    2: "the cost settled",
    3: "the values settled",
    4: "the cost and the values settled",
}


def robust_cost(residuals: Array, loss: str) -> float:
    """Return half the sum of rho(r^2), as `scipy.optimize.least_squares` has it."""
    z = residuals**2
    if loss == "soft_l1":
        z = 2 * (np.sqrt(1 + z) - 1)
    elif loss == "huber":
        z = np.where(z <= 1, z, 2 * np.sqrt(z) - 1)
    elif loss == "cauchy":
        z = np.log1p(z)
    elif loss == "arctan":
        z = np.arctan(z)
    return float(np.sum(z) / 2)


def start_vectors(misfit: Misfit, fit: Fit) -> Array:
    """Return the given start, then a Latin hypercube inside priors and bounds, (starts, n)."""
    unknowns = misfit.unknowns
    first = unknowns.start
    if fit.starts == 1:
        return first[None, :]
    low, high = np.array([_span(item) for item in unknowns.items]).T
    further = low + (high - low) * _latin_hypercube(fit.starts - 1, len(first), fit.seed)
    return np.concatenate([first[None, :], further])


def _latin_hypercube(number: int, dimensions: int, seed: int) -> Array:
    """Return points in the unit cube, one in each of `number` slices along every axis."""
    random = np.random.default_rng(seed)
    slices = np.stack([random.permutation(number) for _ in range(dimensions)], axis=1)
    return np.asarray((slices + random.random((number, dimensions))) / number)


def _span(item: Unknown) -> tuple[float, float]:
    """Return the range of an entry from which further starts are drawn."""
    low, high = item.coded(item.lower), item.coded(item.upper)
    start = item.coded(item.start)
    if math.isfinite(item.prior_sd):
        start, width = item.coded(item.prior_mean), _SPREAD
    elif math.isfinite(low) and math.isfinite(high):
        return low, high
    else:
        width = _UNKNOWN_SPREAD
    return max(low, start - width), min(high, start + width)


def search(misfit: Misfit, fit: Fit, progress: Progress) -> Search:
    """Find the best vector.

    Raises
    ------
    ComputationError
        If nothing could be computed at all.
    KeyboardInterrupt
        If the fit was interrupted before anything was found.
    """
    found = Search(misfit, fit, progress, misfit.unknowns.start)
    found.run()
    if not math.isfinite(found.best_cost):
        if found.interrupted:
            raise KeyboardInterrupt
        raise ComputationError(
            "the model could not be computed at the start; check the case with 'antinode modes'"
        )
    return found
