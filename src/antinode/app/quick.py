"""Bending frequencies and shapes fast enough for a moving slider: some 10 ms.

Two chains, one with half the steps, are solved by the compiled kernel; their difference bounds the
error, which must be below 1e-4 of each frequency. Beams that the kernel does not know (attachments,
modes that coincide), and all while it is not compiled yet, go through `solve_modes` instead.
"""

from __future__ import annotations

import threading
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.batch import BeamBatch, solve_many
from antinode.beam import Beam
from antinode.modes import solve_modes
from antinode.riccati.chain import Chain
from antinode.riccati.shapes import mode_states

Array = npt.NDArray[np.float64]

TOLERANCE = 1e-4
_POINTS = 121
_SAFETY = 2.5 / 15  # of the change by halving the steps
_PAST_BUCKLING = 6  # index of batch.REASONS: solved, with omega^2 < 0
_ready = threading.Event()


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
    """Have the kernel compiled in the background; until then everything works without it."""
    threading.Thread(target=_warm_up, name="antinode-kernel", daemon=True).start()


def _warm_up() -> None:
    one = np.ones(4)
    solve_many(BeamBatch(one, one, one, modes=1))
    _ready.set()


def wait_until_warm(timeout: float = 120.0) -> bool:
    """Wait for the kernel [s]; tell whether it is there."""
    return _ready.wait(timeout)


def quick_omega2(beam: Beam, modes: int) -> Array:
    """Return omega^2 of the first bending modes, for a curve: the finer chain alone.

    Its error was seen at the place where the page stands, by `quick_modes`.
    """
    fast = _by_kernel(beam, modes, refinements=(2,))
    if fast is not None:
        return fast[0]
    result = solve_modes(beam, modes, tolerance=TOLERANCE, families=["bending"])
    return np.array([mode.omega2 for mode in result.modes if mode.number][:modes])


def quick_modes(beam: Beam, modes: int) -> Quick:
    """Return the first bending modes of a beam.

    Raises
    ------
    ComputationError
        If they cannot be computed.
    """
    fast = _by_kernel(beam, modes)
    if fast is None:
        result = solve_modes(beam, modes, tolerance=TOLERANCE, families=["bending"])
        found = [mode for mode in result.modes if mode.number][:modes]
        states = np.stack([mode.states for mode in found], axis=1)
        error = np.array([mode.error_omega2 for mode in found])
        return Quick(np.array([mode.omega2 for mode in found]), error, result.x, states)
    omega2, error, chain = fast
    chain = chain.cut_at(np.linspace(0.0, beam.length, _POINTS))
    with np.errstate(all="ignore"):
        states = mode_states(chain, omega2, np.ones(modes, dtype=np.int64))
    return Quick(omega2, error, beam.x[0] + chain.nodes, _scaled(states))


def _by_kernel(
    beam: Beam, modes: int, refinements: tuple[int, ...] = (1, 2)
) -> tuple[Array, Array, Chain] | None:
    """Return omega^2, its error and the finest chain; None where the kernel will not do."""
    if not _ready.is_set() or beam.attachments:
        return None
    found = []
    for refinement in refinements:
        chain = beam.chain("bending", refinement)
        arrays = (chain.length, chain.mass, chain.stiffness, chain.axial_force)
        result = solve_many(BeamBatch(*arrays, ends=beam.ends, modes=modes))
        if result.reason[0] not in (0, _PAST_BUCKLING):
            return None
        found.append(result.omega2[0])
    error = np.abs(found[-1] - found[0]) * _SAFETY
    if np.any(error > 2 * TOLERANCE * np.abs(found[-1])):
        return None
    return found[-1], error, chain


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
