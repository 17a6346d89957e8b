"""N from the preload of a deck: its forces and gravity along the axis.

They stand in the subcase that a STATSUB names; in a buckling solution that is the first one. Its
own supports hold the beam meanwhile.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.beam.beam import Beam
from antinode.beam.families import LONGITUDINAL
from antinode.errors import InputError
from antinode.exchange.units import System
from antinode.text import counted

from .attached import ends_of, held_by, inner_supports, place_of
from .cards import Card
from .deck import Deck, Subcase
from .line import Line
from .model import Model
from .passed import LOADS


@dataclass(frozen=True)
class Loads:
    """Forces [file's force] at places, and gravity, along the axis."""

    forces: tuple[tuple[float, float], ...]
    gravity: float


def subcases_of(deck: Deck) -> tuple[Subcase | None, Subcase | None]:
    """Return the subcase of the modes, one with preload before others, and that of its preload."""
    cases = deck.subcases
    modal = [case for case in cases if "METHOD" in case.settings]
    if not modal:
        return (cases[0] if cases else None), None
    loaded = [case for case in modal if "STATSUB" in case.settings]
    chosen = (loaded or modal)[-1]
    if deck.buckles and not loaded:
        return chosen, cases[0]
    if not loaded:
        return chosen, None
    number = chosen.settings["STATSUB"]
    for case in cases:
        if case.number == number:
            return chosen, case
    raise InputError(f"{deck.path}: STATSUB names subcase {number}, which is not there; correct it")


def preloaded(beam: Beam, model: Model, line: Line, static: Subcase, system: System) -> Beam:
    """Return the beam [SI] with the axial force of a subcase.

    Raises
    ------
    InputError
        If the subcase has no load, one that is not along the axis, or nothing to bear it.
    """
    loads = _loads(model, line, static)
    held = held_by(model, line, static.settings.get("SPC"))
    _check_enforced(model, static.settings.get("SPC"))
    last = len(line.x) - 1
    supports = [
        replace(spring, x=spring.x / system.length) for spring in inner_supports(held, line.x)
    ]
    infinite = [item for item in beam.attachments if np.inf in vars(item).values()]
    kept = tuple(item for item in beam.attachments if item not in infinite)
    bare = replace(beam, attachments=kept, ends=ends_of(held, last)).with_attachments(*supports)
    if not _is_borne(bare):
        _check_balance(model, loads, static)
        bare = replace(bare, ends=replace(bare.ends, left_axial="fixed"))
    forces = tuple(PointForce(x / system.length, F / system.force) for x, F in loads.forces)
    gravity = loads.gravity / (system.length / system.time**2)
    under = apply_loads(bare, AxialLoads(gravity, 0.0, forces, offset_weight=False))
    return replace(
        beam.with_breakpoints(under.x.tolist()),
        axial_force=under.axial_force,
        axial_acceleration=under.axial_acceleration,
        offset_weight=not gravity,
    )


def _check_enforced(model: Model, chosen: int | None) -> None:
    """Refuse supports that move, which would load the beam."""
    sets = set() if chosen is None else model.chosen_supports(chosen)
    for number, _, _, card in model.supports:
        if number in sets and card.name == "SPC":
            card.zero((4, 7), "an enforced displacement")


def _is_borne(beam: Beam) -> bool:
    springs = any(item.axial for item in beam.attachments if isinstance(item, Spring))
    return springs or "fixed" in beam.ends.of(LONGITUDINAL)


def _check_balance(model: Model, loads: Loads, static: Subcase) -> None:
    forces = np.array([F for _, F in loads.forces])
    if loads.gravity or abs(float(np.sum(forces))) > 1e-6 * float(np.sum(np.abs(forces))):
        raise InputError(
            f"{model.deck.path}: the forces of subcase {static.number} add up to "
            f"{np.sum(forces):g}, and nothing holds the beam axially; balance them, or hold it"
        )


def _loads(model: Model, line: Line, static: Subcase) -> Loads:
    """Return the loads of a subcase along the axis."""
    path = model.deck.path
    for name in ("TEMP", "DEFORM"):
        if name in static.settings:
            raise InputError(f"{path}: subcase {static.number} has {name}, which is not read")
    if "LOAD" not in static.settings:
        raise InputError(f"{path}: subcase {static.number} has no LOAD, but bears the preload")
    chosen = static.settings["LOAD"]
    shares = _shares(model, chosen)
    _check_others(model, set(shares))
    forces = [
        _force(model, line, card, share)
        for card in model.forces
        if (share := shares.get(card.integer(1), 0.0))
    ]
    gravity = sum(
        shares[card.integer(1)] * _along(model, line, card, None, 3)
        for card in model.loads
        if card.name == "GRAV" and card.integer(1) in shares
    )
    if not any(F for _, F in forces) and not gravity:
        what = counted(0, "FORCE card")
        raise InputError(f"{path}: the load set {chosen} has {what}; N needs some")
    return Loads(tuple(forces), gravity)


def _shares(model: Model, chosen: int) -> dict[int, float]:
    """Return the load sets that one number stands for, with their factors."""
    for card in model.loads:
        if card.name == "LOAD" and card.integer(1) == chosen:
            whole = card.real(2)
            pairs = [i for i in range(3, len(card.fields) + 1, 2) if card.text(i)]
            shares: dict[int, float] = {}
            for i in pairs:
                number = card.integer(i + 1)
                shares[number] = shares.get(number, 0.0) + whole * card.real(i)
            return shares
    return {chosen: 1.0}


def _check_others(model: Model, sets: set[int]) -> None:
    """Refuse loads of the preload that are no forces or gravity."""
    for card in model.deck.cards:
        if card.name in LOADS and card.text(1).isdigit() and card.integer(1) in sets:
            raise card.error(
                "it loads the preload's subcase; FORCE and GRAV along the beam are read"
            )


def _force(model: Model, line: Line, card: Card, share: float) -> tuple[float, float]:
    grid = card.integer(2)
    x, arm = place_of(model, line, grid, card)
    if np.max(np.abs(arm[1:])) > 1e-9 * float(np.ptp(line.x)):
        raise card.error("it acts beside the axis of the beam, which it bends; only N is read")
    return x, share * _along(model, line, card, grid, 4)


def _along(model: Model, line: Line, card: Card, grid: int | None, first: int) -> float:
    """Return the component of a load along the axis, which is all of it."""
    at = np.zeros(3) if grid is None else model.grid(grid, card).at
    axes = model.systems.directions(card.integer(first - 1, 0), at, card)
    given = np.array([card.real(i, 0.0) for i in range(first + 1, first + 4)])
    vector: Array = card.real(first) * given @ axes
    along = float(vector @ line.frame[0])
    if np.linalg.norm(vector - along * line.frame[0]) > 1e-9 * np.linalg.norm(vector):
        raise card.error("it is no force along the beam; a preload is N alone: remove it")
    return along
