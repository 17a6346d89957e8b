"""A beam as an input file of CalculiX: B32R elements, its masses, springs and joints, and N.

CalculiX makes a row of solid elements of a B32R. Each has a square section of depth
`h = sqrt(12 EI/EA)`, the E and density that give EA and m, and the G that gives kGA; of a beam that
is rigid in shear a large one. The inertia of turning sections is that of solids, m EI/EA, and N
does more to the strain: both are in the frequencies to expect. N is the preload of a static step,
whose forces are the steps of N; supports along x move in it as N would have them. A node turns as
a rigid section where a stub without mass branches off it, and shows its turn to masses and springs
by equations.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.errors import InputError
from antinode.modes.result import ModalResult
from antinode.version import __version__

from .mesh.analyses import Analysis
from .mesh.expected import (
    Expected,
    comparable,
    critical_factor,
    expected_buckling,
    expected_modes,
    header,
)
from .mesh.mesh import AXIAL, LATERAL, TURN, Mesh, mesh_of
from .units import SI, System

ELEMENTS = 100
"""Fewest elements of a beam."""
SOFT = 1e-9
"""Of what it takes to move a free beam as fast as its first mode: springs that hold it."""
LIGHT = 1e-7
"""Density of a stub in that of the beam."""
_RIGHT, _STUB, _POINT = 1_000_000, 2_000_000, 3_000_000


Section = tuple[float, float, float, float]
"""Depth, E, density and G of a section, in units of the file."""


@dataclass
class Lines:
    """The lines of a file, with numbers for new nodes, elements and sets."""

    mesh: Mesh
    system: System
    buckling: bool = False
    text: list[str] = field(default_factory=list)
    points: int = _POINT
    elements: int = 0

    def add(self, *lines: str) -> None:
        """Append lines."""
        self.text += lines

    def point(self, node: int) -> int:
        """Append a node beside the beam, at the place of one of it."""
        self.points += 1
        x = self.mesh.x[node] * self.system.length
        self.add("*NODE", f"{self.points},{_real(x)},0.,0.")
        return self.points

    def element(self, kind: str, nodes: Iterable[int]) -> str:
        """Append an element in a set of its own, whose name is returned."""
        self.elements += 1
        name = f"{kind}{self.elements}"
        self.add(f"*ELEMENT,TYPE={kind},ELSET={name}", ",".join(map(str, (self.elements, *nodes))))
        return name

    def tie(self, node: int, freedom: int, *to: tuple[int, int, float]) -> None:
        """Append the equation of a freedom that others lead."""
        terms = ((node, freedom, 1.0), *((n, f, -factor) for n, f, factor in to))
        self.add("*EQUATION", f"{len(terms)}")
        self.add(*(f"{n},{f},{_real(factor)}" for n, f, factor in terms))


def write_calculix(
    path: Path, result: ModalResult, system: System = SI, analysis: Analysis = "modes"
) -> tuple[str, ...]:
    """Write the beam of a result, with what to expect.

    Parameters
    ----------
    path : Path
    result : ModalResult
    system : System
    analysis : {"modes", "unloaded", "buckling"}

    Returns
    -------
    tuple of str
        What the file does not hold exactly.

    Raises
    ------
    InputError
        If CalculiX has no such analysis.
    """
    if analysis == "statsub":
        raise InputError(
            "--analysis statsub is NASTRAN's; for CalculiX choose modes, where N is a static step"
        )
    result, notes = comparable(result, analysis)
    path.write_text(calculix_text(result, system, notes, analysis), encoding="ascii")
    say = "CalculiX's beams are solid: their sections have inertia when they turn, of EI/EA"
    notes = (*notes, *_rotary_note(result.beam))
    if result.beam.loss_factor is not None:
        notes = (*notes, "loss_factor is left out: it would count in responses alone")
    return (f"CalculiX has no units: these are {system.words}", say, *notes)


def _rotary_note(beam: Beam) -> tuple[str, ...]:
    """Say where the rotary inertia of solids is not that of the beam."""
    mesh = mesh_of(beam, 1)
    if mesh.rotary is None:
        return ()
    ratio = mesh.mass * mesh.EI / mesh.EA / np.maximum(mesh.rotary, 1e-300)
    if np.allclose(ratio, 1.0, rtol=1e-3):
        return ()
    low, high = np.min(ratio), np.max(ratio)
    return (f"that is {low:.3g} to {high:.3g} times the rotary inertia of the beam",)


def calculix_text(
    result: ModalResult,
    system: System = SI,
    notes: tuple[str, ...] = (),
    analysis: Analysis = "modes",
) -> str:
    """Return the file as text."""
    beam, buckling = result.beam, analysis == "buckling"
    number = max((mode.number for mode in result.modes), default=1)
    factor = critical_factor(beam) if buckling else 1.0
    mesh = mesh_of(beam, max(ELEMENTS, 10 * number), factor=factor)
    if buckling:
        expected = expected_buckling(factor, mesh, "solids")
    else:
        expected = expected_modes(result, mesh, "solids")
    lines = Lines(mesh, system, buckling)
    lines.add(*_comments(mesh, system, notes, expected), "*HEADING", "Beam by antinode")
    _beam(lines)
    _attach(lines)
    _hold(lines, mesh.held_under(buckling=buckling))
    if not buckling:
        _soften(lines, result)
    lines.add(*_steps(mesh, system, expected, analysis))
    return "\n".join((*lines.text, ""))


def _comments(
    mesh: Mesh, system: System, notes: tuple[str, ...], expected: Expected
) -> Iterator[str]:
    title = "".join(c if " " <= c <= "~" else "?" for c in mesh.beam.name)[:60]
    own = (
        f"Units: {system.words}. CalculiX itself has none.",
        f"Mesh: {mesh.count} B32R along x, bending in the plane x-y, made solid by CalculiX:",
        f"with the inertia of turning sections, and {_shear_words(mesh)}",
    )
    lines = [*header(title, notes, expected, __version__)]
    yield from (f"** {line}" for line in (lines[0], *own, *lines[1:]))


def _shear_words(mesh: Mesh) -> str:
    """Say how much the elements give in shear."""
    if mesh.kGA is None:
        return f"little shear (G is {mesh.shear_modulus:.3g} E)"
    if mesh.beam.shear_form == "engesser" or mesh.beam.is_unloaded:
        return "shear: G of kGA"
    return "shear: G of kGA + N, by Haringx"


def _real(value: float) -> str:
    text = f"{value:.12g}"
    return text if "." in text or "e" in text else f"{text}."


def _sides(mesh: Mesh, node: int) -> list[int]:
    """Return the numbers of a node: a joint has a left and a right one."""
    own = 2 * node + 1
    return [own, _RIGHT + own] if node in mesh.joints else [own]


def _beam(lines: Lines) -> None:
    """Append nodes, elements, and sections of equal depth, E and density, each once."""
    mesh, length = lines.mesh, lines.system.length
    x = np.repeat(mesh.x, 2)[:-1]
    x[1::2] = (mesh.x[1:] + mesh.x[:-1]) / 2
    lines.add("*NODE,NSET=BEAM", *(f"{k + 1},{_real(v * length)},0.,0." for k, v in enumerate(x)))
    for node in mesh.joints:
        lines.add(f"{_sides(mesh, node)[1]},{_real(mesh.x[node] * length)},0.,0.")
    alike: dict[Section, list[int]] = {}
    for k in range(mesh.count):
        alike.setdefault(_section(mesh, k, lines.system), []).append(k)
    for number, (section, elements) in enumerate(alike.items(), start=1):
        rows = [(k + 1, _sides(mesh, k)[-1], 2 * k + 2, 2 * k + 3) for k in elements]
        lines.add(f"*ELEMENT,TYPE=B32R,ELSET=S{number}")
        lines.add(*(",".join(map(str, row)) for row in rows))
        _material(lines, f"S{number}", section, "0.,1.,0.")
    lines.elements = mesh.count


def _section(mesh: Mesh, k: int, system: System) -> Section:
    """Return depth, E, density and G of the section of an element."""
    depth = float(np.sqrt(12 * mesh.EI[k] / mesh.EA[k]))
    E, rho, G = (float(v[k]) / depth**2 for v in (mesh.EA, mesh.mass, mesh.solid_shear))
    pressure, density = system.force / system.length**2, system.mass / system.length**3
    return depth * system.length, E * pressure, rho * density, G * pressure


def _material(lines: Lines, name: str, section: Section, towards: str) -> None:
    depth, E, rho, G = (_real(value) for value in section)
    stiff = _real(lines.mesh.shear_modulus * section[1])  # else the solids would twist
    lines.add(
        f"*MATERIAL,NAME={name}",
        "*ELASTIC,TYPE=ENGINEERING CONSTANTS",
        f"{E},{E},{E},0.,0.,0.,{G},{stiff}",
        stiff,
        "*DENSITY",
        rho,
        f"*BEAM SECTION,ELSET={name},MATERIAL={name},SECTION=RECT",
        f"{depth},{depth}",
        towards,
    )


def _attach(lines: Lines) -> None:
    """Append masses, springs and joints; without axial springs where N is to pass them by."""
    mesh = lines.mesh
    springs = [row for row in mesh.springs if not (lines.buckling and row[1] == AXIAL)]
    stubs = {row[0] for row in springs} | {row[0] for row in mesh.held} | set(mesh.joints)
    stubs |= {node for node, _ in mesh.masses}
    for node in sorted(stubs):
        for side in _sides(mesh, node):
            _stub(lines, node, side)
    for node, item in mesh.masses:
        _mass(lines, node, item.mass, item.offset, item.rotary_inertia)
    for node, freedom, k in mesh.bedding:
        _spring(
            lines, [(_sides(mesh, node)[0], freedom)], k * _stiffness_unit(freedom, lines.system)
        )
    for node, mass in mesh.at_nodes(mesh.added):
        point = lines.point(node)
        lines.tie(point, LATERAL, (_sides(mesh, node)[0], LATERAL, 1.0))
        lines.add("*BOUNDARY", f"{point},1,1", f"{point},3,3")
        _inert(lines, point, mass * lines.system.mass)
    for node, freedom, k in springs:
        moving = _moving(lines, node, _sides(mesh, node)[0], freedom)
        _spring(lines, [moving], k * _stiffness_unit(freedom, lines.system))
    for node in mesh.joints:
        _joint(lines, node)


def _stiffness_unit(freedom: int, system: System) -> float:
    return system.force * system.length if freedom == TURN else system.force / system.length


def _stub(lines: Lines, node: int, side: int) -> None:
    """Append a stub, which makes a rigid section of a node."""
    depth, E, rho, _ = _section(lines.mesh, min(node, lines.mesh.count - 1), lines.system)
    x, first = _real(lines.mesh.x[node] * lines.system.length), _STUB + 2 * lines.elements
    lines.add("*NODE,NSET=BEAM", f"{first},{x},{_real(depth / 2)},0.")
    lines.add(f"{first + 1},{x},{_real(depth)},0.")
    name = lines.element("B32R", (side, first, first + 1))
    _material(lines, name, (depth, E, LIGHT * rho, E * lines.mesh.shear_modulus), "1.,0.,0.")


def _moving(lines: Lines, node: int, side: int, freedom: int) -> tuple[int, int]:
    """Return the node and freedom that move as a freedom of the beam does: a point as it turns."""
    if freedom != TURN:
        return side, freedom
    point = lines.point(node)
    lines.tie(point, AXIAL, (side, TURN, 1.0))
    lines.add("*BOUNDARY", f"{point},2,3")
    return point, AXIAL


def _mass(lines: Lines, node: int, mass: float, offset: float, inertia: float) -> None:
    """Append a mass with its centre off the node, and its inertia as a mass at a turning point."""
    system, side = lines.system, _sides(lines.mesh, node)[0]
    point = lines.point(node)
    lever = [(side, TURN, offset * system.length)] if offset else []
    lines.tie(point, AXIAL, (side, AXIAL, 1.0))
    lines.tie(point, LATERAL, (side, LATERAL, 1.0), *lever)
    lines.add("*BOUNDARY", f"{point},3,3")
    _inert(lines, point, mass * system.mass)
    if inertia:
        turned, _ = _moving(lines, node, side, TURN)
        _inert(lines, turned, inertia * system.mass * system.length**2)


def _inert(lines: Lines, point: int, mass: float) -> None:
    name = lines.element("MASS", [point])
    lines.add(f"*MASS,ELSET={name}", _real(mass))


def _spring(lines: Lines, moving: list[tuple[int, int]], k: float) -> None:
    """Append a spring between a freedom and the ground, or between two.

    For buckling it is a cube of solid, whose face moves as the freedom does: CalculiX multiplies
    the stiffness of its spring elements by the load factor too.
    """
    if lines.buckling:
        _cube(lines, moving, k)
        return
    name = lines.element(f"SPRING{len(moving)}", [node for node, _ in moving])
    lines.add(f"*SPRING,ELSET={name}", ",".join(str(freedom) for _, freedom in moving), _real(k))


_CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def _cube(lines: Lines, moving: list[tuple[int, int]], k: float) -> None:
    """Append a cube of side 1 and E = k; its face x = 1 moves, the other one too or not at all."""
    lines.add("*NODE")
    nodes = [lines.points + 1 + i for i in range(8)]
    lines.points += 8
    lines.add(*(f"{n},{x}.,{y}.,{z}." for n, (x, y, z) in zip(nodes, _CORNERS, strict=True)))
    name = lines.element("C3D8", nodes)
    lines.add(f"*MATERIAL,NAME={name}", "*ELASTIC", f"{_real(k)},0.")
    lines.add(f"*SOLID SECTION,ELSET={name},MATERIAL={name}", "*BOUNDARY")
    lines.add(*(f"{n},2,3" for n in nodes))
    faces = [
        [n for n, corner in zip(nodes, _CORNERS, strict=True) if corner[0] == x] for x in (1, 0)
    ]
    for face, to in zip(faces, moving, strict=False):
        for n in face:
            lines.tie(n, AXIAL, (*to, 1.0))
    if len(moving) == 1:
        lines.add("*BOUNDARY", *(f"{n},1,1" for n in faces[1]))


def _joint(lines: Lines, node: int) -> None:
    """Append what links the two sides of a joint: springs where it gives way, else equations.

    Under buckling loads it gives no way along x, where it would change nothing.
    """
    left, right = _sides(lines.mesh, node)
    lines.tie(right, LATERAL, (left, LATERAL, 1.0))
    for freedom, c in lines.mesh.joints[node].items():
        if not c or (lines.buckling and freedom == AXIAL):
            lines.tie(right, freedom, (left, freedom, 1.0))
            continue
        sides = [_moving(lines, node, side, freedom) for side in (left, right)]
        _spring(lines, sides, _stiffness_unit(freedom, lines.system) / c)


def _hold(lines: Lines, held: list[tuple[int, int]]) -> None:
    """Append supports; all nodes stay in the plane, and no part of the beam spins."""
    lines.add("*BOUNDARY", "BEAM,3,3")
    spun = [1, *(_sides(lines.mesh, node)[1] for node in lines.mesh.joints)]
    lines.add(*(f"{number},4,5" for number in spun))
    lines.add(*(f"{2 * node + 1},{freedom},{freedom}" for node, freedom in held))


def _soften(lines: Lines, result: ModalResult) -> None:
    """Append springs that are next to nothing where the beam would move as a rigid body."""
    mesh = lines.mesh
    rigid = [mode for mode in result.modes if mode.number == 0]
    if not rigid:
        return
    first = min(mode.omega2 for mode in result.modes if mode.number and mode.omega2 > 0)
    mass = float(np.sum(mesh.mass * mesh.lengths)) + sum(item.mass for _, item in mesh.masses)
    k = SOFT * first * mass * lines.system.force / lines.system.length
    lines.add("** Springs that are next to nothing hold what moves as a rigid body")
    for number in (1, 2 * mesh.count + 1):
        for freedom in (AXIAL, LATERAL):
            _spring(lines, [(number, freedom)], k)


def _steps(mesh: Mesh, system: System, expected: Expected, analysis: Analysis) -> Iterator[str]:
    if analysis == "buckling":
        yield from (
            "*STEP",
            "*BUCKLE",
            f"{expected.asked},1e-8",
            *_forces(mesh, system, mesh.nodal_forces(0 * mesh.x)),
        )
        yield from ("*NODE FILE,OUTPUT=2D", "U", "*END STEP")
        return
    loaded = not mesh.beam.is_unloaded
    if loaded:
        moved = mesh.stretch()
        supports = [node for node, freedom in sorted(mesh.held) if freedom == AXIAL]
        moved -= moved[supports[0]] if supports else 0.0
        yield from ("*STEP", "*STATIC", *_forces(mesh, system, mesh.nodal_forces(moved)))
        yield from _moved_supports(mesh, system, moved, supports)
        yield "*END STEP"
    yield from ("*STEP,PERTURBATION" if loaded else "*STEP", "*FREQUENCY", f"{expected.asked + 3}")
    yield from ("*NODE FILE,OUTPUT=2D", "U", "*END STEP")


def _forces(mesh: Mesh, system: System, forces: Array) -> Iterator[str]:
    """Yield the forces along x that leave N in the elements."""
    yield "*CLOAD"
    for k in np.flatnonzero(np.abs(forces) > 1e-12 * np.max(np.abs(mesh.N))).tolist():
        yield f"{2 * k + 1},1,{_real(forces[k] * system.force)}"


def _moved_supports(mesh: Mesh, system: System, moved: Array, supports: list[int]) -> Iterator[str]:
    """Yield how far supports along x move under N beside the first of them."""
    if supports[1:]:
        yield "*BOUNDARY"
        yield from (f"{2 * k + 1},1,1,{_real(moved[k] * system.length)}" for k in supports[1:])
