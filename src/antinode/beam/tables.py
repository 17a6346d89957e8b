"""The tables of a beam file for what is attached to the beam and what loads it axially."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import ConfigDict, Field, model_validator

from antinode.inputs.units import Acceleration, Force, Frozen, Length, Mass, Unit

from .attachments import (
    Attachment,
    Dashpot,
    Joint,
    Pedestal,
    PointFeedback,
    PointMass,
    Spring,
)
from .axial import AxialLoads, PointForce
from .rotation import Plane, Rotation

AxialStiffness = Annotated[float, Unit("N/m"), Field(ge=0)]
RotationalStiffness = Annotated[float, Unit("N m/rad"), Field(ge=0)]
LinearDamping = Annotated[float, Unit("N s/m"), Field(ge=0)]
RotationalDamping = Annotated[float, Unit("N m s/rad"), Field(ge=0)]


class PointMassTable(Frozen):
    """A rigid mass fixed to the beam: `[[beam.point_masses]]`."""

    x: Length = Field(description="station [m]")
    mass: Annotated[Mass, Field(gt=0)] = Field(description="mass [kg]")
    rotary_inertia: Annotated[float, Unit("kg m^2"), Field(ge=0)] = Field(
        0.0, description="about its own centre [kg m^2]"
    )
    offset: Length = Field(0.0, description="of its centre along +x from the station [m]")
    polar_inertia: Annotated[float, Unit("kg m^2"), Field(ge=0)] = Field(
        0.0, description="about the axis of the beam, for torsion [kg m^2]"
    )

    def attachment(self) -> PointMass:
        """Return it as the beam wants it."""
        return PointMass(**vars(self))


class SpringTable(Frozen):
    """Springs to the ground; inf is a support: `[[beam.springs]]`."""

    model_config = ConfigDict(allow_inf_nan=True)

    x: Annotated[Length, Field(allow_inf_nan=False)] = Field(description="station [m]")
    translational: AxialStiffness = Field(0.0, description="lateral [N/m]; inf holds it")
    rotational: RotationalStiffness = Field(0.0, description="[N m/rad]; inf holds the slope")
    axial: AxialStiffness = Field(0.0, description="along the axis [N/m]; inf holds it")
    torsional: RotationalStiffness = Field(
        0.0, description="about the axis [N m/rad]; inf holds it"
    )

    coupling: Annotated[float, Unit("N"), Field(allow_inf_nan=False)] = Field(
        0.0,
        description="K_xtheta, lateral force of a unit slope and moment of a unit displacement "
        "[N], either sign: a pile head, soil",
    )

    @model_validator(mode="after")
    def _check_any(self) -> Self:
        springs = (self.translational, self.rotational, self.axial, self.torsional)
        if not any(springs) and not self.coupling:
            raise ValueError(
                "all stiffnesses are 0; give translational, rotational, axial or torsional, inf "
                "for a support"
            )
        return self

    def attachment(self) -> Spring:
        """Return it as the beam wants it."""
        return Spring(**vars(self))


class PedestalTable(Frozen):
    """A mass between a spring to the beam and one to the ground: `[[beam.pedestals]]`."""

    x: Length = Field(description="station [m]")
    mass: Annotated[Mass, Field(gt=0)] = Field(description="mass [kg]; it moves sideways alone")
    beam_stiffness: Annotated[float, Unit("N/m"), Field(gt=0)] = Field(
        description="of the spring between beam and mass [N/m]"
    )
    ground_stiffness: AxialStiffness = Field(
        0.0, description="of the spring between mass and ground [N/m]; 0: it hangs on the beam"
    )

    def attachment(self) -> Pedestal:
        """Return it as the beam wants it."""
        return Pedestal(**vars(self))


class JointTable(Frozen):
    """An elastic joint in line with the beam: `[[beam.joints]]`."""

    x: Length = Field(description="station inside the span [m]")
    rotational: Annotated[float, Unit("rad/(N m)"), Field(ge=0)] = Field(
        0.0, description="compliance: change of slope over moment [rad/(N m)]"
    )
    axial: Annotated[float, Unit("m/N"), Field(ge=0)] = Field(
        0.0, description="compliance along the axis [m/N]"
    )
    torsional: Annotated[float, Unit("rad/(N m)"), Field(ge=0)] = Field(
        0.0, description="compliance about the axis: change of rotation over torque [rad/(N m)]"
    )

    def attachment(self) -> Joint:
        """Return it as the beam wants it."""
        return Joint(**vars(self))


class DashpotTable(Frozen):
    """Dampers to the ground: `[[beam.dashpots]]`."""

    x: Length = Field(description="station [m]")
    translational: LinearDamping = Field(0.0, description="lateral [N s/m]")
    rotational: RotationalDamping = Field(0.0, description="against the turn [N m s/rad]")
    axial: LinearDamping = Field(0.0, description="along the axis [N s/m]")
    torsional: RotationalDamping = Field(0.0, description="about the axis [N m s/rad]")

    @model_validator(mode="after")
    def _check_any(self) -> Self:
        if not (self.translational or self.rotational or self.axial or self.torsional):
            raise ValueError("all values are 0; give translational, rotational, axial or torsional")
        return self

    def attachment(self) -> Dashpot:
        """Return it as the beam wants it."""
        return Dashpot(**vars(self))


class PointFeedbackTable(Frozen):
    """A force and a moment that oppose motion, not of springs alone: `[[beam.point_feedbacks]]`."""

    x: Length = Field(description="station [m]")
    translational: Annotated[float, Unit("N/m")] = Field(0.0, description="force of Y [N/m]")
    force_of_turn: Force = Field(0.0, description="force of psi [N]")
    moment_of_displacement: Force = Field(0.0, description="moment of Y [N]")
    rotational: Annotated[float, Unit("N m/rad")] = Field(
        0.0, description="moment of psi [N m/rad]"
    )
    translational_damping: Annotated[float, Unit("N s/m")] = Field(
        0.0, description="force of the rate of Y [N s/m]"
    )
    force_of_turn_rate: Annotated[float, Unit("N s")] = Field(
        0.0, description="force of the rate of psi [N s]"
    )
    moment_of_velocity: Annotated[float, Unit("N s")] = Field(
        0.0, description="moment of the rate of Y [N s]"
    )
    rotational_damping: Annotated[float, Unit("N m s/rad")] = Field(
        0.0, description="moment of the rate of psi [N m s/rad]"
    )

    @model_validator(mode="after")
    def _check_any(self) -> Self:
        if not any(value for name, value in vars(self).items() if name != "x"):
            raise ValueError("all values are 0; give at least one stiffness or damping")
        return self

    def attachment(self) -> PointFeedback:
        """Return it as the beam wants it."""
        return PointFeedback(**vars(self))


class PointForceTable(Frozen):
    """An axial force at a station."""

    x: Length = Field(description="station [m]")
    force: Force = Field(description="along +x [N]")


class LoadsTable(Frozen):
    """Axial loads; their N adds to the stations' axial_force: `[beam.loads]`."""

    gravity: Acceleration = Field(
        0.0, description="body force per mass along +x [m/s^2]; -9.80665 for a tower from its base"
    )
    acceleration: Acceleration = Field(
        0.0, description="of the axial supports along +x [m/s^2]; a free beam's follows"
    )
    point_forces: tuple[PointForceTable, ...] = Field((), description="axial forces at stations")
    offset_weight: bool = Field(
        True,
        description="whether weight and inertia of an offset mass act through its centre, and so "
        "bend the beam when it turns",
    )

    def loads(self) -> AxialLoads:
        """Return them as the statics want them."""
        forces = tuple(PointForce(f.x, f.force) for f in self.point_forces)
        return AxialLoads(self.gravity, self.acceleration, forces, self.offset_weight)


class RotationTable(Frozen):
    """Rotation about an axis across the beam, as of a blade: `[beam.rotation]`."""

    rate: Annotated[float, Unit("rad/s"), Field(gt=0)] = Field(
        description="Omega, a text such as '12 rpm' too [rad/s]"
    )
    axis: Length = Field(
        0.0, description="x of the axis [m]; minus the hub's radius of a blade from x = 0"
    )
    plane: Plane = Field(
        "out_of_plane",
        description="of bending: out_of_plane (flap), or in_plane (lag), softer by m Omega^2",
    )

    def rotation(self) -> Rotation:
        """Return it as the statics want it."""
        return Rotation(**vars(self))


class AttachmentTables(Frozen):
    """What a beam carries and how it is loaded; the base of the table `[beam]`."""

    point_masses: tuple[PointMassTable, ...] = Field((), description="rigid masses")
    springs: tuple[SpringTable, ...] = Field((), description="springs and supports to ground")
    pedestals: tuple[PedestalTable, ...] = Field(
        (), description="masses between two springs, to the beam and to the ground"
    )
    joints: tuple[JointTable, ...] = Field((), description="elastic joints in line")
    dashpots: tuple[DashpotTable, ...] = Field(
        (), description="dampers to ground: for responses and complex modes"
    )
    point_feedbacks: tuple[PointFeedbackTable, ...] = Field(
        (), description="forces and moments that oppose motion, of a fluid or a control"
    )
    loads: LoadsTable | None = Field(None, description="axial loads")
    rotation: RotationTable | None = Field(
        None, description="about an axis across the beam: centrifugal force, and softening"
    )

    def attachments(self) -> list[Attachment]:
        """Return all that is attached as the beam wants it."""
        tables: tuple[
            PointMassTable
            | SpringTable
            | PedestalTable
            | JointTable
            | DashpotTable
            | PointFeedbackTable,
            ...,
        ] = (
            *self.point_masses,
            *self.springs,
            *self.pedestals,
            *self.joints,
            *self.dashpots,
            *self.point_feedbacks,
        )
        return [table.attachment() for table in tables]
