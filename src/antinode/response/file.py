"""The response file: what drives a beam, what is asked of it, and what equipment may feel.

Paths in it are relative to it. Outputs come in the order of the file.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.reading import naming, read_overridden
from antinode.inputs.units import Frozen, Length, Number, Unit
from antinode.modes.backends import BackendName

from .damping import Damping, Rayleigh
from .quantities import Base, Direction, Drive, Force, Output, QuantityName, Side, family_of
from .units import in_si

Kind = Literal["harmonic", "random", "transient", "shock"]
Frequency = Annotated[float, Unit("Hz"), Field(gt=0)]
Seconds = Annotated[float, Unit("s"), Field(gt=0)]
Ratio = Annotated[Number, Field(ge=0)]
MOST_POINTS = 100_000


class ResponseTable(Frozen):
    """What is asked for: `[response]`."""

    of: str = Field(min_length=1, description="beam file, case, or table of stations")
    kind: Kind = Field(description="harmonic, random, transient or shock")
    name: str = Field("", max_length=200, description="shown in tables and figures")
    tolerance: Annotated[Number, Field(ge=1e-12, le=0.1)] = Field(
        1e-6, description="largest error of an output by what varies inside segments, relative"
    )
    modes: int | None = Field(
        None, ge=1, le=500, strict=True, description="modes of each family in sums of modes"
    )


class RayleighTable(Frozen):
    """Damping by mass and stiffness, fitted: `[damping.rayleigh]`."""

    ratios: tuple[Ratio, Ratio] = Field(description="damping ratios at the two frequencies")
    frequencies: tuple[Frequency, Frequency] = Field(description="[Hz]")


class DampingTable(Frozen):
    """What loses energy, besides the beam's dashpots: `[damping]`."""

    loss_factor: Ratio = Field(0.0, description="of EI, kGA, EA, GJ; not springs, joints, soil")
    modal: tuple[Ratio, ...] = Field(
        (), description="ratios of modes 1, 2, ...; the last one holds for all further ones"
    )
    rayleigh: RayleighTable | None = Field(None, description="alpha M + beta K by two ratios")

    def damping(self) -> Damping:
        """Return it as the responses want it."""
        fitted = None
        if self.rayleigh is not None:
            fitted = Rayleigh.fitted(self.rayleigh.ratios, self.rayleigh.frequencies)
        return Damping(self.loss_factor, self.modal, fitted)


class FrequencyTable(Frozen):
    """At which frequencies: `[frequency]`."""

    model_config = ConfigDict(populate_by_name=True)

    from_: Frequency | None = Field(None, alias="from", description="lowest [Hz]")
    to: Frequency | None = Field(None, description="highest [Hz]")
    points: int = Field(400, ge=2, le=MOST_POINTS, strict=True, description="how many")
    spacing: Literal["log", "linear"] = Field("log", description="how they are spread")
    values: tuple[Frequency, ...] = Field((), description="or one by one [Hz]")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.values:
            if self.from_ is not None or self.to is not None:
                raise ValueError("values stand in place of from and to: give one of them")
            if any(b <= a for a, b in zip(self.values, self.values[1:], strict=False)):
                raise ValueError("values must increase")
        elif self.from_ is None or self.to is None:
            raise ValueError("from and to are needed, or values")
        elif not self.from_ < self.to:
            raise ValueError(f"from {self.from_:g} Hz must be below to {self.to:g} Hz")
        return self

    def hertz(self) -> Array:
        """Return the frequencies [Hz]."""
        if self.values:
            return np.array(self.values)
        assert self.from_ is not None
        assert self.to is not None
        spread = np.geomspace if self.spacing == "log" else np.linspace
        return np.asarray(spread(self.from_, self.to, self.points))


class TimeTable(Frozen):
    """At which times: `[time]`."""

    to: Seconds = Field(description="last time [s]; the first is 0")
    step: Seconds = Field(description="between the times of the answer [s]")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.to / self.step > MOST_POINTS * 10:
            raise ValueError(f"to over step is {self.to / self.step:.3g}; at most 1e6 times")
        return self

    def seconds(self) -> Array:
        """Return the times [s]."""
        return np.asarray(self.step * np.arange(round(self.to / self.step) + 1), dtype=float)


class Driven(Frozen):
    """How large a drive is, in one of three ways."""

    amplitude: float | str | None = Field(None, description="harmonic: size, with its unit")
    phase: Annotated[float, Unit("rad")] = Field(0.0, description="harmonic: by which it leads")
    psd: str | dict[str, Any] | None = Field(
        None, description="random: CSV of frequency [Hz] and psd [unit^2/Hz], or a table of them"
    )
    history: str | dict[str, Any] | None = Field(
        None, description="transient, shock: CSV of time [s] and value, or a shape"
    )


class ForceTable(Driven):
    """A force: `[[forces]]`."""

    x: Length = Field(description="station [m]")
    direction: Direction = Field(
        "lateral", description="lateral (up), axial (+x), torsional, moment (raises psi)"
    )
    to: Length | None = Field(None, description="where an evenly spread one ends [m]")
    name: str = Field("", max_length=80, description="by which results call it")

    def drive(self) -> Force:
        """Return it as a unit force."""
        return Force(self.x, self.direction, self.to)


class BaseTable(Driven):
    """Motion of the supports: `[base]`."""

    direction: Direction = Field("lateral", description="lateral, axial or torsional")
    motion: Literal["acceleration", "velocity", "displacement"] = Field(
        "acceleration", description="what of it is given"
    )

    def drive(self) -> Base:
        """Return it as a unit motion."""
        return Base(self.direction, self.motion)


class OutputTable(Frozen):
    """A number to follow: `[[outputs]]`."""

    x: Length = Field(description="station [m]")
    quantity: QuantityName = Field(description="displacement, acceleration, bending_moment, ...")
    direction: Direction | None = Field(
        None,
        description="of displacement, velocity, acceleration, reaction; default that of forces",
    )
    side: Side = Field("left", description="of what sits at the station")
    relative: bool = Field(False, description="to the moving supports")

    def output(self, direction: Direction) -> Output:
        """Return it as the responses want it; `direction` where none is given."""
        along = self.direction or direction
        made = Output(self.x, self.quantity, along, self.side, self.relative)
        if self.direction is not None and made.family != family_of(self.direction).name:
            raise InputError(
                f"the output '{made.name}': {self.quantity} is no quantity of the direction "
                f"'{self.direction}'; leave the direction out, or ask for another quantity"
            )
        return made


class CoherenceTable(Frozen):
    """How two random forces go together: `[[coherence]]`."""

    forces: tuple[str, str] = Field(description="names of the two")
    value: Annotated[Number, Field(ge=0, le=1)] = Field(description="|S12|^2/(S11 S22)")
    phase: Annotated[float, Unit("rad")] = Field(0.0, description="by which the second leads")


class EquipmentTable(Frozen):
    """A unit and what it is qualified for: `[[equipment]]`."""

    name: str = Field(min_length=1, max_length=80, description="what it is")
    x: Length = Field(description="station [m]")
    mass: Annotated[float, Unit("kg"), Field(ge=0)] = Field(
        0.0, description="added to the beam at the station [kg]; 0 where the beam has it"
    )
    direction: Direction | None = Field(None, description="along which it is measured")
    allowed: str | dict[str, Any] = Field(
        description="CSV of frequency [Hz] and level: psd [g^2/Hz], srs or amplitude [g]"
    )


class RandomTable(Frozen):
    """More of a random response: `[random]`."""

    duration: Seconds = Field(60.0, description="exposure for Davenport's peak [s]")
    envelope: bool = Field(True, description="also M and acceleration along the body")


class ShockTable(Frozen):
    """Of the shock response spectra: `[shock]`."""

    q: Annotated[Number, Field(ge=0.501)] = Field(10.0, description="amplification, 1/(2 zeta)")


class ResponseFile(Frozen):
    """A response file with everything in it."""

    response: ResponseTable = Field(description="what is asked for")
    damping_table: DampingTable = Field(
        DampingTable(), alias="damping", description="what loses energy"
    )
    frequency: FrequencyTable | None = Field(None, description="at which frequencies")
    time: TimeTable | None = Field(None, description="at which times")
    random: RandomTable = Field(RandomTable(), description="more of a random response")
    shock: ShockTable = Field(ShockTable(), description="of shock response spectra")
    forces: tuple[ForceTable, ...] = Field((), description="forces and moments on the beam")
    base: BaseTable | None = Field(None, description="motion of the supports")
    outputs_table: tuple[OutputTable, ...] = Field(
        (), alias="outputs", description="numbers to follow, in this order"
    )
    coherence: tuple[CoherenceTable, ...] = Field((), description="random forces that go together")
    equipment: tuple[EquipmentTable, ...] = Field((), description="units and what they may feel")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.forces and self.base is None:
            raise ValueError("nothing drives the beam: add [[forces]] or [base]")
        if not self.outputs_table and not self.equipment:
            raise ValueError("nothing is asked for: add [[outputs]] or [[equipment]]")
        kind = self.response.kind
        if kind in ("harmonic", "random", "shock") and self.frequency is None:
            raise ValueError(f"a response of kind '{kind}' needs the table [frequency]")
        if kind in ("transient", "shock") and self.time is None:
            raise ValueError(f"a response of kind '{kind}' needs the table [time]")
        if kind == "transient" and self.equipment:
            raise ValueError("equipment is judged by spectra: set response.kind = 'shock'")
        need = {"harmonic": "amplitude", "random": "psd"}.get(kind, "history")
        for name, table in self.drive_tables():
            if getattr(table, need) is None:
                raise ValueError(f"{name} has no {need}: a response of kind '{kind}' needs it")
        return self

    def drive_tables(self) -> list[tuple[str, ForceTable | BaseTable]]:
        """Return forces and base with their keys in the file."""
        rows: list[tuple[str, ForceTable | BaseTable]] = [
            (f"forces.{k}", force) for k, force in enumerate(self.forces)
        ]
        return [*rows, *([("base", self.base)] if self.base is not None else [])]

    @property
    def drives(self) -> tuple[Drive, ...]:
        """Unit forces and motions in the order of the file."""
        return tuple(table.drive() for _, table in self.drive_tables())

    @property
    def drive_names(self) -> tuple[str, ...]:
        """What results call the forces."""
        return tuple(
            getattr(table, "name", "") or drive.name
            for (_, table), drive in zip(self.drive_tables(), self.drives, strict=True)
        )

    @property
    def direction(self) -> Direction:
        """Where outputs say none: lateral if anything acts so, else that of the first drive."""
        directions = [drive.direction for drive in self.drives]
        lateral = "lateral" in directions or "moment" in directions
        return "lateral" if lateral else directions[0]

    @property
    def outputs(self) -> tuple[Output, ...]:
        """The outputs in the order of the file."""
        return tuple(table.output(self.direction) for table in self.outputs_table)

    def amplitudes(self) -> np.ndarray:
        """Return the complex amplitudes of the drives, SI."""
        return np.array(
            [
                in_si(table.amplitude, drive.unit, f"{name}.amplitude") * np.exp(1j * table.phase)
                for (name, table), drive in zip(self.drive_tables(), self.drives, strict=True)
            ]
        )


class Problem(NamedTuple):
    """A response file with the beam that it is about."""

    file: ResponseFile
    beam: Beam
    folder: Path
    where: str
    backend: BackendName = "auto"
    """What carries the states along the beam."""

    @property
    def title(self) -> str:
        """What it is called."""
        return self.file.response.name or self.beam.name

    @property
    def damping(self) -> Damping:
        """How the beam is damped."""
        return self.file.damping_table.damping()


def load_response(path: str | Path, assignments: Iterable[str] = ()) -> Problem:
    """Read a response file and the beam that it names.

    Parameters
    ----------
    path : str or Path
        A TOML file.
    assignments : iterable of str
        Overrides such as ``"damping.loss_factor=0.01"``.

    Returns
    -------
    Problem

    Raises
    ------
    InputError
        If anything in it is wrong.
    """
    path = Path(path)
    tables, where = read_overridden(path, assignments)
    if "response" not in tables and {"beam", "vehicle"} & set(tables):
        raise InputError(
            f"{path}: this is a file of a beam or a vehicle; name it in a response file with "
            f"[response] of = '{path.name}', which 'antinode init --example response' shows"
        )
    file = validate(ResponseFile, tables, where)
    beam = _beam_of(path.parent / file.response.of)
    with naming(where):
        file.damping_table.damping()
        _ = file.outputs
        beam = with_equipment(beam, file)
    return Problem(file, beam, path.parent, where)


def _beam_of(path: Path) -> Beam:
    """Return the beam of a beam file, of a table of stations, or of a vehicle's case."""
    from antinode.beam.file import TABLES, load_beam

    if path.suffix.lower() not in TABLES:
        from antinode.inputs.reading import read_toml

        if "vehicle" in read_toml(path):
            from antinode.vehicle.case import load_case

            return load_case(path).beam()
    return load_beam(path).beam()


def with_equipment(beam: Beam, file: ResponseFile) -> Beam:
    """Return the beam with the masses of the equipment that it does not have yet."""
    from antinode.beam.attachments import PointMass

    for item in file.equipment:
        if item.mass:
            beam = beam.with_attachments(PointMass(item.x, item.mass))
    return beam
