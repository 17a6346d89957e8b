"""The beam file: a beam given by stations in TOML, checked and turned into a `Beam`.

`exchange.beam_toml` writes one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import Field, model_validator

from antinode.arrays import Array, Interpolation
from antinode.errors import InputError
from antinode.inputs.columns import (
    Column,
    both_or_neither,
    dropped_row,
    with_closed_stations,
)
from antinode.inputs.explain import validate
from antinode.inputs.override import override
from antinode.inputs.reading import COLUMN_UNITS, Tables, naming, read_tables
from antinode.inputs.units import Frozen, Number
from antinode.methods import BeamMethods
from antinode.text import counted

from .axial import apply_loads
from .beam import Beam
from .checks import ALLOWED, ShearForm, Theory, allowed_values
from .curves import total
from .ends import AxialEnd, End, Ends, TorsionEnd
from .limits import check_limits
from .loads.turning import with_their_force
from .parts import MassTable, check_on_body
from .rotation import apply_rotation
from .sections.drawn import OTHERS, drawn_beam
from .sections.material import Material
from .sections.shapes import DIMENSIONS
from .sections.table import SectionColumns, check_material
from .settings import Solve
from .station_csv import without_hull
from .tables import AttachmentTables

COLUMNS = (
    "x",
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "axial_force",
    "radius_of_gyration",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
    "foundation_stiffness",
    "added_mass_per_length",
    "loss_factor",
    "tangential_load",
)
"""Of stations, without those of sections."""
ALL_COLUMNS = (*COLUMNS, *DIMENSIONS)


Share = Annotated[Number, Field(ge=0, le=1)]


class BeamEnds(Frozen):
    """How the ends are held."""

    left: End = Field("free", description="how the end at the smallest x is held sideways")
    right: End = Field("free", description="how the end at the largest x is held sideways")
    left_axial: AxialEnd | None = Field(
        None, description="how the left end is held axially; fixed if clamped or pinned, else free"
    )
    right_axial: AxialEnd | None = Field(
        None, description="how the right end is held axially; fixed if clamped or pinned, else free"
    )
    left_torsion: TorsionEnd | None = Field(
        None,
        description="how the left end is held about the axis; fixed if clamped, else free",
    )
    right_torsion: TorsionEnd | None = Field(
        None, description="how the right end is held about the axis; fixed if clamped, else free"
    )
    left_follower: Share = Field(
        0.0, description="share of N at the free left end that turns with its section, 0 to 1"
    )
    right_follower: Share = Field(
        0.0, description="share of N at the free right end that turns with its section, 0 to 1"
    )

    @model_validator(mode="after")
    def _check_followers(self) -> Self:
        for side in ("left", "right"):
            end, name = getattr(self, side), f"{side}_follower"
            if getattr(self, name) and end != "free":
                raise ValueError(
                    f"{name} is {getattr(self, name):g}, but {side} is '{end}'; a force turns with "
                    "a free end only: set it to 0 or leave it out"
                )
        return self


class BeamStations(SectionColumns):
    """The table along the beam; rows count from 1."""

    x: Annotated[Array, Column("m")] = Field(
        description="position [m], increasing; two rows at one x: a jump"
    )
    mass_per_length: Annotated[Array, Column("kg/m")] | None = Field(
        None, description="m [kg/m]; needed unless the section's dimensions are given"
    )
    bending_stiffness: Annotated[Array, Column("N m^2")] | None = Field(
        None, description="EI [N m^2]; needed unless the section's dimensions are given"
    )
    axial_stiffness: Annotated[Array, Column("N")] | None = Field(
        None, description="EA [N]; without it there are no longitudinal modes"
    )
    axial_force: Annotated[Array, Column("N")] | None = Field(
        None, description="N [N], compression positive; zero by default"
    )
    radius_of_gyration: Annotated[Array, Column("m")] | None = Field(
        None,
        description="of the cross-section [m], for the effect of rotary inertia; default "
        "sqrt(EI/EA)",
    )
    torsional_stiffness: Annotated[Array, Column("N m^2")] | None = Field(
        None, description="GJ [N m^2]; without it there are no torsion modes"
    )
    polar_inertia_per_length: Annotated[Array, Column("kg m")] | None = Field(
        None, description="rho I_p, about the axis [kg m]; beside torsional_stiffness"
    )
    shear_stiffness: Annotated[Array, Column("N")] | None = Field(
        None, description="kGA [N], or inf; without it rigid in shear"
    )
    rotary_inertia_per_length: Annotated[Array, Column("kg m")] | None = Field(
        None,
        description="rho I of the section [kg m]; default mass_per_length times "
        "radius_of_gyration^2 in Timoshenko's theory if that column is given, else 0",
    )
    foundation_stiffness: Annotated[Array, Column("N/m^2")] | None = Field(
        None, description="of an elastic foundation, lateral [N/m^2]"
    )
    added_mass_per_length: Annotated[Array, Column("kg/m")] | None = Field(
        None, description="of water that moves with the beam sideways [kg/m]: it has no weight"
    )
    loss_factor: Annotated[Array, Column("")] | None = Field(
        None, description="of EI, kGA, EA and GJ [-]; for responses and complex modes only"
    )
    tangential_load: Annotated[Array, Column("N/m")] | None = Field(
        None,
        description="load along +x that turns with the section [N/m]; without axial_force N "
        "follows from it and from what holds the beam axially",
    )

    @model_validator(mode="after")
    def _check_table(self) -> Self:
        _check_positions(self.x)
        self._check_complete()
        for name in ALL_COLUMNS[1:]:
            column = getattr(self, name)
            if column is not None:
                _check_column(name, column, len(self.x))
        self.check_sections()
        both_or_neither(self, "torsional_stiffness", "polar_inertia_per_length")
        return self

    def _check_complete(self) -> None:
        for name in ("mass_per_length", "bending_stiffness"):
            if getattr(self, name) is None and not self.dimensions():
                raise ValueError(
                    f"{name} is missing; add it, or give the section's dimensions and "
                    "[beam.material] ('antinode schema' lists every key with its unit)"
                )

    def given(self, names: Iterable[str]) -> dict[str, Array]:
        """Return those of some columns that are given."""
        columns = {name: getattr(self, name) for name in names}
        return {name: column for name, column in columns.items() if column is not None}


def _check_positions(x: Array) -> None:
    if len(x) < 2:
        raise ValueError(f"x has {counted(len(x), 'row')}; a table of stations needs at least two")
    for i in np.flatnonzero(~np.isfinite(x))[:1]:
        raise ValueError(f"x, row {i + 1}, is {x[i]}; it must be a finite number: correct this row")
    for i in np.flatnonzero(np.diff(x) < 0)[:1]:
        raise ValueError(
            f"x must increase: row {i + 1} has {x[i]:.10g} m and row {i + 2} {x[i + 1]:.10g} m; "
            "sort the rows by x"
        )
    twice = np.diff(x) == 0
    lonely = twice & (np.append(True, twice[:-1]) | np.append(twice[1:], True))
    for i in np.flatnonzero(lonely)[:1]:
        raise ValueError(
            f"x must increase: rows {i + 1} and {i + 2} both have {x[i]:.10g} m; two rows at one x "
            "are a jump inside the beam: remove one of the duplicate rows"
        )


def check_jumps(x: Array, interpolation: Interpolation) -> None:
    """Raise ValueError where a stepped table has two rows at one x: each row jumps there anyway."""
    for i in np.flatnonzero(np.diff(x) == 0)[:1] if interpolation == "step" else ():
        raise ValueError(
            f"x must increase: rows {i + 1} and {i + 2} both have {x[i]:.10g} m; with "
            "interpolation = 'step' a row holds up to the next one: remove one of the duplicate "
            "rows, or set interpolation = 'linear' for a jump between slopes"
        )


def _check_column(name: str, column: Array, rows: int) -> None:
    if len(column) != rows:
        raise ValueError(
            f"{name} has {counted(len(column), 'row')}, but x has {rows}: give one value a row"
        )
    for i in np.flatnonzero(~allowed_values(name, column))[:1]:
        allowed = ALLOWED.get(name, "greater than 0 and finite")
        allowed = "a finite number" if allowed == "finite" else allowed
        raise ValueError(
            f"{name}, row {i + 1}, is {column[i]:.10g}; it must be {allowed}: correct this row"
        )


class BeamTable(AttachmentTables):
    """The table `[beam]`."""

    name: str = Field("beam", max_length=200, description="shown in tables and figures")
    interpolation: Interpolation = Field(
        "step", description="how columns run between stations; axial_force linearly unless 'step'"
    )
    theory: Theory | None = Field(
        None,
        description="default: timoshenko where shear_stiffness or rotary_inertia_per_length is "
        "given; euler_bernoulli leaves both out",
    )
    shear_form: ShearForm = Field("haringx", description="how the axial force and shear meet")
    stations: BeamStations = Field(description="table along the beam, or the name of a CSV file")
    material: Material | None = Field(
        None, description="beside dimensions of the section: mass and stiffness follow from both"
    )
    ends: BeamEnds = Field(BeamEnds(), description="how the ends are held")
    masses: tuple[MassTable, ...] = Field(
        (), description="parts whose mass adds to the stations' (tank, engine, lining)"
    )

    @model_validator(mode="before")
    @classmethod
    def _close_table(cls, data: Any) -> Any:
        return with_closed_stations(data)

    @model_validator(mode="after")
    def _check_masses(self) -> Self:
        x = self.stations.x
        check_jumps(x, self.interpolation)
        check_material(self.stations.dimensions(), self.material, self.interpolation)
        check_on_body(self.masses, float(x[0]), float(x[-1]), self.interpolation)
        return self


class BeamFile(BeamMethods, Frozen):
    """A beam file with everything in it."""

    table: BeamTable = Field(alias="beam", description="the beam itself")
    solve: Solve = Field(Solve(), description="what to compute, and how well")

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the file should know of it, and its beam does not tell."""
        stations = self.table.stations
        given = [(name, getattr(stations, name)) for name in COLUMNS[1:]]
        columns = ((name, column) for name, column in given if column is not None)
        told = dropped_row(self.table.interpolation, stations.x, columns, COLUMN_UNITS)
        return (told,) if told else ()

    def beam(self) -> Beam:
        """Return the beam that the file describes."""
        beam = self._bare().with_attachments(*self.table.attachments())
        for part in self.table.masses:
            beam = _with_part(beam, part)
        if beam.loads_turn and self.table.stations.axial_force is None:
            beam = with_their_force(beam)
        if self.table.loads is not None:
            beam = apply_loads(beam, self.table.loads.loads())
        turning = self.table.rotation
        return beam if turning is None else apply_rotation(beam, turning.rotation())

    def _bare(self) -> Beam:
        """Return the beam without attachments, further masses and loads."""
        table, stations = self.table, self.table.stations
        choices: dict[str, Any] = {
            "interpolation": table.interpolation,
            "ends": Ends(**table.ends.model_dump()),
            "theory": table.theory,
            "shear_form": table.shear_form,
            "name": table.name,
        }
        if stations.tangential_load is not None:  # its N when everything is attached
            choices["axial_force"] = np.zeros(len(stations.x))
        if table.material is None:
            return Beam.from_stations(stations.x, **choices | stations.given(COLUMNS[1:]))
        columns = stations.dimensions() | stations.given(OTHERS)
        return drawn_beam(stations.x, table.material, **choices | columns)


def _with_part(beam: Beam, part: MassTable) -> Beam:
    """Return the beam with the mass of a part added."""
    beam = beam.with_breakpoints(part.x.tolist())
    linear = part.interpolation == "linear"
    return replace(
        beam,
        mass_per_length=total(beam.mass_per_length, part.distribution().between(beam.x)),
        interpolation="linear" if linear else beam.interpolation,
    )


TABLES = (".csv", ".xlsx")
"""Endings of tables of stations, which stand where a beam file is expected."""


def table_of_stations(path: Path) -> dict[str, Any] | None:
    """Return the table `[beam]` of a CSV file or a workbook, None for a file of another kind.

    Columns of a hull, which a beam has no use for, are among those of the stations.
    """
    if path.suffix.lower() == ".csv":
        from .station_csv import read_station_csv

        return read_station_csv(path, ALL_COLUMNS)
    if path.suffix.lower() == ".xlsx":
        from .workbook import read_workbook

        return read_workbook(path, ALL_COLUMNS)
    return None


def beam_file_tables(path: Path, assignments: Iterable[str] = ()) -> Tables:
    """Return the tables of a beam file, or of stations in a table of their own.

    Raises
    ------
    InputError
        If anything in it cannot be read.
    """
    table = table_of_stations(path)
    if table is None:
        return read_tables(path, assignments, "beam", ALL_COLUMNS)
    tables, assignments = {"beam": without_hull(table)}, tuple(assignments)
    override(tables, assignments)
    where = f"{path} (with --set)" if assignments else str(path)
    return Tables(tables, where, {})


def load_beam(path: str | Path, assignments: Iterable[str] = ()) -> BeamFile:
    """Read a beam file.

    Parameters
    ----------
    path : str or Path
        A TOML file; or a table of stations in CSV, or a workbook, with no more than that.
    assignments : iterable of str
        Overrides such as ``"beam.ends.left=clamped"``.

    Returns
    -------
    BeamFile
        Its `beam()` is what `solve_modes` wants.

    Raises
    ------
    InputError
        If anything in it is wrong.
    """
    path = Path(path)
    tables, where, elsewhere = beam_file_tables(path, assignments)
    if "vehicle" in tables and "beam" not in tables:
        raise InputError(f"{path}: this is a vehicle's case; use 'antinode modes {path}'")
    file = validate(BeamFile, tables, where, elsewhere)
    with naming(where):
        check_limits(file.beam())
    return file
