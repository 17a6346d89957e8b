"""Shapes of modes on the output grid: named, normalised, with what follows from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Integers, Numbers
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.sections.shapes import THIN_TUBE
from antinode.riccati.chain import Chain
from antinode.riccati.laws import Columns, Units
from antinode.riccati.roots import Eigenvalue
from antinode.riccati.shapes import Energies, propagate

from .backends import Backend
from .clusters import part
from .result import Normalisation
from .rigid import rigid_state


def output_grid(beam: Beam, modes: int) -> Array:
    """Return breakpoints and points between, dense enough for smooth shapes [m]."""
    spacing = beam.length / max(200, 20 * (modes + 2))
    h = beam.x[1:] - beam.x[:-1]
    pieces = np.ceil(h / spacing).astype(int)
    first = np.cumsum(pieces) - pieces
    number = np.arange(first[-1] + pieces[-1]) - np.repeat(first, pieces)
    points = np.repeat(beam.x[:-1], pieces) + number * np.repeat(h / pieces, pieces)
    inner = [item.x for item in beam.attachments if beam.x[0] < item.x < beam.x[-1]]
    doubled = sorted({int(np.argmin(np.abs(beam.x - x))) for x in inner})
    grid = np.append(points, beam.x[-1])
    return np.sort(np.append(grid, beam.x[doubled])) if doubled else grid


def shapes(
    solver: Backend,
    beam: Beam,
    chain: Chain,
    eigenvalues: list[Eigenvalue],
    keep: list[int],
    names: list[tuple[str, int]],
) -> Array:
    """Return the states of the kept modes at all nodes; rigid modes at omega^2 = 0 are known.

    Where end forces follow, pairs may be complex, and so are all states then; modes that coincide
    have one shape there.
    """
    values = np.array([eigenvalues[k].value for k in keep])
    states = np.zeros((len(chain.length) + 1, len(keep), chain.law.size), values.dtype)
    free = [c for c, k in enumerate(keep) if eigenvalues[k].omega2 != 0.0 or names[k][1] > 0]
    for c in set(range(len(keep))) - set(free):
        states[:, c] = rigid_state(beam, chain, names[keep[c]][0])
    if free and chain.follows:
        states[:, free] = solver.mode_states(chain, values[free], np.ones(len(free), np.int64))
    elif free:
        omega2 = values[free]
        brackets = [eigenvalues[keep[c]].bracket for c in free]
        clusters = np.array([brackets.count(bracket) for bracket in brackets])
        found = solver.mode_states(chain, omega2, clusters)
        states[:, free] = part(solver, chain, omega2, found)
    return states


def on_grid(chain: Chain, states: Array, omega2: Array, grid: Array) -> Array:
    """Return the states at grid positions; a doubled position has its left side first."""
    nodes = chain.nodes
    node = np.searchsorted((nodes[1:] + nodes[:-1]) / 2, grid)  # the nearest one
    values = states[node].copy()
    left = np.flatnonzero(grid[1:] == grid[:-1])
    if len(left):
        before = node[left] - 1
        values[left] = propagate(chain, states[before], omega2, chain.length[before], before)
    return np.asarray(values)


def largest_displacements(chain: Chain, states: Array, omega2: Array) -> Array:
    """Return the largest displacement anywhere, at nodes or between them, shape (modes,).

    Cubics through displacements and slopes of nodes tell where the highest peaks are; exact
    states there, at places that secants of the slope improve, tell their height.
    """
    ends = _left_sides(chain, states, omega2)
    largest = np.maximum(*(np.max(np.abs(z[..., 0]), axis=0) for z in (states, ends)))
    if not np.isfinite(states).all():
        return np.asarray(largest)
    place, height = _cubic_peaks(chain, states[:-1], ends)
    most = min(_PEAKS, len(height))
    highest = np.argpartition(-height, most - 1, axis=0)[:most]
    segment, mode = highest.ravel(), np.tile(np.arange(len(omega2)), most)
    scale, stiffness = chain.units(omega2)
    units = Units(scale[mode], stiffness)
    peaks = _Peaks(chain, segment, states[segment, mode], omega2[mode], units)
    found = peaks.heights(place[segment, mode]).reshape(most, -1)
    return np.asarray(np.maximum(largest, np.max(found, axis=0)))


_PEAKS = 4  # of a mode whose height is computed: the cubics tell them apart
_NEAR = 1e-7  # share of a segment, the square of which no height shows


def _left_sides(chain: Chain, states: Array, omega2: Array) -> Array:
    """Return the states at the right ends of segments: before what sits at the node there."""
    ends = states[1:].copy()
    before = np.array([p.node - 1 for p in chain.points if p.node > 0], dtype=np.int64)
    if len(before):
        ends[before] = propagate(chain, states[before], omega2, chain.length[before], before)
    return ends


def _cubic_peaks(chain: Chain, start: Array, end: Array) -> tuple[Array, Array]:
    """Return where, as a share of each segment, a displacement peaks, and about how high.

    The height is 0 where the slope keeps its sign.
    """
    h = chain.length[:, None]
    columns = {name: values[:, None] for name, values in chain.columns.items()}
    Y, s, t = (
        *(start[..., 0], chain.law.slope(columns, start) * h),
        chain.law.slope(columns, end) * h,
    )
    rise = end[..., 0] - Y
    b, a = 3 * rise - 2 * s - t, s + t - 2 * rise  # Y + s x + b x^2 + a x^3
    turns = s * t < 0
    with np.errstate(all="ignore"):
        root = np.sqrt(np.maximum(b * b - 3 * a * s, 0.0))
        x = -s / (b + np.copysign(root, b))
        other = -(b + np.copysign(root, b)) / (3 * a)
        x = np.where((x > 0) & (x < 1), x, other)
    x = np.where(turns & (x > 0) & (x < 1), x, 0.0)
    return x, np.where(turns, np.abs(Y + x * (s + x * (b + x * a))), 0.0)


class _Peaks(NamedTuple):
    """Peaks of modes between nodes, each of one mode in one segment."""

    chain: Chain
    segment: Integers
    start: Array
    """States of the modes at the left ends of the segments, shape (peaks, s)."""
    omega2: Array
    units: Units

    def heights(self, place: Array) -> Array:
        """Return abs(displacement) at its peaks, near places given as shares of the segments."""
        law, h = self.chain.law, self.chain.length[self.segment]
        columns = {name: v[self.segment] for name, v in self.chain.columns.items()}
        height, before = np.zeros(len(place)), np.zeros(len(place))
        slope = law.slope(columns, self.start)
        for _ in range(3):
            z = self._at(place * h, columns)
            height = np.maximum(height, np.abs(z[:, 0]))
            here = law.slope(columns, z)
            change = here - slope
            step = here * (place - before) / np.where(change == 0, 1.0, change)
            following = np.where(change == 0, place, np.clip(place - step, 0.0, 1.0))
            if np.all(np.abs(following - place) < _NEAR):
                break
            before, slope, place = place, here, following
        return height

    def _at(self, distance: Array, columns: Columns) -> Array:
        """Return the states at a distance into the segments, shape (peaks, s)."""
        law, beside = self.chain.law, {name: values[None] for name, values in columns.items()}
        units = law.state_units(self.units)
        U = law.transfer(distance[None], beside, self.omega2, self.units)[0]
        return np.asarray(np.einsum("pij,pj->pi", U, self.start / units) * units)


def normalising_factors(
    chain: Chain, states: Array, omega2: Array, mass: Array, normalisation: Normalisation
) -> Array:
    """Return the factor for each mode: size as asked, first extremum from the nose positive."""
    displacement = states[..., 0]
    if np.iscomplexobj(states):  # of nodes, and at the instant when it is largest there
        peak = np.argmax(np.abs(displacement), axis=0)
        largest = displacement[peak, np.arange(len(omega2))]
        size = np.sqrt(mass) if normalisation == "mass" else np.abs(largest)
        return np.asarray(np.abs(largest) / largest / size)
    largest = largest_displacements(chain, states, omega2)
    sign = _first_extremum_signs(displacement, largest)
    return np.asarray(sign / (np.sqrt(mass) if normalisation == "mass" else largest))


def _first_extremum_signs(Y: Array, largest: Array) -> Array:
    """Return the sign of the first local maximum of every column of abs(Y), ends included."""
    size = np.abs(Y)
    extreme = size > 1e-3 * largest
    extreme[1:] &= size[1:] >= size[:-1]
    extreme[:-1] &= size[:-1] >= size[1:]
    first = np.argmax(extreme, axis=0)
    return np.where(Y[first, np.arange(Y.shape[1])] >= 0, 1.0, -1.0)


class ModelErrorParts(NamedTuple):
    """What shear and rotary inertia would do to a beam that is solved without them.

    With the shapes of that beam, all three over its modal mass,

        K = int EI Y''^2 + springs,   S = int (EI Y''')^2 / kGA,   R = int rho I Y'^2,

    what bends and what shears give way in series, K becomes K/(1 + S/K), sections turn by
    1/(1 + S/K) of the slope, and what the axial force does, W = K - omega^2, stays:

        omega^2 -> (K - W (1 + S/K)) / (1 + S/K + R).

    Without axial force that is ``f -> f / sqrt(1 + R + S/omega^2)``, and to first order
    ``-(R + S/omega^2)/2`` of f with it too. A pinned uniform beam buckles by it at
    ``P_E/(1 + P_E/kGA)`` (Engesser), whatever R is; its frequencies are exact but for a term in
    S R.

    kGA is the beam's own column, or EA/(4 + 3 nu) with nu = 0.3, that of a thin-walled tube
    (Cowper, J. Appl. Mech. 33 (1966) 335): kappa = 0.53. Solid sections have 0.85 to 0.89. rho I
    is the beam's column, or m r^2 with the radius of gyration, or with sqrt(EI/EA).
    """

    rotary: Array
    """R [-]"""
    shear: Array
    """S [rad^2/s^2]"""
    strain: Array
    """K [rad^2/s^2]"""

    def ratio(self, omega2: Numbers) -> Numbers:
        """Return omega^2 with shear and rotary inertia over omega^2; below 0 past buckling."""
        with np.errstate(all="ignore"):
            bent = np.real(self.strain) > 0
            series = 1 + np.where(bent, self.shear / np.where(bent, self.strain, 1.0), 0.0)
            return np.asarray((series - self.shear / omega2) / (series + self.rotary))

    def effect(self, omega2: Array) -> Array:
        """Return the relative effect on the frequencies; NaN where a mode does not vibrate.

        -1 where no frequency is left: the mode is past buckling with shear.
        """
        with np.errstate(all="ignore"):
            effect = np.sqrt(np.maximum(self.ratio(omega2), 0.0)) - 1
        return np.asarray(np.where(omega2 > 0, effect, np.nan))


def can_estimate(beam: Beam, family: FamilyName) -> bool:
    """Tell whether there is something to estimate in a family, and the columns to do it with."""
    known = beam.axial_stiffness is not None or beam.shear_stiffness is not None
    return FAMILIES[family].rotary and known and not beam.has_shear


def model_error_parts(beam: Beam, chain: Chain, energies: Energies) -> ModelErrorParts:
    """Return the share of every segment in R, S and K, shape (n, modes)."""
    EI, kGA, rotary = _columns(beam, chain)
    squares = energies.squares
    parts = (
        rotary[:, None] * squares.turn,
        squares.shear / kGA[:, None],
        squares.moment / EI[:, None],
    )
    return ModelErrorParts(*(part / energies.mass for part in parts))


def _columns(beam: Beam, chain: Chain) -> tuple[Array, Array, Array]:
    """Return EI, kGA and what of rho I is left out, of every segment."""
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2 + beam.x[0]
    k: Integers = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    t = (middle - beam.x[k]) / np.diff(beam.x)[k]
    EI, mass = chain.stiffness, beam.column_at("mass_per_length", k, t)
    EA = None if beam.axial_stiffness is None else beam.column_at("axial_stiffness", k, t)
    if beam.shear_stiffness is not None and not beam.is_timoshenko:
        kGA = beam.column_at("shear_stiffness", k, t)
    else:
        kGA = np.full(len(k), np.inf) if EA is None else EA / THIN_TUBE
    if beam.is_timoshenko:
        rotary = np.zeros(len(k))
    elif beam.rotary_inertia_per_length is not None:
        rotary = beam.column_at("rotary_inertia_per_length", k, t)
    elif beam.radius_of_gyration is not None:
        rotary = mass * beam.column_at("radius_of_gyration", k, t) ** 2
    else:
        rotary = np.zeros(len(k)) if EA is None else mass * EI / EA
    return EI, kGA, rotary


def model_error_sums(beam: Beam, chain: Chain, energies: Energies) -> ModelErrorParts:
    """Return R, S and K of whole modes, shape (modes,), springs and joints among K."""
    by_segment = model_error_parts(beam, chain, energies)
    rotary, shear, strain = (part.sum(axis=0) for part in by_segment)
    if chain.points and not chain.follows:
        work = chain.columns["axial_force"] @ energies.squares.turn
        strain = (energies.stiffness + work) / energies.mass
    return ModelErrorParts(rotary, shear, strain)


def estimate_model_errors(
    beam: Beam, chain: Chain, omega2: Array, energies: Energies
) -> list[float | None]:
    """Return the estimated effect of rotary inertia and shear on each frequency, relative."""
    if not can_estimate(beam, chain.family):
        return [None] * len(omega2)
    sums = model_error_sums(beam, chain, energies)
    vibrates = np.imag(omega2) == 0  # one that flutters is no estimate of one frequency
    real = ModelErrorParts(*(np.real(part) for part in sums))
    effect = np.where(vibrates, real.effect(np.real(omega2)), np.nan)
    return [None if np.isnan(e) else e for e in effect.tolist()]
