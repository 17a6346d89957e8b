"""A beam as uniform elements between nodes, with what is attached to these: the mesh of a deck."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Attachment, Dashpot, Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import AxialEnd, Ends
from antinode.beam.families import LONGITUDINAL, TORSION, tells

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
    """

    beam: Beam
    x: Array
    mass: Array
    EI: Array
    EA: Array
    N: Array
    GJ: Array | None = None
    inertia: Array | None = None

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

    def _all_springs(self) -> list[tuple[int, int, float]]:
        rows = []
        for node, item in self.attached(Spring):
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

    @property
    def lumps(self) -> tuple[Array, Array]:
        """Polar inertia of the halves of elements, to the left and right of each node [kg m^2]."""
        half = np.zeros(self.count) if self.inertia is None else self.inertia * self.lengths / 2
        return np.append(0.0, half), np.append(half, 0.0)

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
    return Joint(item.x, axial=item.torsional)


def mesh_of(beam: Beam, count: int, *, twists: bool = False) -> Mesh:
    """Return a beam as uniform elements, at least so many, with breakpoints at their ends."""
    pieces = np.ceil(np.diff(beam.x) / beam.length * count - 1e-9).astype(int).clip(1)
    k = np.repeat(np.arange(len(pieces)), pieces)
    within = np.concatenate([np.arange(n) for n in pieces])
    size = 1 / pieces[k]
    x = np.append(beam.x[k] + np.diff(beam.x)[k] * within * size, beam.x[-1])

    def mean(name: str, power: int = 1) -> Array:
        sides = [beam.column_at(name, k, (within + g) * size) ** power for g in _GAUSS]
        return np.asarray(np.mean(sides, axis=0) ** power)

    EI, twists = mean("bending_stiffness", -1), twists and tells(beam, TORSION)
    has_EA = beam.axial_stiffness is not None
    return Mesh(
        beam,
        x,
        mean("mass_per_length"),
        EI,
        mean("axial_stiffness", -1) if has_EA else EI / (SLENDER * beam.length) ** 2,
        np.mean([beam.axial_force_at(k, (within + g) * size) for g in _GAUSS], axis=0),
        mean("torsional_stiffness", -1) if twists else None,
        mean("polar_inertia_per_length") if twists else None,
    )
