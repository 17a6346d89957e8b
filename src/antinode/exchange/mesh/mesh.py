"""A beam as uniform elements between nodes, with what is attached to these: the mesh of a deck."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.attachments import (
    Attachment,
    Dashpot,
    Joint,
    Pedestal,
    PointFeedback,
    PointMass,
    Spring,
    refuse_pedestals,
)
from antinode.beam.beam import Beam
from antinode.beam.ends import AxialEnd, Ends
from antinode.beam.families import BENDING, FAMILIES, LONGITUDINAL, TORSION, tells
from antinode.errors import InputError

Item = TypeVar("Item", PointMass, Spring, Joint)

SLENDER = 1e-3
"""Radius of gyration in lengths of a beam without EA."""
AXIAL, LATERAL, TURN, TWIST = 1, 2, 6, 4
"""Freedoms of a node, as solvers number them: along x, along y, about z, about x."""
_GAUSS = 0.5 - math.sqrt(3) / 6, 0.5 + math.sqrt(3) / 6
_AXIAL: dict[str, AxialEnd] = {"free": "free", "fixed": "fixed"}
_END = {"free": (), "pinned": (LATERAL,), "sliding": (TURN,), "clamped": (LATERAL, TURN)}


@dataclass(frozen=True)
class Mesh:
    """Uniform elements from left to right, SI.

    Attributes
    ----------
    beam : Beam
        Whose attachments and ends these are.
    x : array, shape (n + 1,)
    mass, EI, EA, N : array, shape (n,)
    GJ, inertia : array, shape (n,), optional
        Torsional stiffness [N m^2] and polar inertia per length [kg m], of a mesh that twists.
    kGA : array, shape (n,), optional
        Of elements that take N and shear by Engesser [N]; inf is rigid. None: rigid in shear.
    rotary : array, shape (n,), optional
        Rotary inertia per length [kg m].
    foundation, added : array, shape (n,), optional
        Stiffness of a foundation [N/m^2], and mass per length that moves sideways alone [kg/m].
    loss : array, shape (n,), optional
        Loss factor.
    """

    beam: Beam
    x: Array
    mass: Array
    EI: Array
    EA: Array
    N: Array
    GJ: Array | None = None
    inertia: Array | None = None
    kGA: Array | None = None
    rotary: Array | None = None
    foundation: Array | None = None
    added: Array | None = None
    loss: Array | None = None

    @property
    def count(self) -> int:
        """The number of elements."""
        return len(self.N)

    @property
    def twists(self) -> bool:
        """Whether its nodes turn about x."""
        return self.GJ is not None

    @property
    def lengths(self) -> Array:
        """Of the elements [m]."""
        return np.diff(self.x)

    @property
    def shear_modulus(self) -> float:
        """G of solid elements in E: little shear is left, and no more digits than that are lost.

        Of a section of depth h its share in mode k is about `(k h/L)^2 E/G`.
        """
        slenderness2 = 12 * float(np.max(self.EI / self.EA)) / self.beam.length**2
        return min(max(1e5 * slenderness2, 1.0), 100.0)

    def node(self, x: float) -> int:
        """Return the node at a station."""
        return int(np.argmin(np.abs(self.x - x)))

    def attached(self, kind: type[Item]) -> list[tuple[int, Item]]:
        """Return what of a kind is attached, with its nodes."""
        items = self.beam.attachments
        return [(self.node(item.x), item) for item in items if isinstance(item, kind)]

    @cached_property
    def joints(self) -> dict[int, dict[int, float]]:
        """The compliance by freedom at each node that has a joint, and so two sides."""
        found: dict[int, dict[int, float]] = {}
        for node, item in self.attached(Joint):
            own = {AXIAL: item.axial, TURN: item.rotational, TWIST: item.torsional}
            here = found.setdefault(node, {})
            for freedom in own if self.twists else (AXIAL, TURN):
                here[freedom] = here.get(freedom, 0.0) + own[freedom]
        return dict(sorted(found.items()))

    @property
    def masses(self) -> list[tuple[int, PointMass]]:
        """Masses with their nodes."""
        return self.attached(PointMass)

    @property
    def springs(self) -> list[tuple[int, int, float]]:
        """Finite springs to the ground: node, freedom, stiffness."""
        return [row for row in self._all_springs() if 0 < row[2] < math.inf]

    @property
    def bedding(self) -> list[tuple[int, int, float]]:
        """The foundation as springs at the nodes: node, freedom, stiffness."""
        return [(node, LATERAL, k) for node, k in self.at_nodes(self.foundation)]

    def _all_springs(self) -> list[tuple[int, int, float]]:
        rows = []
        for node, item in self.attached(Spring):
            if item.coupling:
                raise InputError(
                    f"the spring at x = {item.x:g} m couples displacement and slope; a deck of "
                    "springs cannot hold that: leave its coupling out, or write a .toml"
                )
            stiffness = {AXIAL: item.axial, LATERAL: item.translational, TURN: item.rotational}
            if self.twists:
                stiffness[TWIST] = item.torsional
            rows += [(node, freedom, k) for freedom, k in stiffness.items()]
        return rows

    @property
    def held(self) -> set[tuple[int, int]]:
        """What the ends and supports hold: node and freedom."""
        ends, last = self.beam.ends, self.count
        found = {(0, freedom) for freedom in _END[ends.left]}
        found |= {(last, freedom) for freedom in _END[ends.right]}
        axial = zip((0, last), ends.of(LONGITUDINAL), strict=True)
        found |= {(node, AXIAL) for node, end in axial if end == "fixed"}
        torsion = zip((0, last), ends.of(TORSION), strict=True)
        found |= {(node, TWIST) for node, end in torsion if end == "fixed" and self.twists}
        return found | {
            (node, freedom) for node, freedom, k in self._all_springs() if k == math.inf
        }

    def lumped(self, per_length: Array | None) -> tuple[Array, Array]:
        """Return what the halves of elements have, to the left and right of each node."""
        half = np.zeros(self.count) if per_length is None else per_length * self.lengths / 2
        return np.append(0.0, half), np.append(half, 0.0)

    def at_nodes(self, per_length: Array | None) -> list[tuple[int, float]]:
        """Return what of a property per length is not zero at each node, both halves together."""
        whole = np.sum(self.lumped(per_length), axis=0)
        return [(node, float(whole[node])) for node in np.flatnonzero(whole).tolist()]

    @cached_property
    def solid_shear(self) -> Array:
        """The kGA of solid elements [N]: next to rigid where the beam is rigid."""
        rigid = self.shear_modulus * self.EA
        return rigid if self.kGA is None else np.where(np.isinf(self.kGA), rigid, self.kGA)

    def as_bar(self) -> Mesh:
        """Return the bar whose motion along x is this mesh's about x."""
        if self.GJ is None or self.inertia is None:
            raise ValueError("the mesh does not twist")
        left, right = (_AXIAL[end] for end in self.beam.ends.of(TORSION))
        ends = Ends(left_axial=left, right_axial=right)
        items = tuple(_along(item) for item in self.beam.attachments)
        beam = replace(self.beam, ends=ends, attachments=items)
        return Mesh(beam, self.x, self.inertia, self.EI, self.GJ, 0.0 * self.N)

    def held_under(self, *, buckling: bool) -> list[tuple[int, int]]:
        """Return what holds a solver's mesh: under buckling loads N must be free to act."""
        if not buckling:
            return sorted(self.held)
        return sorted({(0, AXIAL), *(own for own in self.held if own[1] != AXIAL)})

    def stretch(self) -> Array:
        """Return how far N moves the nodes [m], on the left side of a joint; node 0 stays."""
        moved = -np.append(0.0, np.cumsum(self.N / self.EA * self.lengths))
        for node, compliance in self.joints.items():
            moved[node + 1 :] -= (self.N[node - 1] if node else 0.0) * compliance[AXIAL]
        return np.asarray(moved)

    def nodal_forces(self, moved: Array) -> Array:
        """Return the forces along x at the nodes that leave N in the elements [N].

        They are the steps of N, and what axial springs take of them where the nodes have moved.
        """
        forces = np.diff(self.N, prepend=0.0, append=0.0)
        for node, freedom, k in self.springs:
            if freedom == AXIAL:
                forces[node] += k * moved[node]
        return np.asarray(forces)


def _along(item: Attachment) -> Attachment:
    """Return what acts along x as another does about x."""
    if isinstance(item, PointMass):
        return PointMass(item.x, item.polar_inertia)
    if isinstance(item, Spring):
        return Spring(item.x, axial=item.torsional)
    if isinstance(item, Dashpot):
        return Dashpot(item.x, axial=item.torsional)
    if isinstance(item, PointFeedback | Pedestal):
        return Dashpot(item.x)
    return Joint(item.x, axial=item.torsional)


def mesh_of(beam: Beam, count: int, *, twists: bool = False, factor: float = 1.0) -> Mesh:
    """Return a beam as uniform elements, at least so many, with breakpoints at their ends.

    Elements take N and shear by Engesser. By Haringx that is a kGA larger by N, which `factor`
    multiplies.
    """
    refuse_pedestals(beam.attachments, "decks")
    pieces = np.ceil(np.diff(beam.x) / beam.length * count - 1e-9).astype(int).clip(1)
    k = np.repeat(np.arange(len(pieces)), pieces)
    within = np.concatenate([np.arange(n) for n in pieces])
    size = 1 / pieces[k]
    x = np.append(beam.x[k] + np.diff(beam.x)[k] * within * size, beam.x[-1])

    def mean(name: str, power: int = 1) -> Array:
        sides = [beam.column_at(name, k, (within + g) * size) ** power for g in _GAUSS]
        return np.asarray(np.mean(sides, axis=0) ** power)

    EI, twists = mean("bending_stiffness", -1), twists and tells(beam, TORSION)
    mass, used = mean("mass_per_length"), FAMILIES[BENDING].used(beam)
    N = np.mean([beam.axial_force_at(k, (within + g) * size) for g in _GAUSS], axis=0)
    rotary = _rotary(beam, used, k, within, size)
    if beam.axial_stiffness is not None:
        EA = mean("axial_stiffness", -1)
    elif rotary is not None and np.all(rotary > 0):
        EA = EI * mass / rotary
    else:
        EA = EI / (SLENDER * beam.length) ** 2
    return Mesh(
        beam,
        x,
        mass,
        EI,
        EA,
        N,
        mean("torsional_stiffness", -1) if twists else None,
        mean("polar_inertia_per_length") if twists else None,
        _shear(beam, factor, k, within, size) if "shear_stiffness" in used else None,
        rotary,
        mean("foundation_stiffness") if "foundation_stiffness" in used else None,
        mean("added_mass_per_length") if "added_mass_per_length" in used else None,
        None if beam.loss_factor is None else mean("loss_factor"),
    )


def _shear(beam: Beam, factor: float, k: Integers, within: Integers, size: Array) -> Array:
    """Return kGA as Engesser's elements have it."""
    more = 0.0 if beam.shear_form == "engesser" else factor
    flexibility = [
        1 / (beam.column_at("shear_stiffness", k, t) + more * beam.axial_force_at(k, t))
        for t in ((within + g) * size for g in _GAUSS)
    ]
    with np.errstate(divide="ignore"):
        return np.asarray(1 / np.mean(flexibility, axis=0))


def _rotary(
    beam: Beam, used: tuple[str, ...], k: Integers, within: Integers, size: Array
) -> Array | None:
    """Return the rotary inertia that counts; None if there is none."""
    places = [(within + g) * size for g in _GAUSS]
    if "rotary_inertia_per_length" in used:
        rows = [beam.column_at("rotary_inertia_per_length", k, t) for t in places]
    elif "radius_of_gyration" in used:
        rows = [
            beam.column_at("mass_per_length", k, t)
            * beam.column_at("radius_of_gyration", k, t) ** 2
            for t in places
        ]
    else:
        return None
    return np.asarray(np.mean(rows, axis=0))
