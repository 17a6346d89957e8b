"""States of modes, their integrals, and modes normalised, in compiled code: eight side by side."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from antinode.riccati import normalised, shapes
from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import Chain
from antinode.riccati.lanes.laws import FORMS
from antinode.riccati.lanes.library import library
from antinode.riccati.lanes.scratch import scratch
from antinode.riccati.lanes.single import in_si
from antinode.riccati.lanes.workspace import LANES, Asked, Rules
from antinode.riccati.laws import Squares
from antinode.riccati.normalised import Forms, Normalised, Wanted
from antinode.riccati.points import Point
from antinode.riccati.segment import LONGEST_STEP

_HEAVY = 1e3  # m d^2 over that of the beam
_MOST_NODES = 20_000  # whose frames are kept
_NO_PAIR = np.empty((0, 1, 1, 1))


def mode_states(
    chain: Chain, omega2: Array, multiplicity: Integers, *, adjoint: bool = False
) -> Array:
    """Return the states of the modes at every node: `riccati.shapes.mode_states`, compiled.

    Supports between the ends, clusters, modes that flutter and longitudinal ones are left to the
    readable form.
    """
    special = np.iscomplexobj(omega2) or _is_special(chain) or int(multiplicity.max()) > 1
    if not (special or _is_near_a_pole(chain, omega2)):
        found = _states(chain, omega2, adjoint)
        if found is not None:
            return found
        fine = shapes.split_for(chain, omega2)
        found = _states(fine, omega2, adjoint)
        if found is not None:
            return found[shapes.kept_nodes(chain, fine)]
    return shapes.mode_states(chain, omega2, multiplicity, adjoint=adjoint)


def _is_special(chain: Chain) -> bool:
    """Tell whether a chain is of another law, or has points that are left to the readable form."""
    held = any(p.holds or p.feeds_back or _is_heavy(p, chain) for p in chain.points)
    return held or not _is_known(chain)


def _is_near_a_pole(chain: Chain, omega2: Array) -> bool:
    """Tell whether a pedestal all but holds the beam at one of some omega^2."""
    poles = [p.pedestal.pole for p in chain.points if p.pedestal is not None]
    return any(np.min(np.abs(omega2 - pole)) < shapes.NEAR_POLE * pole for pole in poles)


def _is_heavy(point: Point, chain: Chain) -> bool:
    """Tell whether the rotary inertia of a mass off its node may drown in J + m d^2."""
    total, length = float(chain.mass @ chain.length), float(np.sum(chain.length))
    return point.mass * point.offset**2 > _HEAVY * total * length**2


def _is_known(chain: Chain) -> bool:
    return FORMS[chain.law].shapes


def cut(chain: Chain, positions: Array, omega2: Array) -> Chain:
    """Return a chain with joints at positions, fit for states: `riccati.shapes.cut`, compiled."""
    if not _is_known(chain):
        return shapes.cut(chain, positions, omega2)
    n, size = len(chain.length), np.abs(omega2)
    length = np.empty(n + len(positions))
    owner, places = np.empty(len(length), np.int64), np.empty(n + 1, np.int64)
    number, fit, *_ = library("shapes").call(
        "cut", in_si(chain), size, LONGEST_STEP, positions, length, owner, places
    )
    owner = owner[:number]
    columns = {name: values[owner] for name, values in chain.columns.items()}
    points = tuple(replace(p, node=int(places[p.node])) for p in chain.points)
    ends = chain.left, chain.right
    new = Chain(chain.law, length[:number], columns, *ends, points, chain.following)
    return new if fit else shapes.split_for(new, size)


def _states(chain: Chain, omega2: Array, adjoint: bool) -> Array | None:
    """Return the states; None where segments are too long, or too many, for the series."""
    if len(chain.length) > _MOST_NODES:
        return None
    own, parts = in_si(chain), []
    room = scratch.room(len(chain.length))
    for i in range(0, len(omega2), LANES):
        some = np.ascontiguousarray(omega2[i : i + LANES], dtype=float)
        states = np.empty((len(chain.length) + 1, len(some), 4))
        done = library("shapes").call("states", own, some, adjoint, LONGEST_STEP, room, states)
        if not done[0]:
            return None
        parts.append(states)
    return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)


def _rules() -> Rules:
    """Return the rules of Gauss of `riccati.shapes`."""
    limits, numbers = [limit for limit, _ in shapes.RULES], [number for _, number in shapes.RULES]
    most = max(numbers)
    shares, weights = np.zeros((2, len(numbers), most))
    for k, number in enumerate(numbers):
        shares[k, :number], weights[k, :number] = shapes.gauss_points(number)
    return Rules(np.array(limits), np.array(numbers), shares, weights)


_RULES = _rules()


def mode_energies(chain: Chain, states: Array, omega2: Array) -> shapes.Energies:
    """Return modal mass and stiffness of modes: `riccati.shapes.mode_energies`, compiled."""
    if not _is_known(chain) or np.iscomplexobj(states) or len(chain.length) > _MOST_NODES:
        return shapes.mode_energies(chain, states, omega2)
    own, n, parts = in_si(chain), len(chain.length), []
    room = scratch.room(n)
    for i in range(0, len(omega2), LANES):
        some = np.ascontiguousarray(omega2[i : i + LANES], dtype=float)
        these = np.ascontiguousarray(states[:, i : i + LANES])
        done = library("shapes").call("squares", own, some, these, _RULES, LONGEST_STEP, room)
        if not done[0]:
            return shapes.mode_energies(chain, states, omega2)
        squares = room.structure.squares[:n]
        lanes = squares.reshape(n, -1, LANES)[:, :, : len(some)]
        parts.append(lanes.transpose(1, 0, 2).copy())
    total = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=2)
    return shapes.energies(chain, states, Squares(*total), omega2)


def normalise(
    chain: Chain, states: Array, omega2: Array, wanted: Wanted, left: Array | None = None
) -> Normalised:
    """Return modes scaled as asked: `riccati.normalised.normalise`, compiled."""
    plain = _is_known(chain) and _is_plainly_real(states) and not _is_near_a_pole(chain, omega2)
    if not plain or len(chain.length) > _MOST_NODES:
        return normalised.normalise(chain, states, omega2, wanted, left)
    own, parts = in_si(chain), []
    room = scratch.room(len(chain.length))
    asked = Asked(wanted.beside, wanted.places, wanted.by_mass)
    for i in range(0, len(omega2), LANES):
        some = np.ascontiguousarray(omega2[i : i + LANES], dtype=float)
        these = np.array(states[:, i : i + LANES], order="C")
        pair = _NO_PAIR
        if left is not None:
            other = left[:, i : i + LANES]
            pair = np.stack([these + other, these - other])
        sums = np.empty((len(Forms._fields), len(some)))
        at_places = np.empty((len(some), len(wanted.places), 4))
        done = library("shapes").call(
            "normalise",
            *(own, some, these, pair, asked, _RULES, LONGEST_STEP, room, sums, at_places),
        )
        if not done[0]:
            return normalised.normalise(chain, states, omega2, wanted, left)
        parts.append((these, at_places, sums))
    return _together(parts)


def normal_modes(chain: Chain, omega2: Array, motions: Array, wanted: Wanted) -> Normalised:
    """Return modes that are apart, scaled as asked: `riccati.normalised.normal_modes`, compiled."""
    found = None
    special = _is_special(chain) or _is_near_a_pole(chain, omega2)
    if not special and len(chain.length) <= _MOST_NODES:
        found = _normal_modes(chain, omega2, motions, wanted)
    if found is not None:
        return found
    return normalised.normal_modes(chain, omega2, motions, wanted, mode_states, normalise)


def _normal_modes(chain: Chain, omega2: Array, motions: Array, wanted: Wanted) -> Normalised | None:
    """Return the modes in one call for every eight; None where that is left to others."""
    own, parts = in_si(chain), []
    room = scratch.room(len(chain.length))
    asked = Asked(wanted.beside, wanted.places, wanted.by_mass)
    for i in range(0, len(omega2), LANES):
        some = omega2[i : i + LANES]
        states = np.empty((len(chain.length) + 1, len(some), 4))
        sums = np.empty((len(Forms._fields), len(some)))
        at_places = np.empty((len(some), len(wanted.places), 4))
        done = library("shapes").call(
            "modes",
            *(own, some, motions[i : i + LANES], _NO_PAIR, asked, _RULES, LONGEST_STEP),
            *(room, states, sums, at_places),
        )
        if not done[0]:
            return None
        parts.append((states, at_places, sums))
    return _together(parts)


def _together(parts: list[tuple[Array, Array, Array]]) -> Normalised:
    """Return states, those at places, and forms of all modes, from those of eight each."""
    if len(parts) == 1:
        states, at_places, sums = parts[0]
        return Normalised(states, at_places, Forms(*sums))
    all_states, all_places, all_sums = zip(*parts, strict=True)
    return Normalised(
        np.concatenate(all_states, axis=1),
        np.concatenate(all_places),
        Forms(*np.concatenate(all_sums, axis=1)),
    )


def _is_plainly_real(states: Array) -> bool:
    return not np.iscomplexobj(states) and math.isfinite(float(np.sum(states)))
