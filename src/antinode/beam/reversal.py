"""A beam read from its other end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.errors import InputError

from .attachments import Attachment, Joint, PointFeedback, PointMass, Spring, beside_joints
from .checks import TABLES

if TYPE_CHECKING:
    from .beam import Beam


def reversed_beam(beam: Beam) -> Beam:
    """Return the beam read from the other end; see `Beam.reversed`."""
    if beam.axial_acceleration:
        raise InputError("a beam under acceleration cannot be reversed: tabulate N(x) instead")
    sides = beside_joints(beam.attachments)
    return _turned(_with_sides(beam, sides) if sides else beam)


def _with_sides(beam: Beam, joints: Sequence[float]) -> Beam:
    """Return the beam with what moves with the left side of joints just left of them."""
    gap = 64 * np.finfo(float).eps * max(abs(beam.x[0]), abs(beam.x[-1]))
    moved = {x: x - gap for x in joints}
    items = (
        item if isinstance(item, Joint) else replace(item, x=moved.get(item.x, item.x))
        for item in beam.attachments
    )
    return replace(beam.cut_at(list(moved.values())), attachments=tuple(items))


def _turned(beam: Beam) -> Beam:
    flip: dict[str, Any] = {
        name: None if (v := getattr(beam, name)) is None else v[::-1, ::-1].copy()
        for name in TABLES
    }
    if beam.tangential_load is not None:
        flip["tangential_load"] = -flip["tangential_load"]
    total = beam.x[-1] + beam.x[0]
    items: list[Attachment] = []
    for item in beam.attachments:
        turned = replace(item, x=total - item.x)
        if isinstance(turned, PointMass):
            turned = replace(turned, offset=-turned.offset)
        elif isinstance(turned, Spring):
            turned = replace(turned, coupling=-turned.coupling)
        elif isinstance(turned, PointFeedback):
            turned = replace(
                turned,
                force_of_turn=-turned.force_of_turn,
                moment_of_displacement=-turned.moment_of_displacement,
                force_of_turn_rate=-turned.force_of_turn_rate,
                moment_of_velocity=-turned.moment_of_velocity,
            )
        items.append(turned)
    return replace(
        beam,
        x=total - beam.x[::-1],
        ends=beam.ends.reversed(),
        end_force=None if beam.end_force is None else beam.end_force[::-1],
        attachments=tuple(items[::-1]),
        drawing=beam.drawing and beam.drawing.reversed(),
        **flip,
    )
