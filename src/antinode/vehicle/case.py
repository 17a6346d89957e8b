"""The case: a vehicle in an operating condition, read from TOML, with its loads and its beam."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from antinode.arrays import Array, Interpolation
from antinode.beam.attachments import PointFeedback
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.limits import check_limits
from antinode.beam.settings import Solve
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.reading import naming, read_tables
from antinode.inputs.units import Frozen
from antinode.methods import CaseMethods

from .condition import OperatingCondition, Water
from .hydrodynamics.added_mass import AddedMass
from .loads import Loads, loads_of_case
from .many_loads import ManyLoads, loads_of_many
from .numbers import ManyCases, Numbers
from .options import Model
from .tangent import Tangent, disk_share, tangents
from .theory import radius_of_gyration, sheared
from .vehicle import Vehicle

COLUMNS = (
    "x",
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "radius",
    "radius_of_gyration",
    "wall",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
)


NO_TANGENT = (
    "hydrodynamic stiffness and damping: what fins, planing tail and cavitator do as the body "
    'vibrates ([model] hydrodynamic_stiffness = "tangent")'
)
"""What a vehicle's beam leaves out by default."""


class Case(CaseMethods, Frozen):
    """A vehicle in a condition, with all choices made."""

    vehicle: Vehicle = Field(description="stations, cavitator, fins")
    condition: OperatingCondition = Field(description="how the vehicle moves")
    water: Water = Field(default=Water(), description="the water; by default fresh, of 20 C")
    model: Model = Field(default=Model(), description="choices that the equations leave open")
    solve: Solve = Field(default=Solve(), description="what to compute, and how well")

    def __getstate__(self) -> dict[Any, Any]:
        """Leave to other processes to work out again what was worked out and kept here."""
        state = super().__getstate__()
        inputs = {name: state["__dict__"][name] for name in type(self).model_fields}
        return {**state, "__dict__": inputs}

    @cached_property
    def loads(self) -> Loads:
        """Cavity, forces, accelerations and internal forces in this condition."""
        return loads_of_case(self.many_loads, 0)

    @cached_property
    def many_loads(self) -> ManyLoads:
        """The loads of this condition as the one row of many."""
        return loads_of_many(self.many({}, 1))

    @cached_property
    def tangents(self) -> tuple[Tangent, ...]:
        """What the water does as the body vibrates, device by device; none unless asked for."""
        if self.model.hydrodynamic_stiffness == "none":
            return ()
        return tangents(self.many_loads.cases, self.loads)

    @cached_property
    def added_masses(self) -> tuple[AddedMass[float], ...]:
        """Water that moves sideways with the body, part by part; none unless asked for."""
        parts = (part.of(0) for part in self.many_loads.added_masses)
        return tuple(part for part in parts if part.mass > 0)

    @property
    def without_added_mass(self) -> Case:
        """The same case, none of whose water moves sideways with it."""
        none = {"fin_added_mass": "none", "planing_added_mass": "none"}
        return self.model_copy(update={"model": self.model.model_copy(update=none)})

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader should know of choices that the file leaves open."""
        told = {_ENDS: self.model.is_end_force_stated, _THEORY: self.model.is_theory_stated}
        return tuple(note for note, stated in told.items() if not stated)

    def many(self, numbers: Numbers, cases: int) -> ManyCases:
        """Return cases that differ from this one in some numbers."""
        return ManyCases(
            self.vehicle, self.condition, self.water, self.model, numbers=numbers, cases=cases
        )

    def beam(self) -> Beam:
        """Return the free-free beam under the axial force of this condition.

        Raises
        ------
        InputError
            If its numbers are beyond all reason.
        """
        beam = vehicle_beam(self)
        with naming(f"at {self.condition.speed:g} m/s"):
            check_limits(beam)
        return beam


_ENDS = (
    "the file does not say what the end forces do, so thrust and the cavitator's drag turn "
    "with the body; in earlier versions they kept their direction, which lowers the first "
    'frequency: state [model] end_force = "follows_body" or "fixed_direction"'
)
_THEORY = (
    "the file does not name the theory of the beam, so shear and rotary inertia are solved "
    "(Timoshenko); in earlier versions they were left out, which raises the frequencies: state "
    '[model] theory = "timoshenko" or "euler_bernoulli"'
)


def vehicle_beam(case: Case, acting: tuple[Tangent, ...] | None = None) -> Beam:
    """Return the vehicle of a case as a free-free beam under the axial force of its loads.

    ``N(x) = axial_jump + axial_inertia * (mass ahead of x)`` between the breakpoints of the loads;
    shares of the cavitator's drag and of the thrust turn with the body, and the water pushes back
    where the model says so; by some of its tangents alone where these are given.
    """
    loads, burnt, model = case.loads, case.condition.burn_fraction, case.model
    nose, tail = model.follow
    steps = np.repeat(loads.axial_jump[:, None], 2, axis=1)
    pushed = model.hydrodynamic_stiffness == "tangent"
    beam = body_as_beam(
        case.vehicle,
        loads.breakpoints,
        burnt,
        axial_force=steps,
        axial_acceleration=loads.axial_inertia,
        ends=Ends(left_follower=disk_share(loads) if pushed else nose, right_follower=tail),
        end_force=(loads.F_CX, loads.thrust),
        left_out=() if pushed else (NO_TANGENT,),
        **_sheared(case.vehicle, loads, model),
    )
    beam = _with_water(beam, case.added_masses, model)
    acting = case.tangents if acting is None else acting
    feedback = [PointFeedback.of(t.x, t.stiffness, t.damping) for t in acting]
    return beam.with_attachments(*feedback) if feedback else beam


_LEFT = {
    "fin_added_mass": "added mass of the fins",
    "planing_added_mass": "added mass of the planing tail",
}


def _with_water(beam: Beam, parts: Sequence[AddedMass[float]], model: Model) -> Beam:
    """Return a beam with the water that moves sideways with it, spread evenly along each part."""
    chosen = {name: getattr(model, name) for name in _LEFT}
    if all(value == "none" for value in chosen.values()):
        return beam
    beam = beam.with_breakpoints([x for part in parts for x in (part.start, part.end)])
    middle, added = (beam.x[1:] + beam.x[:-1]) / 2, np.zeros((len(beam.x) - 1, 2))
    for part in parts:
        inside = (middle > part.start) & (middle < part.end)
        added[inside] += part.per_length
    left = tuple(_LEFT[name] for name, value in chosen.items() if value == "none")
    return replace(beam, added_mass_per_length=added, left_out=(*beam.left_out, *left))


def _sheared(vehicle: Vehicle, loads: Loads, model: Model) -> dict[str, Any]:
    """Return what Timoshenko's theory asks for besides; nothing in Euler-Bernoulli's."""
    found = sheared(
        vehicle, model, loads.mass_distribution, lambda name: getattr(vehicle.stations, name)
    )
    if found is None:
        return {}
    return {
        "theory": "timoshenko",
        "shear_form": found.form,
        "shear_stiffness": found.stiffness.between(loads.breakpoints),
        "rotary_inertia_per_length": found.rotary.between(loads.breakpoints),
    }


def body_as_beam(vehicle: Vehicle, x: Array, burn_fraction: float, **axial: Any) -> Beam:
    """Return a vehicle as a free-free beam between breakpoints that contain every station.

    Without `axial_force` and `axial_acceleration` it is unloaded.
    """
    section = vehicle.section(x, burn_fraction)
    return Beam(
        x=x,
        mass_per_length=section.mass_per_length,
        bending_stiffness=section.bending_stiffness,
        axial_stiffness=section.axial_stiffness,
        interpolation=_interpolation(vehicle),
        radius_of_gyration=radius_of_gyration(vehicle, x),
        torsional_stiffness=section.torsional_stiffness,
        polar_inertia_per_length=section.polar_inertia_per_length,
        name=vehicle.name,
        **axial,
    )


def _interpolation(vehicle: Vehicle) -> Interpolation:
    """Return how the columns run, once linear parts may have been added to stepped stations."""
    linear = any(part.interpolation == "linear" for part in vehicle.masses)
    return "linear" if linear else vehicle.interpolation


def load_case(path: str | Path, assignments: Iterable[str] = ()) -> Case:
    """Read a case file.

    Parameters
    ----------
    path : str or Path
        A TOML file.
    assignments : iterable of str
        Overrides such as ``"condition.speed=100m/s"``.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        If anything in it is wrong.
    ComputationError
        If the loads are beyond what numbers can hold.
    """
    path = Path(path)
    tables, where, elsewhere = read_tables(path, assignments, "vehicle", COLUMNS)
    if "beam" in tables and "vehicle" not in tables:
        raise InputError(f"{path}: this is a beam file; use 'antinode beam {path}'")
    case = validate(Case, tables, where, elsewhere)
    with naming(where):
        case.beam()
    return case
