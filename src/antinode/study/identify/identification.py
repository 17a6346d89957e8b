"""Identification: the values of a case's or a beam's numbers that explain what was observed best.

    result = identify(load_identification("identify.toml"))

Minimised is ``sum ((f - f_observed)/sd)^2`` over all rows and modes, plus priors and smoothness, by
least squares (docs/theory/identification.md).
"""

from __future__ import annotations

import time
from collections.abc import Callable

from antinode.errors import InputError
from antinode.study.eigenvalues import sufficient_refinement

from .estimates import Estimates
from .file import IdentificationProblem
from .fit import search
from .misfit import Evaluation, Misfit
from .observations import RowData, check_start, gather, noise_is_known
from .result import Comparison, Identification
from .unknowns import make_unknowns
from .warnings import fit_warnings


def identify(
    problem: IdentificationProblem, *, progress: Callable[[str], None] | None = None
) -> Identification:
    """Find the parameters of a case, or of a beam, that explain observed frequencies best.

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
    KeyboardInterrupt
        If the fit was interrupted before its first evaluation.
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
        warnings=tuple(fit_warnings(problem, found, estimates, comparisons, at)),
    )


def prepare(problem: IdentificationProblem) -> Misfit:
    """Turn a problem into residuals with derivatives; refuse what cannot be."""
    rows = gather(problem)
    cases = [row.condition(problem.case) for row in rows]
    unknowns = make_unknowns(problem, cases, [row.numbers for row in rows])
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
