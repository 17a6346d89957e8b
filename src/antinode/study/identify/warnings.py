"""What a fit warns of."""

from __future__ import annotations

import math

from .estimates import Estimates
from .file import IdentificationProblem
from .fit import Search
from .result import Comparison

_POOR_MAC = 0.6


def fit_warnings(
    problem: IdentificationProblem,
    found: Search,
    estimates: Estimates,
    comparisons: tuple[Comparison, ...],
) -> list[str]:
    """Return what a user should know of a fit, a sentence each."""
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
