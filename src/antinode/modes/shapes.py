"""Shapes of modes on the output grid: named, normalised, with what follows from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES
from antinode.riccati.chain import Chain
from antinode.riccati.roots import Eigenvalue
from antinode.riccati.shapes import Energies, propagate

from .backends import Backend
from .clusters import part
from .result import Normalisation
from .rigid import rigid_state


def output_grid(beam: Beam, modes: int) -> Array:
    """Return breakpoints and points between, dense enough for smooth shapes [m]."""
    spacing = beam.length / max(200, 20 * (modes + 2))
    h = np.diff(beam.x)
    pieces = np.ceil(h / spacing).astype(int)
    k = np.repeat(np.arange(len(pieces)), pieces)
    number = np.arange(len(k)) - (np.cumsum(pieces) - pieces)[k]
    points = beam.x[k] + number * (h / pieces)[k]
    inner = [item.x for item in beam.attachments if beam.x[0] < item.x < beam.x[-1]]
    doubled = sorted({int(np.argmin(np.abs(beam.x - x))) for x in inner})
    return np.sort(np.concatenate([points, beam.x[-1:], beam.x[doubled]]))


def shapes(
    solver: Backend,
    beam: Beam,
    chain: Chain,
    eigenvalues: list[Eigenvalue],
    keep: list[int],
    names: list[tuple[str, int]],
) -> Array:
    """Return the states of the kept modes at all nodes; rigid modes at omega^2 = 0 are known."""
    states = np.zeros((len(chain.length) + 1, len(keep), chain.law.size))
    free = [c for c, k in enumerate(keep) if eigenvalues[k].omega2 != 0.0 or names[k][1] > 0]
    for c in set(range(len(keep))) - set(free):
        states[:, c] = rigid_state(beam, chain, names[keep[c]][0])
    if free:
        omega2 = np.array([eigenvalues[keep[c]].omega2 for c in free])
        clusters = np.array(
            [
                sum(eigenvalues[keep[o]].bracket == eigenvalues[keep[c]].bracket for o in free)
                for c in free
            ]
        )
        found = solver.mode_states(chain, omega2, clusters)
        states[:, free] = part(solver, chain, omega2, found)
    return states


def on_grid(chain: Chain, states: Array, omega2: Array, grid: Array) -> Array:
    """Return the states at grid positions; a doubled position has its left side first."""
    nodes = chain.nodes
    node = np.clip(np.searchsorted(nodes, grid - 1e-9 * nodes[-1]), 0, len(nodes) - 1)
    values = states[node].copy()
    left = np.flatnonzero(np.diff(grid, append=np.inf) == 0.0)
    if len(left):
        before = node[left] - 1
        values[left] = propagate(chain, states[before], omega2, chain.length[before], before)
    return np.asarray(values)


def normalising_factors(states: Array, mass: Array, normalisation: Normalisation) -> Array:
    """Return the factor for each mode: size as asked, first extremum from the nose positive."""
    displacement = states[..., 0]
    largest = np.max(np.abs(displacement), axis=0)
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
    """What a beam without shear and rotary inertia leaves out, to first order.

    The relative effect on a frequency is ``-(rotary + shear / omega^2) / 2``.
    """

    rotary: Array
    """int m r^2 theta^2 / int m Y^2 [-]"""
    shear: Array
    """int M'^2/(kGA) / int m Y^2 [rad^2/s^2]"""

    def effect(self, omega2: Array) -> Array:
        """Return the relative effect on the frequencies; NaN where a mode does not vibrate."""
        with np.errstate(all="ignore"):
            effect = -(self.rotary + self.shear / omega2) / 2
        return np.asarray(np.where(omega2 > 0, effect, np.nan))


def model_error_parts(beam: Beam, chain: Chain, energies: Energies) -> ModelErrorParts:
    """Return the share of every segment in both parts, shape (n, modes), of a beam with EA.

    The shear stiffness is that of a thin-walled tube, kGA = EA / (4 (1 + nu)) with nu = 0.3; the
    radius of gyration is the beam's, or sqrt(EI/EA).
    """
    assert beam.axial_stiffness is not None
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2 + beam.x[0]
    k = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    t = (middle - beam.x[k]) / np.diff(beam.x)[k]
    EA = beam.at(beam.axial_stiffness, k, t)
    if beam.radius_of_gyration is not None:
        r2 = beam.column_at("radius_of_gyration", k, t) ** 2
    else:
        r2 = chain.stiffness / EA
    kGA = EA / (4 * 1.3)
    rotary = (chain.mass * r2)[:, None] * energies.squares.slope
    shear = energies.squares.shear / kGA[:, None]
    return ModelErrorParts(rotary / energies.mass, shear / energies.mass)


def estimate_model_errors(
    beam: Beam, chain: Chain, omega2: Array, energies: Energies
) -> list[float | None]:
    """Return the first-order effect of rotary inertia and shear on each frequency, relative."""
    if not FAMILIES[chain.family].rotary or beam.axial_stiffness is None:
        return [None] * len(omega2)
    by_segment = model_error_parts(beam, chain, energies)
    parts = ModelErrorParts(*(part.sum(axis=0) for part in by_segment))
    return [None if np.isnan(e) else e for e in parts.effect(omega2).tolist()]
