"""What the physics of a problem can be switched to: theory, ends, what acts along the body.

Pure: a problem gives its switches with their present positions, and a position gives the changes of
the file that bring it about.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.file import BeamFile
from antinode.vehicle.case import Case

from .inputs import Problem

Changes = dict[str, Any]
_ROUNDING = 1e-9  # of the largest N

THEORIES = {"timoshenko": "Timoshenko", "euler_bernoulli": "Euler-Bernoulli"}
_FORCES = {"both": "all follow", "thrust": "thrust", "none": "fixed"}
_FOLLOW = {"both": (1.0, 1.0), "thrust": (0.0, 1.0), "none": (0.0, 0.0)}
_WATER = {"none": "none", "tangent": "tangent"}
_ONE = {"1": "follows", "0": "fixed"}
_SWITCH = {"on": "on", "off": "off"}
_ENDS = {end: end for end in ("free", "pinned", "sliding", "clamped")}
_ADDED = {"fin_added_mass": "plate", "planing_added_mass": "wedge"}
_COLUMNS = {"foundation_stiffness": "foundation", "added_mass_per_length": "added mass"}


class Switch(NamedTuple):
    """One choice of the physics.

    Attributes
    ----------
    key : str
    label : str
    meaning : str
        In a sentence, for who does not know the word.
    options : mapping
        Words on the screen by position.
    position : str
        The present one; empty where the file says something between.
    """

    key: str
    label: str
    meaning: str
    options: Mapping[str, str]
    position: str


def switches(problem: Problem, beam: Beam, original: Problem) -> tuple[Switch, ...]:
    """Return the switches of a problem in their present positions."""
    if isinstance(problem, Case):
        return _of_case(problem)
    assert isinstance(original, BeamFile)
    return tuple(_of_beam(problem, beam, original))


def _of_case(case: Case) -> tuple[Switch, ...]:
    model = case.model
    forces = next((name for name, shares in _FOLLOW.items() if shares == model.follow), "")
    theory = "Timoshenko solves shear and rotary inertia, Euler-Bernoulli leaves them out"
    ends = "whether thrust and the cavitator's drag turn with the body, or keep their direction"
    water = "what fins, planing tail and cavitator do as the body vibrates: nothing, or tangents"
    added = "whether water moves sideways with fins and planing tail, and is carried along"
    return (
        Switch("theory", "theory", theory, THEORIES, model.theory),
        Switch("forces", "end forces", ends, _FORCES, forces),
        Switch("water", "water's stiffness", water, _WATER, model.hydrodynamic_stiffness),
        Switch("added", "added mass", added, _SWITCH, "on" if _added(case) else "off"),
    )


def _added(case: Case) -> dict[str, str]:
    """Return the formulas of added mass that a case counts, by their keys."""
    formulas = {key: getattr(case.model, key) for key in _ADDED}
    return {key: formula for key, formula in formulas.items() if formula != "none"}


def _of_beam(file: BeamFile, beam: Beam, original: BeamFile) -> list[Switch]:
    table, found = file.table, []
    first = original.table.stations
    given = first.shear_stiffness is not None or first.rotary_inertia_per_length is not None
    if given or original.table.material is not None:
        theory = "timoshenko" if beam.is_timoshenko else "euler_bernoulli"
        meaning = "Timoshenko solves shear and rotary inertia, Euler-Bernoulli leaves them out"
        found.append(Switch("theory", "theory", meaning, THEORIES, theory))
    for side in ("left", "right"):
        own = getattr(table.ends, side)
        meaning = f"how the {side} end is held sideways"
        found.append(Switch(f"{side}", f"{side} end", meaning, _ENDS, own))
    for side, force in zip(("left", "right"), pushing(beam), strict=True):
        if getattr(table.ends, side) == "free" and force:
            share = getattr(table.ends, f"{side}_follower")
            words = f"whether the force at the {side} end turns with it"
            position = f"{share:g}" if share in (0.0, 1.0) else ""
            found.append(Switch(f"{side}_force", f"force at {side} end", words, _ONE, position))
    for name, label in _COLUMNS.items():
        if getattr(first, name) is not None:
            position = "off" if getattr(table.stations, name) is None else "on"
            words = f"whether the column {name} of the file counts"
            found.append(Switch(name, label, words, _SWITCH, position))
    return found


def pushing(beam: Beam) -> tuple[float, float]:
    """Return the forces at both ends [N]; zero where nothing but rounding is left of them."""
    least = _ROUNDING * float(np.max(np.abs(beam.axial_force), initial=0.0))
    left, right = (force if abs(force) > least else 0.0 for force in beam.end_forces)
    return left, right


def changes_of(key: str, position: str, original: Problem) -> Changes:
    """Return the changes of the file that bring a switch into a position."""
    if isinstance(original, Case):
        if key == "added":
            formulas = _added(original) or _ADDED
            on = position == "on"
            return {f"model.{k}": formulas.get(k, "none") if on else "none" for k in _ADDED}
        return _case_changes(key, position)
    if key == "theory":
        return {"beam.theory": position}
    if key.endswith("_force"):
        side = key.removesuffix("_force")
        return {f"beam.ends.{side}_follower": float(position)}
    if key in _COLUMNS:
        column = getattr(original.table.stations, key)
        return {f"beam.stations.{key}": column.tolist() if position == "on" else None}
    held = {} if position == "free" else {f"beam.ends.{key}_follower": None}
    return {f"beam.ends.{key}": position, **held}


def _case_changes(key: str, position: str) -> Changes:
    if key == "theory":
        return {"model.theory": position}
    if key == "water":
        # the slope of the disk's lift takes the place of the share that follows
        own: Changes = {} if position == "none" else {"model.cavitator_follows": None}
        return {"model.hydrodynamic_stiffness": position, **own}
    follow: Changes = {
        "model.end_force": "follows_body" if position == "both" else "fixed_direction",
        "model.cavitator_follows": None,
        "model.thrust_follows": 1.0 if position == "thrust" else None,
    }
    return follow
