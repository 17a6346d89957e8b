"""Axial statics of a beam: the force N that gravity, acceleration and point forces leave in it.

With external force f per length along +x, equilibrium reads ``dN/dx = f - m a``, and a point force
F along +x raises N by F (N > 0 is compression). A beam fixed axially at one end reacts there; one
that is held at both ends, or by axial springs, shares the load by EA: ``du/dx = -N/EA``; one that
nothing holds accelerates as a whole, and its inertia closes the balance.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array, Integers
from antinode.errors import InputError

from . import curves
from .attachments import Joint, on_beam
from .beam import Beam
from .loads.axial_supports import axial_supports

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_POINTS, _WEIGHTS = (_POINTS + 1) / 2, _WEIGHTS / 2
_STEEPEST = 4.0  # ratio of EA across one piece of an integral


@dataclass(frozen=True)
class PointForce:
    """An axial force at a station: `force` [N] along +x at `x` [m]."""

    x: float
    force: float


@dataclass(frozen=True)
class AxialLoads:
    """Axial loads on a beam.

    Parameters
    ----------
    gravity : float
        Body force per mass along +x [m/s^2]; -9.80665 for a tower read from its base up.
    acceleration : float
        Of the supports along +x [m/s^2]; none may be given where nothing holds the beam axially.
    point_forces : tuple of PointForce
    offset_weight : bool
        Whether the weight and inertia of an offset point mass act through its own centre, and so
        bend the beam when it turns (default), or through the station.
    """

    gravity: float = 0.0
    acceleration: float = 0.0
    point_forces: tuple[PointForce, ...] = ()
    offset_weight: bool = True


def apply_loads(beam: Beam, loads: AxialLoads) -> Beam:
    """Return the beam with the axial force of the loads added to its own.

    Raises
    ------
    InputError
        If a force lies off the beam, EA is needed and missing, or an acceleration is given for a
        beam that nothing holds axially.
    """
    forces = tuple(replace(f, x=on_beam(f.x, beam.x)) for f in loads.point_forces)
    loads = replace(loads, point_forces=forces)
    for force in loads.point_forces:
        if not beam.x[0] <= force.x <= beam.x[-1]:
            raise InputError(
                f"the point force at x = {force.x:g} m is off the beam, which runs from "
                f"{beam.x[0]:g} to {beam.x[-1]:g} m"
            )
    beam = beam.with_breakpoints([force.x for force in loads.point_forces])
    at_nodes = np.zeros(len(beam.x))
    for force in loads.point_forces:
        at_nodes[int(np.argmin(np.abs(beam.x - force.x)))] += force.force
    held = axial_supports(beam)
    if not np.any(held):
        if loads.acceleration:
            raise InputError(
                "an acceleration is given, but nothing holds the beam axially: its acceleration "
                "follows from the forces; leave it out or fix an end"
            )
        body = -float(np.sum(at_nodes)) / beam.mass
    else:
        body = loads.gravity - loads.acceleration
    steps = _steps(beam, at_nodes, held, body)
    return replace(
        beam,
        axial_force=beam.axial_force + steps[:, None],
        axial_acceleration=beam.axial_acceleration + body,
        offset_weight=loads.offset_weight,
    )


def _steps(beam: Beam, forces: Array, held: Array, body: float) -> Array:
    """Return the part of N that is constant on every interval [N]: reactions and point forces."""
    supports = np.flatnonzero(held)
    reactions = np.zeros(len(forces))
    total = float(np.sum(forces)) + body * beam.mass
    if len(supports) == 1:
        reactions[supports[0]] = -total
    elif len(supports) > 1:
        reactions[supports] = _shared(beam, forces, held, supports, body)
    return np.asarray(np.cumsum(forces + reactions)[:-1])


def _shared(beam: Beam, forces: Array, held: Array, supports: Integers, body: float) -> Array:
    """Return the reactions of several axial supports (force method: their displacements agree).

    What stands on a joint's station, reactions included, stands on the joint's left.
    """
    flexibility, drop = _flexibility(beam, forces, body)
    first, others = supports[0], supports[1:]
    n = len(supports)
    system, right = np.zeros((n, n)), np.zeros(n)
    for row, j in enumerate(others):  # u_first - u_j = integral of N/EA between them
        between = slice(first, j)
        right[row] = -np.sum(drop[between])
        for column, i in enumerate(supports):
            system[row, column] = np.sum(flexibility[max(first, i) : j]) if i < j else 0.0
        system[row, 0] += 1 / held[first]
        system[row, 1 + row] -= 1 / held[j]
    system[-1], right[-1] = 1.0, -(float(np.sum(forces)) + body * beam.mass)
    return np.asarray(np.linalg.solve(system, right))


def _flexibility(beam: Beam, forces: Array, body: float) -> tuple[Array, Array]:
    """Return what unit N, and N without reactions, shorten each interval by [m/N, m].

    The joint at the left end of an interval belongs to it.
    """
    EA = beam.axial_stiffness
    if EA is None:
        raise InputError(
            "axial_stiffness is missing: a beam held axially at more than one place shares its "
            "load by EA [N]"
        )
    k, start, size = _pieces(EA) if EA.shape[1] == 2 else _halved_pieces(EA)
    at = start[:, None] + size[:, None] * _POINTS
    h = (np.diff(beam.x)[k] * size)[:, None] * _WEIGHTS
    bare = np.cumsum(forces)[:-1]
    compliance = h / beam.column_at("axial_stiffness", k[:, None], at)
    carried = body * beam.mass_left_of(k[:, None], at) + bare[k, None]
    joints = _joint_compliance(beam)[:-1]
    flexibility = np.bincount(k, np.sum(compliance, axis=1)) + joints
    drop = np.bincount(k, np.sum(compliance * carried, axis=1))
    return flexibility, drop + joints * (bare + body * beam.mass_left[:-1])


def _pieces(EA: Array) -> tuple[Integers, Array, Array]:
    """Cut intervals where EA is steep: return interval, and start and size as shares of it.

    A piece of a linear EA has a ratio of `_STEEPEST` at most between its ends, so that 16 points
    integrate 1/EA to rounding.
    """
    ratio = EA[:, 1] / EA[:, 0]
    count = np.maximum(1, np.ceil(np.abs(np.log(ratio)) / np.log(_STEEPEST))).astype(int)
    k = np.repeat(np.arange(len(EA)), count)
    number = np.arange(len(k)) - np.repeat(np.cumsum(count) - count, count)

    def bound(j: Array) -> Array:
        """Return where EA has run through j of the pieces' equal ratios."""
        share, steep = j / count[k], np.abs(ratio[k] - 1) > 1e-3
        inverse = np.where(steep, ratio[k] - 1, 1.0)
        return np.asarray(np.where(steep, (ratio[k] ** share - 1) / inverse, share))

    start = bound(number)
    return k, start, bound(number + 1) - start


def _halved_pieces(EA: Array) -> tuple[Integers, Array, Array]:
    """Return the same where EA is a polynomial: its control values tell where it is steep."""
    k = np.arange(len(EA))
    start, size = np.zeros(len(k)), np.ones(len(k))
    while True:
        control = curves.part(EA[k], start, start + size)
        steep = np.max(control, axis=1) > _STEEPEST / 2 * np.min(control, axis=1)
        if not steep.any():
            return k, start, size
        pieces = np.where(steep, 2, 1)
        k, start = np.repeat(k, pieces), np.repeat(start, pieces)
        size = np.repeat(size / pieces, pieces)
        second = np.append(False, (k[1:] == k[:-1]) & (start[1:] == start[:-1]))
        start = start + second * size


def _joint_compliance(beam: Beam) -> Array:
    """Return the axial compliance of the joints at every breakpoint [m/N], shape (n + 1,)."""
    compliance = np.zeros(len(beam.x))
    for item in beam.attachments:
        if isinstance(item, Joint):
            compliance[int(np.argmin(np.abs(beam.x - item.x)))] += item.axial
    return compliance
