"""Which response the page shows: a force, an output, damping, a band, and defaults of all."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from antinode.beam.beam import Beam
from antinode.beam.families import tells
from antinode.errors import InputError
from antinode.inputs.units import Frozen, Length, Number, Unit
from antinode.modes.hertz import hertz
from antinode.response.damping import Damping, Rayleigh
from antinode.response.quantities import (
    Base,
    Direction,
    Force,
    Output,
    QuantityName,
    check_places,
    family_of,
)

from .quick import Quick

_FORCE, _SEEN = 0.8, 0.3
"""Where along the beam the force acts and the output is, unless told."""
_BELOW, _ABOVE = 0.3, 1.15
"""Ends of the band over the lowest and the highest frequency shown, unless told."""
_Positive = Field(gt=0, lt=1e12)


Drives = Literal["force", "base"]
DampingName = Literal["loss_factor", "modal", "rayleigh"]


class Asked(Frozen):
    """What drives, what is followed of it, what loses energy; None is left to the page."""

    drive: Drives = "force"
    force_x: Length | None = None
    direction: Direction = "lateral"
    amplitude: Annotated[Number, _Positive] = 1.0
    output_x: Length | None = None
    quantity: QuantityName = "acceleration"
    damping: DampingName = "loss_factor"
    loss_factor: Annotated[Number, Field(ge=0, lt=10)] = 0.02
    ratio: Annotated[Number, Field(gt=0, lt=10)] = 0.01
    low: Annotated[float, Unit("Hz"), _Positive] | None = None
    high: Annotated[float, Unit("Hz"), _Positive] | None = None


class Wanted(NamedTuple):
    """The same for one beam, complete.

    Attributes
    ----------
    drive : Force or Base
        Of supports their acceleration.
    amplitude : float
        [N], [N m] or [m/s^2].
    output : Output
    damping : Damping
        By a loss factor, or a viscous ratio: of all modes, or by mass and stiffness at both ends
        of the band.
    low, high : float
        [Hz].
    """

    drive: Force | Base
    amplitude: float
    output: Output
    damping: Damping
    low: float
    high: float


def wanted(asked: Asked, beam: Beam, first: Quick) -> Wanted:
    """Return what is asked of a beam.

    Parameters
    ----------
    asked : Asked
    beam : Beam
    first : Quick
        Modes of the file as it was opened: the band stays while a slider moves.

    Raises
    ------
    InputError
        If a place is off the beam, a column is missing, the force does not move the output, or the
        band is empty.
    """
    low, high = _band(asked, first)
    start, length = float(beam.x[0]), beam.length
    at, seen = (
        float(f"{start + share * length:.3g}") if x is None else x
        for x, share in ((asked.force_x, _FORCE), (asked.output_x, _SEEN))
    )
    along = "lateral" if asked.direction == "moment" else asked.direction
    drive: Force | Base = Force(at, asked.direction)
    if asked.drive == "base":
        drive = Base(asked.direction)
    output = Output(seen, asked.quantity, along)
    check_places(beam, (drive,), (output,))
    if output.family != family_of(asked.direction).name:
        raise InputError(
            f"what drives along '{asked.direction}' makes no {asked.quantity.replace('_', ' ')}; "
            "choose another direction or quantity"
        )
    return Wanted(drive, asked.amplitude, output, _damping(asked, low, high), low, high)


def _damping(asked: Asked, low: float, high: float) -> Damping:
    if asked.damping == "modal":
        return Damping(modal=(asked.ratio,))
    if asked.damping == "rayleigh":
        return Damping(rayleigh=Rayleigh.fitted((asked.ratio, asked.ratio), (low, high)))
    return Damping(asked.loss_factor)


def directions(beam: Beam) -> list[Direction]:
    """Return the directions in which a force moves a beam."""
    every: tuple[Direction, ...] = ("lateral", "moment", "axial", "torsional")
    return [way for way in every if tells(beam, family_of(way).name)]


def _band(asked: Asked, first: Quick) -> tuple[float, float]:
    found = hertz(np.abs(first.omega2))
    found = found[found > 0]
    low = asked.low or float(f"{_BELOW * found[0]:.2g}")
    high = asked.high or float(f"{_ABOVE * found[-1]:.2g}")
    if not low < high:
        raise InputError(f"the band from {low:g} to {high:g} Hz is empty; give the lower end first")
    return low, high
