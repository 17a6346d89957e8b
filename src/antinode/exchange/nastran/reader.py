"""A beam from a NASTRAN deck: elements along one line, its masses, springs, joints and preload.

The beam bends in plane 1 of its elements (I1) or in plane 2 (I2). Supports and springs count in
this plane and along the axis.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from antinode.beam.attachments import Attachment, Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.exchange.units import SI, System

from .attached import attachments_of, ends_of, inner_supports
from .cards import Subcase, read_deck
from .line import line_of
from .model import Model, read_model
from .preload import preload_of, subcases_of
from .properties import tables_of


def read_nastran(path: Path, system: System = SI, plane: int = 1) -> tuple[Beam, tuple[str, ...]]:
    """Read a beam from a NASTRAN file.

    Parameters
    ----------
    path : Path
    system : System
        Units of the file.
    plane : {1, 2}
        In which the beam bends: that of I1, or of I2.

    Returns
    -------
    Beam
        SI.
    tuple of str
        What was left out or assumed.

    Raises
    ------
    InputError
        If a card is not understood, or the elements make up no straight beam.
    """
    deck = read_deck(path)
    model = read_model(deck)
    line = line_of(model, plane)
    modal, static = subcases_of(deck.subcases, path)
    tables, x = tables_of(model, line, plane)
    attachments, held = attachments_of(model, line, modal)
    N = preload_of(model, line, static) if static else np.zeros(len(line.elements))
    tapered = any(np.any(t[:, 0] != t[:, 1]) for t in tables.values())
    k = np.searchsorted(line.x, (x[1:] + x[:-1]) / 2) - 1
    tables["axial_force"] = np.repeat(N[k][:, None], 2, axis=1)
    tables = {name: table / _unit(name, system) for name, table in tables.items()}
    beam = Beam(
        x / system.length,
        tables["mass_per_length"],
        tables["bending_stiffness"],
        tables.get("axial_stiffness"),
        tables["axial_force"],
        ends=ends_of(held, len(line.x) - 1),
        interpolation="linear" if tapered else "step",
        name=path.stem[:200] or "beam",
    )
    supports = inner_supports(held, line.x)
    items = [_in_si(item, system) for item in (*attachments, *supports)]
    return beam.with_attachments(*items), _notes(model, static, system)


def _unit(name: str, system: System) -> float:
    """Return how many units of the file make up an SI unit of a column."""
    return {
        "mass_per_length": system.mass / system.length,
        "bending_stiffness": system.force * system.length**2,
        "axial_stiffness": system.force,
        "axial_force": system.force,
    }[name]


def _in_si(item: Attachment, system: System) -> Attachment:
    length, mass, force = system.length, system.mass, system.force
    x = item.x / length
    if isinstance(item, PointMass):
        inertia = item.rotary_inertia / (mass * length**2)
        return PointMass(x, item.mass / mass, inertia, item.offset / length)
    if isinstance(item, Spring):
        k = length / force
        turning = item.rotational / (force * length)
        return Spring(x, item.translational * k, turning, item.axial * k)
    return Joint(x, item.rotational * force * length, item.axial * force / length)


def _notes(model: Model, static: Subcase | None, system: System) -> tuple[str, ...]:
    notes = [f"NASTRAN has no units: {system.words} are taken (--units)"]
    if model.sheared:
        notes.append("shear factors K1, K2 are left out: the beam is one of Euler and Bernoulli")
    if model.forces and not static:
        notes.append("FORCE cards are left out: no subcase of modes has a STATSUB")
    return tuple(notes)
