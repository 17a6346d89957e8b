"""An input of a case or a beam file between two values: written, read, and the beam at each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.file import BeamFile
from antinode.errors import InputError
from antinode.study.cases.values import Cases
from antinode.study.design.file import Quantity, Study, StudyInput
from antinode.study.design.subject import subject_of
from antinode.study.design.variables import Variable, variables_of
from antinode.text import short
from antinode.vehicle.case import Case

Problem = Case | BeamFile


@dataclass(frozen=True)
class Line:
    """An input, from one value to another.

    Attributes
    ----------
    variable : Variable
    low, high : float
        In SI, low < high; factors of a column.
    """

    variable: Variable
    low: float
    high: float

    @property
    def name(self) -> str:
        """As tables and figures call it."""
        return self.variable.name

    @property
    def unit(self) -> str:
        """SI unit of the values: "1" for a factor."""
        return self.variable.unit

    def to_dict(self) -> dict[str, str]:
        """Return what it is as JSON has it."""
        return {"input": self.variable.key, "name": self.name, "unit": self.unit}

    def __str__(self) -> str:
        return self.name if self.unit == "1" else f"{self.name} [{self.unit}]"


def parse_line(text: str, option: str) -> tuple[str, str, str]:
    """Return key, lowest and highest value of ``key = low .. high``, as they are written."""
    key, equals, values = text.partition("=")
    low, dots, high = values.partition("..")
    parts = key.strip(), low.strip(), high.strip()
    if not (equals and dots and all(parts)):
        raise InputError(
            f"{option}: received {short(text)}; write an input and its range, e.g. "
            f"{option} 'condition.speed = 60 m/s .. 140 m/s'"
        )
    return parts


def line_of(problem: Problem, key: str, low: Quantity, high: Quantity) -> Line:
    """Return an input of a problem between two values.

    Parameters
    ----------
    problem : Case or BeamFile
    key : str
        As in studies: the path to a number, or a column, which is multiplied by a factor.
    low, high : float or str
        In SI, or with a unit.

    Raises
    ------
    InputError
        If there is no such input, or the range is empty.
    """
    if not isinstance(problem, Case | BeamFile):
        raise InputError(
            f"inputs belong to a case or a beam file; received {type(problem).__name__}: use "
            "load_case or load_beam"
        )
    given = StudyInput(key=key)
    (variable,) = variables_of(subject_of(problem), given)
    if variable.kind == "time":
        raise InputError("inputs: time is no input of a case by itself; name a number or a column")
    ends = variable.number(low, "the lowest value"), variable.number(high, "the highest value")
    if not ends[0] < ends[1]:
        raise InputError(
            f"inputs, {variable.name}: the range from {ends[0]:g} to {ends[1]:g} is empty; make "
            "its end larger than its start"
        )
    return Line(variable, *ends)


def beam_at(problem: Problem, lines: Sequence[Line], values: Sequence[float]) -> Beam:
    """Return the beam of a problem with its inputs at some values.

    Raises
    ------
    InputError
        If a value is outside the range that the problem allows.
    """
    variables = [line.variable for line in lines]
    study = Study(case=problem, inputs=tuple(v.given for v in variables))
    cases = Cases(study, variables, np.array([values], dtype=float))
    if cases.outside()[0] or not all(map(math.isfinite, values)):
        told = ", ".join(f"{line} = {v:g}" for line, v in zip(lines, values, strict=True))
        raise InputError(f"{told} is outside the range that {study.subject.name} allows")
    return cases.problem(0).beam()
