"""Mass and stiffness along the elements of a deck, in units of the file.

`EI = E I`, `EA = E A`, `m = rho A + NSM`, `GJ = G J`, `rho I_p = rho (I1 + I2) + NSI`.
"""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array

from .line import Line, left_end, section
from .model import Element, Model
from .sections import Section


def tables_of(model: Model, line: Line, plane: int) -> tuple[dict[str, Array], Array]:
    """Return the properties on intervals, and the breakpoints."""
    x, rows = [line.x[:1]], []
    for k, element in enumerate(line.elements):
        fraction, table = section_rows(model, element, plane)
        if left_end(element, line.node) != element.left:
            fraction, table = 1 - fraction[::-1], table[::-1]
        x.append(line.x[k] + (line.x[k + 1] - line.x[k]) * fraction[1:])
        rows.append(np.stack([table[:-1], table[1:]], axis=2))
    m, EI, EA, GJ, inertia = np.concatenate(rows).transpose(1, 0, 2)
    tables = {"mass_per_length": m * model.mass_factor, "bending_stiffness": EI}
    if np.all(EA > 0):
        tables["axial_stiffness"] = EA
    tables["torsional_stiffness"] = GJ
    tables["polar_inertia_per_length"] = inertia * model.mass_factor
    _check_product(model, line)
    return tables, np.concatenate(x)


def section_rows(model: Model, element: Element, plane: int) -> tuple[Array, Array]:
    """Return fractions of an element, and m, EI, EA, GJ and rho I_p there."""
    own = section(model, element)
    if own.material not in model.materials:
        raise own.card.error(f"there is no MAT1 {own.material}")
    material, columns = model.materials[own.material], own.columns
    EI = material.E * columns[f"I{plane}"]
    mass = material.rho * columns["A"] + columns["NSM"]
    for what, values in ((f"I{plane} times E", EI), ("mass per length", mass)):
        if not np.all(values > 0) or not np.all(np.isfinite(values)):
            raise own.card.error(
                f"{what} is {np.min(values):g}; it must be positive{_HINTS.get(what, '')}"
            )
    GJ = material.G * columns["J"]
    inertia = material.rho * (columns["I1"] + columns["I2"]) + columns["NSI"]
    return own.at, np.stack([mass, EI, material.E * columns["A"], GJ, inertia], axis=1)


_HINTS = {"mass per length": ": give RHO on its MAT1, or NSM"}


def _check_product(model: Model, line: Line) -> None:
    """Refuse sections that bend out of the plane, unless every grid is held in it."""
    skew = next((s for e in line.elements if _is_skew(s := section(model, e))), None)
    if skew is None or all(_held_in_plane(line, grid) for grid in line.node):
        return
    raise skew.card.error(
        "its product of inertia I12 bends the beam out of the plane; that is read only where every "
        "GRID holds displacement and rotation out of the plane for good"
    )


def _is_skew(own: Section) -> bool:
    return bool(np.any(np.abs(own.columns["I12"]) > 1e-9 * own.columns["I1"]))


def _held_in_plane(line: Line, grid: int) -> bool:
    own = line.grids[grid]
    axial, lateral, rotational, _ = line.freedoms(grid, own.card)
    out = {str(6 - axial - lateral), str(lateral + 3)}
    return rotational > 0 and out <= set(own.held)


def notes_of(model: Model, line: Line, no_torsion: str | None) -> tuple[str, ...]:
    """Say what of the sections is left out, torsion with the reason."""
    own = [section(model, element) for element in line.elements]
    notes = {note: None for s in own for note in s.notes}
    if any(any(s.shear) for s in own):
        notes["shear (K1, K2): the beam is one of Euler and Bernoulli"] = None
    if no_torsion:
        notes[f"torsion: {no_torsion}"] = None
    return (f"left out: {'; '.join(notes)}",) if notes else ()
