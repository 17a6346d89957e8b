"""Rigid modes: which the supports leave, which are at zero, which are none, and their shapes.

They are set aside by their index among the eigenvalues, never because they look small. Translation
has omega^2 = 0 exactly, and so has rotation without axial force; an axial force moves rotation to
where it is the lowest eigenvalue beside the translation.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import PointMass
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.families import BENDING, FAMILIES, FamilyName
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
        return int("translation" in rigid) + int(turns_freely(beam, name))
    return len(rigid)


def turns_freely(beam: Beam, name: FamilyName) -> bool:
    """Tell whether nothing turns a loaded free body back: omega^2 = 0 is a double root then.

    So it is where all forces of a body turn with it, both those at its ends and none other: what
    the section carries, N(x), is then nothing but the inertia of what it pushes. Such a rotation is
    no eigenvector: it accelerates the body sideways.
    """
    if not any(beam.following(name)) or len(beam.freedoms(name)) < 2:
        return False
    (left, right), outside = beam.following(name), beam.end_forces
    push = (right - left) / beam.mass
    k, share = (
        np.repeat(np.arange(len(beam.x) - 1), len(_SHARES)),
        np.tile(_SHARES, len(beam.x) - 1),
    )
    N = beam.axial_force_at(k, share)
    own = left + push * beam.mass_left_of(k, share)
    size = _ROUNDING * float(np.max(np.abs(N)))
    ends = max(abs(left - outside[0]), abs(right - outside[1]))
    through_centres = beam.offset_weight or not any(
        isinstance(item, PointMass) and item.offset for item in beam.attachments
    )
    return bool(max(float(np.max(np.abs(N - own))), ends) <= size and through_centres)


def rigid_rotation(chain: Chain, pivot: float | None = None) -> float:
    """Return omega^2 of the rotation of a chain if it did not bend [rad^2/s^2].

    The axial force turns it on, what follows at the ends turns it back:
    ``J omega^2 = -int N dx + kappa_right (L - x_p) + kappa_left x_p`` about the pivot x_p, which is
    the centre of mass where nothing holds the chain.
    """
    nodes = chain.nodes
    about = centre_of_mass(chain) if pivot is None else pivot
    left, right = chain.following
    turning = -float(chain.axial_force @ chain.length) + right * (nodes[-1] - about) + left * about
    return float(turning) / rotary_inertia(chain, about)


def rotary_inertia(chain: Chain, about: float) -> float:
    """Return the moment of inertia of a chain about a place [kg m^2]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    inertia = dm @ ((middle - about) ** 2 + chain.length**2 / 12)
    for p in chain.points:
        inertia += p.mass * (nodes[p.node] + p.offset - about) ** 2 + p.inertia
    return float(inertia)


def pivot_of(beam: Beam) -> float | None:
    """Return where a beam that may turn, and not move, is held [m from its left end]."""
    freedoms = beam.freedoms(BENDING)
    return float(-freedoms[0, 0] / freedoms[0, 1]) if len(freedoms) == 1 else None


def nearest_to_rotation(
    found: Sequence[Eigenvalue], chain: Chain, pivot: float | None = None
) -> int:
    """Return which eigenvalue, of those not exactly zero, is the rotation where ends follow."""
    expected = rigid_rotation(chain, pivot)
    rest = [k for k, value in enumerate(found) if value.omega2 != 0.0]
    return min(rest, key=lambda k: abs(found[k].value - expected))


_SHARES = np.array([0.0, 0.25, 0.5, 1.0])
_ROUNDING = 1e-12  # of the largest N


def rigid_state(beam: Beam, chain: Chain, name: str) -> Array:
    """Return the state of a rigid mode at omega^2 = 0, shape (nodes, s)."""
    state = np.zeros((len(chain.length) + 1, chain.law.size))
    if name == f"rigid {FAMILIES[chain.law.name].rigid[0]}":
        state[:, 0] = 1.0
        return state
    freedoms = beam.freedoms(chain.law.name)
    held = len(freedoms) == 1
    pivot = -freedoms[0, 0] / freedoms[0, 1] if held else centre_of_mass(chain)
    state[:, 0], state[:, 1] = chain.nodes - pivot, 1.0
    return state


def centre_of_mass(chain: Chain) -> float:
    """Return the centre of all mass of a chain, from its left end [m]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    masses = np.array([p.mass for p in chain.points])
    places = np.array([nodes[p.node] + p.offset for p in chain.points])
    return float((dm @ middle + masses @ places) / (np.sum(dm) + np.sum(masses)))


def elastic(
    found: Sequence[Eigenvalue], rigid: int, chain: Chain | None = None
) -> list[Eigenvalue]:
    """Return the eigenvalues without the rigid ones: zeros, and the lowest that N moved off zero.

    Past buckling elastic modes lie below the translation. Of a `chain` whose end forces follow the
    one next to a rigid body's rotation is set aside.
    """
    others = [value for value in found if value.omega2 != 0.0]
    if chain is not None and chain.follows and rigid > len(found) - len(others):
        held = rigid == 1
        pivot = (chain.nodes[-1] if chain.right == "pinned" else 0.0) if held else None
        others.remove(found[nearest_to_rotation(found, chain, pivot)])
        return others
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
