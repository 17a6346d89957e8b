"""`stability_along`: every change of stability along an input; `stability_map`: over another one.

Everything that depends on the input follows it: loads, thrust, mass and stiffness are those of each
case. Dashpots, feedback and loss factors count unless they are left out.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from antinode.arguments import whole
from antinode.beam.beam import Beam
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import AntinodeError, InputError
from antinode.modes.result import not_modelled
from antinode.stability.along import CriticalValue, follow, is_lossy
from antinode.stability.loci import Loci, Mark, rows_of_roots
from antinode.stability.result import CriticalLoad
from antinode.stability.stability import stability
from antinode.study.design.file import Quantity
from antinode.study.design.subject import subject_of

from .inputs import Line, Problem, beam_at, line_of
from .result import Along, StabilityMap

_ON_LINE, _ON_MAP = 33, 17
_DAMPERS = "dashpots and loss factors of the beam (they count along an input, not along the factor)"
Range = tuple[str, Quantity, Quantity]
"""An input and its range: ``("condition.speed", "60 m/s", "140 m/s")``."""


@out_of_range_is_an_error()
def stability_along(
    problem: Problem,
    key: str,
    low: Quantity,
    high: Quantity,
    *,
    points: int | None = None,
    dampers: bool = True,
) -> Along:
    """Find every change of stability along an input, up to the first flutter.

    Parameters
    ----------
    problem : Case or BeamFile
    key : str
        The input as in a study: ``"condition.speed"``, ``"springs.0.translational"``, or a column
        such as ``"bending_stiffness"``, which is multiplied by a factor.
    low, high : float or str
        From where to where: in SI, or with a unit.
    points : int, optional
        Even values at which all modes are solved first, 2 to 2000, 33 by default. Changes that undo
        each other between two of them are not seen.
    dampers : bool
        Whether dashpots and loss factors count.

    Returns
    -------
    Along

    Raises
    ------
    InputError
        If there is no such input, or the range is empty.
    """
    line = line_of(problem, key, low, high)
    found = follow(
        lambda value: beam_at(problem, [line], [value]),
        line.low,
        line.high,
        points=_at_least_two(_ON_LINE if points is None else points),
        dampers=dampers,
    )
    first = beam_at(problem, [line], [line.low])
    return Along(subject_of(problem).name, line, found, _left_out(first, dampers))


def _at_least_two(points: int) -> int:
    number = whole("points", points, 2000)
    if number < 2:
        raise InputError("points is 1; give 2 at the least: both ends of the range")
    return number


@out_of_range_is_an_error()
def stability_map(
    problem: Problem,
    along: Range | None,
    over: Range,
    *,
    rows: int = 11,
    points: int | None = None,
    dampers: bool = True,
    largest: float | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> StabilityMap:
    """Find the critical values of one input over even values of another.

    Parameters
    ----------
    problem : Case or BeamFile
    along : (key, low, high) or None
        The input whose critical values are told, as for `stability_along`; without it the factor on
        all axial forces (`stability`, without dampers).
    over : (key, low, high)
    rows : int
        Values of the second, 2 to 2000.
    points, dampers
        As of `stability_along`, but 17 points by default.
    largest : float, optional
        The largest factor, where `along` is None.
    progress : callable, optional
        Called with rows that are done and all of them.

    Returns
    -------
    StabilityMap
    """
    other = line_of(problem, *over)
    line = None if along is None else line_of(problem, *along)
    if line is not None and line.variable.key == other.variable.key:
        raise InputError(f"the map has {line.name} on both axes; give two inputs")
    values = np.linspace(other.low, other.high, _at_least_two(rows))
    found: list[tuple[CriticalValue | CriticalLoad, ...]] = []
    reasons: list[str] = []
    for k, value in enumerate(values.tolist()):
        try:
            found.append(_row(problem, line, other, value, points, dampers, largest))
            reasons.append("")
        except AntinodeError as error:
            found.append(())
            reasons.append(str(error))
        if progress is not None:
            progress(k + 1, len(values))
    if all(reasons):
        raise InputError(f"no value of {other.name} has an answer; at the first one: {reasons[0]}")
    first = next(value for value, why in zip(values.tolist(), reasons, strict=True) if not why)
    missing = _left_out(beam_at(problem, [other], [first]), dampers and line is not None)
    name = subject_of(problem).name
    return StabilityMap(name, line, other, values, tuple(found), tuple(reasons), missing)


def _left_out(beam: Beam, dampers: bool) -> tuple[str, ...]:
    """Return what is left out; the dampers of a beam first where they do not count."""
    damped = is_lossy(beam)
    own = (_DAMPERS,) if damped and not dampers else ()
    return (*own, *not_modelled(beam, damped and dampers))


def _row(
    problem: Problem,
    line: Line | None,
    other: Line,
    value: float,
    points: int | None,
    dampers: bool,
    largest: float | None,
) -> tuple[CriticalValue | CriticalLoad, ...]:
    if line is None:
        beam = beam_at(problem, [other], [value])
        return stability(beam, largest, dampers=False).critical
    return follow(
        lambda at: beam_at(problem, [line, other], [at, value]),
        line.low,
        line.high,
        points=_at_least_two(_ON_MAP if points is None else points),
        dampers=dampers,
    ).critical


def loci_along(result: Along, modes: int = 4) -> Loci:
    """Return frequency and growth of the lowest modes along an input, for a figure."""
    found = result.found
    frequency, growth = rows_of_roots(found.roots, whole("modes", modes, 30))
    marks = tuple(Mark(c.value, c.kind, c.change, c.modes) for c in found.critical)
    names = tuple(f"{k + 1}" for k in range(frequency.shape[1]))
    return Loci(found.values, frequency, growth, names, marks, str(result.line))
