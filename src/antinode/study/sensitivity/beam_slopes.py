"""Derivatives by the inputs of a study, by differences: frequencies, responses.

The frequencies are solved to a relative 1e-10. Every input of a beam file has one so: places,
compliances, shares of end forces, dimensions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from antinode.arrays import Array
from antinode.study.cases.chunks import mode_names, solve_values
from antinode.study.design.points import Points
from antinode.study.design.variables import Variable
from antinode.study.differences import rule

_TOLERANCE = 1e-10
_RESPONSE_TOLERANCE = 1e-8


def beam_slopes(points: Points) -> dict[str, tuple[float, Array]]:
    """Return frequency [Hz] and its derivatives by the inputs, at the beam itself, of every mode.

    NaN by an input that has no value there, or about which some neighbour cannot be solved.
    """
    names = mode_names(points.study)
    hz, slopes = _slopes(points, _frequencies)
    return {name: (float(hz[k]), slopes[k]) for k, name in enumerate(names)}


def response_slopes(points: Points) -> dict[str, tuple[float, Array]]:
    """Return what the response comes to at the case itself, and its derivatives, by name."""
    values, slopes = _slopes(points, _responses)
    return {one.name: (float(values[k]), slopes[k]) for k, one in enumerate(points.study.asked)}


def _slopes(points: Points, numbers: Callable[[Points, Array], Array]) -> tuple[Array, Array]:
    """Return numbers at the case itself (numbers,), and derivatives (numbers, inputs)."""
    variables = points.variables
    start = np.array([np.nan if v.start is None else v.start for v in variables])
    known = np.isfinite(start)
    centre = np.where(known, start, 0.0)
    rules = [_rule(v, s) for v, s in zip(variables, centre, strict=True)]
    alone = np.eye(len(centre))
    moved = [centre + np.outer(p, row) for (p, _), row in zip(rules, alone, strict=True)]
    hz = numbers(points, np.concatenate([centre[None], *moved]))
    around = hz[1:].reshape(len(variables), -1, hz.shape[1])
    with np.errstate(all="ignore"):
        slopes = np.stack(
            [w[:-1] @ own + w[-1] * hz[0] for (_, w), own in zip(rules, around, strict=True)], 1
        )
    slopes[:, ~known] = np.nan
    return hz[0], slopes


def _rule(variable: Variable, start: float) -> tuple[Array, Array]:
    """Return how far from its value an input is moved, and weights; 0 has the size of its unit."""
    place, size = variable.place, abs(start) or 1.0
    if place is None or variable.given.factor:
        return rule(size, size, np.inf)
    return rule(size, start - place.low, place.high - start)


def _frequencies(points: Points, values: Array) -> Array:
    """Return the frequencies [Hz] of cases by the values of their inputs, (cases, modes)."""
    study = points.study
    settings = {
        "outputs": ("frequency_hz",),
        "solve": study.solve.model_copy(update={"tolerance": _TOLERANCE}),
        "tracking": study.tracking.model_copy(update={"track": False}),
    }
    fine = study.model_copy(update=settings)
    own = Points(fine, points.variables, points.cases, points.shape)
    return np.asarray(solve_values(own, values)["frequency_hz"])


def _responses(points: Points, values: Array) -> Array:
    """Return what the response comes to in cases by the values of their inputs."""
    study = points.study
    assert study.response is not None
    table = study.response.response.model_copy(update={"tolerance": _RESPONSE_TOLERANCE})
    settings = {
        "outputs": ("frequency_hz",),
        "response": study.response.model_copy(update={"response": table}),
        "tracking": study.tracking.model_copy(update={"track": False}),
    }
    fine = study.model_copy(update=settings)
    found = solve_values(Points(fine, points.variables, points.cases, points.shape), values)
    return np.stack([found[one.name] for one in study.asked], axis=1)
