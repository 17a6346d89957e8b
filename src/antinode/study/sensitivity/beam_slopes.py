"""Derivatives by the inputs of a study, by differences of fourth order: frequencies, responses.

``f' = (8 (f(h) - f(-h)) - (f(2 h) - f(-2 h))) / (12 h)``, at a bound of the input on one side; the
frequencies are solved to a relative 1e-10. Every input of a beam file has one so: places,
compliances, shares of end forces, dimensions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from antinode.arrays import Array
from antinode.study.cases.chunks import mode_names, solve_values
from antinode.study.design.points import Points
from antinode.study.design.variables import Variable

_STEP = 2e-3  # of a value; of an input of 0, of its SI unit
_TOLERANCE = 1e-10
_RESPONSE_TOLERANCE = 1e-8
_CENTRAL = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0, 0.0]) / 12
_FORWARD = np.array([1.0, 2.0, 3.0, 4.0]), np.array([48.0, -36.0, 16.0, -3.0, -25.0]) / 12
"""Places in steps, and weights of the frequencies there and, last, at the beam itself."""


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
    """Return how far from its value an input is moved, and weights: on one side at a bound."""
    place, size = variable.place, abs(start) or 1.0
    if place is None or variable.given.factor:
        below, above = size, np.inf
    else:
        below, above = start - place.low, place.high - start
    (places, weights), room = (
        (_CENTRAL, min(below, above) / 3) if min(below, above) > 0 else (_FORWARD, above / 5)
    )
    if room <= 0 < below:
        (places, weights), room = (-_FORWARD[0], -_FORWARD[1]), below / 5
    step = min(_STEP * size, room)
    return places * step, weights / step


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
