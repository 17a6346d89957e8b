"""A beam as a NASTRAN deck: CBAR elements, its masses, springs and joints, and N.

The beam lies along x and bends in the plane x-y. Mass per length stands as NSM, half of it at
either grid (COUPMASS -1): `A = EA/E`, `I1 = EI/E`, `K1 = kGA/(G A)`. What a bar has not of itself
stands at the grids: rotary inertia as a massless CONM2, a foundation as a CELAS2 in freedom 2, and
added mass as a CONM2 on a grid that follows in freedom 2 alone. Elements take N and shear by
Engesser: a Haringx kGA stands there larger by N. A deck for modes has one subcase. N stands in it
as a CELAS2 of `-N/h` across each element, between the freedoms 2 of its grids: what a taut string
adds, read by every solver. For STATSUB and buckling axial forces load a subcase of their own, the
steps of N from element to element; for buckling the beam is held along x at its left end alone.
Springs to the ground end at a grid that is held, since some solvers know no other ground.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import TORSION
from antinode.exchange.mesh.analyses import Analysis
from antinode.exchange.mesh.elements import Kind
from antinode.exchange.mesh.expected import (
    Expected,
    comparable,
    critical_factor,
    expected_buckling,
    expected_modes,
    header,
)
from antinode.exchange.mesh.mesh import AXIAL, LATERAL, TURN, TWIST, Mesh, mesh_of
from antinode.exchange.units import SI, System
from antinode.modes.result import ModalResult
from antinode.version import __version__

from .cards import card_text

ELEMENTS = 200
"""Fewest elements of a beam."""
MODULUS, POISSON = 2.1e11, 0.3
"""E [Pa] and nu of MAT1; A, I and J follow from them."""
_TWISTING: tuple[Analysis, ...] = ("modes", "unloaded")
_STATIC, _MODAL, _LOAD, _METHOD, _MATERIAL = 1, 2, 1, 10, 1
_RIGHT, _GROUND, _STRING, _LUMP = 1_000_000, 2_000_000, 3_000_000, 5_000_000
_WATER, _BED = 6_000_000, 7_000_000
_KINDS: dict[Analysis, Kind] = {
    "modes": "bars by strings", "unloaded": "bars", "statsub": "bars", "buckling": "bars",
}  # fmt: skip


def write_nastran(
    path: Path, result: ModalResult, system: System = SI, analysis: Analysis = "modes"
) -> tuple[str, ...]:
    """Write the beam of a result, with what to expect.

    Parameters
    ----------
    path : Path
    result : ModalResult
    system : System
    analysis : {"modes", "unloaded", "statsub", "buckling"}

    Returns
    -------
    tuple of str
        What the deck does not hold exactly.
    """
    result, notes = comparable(result, analysis, torsion=analysis in _TWISTING)
    text = nastran_text(result, system, notes, analysis)
    path.write_text(text, encoding="ascii", errors="replace")
    return (f"NASTRAN has no units: these are {system.words}", *notes)


def nastran_text(
    result: ModalResult,
    system: System = SI,
    notes: tuple[str, ...] = (),
    analysis: Analysis = "modes",
) -> str:
    """Return the deck as text."""
    beam = result.beam
    count = max(ELEMENTS, 20 * max((mode.number for mode in result.modes), default=1))
    twists = analysis in _TWISTING and bool(result.family(TORSION))
    factor = critical_factor(beam) if analysis == "buckling" else 1.0
    mesh = mesh_of(beam, count, twists=twists, factor=factor)
    kind = _KINDS[analysis]
    if analysis == "buckling":
        expected = expected_buckling(factor, mesh, kind)
    else:
        expected = expected_modes(result, mesh, kind)
    head = [*_comments(mesh, system, notes, expected), *_case_control(mesh, analysis)]
    bulk = [
        card_text("PARAM", "COUPMASS", -1),
        card_text("PARAM", "GRDPNT", 0),
        card_text("EIGRL", _METHOD, None, None, expected.asked, None, None, expected.near),
        *_line(mesh, system),
        *_attachments(mesh, system, axial=analysis != "buckling"),
        *_supports(mesh, analysis),
        *_axial_force(mesh, system, analysis),
    ]
    return "".join([*(f"{line}\n" for line in head), "BEGIN BULK\n", *bulk, "ENDDATA\n"])


def _comments(
    mesh: Mesh, system: System, notes: tuple[str, ...], expected: Expected
) -> Iterator[str]:
    title = "".join(c if c.isprintable() else " " for c in mesh.beam.name)[:60]
    own: tuple[str, ...] = (
        f"Units: {system.words}. NASTRAN itself has none.",
        f"Mesh: {mesh.count} CBAR {_shear_words(mesh)}, along x, bending in the plane x-y, lumped "
        "mass",
    )
    lumped = {
        "Polar inertia as massless CONM2": mesh.twists,
        "Rotary inertia as massless CONM2": mesh.rotary is not None,
        "Added mass, which moves in y alone, as RBE2 and CONM2": mesh.added is not None,
        "Foundation as CELAS2": mesh.foundation is not None,
    }
    own += tuple(f"{what} at every grid" for what, there in lumped.items() if there)
    lines = [*header(title, notes, expected, __version__)]
    yield from (f"$ {line}" for line in (lines[0], *own, *lines[1:]))


def _shear_words(mesh: Mesh) -> str:
    """Say how the elements take shear, and N with it."""
    if mesh.kGA is None:
        return "without shear"
    if mesh.beam.shear_form == "engesser" or mesh.beam.is_unloaded:
        return "with shear (K1)"
    return "with shear (K1 of kGA + N: Haringx)"


def _case_control(mesh: Mesh, analysis: Analysis) -> Iterator[str]:
    is_held = mesh.held_under(buckling=analysis == "buckling")
    held = [f"  SPC = {_MODAL}"] if is_held else []
    method = f"  METHOD = {_METHOD}"
    yield "SOL 105" if analysis == "buckling" else "SOL 103"
    yield from ("CEND", "TITLE = BEAM BY ANTINODE", "ECHO = NONE", "DISPLACEMENT = ALL")
    if analysis in ("modes", "unloaded"):
        yield from ("SUBCASE 1", "  LABEL = MODES", *held, method)
        return
    static = [f"  SPC = {_STATIC}"] if analysis == "statsub" else held
    yield from ("SUBCASE 1", "  LABEL = AXIAL FORCE", *static, f"  LOAD = {_LOAD}")
    if analysis == "statsub":
        yield from ("SUBCASE 2", "  LABEL = MODES UNDER AXIAL FORCE", *held, method)
        yield "  STATSUB(PRELOAD) = 1"
    else:
        yield from ("SUBCASE 2", "  LABEL = BUCKLING", *held, method)


def _line(mesh: Mesh, system: System) -> Iterator[str]:
    """Yield grids, elements and their properties, each property once; a joint has two grids."""
    places = [(k + 1, x) for k, x in enumerate(mesh.x)]
    places += [(_RIGHT + k + 1, mesh.x[k]) for k in mesh.joints]
    held = "35" if mesh.twists else "345"
    for number, x in places:
        yield card_text("GRID", number, None, float(x * system.length), 0.0, 0.0, None, held)
    materials, numbers = (
        dict[float, int](),
        dict[tuple[int, float, float, float, float, float], int](),
    )
    for k in range(mesh.count):
        loss = 0.0 if mesh.loss is None else float(mesh.loss[k])
        material = materials.setdefault(loss, _MATERIAL + len(materials))
        own = (material, *_section(mesh, k, system))
        prop = numbers.setdefault(own, len(numbers) + 1)
        yield card_text("CBAR", k + 1, prop, *_grids(mesh, k), 0.0, 1.0, 0.0)
    E = MODULUS * system.force / system.length**2
    for loss, material in materials.items():
        damping = (None, None, None, loss) if loss else ()
        yield card_text("MAT1", material, E, None, POISSON, *damping)
    for (material, area, inertia, J, mass, K), prop in numbers.items():
        shear = (*[None] * 9, K, K) if K else ()
        yield card_text("PBAR", prop, material, area, inertia, inertia, J, mass, *shear)


def _section(mesh: Mesh, k: int, system: System) -> tuple[float, float, float, float, float]:
    """Return A, I, J, NSM and K of an element; K is 0 where it is rigid in shear."""
    shear_modulus = MODULUS / (2 * (1 + POISSON))
    area, inertia = float(mesh.EA[k] / MODULUS), float(mesh.EI[k] / MODULUS)
    J = 2 * inertia if mesh.GJ is None else float(mesh.GJ[k] / shear_modulus)
    kGA = math.inf if mesh.kGA is None else float(mesh.kGA[k])
    K = 0.0 if math.isinf(kGA) else kGA / (shear_modulus * area)
    mass = float(mesh.mass[k] * system.mass / system.length)
    return area * system.length**2, inertia * system.length**4, J * system.length**4, mass, K


def _grids(mesh: Mesh, k: int) -> tuple[int, int]:
    """Return the grids of an element; it begins on the right side of a joint."""
    return (_RIGHT + k + 1 if k in mesh.joints else k + 1), k + 2


def _attachments(mesh: Mesh, system: System, *, axial: bool) -> Iterator[str]:
    """Yield masses, springs and joints; without axial springs where N is to pass them by."""
    yield from _lumps(mesh, system)
    for row, (node, item) in enumerate(mesh.masses):
        square = system.mass * system.length**2
        about = (
            float(item.polar_inertia * square * mesh.twists),
            float(item.rotary_inertia * square),
        )
        cells = (item.mass * system.mass, item.offset * system.length, 0.0, 0.0)
        own = (*map(float, cells), None, *_inertias(*about))
        yield card_text("CONM2", _GROUND + row + 1, node + 1, None, *own)
    springs = [spring for spring in mesh.springs if axial or spring[1] != AXIAL]
    for node in sorted({node for node, _, _ in springs}):
        x = float(mesh.x[node] * system.length)
        yield card_text("GRID", _GROUND + node + 1, None, x, 0.0, 0.0, None, "123456")
    if mesh.foundation is not None:
        yield card_text("GRID", _BED, None, 0.0, 0.0, 0.0, None, "123456")
    for node, freedom, k in mesh.bedding:
        ends = (node + 1, freedom, _BED, freedom)
        stiffness = k * _stiffness_unit(freedom, system)
        yield card_text("CELAS2", _BED + node + 1, float(stiffness), *ends)
    for row, (node, freedom, k) in enumerate(springs):
        stiffness = k * _stiffness_unit(freedom, system)
        ends = (node + 1, freedom, _GROUND + node + 1, freedom)
        yield card_text("CELAS2", _GROUND + row + 1, float(stiffness), *ends)
    for node in mesh.joints:
        yield from _joint(mesh, node, system)


def _lumps(mesh: Mesh, system: System) -> Iterator[str]:
    """Yield what elements have not of themselves, half of it at either grid."""
    square = system.mass * system.length**2
    about = [_by_grid(mesh, of) for of in (mesh.inertia if mesh.twists else None, mesh.rotary)]
    for row, grid in enumerate(about[0]):
        own = [float(lumps[grid] * square) for lumps in about]
        if any(own):
            cells = 0.0, None, None, None, None, *_inertias(*own)
            yield card_text("CONM2", _LUMP + row + 1, grid, None, *cells)
    for node, mass in mesh.at_nodes(mesh.added):
        follower, x = _WATER + node + 1, float(mesh.x[node] * system.length)
        yield card_text("GRID", follower, None, x, 0.0, 0.0, None, "13456")
        yield card_text("RBE2", follower, node + 1, LATERAL, follower)
        yield card_text("CONM2", follower, follower, None, float(mass * system.mass))


def _by_grid(mesh: Mesh, per_length: Array | None) -> dict[int, float]:
    """Return the halves of elements at their grids, of which a joint has two."""
    left, right = mesh.lumped(per_length)
    parts = {k + 1: left[k] + (k not in mesh.joints) * right[k] for k in range(mesh.count + 1)}
    return parts | {_RIGHT + k + 1: right[k] for k in mesh.joints}


def _inertias(about_x: float, about_z: float) -> tuple[float | None, ...]:
    """Return the six moments of inertia of a CONM2; none that is zero."""
    own = (about_x or None, None, None, None, None, about_z or None)
    return own[: 6 if about_z else 1 if about_x else 0]


def _stiffness_unit(freedom: int, system: System) -> float:
    """Return how many units make up an SI unit of the stiffness in a freedom."""
    return (
        system.force * system.length if freedom in (TURN, TWIST) else system.force / system.length
    )


def _joint(mesh: Mesh, node: int, system: System) -> Iterator[str]:
    """Yield what links the two grids of a joint: springs where it gives way, else a rigid link."""
    compliance, left, right = mesh.joints[node], node + 1, _RIGHT + node + 1
    rigid = "".join(str(f) for f in _freedoms(mesh) if not compliance.get(f))
    number = 4_000_000 + 10 * node
    yield card_text("RBE2", number, left, rigid, right)
    for freedom, c in compliance.items():
        if c:
            stiffness = float(_stiffness_unit(freedom, system) / c)
            yield card_text("CELAS2", number + freedom, stiffness, left, freedom, right, freedom)


def _freedoms(mesh: Mesh) -> tuple[int, ...]:
    return (AXIAL, LATERAL, TWIST, TURN) if mesh.twists else (AXIAL, LATERAL, TURN)


def _supports(mesh: Mesh, analysis: Analysis) -> Iterator[str]:
    held = mesh.held_under(buckling=analysis == "buckling")
    for node in sorted({node for node, _ in held}):
        freedoms = "".join(str(f) for n, f in held if n == node)
        yield card_text("SPC1", _MODAL, freedoms, node + 1)
    if analysis == "statsub":
        yield card_text("SPC1", _STATIC, "126", 1)


def _axial_force(mesh: Mesh, system: System, analysis: Analysis) -> Iterator[str]:
    if analysis in ("statsub", "buckling"):
        yield from _forces(mesh, system, springs=analysis == "statsub")
    elif analysis == "modes":
        yield from _strings(mesh, system)


def _forces(mesh: Mesh, system: System, *, springs: bool) -> Iterator[str]:
    """Yield the forces along x that leave N in the elements."""
    moved = mesh.stretch()
    forces = mesh.nodal_forces(moved if springs else 0.0 * moved)
    for k in np.flatnonzero(np.abs(forces) > 1e-12 * np.max(np.abs(mesh.N))).tolist():
        force = float(forces[k] * system.force)
        yield card_text("FORCE", _LOAD, k + 1, None, force, 1.0, 0.0, 0.0)


def _strings(mesh: Mesh, system: System) -> Iterator[str]:
    """Yield the springs across the elements that N amounts to."""
    for k in np.flatnonzero(mesh.N).tolist():
        stiffness = float(-mesh.N[k] / mesh.lengths[k] * system.force / system.length)
        left, right = _grids(mesh, k)
        yield card_text("CELAS2", _STRING + k + 1, stiffness, left, LATERAL, right, LATERAL)
