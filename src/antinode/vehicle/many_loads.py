"""Loads of many cases of one vehicle at once: the equations of `loads.py` on arrays over cases.

What may vary: numbers of the condition, the water, the cavitator and the fins, and the columns of
mass and stiffness. The numbers are those of `compute_loads`, case by case, to rounding.

Source: as `loads.py`, eq. 1-26.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers, Interpolation
from antinode.beam.mass import MassTable

from .case import Case
from .hydrodynamics import cavitator, fins, planing
from .hydrodynamics.cavity import Cavity, cavity_length, froude_number, maximum_diameter
from .paths import Keys, value_at

Numbers = Mapping[Keys, Array]

OUT_OF_RANGE, CAVITATION, FINS, EXTRA_DRAG, NOT_FINITE = 10, 11, 12, 13, 14
_AGREEMENT = 1e-3  # as in condition.py
_BLOCK = 400_000  # numbers that are worked on at a time
_HALVINGS = 50

_FIN_NUMBERS = ("tip_radius", "thickness", "lift_slope", "chord", "position", "deflection")
_COLUMNS = ("mass_per_length", "bending_stiffness", "axial_stiffness")


def is_vectorised(keys: Keys) -> bool:
    """Tell whether a number or a column of the case may vary here."""
    if keys[0] in ("condition", "water", "time"):
        return True
    if keys[:2] == ("vehicle", "stations"):
        return keys[2] in _COLUMNS
    if keys[:2] == ("vehicle", "fins"):
        return len(keys) == 4 and keys[3] in _FIN_NUMBERS
    return keys == ("vehicle", "cavitator", "diameter")


@dataclass(frozen=True)
class Cavities(Cavity):
    """Cavities of many conditions: the numbers of `Cavity` are arrays here."""

    D_n: Any
    sigma: Any
    theta: Any
    alpha: Any
    Fr_L: Any

    @cached_property
    def D_c(self) -> Any:
        """Largest diameters [m]."""
        return maximum_diameter(self.D_n, self.sigma)

    @cached_property
    def L_c(self) -> Any:
        """Lengths [m]."""
        return cavity_length(self.D_n, self.sigma)

    @cached_property
    def _last_station(self) -> Any:
        thin = 1 + np.sqrt(1 - (self.D_n / self.D_c) ** 2)
        return thin if self.model.gravity_rise == "buoyancy" else 2.0

    def take(self, rows: Any, dimensions: int = 1) -> Cavities:
        """Return some of the cavities, their numbers with trailing dimensions of one."""
        shape = (-1, *(1,) * (dimensions - 1))

        def part(value: Any) -> Any:
            return value[rows].reshape(shape)

        return Cavities(
            D_n=part(self.D_n),
            sigma=part(self.sigma),
            theta=part(self.theta),
            alpha=part(self.alpha),
            Fr_L=part(self.Fr_L),
            body_length=self.body_length,
            model=self.model,
        )


@dataclass(frozen=True)
class Masses:
    """Mass per length of many cases, each interval with its two ends.

    Attributes
    ----------
    x : array, shape (m + 1,)
        Bounds of the intervals [m].
    ends : array, shape (cases or 1, m, 2)
        [kg/m].
    interpolation : {"step", "linear", "log"}
    """

    x: Array
    ends: Array
    interpolation: Interpolation

    def partial(self, size: Array, a: Array, b: Array, length: Array) -> list[Array]:
        """Integrals of m s^p over the first `size` metres of intervals with ends a, b; p to 2."""
        if self.interpolation != "log":
            slope = (b - a) / length
            return [
                a * size ** (p + 1) / (p + 1) + slope * size ** (p + 2) / (p + 2) for p in range(3)
            ]
        nodes, weights = np.polynomial.legendre.leggauss(16)
        t = size[..., None] * (nodes + 1) / 2
        m = a[..., None] * (b / a)[..., None] ** (t / length[..., None])
        return [size * np.sum(weights / 2 * m * t**p, axis=-1) for p in range(3)]

    @cached_property
    def moments(self) -> tuple[Array, Array, Array]:
        """Integrals of m, m x, m x^2 over each interval, shape (cases or 1, m)."""
        length, x = np.diff(self.x), self.x[:-1]
        size = np.broadcast_to(length, self.ends.shape[:2])
        J0, J1, J2 = self.partial(size, self.ends[..., 0], self.ends[..., 1], length)
        return J0, x * J0 + J1, x * x * J0 + 2 * x * J1 + J2

    @cached_property
    def ahead(self) -> Array:
        """Mass ahead of the bounds of the intervals [kg], shape (cases or 1, m + 1)."""
        J0 = self.moments[0]
        return np.concatenate([np.zeros((len(J0), 1)), np.cumsum(J0, axis=1)], axis=1)


@dataclass(frozen=True)
class ManyLoads:
    """Loads of many cases.

    Attributes
    ----------
    code : array of int, shape (cases,)
        0, or why a case has no loads.
    masses : Masses
    places, drags : array, shape (cases, forces)
        Of the forces behind the cavitator: where they act [m], and how large they are, aft [N].
    scalars : dict
        One number a case by the names of `LOAD_OUTPUTS`.
    """

    code: Integers
    masses: Masses
    places: Array
    drags: Array
    scalars: dict[str, Array]


def compute_many_loads(case: Case, numbers: Numbers, cases: int) -> ManyLoads:
    """Work out the loads of many cases.

    Parameters
    ----------
    case : Case
        Whatever does not vary.
    numbers : mapping
        Arrays over cases by the keys of numbers, shape (cases,), and of columns, (cases, rows).
    cases : int
    """
    with np.errstate(all="ignore"):
        return _Many(case, numbers, cases).loads()


class _Many:
    """The numbers of a case, as arrays where they vary."""

    def __init__(self, case: Case, numbers: Numbers, cases: int) -> None:
        self.case, self.numbers, self.cases = case, numbers, cases
        self.vehicle, self.model = case.vehicle, case.model
        self.code = np.zeros(cases, dtype=np.int64)

    def full(self, *keys: str | int) -> Array:
        """Return a number as an array over cases; it must be given."""
        found = self.maybe(*keys)
        assert found is not None
        return found

    def maybe(self, *keys: str | int) -> Array | None:
        if keys in self.numbers:
            return self.numbers[keys]
        value = value_at(self.case, keys)
        return None if value is None else np.full(self.cases, value)

    def refuse(self, wrong: Any, code: int) -> None:
        """Note why cases fail; the first reason stays."""
        self.code[np.asarray(wrong) & (self.code == 0)] = code

    def loads(self) -> ManyLoads:
        rho, V = self.full("water", "density"), self.full("condition", "speed")
        hole = self.cavity(self.sigma(rho, V), V)
        disk = cavitator.cavitator_forces(rho, V, hole.sigma, hole.D_n, hole.alpha)
        sets = [self.fin_set(k, hole, rho, V) for k in range(len(self.vehicle.fins))]
        F_PX, F_PY, x_P = self.planing(hole, rho, V)
        acting = (F_PX != 0) | (F_PY != 0)
        stations = self.vehicle.stations.x
        forces = [(_snapped(x, stations), drag, lift) for x, drag, lift in sets]
        x_force = np.where(acting, _snapped(x_P, stations), self.vehicle.length)
        forces += [(x_force, F_PX, F_PY), *self.extra_drag()]
        masses = self.masses()
        places, drags, lifts = (np.stack(each, axis=1) for each in zip(*forces, strict=True))
        scalars = self.balance(masses, disk, places, drags, lifts)
        scalars |= {
            "sigma": hole.sigma,
            "cavity_length": hole.L_c,
            "cavity_diameter": hole.D_c,
            "F_CX": disk[0],
            "F_CY": disk[1],
            "F_fX": _total([s[1] for s in sets], self.cases),
            "F_fY": _total([s[2] for s in sets], self.cases),
            "F_PX": F_PX,
            "F_PY": F_PY,
            "x_P": x_P,
        }
        finite = np.all(np.isfinite([*scalars.values()]), axis=0)
        self.refuse(~finite, NOT_FINITE)
        return ManyLoads(self.code, masses, places, drags, scalars)

    # --- water and cavity ---

    def sigma(self, rho: Array, V: Array) -> Array:
        """Cavitation number by what is given, eq. 1."""
        sigma, depth, p_c = (
            self.maybe("condition", name)
            for name in ("cavitation_number", "depth", "cavity_pressure")
        )
        p_atm, g = self.full("water", "atmospheric_pressure"), self.full("water", "gravity")
        q = rho * V**2 / 2
        if sigma is None:
            assert depth is not None
            inside = self.full("water", "vapour_pressure") if p_c is None else p_c
            sigma = (p_atm + rho * g * depth - inside) / q
            self.refuse(~((sigma > 0) & (sigma < 1)), CAVITATION)
        elif depth is not None:
            implied = p_atm + rho * g * depth - sigma * q
            self.refuse(implied < 0, CAVITATION)
            if p_c is not None:
                self.refuse(np.abs(p_c - implied) > _AGREEMENT * sigma * q, CAVITATION)
        elif p_c is not None:
            self.refuse(p_c + sigma * q < p_atm * (1 - 1e-9), CAVITATION)
        return np.where(self.code == 0, sigma, 0.5)

    def cavity(self, sigma: Array, V: Array) -> Cavities:
        D_n = self.full("vehicle", "cavitator", "diameter")
        theta = self.full("condition", "body_angle")
        L_c = cavity_length(D_n, sigma)
        return Cavities(
            D_n=D_n,
            sigma=sigma,
            theta=theta,
            alpha=theta + self.full("condition", "cavitator_angle"),
            Fr_L=froude_number(V, self.full("water", "gravity"), L_c),
            body_length=self.vehicle.length,
            model=self.model,
        )

    # --- forces ---

    def fin_set(self, k: int, hole: Cavities, rho: Array, V: Array) -> tuple[Array, Array, Array]:
        """Place, drag and lift of one set of fins."""
        vehicle, phi = self.vehicle, np.array(self.vehicle.fins[k].roll_angles)
        x = self.maybe("vehicle", "fins", k, "position")
        x = self.maybe("condition", "fin_position") if x is None else x
        if x is None:
            self.refuse(np.ones(self.cases, dtype=bool), FINS)
            x = np.zeros(self.cases)
        self.refuse(x > vehicle.length, FINS)
        R, tip = vehicle.radius_at(x), self.full("vehicle", "fins", k, "tip_radius")
        self.refuse(tip <= R, FINS)
        radial = self.model.fin_immersion == "radial"
        immersion = fins.radial_immersion if radial else fins.tip_immersion
        offset, R_c = hole.axis_offset(x), hole.radius(x)
        h_f = immersion(R[:, None], tip[:, None], phi, offset[:, None], R_c[:, None])
        d_f = self.full("vehicle", "fins", k, "thickness")
        flow = rho[:, None], V[:, None]
        drag = fins.fin_drag(flow[0], flow[1], hole.sigma[:, None], h_f, d_f[:, None])
        plate = self.model.fin_lift == "plate"
        slope = self.full("vehicle", "fins", k, "lift_slope") if plate else np.zeros(self.cases)
        chord = self.maybe("vehicle", "fins", k, "chord")
        area = h_f * (tip - R if chord is None else chord)[:, None]
        deflection = self.full("vehicle", "fins", k, "deflection")
        incidence = fins.fin_incidence(hole.theta[:, None], deflection[:, None], phi)
        lift = fins.fin_lift(flow[0], flow[1], slope[:, None], area, incidence, phi)
        return x, drag.sum(axis=1), lift.sum(axis=1)

    def planing(self, hole: Cavities, rho: Array, V: Array) -> tuple[Array, Array, Array]:
        """Drag, lift and place of the planing forces, eq. 16 and 17."""
        tail, model = self.vehicle.length, self.model
        length, area, centroid = self.wetted(hole)
        x = np.minimum(tail, hole.L_c)
        R = np.full(self.cases, float(self.vehicle.radius_at(tail)))
        R_c, offset = hole.radius(x), hole.axis_offset(x)
        h, R_prime = planing.immersion_ratio(offset, R_c, R), planing.clearance_ratio(R_c, R)
        alpha_p = _planing_angle(hole, x)
        size = planing.planing_force(rho, V, R, h, R_prime, alpha_p, hole.L_c < tail)
        mu = self.full("water", "dynamic_viscosity")
        drag = model.planing_drag_factor * planing.planing_drag(rho, V, length, area, mu)
        lift = size * planing.direction(offset, R, model.planing_direction_width)
        place = centroid if model.planing_position == "centroid" else np.full(self.cases, tail)
        if model.planing != "paper":
            drag, lift = np.zeros(self.cases), np.zeros(self.cases)
        return drag, lift, place

    def extra_drag(self) -> list[tuple[Array, Array, Array]]:
        drag = self.maybe("condition", "extra_drag")
        if drag is None:
            return []
        places = (
            self.maybe("condition", "extra_drag_position"),
            self.maybe("condition", "fin_position"),
            np.full(self.cases, self.vehicle.length),
        )
        x = next(place for place in places if place is not None)
        self.refuse(x > self.vehicle.length, EXTRA_DRAG)
        return [(_snapped(x, self.vehicle.stations.x), drag, np.zeros(self.cases))]

    # --- the wetted surface ---

    def wetted(self, hole: Cavities) -> tuple[Array, Array, Array]:
        """Wetted length, area and centroid, aft of the middle of every cavity."""
        stations, tail = self.vehicle.stations.x, self.vehicle.length
        length, area = np.zeros(self.cases), np.zeros(self.cases)
        centroid = np.full(self.cases, tail)
        start, closure = hole.L_c / 2, hole.L_c
        first = np.searchsorted(stations, start, side="right")
        closes = (closure < tail) & ~np.isin(closure, stations)
        group = 2 * first + closes
        live = (start < tail) & (self.code == 0)
        for key in np.unique(group[live]):
            rows = np.flatnonzero(live & (group == key))
            inner = stations[key // 2 : -1]
            pieces = len(inner) + 1 + key % 2
            block = max(1, _BLOCK // (max(planing._SAMPLES, 4 * pieces) + pieces))
            for k in range(0, len(rows), block):
                part = rows[k : k + block]
                cuts = _cuts(start[part], inner, tail, closure[part] if key % 2 else None)
                length[part], area[part], centroid[part] = self._wet_group(hole, part, cuts, tail)
        return length, area, centroid

    def _wet_group(
        self, hole: Cavities, rows: Integers, cuts: Array, tail: float
    ) -> tuple[Array, Array, Array]:
        """Integrate the wetted surface of cases with as many cuts each."""
        pieces = self._split_at_contacts(hole, rows, cuts)
        cavity, radius = hole.take(rows, 3), self.vehicle.radius_at
        width = np.diff(pieces, axis=1)[..., None]
        x = pieces[:, :-1, None] + width * planing._T
        R = radius(x)
        angle = planing.wet_angle(R, cavity.radius(x), cavity.axis_offset(x))
        across = planing.wetted_width(R, angle, self.model.planing_area)
        strips = width * planing._DT * across
        area = strips.sum(axis=(1, 2))
        wet = area > 0
        length = np.where(np.any(across != 0, axis=2), width[..., 0], 0.0).sum(axis=1)
        centroid = (strips * x).sum(axis=(1, 2)) / np.where(wet, area, 1.0)
        return (
            np.where(wet, length, 0.0),
            np.where(wet, area, 0.0),
            np.where(wet, centroid, tail),
        )

    def _split_at_contacts(self, hole: Cavities, rows: Integers, cuts: Array) -> Array:
        """Add to the cuts of each case where wetting starts or ends; padded with the tail."""
        radius, count = self.vehicle.radius_at, cuts.shape[1] - 1
        samples = max(4, -(-planing._SAMPLES // count))
        t = np.clip(np.linspace(0, 1, samples + 1), 1e-12, 1 - 1e-12)
        grid = cuts[:, :-1, None] + np.diff(cuts, axis=1)[..., None] * t
        inside = hole.take(rows, 3)
        R, axis, wall = radius(grid), np.abs(inside.axis_offset(grid)), inside.radius(grid)
        found = [
            _roots(sign, grid, rows, hole, radius, around=around)
            for around, sign in ((False, axis + R - wall > 0), (True, np.abs(R - axis) - wall > 0))
        ]
        case, x = (np.concatenate(each) for each in zip(*found, strict=True))
        if not len(case):
            return cuts
        order = np.argsort(case, kind="stable")
        case, x = case[order], x[order]
        number = np.arange(len(case)) - np.searchsorted(case, case)
        more = np.repeat(cuts[:, -1:], int(number.max()) + 1, axis=1)
        more[case, number] = x
        return np.sort(np.concatenate([cuts, more], axis=1), axis=1)

    # --- masses and balance ---

    def column(self, name: str, state: str | None = None) -> Array:
        """Return a column of the stations, shape (cases or 1, rows)."""
        keys: Keys = ("vehicle", "stations", name, *([state] if state else []))
        if keys in self.numbers:
            return self.numbers[keys]
        own = getattr(self.vehicle.stations, name)
        return np.asarray(own[state] if state else own)[None]

    def masses(self) -> Masses:
        """Mass per length at the ends of all intervals, parts added."""
        vehicle, burn = self.vehicle, self.full("condition", "burn_fraction")
        states = [self.column("mass_per_length", s) for s in vehicle.stations.mass_per_length]
        varies = ("condition", "burn_fraction") in self.numbers
        column = _burnt(states, burn if varies else burn[:1])
        x, how = vehicle.stations.x, vehicle.interpolation
        ends = _interval_ends(column, how)
        for part in vehicle.masses:
            x, ends, how = _with_part(x, ends, how, part, burn if varies else burn[:1])
        return Masses(x, ends, how)

    def balance(
        self, masses: Masses, disk: tuple[Array, Array], places: Array, drags: Array, lifts: Array
    ) -> dict[str, Array]:
        """Eq. 18-20."""
        m, J1, J2 = (np.broadcast_to(J.sum(axis=1), (self.cases,)) for J in masses.moments)
        x_M = J1 / m
        inertia = J2 - x_M * J1
        thrust, g = self.full("condition", "thrust"), self.full("water", "gravity")
        turn = disk[1] * x_M + np.sum(lifts * (x_M[:, None] - places), axis=1)
        return {
            "mass": m,
            "x_M": x_M,
            "a_X": (thrust - disk[0] - drags.sum(axis=1)) / m,
            "a_Y": (disk[1] + lifts.sum(axis=1)) / m - g,
            "beta": turn / inertia,
        }


def _total(parts: list[Array], cases: int) -> Array:
    return np.asarray(sum(parts, np.zeros(cases)))


def _planing_angle(hole: Cavities, x: Array) -> Array:
    """Planing angle at the tail, or at the closure, by the model [rad]."""
    if hole.model.planing_angle == "attitude":
        return np.asarray(np.abs(hole.theta))
    axis = np.abs(hole.axis_slope(x))
    wall = np.abs(hole.radius_slope(x)) if hole.model.planing_angle == "wall" else 0.0
    return np.asarray(axis + wall)


def _snapped(position: Array, stations: Array) -> Array:
    """Return stations that are the same as positions but for rounding, else the positions."""
    after = np.clip(np.searchsorted(stations, position), 1, len(stations) - 1)
    low, high = stations[after - 1], stations[after]
    nearest = np.where(np.abs(position - low) <= np.abs(high - position), low, high)
    return np.where(np.abs(nearest - position) <= 1e-9 * stations[-1], nearest, position)


def _cuts(start: Array, inner: Array, tail: float, closure: Array | None) -> Array:
    """Return the middle of each cavity, the stations behind it, the closure and the tail."""
    n = len(start)
    parts = [start[:, None], np.broadcast_to(inner, (n, len(inner))), np.full((n, 1), tail)]
    if closure is not None:
        parts.append(closure[:, None])
    return np.sort(np.concatenate(parts, axis=1), axis=1)


def _roots(
    positive: npt.NDArray[np.bool_],
    grid: Array,
    rows: Integers,
    hole: Cavities,
    radius: Any,
    *,
    around: bool,
) -> tuple[Integers, Array]:
    """Bisect between neighbours on each row of the grid where the sign changes.

    Returns the case of every root, counted within the grid, and its place.
    """
    change = positive[..., :-1] != positive[..., 1:]
    case = np.nonzero(change)[0]
    low, high = grid[..., :-1][change], grid[..., 1:][change]
    sign, cavity = positive[..., :-1][change], hole.take(rows[case])
    for _ in range(_HALVINGS if len(case) else 0):
        x = (low + high) / 2
        R, offset, wall = radius(x), np.abs(cavity.axis_offset(x)), cavity.radius(x)
        gap = np.abs(R - offset) - wall if around else offset + R - wall
        left = (gap > 0) == sign
        low, high = np.where(left, x, low), np.where(left, high, x)
    return case, (low + high) / 2


def _burnt(states: list[Array], burn: Array) -> Array:
    """Return the column of mass at each burn fraction, linear between neighbouring states."""
    if len(states) == 1:
        return states[0]
    place = burn * (len(states) - 1)
    k = np.minimum(place.astype(np.int64), len(states) - 2)
    share = (place - k)[:, None]
    cases = max(len(burn), *map(len, states))
    table = np.stack([np.broadcast_to(s, (cases, s.shape[1])) for s in states])
    row, k = np.arange(cases), np.broadcast_to(k, (cases,))
    return np.asarray(table[k, row] + share * (table[k + 1, row] - table[k, row]))


def _interval_ends(column: Array, how: str) -> Array:
    """Return the values at both ends of the intervals, shape (cases or 1, m, 2)."""
    before = column[:, :-1]
    return np.stack([before, before if how == "step" else column[:, 1:]], axis=-1)


def _with_part(
    x: Array, ends: Array, how: Interpolation, part: MassTable, burn: Array
) -> tuple[Array, Array, Interpolation]:
    """Add a part to intervals that hold or are linear."""
    own = part.distribution(0.0)
    together = np.union1d(x, own.x)
    k = np.clip(np.searchsorted(x, (together[1:] + together[:-1]) / 2) - 1, 0, len(x) - 2)
    size = (x[k + 1] - x[k])[:, None]
    t = (np.stack([together[:-1], together[1:]], axis=1) - x[k][:, None]) / size
    a, b = ends[:, k, :1], ends[:, k, 1:]
    share = (1 - burn)[:, None, None] if part.burns else 1.0
    total = a + (b - a) * t + share * own.between(together)
    both: Interpolation = "step" if how == own.interpolation == "step" else "linear"
    return together, total, both
