"""What a beam must keep to, row by row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError

from .attachments import check_attachments, check_supports_apart, held_places

if TYPE_CHECKING:
    from .beam import Beam


def check(beam: Beam) -> None:
    """Raise InputError unless shapes agree, x rises, and every property is in its range."""
    n = len(beam.x) - 1
    if n < 1:
        raise InputError(f"a beam needs at least two breakpoints x; received {n + 1}")
    if not np.isfinite(beam.x).all():
        raise InputError("x: every breakpoint must be a finite number [m]")
    rises = beam.x[1:] > beam.x[:-1]
    for k in () if rises.all() else np.flatnonzero(~rises)[:1]:
        raise InputError(
            f"x must increase from row to row: row {k + 2} has {beam.x[k + 1]:g} m "
            f"after {beam.x[k]:g} m in row {k + 1}"
        )
    for name in TABLES:
        values = getattr(beam, name)
        if values is not None:
            _check_table(name, values, n)
    if beam.attachments:
        check_attachments(beam.attachments, beam.x)
        _check_supports(beam)
    for item in beam.attachments:
        if np.min(np.abs(beam.x - item.x)) > 1e-9 * beam.length:
            raise InputError(
                f"no breakpoint at x = {item.x:g} m, where something is attached; "
                "use Beam.with_attachments"
            )


def _check_supports(beam: Beam) -> None:
    """Refuse a support that all but coincides with an end which is held, or with another one."""
    ends = zip((beam.ends.left, beam.ends.right), beam.x[[0, -1]].tolist(), strict=True)
    held = [x for end, x in ends if end in ("pinned", "clamped")]
    check_supports_apart([*held, *held_places(beam.attachments)], beam.x)


def _check_table(name: str, values: Array, n: int) -> None:
    if values.shape != (n, 2):
        raise InputError(f"{name} has shape {values.shape}; {n} intervals need shape ({n}, 2)")
    ok = np.isfinite(values) if name == "axial_force" else np.isfinite(values) & (values > 0)
    if ok.all():
        return
    for row, side in np.argwhere(~ok)[:1]:
        allowed = "finite" if name == "axial_force" else "positive and finite"
        raise InputError(f"{name} must be {allowed}: interval {row + 1} has {values[row, side]:g}")


TABLES = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "axial_force",
    "radius_of_gyration",
)


def given(values: Array | None) -> Array:
    """Return the axial stiffness, or say that it is missing."""
    if values is None:
        raise InputError("axial_stiffness is missing: longitudinal modes need EA [N]")
    return values
