"""Chains of many cases of one vehicle: as `Beam.chain`, on arrays over cases.

Every chain has the cells of the vehicle's own table and one more for each force within them; a cell
in which N varies is two uniform halves, weighted at the Gauss points (fourth order in the step).
Cases whose chains have as many segments are solved together.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers, Interpolation
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import MOST_BUCKLED, MOST_IN_SHEAR, MOST_TENSION, SAMPLES, waves
from antinode.beam.mass import mass_within
from antinode.beam.profile import Profile, interpolated
from antinode.beam.representation import GAUSS, coarsest_steps, halved

from .forces import ForceOnBody, drag_ahead
from .many_loads import ManyLoads
from .theory import Sheared, sheared

_TOGETHER = 512  # cases whose arrays stay near the processor
_LONGEST = 1 / 20  # share of a step in the waves along the body: a few long cells made most errors


@dataclass(frozen=True)
class Chains:
    """Chains of equal length, one a row.

    Attributes
    ----------
    rows : array of int
        The cases.
    length, mass, stiffness, axial_force : array, shape (cases or 1, n)
    more : dict of array, shape (cases, n)
        Columns of a chain besides: what shear and rotary inertia add. Of s, sN and sN^2 each is an
        average of its own.
    following : array, shape (cases, 2), optional
        The part of the forces at both ends that turns with them [N]; None where they do not.
    """

    rows: Integers
    length: Array
    mass: Array
    stiffness: Array
    axial_force: Array
    more: Mapping[str, Array] = field(default_factory=dict)
    following: Array | None = None

    def __post_init__(self) -> None:
        tables = self.length, self.mass, self.stiffness, self.axial_force
        for array in (*tables, *self.more.values()):
            array.flags.writeable = False  # a batch takes them as they are

    @property
    def rigid(self) -> Chains:
        """The same without shear and rotary inertia: Euler-Bernoulli's."""
        return replace(self, more={})

    def some(self, which: Integers) -> Chains:
        """Return some of them."""

        def part(values: Array) -> Array:
            return values if len(values) == 1 < len(self.rows) else values[which]

        more = {name: part(v) for name, v in self.more.items()}
        h, m, EI, N = map(part, (self.length, self.mass, self.stiffness, self.axial_force))
        following = None if self.following is None else self.following[which]
        return Chains(self.rows[which], h, m, EI, N, more, following)


class Values(NamedTuple):
    """Properties at points of cells, arrays that go with (cases, cells, points)."""

    mass: Array
    stiffness: Array
    axial_force: Array
    more: Mapping[str, Array]
    """kGA and rho I as `shear_stiffness` and `rotary_inertia`, where these count."""

    def with_water(self, added: Array | None) -> Values:
        """Return the same with mass per length added in cells [kg/m], if any."""
        return self if added is None else self._replace(mass=self.mass + added[..., None])


@dataclass(frozen=True)
class ManyBeams:
    """The beams of many cases.

    Attributes
    ----------
    loads : ManyLoads
    """

    loads: ManyLoads

    @cached_property
    def exact(self) -> bool:
        """Whether nothing varies inside the cells: N is constant there, and the table steps."""
        return self._midpoint and self.loads.mass_distribution.interpolation == "step"

    @property
    def _midpoint(self) -> bool:
        """Whether N is constant between stations."""
        return self.loads.cases.model.axial_force == "element_midpoint"

    @cached_property
    def stiffness(self) -> Array:
        """EI at both ends of the intervals of the masses, shape (m, 2) or (cases, m, 2)."""
        cases = self.loads.cases
        column, how = cases.column("bending_stiffness"), cases.vehicle.interpolation
        table = Profile.of_rows(cases.vehicle.stations.x, column, how)
        return table.between(self.loads.mass_distribution.x)

    @cached_property
    def shear(self) -> Sheared | None:
        """Shear and rotary inertia of the same intervals; None in Euler-Bernoulli's theory."""
        cases, masses = self.loads.cases, self.loads.mass_distribution
        return sheared(cases.vehicle, cases.model, masses, cases.optional_column)

    @cached_property
    def cells(self) -> Array:
        """Bounds of the cells [m]: the case's own intervals, the long and steep ones divided."""
        masses = self.loads.mass_distribution
        if self.exact:
            return masses.x
        beam = Beam(
            x=masses.x,
            mass_per_length=_mean(masses.ends),
            bending_stiffness=_mean(self.stiffness),
            shear_stiffness=_mean(self.shear.stiffness.ends) if self.shear else None,
            axial_acceleration=1.0,
            interpolation=masses.interpolation,
        )
        interval, start, _ = coarsest_steps(beam, BENDING, _LONGEST)
        x = masses.x[interval] + start * np.diff(masses.x)[interval]
        return np.unique(np.append(x, masses.x[-1]))

    def chains(self, rows: Integers, refinement: int) -> list[Chains]:
        """Return the chains of some cases, those with as many segments together."""
        rows = rows[np.argsort(self.order[rows], kind="stable")]
        return [self._chains(*each, refinement) for each in self._divided(rows, self.cells)]

    def _divided(self, rows: Integers, bounds: Array) -> Iterator[tuple[Integers, Array, Array]]:
        """Yield cases with both ends of their cells, (cases, n), those with as many together."""
        cells = np.broadcast_to(bounds, (len(rows), len(bounds)))
        places = np.stack([f.x for f in self._forces(rows)[1:]], axis=1)
        if self._midpoint:
            places = np.full(places.shape, bounds[-1])
        water = [x[rows, None] for part in self.loads.added_masses for x in (part.start, part.end)]
        x = np.sort(np.concatenate([cells, places, *water], axis=1), axis=1)
        real = np.diff(x, axis=1) > 0
        number = real.sum(axis=1)
        for n in np.unique(number):
            alike = np.flatnonzero(number == n)
            for which in np.array_split(alike, math.ceil(len(alike) / _TOGETHER)):
                left = x[which, :-1][real[which]].reshape(len(which), n)
                right = x[which, 1:][real[which]].reshape(len(which), n)
                yield rows[which], left, right

    def _forces(self, rows: Any) -> list[ForceOnBody[Array]]:
        """Return the forces on some bodies; those that do not act stand at the tail."""
        acting = self.loads.hydrodynamics.forces
        length = self.loads.cases.vehicle.length
        return [
            f._replace(x=np.where((f.F_X != 0) | (f.F_Y != 0), f.x, length)[rows], F_X=f.F_X[rows])
            for f in acting
        ]

    @cached_property
    def order(self) -> Array:
        """What neighbours in a chunk are alike in: N over EI, on average, or the mass."""
        loads = self.loads
        drags = sum(f.F_X for f in loads.hydrodynamics.forces[1:])
        N = loads.F_CX + loads.a_X * loads.mass / 2 + drags / 2
        if self.stiffness.ndim == 3:
            return np.asarray(loads.mass * np.mean(1 / self.stiffness, axis=(1, 2)))
        return np.asarray(N / loads.mass if loads.mass_distribution.ends.ndim == 3 else N)

    def _chains(self, rows: Integers, left: Array, right: Array, refinement: int) -> Chains:
        """Divide cells into steps, and steps into weighted halves."""
        middle = (left + right) / 2
        interval = self.loads.mass_distribution.interval(middle)
        jump, water = self._jumps(rows, middle), self._water(rows, middle)
        if self.exact:
            values = self._at(rows, interval, middle[..., None], jump).with_water(water)
            return self._chain(rows, right - left, _every(values), lambda v: v[..., 0])
        if self.loads.mass_distribution.interpolation == "step" and self._only_force_varies:
            return self._stepped(rows, left, right, refinement, interval, jump, water)
        steps = np.linspace(0, 1, refinement + 1)[:-1]
        size = (right - left)[..., None] / refinement
        start = left[..., None] + (right - left)[..., None] * steps
        at = (start[..., None] + size[..., None] * np.array(GAUSS)).reshape(len(rows), -1, 2)

        def spread(values: Any) -> Any:
            return np.repeat(values, refinement, axis=1)

        def average(values: Array) -> Array:
            return halved(np.broadcast_to(values, at.shape)).reshape(len(rows), -1)

        length = np.repeat(spread(size[..., 0]) / 2, 2, axis=1)
        values = self._at(rows, spread(interval), at, spread(jump))
        values = values.with_water(None if water is None else spread(water))
        return self._chain(rows, length, values, average)

    def _chain(
        self, rows: Integers, length: Array, values: Values, average: Callable[[Array], Array]
    ) -> Chains:
        """Return chains of segments over which values at points are averaged."""
        m, N = average(values.mass), average(values.axial_force)
        EI, more = 1 / average(1 / values.stiffness), {}
        if self.shear is not None:
            force, kGA = values.axial_force, values.more["shear_stiffness"]
            with np.errstate(divide="ignore"):
                s = 1 / (kGA - force if self.shear.form == "engesser" else kGA)
            of = {"shear": s, "shear_turn": s * force, "shear_work": s * force**2}
            of["rotary_inertia"] = values.more["rotary_inertia"]
            more = {name: average(v) for name, v in of.items()}
        return Chains(rows, length, m, EI, N, more, self._following(rows))

    @property
    def _only_force_varies(self) -> bool:
        """Whether nothing but N varies inside cells of a table that steps."""
        return self.shear is None or self.shear.form == "haringx"

    def _following(self, rows: Integers) -> Array | None:
        """Return the part of the cavitator's drag and of the thrust that turns with the body."""
        nose, tail = self.loads.cases.model.follow
        if not nose and not tail:
            return None
        thrust = self.loads.cases.number("condition", "thrust")
        ends = nose * self.loads.F_CX, tail * np.broadcast_to(thrust, self.loads.F_CX.shape)
        return np.stack(ends, axis=1)[rows]

    def _stepped(
        self,
        rows: Integers,
        left: Array,
        right: Array,
        refinement: int,
        interval: Integers,
        jump: Array,
        water: Array | None,
    ) -> Chains:
        """Divide cells in which only N varies, straight: its weighted means are values of it.

        The weighted means of N^2 differ from the squares of those by -1/36 of the square of N's
        change over the step.
        """
        masses, size = self.loads.mass_distribution, right - left
        at = (np.arange(refinement)[:, None] + halved(np.array(GAUSS))).ravel() / refinement
        m = _taken(masses.ends[..., 0], rows, interval)
        a_X = self.loads.a_X[rows, None]
        ahead = _taken(masses.moments_ahead[0], rows, interval) + m * (left - masses.x[interval])
        start, slope = jump + a_X * ahead, a_X * m * size
        N = np.repeat(start, len(at), axis=1)
        N.reshape(*start.shape, -1)[...] += slope[..., None] * at

        def each(cells: Array) -> Array:
            return np.repeat(cells, len(at), axis=1)

        def there(ends: Array) -> Array:
            return each(_taken(ends[..., 0], rows, interval))

        more = {}
        if self.shear is not None:
            s = each(1 / _taken(self.shear.stiffness.ends[..., 0], rows, interval))
            squared = N * N - each((slope / refinement) ** 2 / 36)
            more = {"shear": s, "shear_turn": s * N, "shear_work": s * squared}
            more["rotary_inertia"] = there(self.shear.rotary.ends)
        EI, length = there(self.stiffness), each(size / len(at))
        moving = each(m if water is None else m + water)
        return Chains(rows, length, moving, EI, N, more, self._following(rows))

    def _water(self, rows: Integers, middle: Array) -> Array | None:
        """Return the water that moves with cells, by their middles [kg/m]; None without any."""
        added = None
        for part in self.loads.added_masses:
            start, end, density = (v[rows, None] for v in (part.start, part.end, part.per_length))
            own = np.where((middle > start) & (middle < end), density, 0.0)
            added = own if added is None else added + own
        return added

    def _jumps(self, rows: Integers, middle: Array) -> Array:
        """Return the drag of all forces ahead of the middles of cells, the cavitator's included."""
        if self._midpoint:
            x = self.loads.mass_distribution.x
            middle = ((x[1:] + x[:-1]) / 2)[self.loads.mass_distribution.interval(middle)]
        forces = [
            f._replace(x=f.x[:, None], F_X=f.F_X[:, None])
            for k, f in enumerate(self._forces(rows))
            if not k or np.any(f.F_X)
        ]
        return np.asarray(drag_ahead(forces, lambda force: middle > force.x))

    def _at(self, rows: Integers, interval: Integers, x: Array, jump: Array) -> Values:
        """Return the properties at points `x` of intervals, shape (cases, cells, points)."""
        masses, how = self.loads.mass_distribution, self.loads.mass_distribution.interpolation
        low = masses.x[interval]
        length = (masses.x[interval + 1] - low)[..., None]
        s = x - low[..., None]
        a, b = (_taken(masses.ends[..., k], rows, interval)[..., None] for k in (0, 1))
        total = masses.moments_ahead[0]
        ahead = _taken(total, rows, interval)[..., None]
        a_X = self.loads.a_X[rows, None, None]
        if self._midpoint:
            after = _taken(total, rows, interval + 1)[..., None]
            N = np.broadcast_to(jump[..., None] + a_X * (ahead + after) / 2, x.shape)
        else:
            N = jump[..., None] + a_X * (ahead + mass_within(a, b, length, s, how))
        t = s / length

        def between(ends: Array, how: Interpolation) -> Array:
            a, b = (_taken(ends[..., k], rows, interval)[..., None] for k in (0, 1))
            return a if how == "step" else np.asarray(interpolated(a, b, t, how))

        m, more = a if how == "step" else np.asarray(interpolated(a, b, t, how)), {}
        if self.shear is not None:
            kGA, rotary = self.shear.stiffness, self.shear.rotary
            more["shear_stiffness"] = between(kGA.ends, kGA.interpolation)
            more["rotary_inertia"] = between(rotary.ends, rotary.interpolation)
        return Values(m, between(self.stiffness, how), N, more)

    def beyond_shear(self) -> npt.NDArray[np.bool_]:
        """Tell which cases have an axial force beyond what the stiffness in shear can bear.

        As `beam.checks` has it, at both ends and in the middle of every piece between forces.
        """
        found = np.zeros(self.loads.cases.cases, dtype=bool)
        if self.shear is None:
            return found
        with np.errstate(all="ignore"):
            least = self.shear.stiffness.ends.min(axis=(-2, -1))
            rows = np.flatnonzero(~(self._largest_force < least))
        sign = 1.0 if self.shear.form == "engesser" else -1.0
        for some, left, right in self._divided(rows, self.loads.mass_distribution.x):
            middle = (left + right) / 2
            interval = self.loads.mass_distribution.interval(middle)
            at = np.stack([left, middle, right], axis=-1)
            values = self._at(some, interval, at, self._jumps(some, middle))
            kGA, N = values.more["shear_stiffness"], values.axial_force
            bad = (kGA - sign * N <= 0) | (np.abs(N) > MOST_IN_SHEAR * kGA)
            found[some] = np.any(bad, axis=(1, 2))
        return found

    def beyond_limits(self) -> npt.NDArray[np.bool_]:
        """Tell which cases have an axial force out of all proportion to the bending stiffness.

        Only those are integrated that a bound on N/EI, along all of the beam, leaves open.
        """
        with np.errstate(all="ignore"):
            most = self._largest_force / self.stiffness.min(axis=(-2, -1))
        length = np.array([self.loads.cases.vehicle.length])
        buckled, tension = waves(np.stack([most, -most])[..., None, None], np.ones(1), length)
        rows = np.flatnonzero(~((buckled[0] <= MOST_BUCKLED) & (tension[1] <= MOST_TENSION)))
        found = np.zeros(self.loads.cases.cases, dtype=bool)
        found[rows] = self._beyond_limits(rows)
        return found

    def strained(self, most: float) -> npt.NDArray[np.bool_]:
        """Tell which cases have an axial force that strains the body by more than abs(N)/EA."""
        cases, masses = self.loads.cases, self.loads.mass_distribution
        column, how = cases.column("axial_stiffness"), cases.vehicle.interpolation
        EA = Profile.of_rows(cases.vehicle.stations.x, column, how).between(masses.x)
        found = np.zeros(cases.cases, dtype=bool)
        rows = np.flatnonzero(~(self._largest_force <= most * EA.min(axis=(-2, -1))))
        for some, left, right in self._divided(rows, masses.x):
            middle = (left + right) / 2
            interval, at = masses.interval(middle), np.stack([left, right], axis=-1)
            N = self._at(some, interval, at, self._jumps(some, middle)).axial_force
            low, high = masses.x[interval], masses.x[interval + 1]
            share = (at - low[..., None]) / (high - low)[..., None]
            a, b = (_taken(EA[..., k], some, interval)[..., None] for k in (0, 1))
            there = a if how == "step" else interpolated(a, b, share, how)
            found[some] = np.any(np.abs(N) > most * there, axis=(1, 2))
        return found

    @cached_property
    def _largest_force(self) -> Array:
        """A bound on abs(N) of every case [N]."""
        loads = self.loads
        drags = [np.abs(f.F_X) for f in loads.hydrodynamics.forces]
        return np.asarray(sum(drags, np.abs(loads.a_X) * loads.mass))

    def _beyond_limits(self, rows: Integers) -> npt.NDArray[np.bool_]:
        edges = self.loads.mass_distribution.x
        middle = (edges[1:] + edges[:-1])[None] / 2
        interval = np.broadcast_to(np.arange(len(edges) - 1), (len(rows), len(edges) - 1))
        jump = self._jumps(rows, np.repeat(middle, len(rows), axis=0))
        places = edges[:-1, None] + np.diff(edges)[:, None] * SAMPLES
        at = np.broadcast_to(places, (*interval.shape, len(SAMPLES)))
        values = self._at(rows, interval, at, jump)
        buckled, tension = waves(values.axial_force, values.stiffness, np.diff(edges))
        return np.asarray(~((buckled <= MOST_BUCKLED) & (tension <= MOST_TENSION)))


def _every(values: Values) -> Values:
    """Return values with one entry for each point, none shared."""
    m, EI, N, more = values

    def whole(v: Array) -> Array:
        return np.broadcast_to(v, N.shape)

    return Values(whole(m), whole(EI), N, {name: whole(v) for name, v in more.items()})


def _mean(ends: Array) -> Array:
    """Return the mean over the cases, shape (m, 2)."""
    return np.asarray(ends.mean(axis=0) if ends.ndim == 3 else ends)


def _taken(table: Array, rows: Integers, index: Integers) -> Array:
    """Return entries of a table, one row for all cases or one for each."""
    if table.ndim == 1:
        return np.asarray(table[index])
    return np.take_along_axis(table[rows], index, axis=1)


def sheared_columns(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return the arrays of a `BeamBatch` for columns of chains in shear, of Haringx' form."""
    found = {}
    if "shear" in columns:
        with np.errstate(divide="ignore"):
            found["shear_stiffness"] = 1 / columns["shear"]
        found["shear_stiffness"].flags.writeable = False
    if "rotary_inertia" in columns:
        found["rotary_inertia_per_length"] = columns["rotary_inertia"]
    if "shear_turn" in columns:
        found["force_over_shear"] = columns["shear_turn"]
        found["force_squared_over_shear"] = columns["shear_work"]
    return found
