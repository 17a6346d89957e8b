"""What can be asked of a response, and what drives it: names, components of states, units.

Every output is a component of the state of one family of modes, or its derivative in time:
``d/dt -> i omega``, with time as ``exp(+i omega t)``. Forces go along displacements; a force along
an axis or about it drives the family that moves so.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Literal, NamedTuple, get_args

from antinode.arguments import choice, numbers
from antinode.beam.attachments import Dashpot, PointFeedback, Spring
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, Family, FamilyName, tells
from antinode.errors import InputError

Direction = Literal["lateral", "moment", "axial", "torsional"]
Side = Literal["left", "right"]
QuantityName = Literal[
    "displacement",
    "velocity",
    "acceleration",
    "slope",
    "angular_velocity",
    "angular_acceleration",
    "bending_moment",
    "shear_force",
    "axial_force",
    "torque",
    "reaction",
    "reaction_moment",
]


class _Kind(NamedTuple):
    """Where a quantity is found: a direction by which its family goes, if it has only one."""

    direction: Direction | None
    component: int
    rate: int


_KINDS: dict[str, _Kind] = {
    "displacement": _Kind(None, 0, 0),
    "velocity": _Kind(None, 0, 1),
    "acceleration": _Kind(None, 0, 2),
    "slope": _Kind("lateral", 1, 0),
    "angular_velocity": _Kind("lateral", 1, 1),
    "angular_acceleration": _Kind("lateral", 1, 2),
    "bending_moment": _Kind("lateral", 2, 0),
    "shear_force": _Kind("lateral", 3, 0),
    "axial_force": _Kind("axial", 1, 0),
    "torque": _Kind("torsional", 1, 0),
    "reaction": _Kind(None, -1, 0),
    "reaction_moment": _Kind("lateral", -2, 0),
}
_MOTION = ("displacement", "velocity", "acceleration")


@cache
def family_of(direction: str) -> Family:
    """Return the family that a force along a direction drives."""
    return next(family for family in FAMILIES.values() if direction in family.directions)


@dataclass(frozen=True)
class Output:
    """One number to follow: a quantity at a station.

    Parameters
    ----------
    x : float
        Station [m].
    quantity : str
        displacement, velocity, acceleration (of a direction); slope, angular_velocity,
        angular_acceleration, bending_moment, shear_force (Q_y, in the fixed direction);
        axial_force (compression positive); torque; reaction and reaction_moment: what springs,
        dashpots and supports at the station do to the beam.
    direction : {"lateral", "axial", "torsional"}
        For displacement, velocity, acceleration, reaction.
    side : {"left", "right"}
        Where something sits at the station: left or right of it. At an end always the beam's side.
    relative : bool
        Whether motion is measured from the moving supports.
    """

    x: float
    quantity: QuantityName
    direction: Direction = "lateral"
    side: Side = "left"
    relative: bool = False

    def __post_init__(self) -> None:
        choice("the quantity of an output", self.quantity, QuantityName)
        choice("the direction of an output", self.direction, Direction)
        choice("the side of an output", self.side, Side)
        if self.direction == "moment":
            raise InputError("an output along 'moment' is written as quantity = 'slope'")

    @property
    def family(self) -> FamilyName:
        """The family of modes that it belongs to."""
        return family_of(_KINDS[self.quantity].direction or self.direction).name

    @property
    def rate(self) -> int:
        """How many times the component is differentiated in time."""
        return _KINDS[self.quantity].rate

    @property
    def component(self) -> int:
        """Component of the state; -1 and -2: what the ground does along a displacement."""
        return _KINDS[self.quantity].component

    @property
    def moves(self) -> bool:
        """Whether it is a motion along the first displacement, as that of supports is."""
        return self.quantity in _MOTION

    @property
    def unit(self) -> str:
        """Its SI unit."""
        family = FAMILIES[self.family]
        if self.component < 0:
            return family.quantities[self.component].unit
        return family.quantities[self.component].unit + ("", "/s", "/s^2")[self.rate]

    @property
    def name(self) -> str:
        """How it is called in tables and figures."""
        family = FAMILIES[self.family]
        along = "" if family.rotary or _KINDS[self.quantity].direction else f"{self.direction} "
        what = self.quantity.replace("_", " ")
        side = ", right side" if self.side == "right" else ""
        return f"{along}{what} at {self.x:.6g} m{side}{', relative' if self.relative else ''}"


@dataclass(frozen=True)
class Force:
    """A unit force, or moment, at a station, or along a part of the beam.

    Parameters
    ----------
    x : float
        Station [m].
    direction : {"lateral", "axial", "torsional", "moment"}
        Up is positive; along +x; about +x; a moment that raises psi.
    to : float, optional
        Where a force that is spread evenly ends [m]; it starts at `x`. Its size is per length.
    """

    x: float
    direction: Direction = "lateral"
    to: float | None = None

    def __post_init__(self) -> None:
        choice("the direction of a force", self.direction, Direction)
        if self.to is not None and self.direction == "moment":
            raise InputError("a moment acts at one station: remove 'to'")

    @property
    def family(self) -> FamilyName:
        """The family of modes that it drives."""
        return family_of(self.direction).name

    @property
    def unit(self) -> str:
        """SI unit of its size."""
        family = FAMILIES[self.family]
        unit = family.quantities[-1 - family.directions.index(self.direction)].unit
        if self.to is None:
            return unit
        return "N" if unit == "N m" else "N/m"

    @property
    def name(self) -> str:
        """How it is called."""
        word = "moment" if self.direction == "moment" else f"{self.direction} force"
        if self.to is not None:
            return f"{word} from {self.x:.6g} to {self.to:.6g} m"
        return f"{word} at {self.x:.6g} m"


@dataclass(frozen=True)
class Base:
    """Supports that all move alike: ends, springs, dashpots, foundation.

    Parameters
    ----------
    direction : {"lateral", "axial", "torsional"}
    motion : {"acceleration", "velocity", "displacement"}
        What of it is given.
    """

    direction: Direction = "lateral"
    motion: Literal["acceleration", "velocity", "displacement"] = "acceleration"

    def __post_init__(self) -> None:
        choice("the direction of [base]", self.direction, Direction)
        choice("the motion of [base]", self.motion, Literal[*_MOTION])
        if self.direction == "moment":
            raise InputError("[base] moves along lateral, axial or torsional, not along 'moment'")

    @property
    def family(self) -> FamilyName:
        """The family of modes that it drives."""
        return family_of(self.direction).name

    @property
    def rate(self) -> int:
        """How many times the displacement is differentiated to what is given."""
        return _MOTION.index(self.motion)

    @property
    def unit(self) -> str:
        """SI unit of its size."""
        return Output(0.0, self.motion, self.direction).unit

    @property
    def name(self) -> str:
        """How it is called."""
        return f"{self.direction} {self.motion} of the supports"


Drive = Force | Base


def check_places(beam: Beam, drives: tuple[Drive, ...], outputs: tuple[Output, ...]) -> None:
    """Raise InputError where something is off the beam, or of a family that it has not."""
    low, high = float(beam.x[0]), float(beam.x[-1])
    untold = [family for family in FAMILIES if not tells(beam, family)]
    for item in (*drives, *outputs):
        if item.family in untold:
            family = FAMILIES[item.family]
            absent = [name for name in family.tables if getattr(beam, name) is None]
            raise InputError(
                f"{_called(item)}: the beam has no {' and no '.join(absent)}; add the column to "
                "its stations, or ask for another direction"
            )
        if isinstance(item, Base) and not _is_held(beam, item):
            raise InputError(
                f"{_called(item)}: nothing holds this beam along '{item.direction}', so that they "
                "move nothing: hold it by its ends, a spring, a dashpot or a foundation, or give "
                "[[forces]]"
            )
        places = [item.x] if isinstance(item, Output) else _places(item)
        for x in places:
            if not low - 1e-9 * (high - low) <= x <= high + 1e-9 * (high - low):
                raise InputError(
                    f"{_called(item)}: {x:.10g} m is off the beam, which runs from {low:.10g} to "
                    f"{high:.10g} m"
                )
        if isinstance(item, Force) and item.to is not None and not item.to > item.x:
            raise InputError(f"{_called(item)}: it must end behind its start; exchange x and to")


def _called(item: Drive | Output) -> str:
    """Return how messages call a drive or an output."""
    return f"the output '{item.name}'" if isinstance(item, Output) else item.name


def _is_held(beam: Beam, base: Base) -> bool:
    """Tell whether the ground moves a beam, be it by a dashpot alone."""
    lateral, foundation = base.direction == "lateral", beam.foundation_stiffness
    ends = (beam.ends.left, beam.ends.right) if lateral else beam.ends.of(base.family)
    names = ("translational", "coupling") if lateral else (base.direction,)
    grounded = [i for i in beam.attachments if isinstance(i, Spring | Dashpot)]
    return (
        any(end in ("clamped", "pinned", "fixed") for end in ends)
        or any(getattr(item, name, 0.0) for item in grounded for name in names)
        or (lateral and any(isinstance(i, PointFeedback) for i in beam.attachments))
        or (lateral and foundation is not None and bool(foundation.any()))
    )


def _places(drive: Drive) -> list[float]:
    if isinstance(drive, Base):
        return []
    return [drive.x] if drive.to is None else [drive.x, drive.to]


def stations_of(drives: tuple[Drive, ...], outputs: tuple[Output, ...]) -> list[float]:
    """Return all stations at which something acts or is asked for [m]."""
    return sorted({x for d in drives for x in _places(d)} | {o.x for o in outputs})


def frequencies(values: object) -> tuple[float, ...]:
    """Return frequencies as floats, or raise InputError [Hz]."""
    array = numbers("frequency_hz", values)
    return tuple(array.ravel().tolist())


DIRECTIONS: tuple[str, ...] = get_args(Direction)
