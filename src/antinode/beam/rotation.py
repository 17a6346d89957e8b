"""A beam that rotates about an axis across it, as a blade does: centrifugal force and softening.

At the rate Omega about an axis at x_a the body force m Omega^2 (x - x_a) along +x makes N,
``dN/dx = m Omega^2 (x - x_a)``. In the plane of rotation it turns with the displacement: its
lateral part m Omega^2 Y is that of a foundation of the stiffness -m Omega^2. Out of the plane it
keeps its direction. Left out are Coriolis forces, which couple bending and stretching, and rho I
Omega^2, by which sections that turn out of the plane soften a beam of Timoshenko.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from . import curves
from .attachments import PointMass, Spring, refuse_pedestals
from .beam import Beam
from .loads.axial_supports import axial_supports

Plane = Literal["in_plane", "out_of_plane"]


@dataclass(frozen=True)
class Rotation:
    """A rotation about an axis across the beam.

    Parameters
    ----------
    rate : float
        Omega [rad/s].
    axis : float
        Where the axis stands [m], on the beam or beside it: minus the hub's radius for a blade
        whose root is at x = 0.
    plane : {"in_plane", "out_of_plane"}
        Of bending: lag, or flap.
    """

    rate: float
    axis: float = 0.0
    plane: Plane = "out_of_plane"


def apply_rotation(beam: Beam, rotation: Rotation) -> Beam:
    """Return the beam with the centrifugal N and, in the plane of rotation, the softening.

    Both are exact: polynomials where m is one.

    Raises
    ------
    InputError
        If not exactly one place holds the beam axially, a point mass is beside its station, or m
        varies exponentially.
    """
    _check(beam, rotation)
    refuse_pedestals(beam.attachments, "beams that rotate")
    square = rotation.rate**2
    arm = np.stack([beam.x[:-1], beam.x[1:]], axis=1) - rotation.axis
    pull = square * curves.product(beam.mass_per_length, arm)
    carried = np.diff(beam.x)[:, None] * curves.integral(pull)
    masses = [item for item in beam.attachments if isinstance(item, PointMass)]
    forces = np.zeros(len(beam.x))
    for item in masses:
        node = int(np.argmin(np.abs(beam.x - item.x)))
        forces[node] += item.mass * square * (item.x - rotation.axis)
    total = float(np.sum(carried[:, -1]) + np.sum(forces))
    forces[int(np.flatnonzero(axial_supports(beam))[0])] -= total
    before = np.concatenate([[0.0], np.cumsum(carried[:-1, -1])])
    N = carried + (before + np.cumsum(forces)[:-1])[:, None]
    force = curves.total(beam.axial_force, N)
    if rotation.plane == "out_of_plane":
        return replace(beam, axial_force=force, rotation=rotation)
    softer = -square * beam.mass_per_length
    if beam.foundation_stiffness is not None:
        softer = curves.total(beam.foundation_stiffness, softer)
    springs = (Spring(item.x, translational=-square * item.mass) for item in masses)
    items = (*beam.attachments, *springs)
    return replace(
        beam,
        axial_force=force,
        foundation_stiffness=softer,
        attachments=items,
        rotation=rotation,
    )


def at_rest(beam: Beam) -> Beam:
    """Return a rotating beam without what `apply_rotation` added to it."""
    if beam.rotation is None:
        return beam
    kept = tuple(
        item
        for item in beam.attachments
        if not (isinstance(item, Spring) and item.translational < 0)
    )
    still = replace(
        beam.without_axial_force(), attachments=kept, rotation=None, foundation_stiffness=None
    )
    added = apply_rotation(still, beam.rotation)
    k = beam.foundation_stiffness
    if added.foundation_stiffness is not None and k is not None:
        k = _without_rounding(curves.total(k, -added.foundation_stiffness), k)
    N = curves.total(beam.axial_force, -added.axial_force)
    N = _without_rounding(N, beam.axial_force)
    return replace(
        still,
        axial_force=N,
        axial_acceleration=beam.axial_acceleration,
        foundation_stiffness=None if k is None or not np.any(k) else k,
    )


def _without_rounding(table: Array, whole: Array) -> Array:
    """Return a difference as the straight line that it was, zero where that is its rounding."""
    size = 1e-12 * np.max(np.abs(whole))
    ends = np.where(np.abs(table[:, [0, -1]]) > size, table[:, [0, -1]], 0.0)
    return np.asarray(ends)


def _check(beam: Beam, rotation: Rotation) -> None:
    held = np.count_nonzero(axial_supports(beam))
    if held != 1:
        raise InputError(
            f"{held} places hold the rotating beam axially; centrifugal forces need exactly one: "
            "set left_axial or right_axial of its ends"
        )
    for item in beam.attachments:
        if isinstance(item, PointMass) and item.offset:
            raise InputError(
                f"the point mass at x = {item.x:g} m has an offset of {item.offset:g} m; on a "
                "rotating beam its centre must stand at its station"
            )
    if beam.interpolation == "log" and _varies(beam.mass_per_length):
        raise InputError(
            "interpolation = 'log' on a rotating beam: its centrifugal force is no polynomial; use "
            "'linear', with more rows"
        )


def _varies(table: Array) -> bool:
    return bool(np.any(table != table[:, :1]))
