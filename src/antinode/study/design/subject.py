"""What a study varies something in: the case of a vehicle, or a beam file.

Both are trees of models with a table of stations: what varies is a number in the tree by its keys,
or a column of the stations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeVar, cast

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel

from antinode.arrays import Array, Interpolation
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName, tells
from antinode.beam.file import ALL_COLUMNS, BeamFile, BeamTable
from antinode.errors import InputError
from antinode.inputs.places import (
    Keys,
    Place,
    check_is_number,
    path_names,
    place_below,
    wrong_key,
)
from antinode.text import nearest, short
from antinode.vehicle.case import Case
from antinode.vehicle.columns import column_keys, column_values
from antinode.vehicle.condition import OperatingCondition
from antinode.vehicle.numbers import replaced
from antinode.vehicle.paths import find_place, without_effect
from antinode.vehicle.vehicle import Vehicle

_OF_VEHICLES = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "radius",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
)


Given = Case | BeamFile
"""What a file may name in place of a case."""


class Subject(Protocol):
    """What a study varies something in."""

    @property
    def name(self) -> str:
        """As tables and figures call it."""
        ...

    @property
    def tree(self) -> BaseModel:
        """The model that keys start from."""
        ...

    @property
    def stations(self) -> Keys:
        """From the tree to its table of stations."""
        ...

    @property
    def x(self) -> Array:
        """The stations [m]."""
        ...

    @property
    def interpolation(self) -> Interpolation:
        """How columns run between stations."""
        ...

    def points(self, number: int) -> Array:
        """Return even points from end to end [m]."""
        return np.linspace(float(self.x[0]), float(self.x[-1]), number)

    def written(self, keys: Keys) -> str:
        """Return the path to a number as the file has it."""
        ...

    def short_name(self, place: Place) -> str:
        """Return what a number is called where the study gives it no name."""
        ...

    def column(self, key: str) -> Keys | None:
        """Return the keys of a column; None for what is none."""
        ...

    def values(self, keys: Keys) -> Array:
        """Return a column of the stations."""
        ...

    def possible(self, columns: Array, own: Array) -> npt.NDArray[np.bool_]:
        """Tell which entries of many columns may be instead of those of its own."""
        ...

    def place(self, path: str) -> Place:
        """Find a number by its path."""
        ...

    def without_effect(self, keys: Keys) -> str:
        """Say why a number changes nothing; nothing if it may change something."""
        ...

    def lacks(self, family: FamilyName) -> str:
        """Return a column without which a family of modes has no answer; nothing if all are."""
        ...

    @property
    def solves_shear(self) -> bool:
        """Whether shear or rotary inertia are solved."""
        ...

    def mass_at(self, x: Array) -> Array:
        """Return the mass per length [kg/m]."""
        ...


@dataclass(frozen=True)
class OfVehicle(Subject):
    """A vehicle in a condition.

    Attributes
    ----------
    case : Case
    """

    case: Case
    stations = ("vehicle", "stations")

    @property
    def name(self) -> str:
        """The vehicle's."""
        return self.case.vehicle.name

    @property
    def tree(self) -> BaseModel:
        """The case."""
        return self.case

    @property
    def x(self) -> Array:
        """The stations [m]."""
        return self.case.vehicle.stations.x

    @property
    def interpolation(self) -> Interpolation:
        """How columns run between stations."""
        return self.case.vehicle.interpolation

    def written(self, keys: Keys) -> str:
        """Return the path to a number as the case has it."""
        return ".".join(map(str, keys))

    def short_name(self, place: Place) -> str:
        """Return the last key of a number, or all of it where that is a row."""
        last = place.keys[-1]
        return last if isinstance(last, str) else place.text

    def column(self, key: str) -> Keys | None:
        """Return the keys of a column; None for what is none."""
        bare = key.removeprefix("vehicle.").removeprefix("stations.")
        if bare.partition(":")[0] not in _OF_VEHICLES:
            return None
        return (*self.stations, *column_keys(self.case.vehicle.stations, bare))

    def values(self, keys: Keys) -> Array:
        """Return a column of the stations."""
        return column_values(self.case.vehicle.stations, keys[2:])

    def possible(self, columns: Array, own: Array) -> npt.NDArray[np.bool_]:
        """Tell which entries of many columns may be instead of those of its own."""
        return np.asarray(np.isfinite(columns) & ((columns > 0) | (own == 0)))

    def place(self, path: str) -> Place:
        """Find a number by its path."""
        known = [*OperatingCondition.model_fields, *_OF_VEHICLES, "time"]
        tables = [*Case.model_fields, *Vehicle.model_fields]
        first = path_names(path)[0]
        if first not in known and first not in tables:
            raise InputError(f"inputs: key = {short(path)} leads nowhere; {nearest(first, known)}")
        return find_place(self.case, path)

    def without_effect(self, keys: Keys) -> str:
        """Say why a number changes nothing; nothing if it may change something."""
        return without_effect(self.case, keys)

    def lacks(self, family: FamilyName) -> str:
        """Return a column without which a family of modes has no answer; nothing if all are."""
        stations = self.case.vehicle.stations
        absent = [t for t in FAMILIES[family].tables if getattr(stations, t, 0.0) is None]
        return absent[0] if absent else ""

    @property
    def solves_shear(self) -> bool:
        """Whether shear and rotary inertia are solved."""
        return self.case.model.theory == "timoshenko"

    def mass_at(self, x: Array) -> Array:
        """Return the mass per length [kg/m]."""
        return self.case.vehicle.mass_distribution(self.case.condition.burn_fraction).at(x)


@dataclass(frozen=True)
class OfBeam(Subject):
    """A beam file.

    Attributes
    ----------
    file : BeamFile
    responds : bool
        Whether its response is asked for too.
    table : str
        Of the study's file that names paths, for messages.
    """

    file: BeamFile
    responds: bool = False
    table: str = "inputs"
    stations = ("stations",)

    @property
    def name(self) -> str:
        """The beam's."""
        return self.file.table.name

    @property
    def tree(self) -> BeamTable:
        """The table `[beam]`."""
        return self.file.table

    @property
    def x(self) -> Array:
        """The stations [m]."""
        return self.file.table.stations.x

    @property
    def interpolation(self) -> Interpolation:
        """How columns run between stations."""
        return self.file.table.interpolation

    @cached_property
    def beam(self) -> Beam:
        """The beam itself."""
        return self.file.beam()

    def written(self, keys: Keys) -> str:
        """Return the path to a number as the file has it."""
        return ".".join(("beam", *map(str, keys)))

    def short_name(self, place: Place) -> str:
        """Return the last key of a number, or all of it in a list: one spring is none of others."""
        inside = any(isinstance(key, int) for key in place.keys)
        return place.text if inside else str(place.keys[-1])

    @property
    def columns(self) -> list[str]:
        """Names of its columns, without x."""
        return [n for n in ALL_COLUMNS[1:] if getattr(self.tree.stations, n) is not None]

    def column(self, key: str) -> Keys | None:
        """Return the keys of a column; None for what is none."""
        bare = key.removeprefix("beam.").removeprefix("stations.")
        if bare not in ALL_COLUMNS:
            return None
        known = self.columns
        where = f"{self.table}: key = {short(key)}"
        if bare == "x":
            raise InputError(f"{where}: positions of stations stay as they are")
        if bare not in known:
            say = f"the stations have no such column; {nearest(bare, known)}"
            raise InputError(f"{where}: {say}")
        return (*self.stations, bare)

    def values(self, keys: Keys) -> Array:
        """Return a column of the stations."""
        return np.asarray(getattr(self.tree.stations, str(keys[1])))

    def possible(self, columns: Array, own: Array) -> npt.NDArray[np.bool_]:
        """Tell which entries of many columns may be; the beam itself judges of their sizes."""
        return np.asarray(np.isfinite(columns) | ((columns == own) & np.isinf(own)))

    def place(self, path: str) -> Place:
        """Find a number by its path."""
        names = path_names(path)
        names = names[1:] if names[0] == "beam" and len(names) > 1 else names
        names = ["stations", *names] if names[0] in ALL_COLUMNS else names
        known = [n for n in BeamTable.model_fields if n != "name"]
        if names[0] not in known:
            say = nearest(names[0], [*self.columns, *known])
            raise InputError(f"{self.table}: key = {short(path)} leads nowhere; {say}")
        here, place = place_below(self.tree, names, path)
        check_is_number(here, path, "name one number, such as springs.0.translational")
        if place.keys[:2] == (*self.stations, "x"):
            raise InputError(f"{wrong_key(path)}: positions of stations stay as they are")
        if math.isinf(here):
            raise InputError(f"{wrong_key(path)} leads to a support, inf; give it a finite number")
        return place

    def without_effect(self, keys: Keys) -> str:
        """Say why a number changes nothing; nothing if it may change something."""
        if keys[0] == "stations" and keys[1] == "loss_factor" and not self.responds:
            return "frequencies are those without losses; name a response file: response = '...'"
        end = {"left_follower": "left", "right_follower": "right"}.get(str(keys[-1]))
        if end and getattr(self.tree.ends, end) != "free":
            return f"a force turns with a free end only, and {end} is held"
        return ""

    def lacks(self, family: FamilyName) -> str:
        """Return a column without which a family of modes has no answer; nothing if all are."""
        if tells(self.beam, family):
            return ""
        absent = (t for t in FAMILIES[family].tables if getattr(self.beam, t) is None)
        return next(absent)

    @property
    def solves_shear(self) -> bool:
        """Whether shear or rotary inertia are solved."""
        return self.beam.is_timoshenko

    def mass_at(self, x: Array) -> Array:
        """Return the mass per length [kg/m]."""
        beam = self.beam
        k = np.clip(np.searchsorted(beam.x, x, side="right") - 1, 0, len(beam.x) - 2)
        return beam.column_at("mass_per_length", k, (x - beam.x[k]) / np.diff(beam.x)[k])

    def changed(self, numbers: Mapping[Keys, Any], i: int) -> BeamFile:
        """Return the file with the numbers and columns of case `i`, unchecked."""
        file = self.file
        for keys, values in numbers.items():
            value = values[i]
            one = float(value) if np.ndim(value) == 0 else np.asarray(value)
            file = with_value(file, keys, one)
        return file


def subject_of(case: Given, responds: bool = False) -> OfVehicle | OfBeam:
    """Return what a study of a case, or of a beam file, varies something in."""
    return OfBeam(case, responds) if isinstance(case, BeamFile) else OfVehicle(case)


Changed = TypeVar("Changed", bound=Given)


def with_value(case: Changed, keys: Keys, value: Any) -> Changed:
    """Return a case or a beam file with one number, or one column, replaced, unchecked."""
    if not isinstance(case, BeamFile):
        return replaced(case, keys, value)
    changed = case.model_copy(update={"table": replaced(case.table, keys, value)})
    return cast(Changed, changed)
