"""A beam from a NASTRAN deck: elements along one line, its masses, springs, joints and preload.

The beam bends in plane 1 of its elements (I1) or in plane 2 (I2). Supports and springs count in
this plane, along the axis, and about it.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.exchange.units import SI, System
from antinode.text import counted, short

from .attached import attachments_of, axial_force_of_strings, ends_of, inner_supports
from .deck import Subcase, read_deck
from .line import Line, line_of
from .lumped import ADDED, FOUNDATION, INERTIA, ROTARY, lumps_of
from .model import Model
from .preload import preloaded, subcases_of
from .properties import notes_of, tables_of, theory_of
from .sorting import passed_notes, read_model
from .torsion import GJ, missing, without


def read_nastran(
    path: Path, system: System = SI, plane: int = 1, elements: tuple[range, ...] = ()
) -> tuple[Beam, tuple[str, ...]]:
    """Read a beam from a NASTRAN file.

    Parameters
    ----------
    path : Path
    system : System
        Units of the file.
    plane : {1, 2}
        In which the beam bends: that of I1, or of I2.
    elements : tuple of range
        Numbers of those that make up the beam; empty for all.

    Returns
    -------
    Beam
        SI.
    tuple of str
        What was left out.

    Raises
    ------
    InputError
        If it is no beam, or has a card that is not understood.
    """
    deck = read_deck(path)
    model = read_model(deck, elements)
    line = line_of(model, plane)
    modal, static = subcases_of(deck)
    beam, no_torsion = _beam(model, line, modal, plane, system)
    beam = replace(beam, name=path.stem[:200] or "beam")
    if static:
        beam = preloaded(beam, model, line, static, system)
    strings = axial_force_of_strings(model, line)
    if np.any(strings):
        beam = _under(beam, line, strings, system)
    if beam.shear_stiffness is not None and not beam.is_unloaded:
        beam = replace(beam, shear_form="engesser")  # as the elements of solvers have it
    _pass_unused_supports(model, modal, static)
    notes = (
        *_notes(model, modal, static, system),
        *model.notes,
        *notes_of(model, line, no_torsion, beam.theory),
        *passed_notes(model),
    )
    return beam, notes


def _beam(
    model: Model, line: Line, modal: Subcase | None, plane: int, system: System
) -> tuple[Beam, str | None]:
    """Return the beam without axial force, and why it has no torsion, if it has none."""
    tables, x = tables_of(model, line, plane)
    lumps = lumps_of(model, line, tables)
    for name, table in lumps.spread(line, x).items():
        tables[name] = table * (1.0 if name == FOUNDATION else model.mass_factor)
    items, held = attachments_of(model, line, modal, lumps)
    no_torsion = missing(line, tables, held, items)
    if no_torsion:
        tables = {name: tables[name] for name in tables if name not in (GJ, INERTIA)}
        held, items = without(held, items)
    ends = ends_of(held, len(line.x) - 1)
    if not np.any(tables.get(ROTARY, 0.0)):
        tables.pop(ROTARY, None)
    tapered = any(np.any(t[:, :-1] != t[:, 1:]) for t in tables.values())
    columns: dict[str, Any] = {n: table / _unit(n, system) for n, table in tables.items()}
    beam = Beam(
        x / system.length,
        ends=replace(ends, left_torsion=None, right_torsion=None) if no_torsion else ends,
        interpolation="linear" if tapered else "step",
        theory=None if ROTARY in lumps.at else theory_of(line, model, tables),
        **columns,
    )
    own = (_in_si(item, system) for item in (*items, *inner_supports(held, line.x)))
    return beam.with_attachments(*own), no_torsion


def _under(beam: Beam, line: Line, strings: Array, system: System) -> Beam:
    """Return the beam under N of its elements as well [file's force]."""
    middles = (beam.x[1:] + beam.x[:-1]) / 2 * system.length
    N = strings[np.searchsorted(line.x, middles) - 1] / system.force
    return replace(beam, axial_force=beam.axial_force + N[:, None])


def _unit(name: str, system: System) -> float:
    """Return how many units of the file make up an SI unit of a column."""
    return {
        "mass_per_length": system.mass / system.length,
        "bending_stiffness": system.force * system.length**2,
        "axial_stiffness": system.force,
        GJ: system.force * system.length**2,
        INERTIA: system.mass * system.length,
        ROTARY: system.mass * system.length,
        "shear_stiffness": system.force,
        ADDED: system.mass / system.length,
        FOUNDATION: system.force / system.length**2,
        "loss_factor": 1.0,
    }[name]


def _in_si(item: Attachment, system: System) -> Attachment:
    length, mass, force = system.length, system.mass, system.force
    x = item.x / length
    if isinstance(item, PointMass):
        square = mass * length**2
        turning, polar = item.rotary_inertia / square, item.polar_inertia / square
        return PointMass(x, item.mass / mass, turning, item.offset / length, polar)
    if isinstance(item, Spring):
        k = length / force
        turning, twisting = (v / (force * length) for v in (item.rotational, item.torsional))
        return Spring(x, item.translational * k, turning, item.axial * k, twisting)
    assert isinstance(item, Joint)  # decks give no others
    turning, twisting = (v * force * length for v in (item.rotational, item.torsional))
    return Joint(x, turning, item.axial * force / length, twisting)


def _pass_unused_supports(model: Model, modal: Subcase | None, static: Subcase | None) -> None:
    """Count supports of sets that nothing chooses, where a case control could."""
    if modal is None:
        return
    cases = [modal] if static is None else [modal, static]
    numbers = [case.settings["SPC"] for case in cases if "SPC" in case.settings]
    used = set[int]().union(*(model.chosen_supports(number) for number in numbers))
    unused = {id(card): card.name for number, _, _, card in model.supports if number not in used}
    model.passed.update(unused.values())


def _notes(
    model: Model, modal: Subcase | None, static: Subcase | None, system: System
) -> tuple[str, ...]:
    notes = [f"NASTRAN has no units: {system.words} are taken (--units)"]
    if modal is not None and len(model.deck.subcases) > 1:
        count = counted(len(model.deck.subcases), "subcase")
        notes.append(f"of {count}, {modal.number} is read")
    if not model.deck.whole:
        notes.append(
            "there is no ENDDATA at the end of the file: if it was cut off, cards are missing"
        )
    if model.deck.missing:
        names = ", ".join(short(name) for name in model.deck.missing)
        notes.append(f"files included before the bulk data are not there: {names}")
    if model.forces and not static:
        notes.append("FORCE cards are left out: no subcase of modes has a STATSUB")
    return tuple(notes)
