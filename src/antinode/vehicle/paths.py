"""Numbers of a case by their dotted paths: ``vehicle.fins.0.thickness``.

A path is written as `--set` takes it. The first tables may be left out where nothing else has the
name: ``fins.0.thickness``, ``thrust``.
"""

from __future__ import annotations

from antinode.errors import InputError
from antinode.inputs.places import (
    Keys,
    Place,
    check_is_number,
    path_names,
    place_below,
    wrong_key,
)

from .case import Case
from .condition import OperatingCondition
from .vehicle import Vehicle

_FIXED = ("solve",)
_LISTED = ("radius_of_gyration", "wall")


def find_place(case: Case, path: str) -> Place:
    """Find a number of a case by its path.

    Raises
    ------
    InputError
        If the path leads nowhere, or to something that is no number or cannot change.
    """
    here, place = place_below(case, _from_the_case(path_names(path)), path)
    if here is None and place.keys[-1] not in _LISTED:
        return place
    check_is_number(here, path, "name one number, such as vehicle.cavitator.diameter")
    if place.keys[0] in _FIXED or "x" in place.keys:
        say = "positions of stations and settings of the solver stay as they are"
        raise InputError(f"{wrong_key(path)} cannot be a parameter; {say}")
    return place


def _from_the_case(names: list[str]) -> list[str]:
    """Put the tables in front that were left out."""
    if names[0] in Case.model_fields:
        return names
    if names[0] in OperatingCondition.model_fields:
        return ["condition", *names]
    if names[0] in Vehicle.model_fields:
        return ["vehicle", *names]
    return names


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
