"""The beam: what every vibration problem of antinode becomes, and all that the solver needs.

Properties are given on intervals between breakpoints by their values at both ends of the interval
and vary between them linearly or logarithmically (the axial force always linearly). N > 0 is
compression; x runs from the left end (the nose) to the right.

A chain of uniform segments represents an interval exactly when nothing varies in it. Elsewhere each
step is two uniform half-segments whose 1/EI, m and N are averages of the values at the two Gauss
points with weights 1/2 +- sqrt(3)/3, the larger for the nearer point: fourth order in the step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .attachments import (
    Attachment,
    Joint,
    PointMass,
    check_attachments,
    check_supports_apart,
    gather,
    held_places,
)
from .errors import InputError
from .riccati.chain import Chain, Family, Integers
from .riccati.points import Point

Array = npt.NDArray[np.float64]
End = Literal["free", "clamped", "pinned", "sliding"]
AxialEnd = Literal["free", "fixed"]
Interpolation = Literal["step", "linear", "log"]

_GAUSS = 0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6
_NEAR, _FAR = 0.5 + np.sqrt(3) / 3, 0.5 - np.sqrt(3) / 3
_STEEPEST = 4.0  # ratio of a property across one step (averages stay positive up to 13.9)
_LONGEST = 1 / 16  # share of one step in the waves along the beam
_MOST_HALVINGS = 40
LIMITS = _STEEPEST, _LONGEST, _MOST_HALVINGS
"""What the coarsest steps keep to: `riccati.lanes` makes the same ones."""


@dataclass(frozen=True)
class Ends:
    """How the two ends are held, laterally and axially.

    Parameters
    ----------
    left, right : {"free", "clamped", "pinned", "sliding"}
        A pinned end has Y = M = 0, a sliding one theta = Q = 0. Forces at an end keep their
        direction: at a free end Q = M' + N Y' = 0 (equations 64-65).
    left_axial, right_axial : {"free", "fixed"}, optional
        Default: fixed for clamped and pinned ends, else free.
    """

    left: End = "free"
    right: End = "free"
    left_axial: AxialEnd | None = None
    right_axial: AxialEnd | None = None

    def of(self, family: Family) -> tuple[str, str]:
        """Return the two ends as the solver names them for a family of modes."""
        if family == "bending":
            return self.left, self.right
        return (
            self.left_axial or _axial_default(self.left),
            self.right_axial or _axial_default(self.right),
        )


def _axial_default(end: End) -> AxialEnd:
    return "fixed" if end in ("clamped", "pinned") else "free"


@dataclass(frozen=True)
class Beam:
    """A straight non-uniform Euler-Bernoulli beam under static axial force.

    Parameters
    ----------
    x : array, shape (n + 1,)
        Breakpoints from left to right [m].
    mass_per_length, bending_stiffness : array, shape (n, 2)
        m [kg/m] and EI [N m^2] at the left and right end of every interval, positive.
    axial_stiffness : array, shape (n, 2), optional
        EA [N]; without it there are no longitudinal modes.
    axial_force : array, shape (n, 2), optional
        N [N], compression positive, linear in each interval; zero by default.
    axial_acceleration : float
        a [m/s^2] adds ``a * (mass left of x)`` to N: the inertia of a body that accelerates
        towards -x, or weight that acts towards +x.
    interpolation : {"step", "linear", "log"}
        How m, EI, EA vary between the two values of an interval ("step": they are equal).
    ends : Ends
    radius_of_gyration : array, shape (n, 2), optional
        Of the cross-section [m], for the estimate of shear and rotary inertia only; by default
        sqrt(EI/EA).
    attachments : tuple of PointMass, Spring and Joint
        At breakpoints; `with_attachments` makes the breakpoints.
    offset_weight : bool
        Whether the part of N that the axial acceleration makes of an offset point mass acts
        through its own centre, and so bends the beam when it turns.
    name : str

    Raises
    ------
    InputError
        If shapes disagree, breakpoints do not increase, a property is not positive and finite, or
        an attachment is not at a breakpoint.
    """

    x: Array
    mass_per_length: Array
    bending_stiffness: Array
    axial_stiffness: Array | None = None
    axial_force: Array = field(default_factory=lambda: np.zeros(0))
    axial_acceleration: float = 0.0
    interpolation: Interpolation = "step"
    ends: Ends = Ends()
    radius_of_gyration: Array | None = None
    attachments: tuple[Attachment, ...] = ()
    offset_weight: bool = True
    name: str = "beam"

    def __post_init__(self) -> None:
        if not len(self.axial_force):
            object.__setattr__(self, "axial_force", np.zeros((len(self.x) - 1, 2)))
        for name in ("x", *_TABLES):
            values = getattr(self, name)
            if values is not None:
                object.__setattr__(self, name, _own(values))
        _check(self)

    @classmethod
    def from_stations(
        cls,
        x: npt.ArrayLike,
        mass_per_length: npt.ArrayLike,
        bending_stiffness: npt.ArrayLike,
        axial_stiffness: npt.ArrayLike | None = None,
        axial_force: npt.ArrayLike | None = None,
        *,
        interpolation: Interpolation = "step",
        ends: Ends | None = None,
        radius_of_gyration: npt.ArrayLike | None = None,
        name: str = "beam",
    ) -> Beam:
        """Build a beam from values at stations.

        Parameters
        ----------
        x : array_like, shape (n + 1,)
            Stations [m].
        mass_per_length, bending_stiffness, axial_stiffness, axial_force, radius_of_gyration
            Values at the stations, shape (n + 1,) [kg/m, N m^2, N, N, m]. With "step" row k holds
            from x_k to x_k+1 and the last row only closes the table (shape (n,) is accepted too).
        interpolation : {"step", "linear", "log"}
        ends : Ends
        name : str
        """
        stations = np.asarray(x, dtype=float)
        intervals = len(stations) - 1

        def between(values: npt.ArrayLike | None) -> Array | None:
            """Return values at both ends of every interval, shape (n, 2)."""
            if values is None:
                return None
            column = np.asarray(values, dtype=float)
            if column.ndim == 0:
                column = np.full(len(stations), column)
            table = np.empty((intervals, 2))
            right = column[:intervals] if interpolation == "step" else column[1:]
            table[:, 0], table[:, 1] = column[:intervals], right
            table.flags.writeable = False
            return table

        m, EI, EA, N, r = (
            between(v)
            for v in (
                mass_per_length,
                bending_stiffness,
                axial_stiffness,
                axial_force,
                radius_of_gyration,
            )
        )
        assert m is not None
        assert EI is not None
        return cls(
            stations,
            m,
            EI,
            EA,
            N if N is not None else np.zeros(0),
            interpolation=interpolation,
            ends=ends or Ends(),
            radius_of_gyration=r,
            name=name,
        )

    @property
    def length(self) -> float:
        """Length [m]."""
        return float(self.x[-1] - self.x[0])

    @cached_property
    def mass(self) -> float:
        """Total mass [kg], point masses included."""
        return float(self.mass_left[-1])

    @cached_property
    def mass_left(self) -> Array:
        """Mass left of every breakpoint and at it [kg], shape (n + 1,)."""
        whole = _partial_mass(self, np.arange(len(self.x) - 1), np.ones(len(self.x) - 1))
        points = np.zeros(len(self.x))
        for item in self.attachments:
            if isinstance(item, PointMass):
                points[self._breakpoint(item.x)] += item.mass
        return np.concatenate([[0.0], np.cumsum(whole)]) + np.cumsum(points)

    def mass_left_of(self, interval: Integers, fraction: Array) -> Array:
        """Return the mass left of places inside intervals [kg]."""
        return np.asarray(self.mass_left[interval] + _partial_mass(self, interval, fraction))

    def _breakpoint(self, x: float) -> int:
        return int(np.argmin(np.abs(self.x - x)))

    @property
    def axial_joint_compliance(self) -> Array:
        """Axial compliance of the joints at every breakpoint [m/N], shape (n + 1,)."""
        compliance = np.zeros(len(self.x))
        for item in self.attachments:
            if isinstance(item, Joint):
                compliance[self._breakpoint(item.x)] += item.axial
        return compliance

    def with_breakpoints(self, positions: Sequence[float]) -> Beam:
        """Return the same beam with breakpoints at the given positions [m] as well."""
        inside = [p for p in positions if np.min(np.abs(self.x - p)) > 1e-12 * self.length]
        if not inside:
            return self
        x = np.union1d(self.x, inside)
        k = np.clip(np.searchsorted(self.x, (x[1:] + x[:-1]) / 2) - 1, 0, len(self.x) - 2)
        size = np.diff(self.x)[k]
        start, end = (x[:-1] - self.x[k]) / size, (x[1:] - self.x[k]) / size
        linear = replace(self, interpolation="linear")
        tables: dict[str, Any] = {}
        for name in _TABLES:
            values = getattr(self, name)
            how = linear if name == "axial_force" else self
            if values is not None:
                sides = (how.at(values, k, start), how.at(values, k, end))
                tables[name] = np.stack(sides, axis=1)
        return replace(self, x=x, **tables)

    def with_attachments(self, *attachments: Attachment) -> Beam:
        """Return the beam with point masses, springs and joints added, and breakpoints for them."""
        check_attachments(attachments, self.x)
        beam = self.with_breakpoints([item.x for item in attachments])
        return replace(beam, attachments=(*self.attachments, *attachments))

    @cached_property
    def moment_of_inertia(self) -> float:
        """Moment of inertia about the centre of mass [kg m^2], point masses included."""
        points, weights = np.polynomial.legendre.leggauss(8)
        k = np.arange(len(self.x) - 1)[:, None]
        t = (points + 1) / 2
        dm = (self.at(self.mass_per_length, k, t) * np.diff(self.x)[:, None] * weights / 2).ravel()
        x = (self.x[:-1, None] + np.diff(self.x)[:, None] * t).ravel()
        masses = [item for item in self.attachments if isinstance(item, PointMass)]
        dm = np.append(dm, [item.mass for item in masses])
        x = np.append(x, [item.x + item.offset for item in masses])
        centre = np.sum(dm * x) / np.sum(dm)
        own = sum(item.rotary_inertia for item in masses)
        return float(np.sum(dm * (x - centre) ** 2)) + own

    def at(self, values: Array, interval: Integers, fraction: Array) -> Array:
        """Interpolate a property inside intervals, at fractions 0 ... 1 of their lengths."""
        a, b = values[interval, 0], values[interval, 1]
        if self.interpolation == "log":
            return np.asarray(a * (b / a) ** fraction)
        return np.asarray(a + (b - a) * fraction)

    def axial_force_at(self, interval: Integers, fraction: Array) -> Array:
        """Return N [N] inside intervals, at fractions 0 ... 1 of their lengths."""
        table = self.axial_force[interval]
        N = table[..., 0] + (table[..., 1] - table[..., 0]) * fraction
        if self.axial_acceleration == 0.0:
            return np.asarray(N)
        return np.asarray(N + self.axial_acceleration * self.mass_left_of(interval, fraction))

    @cached_property
    def is_unloaded(self) -> bool:
        """Whether no axial force acts anywhere."""
        return self.axial_acceleration == 0.0 and not np.any(self.axial_force)

    def without_axial_force(self) -> Beam:
        """Return the same beam with N = 0 everywhere."""
        return replace(self, axial_force=np.zeros_like(self.axial_force), axial_acceleration=0.0)

    def reversed(self) -> Beam:
        """Return the beam read from the other end (acceleration becomes part of the table)."""
        if self.axial_acceleration:
            raise InputError("a beam under acceleration cannot be reversed: tabulate N(x) instead")
        flip: dict[str, Any] = {
            name: None if (v := getattr(self, name)) is None else v[::-1, ::-1].copy()
            for name in _TABLES
        }
        e = self.ends
        ends = Ends(e.right, e.left, e.right_axial, e.left_axial)
        total = self.x[-1] + self.x[0]
        items: list[Attachment] = []
        for item in self.attachments:
            turned = replace(item, x=total - item.x)
            if isinstance(turned, PointMass):
                turned = replace(turned, offset=-turned.offset)
            items.append(turned)
        return replace(
            self, x=total - self.x[::-1], ends=ends, attachments=tuple(items[::-1]), **flip
        )

    def varies(self, family: Family) -> npt.NDArray[np.bool_]:
        """Tell for each interval whether anything that the family sees varies inside it."""
        tables = [self.mass_per_length]
        if family == "longitudinal":
            tables.append(_given(self.axial_stiffness))
            return np.asarray(np.any([t[:, 0] != t[:, 1] for t in tables], axis=0))
        tables += [self.bending_stiffness, self.axial_force]
        varying = np.full(len(self.x) - 1, self.axial_acceleration != 0.0)
        for table in tables:
            varying |= table[:, 0] != table[:, 1]
        return varying

    def chain(self, family: Family, refinement: int = 1) -> Chain:
        """Represent the beam by uniform segments for one family of modes.

        Parameters
        ----------
        family : {"bending", "longitudinal"}
        refinement : int
            Number by which the steps of the coarsest representation are divided; intervals in
            which nothing varies stay whole: they are exact.

        Returns
        -------
        Chain
        """
        varies = self.varies(family)
        if not varies.any():
            return self._uniform_chain(family)
        cell, start, size = _coarsest_steps(self, family)
        times = np.where(varies[cell], refinement, 1)
        which, number = _copies(times)
        interval, size = cell[which], (size / times)[which]
        start = start[which] + number * size
        halves = np.where(varies[interval], 2, 1)
        step, second = _copies(halves)
        nearer = np.where(second == 1, _FAR, _NEAR)  # weight of the first Gauss point

        def average(values: Callable[[Integers, Array], Array]) -> Array:
            """Return weighted means of the values at the Gauss points, one for each segment."""
            first, last = (values(interval, start + size * g)[step] for g in _GAUSS)
            return np.asarray(nearer * first + (1 - nearer) * last)

        stiffness = self.bending_stiffness if family == "bending" else _given(self.axial_stiffness)
        first = np.concatenate([[0], np.cumsum(np.bincount(interval[step]))])
        left, right, points = self.points(family, first)
        return Chain(
            points=points,
            length=(np.diff(self.x)[interval] * size / halves)[step],
            mass=average(lambda k, t: self.at(self.mass_per_length, k, t)),
            stiffness=1.0 / average(lambda k, t: 1.0 / self.at(stiffness, k, t)),
            axial_force=average(self.axial_force_at),
            left=left,
            right=right,
            family=family,
        )

    def _uniform_chain(self, family: Family) -> Chain:
        """Return one segment for every interval: nothing varies in any."""
        stiffness = self.bending_stiffness if family == "bending" else _given(self.axial_stiffness)
        left, right, points = self.points(family)
        tables = (self.mass_per_length, stiffness, self.axial_force)
        m, EI, N = (np.ascontiguousarray(table[:, 0]) for table in tables)
        return Chain(np.diff(self.x), m, EI, N, left, right, family, points)

    def points(
        self, family: Family, first: Integers | None = None
    ) -> tuple[str, str, tuple[Point, ...]]:
        """Return the ends with their supports, and the points at nodes of a chain.

        `first` is the node of every breakpoint: its number, unless given.
        """
        if first is None:
            first = np.arange(len(self.x))
        acceleration = self.axial_acceleration if self.offset_weight else 0.0
        points = gather(self.attachments, self.x, family, acceleration)
        ends = list(self.ends.of(family))
        for side, k in ((0, 0), (1, len(self.x) - 1)):
            if k in points:
                ends[side] = _held(ends[side], points[k].holds, family)
                points[k] = replace(points[k], holds=())
        kept = tuple(replace(p, node=int(first[k])) for k, p in points.items())
        return ends[0], ends[1], kept

    def freedoms(self, family: Family) -> Array:
        """Return the rigid motions that nothing holds.

        Returns
        -------
        array, shape (freedoms, 2)
            Rows [a, b] of motions ``a + b (x - x[0])``; longitudinally only [1, 0] can occur.
        """
        if family not in self._known_freedoms:
            self._known_freedoms[family] = self._find_freedoms(family)
        return self._known_freedoms[family]

    @cached_property
    def _known_freedoms(self) -> dict[Family, Array]:
        return {}

    def _find_freedoms(self, family: Family) -> Array:
        rows = [np.zeros(2)]
        left, right, points = self.points(family)
        held = [(0.0, _HOLDS[left]), (self.length, _HOLDS[right])]
        for point in points:
            springs = (point.spring, point.rotational_spring)
            all_held = {*point.holds, *(i for i, stiffness in enumerate(springs) if stiffness)}
            held.append((float(self.x[point.node] - self.x[0]), tuple(all_held)))
        if family == "longitudinal":
            return np.zeros((0, 2)) if any(rows for _, rows in held) else np.array([[1.0, 0.0]])
        for x, components in held:
            rows += [np.array([1.0, x / self.length]) if c == 0 else _SLOPE for c in components]
        _, size, basis = np.linalg.svd(np.array(rows))
        rank = int(np.sum(size > 1e-9))
        return np.asarray(basis[rank:] / np.array([1.0, self.length]))


_SLOPE = np.array([0.0, 1.0])
_HOLDS: dict[str, tuple[int, ...]] = {
    "free": (),
    "pinned": (0,),
    "sliding": (1,),
    "clamped": (0, 1),
    "fixed": (0,),
}


def _held(end: str, holds: tuple[int, ...], family: Family) -> str:
    """Return an end that a support holds as well."""
    if family == "longitudinal":
        return "fixed" if holds else end
    both = tuple(sorted({*_HOLDS[end], *holds}))
    return {(): "free", (0,): "pinned", (1,): "sliding", (0, 1): "clamped"}[both]


def _copies(times: Integers) -> tuple[Integers, Integers]:
    """Return, for entry k repeated ``times[k]`` times, every copy's k and its number from 0."""
    index = np.repeat(np.arange(len(times)), times)
    return index, np.arange(len(index)) - (np.cumsum(times) - times)[index]


_TABLES = (
    "mass_per_length",
    "bending_stiffness",
    "axial_stiffness",
    "axial_force",
    "radius_of_gyration",
)


def _own(values: npt.ArrayLike) -> Array:
    """Return a read-only array that nobody else can write to."""
    if isinstance(values, np.ndarray) and values.dtype == np.float64:
        kept: Array = values
        if kept.base is None and not kept.flags.writeable:
            return kept
    own = np.array(values, dtype=float)
    own.flags.writeable = False
    return own


def _given(values: Array | None) -> Array:
    if values is None:
        raise InputError("axial_stiffness is missing: longitudinal modes need EA [N]")
    return values


def _partial_mass(beam: Beam, interval: Integers, fraction: Array) -> Array:
    """Return the mass between the left end of an interval and a fraction of it [kg]."""
    a, b = beam.mass_per_length[interval, 0], beam.mass_per_length[interval, 1]
    h = np.diff(beam.x)[interval] * fraction
    if beam.interpolation == "log":
        rate = np.log(b / a) * fraction
        mean = np.where(np.abs(rate) > 1e-12, np.expm1(rate) / np.where(rate == 0, 1, rate), 1.0)
        return np.asarray(a * h * mean)
    return np.asarray(h * (a + (b - a) * fraction / 2))


def _coarsest_steps(beam: Beam, family: Family) -> tuple[Integers, Array, Array]:
    """Divide intervals in which something varies until no step is long or steep.

    Returns
    -------
    interval, start, size : array
        Of every step; start and size as fractions of the interval's length.
    """
    interval = np.arange(len(beam.x) - 1)
    start, size = np.zeros(len(interval)), np.ones(len(interval))
    main = beam.bending_stiffness if family == "bending" else _given(beam.axial_stiffness)
    varies, power = beam.varies(family), 4 if family == "bending" else 2
    for _ in range(_MOST_HALVINGS):
        ends = [
            [beam.at(table, interval, start + side * size) for side in (0.0, 1.0)]
            for table in (beam.mass_per_length, main)
        ]
        steepest = np.max([np.maximum(a / b, b / a) for a, b in ends], axis=0)
        mass, stiffness = (np.sqrt(a * b) for a, b in ends)
        phase = (mass / stiffness) ** (1 / power) * np.diff(beam.x)[interval] * size
        coarse = (steepest > _STEEPEST) | (phase > _LONGEST * np.sum(phase))
        pieces = np.where(coarse & varies[interval], 2, 1)
        if np.all(pieces == 1):
            break
        which, second = _copies(pieces)
        interval, size = interval[which], (size / pieces)[which]
        start = start[which] + second * size
    return interval, start, size


def _check(beam: Beam) -> None:
    n = len(beam.x) - 1
    if n < 1:
        raise InputError(f"a beam needs at least two breakpoints x; received {n + 1}")
    if not np.isfinite(beam.x).all():
        raise InputError("x: every breakpoint must be a finite number [m]")
    rises = beam.x[1:] > beam.x[:-1]
    for k in () if rises.all() else np.flatnonzero(~rises)[:1]:
        raise InputError(
            f"x must increase from row to row: row {k + 2} has {beam.x[k + 1]:g} m "
            f"after {beam.x[k]:g} m in row {k + 1}"
        )
    for name in _TABLES:
        values = getattr(beam, name)
        if values is not None:
            _check_table(name, values, n)
    if beam.attachments:
        check_attachments(beam.attachments, beam.x)
        _check_supports(beam)
    for item in beam.attachments:
        if np.min(np.abs(beam.x - item.x)) > 1e-9 * beam.length:
            raise InputError(
                f"no breakpoint at x = {item.x:g} m, where something is attached; "
                "use Beam.with_attachments"
            )


def _check_supports(beam: Beam) -> None:
    """Refuse a support that all but coincides with an end which is held, or with another one."""
    ends = zip((beam.ends.left, beam.ends.right), beam.x[[0, -1]].tolist(), strict=True)
    held = [x for end, x in ends if end in ("pinned", "clamped")]
    check_supports_apart([*held, *held_places(beam.attachments)], beam.x)


def _check_table(name: str, values: Array, n: int) -> None:
    if values.shape != (n, 2):
        raise InputError(f"{name} has shape {values.shape}; {n} intervals need shape ({n}, 2)")
    ok = np.isfinite(values) if name == "axial_force" else np.isfinite(values) & (values > 0)
    if ok.all():
        return
    for row, side in np.argwhere(~ok)[:1]:
        allowed = "finite" if name == "axial_force" else "positive and finite"
        raise InputError(f"{name} must be {allowed}: interval {row + 1} has {values[row, side]:g}")
