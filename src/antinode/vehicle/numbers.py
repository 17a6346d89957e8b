"""The numbers of a case: read and replaced by their keys, and as arrays over many cases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from pydantic import BaseModel

from antinode.arrays import Array
from antinode.inputs.places import Keys as Keys

from .condition import OperatingCondition, Water
from .options import Model
from .vehicle import Vehicle

Node = TypeVar("Node")
Numbers = Mapping[Keys, Array]
"""Arrays by the keys of what varies: numbers (cases,), columns (cases, rows)."""

_FIN_NUMBERS = ("tip_radius", "thickness", "lift_slope", "chord", "position", "deflection")
_COLUMNS = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
)
_BURN = ("condition", "burn_fraction")


def value_at(node: Any, keys: Keys) -> float | None:
    """Return the number that keys lead to; None where the case leaves it out."""
    for key in keys:
        node = getattr(node, str(key)) if isinstance(node, BaseModel) else node[key]
    return None if node is None else float(node)


def replaced(node: Node, keys: Keys, value: Any) -> Node:
    """Return a copy of a tree of models, lists and columns with one value replaced, unchecked."""
    if not keys:
        return value  # type: ignore[no-any-return]
    key, rest = keys[0], keys[1:]
    if isinstance(node, BaseModel):
        inner = replaced(getattr(node, str(key)), rest, value)
        return _copied(node, str(key), inner)  # type: ignore[no-any-return]
    if isinstance(node, dict):
        return {**node, key: replaced(node[key], rest, value)}  # type: ignore[return-value]
    if isinstance(node, np.ndarray):
        column = node.copy()
        column[key] = value
        return column
    if isinstance(node, tuple):
        index = int(key)
        inner = replaced(node[index], rest, value)
        return (*node[:index], inner, *node[index + 1 :])  # type: ignore[return-value]
    raise TypeError(f"{key} leads on from a value")


def _copied(model: Any, key: str, value: Any) -> Any:
    """Return a model with one field replaced, and without what it had worked out and kept."""
    fields = {**model.__dict__, key: value}
    kept = {name: v for name, v in fields.items() if name in type(model).model_fields}
    return type(model).model_construct(**kept)


def is_vectorised(keys: Keys) -> bool:
    """Tell whether a number or a column of the case may vary among `ManyCases`."""
    if keys[0] in ("condition", "water", "time"):
        return True
    if keys[:2] == ("vehicle", "stations"):
        return keys[2] in _COLUMNS
    if keys[:2] == ("vehicle", "fins"):
        return len(keys) == 4 and keys[3] in _FIN_NUMBERS
    return keys == ("vehicle", "cavitator", "diameter")


@dataclass(frozen=True)
class ManyCases:
    """Cases of one vehicle that differ in some numbers; by default the one case itself.

    Attributes
    ----------
    vehicle, condition, water, model
        What does not vary.
    numbers : mapping
        What varies, by keys for which `is_vectorised` holds.
    cases : int
        How many there are.
    """

    vehicle: Vehicle
    condition: OperatingCondition
    water: Water
    model: Model
    numbers: Numbers = field(default_factory=dict)
    cases: int = 1

    def number(self, *keys: str | int) -> Array:
        """Return a number that the case has, as an array (cases,)."""
        found = self.given(*keys)
        assert found is not None
        return found

    def given(self, *keys: str | int) -> Array | None:
        """Return a number as an array (cases,), or None where the case leaves it out."""
        if keys in self.numbers:
            return self.numbers[keys]
        value = value_at(getattr(self, str(keys[0])), keys[1:])
        return None if value is None else np.full(self.cases, value)

    @property
    def burn_fraction(self) -> float | Array:
        """The burn fraction, one for all cases where it does not vary."""
        return self.numbers.get(_BURN, self.condition.burn_fraction)

    def optional_column(self, name: str) -> Array | None:
        """Return a column that stations may leave out, None where they do."""
        return None if getattr(self.vehicle.stations, name) is None else self.column(name)

    def column(self, name: str, state: str | None = None) -> Array:
        """Return a column of the stations, (rows,), or (cases, rows) where it varies."""
        keys: Keys = ("vehicle", "stations", name, *([state] if state else []))
        own = getattr(self.vehicle.stations, name)
        return np.asarray(self.numbers.get(keys, own[state] if state else own))
