"""N from the preload of a deck.

It follows from the forces along the axis of the subcase that a STATSUB names: the bar under them,
solved for its displacement u, has `N = -EA u'`, compression positive.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.text import counted

from .attached import held_by, is_joint, joints_of, spring_of
from .cards import Subcase
from .line import Line
from .model import Model
from .properties import section_rows


def subcases_of(subcases: tuple[Subcase, ...], path: Path) -> tuple[Subcase | None, Subcase | None]:
    """Return the subcase of the modes, one with preload before others, and that of its preload."""
    modal = [case for case in subcases if "METHOD" in case.settings]
    if not modal:
        return (subcases[0] if subcases else None), None
    loaded = [case for case in modal if "STATSUB" in case.settings]
    chosen = (loaded or modal)[-1]
    if not loaded:
        return chosen, None
    number = chosen.settings["STATSUB"]
    for case in subcases:
        if case.number == number:
            return chosen, case
    raise InputError(f"{path}: STATSUB names subcase {number}, which is not there; correct it")


def preload_of(model: Model, line: Line, static: Subcase) -> Array:
    """Return N in every element, compression positive, in units of the file."""
    if "LOAD" not in static.settings:
        raise InputError(f"{model.deck.path}: subcase {static.number} has no LOAD, but a STATSUB")
    k = _axial_stiffness(model, line)
    forces, held = (
        _axial_forces(model, line, static.settings["LOAD"]),
        held_by(model, line, static.settings.get("SPC")),
    )
    fixed = [node for node, names in held.items() if "axial" in names]
    n = len(line.x)
    diagonal = np.zeros(n)
    diagonal[:-1] += k
    diagonal[1:] += k
    grounded = False
    for item in (spring_of(line, c) for c in model.springs if not is_joint(line, c)):
        if item.axial:
            diagonal[int(np.argmin(np.abs(line.x - item.x)))] += item.axial
            grounded = True
    if not fixed and not grounded:
        _check_balance(model, forces, static)
        fixed = [0]
    u = _displacement(diagonal, k, forces, fixed)
    return np.asarray(-k * np.diff(u))


def _check_balance(model: Model, forces: Array, static: Subcase) -> None:
    if abs(float(np.sum(forces))) > 1e-6 * float(np.sum(np.abs(forces))):
        raise InputError(
            f"{model.deck.path}: the forces of subcase {static.number} add up to "
            f"{np.sum(forces):g}, and nothing holds the beam axially; balance them, or hold it"
        )


def _axial_stiffness(model: Model, line: Line) -> Array:
    """Return the stiffness of every element as a bar, with the joint on its right."""
    compliance = np.zeros(len(line.elements))
    for i, element in enumerate(line.elements):
        fraction, _, _, EA = section_rows(model, element, 1).T
        if not np.all(EA > 0):
            raise element.card.error("its section has no area A, which the preload needs")
        size = (line.x[i + 1] - line.x[i]) * np.diff(fraction)
        ratio = np.log(EA[1:] / EA[:-1])
        mean = np.where(ratio == 0, 1.0, np.expm1(ratio) / np.where(ratio == 0, 1.0, ratio))
        compliance[i] = np.sum(size / (EA[:-1] * mean))
    for joint in joints_of(model, line):
        compliance[int(np.argmin(np.abs(line.x - joint.x)))] += joint.axial
    return np.asarray(1 / compliance)


def _axial_forces(model: Model, line: Line, chosen: int) -> Array:
    """Return the forces of a load set along the axis, by node."""
    forces = np.zeros(len(line.x))
    for card in model.forces:
        if card.integer(1) != chosen:
            continue
        card.zero((3,), "a coordinate system")
        vector = card.real(4) * np.array([card.real(i, 0.0) for i in (5, 6, 7)])
        along = float(vector @ line.frame[0])
        if np.linalg.norm(vector - along * line.frame[0]) > 1e-9 * np.linalg.norm(vector):
            raise card.error("it is no force along the beam; a preload is N alone: remove it")
        grid = card.integer(2)
        if grid not in line.node:
            raise card.error(f"grid {grid} is no grid of the beam's elements")
        forces[line.node[grid]] += along
    if not np.any(forces):
        what = counted(0, "FORCE card")
        raise InputError(f"{model.deck.path}: the load set {chosen} has {what}; N needs some")
    return forces


def _displacement(diagonal: Array, k: Array, forces: Array, fixed: list[int]) -> Array:
    """Solve the bar for its displacements, zero at the fixed nodes."""
    from scipy.linalg import solve_banded

    band = np.zeros((3, len(diagonal)))
    band[1], band[0, 1:], band[2, :-1] = diagonal, -k, -k
    right = forces.copy()
    for node in fixed:
        band[1, node], right[node] = 1.0, 0.0
        band[0, node + 1 : node + 2] = 0.0  # row `node`: zero beside the diagonal
        if node > 0:
            band[2, node - 1] = 0.0
    return np.asarray(solve_banded((1, 1), band, right))
