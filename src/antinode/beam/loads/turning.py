"""Loads along a beam that turn with its section: what they add to N, and who refuses them.

`tangential_load` t is the part of ``dN/dx`` [N/m], along +x, that turns with the section: a
stream along a hull, jets along a pipe. Across the axis t cancels what N leaves by growing,
``Q' = m omega^2 Y + t psi``; loads that keep their direction, weight and inertia, are not in it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam import curves
from antinode.beam.attachments import refuse_feedback
from antinode.beam.families import FAMILIES, FamilyName
from antinode.errors import InputError

from .axial_supports import axial_supports

if TYPE_CHECKING:
    from antinode.beam.beam import Beam


def _integrals(beam: Beam) -> Array:
    """Return the control values of the integral from the left end of each interval [N]."""
    assert beam.tangential_load is not None
    return curves.integral(beam.tangential_load) * np.diff(beam.x)[:, None]


def turning_load(beam: Beam) -> float:
    """Return the sum of the loads that turn [N]."""
    return float(np.sum(_integrals(beam)[:, -1])) if beam.loads_turn else 0.0


def turning_load_left(beam: Beam, interval: Integers, fraction: Array) -> Array:
    """Return the sum of these loads left of places inside intervals [N]."""
    if not beam.loads_turn:
        return np.zeros(np.shape(fraction))
    own = _integrals(beam)
    before = np.append(0.0, np.cumsum(own[:, -1]))
    return np.asarray(before[interval] + curves.value(own[interval], fraction))


def with_their_force(beam: Beam) -> Beam:
    """Return the beam with N of its loads that turn, and what holds it axially, or its inertia.

    Raises
    ------
    InputError
        If it is held axially at several places, so that EA would share the load.
    """
    own = _integrals(beam)
    total = float(np.sum(own[:, -1]))
    held = np.flatnonzero(axial_supports(beam))
    if len(held) > 1:
        raise InputError(
            f"{beam.name}: tangential_load acts on a beam that is held axially at "
            f"{len(held)} places; give the axial_force that follows, or hold one of them "
            "(left_axial, right_axial)"
        )
    reaction = np.zeros(len(beam.x))
    reaction[held] = -total
    before = np.append(0.0, np.cumsum(own[:, -1])[:-1]) + np.cumsum(reaction)[:-1]
    force = curves.total(beam.axial_force, own + before[:, None])
    body = 0.0 if len(held) else -total / beam.mass
    return replace(beam, axial_force=force, axial_acceleration=beam.axial_acceleration + body)


def refuse_complex(beam: Beam, family: FamilyName, what: str) -> None:
    """Raise InputError if what acts on a beam leaves it no energy, for something that needs one."""
    refuse_feedback(beam.attachments, family, what)
    if FAMILIES[family].law.has_axial_force:
        refuse_turning(beam, what)


def refuse_turning(beam: Beam, what: str) -> None:
    """Raise InputError if loads along a beam turn with its section."""
    if beam.loads_turn:
        raise InputError(
            f"{beam.name}: tangential_load turns with the section, and {what} know nothing of it; "
            "solve_modes, or the commands modes, beam and stability, give complex modes with it; "
            "or remove the column"
        )
