"""A beam from a NASTRAN deck: elements along one line, its masses, springs, joints and preload.

`EI = E I`, `EA = E A`, `m = rho A + NSM`. The beam bends in plane 1 of its elements (I1) or in
plane 2 (I2). Supports and springs count in this plane and along the axis. N follows from the forces
along the axis of the subcase that a STATSUB names: the bar under them, solved for its displacement
u, has `N = -EA u'`, compression positive.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt

from antinode.attachments import Attachment, Joint, PointMass, Spring
from antinode.beam import AxialEnd, Beam, End, Ends
from antinode.errors import InputError
from antinode.text import counted

from .nastran_cards import Card, Subcase, read_deck
from .nastran_model import Element, Model, Section, read_model
from .units import SI, System

Array = npt.NDArray[np.float64]
_SAME = 1e-6  # of the length: what may be off the line
_ENDS: dict[tuple[bool, bool], End] = {
    (True, True): "clamped",
    (True, False): "pinned",
    (False, True): "sliding",
    (False, False): "free",
}


@dataclass(frozen=True)
class Line:
    """The elements in order along their line.

    Attributes
    ----------
    x : array, shape (n + 1,)
        Along the axis, in units of the file.
    elements : tuple of Element
        From left to right.
    node : dict
        Index in `x` by grid.
    right_grids : frozenset of int
        Grids on the right side of a joint.
    frame : array, shape (3, 3)
        Axis, direction of bending, and the normal of both.
    """

    x: Array
    elements: tuple[Element, ...]
    node: dict[int, int]
    right_grids: frozenset[int]
    frame: Array

    def freedoms(self, card: Card) -> tuple[int, int, int]:
        """Return the numbers of axial, lateral and rotational freedom, if the line has them."""
        axis, lateral, normal = (int(np.argmax(np.abs(v))) for v in self.frame)
        if np.any(np.sort(np.abs(self.frame), axis=1)[:, :2] > _SAME):
            raise card.error(
                "the beam or its plane of bending is oblique to the axes, so that freedoms cannot "
                "be told apart: turn the model"
            )
        return axis + 1, lateral + 1, normal + 4


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
    line = _line(model, plane)
    modal, static = _subcases(deck.subcases, path)
    tables, x = _tables(model, line, plane)
    attachments, held = _attachments(model, line, modal)
    N = _preload(model, line, static) if static else np.zeros(len(line.elements))
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
        ends=_ends(held, len(line.x) - 1),
        interpolation="linear" if tapered else "step",
        name=path.stem[:200] or "beam",
    )
    supports = _inner_supports(held, line.x)
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


# --- the line --------------------------------------------------------------------------------


def _line(model: Model, plane: int) -> Line:
    """Order the elements from left to right, or say why they make up no line."""
    used = list(dict.fromkeys(g for e in model.elements.values() for g in (e.left, e.right)))
    cards = {g: e.card for e in model.elements.values() for g in (e.left, e.right)}
    at = np.array([model.grid(g, cards[g]).at for g in used])
    axis, length = _axis(at, model)
    off = np.linalg.norm(at - at[0] - np.outer((at - at[0]) @ axis, axis), axis=1)
    for k in np.flatnonzero(off > _SAME * length)[:1]:
        raise model.grids[used[k]].card.error(
            f"grid {used[k]} is {off[k]:.3g} off the line of the others; one straight beam is read"
        )
    along = dict(zip(used, at @ axis, strict=True))
    x = _places(np.array(sorted(along.values())), length)
    node = {g: int(np.argmin(np.abs(x - s))) for g, s in along.items()}
    ordered, right_grids = _ordered(model, node, len(x))
    return Line(x, ordered, node, right_grids, _frame(model, ordered, axis, plane))


def _axis(at: Array, model: Model) -> tuple[Array, float]:
    """Return the direction of the line, positive along its largest component, and its length."""
    far = at[np.argmax(np.linalg.norm(at - at[0], axis=1))]
    other = at[np.argmax(np.linalg.norm(at - far, axis=1))]
    length = float(np.linalg.norm(far - other))
    if not 0 < length < 1e150:
        raise InputError(
            f"{model.deck.path}: all elements have the length 0; correct the GRID cards"
        )
    axis = (far - other) / length
    axis[np.abs(axis) < 1e-12] = 0.0
    return axis * np.sign(axis[np.argmax(np.abs(axis))]), length


def _places(x: Array, length: float) -> Array:
    return np.asarray(x[np.append([True], np.diff(x) > 1e-9 * length)])


def _ordered(
    model: Model, node: dict[int, int], places: int
) -> tuple[tuple[Element, ...], frozenset[int]]:
    """Return the elements from left to right, and the grids on the right side of joints."""
    found: dict[int, Element] = {}
    for element in model.elements.values():
        a, b = node[element.left], node[element.right]
        if abs(a - b) != 1:
            between = "has the length 0" if a == b else "runs past another grid of the beam"
            raise element.card.error(f"this element {between}; elements must follow each other")
        if min(a, b) in found:
            other = found[min(a, b)].card.line
            raise element.card.error(f"this element lies beside that of line {other}; remove one")
        found[min(a, b)] = element
    for k in range(places - 1):
        if k not in found:
            raise InputError(f"{model.deck.path}: there is a gap between the elements; close it")
    ordered = tuple(found[k] for k in range(places - 1))
    right = set()
    for before, after in pairwise(ordered):
        end, start = _right_end(before, node), _left_end(after, node)
        if end != start:
            _check_joint(model, end, start, after.card)
            right.add(start)
    return ordered, frozenset(right)


def _left_end(element: Element, node: dict[int, int]) -> int:
    return min(element.left, element.right, key=lambda g: node[g])


def _right_end(element: Element, node: dict[int, int]) -> int:
    return max(element.left, element.right, key=lambda g: node[g])


def _check_joint(model: Model, left: int, right: int, card: Card) -> None:
    if not _linked(model, left, right) and not _linked(model, right, left):
        raise card.error(
            f"grids {left} and {right} stand at one place, but no RBE2 links them across; "
            "merge them, or link them"
        )


def _linked(model: Model, left: int, right: int) -> str:
    """Return the freedoms in which an RBE2 ties the right grid to the left one."""
    freedoms = ""
    for card in model.links:
        if card.integer(2) == left and str(right) in card.fields[3:]:
            freedoms += card.text(3)
    return freedoms


def _frame(model: Model, elements: tuple[Element, ...], axis: Array, plane: int) -> Array:
    """Return axis, direction of bending and their normal, the same for all elements."""
    first: Array | None = None
    for element in elements:
        card = element.card
        start = model.grid(element.left, card).at
        towards = element.towards
        v = model.grid(towards, card).at - start if isinstance(towards, int) else towards
        v = v - (v @ axis) * axis
        size = float(np.linalg.norm(v))
        if size < 1e-9 * max(float(np.linalg.norm(towards)), 1e-300):
            raise card.error("its orientation runs along the beam; give a vector across it")
        v = v / size
        first = v if first is None else first
        if abs(float(v @ first)) < 1 - 1e-9:
            raise card.error("its plane 1 is turned against that of the first element")
    assert first is not None
    lateral = first if plane == 1 else np.cross(axis, first)
    return np.stack([axis, lateral, np.cross(axis, lateral)])


# --- properties ------------------------------------------------------------------------------


def _tables(model: Model, line: Line, plane: int) -> tuple[dict[str, Array], Array]:
    """Return the properties on intervals, and the breakpoints."""
    x, rows = [line.x[:1]], []
    for k, element in enumerate(line.elements):
        table = _section_rows(model, element, plane)
        if _left_end(element, line.node) != element.left:
            table = np.column_stack([1 - table[::-1, 0], table[::-1, 1:]])
        x.append(line.x[k] + (line.x[k + 1] - line.x[k]) * table[1:, 0])
        rows.append(np.stack([table[:-1, 1:], table[1:, 1:]], axis=2))
    m, EI, EA = np.concatenate(rows).transpose(1, 0, 2)
    tables = {"mass_per_length": m * model.mass_factor, "bending_stiffness": EI}
    if np.all(EA > 0):
        tables["axial_stiffness"] = EA
    return tables, np.concatenate(x)


def _section_rows(model: Model, element: Element, plane: int) -> Array:
    """Return fraction, m, EI and EA along an element, in units of the file."""
    section = _section(model, element)
    if section.material not in model.materials:
        raise section.card.error(f"there is no MAT1 {section.material}")
    E, rho = model.materials[section.material]
    fraction, area, inertia_1, inertia_2, nsm = section.rows.T
    EI = E * (inertia_1 if plane == 1 else inertia_2)
    mass = rho * area + nsm
    for what, values in ((f"I{plane} times E", EI), ("mass per length", mass)):
        if not np.all(values > 0) or not np.all(np.isfinite(values)):
            raise section.card.error(f"{what} is {np.min(values):g}; it must be positive")
    return np.stack([fraction, mass, EI, E * area], axis=1)


def _section(model: Model, element: Element) -> Section:
    if element.prop not in model.sections:
        raise element.card.error(f"there is no PBAR or PBEAM {element.prop}")
    return model.sections[element.prop]


# --- what is attached ------------------------------------------------------------------------


def _attachments(
    model: Model, line: Line, modal: Subcase | None
) -> tuple[list[Attachment], dict[int, set[str]]]:
    """Return masses, springs and joints, and what the supports of the modes hold at each node."""
    items: list[Attachment] = [_point_mass(model, line, card) for card in model.masses]
    items += [_spring(line, card) for card in model.springs if not _is_joint(line, card)]
    items += _joints(model, line)
    sets = {number for number, *_ in model.supports}
    if modal is None and len(sets) > 1:
        names = ", ".join(map(str, sorted(sets)))
        raise InputError(
            f"{model.deck.path}: there are SPC sets {names}, and no case control says which one "
            "holds; keep one of them"
        )
    chosen = next(iter(sets), None) if modal is None else modal.settings.get("SPC")
    return items, _held(model, line, chosen)


def _held(model: Model, line: Line, chosen: int | None) -> dict[int, set[str]]:
    """Return which of axial, lateral and rotational are held at each node."""
    given = [(g, grid.held, grid.card) for g, grid in model.grids.items() if grid.held]
    given += [(g, freedoms, card) for n, g, freedoms, card in model.supports if n == chosen]
    held: dict[int, set[str]] = {}
    for grid, freedoms, card in given:
        if grid not in line.node:
            continue
        if set("123456") <= set(freedoms):
            names = {"axial", "lateral", "rotational"}
        else:
            own = zip(("axial", "lateral", "rotational"), line.freedoms(card), strict=True)
            names = {name for name, freedom in own if str(freedom) in freedoms}
        if names:
            _check_side(line, grid, card)
            held.setdefault(line.node[grid], set()).update(names)
    return held


def _check_side(line: Line, grid: int, card: Card) -> None:
    if grid in line.right_grids:
        raise card.error(f"grid {grid} is the right side of a joint; attach it to the left side")


def _ends(held: dict[int, set[str]], last: int) -> Ends:
    def of(node: int) -> tuple[End, AxialEnd]:
        here = held.get(node, set())
        axial: AxialEnd = "fixed" if "axial" in here else "free"
        return _ENDS["lateral" in here, "rotational" in here], axial

    (left, left_axial), (right, right_axial) = of(0), of(last)
    return Ends(left, right, left_axial, right_axial)


def _inner_supports(held: dict[int, set[str]], x: Array) -> list[Spring]:
    inner = [k for k in sorted(held) if 0 < k < len(x) - 1]
    stiff = {name: {k: math.inf if name in held[k] else 0.0 for k in inner} for name in _FREEDOMS}
    return [
        Spring(float(x[k]), stiff["lateral"][k], stiff["rotational"][k], stiff["axial"][k])
        for k in inner
    ]


_FREEDOMS = ("axial", "lateral", "rotational")


def _node(line: Line, grid: int, card: Card) -> int:
    if grid not in line.node:
        raise card.error(f"grid {grid} is no grid of the beam's elements")
    _check_side(line, grid, card)
    return line.node[grid]


def _point_mass(model: Model, line: Line, card: Card) -> PointMass:
    if card.text(3) not in ("", "0"):
        raise card.error("a coordinate system in field 3 cannot be read")
    offset = np.array([card.real(i, 0.0) for i in (5, 6, 7)])
    axis, _, normal = line.frame
    along = float(offset @ axis)
    if np.linalg.norm(offset - along * axis) > _SAME * float(np.ptp(line.x)):
        raise card.error("its centre is off the axis of the beam; only an offset along it is read")
    I = [card.real(i, 0.0) for i in range(9, 15)]  # noqa: E741
    tensor = np.array([[I[0], -I[1], -I[3]], [-I[1], I[2], -I[4]], [-I[3], -I[4], I[5]]])
    mass, factor = card.real(4), model.mass_factor
    if not mass > 0:
        raise card.error(f"field 4 is {mass:g}; a mass must be positive")
    at = float(line.x[_node(line, card.integer(2), card)])
    return PointMass(at, mass * factor, float(normal @ tensor @ normal) * factor, along)


def _ends_of(card: Card) -> list[tuple[int, int]]:
    """Return grid and freedom of the ends of a CELAS2 that are not to the ground."""
    pairs = [(card.integer(3, 0), card.integer(4, 0)), (card.integer(5, 0), card.integer(6, 0))]
    return [(grid, freedom) for grid, freedom in pairs if grid]


def _is_joint(line: Line, card: Card) -> bool:
    ends = _ends_of(card)
    return len(ends) == 2 and any(grid in line.right_grids for grid, _ in ends)


def _spring(line: Line, card: Card) -> Spring:
    ends, k = _ends_of(card), card.real(2)
    if len(ends) != 1:
        raise card.error("it must join one grid to the ground, or the two sides of a joint")
    if not k > 0:
        raise card.error(f"field 2 is {k:g}; a stiffness must be positive")
    ((grid, freedom),) = ends
    axial, lateral, rotational = line.freedoms(card)
    x = float(line.x[_node(line, grid, card)])
    if freedom not in (axial, lateral, rotational):
        raise card.error(f"freedom {freedom} is none of the plane of bending; remove it")
    return Spring(x, k * (freedom == lateral), k * (freedom == rotational), k * (freedom == axial))


def _joints(model: Model, line: Line) -> list[Joint]:
    """Return the joints, by the links and springs between the two grids of each."""
    found = []
    for a, b in pairwise(line.elements):
        left, right = _right_end(a, line.node), _left_end(b, line.node)
        if left == right:
            continue
        rigid = _linked(model, left, right) + _linked(model, right, left)
        axial, lateral, rotational = line.freedoms(b.card)
        if str(lateral) not in rigid:
            raise b.card.error(f"grids {left} and {right} are not linked in freedom {lateral}")
        found.append(
            Joint(
                float(line.x[line.node[left]]),
                _compliance(model, line, (left, right), rotational, rigid, b.card),
                _compliance(model, line, (left, right), axial, rigid, b.card),
            )
        )
    return found


def _compliance(
    model: Model, line: Line, grids: tuple[int, int], freedom: int, rigid: str, card: Card
) -> float:
    if str(freedom) in rigid:
        return 0.0
    k = sum(
        spring.real(2)
        for spring in model.springs
        if _is_joint(line, spring) and {(g, freedom) for g in grids} == set(_ends_of(spring))
    )
    if not k > 0:
        raise card.error(f"grids {grids[0]} and {grids[1]} are not joined in freedom {freedom}")
    return 1 / k


# --- the preload -----------------------------------------------------------------------------


def _subcases(subcases: tuple[Subcase, ...], path: Path) -> tuple[Subcase | None, Subcase | None]:
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


def _preload(model: Model, line: Line, static: Subcase) -> Array:
    """Return N in every element, compression positive, in units of the file."""
    if "LOAD" not in static.settings:
        raise InputError(f"{model.deck.path}: subcase {static.number} has no LOAD, but a STATSUB")
    k = _axial_stiffness(model, line)
    forces, held = (
        _axial_forces(model, line, static.settings["LOAD"]),
        _held(model, line, static.settings.get("SPC")),
    )
    fixed = [node for node, names in held.items() if "axial" in names]
    n = len(line.x)
    diagonal = np.zeros(n)
    diagonal[:-1] += k
    diagonal[1:] += k
    grounded = False
    for item in (_spring(line, c) for c in model.springs if not _is_joint(line, c)):
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
        fraction, _, _, EA = _section_rows(model, element, 1).T
        if not np.all(EA > 0):
            raise element.card.error("its section has no area A, which the preload needs")
        size = (line.x[i + 1] - line.x[i]) * np.diff(fraction)
        ratio = np.log(EA[1:] / EA[:-1])
        mean = np.where(ratio == 0, 1.0, np.expm1(ratio) / np.where(ratio == 0, 1.0, ratio))
        compliance[i] = np.sum(size / (EA[:-1] * mean))
    for joint in _joints(model, line):
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
