"""Mass and stiffness along the elements of a deck, in units of the file.

`EI = E I`, `EA = E A`, `m = rho A + NSM`.
"""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array

from .line import Line, left_end
from .model import Element, Model, Section


def tables_of(model: Model, line: Line, plane: int) -> tuple[dict[str, Array], Array]:
    """Return the properties on intervals, and the breakpoints."""
    x, rows = [line.x[:1]], []
    for k, element in enumerate(line.elements):
        table = section_rows(model, element, plane)
        if left_end(element, line.node) != element.left:
            table = np.column_stack([1 - table[::-1, 0], table[::-1, 1:]])
        x.append(line.x[k] + (line.x[k + 1] - line.x[k]) * table[1:, 0])
        rows.append(np.stack([table[:-1, 1:], table[1:, 1:]], axis=2))
    m, EI, EA = np.concatenate(rows).transpose(1, 0, 2)
    tables = {"mass_per_length": m * model.mass_factor, "bending_stiffness": EI}
    if np.all(EA > 0):
        tables["axial_stiffness"] = EA
    return tables, np.concatenate(x)


def section_rows(model: Model, element: Element, plane: int) -> Array:
    """Return fraction, m, EI and EA along an element, in units of the file."""
    section = _section(model, element)
    if section.material not in model.materials:
        raise section.card.error(f"there is no MAT1 {section.material}")
    E, rho = model.materials[section.material]
    fraction, area, inertia_1, inertia_2, nsm = section.rows.T
    EI = E * (inertia_1 if plane == 1 else inertia_2)
    mass = rho * area + nsm
    for what, values in ((f"I{plane} times E", EI), ("mass per length", mass)):
        if not np.all(values > 0) or not np.all(np.isfinite(values)):
            raise section.card.error(f"{what} is {np.min(values):g}; it must be positive")
    return np.stack([fraction, mass, EI, E * area], axis=1)


def _section(model: Model, element: Element) -> Section:
    if element.prop not in model.sections:
        raise element.card.error(f"there is no PBAR or PBEAM {element.prop}")
    return model.sections[element.prop]
