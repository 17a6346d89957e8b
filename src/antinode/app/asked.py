"""Which response the page shows: a force, an output, damping, a band, and defaults of all."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field

from antinode.beam.beam import Beam
from antinode.beam.families import tells
from antinode.errors import InputError
from antinode.inputs.units import Frozen, Length, Number, Unit
from antinode.modes.hertz import hertz
from antinode.response.damping import Damping
from antinode.response.quantities import (
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


class Asked(Frozen):
    """A force and what is followed of it; None is left to the page."""

    force_x: Length | None = None
    direction: Direction = "lateral"
    amplitude: Annotated[Number, _Positive] = 1.0
    output_x: Length | None = None
    quantity: QuantityName = "acceleration"
    loss_factor: Annotated[Number, Field(ge=0, lt=10)] = 0.02
    low: Annotated[float, Unit("Hz"), _Positive] | None = None
    high: Annotated[float, Unit("Hz"), _Positive] | None = None


class Wanted(NamedTuple):
    """The same for one beam, complete.

    Attributes
    ----------
    force : Force
    amplitude : float
        [N] or [N m].
    output : Output
    damping : Damping
    low, high : float
        [Hz].
    """

    force: Force
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
    force, output = Force(at, asked.direction), Output(seen, asked.quantity, along)
    check_places(beam, (force,), (output,))
    if output.family != family_of(asked.direction).name:
        raise InputError(
            f"a force along '{asked.direction}' makes no {asked.quantity.replace('_', ' ')}; "
            "choose another direction or quantity"
        )
    return Wanted(force, asked.amplitude, output, Damping(asked.loss_factor), low, high)


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
