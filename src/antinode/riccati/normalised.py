"""Modes as they are given out: scaled, signed, with their forms, at places along the chain.

The largest displacement, or the modal mass, becomes one; the first extremum from the left is
positive. Between nodes displacements are cubics first, and exact states where these are highest.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .arrays import Array, Integers
from .chain import Chain
from .laws import Columns, Units
from .shapes import Energies, energies_between, mode_energies, mode_states, propagate

_PEAKS = 4  # of a mode whose height is computed: the cubics tell them apart
_NEAR = 1e-7  # share of a segment, the square of which no height shows


class Wanted(NamedTuple):
    """What modes are to be given out as."""

    places: Array
    """Ascending, from the left end [m]; a doubled one has its left side first."""
    beside: Array
    """rho I [kg m] and 1/kGA [1/N] that the columns leave out, shape (2, n)."""
    by_mass: bool
    """Whether the modal mass is one, or else the largest displacement."""


class Forms(NamedTuple):
    """Quadratic forms of modes, shape (modes,), as `riccati.shapes.Energies` has the first three.

    The others are integrals of what a chain leaves out: of rho I psi^2 and of V^2/kGA; beside
    them the strain, of M^2/EI, and with points all that is not work of the axial force.
    """

    mass: Array
    stiffness: Array
    size: Array
    rotary: Array
    shear: Array
    strain: Array


class Normalised(NamedTuple):
    """Modes as they are given out."""

    states: Array
    """At the nodes, shape (n + 1, modes, s)."""
    at_places: Array
    """Shape (modes, places, s)."""
    forms: Forms


def normalise(
    chain: Chain, states: Array, omega2: Array, wanted: Wanted, left: Array | None = None
) -> Normalised:
    """Return modes scaled as asked.

    Parameters
    ----------
    states : array, shape (n + 1, k, s)
    omega2 : array, shape (k,)
    left : array, shape (n + 1, k, s), optional
        Left eigenvectors, where an end's force follows: forms are those between both.
    """
    if left is None:
        energies = mode_energies(chain, states, omega2)
    else:
        energies = energies_between(mode_energies, chain, states, left, omega2)
    scale = normalising_factors(chain, states, omega2, np.abs(energies.mass), wanted.by_mass)
    states = states * scale[:, None]
    at_places = states_at(chain, states, omega2, wanted.places)
    return Normalised(states, at_places.swapaxes(0, 1), _forms(chain, energies, wanted, scale))


def normal_modes(
    chain: Chain,
    omega2: Array,
    motions: Array,
    wanted: Wanted,
    states_of: Callable[..., Array] = mode_states,
    scaled: Callable[..., Normalised] = normalise,
) -> Normalised:
    """Return modes that are apart, with states that are known or solved, scaled as asked.

    Parameters
    ----------
    omega2 : array, shape (k,)
        Real; chains whose ends follow have left eigenvectors too, see `normalise`.
    motions : array, shape (k, 2)
        Rigid modes at omega^2 = 0 move as a + b x, x from the left end: a and b; NaN for others.
    states_of, scaled : callable
        `mode_states` and `normalise`, of a backend.

    Returns
    -------
    Normalised
    """
    free = np.isnan(motions[:, 0])
    states = np.zeros((len(chain.length) + 1, len(omega2), chain.law.size))
    a, b = motions.T
    states[..., 0] = a + b * chain.nodes[:, None]
    if chain.law.size > 2:
        states[..., 1] = b
    if free.any():
        states[:, free] = states_of(chain, omega2[free], np.ones(free.sum(), np.int64))
    return scaled(chain, states, omega2, wanted)


def _forms(chain: Chain, energies: Energies, wanted: Wanted, scale: Array) -> Forms:
    squares, (rotary, soft) = energies.squares, wanted.beside
    strain = (1 / chain.stiffness) @ squares.moment
    if chain.points and not chain.follows:
        strain = energies.stiffness + chain.law.forms(chain.columns, squares).work
    sums = *energies[1:], rotary @ squares.turn, soft @ squares.shear, strain
    return Forms(*(value * scale**2 for value in sums))


def states_at(chain: Chain, states: Array, omega2: Array, places: Array) -> Array:
    """Return the states at places; a doubled one has its left side first, (places, k, s).

    Both sides are the same but where something sits.
    """
    nodes = chain.nodes
    node = np.searchsorted((nodes[1:] + nodes[:-1]) / 2, places)  # the nearest one
    values = states[node]
    left = np.flatnonzero(places[1:] == places[:-1])
    left = left[np.isin(node[left], [point.node for point in chain.points])]
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
    chain: Chain, states: Array, omega2: Array, mass: Array, by_mass: bool
) -> Array:
    """Return the factor for each mode: size as asked, first extremum from the nose positive."""
    displacement = states[..., 0]
    if np.iscomplexobj(states):  # of nodes, and at the instant when it is largest there
        peak = np.argmax(np.abs(displacement), axis=0)
        largest = displacement[peak, np.arange(len(omega2))]
        size = np.sqrt(mass) if by_mass else np.abs(largest)
        return np.asarray(np.abs(largest) / largest / size)
    largest = largest_displacements(chain, states, omega2)
    sign = _first_extremum_signs(displacement, largest)
    return np.asarray(sign / (np.sqrt(mass) if by_mass else largest))


def _first_extremum_signs(Y: Array, largest: Array) -> Array:
    """Return the sign of the first local maximum of every column of abs(Y), ends included."""
    size = np.abs(Y)
    extreme = size > 1e-3 * largest
    extreme[1:] &= size[1:] >= size[:-1]
    extreme[:-1] &= size[:-1] >= size[1:]
    first = np.argmax(extreme, axis=0)
    return np.where(Y[first, np.arange(Y.shape[1])] >= 0, 1.0, -1.0)
