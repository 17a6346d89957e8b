"""Modes that nearly coincide: shapes made orthogonal where each alone is a mixture of neighbours.

A shape at an eigenvalue that is known to a relative e mixes in a neighbour at the relative distance
d by e/d. Within a group of near modes Rayleigh and Ritz part them: the quadratic forms of mass and
stiffness, taken in the span of their shapes, are made diagonal. The states keep to the equations,
for mixtures of solutions whose omega^2 all but agree are solutions.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.riccati.chain import Chain

from .backends import Backend

_NEAR = 1e-3  # relative distance of omega^2 up to which shapes are parted
_ALIKE = 1e-2  # least eigenvalue of the normalised mass form: below, shapes are nearly the same


def part(backend: Backend, chain: Chain, omega2: Array, states: Array) -> Array:
    """Return the states of modes, those of near ones parted; rows of NaN stay what they are.

    Parameters
    ----------
    omega2 : array, shape (k,)
        Ascending [rad^2/s^2].
    states : array, shape (n + 1, k, s)
    """
    if are_apart(omega2.tolist()):
        return states
    groups = [group for group in near_groups(omega2) if len(group) > 1]
    if not groups:
        return states
    known = np.asarray(np.isfinite(states).all(axis=(0, 2)))
    states = states.copy()
    for group in groups:
        if known[group].all():
            mean = float(np.mean(omega2[group]))
            parted = _ritz(backend, chain, mean, states[:, group])
            if parted is None:  # nearly the same: as a cluster they are told apart
                same = np.full(len(group), mean), np.full(len(group), len(group))
                states[:, group] = backend.mode_states(chain, *same)
                parted = _ritz(backend, chain, mean, states[:, group])
            if parted is not None:
                states[:, group] = parted
    return states


def are_apart(omega2: list[float]) -> bool:
    """Tell whether ascending omega^2 are so far apart that each has its shape by itself."""
    return all(b - a > _NEAR * abs(b) for a, b in pairwise(omega2))


def near_groups(omega2: Array) -> list[Array]:
    """Return the numbers of modes in groups of near neighbours; zeros are by themselves."""
    gap = np.diff(omega2)
    apart = (gap > _NEAR * np.abs(omega2[1:])) | (omega2[1:] == 0.0) | (omega2[:-1] == 0.0)
    return np.split(np.arange(len(omega2)), np.flatnonzero(apart) + 1)


def _ritz(backend: Backend, chain: Chain, omega2: float, states: Array) -> Array | None:
    """Return the mixtures that make mass and stiffness diagonal; None if shapes depend."""
    own = backend.mode_energies(chain, states, np.full(states.shape[1], omega2))
    states = states / np.sqrt(own.mass)[:, None]
    mass, stiffness = _forms(backend, chain, omega2, states)
    size, axes = np.linalg.eigh(mass)
    if not size[0] > _ALIKE:
        return None
    whiten = axes / np.sqrt(size)
    _, mix = np.linalg.eigh(whiten.T @ stiffness @ whiten)
    return np.asarray(np.einsum("nks,kj->njs", states, whiten @ mix))


def _forms(backend: Backend, chain: Chain, omega2: float, states: Array) -> tuple[Array, Array]:
    """Return the forms of mass and of stiffness in the span of states: by those of their sums."""
    k = states.shape[1]
    i, j = np.triu_indices(k)
    sums = states[:, i] + states[:, j]
    found = backend.mode_energies(chain, sums, np.full(len(i), omega2))
    mass, stiffness = np.zeros((k, k)), np.zeros((k, k))
    for form, values in ((mass, found.mass), (stiffness, found.stiffness)):
        form[i, j] = values
        own = np.diag(form) / 4
        form[i, j] = (values - own[i] - own[j]) / 2
        form[j, i] = form[i, j]
    return mass, stiffness
