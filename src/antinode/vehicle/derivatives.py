"""Derivatives of the eigenvalues of a vehicle by its columns, its forces and their places.

With a mode Y of unit modal mass, to first order and exactly

    d(omega^2) = int dEI Y''^2 - int dN Y'^2 - omega^2 int dm Y^2,

and moving the place x_i of a drag F_i changes omega^2 by F_i Y'(x_i)^2 (compression and drag aft
are positive). Shear and rotary inertia add ``int dkGA gamma^2 - omega^2 int d(rho I) psi^2``, with
the shear angle gamma = Y' - psi. Where forces at the ends follow the body, every square is the
product of the mode with its left eigenvector w, modal mass included, and what follows adds
``d kappa_tail Y'(L) w(L) - d kappa_nose Y'(0) w(0)``. N is linear in the forces, and goes with the
mass ahead through the acceleration:

    N(x) = sum_i F_i [x > x_i] + a_X m_ahead(x),   a_X = (T - sum_i F_i) / m.

Longitudinally d(omega^2) = int dEA X'^2 - omega^2 int dm X^2. The integrals are sums over Gauss
points of every uniform segment, with the exact solution between its ends.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Interpolation
from antinode.beam.beam import Beam
from antinode.beam.checks import ShearForm
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.profile import Profile
from antinode.modes.backends import BackendName, choose
from antinode.modes.following import left_states
from antinode.modes.result import Solution
from antinode.riccati.chain import Chain, largest_wave_number
from antinode.riccati.shapes import propagate

from .columns import hat, hats, integrals
from .forces import ForceOnBody
from .loads import Loads

_MASS = "mass_per_length"
_SHORT = 0.5  # wave number times length up to which three points integrate squares to 1e-9


def _gauss(points: int) -> tuple[Array, Array]:
    """Return Gauss nodes and weights on 0 ... 1."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return (nodes + 1) / 2, weights / 2


_FEW, _MANY = _gauss(3), _gauss(8)


@dataclass(frozen=True)
class ChainModes:
    """Eigenvalues of one family on a chain, with the weights of their derivatives.

    The modes themselves are a `Solution`, as those of `solve_modes` are.

    Attributes
    ----------
    chain : Chain
    omega2 : array, shape (k,)
        [rad^2/s^2].
    backend : {"auto", "numpy", "numba"}
        What computes the shapes.
    shear_form : {"haringx", "engesser"}
        How the axial force and shear meet.
    """

    chain: Chain
    omega2: Array
    backend: BackendName = "auto"
    shear_form: ShearForm = "haringx"

    @property
    def family(self) -> FamilyName:
        """Bending or longitudinal."""
        return self.chain.family

    @cached_property
    def states(self) -> Array:
        """At the nodes, up to one factor for each mode, shape (n + 1, k, s)."""
        one, solver = np.ones(len(self.omega2), dtype=np.int64), choose(self.backend)
        return np.asarray(solver.mode_states(self.chain, self.omega2, one))

    @cached_property
    def _rule(self) -> tuple[Array, Array]:
        """Gauss nodes and weights for every segment."""
        wave = largest_wave_number(self.chain, float(np.max(np.abs(self.omega2))))
        return _FEW if np.max(wave * self.chain.length) < _SHORT else _MANY

    @cached_property
    def x(self) -> Array:
        """Gauss points of all segments, from the nose aft [m], shape (q,)."""
        nodes = self.chain.nodes
        return np.asarray((nodes[:-1, None] + self.chain.length[:, None] * self._rule[0]).ravel())

    @cached_property
    def _at_points(self) -> Array:
        """States at the Gauss points, shape (q, k, s)."""
        return self._between(self.states)

    def _between(self, states: Array) -> Array:
        start, length = states[:-1], self.chain.length
        parts = [propagate(self.chain, start, self.omega2, t * length) for t in self._rule[0]]
        return np.stack(parts, axis=1).reshape(len(self.x), *start.shape[1:])

    @cached_property
    def left_states(self) -> Array:
        """Of the left eigenvectors at the nodes; the modes' own where no end force follows."""
        if not self.chain.follows:
            return self.states
        return left_states(choose(self.backend), self.chain, self.states, self.omega2)

    @cached_property
    def _left_at_points(self) -> Array:
        return self._between(self.left_states) if self.chain.follows else self._at_points

    @cached_property
    def _weights(self) -> Array:
        return np.asarray((self.chain.length[:, None] * self._rule[1]).ravel())

    @cached_property
    def _modal_mass(self) -> Array:
        mass = self._column("mass") * self._weights @ self._product(0)
        if "rotary_inertia" in self.chain.columns:
            rotary = self._column("rotary_inertia") * self._weights
            mass = mass + rotary @ self._product(1)
        return np.asarray(mass)

    def _column(self, name: str) -> Array:
        """Return a column of the chain at the Gauss points, shape (q,)."""
        return np.repeat(self.chain.columns[name], len(self._rule[0]))

    def _over_mass(self, square: Array) -> Array:
        """Return weights of the Gauss points for a square of the modes there, shape (q, k)."""
        return np.asarray(self._weights[:, None] * square / self._modal_mass)

    @cached_property
    def by_rotary_inertia(self) -> Array:
        """Weights of d(rho I)(x), shape (q, k)."""
        return -self.omega2 * self._over_mass(self._product(1))

    @cached_property
    def by_foundation(self) -> Array:
        """Weights of dk(x), shape (q, k)."""
        return self._over_mass(self._product(0))

    @property
    def mean_shear(self) -> Array:
        """1/kGA of the segments at the Gauss points [1/N], shape (q,)."""
        return self._column("shear")

    @cached_property
    def by_shear_stiffness(self) -> Array:
        """Weights of dkGA(x), shape (q, k): the squares of the shear angle."""
        return self._over_mass(self._shear_angles)

    @cached_property
    def _slopes(self) -> Array:
        """Y' at the Gauss points, of modes and of left eigenvectors, shape (2, q, k)."""
        names = (name for name in ("shear", "shear_turn") if name in self.chain.columns)
        columns = {name: self._column(name)[:, None] for name in names}
        both = self._at_points, self._left_at_points
        return np.stack([self.chain.law.slope(columns, z) for z in both])

    @property
    def _shear_angles(self) -> Array:
        """Products of the shear angles at the Gauss points, shape (q, k)."""
        right, left = self._slopes
        off = right - self._at_points[..., 1]
        return np.asarray(off * (left - self._left_at_points[..., 1]))

    @cached_property
    def by_mass(self) -> Array:
        """Weights of dm(x) in d(omega^2), without its share in N, shape (q, k)."""
        square = self._weights[:, None] * self._product(0)
        return np.asarray(-self.omega2 * square / self._modal_mass)

    @cached_property
    def by_axial_force(self) -> Array:
        """Weights of dN(x), shape (q, k); zero longitudinally."""
        if not self.chain.law.has_axial_force:
            return np.zeros((len(self.x), len(self.omega2)))
        square = self._slopes[0] * self._slopes[1]
        if self.shear_form == "haringx":
            square = square - self._shear_angles
        return -self._over_mass(square)

    def by_stiffness(self, stiffness: Array) -> Array:
        """Weights of dEI(x) or dEA(x), given what it is at the Gauss points, shape (q, k)."""
        force = self._product(self.chain.law.size // 2)
        square = self._weights[:, None] * force / (stiffness[:, None] ** 2)
        return np.asarray(square / self._modal_mass)

    def _product(self, component: int) -> Array:
        """Return products of mode and left eigenvector at the Gauss points, shape (q, k)."""
        right, left = (z[..., component] for z in (self._at_points, self._left_at_points))
        return np.asarray(right * left)

    @cached_property
    def by_following(self) -> Array:
        """Weights of what turns with the nose and with the tail [rad^2/s^2/N], shape (2, k)."""
        turn, move = self.states[..., 1], self.left_states[..., 0]
        signed = np.stack([-turn[0] * move[0], turn[-1] * move[-1]])
        return np.asarray(signed / self._modal_mass)

    def square(self, x: float) -> Array:
        """Return the square of the displacement at a place over the modal mass, shape (k,)."""
        right = self.solution.at(np.array([x]))[0, :, 0]
        left = right
        if self.chain.follows:
            left = replace(self.solution, states=self.left_states).at(np.array([x]))[0, :, 0]
        return np.asarray(right * left / self._modal_mass)

    @cached_property
    def solution(self) -> Solution:
        """The modes, exact at every place of the chain, each to a scale of its own."""
        return Solution(self.chain, self.omega2, self.states)

    def displacement(self, x: Array) -> Array:
        """Return the displacements of the modes at places [m], to any scale, (points, k)."""
        return np.asarray(self.solution.at(x)[..., 0])

    def slope_squared(self, x: float, sides: Sequence[tuple[float, float]] = ()) -> Array:
        """Return what N works on at a place, over the modal mass, shape (k,).

        That is Y'^2, without shear; with it, Haringx' Y'^2 less the shear angle's square, or
        Engesser's Y'^2, as a mean of both sides where N jumps.

        Parameters
        ----------
        x : float
            The place [m].
        sides : sequence of (float, float), optional
            Flexibility in shear s [1/N] and N [N] just ahead of it, and just aft.
        """
        here = replace(self.solution, states=self.left_states) if self.chain.follows else None
        both = [z.at(np.array([x]))[0] for z in (self.solution, here or self.solution)]
        right, left = both
        total = right[:, 1] * left[:, 1]
        for s, N in sides:
            angles = [s * (N * z[:, 1] - z[:, 3]) for z in both]
            crossed = right[:, 1] * angles[1] + left[:, 1] * angles[0]
            total = total + (crossed + (self.shear_form == "engesser") * angles[0] * angles[1]) / 2
        return np.asarray(total / self._modal_mass)


class ForceChange(NamedTuple):
    """How a force and its place change with a parameter."""

    name: str
    drag: float
    """[N] for each unit of the parameter."""
    place: float
    """[m] for each unit of the parameter."""


class MassChange(NamedTuple):
    """How the mass per length, and the mass ahead, change with a parameter."""

    density: Callable[[Array], Array]
    ahead: Callable[[Array], Array]


class WaterChange(NamedTuple):
    """How water that moves sideways with a part of the body changes with a parameter."""

    start: float
    """[m]."""
    end: float
    """[m]."""
    density: float
    """That it has now [kg/m]."""
    growth: tuple[float, float, float]
    """Of start and end [m], and of the density [kg/m], for each unit of the parameter."""


class ShearChange(NamedTuple):
    """How kGA and rho I change with some parameters: at places, shape (q,) or (parameters, q)."""

    stiffness: Callable[[Array], Array]
    rotary: Callable[[Array], Array]


@dataclass(frozen=True)
class EigenvalueDerivatives:
    """Derivatives of the eigenvalues of one family of a vehicle in a condition.

    Attributes
    ----------
    modes : ChainModes
    beam : Beam
    loads : Loads
    """

    modes: ChainModes
    beam: Beam
    loads: Loads

    @cached_property
    def _length(self) -> float:
        return float(self.beam.x[-1])

    @cached_property
    def _interval(self) -> npt.NDArray[np.int64]:
        """Interval of the beam in which every Gauss point lies."""
        found = np.searchsorted(self.beam.x, self.modes.x, side="right") - 1
        return np.asarray(np.clip(found, 0, len(self.beam.x) - 2))

    @cached_property
    def _exact(self) -> bool:
        """Whether N follows the mass ahead inside intervals, and steps at the forces."""
        return self.loads.axial_model == "exact"

    def _seen_ahead(self, ahead: Callable[[Array], Array]) -> Array:
        """Return the mass ahead as N sees it at the Gauss points, or the mean of the interval."""
        if self._exact:
            return ahead(self.modes.x)
        ends = ahead(self.beam.x)
        return np.asarray((ends[:-1] + ends[1:]) / 2)[self._interval]

    @cached_property
    def _share_ahead(self) -> Array:
        """Share of the mass that lies ahead, as N sees it, shape (q,)."""
        distribution = self.loads.mass_distribution
        return self._seen_ahead(lambda x: distribution.moments(x)[0]) / self.loads.mass

    @cached_property
    def by_thrust(self) -> Array:
        """[rad^2/s^2/N], shape (k,)."""
        return np.asarray(self._share_ahead @ self.modes.by_axial_force + self._at_end(1))

    def _at_end(self, side: int) -> Array | float:
        """Return what a unit force does that follows the nose (0) or the tail (1), by its share."""
        share = self.beam.ends.follow[side]
        return share * self.modes.by_following[side] if share and self._bends else 0.0

    @property
    def by_share(self) -> Array:
        """By the shares of drag and thrust that turn with nose and tail, shape (2, k)."""
        forces = np.array([self.loads.F_CX, self.loads.thrust])[:, None]
        none = np.zeros((2, len(self.modes.omega2)))
        return forces * self.modes.by_following if self._bends else none

    @property
    def _bends(self) -> bool:
        return self.modes.chain.law.has_axial_force

    def by_force(self, change: ForceChange) -> Array:
        """Return d(omega^2) for each unit of the parameter that changes a force, shape (k,)."""
        force = next((f for f in self.loads.forces if f.name == change.name), None)
        if force is None or not self.modes.chain.law.has_axial_force:
            return np.zeros(len(self.modes.omega2))
        steps = self._steps(change.name)[self._interval] - self._share_ahead
        by_drag = steps @ self.modes.by_axial_force
        total = change.drag * (
            by_drag + (self._at_end(0) if force is self.loads.forces[0] else 0.0)
        )
        if self._exact and change.place and force.x > 0:
            square = self.modes.slope_squared(force.x, self._beside(force.x))
            total = total + change.place * force.F_X * square
        return np.asarray(total)

    def _beside(self, x: float) -> list[tuple[float, float]]:
        """Return s and N on both sides of a place; nothing where the beam is rigid in shear."""
        beam = self.beam
        if not beam.has_shear:
            return []
        k = int(np.clip(np.searchsorted(beam.x, x, side="right") - 1, 0, len(beam.x) - 2))
        found = []
        for i in (k - 1, k) if x == beam.x[k] and k else (k, k):
            t = (x - beam.x[i]) / (beam.x[i + 1] - beam.x[i])
            at = np.array([i]), np.array([t])
            N, kGA = beam.axial_force_at(*at)[0], beam.column_at("shear_stiffness", *at)[0]
            found.append((float(1 / (kGA - N if beam.shear_form == "engesser" else kGA)), float(N)))
        return found

    def _steps(self, name: str) -> Array:
        """Return N of a unit drag of this name without acceleration, in every interval."""
        unit = [f._replace(F_X=float(f.name == name), F_Y=0.0) for f in self.loads.forces]
        alone: Loads = replace(
            self.loads,
            F_CX=unit[0].F_X,
            forces=tuple(unit),
            a_X=0.0,
        )
        return alone.axial_jump

    def by_mass(self, change: MassChange) -> Array:
        """Return d(omega^2) for each unit of a parameter that changes the mass, shape (k,)."""
        if FAMILIES[self.modes.family].columns["mass"] != _MASS:
            return np.zeros(len(self.modes.omega2))
        return self._by_mass(
            change.density(self.modes.x),
            self._seen_ahead(change.ahead),
            change.ahead(np.array([self._length]))[0],
        )

    def by_water(self, change: WaterChange) -> Array:
        """Return d(omega^2) for each unit of a parameter that changes added mass, shape (k,)."""
        modes = self.modes
        if not self._bends:
            return np.zeros(len(modes.omega2))
        inside = (modes.x > change.start) & (modes.x < change.end)
        start, end, density = change.growth
        edges = end * modes.square(change.end) - start * modes.square(change.start)
        return np.asarray(
            density * modes.by_mass[inside].sum(axis=0) - modes.omega2 * change.density * edges
        )

    def _by_mass(self, density: Array, ahead: Array, total: Array) -> Array:
        """Return density and what it does to N, put together; shape (k,) or (rows, k)."""
        force = self.loads.a_X * (ahead.T - np.multiply.outer(total, self._share_ahead))
        return np.asarray(density.T @ self.modes.by_mass + force @ self.modes.by_axial_force)

    def by_shear(self, change: ShearChange) -> Array:
        """Return d(omega^2) by what shear and rotary inertia do, (k,) or (parameters, k)."""
        modes = self.modes
        if not (self._bends and self.beam.has_shear):
            return np.zeros(len(modes.omega2))
        stiffness, rotary = change.stiffness(modes.x) * self._softness, change.rotary(modes.x)
        return np.asarray(stiffness @ modes.by_shear_stiffness + rotary @ modes.by_rotary_inertia)

    @cached_property
    def _softness(self) -> Array:
        """Square of the flexibility in shear over the segment's mean of it, shape (q,)."""
        beam, k = self.beam, self._interval
        t = (self.modes.x - beam.x[k]) / np.diff(beam.x)[k]
        kGA = beam.column_at("shear_stiffness", k, t)
        engesser = beam.shear_form == "engesser"
        soft = kGA - beam.axial_force_at(k, t) if engesser else kGA
        with np.errstate(divide="ignore", invalid="ignore"):
            share = 1 / (soft * self.modes.mean_shear)
        return np.where(np.isinf(kGA), 1.0, share**2)

    def by_mass_rows(self, stations: Array, column: Array, how: Interpolation) -> Array:
        """Return derivatives by the rows of the column of mass per length, shape (stations, k)."""
        at_points = hats(self.modes.x, stations, column, how)
        ahead = at_points.ahead[:-1]
        if not self._exact:
            ends = integrals(self.beam.x, stations, column, how)[:-1]
            ahead = ((ends[:-1] + ends[1:]) / 2)[self._interval]
        return self._by_mass(at_points.value, ahead, at_points.ahead[-1])

    def by_stiffness_rows(self, stations: Array, column: Array, how: Interpolation) -> Array:
        """Return derivatives by the rows of the column of EI or EA, shape (stations, k)."""
        k = np.clip(np.searchsorted(stations, self.modes.x, "right") - 1, 0, len(stations) - 2)
        t = (self.modes.x - stations[k]) / np.diff(stations)[k]
        value = Profile.of_rows(stations, column, how).at(self.modes.x)
        return np.asarray(hat(k, t, column, how).T @ self.modes.by_stiffness(value))


def force_changes(
    lower: tuple[ForceOnBody[float], ...], upper: tuple[ForceOnBody[float], ...], step: float
) -> tuple[ForceChange, ...]:
    """Return how forces and places change, from those at both ends of a step of a parameter."""
    low, high = ({f.name: f for f in forces} for forces in (lower, upper))
    changes = []
    for name in low | high:
        a, b = low.get(name), high.get(name)
        drag = ((b.F_X if b else 0.0) - (a.F_X if a else 0.0)) / step
        place = (b.x - a.x) / step if a and b else 0.0
        changes.append(ForceChange(name, drag, place))
    return tuple(changes)
