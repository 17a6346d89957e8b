"""Numbers of a case by their dotted paths: ``vehicle.fins.0.thickness``.

A path is written as `--set` takes it. The first tables may be left out where nothing else has the
name: ``fins.0.thickness``, ``thrust``.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, get_args

import numpy as np
from pydantic import BaseModel

from antinode.errors import InputError
from antinode.inputs.columns import Column
from antinode.inputs.units import Unit
from antinode.text import nearest, short

from .case import Case
from .condition import OperatingCondition
from .numbers import Keys
from .vehicle import Vehicle

_FIXED = ("solve",)
_LISTED = ("radius_of_gyration", "wall")


class Place(NamedTuple):
    """A number of a case.

    Attributes
    ----------
    keys : tuple
        From the case to the number.
    unit : str
        SI unit; "" for a pure number.
    low, high : float
        Range that is allowed, as far as it is a plain one.
    strict : bool
        Whether the number must stay above `low`.
    """

    keys: Keys
    unit: str
    low: float
    high: float
    strict: bool

    @property
    def text(self) -> str:
        """The path as a file has it."""
        return ".".join(map(str, self.keys))


def find_place(case: Case, path: str) -> Place:
    """Find a number of a case by its path.

    Raises
    ------
    InputError
        If the path leads nowhere, or to something that is no number or cannot change.
    """
    names = [part.strip() for part in path.replace("[", ".").replace("]", "").split(".")]
    keys = _from_the_case(names)
    here: Any = case
    annotation: Any = Case
    metadata: list[Any] = []
    walked: list[str | int] = []
    for name in keys:
        here, key, annotation, metadata = _step(here, name, annotation, metadata, path)
        walked += key
    _check_number(here, walked, path)
    marks = [*metadata, *_marks(annotation)]
    unit = next((m.symbol if isinstance(m, Unit) else m.unit for m in marks if _has_unit(m)), "")
    return Place(tuple(walked), unit, *_limits(marks))


def _from_the_case(names: list[str]) -> list[str]:
    """Put the tables in front that were left out."""
    if names[0] in Case.model_fields:
        return names
    if names[0] in OperatingCondition.model_fields:
        return ["condition", *names]
    if names[0] in Vehicle.model_fields:
        return ["vehicle", *names]
    return names


def _step(
    here: Any, name: str, annotation: Any, metadata: list[Any], path: str
) -> tuple[Any, list[str | int], Any, list[Any]]:
    """Follow one key; return what is there, the key, its annotation and the marks on it."""
    if isinstance(here, BaseModel):
        return _step_into_model(here, name, path)
    if isinstance(here, tuple | np.ndarray):
        index = int(name) if name.isascii() and name.isdigit() and len(name) < 9 else -1
        if not 0 <= index < len(here):
            wrong = f"{_wrong(path)} leads to a list of {len(here)}, without {short(name)}"
            raise InputError(f"{wrong}; give an index from 0 to {len(here) - 1}")
        return here[index], [index], annotation, metadata
    if isinstance(here, dict):
        if name not in here:
            raise InputError(f"{_wrong(path)} leads nowhere; {nearest(name, list(here))}")
        return here[name], [name], annotation, metadata
    raise InputError(f"{_wrong(path)} leads on from a value, {short(here)}; shorten it")


def _step_into_model(
    model: BaseModel, name: str, path: str
) -> tuple[Any, list[str | int], Any, list[Any]]:
    fields = type(model).model_fields
    column, _, state = name.partition(":")
    if column == "mass_per_length" and isinstance(getattr(model, column, None), dict):
        states = getattr(model, column)
        state = state or next(iter(states))
        if state not in states:
            raise InputError(f"{_wrong(path)} leads nowhere; {nearest(state, list(states))}")
        return states[state], [column, state], fields[column].annotation, fields[column].metadata
    if name not in fields:
        say = nearest(name, sorted(fields))
        raise InputError(f"{_wrong(path)} leads nowhere; {say}")
    return getattr(model, name), [name], fields[name].annotation, list(fields[name].metadata)


def _wrong(path: str) -> str:
    return f"parameters: key = {short(path)}"


def _check_number(here: Any, keys: list[str | int], path: str) -> None:
    if here is None and keys[-1] not in _LISTED:
        return
    if isinstance(here, bool) or not isinstance(here, int | float):
        say = "name one number, such as vehicle.cavitator.diameter"
        raise InputError(f"{_wrong(path)} leads to {_kind(here)}; {say}")
    if keys[0] in _FIXED or "x" in keys:
        say = "positions of stations and settings of the solver stay as they are"
        raise InputError(f"{_wrong(path)} cannot be a parameter; {say}")


def _kind(here: Any) -> str:
    if isinstance(here, BaseModel | dict):
        return "a table"
    return "a list" if isinstance(here, tuple | np.ndarray) else f"the choice {short(here)}"


def _marks(annotation: Any) -> list[Any]:
    """Return all marks inside an annotation such as ``Annotated[float, ...] | None``."""
    found = list(getattr(annotation, "__metadata__", ()))
    for argument in get_args(annotation):
        if not isinstance(argument, str):
            found += _marks(argument)
    return [*found, *(m for f in found for m in getattr(f, "metadata", ()))]


def _has_unit(mark: Any) -> bool:
    return isinstance(mark, Unit | Column)


def _limits(marks: list[Any]) -> tuple[float, float, bool]:
    """Return the range that the marks of a field allow, and whether its low end is left out."""
    low = [float(getattr(m, k)) for m in marks for k in ("gt", "ge") if hasattr(m, k)]
    high = [float(getattr(m, k)) for m in marks for k in ("lt", "le") if hasattr(m, k)]
    strict = any(hasattr(m, "gt") for m in marks) or any(isinstance(m, Column) for m in marks)
    if any(isinstance(m, Column) for m in marks):
        low.append(0.0)
    return max(low, default=-math.inf), min(high, default=math.inf), strict


_OF_SIGMA = (
    ("condition", "depth"),
    ("condition", "cavity_pressure"),
    ("water", "vapour_pressure"),
    ("water", "atmospheric_pressure"),
)

_OF_TIMOSHENKO = "shear_stiffness", "rotary_inertia_per_length", "radius_of_gyration", "wall"


def without_effect(case: Case, keys: Keys) -> str:
    """Say why a number of a case changes no load and no frequency; nothing if it may change some.

    Parameters
    ----------
    case : Case
    keys : tuple
        Of the number.
    """
    given, vehicle = case.condition, case.vehicle
    if keys in _OF_SIGMA and given.cavitation_number is not None:
        return (
            "the case gives cavitation_number, which alone makes the cavity; remove it from the "
            "case, or vary it instead"
        )
    own = all(fins.position is not None for fins in vehicle.fins)
    of_drag = given.extra_drag and given.extra_drag_position is None
    if keys == ("condition", "fin_position") and own and not of_drag:
        return "no fin set stands there; vary vehicle.fins.0.position instead"
    if keys == ("condition", "extra_drag_position") and not given.extra_drag:
        return "the case has no extra_drag"
    sheared = keys[:2] == ("vehicle", "stations") and keys[2] in _OF_TIMOSHENKO
    if sheared and case.model.theory == "euler_bernoulli":
        return "the case has [model] theory = 'euler_bernoulli', which leaves it out"
    burns = len(vehicle.stations.mass_per_length) > 1 or any(p.burns for p in vehicle.masses)
    if keys == ("condition", "burn_fraction") and not burns:
        return "the vehicle has one mass state, and no part that burns"
    return ""
