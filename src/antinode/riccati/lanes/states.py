"""States and integrals of modes in compiled code, eight modes side by side."""

from __future__ import annotations

import numpy as np

from antinode.riccati import shapes
from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import Chain, end_frame, largest_wave_number, point_steps, state_units
from antinode.riccati.laws import Squares
from antinode.riccati.points import Point
from antinode.riccati.segment import LONGEST_STEP

from . import shapes as lane_shapes
from .laws import FORMS
from .library import library
from .single import more_columns
from .workspace import LANES, new_scaled

_HEAVY = 1e3  # m d^2 over that of the beam
_MOST_NODES = 20_000  # whose frames are kept


def mode_states(
    chain: Chain, omega2: Array, multiplicity: Integers, *, adjoint: bool = False
) -> Array:
    """Return the states of the modes at every node: `riccati.shapes.mode_states`, compiled.

    Supports between the ends, clusters, modes that flutter and longitudinal ones are left to the
    readable form.
    """
    special = np.iscomplexobj(omega2) or _is_special(chain, multiplicity)
    fine = None if special else shapes.split_for(chain, omega2)
    if fine is None or len(fine.length) > _MOST_NODES:
        return shapes.mode_states(chain, omega2, multiplicity, adjoint=adjoint)
    keep = shapes.kept_nodes(chain, fine)
    parts = [_states(fine, omega2[i : i + LANES], adjoint) for i in range(0, len(omega2), LANES)]
    return np.concatenate([part[keep] for part in parts], axis=1)


def _is_special(chain: Chain, multiplicity: Integers) -> bool:
    held = any(point.holds or _is_heavy(point, chain) for point in chain.points)
    return not _is_known(chain) or held or bool(np.any(multiplicity > 1))


def _is_heavy(point: Point, chain: Chain) -> bool:
    """Tell whether the rotary inertia of a mass off its node may drown in J + m d^2."""
    total, length = float(chain.mass @ chain.length), float(np.sum(chain.length))
    return point.mass * point.offset**2 > _HEAVY * total * length**2


def _is_known(chain: Chain) -> bool:
    return FORMS[chain.law].shapes


class _LaneChain:
    """A chain in the units of up to eight modes; arrays are copied into the layout compiled for."""

    def __init__(self, chain: Chain, omega2: Array) -> None:
        n, number = len(chain.length), len(omega2)
        lane = np.minimum(np.arange(LANES), number - 1)
        self.scale = chain.scale_length(omega2)[lane]
        arrays = chain.length, chain.mass, chain.stiffness, chain.axial_force
        self.length, mass, stiffness, self.force = (np.array(v, order="C") for v in arrays)
        self.units = state_units(chain, omega2)[lane]
        self.columns = new_scaled(n)
        library("shapes").call(
            "scaled_chain",
            *(mass, stiffness, self.force, more_columns(chain), omega2[lane], self.scale),
            *(chain.reference[0], self.columns),
        )
        self.scratch = np.zeros((lane_shapes.SCRATCH, LANES))

    def transfers(self) -> Array:
        U = np.empty((len(self.length), 10, LANES))
        library("shapes").call("transfers", self.length, self.columns, self.scale, self.scratch, U)
        return U


def _states(fine: Chain, omega2: Array, adjoint: bool) -> Array:
    own = _LaneChain(fine, omega2)
    n, number, U = len(fine.length), len(omega2), own.transfers()
    points = _lane_points(fine, omega2, own.units)

    def sweeps(adjoint: bool) -> tuple[Array, Array]:
        frames, backs = np.empty((2, n + 1, 8, LANES)), np.empty((2, n + 1, 3, LANES))
        ends = _end_frames(fine, own.units, adjoint)
        library("shapes").call("sweeps", U, *points, ends, own.scratch, *frames, *backs)
        return frames, backs

    frames, backs = sweeps(adjoint)
    across = sweeps(not adjoint)[0][0] if fine.following[0] else frames[0]
    node, state = np.zeros(LANES, np.int64), np.empty((4, LANES))
    library("shapes").call("meet", across, frames[1], own.scratch, node, state)
    z = np.empty((n + 1, number, 4))
    library("shapes").call("carry", *frames, *backs, node, state, own.units, z)
    return z


def _end_frames(chain: Chain, units: Array, adjoint: bool) -> Array:
    """Return the frames that both ends admit, columns one after the other, (2, 8, lanes)."""
    F = np.stack([end_frame(chain, side, units, adjoint=adjoint) for side in (0, -1)])
    return np.ascontiguousarray(F.transpose(0, 3, 2, 1).reshape(2, 8, -1), dtype=float)


def _lane_points(chain: Chain, omega2: Array, units: Array) -> tuple[Integers, Array]:
    """Return which point sits at every node (-1: none), and what `lane_shapes.sweeps` needs."""
    marks, table = np.full(len(chain.length) + 1, -1), np.zeros((len(chain.points), 5, LANES))
    lane = np.minimum(np.arange(LANES), len(omega2) - 1)
    for k, point in enumerate(chain.points):
        marks[point.node] = k
        for kind, T, _ in point_steps(chain.law, point, omega2[lane], units):
            if kind == "load":
                table[k, :4] = T[:, 3, 0], T[:, 3, 1], T[:, 2, 0], T[:, 2, 1]
                table[k, 3] = T[:, 2, 1]
            else:
                table[k, 4] = T[:, 1, 2]
    return marks, table


def mode_energies(chain: Chain, states: Array, omega2: Array) -> shapes.Energies:
    """Return modal mass and stiffness of modes: `riccati.shapes.mode_energies`, compiled."""
    phase = float(np.max(largest_wave_number(chain, float(np.max(np.abs(omega2)))) * chain.length))
    if not _is_known(chain) or phase > LONGEST_STEP or np.iscomplexobj(states):
        return shapes.mode_energies(chain, states, omega2)
    share, weight = shapes.gauss_rule(phase)
    parts = []
    for i in range(0, len(omega2), LANES):
        own = _LaneChain(chain, omega2[i : i + LANES])
        these = np.array(states[:, i : i + LANES], order="C")
        total = np.zeros((len(Squares._fields), *these[:-1, :, 0].shape))
        library("shapes").call(
            "squares",
            *(own.length, own.force, own.columns, own.scale, own.units),
            *(these, share, weight, own.scratch, total),
        )
        parts.append(total)
    return shapes.energies(chain, states, Squares(*np.concatenate(parts, axis=2)))
