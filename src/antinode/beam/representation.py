"""How a beam becomes a chain: steps, and two uniform half-segments for each."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from antinode.arrays import Array, Integers
from antinode.riccati.chain import Chain

from . import curves
from .checks import given
from .families import FAMILIES, FamilyName
from .profile import AT_START

if TYPE_CHECKING:
    from .beam import Beam

GAUSS = 0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6
NEAR, FAR = 0.5 + np.sqrt(3) / 3, 0.5 - np.sqrt(3) / 3
_STEEPEST = 4.0  # ratio of a property across one step (averages stay positive up to 13.9)
_LONGEST = 1 / 16  # share of one step in the waves along the beam
_MOST_HALVINGS = 40
LIMITS = _STEEPEST, _LONGEST, _MOST_HALVINGS
"""What the coarsest steps keep to: `riccati.lanes` makes the same ones."""


def halved(values: Array) -> Array:
    """Return means on the two halves of steps, from values at their Gauss points, (..., 2)."""
    first, last = values[..., 0], values[..., 1]
    return np.stack([NEAR * first + FAR * last, FAR * first + NEAR * last], axis=-1)


def copies(times: Integers) -> tuple[Integers, Integers]:
    """Return, for entry k repeated ``times[k]`` times, every copy's k and its number from 0."""
    index = np.repeat(np.arange(len(times)), times)
    return index, np.arange(len(index)) - (np.cumsum(times) - times)[index]


Values = Callable[[Integers | slice, Array], Array]
"""Of a property inside intervals, at fractions of their lengths."""


def make_chain(
    beam: Beam, family: FamilyName, refinement: int = 1, loss: float | None = None
) -> Chain:
    """Represent a beam by uniform segments: `Beam.chain`.

    With a `loss` factor, which adds to the beam's own, the columns are complex: every stiffness
    times ``1 + i loss``.
    """
    varies = beam.varies(family)
    law, values = FAMILIES[family].law, _values(beam, family, loss)
    if not varies.any():
        columns = {name: np.array(at(np.s_[:], AT_START)) for name, at in values.items()}
        left, right, points = beam.points(family)
        length = beam.x[1:] - beam.x[:-1]
        return Chain(law, length, columns, left, right, points, beam.following(family))
    cell, start, size = coarsest_steps(beam, family)
    times = np.where(varies[cell], refinement, 1)
    which, number = copies(times)
    interval, size = cell[which], (size / times)[which]
    start = start[which] + number * size
    halves = np.where(varies[interval], 2, 1)
    step, second = copies(halves)

    def average(values: Values) -> Array:
        """Return weighted means of the values at the Gauss points, one for each segment."""
        at_points = np.stack([values(interval, start + size * g) for g in GAUSS], axis=-1)
        return np.asarray(halved(at_points)[step, second])

    first = np.concatenate([[0], np.cumsum(np.bincount(interval[step]))])
    length = (np.diff(beam.x)[interval] * size / halves)[step]
    EI = values.pop("stiffness")
    flexibility = average(lambda k, t: 1.0 / EI(k, t))
    columns = {name: average(of) for name, of in values.items()} | {"stiffness": 1.0 / flexibility}
    left, right, points = beam.points(family, first)
    return Chain(law, length, columns, left, right, points, beam.following(family))


def _values(beam: Beam, family: FamilyName, loss: float | None = None) -> dict[str, Values]:
    """Return what the columns of a chain are inside intervals, by their names."""

    def table(name: str) -> Values:
        return lambda k, t: beam.column_at(name, k, t)

    def stiff(name: str) -> Values:
        if loss is None:
            return table(name)
        return lambda k, t: beam.column_at(name, k, t) * (1 + 1j * (loss + own_loss(beam, k, t)))

    entry, force = FAMILIES[family], beam.axial_force_at
    for name in entry.law.columns:
        given(beam, family, name)
    values = {name: table(column) for name, column in entry.columns.items()}
    values["stiffness"] = stiff(entry.columns["stiffness"])
    if entry.law.has_axial_force:
        values["axial_force"] = force
    used = entry.used(beam)
    if "added_mass_per_length" in used:
        own, added = values["mass"], table("added_mass_per_length")
        values["mass"] = lambda k, t: own(k, t) + added(k, t)
    if "foundation_stiffness" in used:
        values["foundation"] = table("foundation_stiffness")
    if "tangential_load" in used and beam.loads_turn:
        values["tangential"] = table("tangential_load")
    if "rotary_inertia_per_length" in used:
        values["rotary_inertia"] = table("rotary_inertia_per_length")
    elif "radius_of_gyration" in used:
        m, r = table("mass_per_length"), table("radius_of_gyration")
        values["rotary_inertia"] = lambda k, t: m(k, t) * r(k, t) ** 2
    if "shear_stiffness" in used:
        values |= _shear(stiff("shear_stiffness"), force, beam.shear_form == "engesser")
    return values


def own_loss(beam: Beam, interval: Integers | slice, fraction: Array) -> Array:
    """Return the beam's own loss factor inside intervals; zero where none is given."""
    if beam.loss_factor is None:
        return np.zeros(())
    return beam.column_at("loss_factor", interval, fraction)


def _shear(stiffness: Values, force: Values, engesser: bool) -> dict[str, Values]:
    """Return s, sN and sN^2 of Haringx' form; Engesser's kGA is one that is smaller by N."""

    def flexibility(k: Integers | slice, t: Array) -> Array:
        kGA = stiffness(k, t)
        rigid = np.isinf(kGA)
        soft = np.where(rigid, 1.0, kGA - (force(k, t) if engesser else 0.0))
        return np.asarray(np.where(rigid, 0.0, 1.0 / soft))

    return {
        "shear": flexibility,
        "shear_turn": lambda k, t: flexibility(k, t) * force(k, t),
        "shear_work": lambda k, t: flexibility(k, t) * force(k, t) ** 2,
    }


def _over(beam: Beam, name: str, interval: Integers | slice, start: Array, size: Array) -> Array:
    """Return values between which a column stays in steps: at their ends, or control values."""
    table = getattr(beam, name)
    if table.shape[1] > 2:
        return curves.part(table[interval], start, start + size)
    sides = (beam.column_at(name, interval, start + side * size) for side in (0.0, 1.0))
    return np.stack(list(sides), axis=-1)


def coarsest_steps(
    beam: Beam, family: FamilyName, longest: float = _LONGEST
) -> tuple[Integers, Array, Array]:
    """Divide intervals in which something varies until no step is long or steep.

    `longest` is the share of one step in the waves along the beam, at most.

    Returns
    -------
    interval, start, size : array
        Of every step; start and size as fractions of the interval's length.
    """
    interval = np.arange(len(beam.x) - 1)
    start, size = np.zeros(len(interval)), np.ones(len(interval))
    columns, power = FAMILIES[family].columns, FAMILIES[family].law.power
    varies = beam.varies(family)
    tables = [columns["mass"], columns["stiffness"], *FAMILIES[family].steep(beam)]
    for _ in range(_MOST_HALVINGS):
        parts = [_over(beam, name, interval, start, size) for name in tables]
        steepest = np.max([_ratio(np.min(p, axis=-1), np.max(p, axis=-1)) for p in parts], axis=0)
        mass, stiffness = (np.sqrt(p[:, 0] * p[:, -1]) for p in parts[:2])
        phase = (mass / stiffness) ** (1 / power) * np.diff(beam.x)[interval] * size
        coarse = (steepest > _STEEPEST) | (phase > longest * np.sum(phase))
        pieces = np.where(coarse & varies[interval], 2, 1)
        if np.all(pieces == 1):
            break
        which, second = copies(pieces)
        interval, size = interval[which], (size / pieces)[which]
        start = start[which] + second * size
    return interval, start, size


def _ratio(a: Array, b: Array) -> Array:
    """Return the larger over the smaller of two numbers, which may be infinite both."""
    with np.errstate(invalid="ignore"):
        return np.where(a == b, 1.0, np.maximum(a / b, b / a))
