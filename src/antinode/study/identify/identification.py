"""Identification: the values of a case's parameters that explain observed frequencies best.

    result = identify(load_identification("identify.toml"))

Minimised is ``sum ((f - f_observed)/sd)^2`` over all rows and modes, plus priors and smoothness, by
least squares with analytic derivatives (docs/theory/identification.md).
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from antinode.beam.families import FamilyName
from antinode.errors import InputError
from antinode.study.eigenvalues import sufficient_refinement
from antinode.vehicle.case import Case

from .estimates import Estimates
from .file import IdentificationProblem
from .fit import Search, Start, search
from .misfit import Evaluation, Misfit
from .observations import RowData, check_start, gather, noise_is_known
from .unknowns import Unknowns, make_unknowns

_POOR_MAC = 0.6


@dataclass(frozen=True)
class Comparison:
    """One observed frequency against the fitted one.

    Attributes
    ----------
    row : int
        From 1.
    label : str
        Of the row.
    family : {"bending", "longitudinal"}
    number : int
        Of the observed mode.
    paired : int
        Number of the computed mode that it belongs to.
    observed_hz, fitted_hz, sd_hz : float
        [Hz].
    mac : float
        Likeness of the shapes; NaN where none was observed.
    """

    row: int
    label: str
    family: FamilyName
    number: int
    paired: int
    observed_hz: float
    fitted_hz: float
    sd_hz: float
    mac: float

    @property
    def relative(self) -> float:
        """Fitted less observed, over observed [-]."""
        return self.fitted_hz / self.observed_hz - 1


@dataclass(frozen=True)
class Estimate:
    """One unknown as found.

    Attributes
    ----------
    name, unit : str
    value, start : float
    sd : float
        Standard deviation of the value; NaN at a bound, infinite where nothing determines it.
    interval : tuple of float
        95 %.
    determined : float
        Share of the prior's variance that the data removed; 1 without a prior.
    at_bound : bool
    """

    name: str
    unit: str
    value: float
    start: float
    sd: float
    interval: tuple[float, float]
    determined: float
    at_bound: bool


@dataclass(frozen=True)
class Identification:
    """What was identified; immutable.

    Attributes
    ----------
    problem : IdentificationProblem
    case : Case
        With the values found, in the condition of the case file.
    estimates : Estimates
        Covariance and what follows from it.
    comparisons : tuple of Comparison
    starts : tuple of Start
    cost : float
        Half the sum of squares at the end.
    interrupted : bool
        Whether it was stopped early: the values are the best so far.
    evaluations : int
    seconds : float
    warnings : tuple of str
    """

    problem: IdentificationProblem
    case: Case
    estimates: Estimates = field(repr=False)
    comparisons: tuple[Comparison, ...] = field(repr=False)
    starts: tuple[Start, ...]
    cost: float
    interrupted: bool
    evaluations: int
    seconds: float
    warnings: tuple[str, ...]

    @property
    def unknowns(self) -> Unknowns:
        """What could change."""
        return self.estimates.unknowns

    @cached_property
    def parameters(self) -> tuple[Estimate, ...]:
        """Every unknown as found, in the order of the file."""
        e = self.estimates
        values, slopes = self.unknowns.values(e.vector), self.unknowns.slopes(e.vector)
        return tuple(
            Estimate(
                name=item.label,
                unit=item.unit,
                value=float(values[k]),
                start=item.start,
                sd=float(e.deviation[k] * slopes[k]),
                interval=e.interval(k),
                determined=float(e.determined[k]),
                at_bound=bool(e.at_bound[k]),
            )
            for k, item in enumerate(self.unknowns.items)
        )

    @cached_property
    def worst_relative(self) -> float:
        """Largest relative difference of a frequency [-]."""
        return max(abs(c.relative) for c in self.comparisons)

    @cached_property
    def rms_relative(self) -> float:
        """Root mean square of the relative differences [-]."""
        return math.sqrt(float(np.mean([c.relative**2 for c in self.comparisons])))

    def parameter(self, name: str) -> Estimate:
        """Return an unknown by its name."""
        for item in self.parameters:
            if item.name == name:
                return item
        have = ", ".join(item.name for item in self.parameters[:20])
        raise InputError(f"there is no parameter '{name[:60]}' in this result; it has {have}")

    def row_case(self, row: int) -> Case:
        """Return the fitted case in the condition of a row (from 1), its own values included."""
        rows = gather(self.problem)
        if not 1 <= row <= len(rows):
            raise InputError(f"there is no row {row}; rows run from 1 to {len(rows)}")
        base = rows[row - 1].condition(self.case)
        return self.unknowns.apply_row(base, self.estimates.vector, row - 1)

    def __str__(self) -> str:
        lines = [
            f"{len(self.comparisons)} frequencies in {len(self.problem.observations)} rows: "
            f"rms difference {self.rms_relative:.2e}, worst {self.worst_relative:.2e}"
        ]
        lines += [f"  {p.name}: {p.value:.6g} {p.unit} +- {p.sd:.2g}" for p in self.parameters]
        return "\n".join([*lines, *(f"  warning: {w}" for w in self.warnings)])

    def to_dict(self) -> dict[str, object]:
        """Return the result as plain numbers for JSON."""
        from .tables import identification_dict

        return identification_dict(self)


def identify(
    problem: IdentificationProblem, *, progress: Callable[[str], None] | None = None
) -> Identification:
    """Find the parameters of a case that explain observed frequencies best.

    Parameters
    ----------
    problem : IdentificationProblem
        As `load_identification` reads it, or made in Python.
    progress : callable, optional
        Is told in a line of text how the fit goes.

    Returns
    -------
    Identification
        After an interruption (KeyboardInterrupt) with the best values so far and
        `interrupted` set.

    Raises
    ------
    InputError
        If the problem contradicts itself, or asks more than the data could tell.
    ComputationError
        If the model cannot be computed at the start.
    """
    began = time.perf_counter()
    misfit = prepare(problem)
    found = search(misfit, problem.fit, progress or (lambda text: None))
    at = misfit.evaluate(found.best)
    estimates = Estimates(
        unknowns=misfit.unknowns,
        vector=found.best,
        jacobian=misfit.jacobian(at),
        prior_jacobian=misfit.unknowns.prior_jacobian(found.best),
        residuals=misfit.residuals(at),
        known_noise=noise_is_known(problem),
    )
    comparisons = tuple(_compare(misfit.rows, at))
    return Identification(
        problem=problem,
        case=misfit.unknowns.apply(problem.case, found.best),
        estimates=estimates,
        comparisons=comparisons,
        starts=found.starts,
        cost=found.best_cost,
        interrupted=found.interrupted,
        evaluations=found.evaluations,
        seconds=time.perf_counter() - began,
        warnings=tuple(_warnings(problem, found, estimates, comparisons)),
    )


def prepare(problem: IdentificationProblem) -> Misfit:
    """Turn a problem into residuals with derivatives; refuse what cannot be."""
    rows = gather(problem)
    cases = [row.condition(problem.case) for row in rows]
    unknowns = make_unknowns(problem, cases, [set(row.settings) for row in rows])
    start = Misfit(unknowns, rows, 1)
    _check_counts(start)
    at_start = start.cases(unknowns.start)
    check_start(rows, at_start)
    tolerance = problem.fit.frequency_tolerance
    # Conditions are alike: the first, the middle and the last one stand for all.
    chosen = {0, len(rows) // 2, len(rows) - 1}
    finest = max(sufficient_refinement(at_start[k], rows[k].wanted, tolerance) for k in chosen)
    return Misfit(unknowns, rows, finest)


def _check_counts(misfit: Misfit) -> None:
    """Refuse more parameters than data, priors and smoothness together could hold."""
    unknowns = misfit.unknowns
    known = len(unknowns.prior_residuals(unknowns.start))
    number, parameters = misfit.number, len(unknowns.items)
    if parameters > number + known:
        say = "give priors (or smoothness), more observations, or fewer parameters"
        raise InputError(
            f"{parameters} parameters, but only {number} frequencies and {known} priors and "
            f"smoothness conditions; {say}"
        )


def _compare(rows: tuple[RowData, ...], at: Evaluation) -> list[Comparison]:
    found = []
    for k, row in enumerate(rows):
        for family, data in row.families.items():
            pairing, fitted = at.pairings[k][family], at.fitted_hz(k, family)
            found += [
                Comparison(k + 1, row.label, family, int(number), int(index) + 1, *map(float, rest))
                for number, index, *rest in zip(
                    data.numbers, pairing.index, data.hz, fitted, data.sd, pairing.mac, strict=True
                )
            ]
    return found


def _warnings(
    problem: IdentificationProblem,
    found: Search,
    estimates: Estimates,
    comparisons: tuple[Comparison, ...],
) -> list[str]:
    warnings = []
    if found.interrupted:
        warnings.append("interrupted: these are the best values so far, not a minimum")
    elif found.starts and min(found.starts, key=lambda s: s.cost).reason.startswith("the largest"):
        warnings.append("the largest number of evaluations was reached; raise fit.max_evaluations")
    items = estimates.unknowns.items
    if held := [item.label for k, item in enumerate(items) if estimates.at_bound[k]]:
        names = ", ".join(held[:6]) + (f" and {len(held) - 6} more" if len(held) > 6 else "")
        warnings.append(f"at a bound, without a standard deviation: {names}; widen the bounds?")
    if problem.fit.loss != "linear":
        warnings.append("standard deviations are those of least squares, not of a robust loss")
    if estimates.known_noise and (ratio := _misfit_ratio(estimates)) > 1.5:
        warnings.append(
            f"the frequencies differ by {ratio:.2g} times their standard deviations (rms): this is "
            "no more than a local minimum (try more fit.starts), or the model or the standard "
            "deviations are wrong; the intervals are too narrow"
        )
    if not estimates.known_noise and estimates.freedoms < 1:
        warnings.append(
            "as many parameters as frequencies: the noise cannot be estimated, the standard "
            "deviations mean nothing; give relative_sd or sd"
        )
    warnings += [
        f"{c.label}: no computed shape is like the observed one of {c.family} {c.number} "
        f"(MAC {c.mac:.2f} with {c.family} {c.paired})"
        for c in comparisons
        if c.mac < _POOR_MAC
    ]
    if any(c.fitted_hz < 0 for c in comparisons):
        warnings.append("a mode that was observed diverges in the fitted case")
    return warnings


def _misfit_ratio(estimates: Estimates) -> float:
    r = estimates.residuals
    return math.sqrt(float(r @ r) / max(estimates.freedoms, 1.0))
