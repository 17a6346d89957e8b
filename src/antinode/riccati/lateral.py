r"""Lateral motion under axial force: one law for every beam.

Euler-Bernoulli and Timoshenko, by Haringx or by Engesser, with rotary inertia, on an elastic
foundation, in water: numbers of the same four entries (`riccati.segment`; docs/theory/beam.md).

    Y' = alpha psi - s Q,  psi' = M/EI,  M' = alpha Q - beta psi,  Q' = mu Y

    alpha = 1 + sN,  beta = N + sN^2 + rho I omega^2,  mu = m omega^2 - k

The products s, sN and sN^2 are columns of their own: where properties vary inside a step, each is
averaged. Engesser's kGA is a Haringx kGA smaller by N. Energies of a mode, with omega^2 times the
mass equal to the stiffness:

    mass = int m Y^2 + rho I psi^2,   stiffness = int M^2/EI + s Q^2 + k Y^2 - (N + sN^2) psi^2

A load t along the axis that turns with the section adds ``Q' = ... + t psi`` (column `tangential`);
its adjoint ``M' = ... - t Y`` (`tangential_adjoint`). No energy goes with it, and no count.

Bazant, Beghini, J. Appl. Mech. 72 (2005) 785; Attard, Hunt, Int. J. Solids Struct. 45 (2008) 4322.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import Array, Integers
from .frames import minor
from .law import Columns, Forms, Law, LawName, Squares, Units
from .points import Point, lateral_energies, lateral_joint, lateral_load
from .segment import following_transfer, lateral_transfer, wave_number

if TYPE_CHECKING:
    from .chain import Chain

_ENDS: Mapping[str, tuple[int, ...]] = {
    "free": (),
    "clamped": (0, 1),
    "pinned": (0,),
    "sliding": (1,),
}
"""Held of [Y, psi]; a force is zero where its displacement is free: pinned is Y = M = 0."""


class Lateral(Law):
    """Lateral motion: bending and shear under axial force (equations 48-53)."""

    components = "Y", "psi", "M", "Q"
    columns = "mass", "stiffness", "axial_force"
    more = "shear", "shear_turn", "shear_work", "rotary_inertia", "foundation"
    ends = _ENDS
    power = 4
    symplectic = np.array([[0, 0, 0, -1.0], [0, 0, 1, 0], [0, -1, 0, 0], [1, 0, 0, 0]])
    behind = 1.0

    def __init__(self, name: LawName) -> None:
        self.name = name

    def _two_more(self, U: Array, here: Array, after: Array, R: Array) -> Array:
        """Tell it by the trace of ``A_i^T P U12^-1 A_i+1``; det U12 > 0 in every block."""
        P_adjugate = np.empty((*U.shape[:-2], 2, 2))  # P adj(U12)
        P_adjugate[..., 0, 0], P_adjugate[..., 0, 1] = U[..., 1, 2], -U[..., 0, 2]
        P_adjugate[..., 1, 0], P_adjugate[..., 1, 1] = U[..., 1, 3], -U[..., 0, 3]
        A_next = after[:, :, :2] @ R
        trace = np.sum(here[:, :, :2] * (P_adjugate @ A_next), axis=(-2, -1))
        held = minor(here, [0, 1]) == 0.0  # a supported node has one freedom, or none
        return np.asarray((trace < 0) & ~held)

    def negative_at_end(self, F: Array, end: str) -> Integers:
        """Count by the minors, which are the entries of K times det A."""
        det_A = minor(F, [0, 1])
        along_theta, along_Y = minor(F, [0, 2]) * det_A, minor(F, [1, 3]) * det_A
        held = self.ends[end]
        if held:
            along = {(0,): along_theta, (1,): along_Y, (0, 1): np.zeros(det_A.shape)}[held]
            return np.asarray(along < 0, dtype=np.int64)
        indefinite = minor(F, [2, 3]) * det_A < 0
        return np.where(indefinite, 1, np.where(along_theta + along_Y < 0, 2, 0))

    def wave_number(self, chain: Chain, omega2: float) -> Array:
        """Bound the four roots of equation 50 for all omega^2 of this size and less."""
        c = chain.columns
        inertia, along = c["mass"] * abs(omega2), _tangential(c)
        if along is not None:
            turn = c.get("shear_turn", _NONE)
            extra = np.cbrt(np.abs((1 + turn) * along / c["stiffness"]))
            return self.wave_number(replace(chain, columns=without_tangential(c)), omega2) + extra
        if not _has_more(c):
            return wave_number(c["axial_force"] / c["stiffness"], inertia / c["stiffness"])
        s, turn, work, rotary, foundation = _more(c)
        inertia, rotary = inertia + foundation, rotary * abs(omega2)
        beta, alpha = np.abs(c["axial_force"] + work), 1 + turn
        kappa = np.abs(alpha * alpha - s * (c["axial_force"] + work)) + s * rotary
        EI = c["stiffness"]
        return wave_number(s * inertia + (beta + rotary) / EI, inertia * kappa / EI)

    def oscillation(self, chain: Chain, omega2: float) -> Array:
        """Return lambda_2 of equation 51, and above a cut-off that of the second spectrum too."""
        columns = chain.columns
        EI, inertia = columns["stiffness"], columns["mass"] * omega2
        b, c = columns["axial_force"] / EI / 2, inertia / EI
        if not _has_more(columns):
            return np.sqrt(np.maximum(b + np.sqrt(b * b + c), 0.0))
        s, turn, work, rotary, foundation = _more(columns)
        mu = inertia - foundation
        beta = columns["axial_force"] + work + rotary * omega2
        b = (s * mu + beta / EI) / 2
        c = mu / EI * ((1 + turn) ** 2 - s * beta)
        root = np.sqrt(np.maximum(b * b + c, 0.0))
        return np.sqrt(np.maximum(b + root, 0.0)) + np.sqrt(np.maximum(b - root, 0.0))

    def worst(self, columns: Columns, starts: Integers) -> dict[str, Array]:
        """Take the least stiffness, most inertia, strongest force and softest shear.

        alpha is no energy of its own. Where it varies by d about a mean, ``(alpha psi - Y')^2/s``
        is at least ``(1 - e)`` of its value with the mean, less ``(1/e - 1) d^2/s psi^2``.
        """
        most = {name: np.maximum.reduceat(np.abs(v), starts) for name, v in columns.items()}
        most["stiffness"] = np.minimum.reduceat(columns["stiffness"], starts)
        if "shear" not in columns:
            return most
        turn, least = columns["shear_turn"], np.minimum.reduceat(columns["shear"], starts)
        low, high = np.minimum.reduceat(turn, starts), np.maximum.reduceat(turn, starts)
        spread = (high - low) / 2
        varies = spread > 0
        share = np.where(varies, _SHARE, 0.0)
        lost = np.zeros(len(starts))
        lost[varies] = (1 / _SHARE - 1) * spread[varies] ** 2 / np.maximum(least[varies], 1e-300)
        most["shear"] = most["shear"] / (1 - share)
        most["shear_turn"], most["shear_work"] = (low + high) / 2, most["shear_work"] + lost
        return most

    def scale_length(self, chain: Chain, omega2: Array) -> Array:
        """Take the longer wave of mean properties, or the length of the chain."""
        stiffness, mass = chain.reference
        inertia = np.abs(omega2) * mass / stiffness
        total = float(np.sum(chain.length))
        weight = chain.length / np.sum(chain.length)
        b = float(weight @ np.abs(chain.axial_force)) / stiffness
        return np.asarray((inertia + b * b + total**-4) ** -0.25)

    def lowest(self, chain: Chain) -> float:
        """Let the largest compression act on the whole length, and on a soft section."""
        force = chain.axial_force + chain.columns.get("shear_work", 0.0)
        b = np.max(np.maximum(force, 0) / chain.stiffness)
        stiffness, mass = chain.reference
        total = float(np.sum(chain.length))
        return float(stiffness / (mass * total**4) * (1 + b * np.sum(chain.length) ** 2) ** 2)

    def transfer(self, length: Array, columns: Columns, omega2: Array, units: Units) -> Array:
        """Scale equations 58, 61 and 62."""
        scale, stiffness = units
        N = columns["axial_force"] * (scale**2 / stiffness)
        inertia = columns["mass"] * (omega2 * scale**4 / stiffness)
        h, EI = length / scale, columns["stiffness"] / stiffness
        along = _tangential(columns)
        if along is not None:
            return self._following(h, EI, N, inertia, along, columns, omega2, units)
        if not _has_more(columns):
            return lateral_transfer(h, EI, N, inertia)
        s, turn, work, rotary, foundation = _more(columns)
        beta = N + (work + rotary * omega2) * (scale**2 / stiffness)
        mu = inertia - foundation * (scale**4 / stiffness)
        return lateral_transfer(h, EI, beta, mu, s * (stiffness / scale**2), 1 + turn)

    def _following(
        self,
        h: Array,
        EI: Array,
        N: Array,
        inertia: Array,
        along: Array,
        columns: Columns,
        omega2: Array,
        units: Units,
    ) -> Array:
        """Return the transfer where a load turns; of the adjoint ``J U^-T J^-1``."""
        scale, stiffness = units
        s, turn, work, rotary, foundation = _more(columns)
        beta = N + (work + rotary * omega2) * (scale**2 / stiffness)
        mu = inertia - foundation * (scale**4 / stiffness)
        t, s = along * (scale**3 / stiffness), s * (stiffness / scale**2)
        if "tangential" in columns:
            return following_transfer(h, EI, beta, mu, t, s, 1 + turn)
        back = following_transfer(-h, EI, beta, mu, t, s, 1 + turn)
        J = self.symplectic
        return np.asarray(-J @ np.swapaxes(back, -1, -2) @ J)

    def rates(self, column: Mapping[str, Any], omega2: Any) -> list[list[Any]]:
        """Return the law as it stands at the head of this module."""
        s, turn, work, rotary, foundation = (column.get(name, 0) for name in self.more)
        alpha = 1 + turn
        beta = column["axial_force"] + work + rotary * omega2
        along, across = (column.get(name, 0) for name in ("tangential", "tangential_adjoint"))
        return [
            [0, alpha, 0, -s],
            [0, 0, 1 / column["stiffness"], 0],
            [-across, -beta, 0, alpha],
            [column["mass"] * omega2 - foundation, along, 0, 0],
        ]

    def state_units(self, units: Units) -> Array:
        """Return those of ``[Y/l, psi, M l/EI0, Q l^2/EI0]``."""
        scale, stiffness = units
        one = np.ones_like(scale)
        return np.stack([scale, one, stiffness / scale, stiffness / scale**2], axis=-1)

    def load(self, point: Point, omega2: Array) -> Array:
        """Return jumps of Q and M."""
        return lateral_load(point, omega2)

    def joint(self, point: Point, lanes: int) -> Array:
        """Return the jump of psi."""
        return lateral_joint(point, lanes)

    def slope(self, columns: Columns, z: Array) -> Array:
        """Return Y' = alpha psi - s Q."""
        if "shear" not in columns:
            return np.asarray(z[..., 1])
        s, turn = columns["shear"], columns["shear_turn"]
        return np.asarray((1 + turn) * z[..., 1] - s * z[..., 3])

    def squares(self, columns: Columns, z: Array) -> Array:
        """Return Y^2, psi^2, M^2, V^2 and Q^2."""
        Y, psi, M, Q = np.moveaxis(z, -1, 0)
        V = Q - columns["axial_force"][:, None] * psi
        return np.stack([Y**2, psi**2, M**2, V**2, Q**2])

    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return the energies of mass, strain, foundation and axial force."""
        mass = columns["mass"] @ squares.displacement
        strain = (1 / columns["stiffness"]) @ squares.moment
        force = columns["axial_force"]
        if _has_more(columns):
            more = (np.broadcast_to(column, force.shape) for column in _more(columns))
            s, _, shear_work, rotary, foundation = more
            mass = mass + rotary @ squares.turn
            strain = strain + s @ squares.force + foundation @ squares.displacement
            force = force + shear_work
        work = force @ squares.turn
        return Forms(mass, strain, work, strain + np.abs(force) @ squares.turn)

    def densities(self, columns: Columns, z: Array, omega2: float) -> dict[str, Array]:
        """Return those of motion, bending, shear, foundation, and the axial force's work.

        The force's is what the others leave of ``s Q^2 - (N + sN^2) psi^2``.
        """
        Y2, psi2, M2, V2, Q2 = self.squares(columns, z)
        every = (np.broadcast_to(c, len(z))[:, None] for c in _more(columns))
        s, _, work, rotary, foundation = every
        mass, EI, N = (columns[name][:, None] for name in self.columns)
        shear = s * V2
        return {
            "kinetic": omega2 * (mass * Y2 + rotary * psi2),
            self.name: M2 / EI,
            "shear": shear,
            "foundation": foundation * Y2,
            "axial force": s * Q2 - shear - (N + work) * psi2,
        }

    def point_energies(
        self, point: Point, state: Array, last: bool, moved: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Return those of a rigid mass, springs, a pedestal and a joint that turns."""
        return lateral_energies(point, state, last, moved)


_SHARE = 0.1


def _tangential(columns: Columns) -> Array | None:
    """Return the load along the axis that turns with the section, of either problem."""
    return columns.get("tangential", columns.get("tangential_adjoint"))


def without_tangential(columns: Columns) -> dict[str, Array]:
    """Return the columns of the self-adjoint rest."""
    return {name: v for name, v in columns.items() if not name.startswith("tangential")}


def _has_more(columns: Columns) -> bool:
    """Tell whether there is more than Euler-Bernoulli's columns."""
    return len(columns) > len(Lateral.columns)


def _more(columns: Columns) -> Iterator[Array]:
    """Yield s, sN, sN^2, rho I and k; what is not given is zero."""
    return (columns.get(name, _NONE) for name in Lateral.more)


_NONE = np.zeros(())
