"""A beam as a NASTRAN deck: CBAR elements, its masses, springs and joints, and N as a preload.

The beam lies along x and bends in the plane x-y. Mass per length stands as NSM, so `A = EA/E`,
`I1 = EI/E`. Subcase 1 loads the beam by axial forces, the steps of N from element to element; it is
held at its left end alone, whatever the ends, so that N(x) follows from them. Subcase 2 are modes
without N, subcase 3 with it (STATSUB). An axial spring at x stretches in subcase 1; the force there
is `F + k u`, with `u' = -N/EA`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, LONGITUDINAL
from antinode.exchange.units import SI, System
from antinode.modes.hertz import hertz
from antinode.modes.result import ModalResult
from antinode.version import __version__

from .cards import card_text

ELEMENTS = 200
"""Fewest elements of a beam."""
MODULUS = 2.1e11
"""E of MAT1 [Pa]; A and I follow from it."""
SLENDER = 1e-3
"""Radius of gyration in lengths of a beam without EA."""
_GAUSS = 0.5 - math.sqrt(3) / 6, 0.5 + math.sqrt(3) / 6
_STATIC, _MODAL, _LOAD, _METHOD, _MATERIAL = 1, 2, 1, 10, 1


@dataclass(frozen=True)
class Elements:
    """Uniform elements from left to right, SI.

    Attributes
    ----------
    x : array, shape (n + 1,)
    mass, EI, EA, N : array, shape (n,)
    """

    x: Array
    mass: Array
    EI: Array
    EA: Array
    N: Array


def write_nastran(path: Path, result: ModalResult, system: System = SI) -> tuple[str, ...]:
    """Write the beam of a result, with the frequencies to expect.

    Parameters
    ----------
    path : Path
    result : ModalResult
        Solved with ``unloaded=True``.
    system : System

    Returns
    -------
    tuple of str
        What the deck does not hold exactly.
    """
    result, notes = _comparable(result)
    path.write_text(nastran_text(result, system, notes), encoding="ascii", errors="replace")
    return (f"NASTRAN has no units: these are {system.words}", *notes)


def nastran_text(result: ModalResult, system: System = SI, notes: tuple[str, ...] = ()) -> str:
    """Return the deck as text."""
    beam = result.beam
    count = max(ELEMENTS, 20 * max((mode.number for mode in result.modes), default=1))
    elements = elements_of(beam, count)
    loaded = not beam.is_unloaded
    head = [*_comments(result, system, elements, notes), *_case_control(beam, loaded=loaded)]
    bulk = [
        card_text("PARAM", "COUPMASS", 1),
        card_text("PARAM", "GRDPNT", 0),
        card_text("EIGRL", _METHOD, None, None, len(result.modes)),
        card_text("MAT1", _MATERIAL, MODULUS * system.force / system.length**2, None, 0.3),
        *_line(beam, elements, system),
        *_attachments(beam, elements, system),
        *_supports(beam, elements),
        *(_preload(beam, elements, system) if loaded else ()),
    ]
    return "".join([*(f"{line}\n" for line in head), "BEGIN BULK\n", *bulk, "ENDDATA\n"])


def _comparable(result: ModalResult) -> tuple[ModalResult, tuple[str, ...]]:
    """Return modes that the deck can give: NASTRAN lets weight act at its grid."""
    from antinode.modes.solve import solve_one

    beam = result.beam
    in_plane = [name for name in result.families if set(FAMILIES[name].freedoms) <= {0, 1, 5}]
    kept = tuple(mode for mode in result.modes if mode.family in in_plane)
    offset = any(isinstance(item, PointMass) and item.offset for item in beam.attachments)
    notes: tuple[str, ...] = ()
    if beam.axial_stiffness is None:
        notes = (f"EA is not known: EI/(L/{1 / SLENDER:.0f})^2 stands for it",)
    if len(kept) < len(result.modes):
        notes = (*notes, "torsion is left out: the grids of this deck do not turn about x")
    if not (offset and beam.offset_weight and beam.axial_acceleration):
        return replace(result, modes=kept), notes
    beam = replace(beam, offset_weight=False)
    number = max(mode.number for mode in result.modes)
    say = "the weight of offset masses acts at their grids, in the frequencies expected here too"
    options: dict[str, Any] = {"tolerance": result.tolerance, "families": in_plane}
    return solve_one(beam, number, unloaded=True, **options), (*notes, say)


def elements_of(beam: Beam, count: int) -> Elements:
    """Return a beam as uniform elements, at least so many, with breakpoints at their ends."""
    pieces = np.ceil(np.diff(beam.x) / beam.length * count - 1e-9).astype(int).clip(1)
    k = np.repeat(np.arange(len(pieces)), pieces)
    within = np.concatenate([np.arange(n) for n in pieces])
    size = 1 / pieces[k]
    x = np.append(beam.x[k] + np.diff(beam.x)[k] * within * size, beam.x[-1])

    def mean(values: Array, power: int = 1) -> Array:
        sides = [beam.at(values, k, (within + g) * size) ** power for g in _GAUSS]
        return np.asarray(np.mean(sides, axis=0) ** power)

    EI, EA = mean(beam.bending_stiffness, -1), beam.axial_stiffness
    return Elements(
        x,
        mean(beam.mass_per_length),
        EI,
        EI / (SLENDER * beam.length) ** 2 if EA is None else mean(EA, -1),
        np.mean([beam.axial_force_at(k, (within + g) * size) for g in _GAUSS], axis=0),
    )


def _comments(
    result: ModalResult, system: System, elements: Elements, notes: tuple[str, ...]
) -> Iterator[str]:
    name = "".join(c if c.isprintable() else " " for c in result.beam.name)[:60]
    yield f"$ {name}: a beam by antinode {__version__}"
    yield f"$ Units: {system.words}. NASTRAN itself has none."
    yield f"$ {len(elements.N)} CBAR without shear, along x, bending in the plane x-y"
    yield from (f"$ Note: {note}" for note in notes)
    yield "$ Frequencies to expect [Hz]; these are of the beam itself, not of its elements:"
    yield f"$ {'mode':<24}{'subcase 3, with N':>20}{'subcase 2, without':>20}"
    for mode in result.modes:
        with_N = f"{mode.frequency_hz:.6f}"
        if mode.omega2 < 0:
            with_N = f"omega2 {mode.omega2:.5g}"
        bare = "-" if mode.unloaded_omega2 is None else f"{hertz(mode.unloaded_omega2):.6f}"
        yield f"$ {mode.name:<24}{with_N:>20}{bare:>20}"


def _case_control(beam: Beam, *, loaded: bool) -> Iterator[str]:
    held = [f"  SPC = {_MODAL}"] if _held_freedoms(beam) else []
    yield from ("SOL 103", "CEND", "TITLE = BEAM BY ANTINODE", "ECHO = NONE", "DISPLACEMENT = ALL")
    if loaded:
        yield from ("SUBCASE 1", "  LABEL = AXIAL FORCE", f"  SPC = {_STATIC}", f"  LOAD = {_LOAD}")
    yield from ("SUBCASE 2", "  LABEL = MODES WITHOUT AXIAL FORCE", *held, f"  METHOD = {_METHOD}")
    if loaded:
        yield from ("SUBCASE 3", "  LABEL = MODES UNDER AXIAL FORCE", *held)
        yield from (f"  METHOD = {_METHOD}", "  STATSUB(PRELOAD) = 1")


def _line(beam: Beam, elements: Elements, system: System) -> Iterator[str]:
    """Yield grids, elements and their properties, each property once; a joint has two grids."""
    joints = _joint_nodes(beam, elements)
    places = [(k + 1, x) for k, x in enumerate(elements.x)]
    places += [(_right_grid(k), elements.x[k]) for k in joints]
    for number, x in places:
        yield card_text("GRID", number, None, float(x * system.length), 0.0, 0.0, None, "345")
    numbers: dict[tuple[float, ...], int] = {}
    for k in range(len(elements.N)):
        area = float(elements.EA[k] / MODULUS * system.length**2)
        inertia = float(elements.EI[k] / MODULUS * system.length**4)
        mass = float(elements.mass[k] * system.mass / system.length)
        number = numbers.setdefault((area, inertia, mass), len(numbers) + 1)
        left = _right_grid(k) if k in joints else k + 1
        yield card_text("CBAR", k + 1, number, left, k + 2, 0.0, 1.0, 0.0)
    for (area, inertia, mass), number in numbers.items():
        yield card_text("PBAR", number, _MATERIAL, area, inertia, inertia, 2 * inertia, mass)


def _right_grid(node: int) -> int:
    """Return the grid on the right side of a joint at a node."""
    return 1_000_001 + node


def _joint_nodes(beam: Beam, elements: Elements) -> list[int]:
    places = {_node(elements, item.x) for item in beam.attachments if isinstance(item, Joint)}
    return sorted(places)


def _node(elements: Elements, x: float) -> int:
    return int(np.argmin(np.abs(elements.x - x)))


def _attachments(beam: Beam, elements: Elements, system: System) -> Iterator[str]:
    """Yield masses, finite springs and joints."""
    number = 2_000_000
    for item in beam.attachments:
        grid = _node(elements, item.x) + 1
        number += 10
        if isinstance(item, PointMass):
            offset = item.offset * system.length
            inertia = item.rotary_inertia * system.mass * system.length**2
            mass = item.mass * system.mass
            cells = (mass, float(offset), 0.0, 0.0, None, 0.0, None, 0.0, None, None, inertia)
            yield card_text("CONM2", number, grid, None, *(_float(c) for c in cells))
        elif isinstance(item, Spring):
            for dof, k in _stiffness(item, system).items():
                if 0 < k < math.inf:
                    yield card_text("CELAS2", number + dof, k, grid, dof)
    for node in _joint_nodes(beam, elements):
        yield from _joint(beam, elements, node, system)


def _float(value: float | None) -> float | None:
    return None if value is None else float(value)


def _stiffness(spring: Spring, system: System) -> dict[int, float]:
    """Return the stiffness of a spring by degree of freedom."""
    k = system.force / system.length
    turning = system.force * system.length
    return {1: spring.axial * k, 2: spring.translational * k, 6: spring.rotational * turning}


def _joint(beam: Beam, elements: Elements, node: int, system: System) -> Iterator[str]:
    """Yield what links the two grids of a joint: springs where it gives way, else a rigid link."""
    here = [
        item
        for item in beam.attachments
        if isinstance(item, Joint) and _node(elements, item.x) == node
    ]
    axial = sum(item.axial for item in here) * system.length / system.force
    turning = sum(item.rotational for item in here) / (system.force * system.length)
    number, left, right = 4_000_000 + 10 * node, node + 1, _right_grid(node)
    rigid = "2" if axial else "12"
    yield card_text("RBE2", number, left, rigid if turning else rigid + "6", right)
    for dof, compliance in ((1, axial), (6, turning)):
        if compliance:
            yield card_text("CELAS2", number + dof, 1 / compliance, left, dof, right, dof)


_END = {"free": "", "pinned": "2", "sliding": "6", "clamped": "26"}


def _held_freedoms(beam: Beam) -> list[tuple[float, str]]:
    """Return what holds the modes: place and degrees of freedom, ends and supports."""
    axial = ["1" if end == "fixed" else "" for end in beam.ends.of(LONGITUDINAL)]
    held = [
        (float(beam.x[0]), axial[0] + _END[beam.ends.left]),
        (float(beam.x[-1]), axial[1] + _END[beam.ends.right]),
    ]
    for item in beam.attachments:
        if isinstance(item, Spring):
            infinite = [dof for dof, k in _stiffness(item, SI).items() if math.isinf(k)]
            held.append((item.x, "".join(map(str, infinite))))
    return [(x, freedoms) for x, freedoms in held if freedoms]


def _supports(beam: Beam, elements: Elements) -> Iterator[str]:
    for x, freedoms in _held_freedoms(beam):
        yield card_text("SPC1", _MODAL, freedoms, _node(elements, x) + 1)


def _preload(beam: Beam, elements: Elements, system: System) -> Iterator[str]:
    """Yield the forces along x that leave N in the elements, and what holds the beam meanwhile."""
    yield card_text("SPC1", _STATIC, "126", 1)
    steps = np.diff(elements.N, prepend=0.0, append=0.0) + _spring_forces(beam, elements)
    for k in np.flatnonzero(np.abs(steps) > 1e-12 * np.max(np.abs(elements.N))).tolist():
        force = float(steps[k] * system.force)
        yield card_text("FORCE", _LOAD, k + 1, None, force, 1.0, 0.0, 0.0)


def _spring_forces(beam: Beam, elements: Elements) -> Array:
    """Return what axial springs take of the forces at the nodes in subcase 1, ``k u`` [N]."""
    short = elements.N * np.diff(elements.x) / elements.EA
    u = -np.append(0.0, np.cumsum(short))
    N_left = np.append(elements.N, 0.0)
    forces = np.zeros(len(u))
    for item in beam.attachments:
        if isinstance(item, Joint):  # the nodes right of it move by -N f
            at = _node(elements, item.x)
            u[at + 1 :] -= N_left[at] * item.axial
    for item in beam.attachments:
        if isinstance(item, Spring) and math.isfinite(item.axial):
            at = _node(elements, item.x)
            forces[at] += item.axial * u[at]
    return forces
