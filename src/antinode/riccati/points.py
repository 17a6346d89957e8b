"""What sits at a node of a chain: masses, springs, supports and in-line joints, as transfer steps.

A point changes the state between its two sides. From the energy of each (docs/theory/beam.md), in
bending, for a mass m_p whose centre lies d to the right of the node and has the inertia J, springs
to ground k, k_r and, coupling both, k_c, the mass' own axial force P along +x, and a joint of
rotational compliance f::

    Q+ = Q- + omega^2 m_p (Y + d theta) - k Y - k_c theta
    M+ = M- - omega^2 [m_p d (Y + d theta) + J theta] + k_c Y + k_r theta + P d theta
    theta+ = theta- + f M

A feedback of the node's own motion, whose matrix K need not be symmetric (row Y, row theta)::

    Q+ = Q- - K_YY Y - K_Yt theta,   M+ = M- + K_tY Y + K_tt theta

A pedestal, a mass m between a spring k_1 to the node and a spring k_2 to the ground, moves sideways
by ``x = k_1 Y/(k_1 + k_2 - m omega^2)`` and acts as a spring that depends on omega^2::

    Q+ = Q- - K Y,   K = k_1 (k_2 - m omega^2)/(k_1 + k_2 - m omega^2)

and along one freedom u with the force s K u' (s is -1 for a bar, 1 for a shaft)
``F+ = F- - s (omega^2 m_p u - k u)``, ``u+ = u- + s f F``. A support (an infinite spring) holds a
displacement at zero and leaves the conjugate force free to jump.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from .arrays import Array, Complex

StepKind = Literal["block", "load", "support", "joint", "pedestal"]


class Pedestal(NamedTuple):
    """A mass between a spring to a node and one to the ground, both across the beam.

    Attributes
    ----------
    mass : float
        m [kg].
    upper, lower : float
        k_1, to the node, and k_2, to the ground [N/m].
    """

    mass: float
    upper: float
    lower: float

    @property
    def pole(self) -> float:
        """omega^2 of the mass while the node stands still [rad^2/s^2]."""
        return (self.upper + self.lower) / self.mass

    def parts(self, omega2: Any) -> tuple[Any, Any]:
        """Return numerator [N^2/m^2] and denominator [N/m] of K."""
        inertia = self.mass * omega2
        return self.upper * (self.lower - inertia), self.upper + self.lower - inertia

    def stiffness(self, omega2: Any) -> Any:
        """Return K(omega^2) [N/m]; at its pole as large as next to it."""
        above, below = self.parts(omega2)
        return above / self._off_pole(below)

    def passed_on(self, omega2: Any) -> Any:
        """Return the force on the node for a unit motion of the ground [N/m]."""
        return self.lower * self.moved(omega2)

    def moved(self, omega2: Any) -> Any:
        """Return how far the mass moves where the node moves by one [-]."""
        return self.upper / self._off_pole(self.parts(omega2)[1])

    def _off_pole(self, below: Any) -> Any:
        """Return a denominator that is not all but zero: rounding would take more than is moved."""
        least = _NEAR_POLE * (self.upper + self.lower)
        return np.where(np.abs(below) < least, least, below)


_NEAR_POLE = 1e-8


@dataclass(frozen=True)
class Point:
    """Everything at one node of a chain, for one law.

    Parameters
    ----------
    node : int
        0 ... n.
    mass, offset, inertia : float
        m_p [kg], d [m], J [kg m^2]. Where there is one freedom only the mass counts: the inertia
        of that freedom, [kg m^2] in torsion.
    spring, rotational_spring : float
        k [N/m] and k_r [N m/rad]; the spring is [N m/rad] in torsion.
    coupling : float
        k_c [N]: the lateral force of a unit slope, and the moment of a unit displacement.
    holds : tuple of int
        Displacements held at zero by supports: 0 (Y, X, phi), 1 (theta).
    compliance : float
        f of the joint [rad/(N m)], or [m/N] of a bar.
    own_load : float
        P [N], by which N jumps because of this mass, acting through its centre.
    dashpot, rotational_dashpot : float
        To the ground [N s/m, N m s/rad]; at omega they add i omega times themselves to the
        springs. Undamped modes know nothing of them.
    feedback : tuple of float, optional
        K_YY, K_Yt, K_tY, K_tt of a force and a moment that oppose motion [N/m, N, N, N m]: where
        K_Yt is not K_tY the problem is not self-adjoint, and counts do not know it.
    feedback_damping : tuple of float, optional
        The same for velocities [N s/m, N s, N s, N m s].
    pedestal : Pedestal, optional
        That the node stands on, or that hangs on it; sideways alone.
    """

    node: int
    mass: float = 0.0
    offset: float = 0.0
    inertia: float = 0.0
    spring: float = 0.0
    rotational_spring: float = 0.0
    coupling: float = 0.0
    holds: tuple[int, ...] = ()
    compliance: float = 0.0
    own_load: float = 0.0
    dashpot: float = 0.0
    rotational_dashpot: float = 0.0
    feedback: tuple[float, float, float, float] | None = None
    feedback_damping: tuple[float, float, float, float] | None = None
    pedestal: Pedestal | None = None

    @property
    def feeds_back(self) -> bool:
        """Whether a feedback acts here."""
        return self.feedback is not None or self.feedback_damping is not None

    @property
    def damps(self) -> bool:
        """Whether a dashpot acts here."""
        return self.dashpot != 0.0 or self.rotational_dashpot != 0.0

    @property
    def off_ground(self) -> Point:
        """The same without what ties it to the ground: a mass and a joint."""
        return Point(
            self.node,
            self.mass,
            self.offset,
            self.inertia,
            compliance=self.compliance,
            own_load=self.own_load,
        )

    @property
    def static_spring(self) -> float:
        """What holds the displacement at rest [N/m]: the spring, and a pedestal on the ground."""
        own = self.pedestal
        return self.spring + (0.0 if own is None else float(own.stiffness(0.0)))

    @property
    def hung(self) -> float:
        """Mass that hangs on a spring and moves along with a rigid motion [kg]."""
        own = self.pedestal
        return own.mass if own is not None and own.lower == 0 else 0.0

    @property
    def loads(self) -> bool:
        """Whether a mass or a finite spring acts here."""
        springs = (self.spring, self.rotational_spring, self.coupling)
        values = (self.mass, self.inertia, *springs)
        return self.pedestal is not None or any(value != 0.0 for value in values)


def lateral_load(point: Point, omega2: Array) -> Array:
    """Return the step of a mass with springs in bending, shape (k, 4, 4)."""
    T = np.tile(np.eye(4, dtype=np.result_type(omega2, 1.0)), (len(omega2), 1, 1))
    m, d, J = point.mass, point.offset, point.inertia
    T[:, 3, 0] = omega2 * m - point.spring
    if point.pedestal is not None:
        T[:, 3, 0] -= point.pedestal.stiffness(omega2)
    T[:, 3, 1] = omega2 * m * d - point.coupling
    T[:, 2, 0] = -omega2 * m * d + point.coupling
    T[:, 2, 1] = -omega2 * (m * d * d + J) + point.rotational_spring + point.own_load * d
    if point.feedback is not None:
        for (row, column, sign), K in zip(_FEEDBACK, point.feedback, strict=True):
            T[:, row, column] += sign * K
    return T


_FEEDBACK = (3, 0, -1), (3, 1, -1), (2, 0, 1), (2, 1, 1)


def lateral_joint(point: Point, lanes: int) -> Array:
    """Return the step of a joint in bending, shape (lanes, 4, 4)."""
    T = np.tile(np.eye(4), (lanes, 1, 1))
    T[:, 1, 2] = point.compliance
    return T


def lateral_energies(
    point: Point, state: Array, last: bool, moved: Array | float = 0.0
) -> tuple[Array, Array]:
    """Return a point's shares of modal mass and stiffness in bending.

    Parameters
    ----------
    state : array, shape (k, 4)
        On its right side, where a joint has turned already; at the `last` node on its left.
    moved : array, shape (k,), optional
        Of the mass of a pedestal.
    """
    Y, theta, M, _ = state.T
    turn = theta if last else theta - point.compliance * M
    inertia = point.mass * (Y + point.offset * turn) ** 2 + point.inertia * turn**2
    if point.pedestal is not None:
        x, own = moved, point.pedestal
        inertia = inertia + own.mass * x**2
        held = own.upper * (Y - x) ** 2 + own.lower * x**2
        return inertia, held + _elastic(point, Y, turn, M)
    return inertia, _elastic(point, Y, turn, M)


def _elastic(point: Point, Y: Array, turn: Array, M: Array) -> Array:
    """Return what springs and joint store, twice."""
    rotational = point.rotational_spring + point.own_load * point.offset
    springs = point.spring * Y**2 + 2 * point.coupling * Y * turn + rotational * turn**2
    return np.asarray(springs + point.compliance * M**2)


def wave_load(point: Point, omega2: Array, sign: float) -> Array:
    """Return the step of a mass with its spring along one freedom, shape (k, 2, 2)."""
    T = np.tile(np.eye(2, dtype=np.result_type(omega2, 1.0)), (len(omega2), 1, 1))
    T[:, 1, 0] = sign * (point.spring - omega2 * point.mass)
    return T


def wave_joint(point: Point, lanes: int, sign: float) -> Array:
    """Return the step of a joint along one freedom, shape (lanes, 2, 2)."""
    T = np.tile(np.eye(2), (lanes, 1, 1))
    T[:, 0, 1] = sign * point.compliance
    return T


def wave_energies(point: Point, state: Array, last: bool, sign: float) -> tuple[Array, Array]:
    """Return a point's shares of modal mass and stiffness; states (k, 2) as `lateral_energies`."""
    u, F = state.T
    if not last:
        u = u - sign * point.compliance * F
    return point.mass * u**2, point.spring * u**2 + point.compliance * F**2


@dataclass(frozen=True)
class MovingPoint(Point):
    """A point at complex s: its springs with what dashpots and feedback add there, by lanes."""

    @property
    def loads(self) -> bool:
        """Whether anything acts here: that may depend on the lane."""
        return True


def moving(point: Point, s: Array | Complex) -> MovingPoint:
    """Return a point as it acts on motion ``exp(s t)``: dashpots and feedback beside its springs.

    Parameters
    ----------
    s : array of complex, shape (k,)
        [1/s].
    """
    values: dict[str, Any] = vars(point) | {
        "spring": point.spring + s * point.dashpot,
        "rotational_spring": point.rotational_spring + s * point.rotational_dashpot,
    }
    if point.feeds_back:
        K, C = point.feedback or _NONE, point.feedback_damping or _NONE
        values["feedback"] = tuple(k + s * c for k, c in zip(K, C, strict=True))
    return MovingPoint(**values)


_NONE = (0.0, 0.0, 0.0, 0.0)
