"""Torsion of a deck: whether the beam has it, and why not."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Joint, Pedestal, PointFeedback, PointMass, Spring

from .line import SAME, Line
from .lumped import INERTIA

GJ = "torsional_stiffness"


def missing(
    line: Line,
    tables: Mapping[str, Array],
    held: Mapping[int, set[str]],
    items: Sequence[Attachment],
) -> str | None:
    """Say why the beam has no torsion; None where it has."""
    if not np.all(tables[GJ] > 0):
        return "J, or G, is not known of all elements"
    if all("torsional" in held.get(k, ()) for k in range(len(line.x))):
        return "freedom 4 is held at every grid"
    if not np.all(tables[INERTIA] > 0):
        return "rho (I1 + I2) is zero, and no massless CONM2 at every grid stands for it"
    if any(np.max(np.abs(arm)) > SAME * np.ptp(line.x) for arm in line.arms.values()):
        return "grids beside the axis couple it to bending"
    if any(isinstance(item, Joint) and math.isinf(item.torsional) for item in items):
        return "the two grids of a joint are not joined in it"
    return None


def without(
    held: Mapping[int, set[str]], items: Sequence[Attachment]
) -> tuple[dict[int, set[str]], list[Attachment]]:
    """Return supports and attachments without what acts in torsion alone."""
    kept = {node: names - {"torsional"} for node, names in held.items() if names != {"torsional"}}
    bare = [_bare(item) for item in items]
    return kept, [item for item in bare if any(v for n, v in vars(item).items() if n != "x")]


def _bare(item: Attachment) -> Attachment:
    if isinstance(item, PointMass):
        return replace(item, polar_inertia=0.0)
    if isinstance(item, Spring):
        return replace(item, torsional=0.0)
    return item if isinstance(item, PointFeedback | Pedestal) else replace(item, torsional=0.0)
