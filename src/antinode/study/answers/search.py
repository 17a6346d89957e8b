"""The worst case inside the bounds of the inputs: looked for from the worst cases of the design.

A population of cases evolves (differential evolution, all of a generation solved together), the
best of them is polished (Nelder and Mead). What is found is the worst that was seen: no proof that
there is none worse.

Source: R. Storn, K. Price, Journal of Global Optimization 11 (1997) 341-359, as scipy has it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.errors import ComputationError, InputError
from antinode.study.cases.chunks import solve_values
from antinode.study.design.file import MODE_OUTPUTS, Study
from antinode.study.design.points import Points, points_of
from antinode.study.design.variables import Variable

from .answers import Answers

if TYPE_CHECKING:
    import xarray

_TAIL = 0.00135  # share beyond three deviations, where a normal input is cut
_GENERATION = 32  # cases, at the least
_GENERATIONS = 40
_POLISH = 150  # cases
_EDGE = 1e-3  # of a range, within which an input is at its bound


class Found(NamedTuple):
    """The worst case that was found.

    Attributes
    ----------
    of, unit : str
    largest : bool
    value, design : float
        What was found, and the worst of the design it started from.
    inputs : dict
        In SI, by name.
    at_bounds : tuple of str
        Inputs that are at an end of their range.
    evaluations : int
        Cases that were solved.
    units : dict
        Units of the inputs, by name.
    """

    of: str
    unit: str
    largest: bool
    value: float
    design: float
    inputs: dict[str, float]
    at_bounds: tuple[str, ...]
    evaluations: int
    units: dict[str, str]


def search(
    study: Study,
    dataset: xarray.Dataset,
    text: str,
    *,
    largest: bool = False,
    define: Mapping[str, str] | None = None,
) -> Found:
    """Look for the case inside the bounds in which a number is smallest, or largest.

    Parameters
    ----------
    study : Study
        Its inputs and their ranges; a normal input is cut at three deviations.
    dataset : xarray.Dataset
        The design's cases, to start from.
    text : str
        A formula over inputs and outputs.
    largest : bool
    define : mapping, optional
        Formulas by names of their own.

    Raises
    ------
    InputError
        If the formula cannot be read, or nothing varies.
    ComputationError
        If no case of the design has the number.
    """
    answers, points = Answers(dataset, define=define), points_of(study)
    asked = _Asked(points, answers, text, -1.0 if largest else 1.0)
    start = answers.worst(text, max(_GENERATION, 4 * len(points.variables)), largest=largest)
    if not start.values:
        raise ComputationError(f"no case of the design has {text}; nothing to start from")
    best, least = _evolved(asked, start.inputs, study.design.seed)
    edge = [v.name for v, u in zip(points.variables, best, strict=True) if min(u, 1 - u) < _EDGE]
    values = asked.values(best[None])[0]
    inputs = {v.name: float(x) for v, x in zip(points.variables, values, strict=True)}
    value, design = asked.sign * least, start.values[0]
    last = tuple(edge), asked.evaluations, start.units
    return Found(text, start.unit, largest, value, design, inputs, *last)


def _evolved(asked: _Asked, start: Any, seed: int) -> tuple[Array, float]:
    """Return where a number is smallest, each input from 0 to 1, and that number."""
    import scipy.optimize

    optimize: Any = scipy.optimize
    rng = np.random.default_rng(seed)
    first = asked.population(start, rng)
    bounds = [(0.0, 1.0)] * first.shape[1]
    evolved = optimize.differential_evolution(
        lambda x: asked(x.T),
        bounds,
        init=first,
        maxiter=_GENERATIONS,
        vectorized=True,
        updating="deferred",
        polish=False,
        rng=rng,
        tol=1e-8,
    )
    polished = optimize.minimize(
        lambda x: float(asked(x[None])[0]),
        evolved.x,
        method="Nelder-Mead",
        bounds=bounds,
        options={"maxfev": _POLISH, "xatol": 1e-6, "fatol": 1e-10},
    )
    best = min(polished, evolved, key=lambda found: float(found.fun))
    return np.asarray(best.x), float(best.fun)


class _Asked:
    """A number as a function of the inputs, each from 0 to 1 between its bounds."""

    def __init__(self, points: Points, answers: Answers, text: str, sign: float) -> None:
        self.formula, self.sign, self.evaluations = answers.number(text), sign, 0
        outputs = tuple(n for n in self.formula.names if n not in answers.dataset.coords)
        wanted = outputs or tuple(MODE_OUTPUTS)[:1]
        tracking = points.study.tracking.model_copy(update={"track": False})
        study = points.study.model_copy(update={"outputs": wanted, "tracking": tracking})
        self._points = Points(study, points.variables, points.cases, points.shape)
        self._bounds = np.array([bounds_of(v, points) for v in points.variables])

    def values(self, shares: Array) -> Array:
        """Return the values of the inputs, shape (cases, inputs)."""
        low, high = self._bounds.T
        return np.asarray(low + (high - low) * shares)

    def __call__(self, shares: Array) -> Array:
        """Return what is to be made small, (cases,); infinite where it is not known."""
        values = self.values(np.clip(shares, 0.0, 1.0))
        self.evaluations += len(values)
        columns = solve_values(self._points, values)
        found = np.asarray(self.formula(columns), dtype=float)
        known = self.formula.known(columns) & np.isfinite(found)
        return np.where(known, self.sign * found, np.inf)

    def population(self, inputs: Any, rng: np.random.Generator) -> Array:
        """Return the first generation: the worst cases of the design, and as many anywhere."""
        low, high = self._bounds.T
        span = np.where(high > low, high - low, 1.0)
        values = np.array([list(each.values()) for each in inputs])
        own = np.clip((values - low) / span, 0.0, 1.0)
        return np.concatenate([own, rng.random((max(len(own), 5), len(low)))])


def bounds_of(variable: Variable, points: Points) -> tuple[float, float]:
    """Return the ends of the range of an input in a design [SI].

    Raises
    ------
    InputError
        If it is a time, which is no choice.
    """
    if variable.kind == "time":
        raise InputError("a history has no bounds to search within; take a grid or samples")
    if points.study.design.kind in ("grid", "zip"):
        return float(variable.listed.min()), float(variable.listed.max())
    normal = variable.given.distribution in ("normal", "lognormal")
    ends = variable.quantile(np.array([_TAIL, 1 - _TAIL] if normal else [0.0, 1.0]))
    return float(ends[0]), float(ends[1])
