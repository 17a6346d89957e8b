"""What a fit warns of."""

from __future__ import annotations

from antinode.study.cases.water_warnings import DELAYED, ONE_SIDED, is_delayed, is_one_sided
from antinode.study.complex_modes import ComplexModes
from antinode.vehicle.case import Case

from .estimates import Estimates
from .file import IdentificationProblem
from .fit import Search
from .misfit import Evaluation
from .result import Comparison
from .suspects import far_from_priors, quality, spoiling_row
from .unknowns import Unknown
from .words import brief

_POOR_MAC = 0.6
_NAMED = 6


def fit_warnings(
    problem: IdentificationProblem,
    found: Search,
    estimates: Estimates,
    comparisons: tuple[Comparison, ...],
    at: Evaluation,
) -> list[str]:
    """Return what a user should know of a fit, a sentence each."""
    warnings = _water_limits(at)
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
    poor = estimates.known_noise and (fit := quality(estimates)).is_poor
    if poor:
        warnings.append(
            f"the frequencies differ by {brief(fit.rms)} of their standard deviations (rms), where "
            f"{brief(fit.expected)} would be expected: this is no more than a local minimum (try "
            "more fit.starts), or the model, an observation or the standard deviations are wrong; "
            "the intervals are too narrow"
        )
    if poor or not estimates.known_noise:
        warnings += _suspect_row(problem, estimates, comparisons)
    warnings += _far_values(estimates)
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


def _suspect_row(
    problem: IdentificationProblem, estimates: Estimates, comparisons: tuple[Comparison, ...]
) -> list[str]:
    """Name a row that alone spoils the fit; a robust loss has weighed it down already."""
    found = spoiling_row(estimates, comparisons) if problem.fit.loss == "linear" else None
    if found is None:
        return []
    worst, number = found.worst, f"row {found.worst.row}"
    name = number if worst.label == number else f"{number} ({worst.label})"
    return [
        f"{name} alone spoils the fit: without it {found.share:.0%} of the sum of squares would be "
        f"gone; {worst.family} {worst.number} is farthest off ({worst.observed_hz:.6g} Hz "
        f"observed, {worst.fitted_hz:.6g} Hz fitted): check its frequencies and its condition, or "
        "leave it out"
    ]


def _far_values(estimates: Estimates) -> list[str]:
    """Name what ended far from its prior, the farthest first."""
    found = sorted(far_from_priors(estimates), key=lambda each: -abs(each[2]))
    if not found:
        return []
    told = "; ".join(_far_value(*each) for each in found[:_NAMED])
    more = f"; and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    return [
        f"far from their priors: {told}{more}: the data contradict these priors, or the model "
        "makes up for something else by such values"
    ]


def _far_value(item: Unknown, value: float, distance: float) -> str:
    unit = f" {item.unit}" if item.unit else ""
    sd = "sd of the logarithm" if item.lognormal else "sd"
    return (
        f"{item.label} = {value:.5g}{unit}, {abs(distance):.2g} standard deviations off "
        f"({item.prior_mean:.5g}{unit}, {sd} {item.prior_sd:.3g})"
    )


def _water_limits(at: Evaluation) -> list[str]:
    """Return what limits modes on the water's stiffness, with the rows that it concerns."""
    told: dict[str, list[str]] = {DELAYED: [], ONE_SIDED: []}
    for k, one in enumerate(at.solved, 1):
        for modes in one.modes.values():
            if not (isinstance(one.case, Case) and isinstance(modes, ComplexModes)):
                continue
            told[DELAYED] += [str(k)] if is_delayed(one.case, modes.frequencies_hz) else []
            told[ONE_SIDED] += [str(k)] if is_one_sided(one.case) else []
    return [
        f"{text} (row {', '.join(rows[:_NAMED])}{', ...' if rows[_NAMED:] else ''})"
        for text, rows in told.items()
        if rows
    ]
