"""The inputs of a case or a beam as tables with units."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from pydantic import BaseModel

from antinode.beam.attachments import (
    Attachment,
    Dashpot,
    Joint,
    Pedestal,
    PointFeedback,
    PointMass,
    Spring,
    name_of,
)
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES
from antinode.beam.file import ALL_COLUMNS, BeamFile
from antinode.beam.parts import MassTable
from antinode.inputs.reading import COLUMN_UNITS
from antinode.vehicle.case import Case

from .blocks import Block, Section, Table, bullets, paragraph, table
from .numbers import number

_UNIT = re.compile(r"\s*\[([^\]]+)\]")
_MOST_ROWS = 48
_MOST_ATTACHED = 60
Row = tuple[str, str, str, str]


def case_inputs(case: Case) -> list[Section]:
    """Return condition, water, choices of the model, vehicle and stations."""
    return [
        Section("Inputs", ()),
        Section("Condition and water", tuple(_conditions(case)), 2),
        Section("Vehicle", tuple(_vehicle(case)), 2),
        Section("Choices of the model", (_choices(case), _chosen(case)), 2),
    ]


_EVERYTHING = (
    "All numbers are in SI units as the file gives them, angles in degrees. What the file leaves "
    "open has its default."
)


def _conditions(case: Case) -> Iterator[Block]:
    yield paragraph(_EVERYTHING)
    yield _keys("Condition.", case.condition)
    yield _keys("Water and surroundings.", case.water)


def _keys(caption: str, inputs: BaseModel) -> Table:
    head = ("key", "value", "unit", "meaning")
    return table(caption, head, list(key_rows(inputs)), left=(0, 2), wide=(3,))


def key_rows(inputs: BaseModel) -> Iterator[Row]:
    """Yield name, value, unit and meaning of every number that is given."""
    for name, field in type(inputs).model_fields.items():
        value = getattr(inputs, name)
        if isinstance(value, bool) or not isinstance(value, int | float):
            continue
        meaning = field.description or ""
        found = _UNIT.search(meaning)
        unit = found[1] if found else "-"
        shown, unit = _in_degrees(value) if unit == "rad" else (value, unit)
        yield name, number(shown, 7), unit, _UNIT.sub("", meaning)


def _in_degrees(value: float) -> tuple[float, str]:
    return math.degrees(value), "deg"


def _vehicle(case: Case) -> Iterator[Block]:
    vehicle = case.vehicle
    yield paragraph(
        f"{vehicle.name}: {number(vehicle.length)} m long, {number(case.loads.mass)} kg in this "
        f"condition, centre of mass at x = {number(case.loads.x_M)} m; cavitator: disk of "
        f"{number(1e3 * vehicle.cavitator.diameter)} mm. Columns run between the stations by "
        f"“{vehicle.interpolation}”"
        + (": each row holds up to the next." if vehicle.interpolation == "step" else ".")
    )
    for k, fins in enumerate(vehicle.fins, 1):
        angles = ", ".join(number(math.degrees(a), 4) for a in fins.roll_angles)
        yield _keys(f"Fin set {k}: {len(fins.roll_angles)} fins at {angles} deg.", fins)
    stations = vehicle.stations
    columns = [(name, unit, values) for name, values, unit in stations.columns()]
    yield station_table("Stations.", [("x", "m", stations.x), *columns])
    if vehicle.masses:
        rows = [(*_part(part), _yes(part.burns)) for part in vehicle.masses]
        yield table("Parts that add mass, unburnt.", (*_PART, "burns"), rows, left=(0, 3))


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def station_table(caption: str, columns: Sequence[tuple[str, str, np.ndarray]]) -> Table:
    """Return the columns as a table, of a long one evenly chosen rows."""
    rows = len(columns[0][2])
    chosen = np.unique(np.linspace(0, rows - 1, min(rows, _MOST_ROWS)).round().astype(int))
    if len(chosen) < rows:
        caption = f"{caption} {len(chosen)} of {rows} rows are shown; all enter the hash."
    head = ["row", *(f"{_spoken(name)} [{unit}]" for name, unit, _ in columns)]
    body = [[str(k + 1), *(number(values[k], 6) for *_, values in columns)] for k in chosen]
    return table(caption, head, body, left=())


_SPOKEN = {
    "mass_per_length": "mass per length",
    "bending_stiffness": "EI",
    "axial_stiffness": "EA",
    "axial_force": "N",
    "radius_of_gyration": "radius of gyration",
    "torsional_stiffness": "GJ",
    "polar_inertia_per_length": "ρI_p",
    "shear_stiffness": "kGA",
    "rotary_inertia_per_length": "ρI",
    "foundation_stiffness": "foundation",
    "added_mass_per_length": "added mass",
    "loss_factor": "loss factor",
    "tangential_load": "load that turns",
}


def _spoken(name: str) -> str:
    first, colon, state = name.partition(":")
    return _SPOKEN.get(first, first) + (f", {state}" if colon else "")


def _choices(case: Case) -> Block:
    """Name the choices that differ from the default."""
    default = type(case.model)()
    changed = [
        f"`model.{name}` = {getattr(case.model, name)} (default {getattr(default, name)})"
        for name in type(case.model).model_fields
        if getattr(case.model, name) != getattr(default, name)
    ]
    if not changed:
        return paragraph("The equations leave some choices open. All of them have their default.")
    return bullets(["The equations leave some choices open. Not at their default:", *changed])


def _chosen(case: Case) -> Table:
    default, rows, marked = type(case.model)(), [], []
    for k, (name, field) in enumerate(type(case.model).model_fields.items()):
        value = getattr(case.model, name)
        text = value if isinstance(value, str) else number(value)
        rows.append((f"`{name}`", str(text), field.description or ""))
        if value != getattr(default, name):
            marked.append(k)
    head = ("choice", "taken", "meaning")
    return table(
        "Choices; marked where they are not the default.",
        head,
        rows,
        left=(0, 1),
        wide=(2,),
        marked=marked,
    )


def beam_inputs(file: BeamFile, beam: Beam) -> list[Section]:
    """Return ends, stations, parts, loads and what is attached."""
    table_, stations = file.table, file.table.stations
    ends = beam.ends
    columns = [
        (name, COLUMN_UNITS[name], column) for name, column in stations.given(ALL_COLUMNS).items()
    ]
    sides = [
        (side, *(ends.of(family)[k] for family in FAMILIES))
        for k, side in enumerate(("left", "right"))
    ]
    blocks: list[Block] = [
        paragraph(
            f"{beam.name}: {number(beam.length)} m long, {number(beam.mass)} kg with what is "
            f"attached. Columns run between the stations by “{table_.interpolation}”."
        ),
        table("Ends.", ("end", *_END_HEADS), sides, left=(0, 1, 2, 3)),
        station_table("Stations, as given.", columns),
        *_material(file),
        *_loads_and_parts(file),
        *attachment_tables(beam.attachments),
    ]
    return [Section("Inputs", tuple(blocks))]


_END_HEADS = ("laterally", "axially", "about the axis")
"""How an end is held in each family."""


def _material(file: BeamFile) -> Iterator[Block]:
    if file.table.material is not None:
        yield _keys(
            "Material; mass and stiffness follow from it and the section.", file.table.material
        )


def _loads_and_parts(file: BeamFile) -> Iterator[Block]:
    loads = file.table.loads
    if loads is not None:
        rows = list(key_rows(loads))
        if rows:
            head = ("key", "value", "unit", "meaning")
            yield table("Axial loads.", head, rows, left=(0, 2), wide=(3,))
        forces = [(number(f.x), number(f.force)) for f in loads.point_forces]
        if forces:
            yield table("Axial point forces.", ("x [m]", "force along +x [N]"), forces, left=())
    if file.table.masses:
        yield table("Parts that add mass.", _PART, [_part(p) for p in file.table.masses])


_PART = ("part", "x [m]", "mass [kg]")


def _part(part: MassTable) -> tuple[str, str, str]:
    """Return name, place and mass of a part, nothing of it burnt."""
    mass = float(part.distribution().moments_ahead[0][-1])
    return part.name, f"{number(part.x[0])} … {number(part.x[-1])}", number(mass)


def attachment_tables(items: Iterable[Attachment]) -> Iterator[Block]:
    """Yield a table for every kind of attachment; an infinite stiffness is a support."""
    attached = list(items)
    for kind, caption, head, values in _KINDS:
        rows = [
            (name_of(item), number(item.x), *(number(getattr(item, v)) for v in values))
            for item in attached
            if isinstance(item, kind)
        ]
        if rows:
            if len(rows) > _MOST_ATTACHED:
                caption = f"{caption} The first {_MOST_ATTACHED} of {len(rows)} are shown."
            yield table(caption, ("", "x [m]", *head), rows[:_MOST_ATTACHED])


_KINDS: tuple[tuple[type, str, tuple[str, ...], tuple[str, ...]], ...] = (
    (
        PointMass,
        "Point masses.",
        ("mass [kg]", "rotary inertia [kg m^2]", "offset [m]", "polar inertia [kg m^2]"),
        ("mass", "rotary_inertia", "offset", "polar_inertia"),
    ),
    (
        Spring,
        "Springs and supports to the ground.",
        (
            "translational [N/m]",
            "rotational [N m/rad]",
            "axial [N/m]",
            "torsional [N m/rad]",
            "coupling [N]",
        ),
        ("translational", "rotational", "axial", "torsional", "coupling"),
    ),
    (
        Pedestal,
        "Masses between a spring to the beam and one to the ground; they move sideways alone.",
        ("mass [kg]", "to the beam [N/m]", "to the ground [N/m]"),
        ("mass", "beam_stiffness", "ground_stiffness"),
    ),
    (
        Joint,
        "Joints in line.",
        ("rotational [rad/(N m)]", "axial [m/N]", "torsional [rad/(N m)]"),
        ("rotational", "axial", "torsional"),
    ),
    (
        Dashpot,
        "Dashpots to the ground.",
        (
            "translational [N s/m]",
            "rotational [N m s/rad]",
            "axial [N s/m]",
            "torsional [N m s/rad]",
        ),
        ("translational", "rotational", "axial", "torsional"),
    ),
    (
        PointFeedback,
        "Forces and moments that oppose motion: of the displacement Y and the turn psi.",
        ("force, Y [N/m]", "force, psi [N]", "moment, Y [N]", "moment, psi [N m]"),
        ("translational", "force_of_turn", "moment_of_displacement", "rotational"),
    ),
    (
        PointFeedback,
        "The same of their rates.",
        ("force, Y [N s/m]", "force, psi [N s]", "moment, Y [N s]", "moment, psi [N m s]"),
        (
            "translational_damping",
            "force_of_turn_rate",
            "moment_of_velocity",
            "rotational_damping",
        ),
    ),
)
