"""What a beam must keep to, row by row."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from antinode.arguments import choice
from antinode.arrays import Array, Interpolation
from antinode.errors import InputError

from .attachments import (
    check_attachments,
    check_pedestals,
    check_supports_apart,
    held_places,
)
from .ends import check_follower
from .families import FAMILIES, FamilyName
from .stations import check_stations

if TYPE_CHECKING:
    from .beam import Beam

Theory = Literal["euler_bernoulli", "timoshenko"]
ShearForm = Literal["haringx", "engesser"]


def check(beam: Beam) -> None:
    """Raise InputError unless shapes agree, x rises, and every property is in its range."""
    n = len(beam.x) - 1
    check_stations(beam.x)
    choice("interpolation", beam.interpolation, Interpolation)
    choice("shear_form", beam.shear_form, ShearForm)
    if beam.theory is not None:
        choice("theory", beam.theory, Theory)
    _check_rising(beam.x)
    for name in TABLES:
        values = getattr(beam, name)
        if values is not None:
            if not (name == "foundation_stiffness" and beam.rotation is not None):
                _check_table(name, values, n)
            _check_logarithm(beam, name, values)
    _check_complete(beam)
    check_shear(beam)
    if beam.attachments:
        check_attachments(beam.attachments, beam.x, softened=beam.rotation is not None)
        _check_supports(beam)
    if any(beam.ends.follow):
        _check_followers(beam)
    for item in beam.attachments:
        if np.min(np.abs(beam.x - item.x)) > 1e-9 * beam.length:
            raise InputError(
                f"no breakpoint at x = {item.x:g} m, where something is attached; "
                "use Beam.with_attachments"
            )


def _check_rising(x: Array) -> None:
    rises = x[1:] > x[:-1]
    if np.count_nonzero(rises) == len(rises) and x[0] > -np.inf and x[-1] < np.inf:
        return
    if not np.isfinite(x).all():
        raise InputError("x: every breakpoint must be a finite number [m]")
    k = int(np.argmin(rises))
    raise InputError(
        f"x must increase from row to row: row {k + 2} has {x[k + 1]:g} m "
        f"after {x[k]:g} m in row {k + 1}"
    )


def _check_complete(beam: Beam) -> None:
    """Refuse one column of a family without the other, but for what every beam has."""
    own = vars(beam)
    for name, family in FAMILIES.items():
        absent = [table for table in family.tables if own[table] is None]
        if not absent:
            continue
        there = [table for table in family.tables if table not in (*absent, *_ALWAYS)]
        if there:
            raise InputError(
                f"{there[0]} is given, but {absent[0]} is missing: {name} modes need both; give "
                "both, or neither"
            )


_ALWAYS = "mass_per_length", "axial_force"


def _check_supports(beam: Beam) -> None:
    """Refuse a support that all but coincides with an end which is held, or with another one."""
    ends = zip((beam.ends.left, beam.ends.right), beam.x[[0, -1]].tolist(), strict=True)
    held = [x for end, x in ends if end in ("pinned", "clamped")]
    check_supports_apart([*held, *held_places(beam.attachments)], beam.x)
    check_pedestals(beam.attachments, held)


def _check_followers(beam: Beam) -> None:
    """Refuse a force that follows an end which a support holds."""
    held = held_places(beam.attachments)
    for side, share, x in zip(("left", "right"), beam.ends.follow, beam.x[[0, -1]], strict=True):
        if share and any(abs(place - x) <= 1e-9 * beam.length for place in held):
            check_follower(f"{side}_follower", share, "held by a support")


def _check_table(name: str, values: Array, n: int) -> None:
    if values.ndim != 2 or len(values) != n or values.shape[1] < 2:
        raise InputError(
            f"{name} has shape {values.shape}; {n} intervals need shape ({n}, 2), or ({n}, p + 1) "
            "for the control values of polynomials"
        )
    least = -np.inf if name in _SIGNED else 0.0
    lowest, highest = np.minimum.reduce(values, None), np.maximum.reduce(values, None)
    if least < lowest and highest < np.inf:  # no NaN: every table may have these
        return
    ok = allowed_values(name, values)
    for row, side in () if ok.all() else np.argwhere(~ok)[:1]:
        wanted = ALLOWED.get(name, "positive and finite")
        raise InputError(f"{name} must be {wanted}: interval {row + 1} has {values[row, side]:g}")
    if name in _MAY_BE_INFINITE:
        for row in np.flatnonzero(np.isinf(values[:, 0]) != np.isinf(values[:, -1]))[:1]:
            raise InputError(
                f"{name} runs from {values[row, 0]:g} to {values[row, -1]:g} in interval "
                f"{row + 1}: give inf at both ends of an interval (two rows at one x are a jump), "
                "or at neither"
            )


def _check_logarithm(beam: Beam, name: str, values: Array) -> None:
    if beam.interpolation == "log" and name in LOGARITHMIC and values.shape[1] > 2:
        raise InputError(
            f"{name} has shape {values.shape}, control values of polynomials, but the "
            "interpolation is 'log': use 'linear'"
        )


TABLES = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "axial_force",
    "radius_of_gyration",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
    "foundation_stiffness",
    "added_mass_per_length",
    "loss_factor",
    "tangential_load",
)

_MAY_BE_ZERO = (
    "rotary_inertia_per_length",
    "foundation_stiffness",
    "added_mass_per_length",
    "loss_factor",
)
_MAY_BE_INFINITE = ("shear_stiffness",)
_SIGNED = "axial_force", "tangential_load"
ALLOWED = {
    **dict.fromkeys(_SIGNED, "finite"),
    **dict.fromkeys(_MAY_BE_ZERO, "zero or positive, and finite"),
    **dict.fromkeys(_MAY_BE_INFINITE, "positive, or inf"),
}
"""What the values of a table may be where it is not "positive and finite"."""


def allowed_values(name: str, values: Array) -> npt.NDArray[np.bool_]:
    """Tell which values a table of this name may have."""
    if name in _MAY_BE_INFINITE:
        return np.asarray(values > 0)
    finite = np.isfinite(values)
    if name in _SIGNED:
        return finite
    return np.asarray(finite & ((values >= 0) if name in _MAY_BE_ZERO else (values > 0)))


def check_shear(beam: Beam) -> None:
    """Raise InputError where the axial force is beyond what the stiffness in shear can bear.

    Engesser's form needs N < kGA, Haringx' kGA + N > 0: there a short piece of the beam, sheared,
    gives way of itself.
    """
    if beam.shear_stiffness is None or not beam.has_shear:
        return
    k = np.arange(len(beam.x) - 1)[:, None]
    N = beam.axial_force_at(k, np.linspace(0.0, 1.0, 3))
    kGA = beam.column_at("shear_stiffness", k, np.linspace(0.0, 1.0, 3))
    engesser = beam.shear_form == "engesser"
    bad = kGA <= N if engesser else kGA + N <= 0
    for row, at in () if not bad.any() else np.argwhere(bad)[:1]:
        form = "N < kGA in Engesser's form" if engesser else "kGA + N > 0 in Haringx' form"
        raise InputError(
            f"axial_force is {N[row, at]:.4g} N in interval {row + 1}, where shear_stiffness is "
            f"{kGA[row, at]:.4g} N; {form} of shear: check the units of both, or set "
            f"shear_form = '{'haringx' if engesser else 'engesser'}'"
        )


LOGARITHMIC = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "torsional_stiffness",
    "shear_stiffness",
)
"""Those that vary exponentially where the interpolation is "log"; the others vary linearly."""


def varying(beam: Beam, name: FamilyName) -> npt.NDArray[np.bool_]:
    """Tell for each interval of a beam whether anything that a family sees varies inside it."""
    family = FAMILIES[name]
    accelerates = family.law.has_axial_force and beam.axial_acceleration != 0.0
    found = np.full(len(beam.x) - 1, accelerates)
    lossy = () if beam.loss_factor is None else (beam.loss_factor,)
    columns = (given(beam, name, column) for column in family.law.columns)
    for table in (*columns, *(getattr(beam, more) for more in family.used(beam)), *lossy):
        differs = table[:, 1:] != table[:, :1]
        found |= differs[:, 0] if differs.shape[1] == 1 else np.any(differs, axis=1)
    found.flags.writeable = False
    return found


def given(beam: Beam, name: FamilyName, column: str) -> Array:
    """Return the beam's table for a column of a family's law, or say that it is missing."""
    family = FAMILIES[name]
    values: Array | None = getattr(beam, family.columns[column])
    if values is None:
        raise InputError(
            f"{family.columns[column]} is missing: {name} modes need {family.symbol} and "
            f"{family.columns['mass']} at every station"
        )
    return values
