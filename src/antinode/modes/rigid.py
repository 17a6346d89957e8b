"""Rigid modes: which the supports leave, which are at zero, which are none, and their shapes.

They are set aside by their index among the eigenvalues, never because they look small. Translation
has omega^2 = 0 exactly, and so has rotation without axial force; an axial force moves rotation to
where it is the lowest eigenvalue beside the translation.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.families import FAMILIES, FamilyName
from antinode.riccati.chain import Chain
from antinode.riccati.roots import Eigenvalue


def rigid_modes(beam: Beam, name: FamilyName) -> tuple[str, ...]:
    """Return the names of the rigid modes that the supports leave, e.g. translation, rotation."""
    rigid, freedoms = FAMILIES[name].rigid, beam.freedoms(name)
    if len(freedoms) == 2:
        return rigid
    return tuple(rigid[0 if _is_translation(row, beam) else 1] for row in freedoms)


def _is_translation(freedom: Array, beam: Beam) -> bool:
    return bool(abs(freedom[1]) * beam.length < 1e-9 * abs(freedom[0]))


def exact_zeros(beam: Beam, name: FamilyName) -> int:
    """Return how many rigid modes have omega^2 = 0 exactly: translation, and all without N."""
    rigid = rigid_modes(beam, name)
    if FAMILIES[name].law.has_axial_force and not beam.is_unloaded:
        return int("translation" in rigid)
    return len(rigid)


def rigid_state(beam: Beam, chain: Chain, name: str) -> Array:
    """Return the state of a rigid mode at omega^2 = 0, shape (nodes, s)."""
    state = np.zeros((len(chain.length) + 1, chain.law.size))
    if name == f"rigid {FAMILIES[chain.law.name].rigid[0]}":
        state[:, 0] = 1.0
        return state
    freedoms = beam.freedoms(chain.law.name)
    held = len(freedoms) == 1
    pivot = -freedoms[0, 0] / freedoms[0, 1] if held else _centre_of_mass(chain)
    state[:, 0], state[:, 1] = chain.nodes - pivot, 1.0
    return state


def _centre_of_mass(chain: Chain) -> float:
    """Return the centre of all mass of a chain, from its left end [m]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    masses = np.array([p.mass for p in chain.points])
    places = np.array([nodes[p.node] + p.offset for p in chain.points])
    return float((dm @ middle + masses @ places) / (np.sum(dm) + np.sum(masses)))


def elastic(found: Sequence[Eigenvalue], rigid: int) -> list[Eigenvalue]:
    """Return the eigenvalues without the rigid ones: zeros, and the lowest that N moved off zero.

    Past buckling elastic modes lie below the translation.
    """
    others = [value for value in found if value.omega2 != 0.0]
    return others[rigid - (len(found) - len(others)) :]


def translates(ends: Ends, name: FamilyName) -> bool:
    """Tell whether the ends leave the family's first displacement free, as translation is."""
    return not any(0 in held for held in _held(ends, name))


def zeros_of(ends: Ends, chain: Chain) -> int:
    """Return how many rigid modes of a chain held at its ends alone have omega^2 = 0 exactly."""
    if chain.law.has_axial_force and np.any(chain.axial_force):
        return int(translates(ends, chain.family))
    return rigid_modes_of(ends, chain.family)


def rigid_modes_of(ends: Ends, name: FamilyName) -> int:
    """Return how many rigid modes of a family the ends leave: the index of the last one.

    Either end that holds the displacement takes one, and so do both together that hold its slope.
    """
    held = _held(ends, name)
    taken = sum(0 in end for end in held) + any(1 in end for end in held)
    return max(len(FAMILIES[name].rigid) - taken, 0)


def _held(ends: Ends, name: FamilyName) -> list[tuple[int, ...]]:
    """Return the displacements that either end holds."""
    return [FAMILIES[name].law.ends[end] for end in ends.of(name)]
