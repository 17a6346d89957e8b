"""The laws of vibration: all that tells one kind of chain from another, each law in one object.

A law says which columns a segment has, how a state runs through it, how short it must be, which
ends and points there are, how eigenvalues are counted at the nodes, and which energies make modal
mass and stiffness. Everything else in this package reads it from here; no other module of the
readable form names a law.

===========  =============  ===================================  ==================================
law          state          equations                            columns
===========  =============  ===================================  ==================================
`BENDING`    Y theta M Q    ``M = EI Y''``, ``Q = M' + N Y'``    mass, stiffness EI, axial_force N
`BAR`        X Q            ``Q = -EA X'``                       mass, stiffness EA
`SHAFT`      phi T          ``T = GJ phi'``                      mass rho I_p, stiffness GJ
===========  =============  ===================================  ==================================

The force of each law changes along the beam by ``m omega^2 u`` (equation 48 with equation 50).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from .arrays import Array, Integers
from .frames import displacement_sign, minor
from .points import (
    Point,
    lateral_energies,
    lateral_joint,
    lateral_load,
    wave_energies,
    wave_joint,
    wave_load,
)
from .segment import bending_transfer, wave_number, wave_transfer

if TYPE_CHECKING:
    from .chain import Chain

LawName = Literal["bending", "longitudinal", "torsion"]
Columns = Mapping[str, Array]
"""One value for each segment, by name: `mass` and `stiffness` of every law, and what it adds."""


class Units(NamedTuple):
    """What scales the states of a chain."""

    length: Array
    """l [m], shape (k,)."""
    stiffness: float
    """EI0, EA0 or GJ0."""


class Squares(NamedTuple):
    """Integrals over each segment of squares along the modes, shape (n, modes)."""

    displacement: Array
    """of Y^2 or X^2 [m^3], or phi^2 [m]"""
    slope: Array
    """of theta^2 [m]; zero where there is one freedom"""
    moment: Array
    """of M^2 or T^2 [N^2 m^3], or Q_x^2 [N^2 m]"""
    shear: Array
    """of M'^2 [N^2 m]; zero where there is one freedom"""


class Forms(NamedTuple):
    """Quadratic forms of the modes over all segments, shape (modes,)."""

    mass: Array
    strain: Array
    work: Array
    """Of the axial force: the stiffness is strain less work."""
    size: Array
    """Strain and work with every term taken positive."""


class Law(ABC):
    """What the solver must know of one kind of vibration.

    Attributes
    ----------
    name : str
    components : tuple of str
        Of the state: d displacements, then the forces that go with them, in reverse order.
    columns : tuple of str
        Of a segment, `mass` and `stiffness` first.
    ends : dict
        The displacements that an end holds, by its name.
    power : int
        omega^2 goes as stiffness / (mass length^power).
    block_phase, block_limit : float
        Wave number times length at which a block of segments is closed, and the bound that it must
        keep with its extreme properties: well below the lowest clamped-clamped eigenvalue (4.73 in
        bending, 2 pi if buckling governs, pi for a wave).
    symplectic : array, shape (s, s)
        J with ``U^T J U = J`` for every transfer matrix; ``J^-1 = -J``.
    behind : float
        Sign of det A just behind a node where everything is held: that of det U12 of a short step
        (with Q a reaction pushes toward -x, a torque turns with phi).
    """

    name: LawName
    components: tuple[str, ...]
    columns: tuple[str, ...]
    ends: Mapping[str, tuple[int, ...]]
    power: int
    block_phase = 1.25
    block_limit = 2.5
    symplectic: Array
    behind: float

    @property
    def size(self) -> int:
        """Number of components of the state, s = 2 d."""
        return len(self.components)

    @property
    def has_axial_force(self) -> bool:
        """Whether a static axial force changes the vibration."""
        return "axial_force" in self.columns

    def named(self, *values: Array) -> dict[str, Array]:
        """Return columns in the order of the law as a table of a chain."""
        return dict(zip(self.columns, values, strict=True))

    def end_holding(self, end: str, more: tuple[int, ...]) -> str:
        """Return the name of an end that holds some displacements more."""
        wanted = {*self.ends[end], *more}
        return next(name for name, holds in self.ends.items() if set(holds) == wanted)

    def zeros(self, end: str) -> list[int]:
        """Return which components an end sets to zero: held displacements, forces of the others."""
        held = self.ends[end]
        free = (i for i in range(self.size // 2) if i not in held)
        return sorted([*held, *(self.size - 1 - i for i in free)])

    def admitted(self, end: str, segment: Mapping[str, float], units: Array) -> Array:
        """Return the frame of states that an end admits, free displacements first, (k, s, d).

        Parameters
        ----------
        end : str
        segment : dict
            Columns of the segment beside the end, on which a law's ends may depend.
        units : array, shape (k, s)
            What one unit of each scaled component is in SI.
        """
        zeros = self.zeros(end)
        free = [i for i in range(self.size) if i not in zeros]
        shape = (len(units), self.size, len(free))
        return np.broadcast_to(np.eye(self.size)[:, free], shape).copy()

    def conditions(self, end: str, segment: Mapping[str, float], units: Array) -> Array:
        """Return what vanishes at an end: rows that give zero times its frame, (k, d, s)."""
        rows = np.eye(self.size)[self.zeros(end)]
        return np.broadcast_to(rows, (len(units), *rows.shape))

    def negative_in_blocks(self, U: Array, here: Array, after: Array, R: Array) -> Integers:
        """Count the negative eigenvalues met where the left nodes of blocks are condensed, (k,).

        Parameters
        ----------
        U : array, shape (blocks, k, s, s)
        here, after : array, shape (blocks, k, s, d)
            Frames at the two nodes of each block.
        R : array, shape (blocks, k, d, d)
            Change of basis behind it.
        """
        changes = displacement_sign(here, self.behind) * displacement_sign(after, self.behind) < 0
        more = self._two_more(U, here, after, R)
        return np.asarray(np.sum(np.where(changes, 1, np.where(more, 2, 0)), axis=0))

    def _two_more(self, U: Array, here: Array, after: Array, R: Array) -> Array:
        """Tell where both eigenvalues of a node are negative; with one freedom there are no two."""
        return np.zeros(here.shape[:2], dtype=bool)

    @abstractmethod
    def negative_at_end(self, F: Array, end: str) -> Integers:
        """Count the negative eigenvalues of the stiffness of the whole, seen by the right end."""

    @abstractmethod
    def wave_number(self, chain: Chain, omega2: float) -> Array:
        """Return the bound on the wave number of every segment at `omega2` [1/m], shape (n,)."""

    @abstractmethod
    def oscillation(self, chain: Chain, omega2: float) -> Array:
        """Return the wave number of the oscillating solutions for omega^2 > 0 [1/m], shape (n,)."""

    @abstractmethod
    def worst(self, columns: Columns, starts: Integers) -> dict[str, Array]:
        """Return, for each block of segments, the columns that make waves shortest."""

    @abstractmethod
    def scale_length(self, chain: Chain, omega2: Array) -> Array:
        """Return the length [m] that makes the states of a wave at `omega2` of order one, (k,)."""

    @abstractmethod
    def lowest(self, chain: Chain) -> float:
        """Return how far below zero omega^2 may go [rad^2/s^2], roughly; 0 if it cannot."""

    @abstractmethod
    def transfer(self, length: Array, columns: Columns, omega2: Array, units: Units) -> Array:
        """Return scaled transfer matrices; length and columns (n, 1), omega2 (k,): (n, k, s, s)."""

    @abstractmethod
    def state_units(self, units: Units) -> Array:
        """Return what one unit of each scaled state component is in SI, shape (k, s)."""

    @abstractmethod
    def load(self, point: Point, omega2: Array) -> Array:
        """Return the step of a point's mass and springs in SI, shape (k, s, s)."""

    @abstractmethod
    def joint(self, point: Point, lanes: int) -> Array:
        """Return the step of a point's joint in SI, shape (lanes, s, s)."""

    @abstractmethod
    def slope(self, stiffness: Array, z: Array) -> Array:
        """Return the derivative of the displacement along the axis, shape z.shape[:-1]."""

    @abstractmethod
    def squares(self, columns: Columns, z: Array) -> Array:
        """Return what `Squares` integrates, of states (n, k, s), shape (4, n, k)."""

    @abstractmethod
    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return the quadratic forms of the segments."""

    @abstractmethod
    def point_energies(self, point: Point, state: Array, last: bool) -> tuple[Array, Array]:
        """Return a point's shares of modal mass and stiffness, from states (k, s) on its right."""


_LATERAL_ENDS: Mapping[str, tuple[int, ...]] = {
    "free": (),
    "clamped": (0, 1),
    "pinned": (0,),
    "sliding": (1,),
}
"""Held of [Y, theta]; a force is zero where its displacement is free: pinned is Y = M = 0."""
_SINGLE_ENDS: Mapping[str, tuple[int, ...]] = {"free": (), "fixed": (0,)}


class Bending(Law):
    """Euler-Bernoulli bending under axial force (equations 48-53)."""

    name: LawName = "bending"
    components = "Y", "theta", "M", "Q"
    columns = "mass", "stiffness", "axial_force"
    ends = _LATERAL_ENDS
    power = 4
    symplectic = np.array([[0, 0, 0, -1.0], [0, 0, 1, 0], [0, -1, 0, 0], [1, 0, 0, 0]])
    behind = 1.0

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
        """Bound the four roots of equation 50."""
        return wave_number(chain.stiffness, chain.axial_force, chain.mass * abs(omega2))

    def oscillation(self, chain: Chain, omega2: float) -> Array:
        """Return lambda_2 of equation 51."""
        c = chain.mass * omega2 / chain.stiffness
        b = chain.axial_force / chain.stiffness / 2
        return np.sqrt(np.maximum(b + np.sqrt(b * b + c), 0.0))

    def worst(self, columns: Columns, starts: Integers) -> dict[str, Array]:
        """Take the least stiffness, most mass and the strongest force."""
        force = np.maximum.reduceat(np.abs(columns["axial_force"]), starts)
        return {**_softest(columns, starts), "axial_force": force}

    def scale_length(self, chain: Chain, omega2: Array) -> Array:
        """Take the longer wave of mean properties, or the length of the chain."""
        stiffness, mass = chain.reference
        inertia = np.abs(omega2) * mass / stiffness
        total = float(np.sum(chain.length))
        weight = chain.length / np.sum(chain.length)
        b = float(weight @ np.abs(chain.axial_force)) / stiffness
        return np.asarray((inertia + b * b + total**-4) ** -0.25)

    def lowest(self, chain: Chain) -> float:
        """Let the largest compression act on the whole length."""
        b = np.max(np.maximum(chain.axial_force, 0) / chain.stiffness)
        stiffness, mass = chain.reference
        total = float(np.sum(chain.length))
        return float(stiffness / (mass * total**4) * (1 + b * np.sum(chain.length) ** 2) ** 2)

    def transfer(self, length: Array, columns: Columns, omega2: Array, units: Units) -> Array:
        """Scale equations 58, 61 and 62."""
        scale, stiffness = units
        N = columns["axial_force"] * (scale**2 / stiffness)
        inertia = columns["mass"] * (omega2 * scale**4 / stiffness)
        return bending_transfer(length / scale, columns["stiffness"] / stiffness, N, inertia)

    def state_units(self, units: Units) -> Array:
        """Return those of ``[Y/l, theta, M l/EI0, Q l^2/EI0]``."""
        scale, stiffness = units
        one = np.ones_like(scale)
        return np.stack([scale, one, stiffness / scale, stiffness / scale**2], axis=-1)

    def load(self, point: Point, omega2: Array) -> Array:
        """Return jumps of Q and M."""
        return lateral_load(point, omega2)

    def joint(self, point: Point, lanes: int) -> Array:
        """Return the jump of theta."""
        return lateral_joint(point, lanes)

    def slope(self, stiffness: Array, z: Array) -> Array:
        """Return theta."""
        return np.asarray(z[..., 1])

    def squares(self, columns: Columns, z: Array) -> Array:
        """Return Y^2, theta^2, M^2 and M'^2."""
        Y, theta, M, Q = np.moveaxis(z, -1, 0)
        shear = Q - columns["axial_force"][:, None] * theta
        return np.stack([Y**2, theta**2, M**2, shear**2])

    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return m Y^2, M^2/EI and N Y'^2."""
        mass = columns["mass"] @ squares.displacement
        strain = (1 / columns["stiffness"]) @ squares.moment
        work = columns["axial_force"] @ squares.slope
        return Forms(mass, strain, work, strain + np.abs(columns["axial_force"]) @ squares.slope)

    def point_energies(self, point: Point, state: Array, last: bool) -> tuple[Array, Array]:
        """Return those of a rigid mass, springs and a joint that turns."""
        return lateral_energies(point, state, last)


class Wave(Law):
    """One freedom u with the force ``F = sign K u'`` and ``F' = -sign m omega^2 u`` (equation 48).

    The bar's Q counts compression positive, a shaft's T the torque on a section that faces +x.
    """

    columns = "mass", "stiffness"
    ends = _SINGLE_ENDS
    power = 2
    symplectic = np.array([[0.0, 1.0], [-1.0, 0.0]])

    def __init__(self, name: LawName, components: tuple[str, str], sign: float) -> None:
        self.name, self.components = name, components
        self.sign = self.behind = sign

    def negative_at_end(self, F: Array, end: str) -> Integers:
        """Count where the end's own force pulls it on."""
        negative = self.sign * F[..., 1, 0] * F[..., 0, 0] < 0
        return np.where(len(self.ends[end]) == 0, negative, False).astype(np.int64)

    def wave_number(self, chain: Chain, omega2: float) -> Array:
        """Return the one wave number there is."""
        return np.sqrt(chain.mass * abs(omega2) / chain.stiffness)

    def oscillation(self, chain: Chain, omega2: float) -> Array:
        """Return the same."""
        return np.sqrt(chain.mass * omega2 / chain.stiffness)

    def worst(self, columns: Columns, starts: Integers) -> dict[str, Array]:
        """Take the least stiffness and most mass."""
        return _softest(columns, starts)

    def scale_length(self, chain: Chain, omega2: Array) -> Array:
        """Take the wave of mean properties, or the length of the chain."""
        stiffness, mass = chain.reference
        total = float(np.sum(chain.length))
        return np.asarray((np.abs(omega2) * mass / stiffness + total**-2) ** -0.5)

    def lowest(self, chain: Chain) -> float:
        """Return zero: no force makes it unstable."""
        return 0.0

    def transfer(self, length: Array, columns: Columns, omega2: Array, units: Units) -> Array:
        """Scale equation 55."""
        scale, stiffness = units
        inertia = columns["mass"] * (omega2 * scale**2 / stiffness)
        return wave_transfer(length / scale, columns["stiffness"] / stiffness, inertia, self.sign)

    def state_units(self, units: Units) -> Array:
        """Return those of ``[u/l, F/K0]``."""
        scale, stiffness = units
        return np.stack([scale, stiffness * np.ones_like(scale)], axis=-1)

    def load(self, point: Point, omega2: Array) -> Array:
        """Return the jump of the force."""
        return wave_load(point, omega2, self.sign)

    def joint(self, point: Point, lanes: int) -> Array:
        """Return the jump of u."""
        return wave_joint(point, lanes, self.sign)

    def slope(self, stiffness: Array, z: Array) -> Array:
        """Return u' = s F / K."""
        return np.asarray(self.sign * z[..., 1] / stiffness)

    def squares(self, columns: Columns, z: Array) -> Array:
        """Return u^2 and F^2, and zeros where bending has slope and shear."""
        u, F = z[..., 0], z[..., 1]
        return np.stack([u**2, 0 * u, F**2, 0 * u])

    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return m u^2 and F^2/K."""
        strain = (1 / columns["stiffness"]) @ squares.moment
        return Forms(columns["mass"] @ squares.displacement, strain, 0 * strain, strain)

    def point_energies(self, point: Point, state: Array, last: bool) -> tuple[Array, Array]:
        """Return those of a mass, a spring and a joint."""
        return wave_energies(point, state, last, self.sign)


def _softest(columns: Columns, starts: Integers) -> dict[str, Array]:
    """Return the least stiffness and the most mass of each block."""
    return {
        "mass": np.maximum.reduceat(columns["mass"], starts),
        "stiffness": np.minimum.reduceat(columns["stiffness"], starts),
    }


BENDING = Bending()
BAR = Wave("longitudinal", ("X", "Q"), -1.0)
SHAFT = Wave("torsion", ("phi", "T"), 1.0)
