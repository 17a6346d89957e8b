"""Mass and stiffness along the elements of a deck, in units of the file.

`EI = E I`, `EA = E A`, `m = rho A + NSM`, `GJ = G J`, `rho I_p = rho (I1 + I2) + NSI`,
`kGA = K G A`, and with it the rotary inertia `rho I`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from antinode.arrays import Array
from antinode.beam.checks import Theory
from antinode.errors import InputError

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
    m, EI, EA, GJ, inertia, kGA, rotary, loss = np.concatenate(rows).transpose(1, 0, 2)
    m = _with_mass(model, line, m)
    tables = {"mass_per_length": m * model.mass_factor, "bending_stiffness": EI}
    if np.all(EA > 0):
        tables["axial_stiffness"] = EA
    tables["torsional_stiffness"] = GJ
    tables["polar_inertia_per_length"] = inertia * model.mass_factor
    if np.any(np.isfinite(kGA)):
        tables["shear_stiffness"] = kGA
        if np.any(rotary):
            tables["rotary_inertia_per_length"] = rotary * model.mass_factor
    if np.any(loss > 0):
        tables["loss_factor"] = loss
    _check_product(model, line)
    return tables, np.concatenate(x)


def section_rows(model: Model, element: Element, plane: int) -> tuple[Array, Array]:
    """Return fractions of an element, and m, EI, EA, GJ, rho I_p, kGA, rho I and loss there."""
    own = section(model, element)
    if own.material not in model.materials:
        raise own.card.error(f"there is no MAT1 {own.material}")
    material, columns = model.materials[own.material], own.columns
    EI = material.E * columns[f"I{plane}"]
    mass = material.rho * columns["A"] + columns["NSM"]
    for what, values, ok in (
        (f"I{plane} times E", EI, EI > 0),
        ("mass per length", mass, mass >= 0),
    ):
        if not np.all(ok) or not np.all(np.isfinite(values)):
            raise own.card.error(f"{what} is {np.min(values):g}; it must be positive")
    GJ = material.G * columns["J"]
    inertia = material.rho * (columns["I1"] + columns["I2"]) + columns["NSI"]
    shear = material.G * columns["A"] * columns[f"K{plane}"]
    kGA = np.where(shear > 0, shear, np.inf)
    rotary, loss = material.rho * columns[f"I{plane}"], np.full(len(EI), material.loss)
    rows = mass, EI, material.E * columns["A"], GJ, inertia, kGA, rotary, loss
    return own.at, np.stack(rows, axis=1)


def theory_of(line: Line, model: Model, tables: Mapping[str, Array]) -> Theory | None:
    """Return the theory that the deck asks for; None for what the columns say.

    Shear counts where a card gives K1 or K2 itself; by NASTRAN's defaults it only stands there.
    """
    own = [section(model, element) for element in line.elements]
    if "shear_stiffness" not in tables or any(s.shear for s in own):
        return None
    return "euler_bernoulli"


LIGHT = 1e-9
"""Of the masses at the grids: what bars weigh that have no mass of their own."""


def _with_mass(model: Model, line: Line, m: Array) -> Array:
    """Return mass per length; next to none of the masses at the grids where bars have none.

    Raises
    ------
    InputError
        If there is no mass at the grids either.
    """
    bare = m <= 0
    if not np.any(bare):
        return m
    lumped = sum(card.real(4, 0.0) for card in model.masses)
    if not lumped > 0:
        weightless = min(
            (section(model, element) for element in line.elements), key=_mass_of_section(model)
        )
        raise weightless.card.error(
            "mass per length is 0, and no CONM2 has a mass; it must be positive: give RHO on its "
            "MAT1, or NSM"
        )
    model.notes.append(
        f"bars without mass weigh {LIGHT:g} of the CONM2 here; modes beyond the number of masses "
        "mean nothing"
    )
    return np.where(bare, LIGHT * lumped / float(np.ptp(line.x)), m)


def _mass_of_section(model: Model) -> Callable[[Section], float]:
    def mass(own: Section) -> float:
        rho = model.materials[own.material].rho
        return float(np.min(rho * own.columns["A"] + own.columns["NSM"]))

    return mass


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
    try:
        axial, lateral, rotational, _ = line.freedoms(grid, own.card)
    except InputError:
        return False
    out = {str(6 - axial - lateral), str(lateral + 3)}
    return rotational > 0 and out <= set(own.held)


def notes_of(
    model: Model, line: Line, no_torsion: str | None, shear: Theory | None
) -> tuple[str, ...]:
    """Say what of the sections is left out, torsion with the reason."""
    own = [section(model, element) for element in line.elements]
    notes = {note: None for s in own for note in s.notes}
    if shear == "euler_bernoulli":
        notes[
            "shear (K1, K2): no card gives it, so that kGA and rho I stand there and do not count; "
            "--set beam.theory=timoshenko counts them"
        ] = None
    if no_torsion:
        notes[f"torsion: {no_torsion}"] = None
    said: tuple[str, ...] = (f"left out: {'; '.join(notes)}",) if notes else ()
    if no_torsion is None and any(element.card.name == "CBAR" for element in line.elements):
        said += ("rho (I1 + I2) is the polar inertia of the bars; a CBAR has none in most solvers",)
    return said
