"""Rigid modes: which the supports leave, which are at zero, which are none, and their shapes.

They are set aside by their index among the eigenvalues, never because they look small. Translation
has omega^2 = 0 exactly, and so has rotation without axial force; an axial force moves rotation to
where it is the lowest eigenvalue beside the translation, unless all of it turns with the body.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.attachments import Pedestal, PointMass
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.families import BENDING, FAMILIES, FamilyName
from antinode.beam.loads.turning import turning_load, turning_load_left
from antinode.riccati.chain import Chain
from antinode.riccati.points import Point

_SHARES = np.array([0.0, 0.25, 0.5, 1.0])
_ROUNDING = 1e-12  # of the largest N
_NEAR = 1e-9  # of the length, of places that are one


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
    """Tell whether nothing turns back a loaded body that may turn: omega^2 = 0 is exact then.

    So it is where all forces of a body turn with it, both those at its ends and none other: what
    the section of a free body carries, N(x), is then nothing but the inertia of what it pushes.
    Such a rotation is no eigenvector: it accelerates the body sideways, and zero is a double root.

    A body that is held at one place does not: what pushes it there goes into what holds it. With
    M = 0 and psi = 1 all along, ``Q = N`` does not change between the place and an end where it is
    what turns with that end: the rotation is an eigenvector, and zero a single root.
    """
    freedoms = beam.freedoms(name)
    turning = len(freedoms) == 2 or (len(freedoms) == 1 and not _is_translation(freedoms[0], beam))
    if not (any(beam.following(name)) or beam.loads_turn) or not turning:
        return False
    own = _carried_freely(beam, name) if len(freedoms) == 2 else _carried_about_pivot(beam, name)
    if own is None:
        return False
    N = beam.axial_force_at(*_places(beam))
    through_centres = beam.offset_weight or not any(
        isinstance(item, PointMass) and item.offset for item in beam.attachments
    )
    off = float(np.max(np.abs(N - own)))
    hung = any(isinstance(item, Pedestal) for item in beam.attachments)
    return (
        not hung
        and off <= _ROUNDING * max(float(np.max(np.abs(N))), _turning_size(beam))
        and through_centres
    )


def _turning_size(beam: Beam) -> float:
    """Return the size of the loads along a beam that turn with it [N]."""
    load = beam.tangential_load
    return 0.0 if load is None else float(np.max(np.abs(load))) * beam.length


def _places(beam: Beam) -> tuple[Integers, Array]:
    """Return places in all intervals: the numbers of these, and shares of their lengths."""
    last = len(beam.x) - 1
    return np.repeat(np.arange(last), len(_SHARES)), np.tile(_SHARES, last)


def _carried_freely(beam: Beam, name: FamilyName) -> Array | None:
    """Return N of a free body which carries its inertia alone, None where ends do not follow."""
    (left, right), outside = beam.following(name), beam.end_forces
    size = max(*map(abs, outside), _turning_size(beam))
    if max(abs(left - outside[0]), abs(right - outside[1])) > _ROUNDING * size:
        return None
    k, share = _places(beam)
    load, total = turning_load_left(beam, k, share), turning_load(beam)
    carried = (right - left - total) / beam.mass * beam.mass_left_of(k, share)
    return np.asarray(left + load + carried)


def _carried_about_pivot(beam: Beam, name: FamilyName) -> Array | None:
    """Return the N of a body that turns about a place, on either side what follows at the end.

    What is there takes the difference; None where it cannot without a moment.
    """
    (left, right), (held_left, held_right, points) = beam.following(name), beam.points(name)
    if held_left != "free":
        left = right
    if held_right != "free":
        right = left
    pivot, nodes = pivot_of(beam) or 0.0, beam.x - beam.x[0]
    k, share = _places(beam)
    load = turning_load_left(beam, k, share)
    left_N, right_N = left + load, right + load - turning_load(beam)
    if (left != right or beam.loads_turn) and _node_at(pivot, nodes, points) is None:
        return None
    return np.where(nodes[k + 1] <= pivot + _NEAR * beam.length, left_N, right_N)


def _node_at(pivot: float, nodes: Array, points: Sequence[Point]) -> Point | None:
    """Return what holds a beam at a node, not on an arm."""
    for point in points:
        near = abs(nodes[point.node] - pivot) < _NEAR * nodes[-1]
        if near and (point.static_spring or 0 in point.holds) and not point.coupling:
            return point
    return None


def rigid_rotation(chain: Chain, pivot: float | None = None) -> float:
    """Return omega^2 of the rotation of a chain if it did not bend [rad^2/s^2].

    The axial force turns it on, what follows at the ends turns it back:
    ``J omega^2 = -int N dx + kappa_right (L - x_p) + kappa_left x_p`` about the pivot x_p, which is
    the centre of mass where nothing holds the chain; loads along the axis that turn with the
    section take ``int t (x - x_p) dx`` from it.
    """
    nodes = chain.nodes
    about = centre_of_mass(chain) if pivot is None else pivot
    left, right = chain.following
    load = chain.columns.get("tangential", np.zeros(1)) * chain.length
    own = float(load @ (nodes[1:] + nodes[:-1] - 2 * about)) / 2
    turning = (
        -own - float(chain.axial_force @ chain.length) + right * (nodes[-1] - about) + left * about
    )
    return float(turning) / rotary_inertia(chain, about)


def rotary_inertia(chain: Chain, about: float) -> float:
    """Return the moment of inertia of a chain about a place [kg m^2]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    inertia = dm @ ((middle - about) ** 2 + chain.length**2 / 12)
    for p in chain.points:
        inertia += p.mass * (nodes[p.node] + p.offset - about) ** 2 + p.inertia
        inertia += p.hung * (nodes[p.node] - about) ** 2
    return float(inertia)


def pivot_of(beam: Beam) -> float | None:
    """Return where a beam that may turn, and not move, is held [m from its left end]."""
    freedoms = beam.freedoms(BENDING)
    return float(-freedoms[0, 0] / freedoms[0, 1]) if len(freedoms) == 1 else None


def rigid_motion(beam: Beam, chain: Chain, name: str) -> tuple[float, float]:
    """Return a and b of a rigid mode at omega^2 = 0: ``a + b x``, x from the left end."""
    if name == f"rigid {FAMILIES[chain.law.name].rigid[0]}":
        return 1.0, 0.0
    freedoms = beam.freedoms(chain.law.name)
    if len(freedoms) == 2:
        return -centre_of_mass(chain), 1.0
    pivot = float(-freedoms[0, 0] / freedoms[0, 1])
    holding = _node_at(pivot, chain.nodes, chain.points)
    if holding is not None and not holding.holds:  # a spring gives way to what it takes
        left, right = chain.following
        pivot += (right - left) / holding.static_spring
    return -pivot, 1.0


def rigid_state(beam: Beam, chain: Chain, name: str) -> Array:
    """Return the state of a rigid mode at omega^2 = 0, shape (nodes, s)."""
    state = np.zeros((len(chain.length) + 1, chain.law.size))
    a, b = rigid_motion(beam, chain, name)
    state[:, 0] = a + b * chain.nodes
    if b:
        state[:, 1] = b
        if chain.follows and len(beam.freedoms(chain.law.name)) == 1:
            state[:, 3] = np.append(chain.axial_force, chain.axial_force[-1])
    return state


def centre_of_mass(chain: Chain) -> float:
    """Return the centre of all mass of a chain, from its left end [m]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    masses = np.array([m for p in chain.points for m in (p.mass, p.hung)])
    places = np.array([x for p in chain.points for x in (nodes[p.node] + p.offset, nodes[p.node])])
    return float((dm @ middle + masses @ places) / (np.sum(dm) + np.sum(masses)))


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
