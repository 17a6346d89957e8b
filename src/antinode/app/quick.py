"""Bending frequencies and shapes fast enough for a moving slider: some milliseconds.

Frequencies are the compiled ones, to 1e-4; shapes are those of one chain at these frequencies.
Modes that coincide go through `solve_modes` instead.
"""

from __future__ import annotations

import threading
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.modes.backends import choose
from antinode.modes.frequencies import natural_frequencies
from antinode.modes.solve import solve_modes

QUICK_FAMILY = BENDING
"""The only family that is solved at once; the others come with the full solve."""
TOLERANCE = 1e-4
_POINTS = 121
_REFINEMENT = 2  # of the chain whose shapes are shown
_PARTED = 1e-6  # relative distance of omega^2 below which shapes need `solve_modes`


class Quick(NamedTuple):
    """Bending modes 1, 2, ... of a beam.

    Attributes
    ----------
    omega2 : array, shape (modes,)
        [rad^2/s^2].
    error : array, shape (modes,)
        Of omega2, estimated.
    x : array, shape (points,)
        [m].
    states : array, shape (points, modes, 4)
        Y, theta, M, Q_y; the largest Y is 1.
    """

    omega2: Array
    error: Array
    x: Array
    states: Array


def warm_up() -> None:
    """Load the compiled code in the background, before the first page asks for it."""
    threading.Thread(target=choose, name="antinode-kernel", daemon=True).start()


def quick_omega2(beam: Beam, modes: int) -> Array:
    """Return omega^2 of the first bending modes, for a curve."""
    return natural_frequencies(beam, modes, tolerance=TOLERANCE).omega2


def quick_modes(beam: Beam, modes: int) -> Quick:
    """Return the first bending modes of a beam.

    Raises
    ------
    ComputationError
        If they cannot be computed.
    """
    found = natural_frequencies(beam, modes, tolerance=TOLERANCE)
    if np.any(np.diff(found.omega2) <= _PARTED * np.abs(found.omega2[1:])):
        return _full_modes(beam, modes)
    chain = beam.chain(QUICK_FAMILY, _REFINEMENT).cut_at(np.linspace(0.0, beam.length, _POINTS))
    with np.errstate(all="ignore"):
        states = choose().mode_states(chain, found.omega2, np.ones(modes, dtype=np.int64))
    return Quick(found.omega2, found.error_omega2, beam.x[0] + chain.nodes, _scaled(states))


def _full_modes(beam: Beam, modes: int) -> Quick:
    result = solve_modes(beam, modes, tolerance=TOLERANCE, families=[QUICK_FAMILY], damping="none")
    found = [mode for mode in result.modes if mode.number][:modes]
    states = np.stack([mode.states for mode in found], axis=1)
    error = np.array([mode.error_omega2 for mode in found])
    return Quick(np.array([mode.omega2 for mode in found]), error, result.x, states)


def _scaled(states: Array) -> Array:
    """Scale shapes to a largest Y of 1, their first extremum positive."""
    Y = states[..., 0]
    largest = np.max(np.abs(Y), axis=0)
    signs = [_first_extremum(column / size) for column, size in zip(Y.T, largest, strict=True)]
    return np.asarray(states / (np.array(signs) * largest)[:, None])


def _first_extremum(y: Array) -> float:
    size = np.abs(y)
    rises = np.concatenate([[True], size[1:] >= size[:-1]])
    falls = np.concatenate([size[:-1] >= size[1:], [True]])
    return float(np.sign(y[np.flatnonzero(rises & falls & (size > 1e-3))[0]]))
