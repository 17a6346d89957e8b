"""What is doubtful about the loads of many cases: ranges left, closures, fins, the forebody.

Every warning is data - what it says, which quantity, its values, what is allowed, which cases it
concerns - so that a study can count it; the sentence of one case has that case's numbers in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Numbers

from .forces import FinLoads, Hydrodynamics
from .hydrodynamics import cavitator, cavity, fins, planing
from .hydrodynamics.cavity import Cavity
from .hydrodynamics.validity import Range, Validity
from .numbers import ManyCases

_PLACES = 33  # along the forebody, beside its stations


class CheckedRange(NamedTuple):
    """A range of validity with the values of many cases.

    Attributes
    ----------
    range : Range
    value : array (cases,)
    touched : array of bool (cases,)
        Which cases use the correlation at all.
    """

    range: Range
    value: Array
    touched: Numbers


@dataclass(frozen=True)
class LoadWarning:
    """A warning and the cases that it concerns.

    Attributes
    ----------
    message : str
        What is doubtful, what is allowed and what to do, without the numbers of a case.
    quantity : str
        What is compared, with its unit.
    value : array (cases,)
        Its values; a bound, which is inside, where the true one is not worked out.
    low, high : float or array (cases,)
        What is allowed.
    concerns : array of bool (cases,)
        The cases that are outside.
    sentence : callable
        The message with the numbers of a case, by its row.
    """

    message: str
    quantity: str
    value: Array
    low: Any
    high: Any
    concerns: npt.NDArray[np.bool_]
    sentence: Callable[[int], str]


def checked_ranges(
    cases: ManyCases, found: Hydrodynamics, counted: npt.NDArray[np.bool_]
) -> tuple[CheckedRange, ...]:
    """Return every range that cases touch, with their values; only some cases are counted."""
    return tuple(
        CheckedRange(known, value, counted & touched)
        for known, value, touched in _ranges(cases, found)
    )


def _ranges(cases: ManyCases, found: Hydrodynamics) -> Iterator[tuple[Range, Array, Any]]:
    hole, tail, model = found.cavity, found.planing, cases.model
    yield cavitator.DRAG_RANGE, hole.sigma, True
    yield cavitator.ANGLE_RANGE, np.abs(hole.alpha), True
    yield cavity.SIZE_RANGE, hole.sigma, True
    if model.gravity_rise != "none":
        yield cavity.RISE_RANGE, hole.Fr_L, True
    if model.distortion != "none":
        yield cavity.DISTORTION_RANGE, np.abs(hole.alpha), True
    if found.fins:
        yield fins.DRAG_RANGE, hole.sigma, True
        if model.fin_lift != "none":
            incidence = np.concatenate([fin.incidence for fin in found.fins])
            yield fins.LIFT_RANGE, np.abs(incidence).max(axis=0), True
    if model.planing != "none":
        yield planing.FRICTION_RANGE, tail.Re_w, tail.area > 0
        yield planing.CLEARANCE_RANGE, tail.R_prime, tail.h > 0
        yield planing.SLOPE_RANGE, tail.alpha_p, tail.h > 0


def validity_of(ranges: tuple[CheckedRange, ...], case: int) -> tuple[Validity, ...]:
    """Return the ranges that one case touches, with its values and the verdicts."""
    return tuple(r.range.check(float(r.value[case])) for r in ranges if r.touched[case])


def load_warnings(
    cases: ManyCases, found: Hydrodynamics, counted: npt.NDArray[np.bool_]
) -> tuple[LoadWarning, ...]:
    """Return all warnings that these cases can have; they concern those that are counted.

    Their messages follow from the vehicle and the model, not from the numbers of the cases.
    """
    every = (
        *map(_outside, checked_ranges(cases, found, counted)),
        _closure(cases, found),
        *(_dry_fins(cases, fin, k) for k, fin in enumerate(found.fins, 1)),
        _forebody(cases, found),
    )
    return tuple(replace(warning, concerns=warning.concerns & counted) for warning in every)


def _outside(checked: CheckedRange) -> LoadWarning:
    known, value, touched = checked
    return LoadWarning(
        known.message,
        known.quantity,
        value,
        known.low,
        known.high,
        touched & ~known.is_inside(value),
        lambda k: known.warning(float(value[k])),
    )


def _closure(cases: ManyCases, found: Hydrodynamics) -> LoadWarning:
    """Warn of a cavity that closes on the body."""
    L_c, length = found.cavity.L_c, cases.vehicle.length
    rest = (
        "and the body behind it is taken as wetted all round: lower sigma, or take a larger "
        "cavitator, if a full cavity was meant."
    )
    return LoadWarning(
        f"The cavity closes ahead of the tail, {rest}",
        "length of the cavity [m]",
        L_c,
        length,
        math.inf,
        L_c < length,
        lambda k: (
            f"The cavity closes at x = {L_c[k]:.4g} m, ahead of the tail at {length:.4g} m, {rest}"
        ),
    )


def _dry_fins(cases: ManyCases, fin: FinLoads, number: int) -> LoadWarning:
    """Warn of a set of fins inside the cavity."""
    wet = fin.immersion.max(axis=0)
    rest = (
        "is inside the cavity altogether and gives no force: move it aft, or make its tip_radius "
        "larger."
    )
    return LoadWarning(
        f"Fin set {number} {rest}",
        "length of the fins outside the cavity [m]",
        wet,
        0.0,
        math.inf,
        wet == 0,
        lambda k: f"Fin set {number} at x = {fin.position[k]:.4g} m {rest}",
    )


def _forebody(cases: ManyCases, found: Hydrodynamics) -> LoadWarning:
    """Warn of a nose outside the cavity, but for the rim of the disk (its radius in length)."""
    hole = found.cavity
    start, end = hole.D_n / 2, np.minimum(hole.L_c / 2, cases.vehicle.length)
    most, where = _clearance(cases, hole, start, end), start.copy()
    near = np.flatnonzero(~(most < 0) & (start < end))
    if len(near):
        most[near], where[near] = _height_out(cases, hole.take(near), start[near], end[near])
    rest = "where no force is counted: make the nose slimmer, or the cavity larger."
    return LoadWarning(
        f"The forebody stands out of the cavity, {rest}",
        "height of the forebody outside the cavity [m]",
        most,
        -math.inf,
        0.0,
        (most > 0) & (start < end),
        lambda k: (
            f"The forebody stands {most[k]:.3g} m out of the cavity at x = {where[k]:.4g} m, {rest}"
        ),
    )


def _clearance(cases: ManyCases, hole: Cavity, start: Array, end: Array) -> Array:
    """Return a bound on how far the body stands out of the cavity between places [m]."""
    body = cases.vehicle.radius_profile
    low, high = (np.clip(x[:, None], start, end) for x in (body.x[:-1], body.x[1:]))
    slope = (np.diff(body.ends, axis=1)[:, 0] / np.diff(body.x))[:, None]
    R = [body.ends[:, :1] + slope * (x - body.x[:-1, None]) for x in (low, high)]
    bound = np.where(low < high, hole.course.protrusion_bound(low, high, *R), -np.inf)
    return np.asarray(np.max(bound, axis=0))


def _height_out(cases: ManyCases, hole: Cavity, start: Array, end: Array) -> tuple[Array, Array]:
    """Return how far the body stands out of the cavity at most between places, and where [m]."""
    body = cases.vehicle.radius_profile
    even = start + (end - start) * np.linspace(0, 1, _PLACES)[:, None]
    bounds = np.clip(np.repeat(body.x, 2)[1:-1, None], start, end)
    at_bounds = np.where(
        bounds == np.repeat(body.x, 2)[1:-1, None], body.ends.reshape(-1, 1), body.at(bounds)
    )
    x = np.concatenate([even, bounds])
    R = np.concatenate([body.at(even), at_bounds])
    out = np.abs(hole.axis_offset(x)) + R - hole.radius(x)
    worst, column = np.argmax(out, axis=0), np.arange(len(start))
    return out[worst, column], x[worst, column]
