"""From a drawing to a `Beam`: dimensions of the section along it, and a material.

steel = Material(youngs_modulus="210 GPa", density=7850)
tower = drawn_beam([0, 30, 80], steel, outer_diameter=[4, 4, 2.5], wall=[0.04, 0.03, 0.02])
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import choice, wanted
from antinode.arrays import Array, Interpolation
from antinode.beam import curves
from antinode.beam.beam import Beam
from antinode.beam.checks import TABLES, ShearForm, Theory
from antinode.beam.ends import FREE, Ends
from antinode.beam.profile import interval_ends, kept_intervals
from antinode.beam.stations import as_column, check_stations, column_of_rows
from antinode.errors import InputError
from antinode.text import nearest

from .drawing import PROPERTIES, Drawing
from .material import Material
from .shapes import DIMENSIONS
from .table import LOG_OF_DIMENSIONS, drawing_of

OTHERS = tuple(name for name in TABLES if name not in (*PROPERTIES, "radius_of_gyration"))
"""Columns of a beam that do not follow from its section."""


def drawn_beam(
    x: npt.ArrayLike,
    material: Material,
    *,
    interpolation: Interpolation = "linear",
    ends: Ends = FREE,
    theory: Theory | None = None,
    shear_form: ShearForm = "haringx",
    name: str = "beam",
    **columns: npt.ArrayLike,
) -> Beam:
    """Build a beam from its drawing.

    Parameters
    ----------
    x : array_like, shape (n + 1,)
        Stations [m]; two rows at one x are a jump, unless "step".
    material : Material
    interpolation : {"step", "linear"}
        How the dimensions run between stations; mass and stiffness are what follows from them
        everywhere, so that a straight diameter makes no straight EI.
    ends, theory, shear_form, name
        As they are of the beam; Timoshenko's theory is the default, since shear and rotary inertia
        follow from the section.
    **columns : array_like, shape (n + 1,), or float
        `outer_diameter` and `wall` of a tube [m], solid without `wall`; `width`, `height` along Y,
        and `wall` of a box; or `area` [m^2], `second_moment` [m^4] and, where they are known,
        `shear_area`, `polar_moment` and `torsion_constant` of any other section. Besides, columns
        that follow from no section: `axial_force` [N] and others of `Beam`.

    Raises
    ------
    InputError
        If the dimensions make no section.

    Examples
    --------
    >>> rod = drawn_beam([0, 2], Material(youngs_modulus=210e9, density=7850), outer_diameter=0.02)
    >>> round(rod.mass, 4)
    4.9323
    """
    wanted("the material", material, Material, "Material(youngs_modulus='210 GPa', density=7850)")
    stations = np.atleast_1d(as_column("x", x))
    drawing, others = _read(stations, columns, material, interpolation)
    own = drawing.columns
    tables: dict[str, Any] = own.tables | {
        n: on_parts(drawing.x, table, own.x) for n, table in others.items()
    }
    return Beam(
        own.x,
        **tables,
        interpolation=interpolation,
        ends=ends,
        theory=theory,
        shear_form=shear_form,
        name=name,
        drawing=drawing,
    )


def _read(
    x: Array, columns: Mapping[str, npt.ArrayLike], material: Material, how: Interpolation
) -> tuple[Drawing, dict[str, Array]]:
    """Return the drawing of a table of stations, and its other columns at ends of intervals."""
    check_stations(x)
    choice("interpolation", how, Interpolation)
    if how == "log":
        raise InputError(LOG_OF_DIMENSIONS)
    allowed = (*DIMENSIONS, *OTHERS)
    for key in columns:
        if key not in allowed:
            raise InputError(f"unknown column {key}; {nearest(key, allowed)}")
    given = {key: column_of_rows(key, v, len(x), how) for key, v in columns.items()}
    dimensions = {key: given.pop(key) for key in list(given) if key in DIMENSIONS}
    try:
        drawing = drawing_of(x, dimensions, material, how)
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(error)) from error
    kept = kept_intervals(x, how)
    return drawing, {key: interval_ends(column, kept, how) for key, column in given.items()}


def on_parts(x: Array, table: Array, finer: Array) -> Array:
    """Return a table (n, p + 1) on breakpoints `finer`, which are those of `x` and more."""
    k = np.clip(np.searchsorted(x, (finer[1:] + finer[:-1]) / 2) - 1, 0, len(x) - 2)
    size = np.diff(x)[k]
    return curves.part(table[k], (finer[:-1] - x[k]) / size, (finer[1:] - x[k]) / size)
