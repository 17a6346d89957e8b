"""Numbers in a tree of models, lists and columns, found by dotted paths: ``fins.0.thickness``."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, get_args

import numpy as np
from pydantic import BaseModel

from antinode.errors import InputError
from antinode.text import nearest, short

from .columns import Column
from .units import Unit

Keys = tuple[str | int, ...]


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


def path_names(path: str) -> list[str]:
    """Return the keys of a path as it is written; ``fins[0]`` is ``fins.0``."""
    return [part.strip() for part in path.replace("[", ".").replace("]", "").split(".")]


def place_below(root: BaseModel, names: list[str], path: str) -> tuple[Any, Place]:
    """Follow names from a model to what is there, with its unit and range.

    Parameters
    ----------
    root : BaseModel
    names : list of str
    path : str
        As it was written, for messages.

    Raises
    ------
    InputError
        If they lead nowhere.
    """
    here: Any = root
    annotation: Any = type(root)
    metadata: list[Any] = []
    walked: list[str | int] = []
    for name in names:
        here, key, annotation, metadata = _step(here, name, annotation, metadata, path)
        walked += key
    marks = [*metadata, *_marks(annotation)]
    unit = next((m.symbol if isinstance(m, Unit) else m.unit for m in marks if _has_unit(m)), "")
    return here, Place(tuple(walked), unit, *_limits(marks))


def wrong_key(path: str) -> str:
    """Return how a message about a path begins."""
    return f"parameters: key = {short(path)}"


def check_is_number(here: object, path: str, example: str) -> None:
    """Raise InputError where a path leads to no number."""
    if isinstance(here, bool) or not isinstance(here, int | float):
        raise InputError(f"{wrong_key(path)} leads to {_kind(here)}; {example}")


def _step(
    here: Any, name: str, annotation: Any, metadata: list[Any], path: str
) -> tuple[Any, list[str | int], Any, list[Any]]:
    """Follow one key; return what is there, the key, its annotation and the marks on it."""
    if isinstance(here, BaseModel):
        return _step_into_model(here, name, path)
    if isinstance(here, tuple | np.ndarray):
        index = int(name) if name.isascii() and name.isdigit() and len(name) < 9 else -1
        if not 0 <= index < len(here):
            wrong = f"{wrong_key(path)} leads to a list of {len(here)}, without {short(name)}"
            allowed = f"give an index from 0 to {len(here) - 1}" if len(here) else "write one first"
            raise InputError(f"{wrong}; {allowed}")
        return here[index], [index], annotation, metadata
    if isinstance(here, dict):
        if name not in here:
            raise InputError(f"{wrong_key(path)} leads nowhere; {nearest(name, list(here))}")
        return here[name], [name], annotation, metadata
    if here is None:
        raise InputError(f"{wrong_key(path)}: there is nothing yet; write that table first")
    raise InputError(f"{wrong_key(path)} leads on from a value, {short(here)}; shorten it")


def _step_into_model(
    model: BaseModel, name: str, path: str
) -> tuple[Any, list[str | int], Any, list[Any]]:
    fields = type(model).model_fields
    column, _, state = name.partition(":")
    if column == "mass_per_length" and isinstance(getattr(model, column, None), dict):
        states = getattr(model, column)
        state = state or next(iter(states))
        if state not in states:
            raise InputError(f"{wrong_key(path)} leads nowhere; {nearest(state, list(states))}")
        return states[state], [column, state], fields[column].annotation, fields[column].metadata
    if name not in fields:
        say = nearest(name, sorted(fields))
        raise InputError(f"{wrong_key(path)} leads nowhere; {say}")
    return getattr(model, name), [name], fields[name].annotation, list(fields[name].metadata)


def _kind(here: object) -> str:
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
