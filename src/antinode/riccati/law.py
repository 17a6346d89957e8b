"""What the solver must know of one kind of vibration: `Law`, the pattern of `riccati.laws`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from .arrays import Array, Integers
from .points import Point

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
    turn: Array
    """of psi^2 [m]; zero where there is one freedom"""
    moment: Array
    """of M^2 or T^2 [N^2 m^3], or Q_x^2 [N^2 m]"""
    shear: Array
    """of (Q - N psi)^2 [N^2 m], of the shear force along the section (M' without rotary inertia);
    zero where there is one freedom"""
    force: Array
    """of Q^2 [N^2 m]; zero where there is one freedom"""


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
        That a segment must have, `mass` and `stiffness` first.
    more : tuple of str
        That it may have besides; zero where they are not given.
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
    more: tuple[str, ...] = ()
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

    def negative_in_blocks(
        self, U: Array, here: Array, after: Array, R: Array, changes: npt.NDArray[np.bool_]
    ) -> Integers:
        """Count the negative eigenvalues met where the left nodes of blocks are condensed, (k,).

        Parameters
        ----------
        U : array, shape (blocks, k, s, s)
        here, after : array, shape (blocks, k, s, d)
            Frames at the two nodes of each block.
        R : array, shape (blocks, k, d, d)
            Change of basis behind it.
        changes : array of bool, shape (blocks, k)
            Whether det A changes its sign between them.
        """
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
    def rates(self, column: Mapping[str, Any], omega2: Any) -> list[list[Any]]:
        """Return A of ``z' = A z`` in SI, row by row, from numbers of any kind; of first degree."""

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
    def slope(self, columns: Columns, z: Array) -> Array:
        """Return the derivative of the displacement along the axis, shape z.shape[:-1]."""

    @abstractmethod
    def squares(self, columns: Columns, z: Array) -> Array:
        """Return what `Squares` integrates, of states (n, k, s), shape (5, n, k)."""

    @abstractmethod
    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return the quadratic forms of the segments."""

    @abstractmethod
    def densities(self, columns: Columns, z: Array, omega2: float) -> dict[str, Array]:
        """Return twice the energies per length by name, as `forms` sums them.

        Parameters
        ----------
        columns : mapping
            Of the segments.
        z : array, shape (segments, points, components)
        omega2 : float
        """

    @abstractmethod
    def point_energies(
        self, point: Point, state: Array, last: bool, moved: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Return a point's shares of modal mass and stiffness, from states (k, s) on its right.

        `moved` is the displacement of the mass of its pedestal, shape (k,).
        """


def softest(columns: Columns, starts: Integers) -> dict[str, Array]:
    """Return the least stiffness and the most mass of each block."""
    return {
        "mass": np.maximum.reduceat(columns["mass"], starts),
        "stiffness": np.minimum.reduceat(columns["stiffness"], starts),
    }
