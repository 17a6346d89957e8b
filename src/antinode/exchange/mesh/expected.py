"""What a solver should find in a deck: of its mesh, beside the same of the beam itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.beam.attachments import Dashpot, PointFeedback, PointMass
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES, FamilyName
from antinode.errors import InputError
from antinode.modes.hertz import hertz
from antinode.modes.result import ModalResult, Mode

from .analyses import Analysis
from .elements import Kind
from .mesh import SLENDER, Mesh

FACTORS = 6
"""How many load factors: those of the reversed force, below zero, are among them."""
MOST = 50
"""Most modes that a deck asks for."""


@dataclass(frozen=True)
class Expected:
    """What stands in the head of a deck.

    Attributes
    ----------
    lines : tuple of str
        A table: of the mesh, of the beam.
    asked : int
        How many modes a solver must find until all of the table are among them.
    near : float or None
        Where a solver should look for load factors.
    """

    lines: tuple[str, ...]
    asked: int
    near: float | None = None


def comparable(
    result: ModalResult, analysis: Analysis, *, torsion: bool = False
) -> tuple[ModalResult, tuple[str, ...]]:
    """Return modes that a deck's elements can give, and what they leave out.

    Raises
    ------
    InputError
        If the analysis asks for an axial force, and the beam has none.
    """
    from antinode.modes.solve import solve_one

    beam, notes = result.beam, []
    if beam.axial_stiffness is None:
        notes.append(f"EA is not known: EI/(L/{1 / SLENDER:.0f})^2 stands for it")
    if beam.is_unloaded and analysis in ("statsub", "buckling"):
        raise InputError(f"--analysis {analysis}: the beam is under no axial force; choose modes")
    known = {0, 1, 3, 5} if torsion else {0, 1, 5}
    kept = [name for name in result.families if set(FAMILIES[name].freedoms) <= known]
    if len(kept) < len(result.families):
        notes.append("torsion is left out: the nodes of this mesh do not turn about x")
    if any(isinstance(item, Dashpot) for item in beam.attachments):
        notes.append("dashpots are left out: these are undamped modes")
    if any(isinstance(item, PointFeedback) for item in beam.attachments):
        notes.append(
            "point feedback has no card here: in the deck, and in the frequencies beside it, it "
            "is left out"
        )
        kept_items = tuple(i for i in beam.attachments if not isinstance(i, PointFeedback))
        beam = replace(beam, attachments=kept_items)
    offset = any(isinstance(item, PointMass) and item.offset for item in beam.attachments)
    if offset and beam.offset_weight and beam.axial_acceleration and analysis != "unloaded":
        beam = replace(beam, offset_weight=False)
        notes.append("the weight of offset masses acts at their nodes, for the beam here too")
    if any(beam.following()):
        beam = replace(beam, ends=replace(beam.ends, left_follower=0.0, right_follower=0.0))
        if analysis != "unloaded":
            notes.append(
                "end forces that turn with the end have no card here: in the deck, and in the "
                "frequencies beside it, they keep their direction"
            )
    if analysis == "unloaded":
        beam = beam.without_axial_force()
    if beam is result.beam:
        modes = tuple(mode for mode in result.modes if mode.family in kept)
        return replace(result, modes=modes), tuple(notes)
    number = max(mode.number for mode in result.modes)
    options: dict[str, Any] = {"tolerance": result.tolerance, "families": kept}
    return solve_one(beam, number, damping="none", **options), tuple(notes)


def expected_modes(result: ModalResult, mesh: Mesh, kind: Kind) -> Expected:
    """Return the frequencies to expect."""
    rows: list[tuple[Mode, float]] = []
    others: list[float] = []
    for name in dict.fromkeys(mode.family for mode in result.modes):
        modes = sorted((m for m in result.modes if m.family == name), key=lambda m: m.omega2)
        found = _lowest(mesh, kind, name, modes, top=max(m.omega2 for m in result.modes))
        rows += zip(modes, found, strict=False)
        others += found
    listed = {mode.name: value for mode, value in rows}
    top = max(listed.values())
    asked = sum(value <= top * (1 + 1e-9) for value in others)
    head = (
        "Frequencies to expect [Hz]: of this mesh, and beside them of the beam itself",
        f"{'mode':<26}{'this mesh':>20}{'beam':>20}",
    )
    table = (_row(mode, listed[mode.name]) for mode in result.modes)
    strain = _strain_note(mesh) if kind == "solids" else ()
    more = _twists(mesh, top) if kind == "solids" else 0
    return Expected((*head, *table, *strain, *_beyond(listed, others)), min(asked, MOST) + more)


def _twists(mesh: Mesh, top: float) -> int:
    """Return about how many modes solids that are soft in shear have besides: they twist.

    A square section that warps freely has the stiffness `4 G I` of the shear in one plane, and
    the inertia `2 rho I`.
    """
    if mesh.kGA is None:
        return 0
    phase = np.sqrt(max(top, 0.0) * mesh.mass / (2 * mesh.solid_shear)) * mesh.lengths
    return int(np.ceil(1.1 * float(np.sum(phase)) / np.pi)) + 2


def _strain_note(mesh: Mesh, factor: float = 1.0) -> tuple[str, ...]:
    """Say how far the strain of the preload, of which solids have more effects, may matter."""
    largest = abs(factor) * float(np.max(np.abs(mesh.N / mesh.EA)))
    return (f"Under N a solver may be off by its strain, at most {largest:.1e}",) if largest else ()


def _beyond(listed: dict[str, float], others: list[float]) -> tuple[str, ...]:
    """Say which of the listed modes lie beyond those that a deck asks for."""
    if len(others) <= MOST:
        return ()
    last = sorted(others)[MOST - 1]
    beyond = ", ".join(name for name, value in listed.items() if value > last)
    return (f"Beyond the {MOST} modes that are asked for: {beyond}",) if beyond else ()


def _lowest(mesh: Mesh, kind: Kind, name: FamilyName, modes: list[Mode], top: float) -> list[float]:
    """Return the lowest eigenvalues of a family on the mesh, up to all that others list."""
    from .finite_elements import eigenvalues

    values = np.array([mode.omega2 for mode in modes])
    below = float(values[0] - 0.5 * np.min(values[values > 0], initial=np.max(np.abs(values))))
    count, loaded = len(modes) + 4, not mesh.beam.is_unloaded
    while True:
        found = eigenvalues(mesh, kind, name, below, count, loaded=loaded)
        if found[-1] > top or count > MOST:
            return [_cleared(float(value), values) for value in found]
        count *= 2


def _cleared(value: float, values: np.ndarray[Any, Any]) -> float:
    """Return 0 for what is rounding of a rigid mode."""
    return 0.0 if abs(value) < 1e-7 * float(np.max(np.abs(values))) else value


def _row(mode: Mode, found: float) -> str:
    def text(value: float) -> str:
        return f"omega2 {value:.8g}" if value < 0 else f"{hertz(value):.8g}"

    return f"{mode.name:<26}{text(found):>20}{text(mode.omega2):>20}"


def critical_factor(beam: Beam) -> float:
    """Return the beam's lowest load factor.

    Raises
    ------
    InputError
        If the beam is not held, or does not buckle.
    """
    from antinode.modes.buckling import buckling
    from antinode.modes.rigid import rigid_modes

    if rigid_modes(beam, BENDING):
        raise InputError(
            "--analysis buckling: the beam moves sideways as a rigid body, so that a solver finds "
            "no static state; hold it, or choose modes"
        )
    own = buckling(beam)
    if own is None:
        raise InputError("--analysis buckling: no factor on its axial force buckles the beam")
    return own.load_factor


def expected_buckling(factor: float, mesh: Mesh, kind: Kind) -> Expected:
    """Return the load factor to expect, beside that of the beam."""
    from .finite_elements import load_factor

    found = load_factor(mesh, kind)
    if found is None:
        raise InputError("--analysis buckling: no factor on its axial force buckles the mesh")
    head = "Lowest positive load factor to expect: of this mesh, and beside it of the beam itself"
    row = f"{'buckling':<26}{found:>20.8g}{factor:>20.8g}"
    strain = _strain_note(mesh, factor) if kind == "solids" and mesh.kGA is not None else ()
    return Expected((head, row, *strain), FACTORS, 0.9 * found)


def header(title: str, notes: tuple[str, ...], expected: Expected, version: str) -> Iterator[str]:
    """Yield the lines that stand at the top of a deck."""
    yield f"{title}: a beam by antinode {version}"
    yield from (f"Note: {note}" for note in notes)
    yield from expected.lines
