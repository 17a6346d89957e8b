"""Chains of many cases of one vehicle: as `Beam.chain`, on arrays over cases.

Every chain has the cells of the vehicle's own table and one more for each force within them; a cell
in which N varies is two uniform halves, weighted at the Gauss points (fourth order in the step).
Cases whose chains have as many segments are solved together.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import MOST_BUCKLED, MOST_TENSION
from antinode.beam.representation import coarsest_steps

from .case import Case
from .many_loads import ManyLoads, Numbers

_GAUSS = np.array([0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6])
_WEIGHTS = np.array([[0.5 + np.sqrt(3) / 3, 0.5 - np.sqrt(3) / 3]])
_WEIGHTS = np.concatenate([_WEIGHTS, _WEIGHTS[:, ::-1]])
"""Of the two Gauss points, in the first and in the second half of a step."""


@dataclass(frozen=True)
class Chains:
    """Chains of equal length, one a row.

    Attributes
    ----------
    rows : array of int
        The cases.
    length, mass, stiffness, axial_force : array, shape (cases or 1, n)
    """

    rows: Integers
    length: Array
    mass: Array
    stiffness: Array
    axial_force: Array


@dataclass(frozen=True)
class ManyBeams:
    """The beams of many cases.

    Attributes
    ----------
    case : Case
    numbers : mapping
        What varies, as in `compute_many_loads`.
    loads : ManyLoads
    """

    case: Case
    numbers: Numbers
    loads: ManyLoads

    @property
    def exact(self) -> bool:
        """Whether nothing varies inside the cells: N is constant there, and the table steps."""
        constant = self.case.model.axial_force == "element_midpoint"
        return constant and self.loads.masses.interpolation == "step"

    @cached_property
    def stiffness(self) -> Array:
        """EI at both ends of the intervals of the masses, shape (cases or 1, m, 2)."""
        keys = ("vehicle", "stations", "bending_stiffness")
        stations, how = self.case.vehicle.stations, self.case.vehicle.interpolation
        column = self.numbers.get(keys, stations.bending_stiffness[None])
        before = column[:, :-1]
        ends = np.stack([before, before if how == "step" else column[:, 1:]], axis=-1)
        x = self.loads.masses.x
        k = np.clip(np.searchsorted(stations.x, (x[1:] + x[:-1]) / 2) - 1, 0, len(stations.x) - 2)
        t = (np.stack([x[:-1], x[1:]], axis=1) - stations.x[k][:, None]) / np.diff(stations.x)[
            k, None
        ]
        a, b = ends[:, k, :1], ends[:, k, 1:]
        return np.asarray(a * (b / a) ** t if how == "log" else a + (b - a) * t)

    @cached_property
    def cells(self) -> Array:
        """Bounds of the cells [m]: the case's own intervals, the long and steep ones divided."""
        masses = self.loads.masses
        if self.exact:
            return masses.x
        beam = Beam(
            x=masses.x,
            mass_per_length=masses.ends.mean(axis=0),
            bending_stiffness=self.stiffness.mean(axis=0),
            axial_acceleration=1.0,
            interpolation=masses.interpolation,
        )
        interval, start, _ = coarsest_steps(beam, BENDING)
        x = masses.x[interval] + start * np.diff(masses.x)[interval]
        return np.unique(np.append(x, masses.x[-1]))

    def chains(self, rows: Integers, refinement: int) -> list[Chains]:
        """Return the chains of some cases, those with as many segments together."""
        rows = rows[np.argsort(self.order[rows], kind="stable")]
        cells = np.broadcast_to(self.cells, (len(rows), len(self.cells)))
        places = self.loads.places[rows]
        if self.case.model.axial_force == "element_midpoint":
            places = np.full(places.shape, self.cells[-1])
        x = np.sort(np.concatenate([cells, places], axis=1), axis=1)
        real = np.diff(x, axis=1) > 0
        number = real.sum(axis=1)
        found = []
        for n in np.unique(number):
            which = np.flatnonzero(number == n)
            left = x[which, :-1][real[which]].reshape(len(which), n)
            right = x[which, 1:][real[which]].reshape(len(which), n)
            found.append(self._chains(rows[which], left, right, refinement))
        return found

    @cached_property
    def order(self) -> Array:
        """What neighbours in a chunk are alike in: N over EI, on average, or the mass."""
        s = self.loads.scalars
        N = s["F_CX"] + s["a_X"] * s["mass"] / 2 + self.loads.drags.sum(axis=1) / 2
        if ("vehicle", "stations", "bending_stiffness") in self.numbers:
            flexible = np.mean(1 / self.stiffness, axis=(1, 2))
            heavy = np.broadcast_to(s["mass"], flexible.shape)
            return np.asarray(heavy * flexible)
        return np.asarray(N / s["mass"] if self.loads.masses.ends.shape[0] > 1 else N)

    def _chains(self, rows: Integers, left: Array, right: Array, refinement: int) -> Chains:
        """Divide cells into steps, and steps into weighted halves."""
        middle = (left + right) / 2
        interval = np.searchsorted(self.loads.masses.x, middle) - 1
        jump = self._jumps(rows, middle)
        if self.exact:
            at = middle[..., None]
            m, EI, N = (v[..., 0] for v in self._at(rows, interval, at, jump))
            return Chains(rows, right - left, m, EI, N)
        steps = np.linspace(0, 1, refinement + 1)[:-1]
        size = (right - left)[..., None] / refinement
        start = left[..., None] + (right - left)[..., None] * steps
        shape = (len(rows), -1, 2)
        at = (start[..., None] + size[..., None] * _GAUSS).reshape(shape)

        def spread(values: Any) -> Any:
            return np.repeat(values, refinement, axis=1)

        m, EI, N = self._at(rows, spread(interval), at, spread(jump))
        halves = [(v @ _WEIGHTS.T).reshape(len(rows), -1) for v in (m, 1 / EI, N)]
        length = np.repeat(spread(size[..., 0]) / 2, 2, axis=1)
        return Chains(rows, length, halves[0], 1 / halves[1], halves[2])

    def _jumps(self, rows: Integers, middle: Array) -> Array:
        """Return the drag of all forces ahead of the middles of cells, the cavitator's included."""
        N = np.repeat(self.loads.scalars["F_CX"][rows, None], middle.shape[1], axis=1)
        for k in range(self.loads.places.shape[1]):
            x, F = self.loads.places[rows, k, None], self.loads.drags[rows, k, None]
            N += np.where(middle > x, F, 0.0)
        return N

    def _at(
        self, rows: Integers, interval: Integers, x: Array, jump: Array
    ) -> tuple[Array, Array, Array]:
        """Return m, EI and N at points `x` of intervals, shape (cases, cells, points)."""
        masses, how = self.loads.masses, self.loads.masses.interpolation
        low = masses.x[interval]
        length = (masses.x[interval + 1] - low)[..., None]
        s = x - low[..., None]
        a, b = (_taken(masses.ends[..., k], rows, interval)[..., None] for k in (0, 1))
        EIa, EIb = (_taken(self.stiffness[..., k], rows, interval)[..., None] for k in (0, 1))
        ahead = _taken(masses.ahead, rows, interval)[..., None]
        a_X = self.loads.scalars["a_X"][rows, None, None]
        if self.case.model.axial_force == "element_midpoint":
            after = _taken(masses.ahead, rows, interval + 1)[..., None]
            N = jump[..., None] + a_X * (ahead + after) / 2
            N = np.broadcast_to(N, x.shape)
        else:
            N = jump[..., None] + a_X * (ahead + _mass_within(s, a, b, length, how))
        t = s / length
        if how == "log":
            return a * (b / a) ** t, EIa * (EIb / EIa) ** t, N
        return a + (b - a) * t, EIa + (EIb - EIa) * t, N

    def beyond_limits(self) -> npt.NDArray[np.bool_]:
        """Tell which cases have an axial force out of all proportion to the bending stiffness."""
        edges, loads = self.loads.masses.x, self.loads
        rows = np.arange(len(loads.code))
        middle = (edges[1:] + edges[:-1])[None] / 2
        interval = np.broadcast_to(np.arange(len(edges) - 1), (len(rows), len(edges) - 1))
        jump = self._jumps(rows, np.repeat(middle, len(rows), axis=0))
        at = np.broadcast_to(np.stack([edges[:-1], edges[1:]], axis=1), (*interval.shape, 2))
        _, EI, N = self._at(rows, interval, at, jump)
        wave = np.sqrt(np.maximum(N.max(axis=-1), 0) / EI.min(axis=-1)) * np.diff(edges)
        pull = np.sqrt(np.maximum(-N.min(axis=-1), 0) / EI.min(axis=-1)) * np.diff(edges)
        buckled, tension = wave.sum(axis=1) / np.pi, pull.sum(axis=1) ** 2
        return np.asarray(~((buckled <= MOST_BUCKLED) & (tension <= MOST_TENSION)))


def _taken(table: Array, rows: Integers, index: Integers) -> Array:
    """Return entries of a table, one row for all cases or one for each."""
    if len(table) == 1:
        return np.asarray(table[0][index])
    return np.take_along_axis(table[rows], index, axis=1)


def _mass_within(s: Array, a: Array, b: Array, length: Array, how: str) -> Array:
    """Return the mass of the first `s` metres of intervals."""
    if how != "log":
        return np.asarray(a * s + (b - a) / length * s * s / 2)
    rate = np.log(b / a) * s / length
    mean = np.where(np.abs(rate) > 1e-12, np.expm1(rate) / np.where(rate == 0, 1, rate), 1.0)
    return np.asarray(a * s * mean)
