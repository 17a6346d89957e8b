"""Cases of a beam file: each beam built from its numbers, solved in batches where it allows.

Bending frequencies of a beam with something attached are found by themselves, in some tenths of a
millisecond; where shear, curved tables or following ends come to that, all of its modes are.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.file import BeamFile
from antinode.beam.limits import check_limits
from antinode.errors import AntinodeError
from antinode.vehicle.refusals import OUT_OF_RANGE

from .batches import fits_a_batch, solve_batches
from .beam_warnings import beam_messages, beam_warned
from .bending import effect_of_shear
from .reasons import FLUTTERS, GROWS, NO_BEAM, NOT_FOUND, NOT_PROVEN, PAST_BUCKLING, failed
from .single import Motion, Solved, model_error, shapes_of, solve_alone
from .values import Cases

_OF_SOLVED = ("omega2", "model_error", "effect_of_shear")
_FEW = 8  # beams that are no batch


@dataclass(frozen=True)
class BeamAnswers:
    """What is found of some cases of a beam file; NaN where they failed.

    Attributes
    ----------
    of_modes : dict
        Outputs that have one number a mode, (cases, modes), all families side by side; the effect
        of shear where it is asked for.
    reason, warned : array of int, shape (cases,)
    shapes : array, shape (cases, modes, points)
        At even points along the beam, of unit norm.
    mass : array, shape (cases,)
        [kg].
    proven : array, shape (cases,)
        1 where all modes are proven to be found, 0 where not.
    """

    of_modes: dict[str, Array]
    reason: Integers
    warned: Integers
    shapes: Array
    mass: Array
    proven: Array


def solve_structures(cases: Cases, points: int) -> BeamAnswers:
    """Return the answers of some cases of a beam file, with shapes at so many points."""
    file = cases.study.case
    assert isinstance(file, BeamFile)
    beams, reason = _built(cases)
    texts = beam_messages(file)
    return answers_of(
        cases, beams, reason, points, lambda i, own: beam_warned(file, texts, beams[i], own)
    )


def answers_of(
    cases: Cases,
    beams: Mapping[int, Beam],
    reason: Integers,
    points: int,
    bits: Callable[[int, Sequence[Solved]], int],
) -> BeamAnswers:
    """Return the answers of beams by their cases.

    Parameters
    ----------
    cases : Cases
    beams : mapping
        Of the cases that have one.
    reason : array of int, shape (cases,)
        Why others have none; filled in.
    points : int
        At which shapes are kept.
    bits : callable
        Tells of what a case warns, by all of its families.
    """
    study = cases.study
    families, modes = study.solve.families, study.solve.modes
    x = study.subject.points(points) if points else None
    each = [_with_shear(cases, beams, f, x) for f in families]
    shape = len(cases), modes * len(families)
    of_modes = {name: np.full(shape, np.nan) for name in (*_OF_SOLVED, *Motion._fields)}
    out = np.full((*shape, points), np.nan)
    warned, mass = np.zeros(len(cases), dtype=np.int64), np.full(len(cases), np.nan)
    proven = np.full(len(cases), np.nan)
    for i, beam in beams.items():
        mass[i] = beam.mass
        own = [found[i] for found in each if i in found]
        if len(own) < len(families):
            reason[i] = NOT_FOUND
            continue
        own = [_with_model_error(beam, solved) for solved in own]
        proven[i] = all(solved.proven for solved in own)
        reason[i] = _reason(own)
        if failed(reason[i]):
            continue
        motions = [s.motion or Motion.steady(s.omega2, s.error) for s in own]
        for name, values in of_modes.items():
            source: Sequence[Solved | Motion] = own if name in _OF_SOLVED else motions
            values[i] = np.concatenate([getattr(each, name) for each in source])
        warned[i] = bits(i, own)
        if x is not None:
            out[i] = np.concatenate(
                [
                    shapes_of(beam, s.family, s.omega2, x) if s.shapes is None else s.shapes
                    for s in own
                ]
            )
    return BeamAnswers(of_modes, reason, warned, out, mass, proven)


def _built(cases: Cases) -> tuple[dict[int, Beam], Integers]:
    """Return the beams by their cases, and why others have none."""
    reason = np.where(cases.outside(), OUT_OF_RANGE, 0)
    beams: dict[int, Beam] = {}
    for i in np.flatnonzero(reason == 0).tolist():
        try:
            with np.errstate(all="ignore"):
                beam = cases.problem(i).beam()
                check_limits(beam)
        except (AntinodeError, ArithmeticError, ValueError):
            reason[i] = NO_BEAM
            continue
        beams[i] = beam
    return beams, reason


def _with_shear(
    cases: Cases, beams: Mapping[int, Beam], family: FamilyName, x: Array | None
) -> dict[int, Solved]:
    """Return one family of all beams, with what shear does to it, if that is asked for."""
    solve = cases.study.solve
    found = solve_beams(beams, family, solve.modes, solve.tolerance, x)
    sheared = {
        i: replace(beams[i], theory="euler_bernoulli")
        for i, solved in found.items()
        if solved.effect_of_shear is None and beams[i].is_timoshenko and FAMILIES[family].rotary
    }
    if "effect_of_shear" not in cases.study.outputs:
        sheared = {}
    rigid = solve_beams(sheared, family, solve.modes, solve.tolerance)
    none = np.full(solve.modes, np.nan)
    for i, solved in found.items():
        if solved.effect_of_shear is None:
            effect = effect_of_shear(solved.omega2, rigid[i].omega2) if i in rigid else none
            found[i] = solved._replace(effect_of_shear=effect)
    return found


def solve_beams(
    beams: Mapping[int, Beam],
    family: FamilyName,
    modes: int,
    tolerance: float,
    x: Array | None = None,
) -> dict[int, Solved]:
    """Return one family of all beams for which it is found, complex shapes at places [m]."""
    together = {i: beam for i, beam in beams.items() if fits_a_batch(beam, family)}
    if len(together) < _FEW:
        together = {}
    found, left = solve_batches(together, family, modes, tolerance)
    answers = {i: Solved(family, *answer) for i, answer in found.items()}
    for i in (*(i for i in beams if i not in together), *left):
        solved = solve_alone(beams[i], family, modes, tolerance, x)
        if solved is not None:
            answers[i] = solved
    return answers


def _with_model_error(beam: Beam, solved: Solved) -> Solved:
    if solved.model_error is not None:
        return solved
    return solved._replace(model_error=model_error(beam, solved.family, solved.omega2))


def _reason(own: Sequence[Solved]) -> int:
    """Return 0, what is special about a case that has an answer, or why it has none."""
    if any(s.is_complex and not s.proven for s in own):
        return NOT_PROVEN
    if any(s.motion and np.any(_flutters(s.motion)) for s in own):
        return FLUTTERS
    if any(s.is_complex and np.any(s.omega2 < 0) for s in own):
        return GROWS
    return PAST_BUCKLING if any(solved.omega2[0] < 0 for solved in own) else 0


def _flutters(motion: Motion) -> Array:
    """Tell which modes grow while they oscillate."""
    return np.asarray((motion.growth_rate_per_s > 0) & (motion.frequency_hz > 0))
