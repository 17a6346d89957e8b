r"""The characteristic function of a chain as an entire function of z = s or omega^2, in balls.

Each segment takes the states by ``exp(h A(z))``, each mass, spring, dashpot and joint by a matrix
T(z); A and T are polynomials in z. Values are exact up to the radii of their balls (python-flint,
Johansson, IEEE Trans. Comput. 66 (2017) 1281). Where ``abs(z) <= r``, with the absolute values
of all coefficients, and with r for z, the same steps bound every entry, and the function.

A pedestal is a spring ``n(z)/g(z)``, of rank one: g D is the sum of g times D without it, and of n
times D as where a support holds the node. These are two branches, and have no pole.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields, replace
from typing import Any, Literal

import numpy as np

from antinode.extras import import_extra
from antinode.riccati.chain import state_units
from antinode.riccati.damped.chain import Damped
from antinode.riccati.points import Pedestal, Point, moving

Variable = Literal["s", "omega2"]
Ball = Any
"""A real or complex ball of python-flint, or a matrix or polynomial of them."""


@contextmanager
def precision(flint: Any, bits: int) -> Iterator[None]:
    """Let balls be computed with so many bits."""
    before = flint.ctx.prec
    flint.ctx.prec = bits
    try:
        yield
    finally:
        flint.ctx.prec = before


class Characteristic:
    """D(z) of a chain, at the precision that holds when it is made.

    Parameters
    ----------
    damped : Damped
        Uniform segments with all that acts on them; with loss its columns are complex.
    variable : {"s", "omega2"}
        What z is; omega^2 only where nothing depends on velocity.
    omega2 : float
        About as large as it gets [rad^2/s^2]: it scales the states.
    """

    def __init__(self, damped: Damped, variable: Variable, omega2: float) -> None:
        self.flint = import_extra("flint", "prove")
        self.chain, self.variable = damped.chain, variable
        self.law = damped.chain.law
        self.real = damped.columns is None
        """Whether conjugate z have conjugate values."""
        units = state_units(self.chain, np.array([max(omega2, 1e-300)]))[0]
        self._units = [self.flint.arb(float(u)) for u in units]
        self._matrices = self._segments(damped.columns or self.chain.columns)
        self._points = {point.node: self._steps(point) for point in damped.points}
        self._joints = {p.node: [self._joint(p)] for p in damped.points if p.compliance}
        self._pedestals = {p.node: self._pedestal(p.pedestal) for p in damped.points if p.pedestal}

    def __call__(self, z: Ball) -> Ball:
        """Return D(z)."""
        passed = self._passed([1, z, z * z], bounding=False)
        return sum((factor * self._end(frame).det() for frame, factor in passed), self.flint.acb(0))

    def bound(self, r: Ball) -> Ball:
        """Return what abs(D) does not exceed where abs(z) <= r."""
        passed = self._passed([1, r, r * r], bounding=True)
        parts = (factor * _permanent(self._end(frame)) for frame, factor in passed)
        return sum(parts, self.flint.acb(0)).abs_upper()

    def _passed(self, powers: list[Ball], *, bounding: bool) -> list[tuple[Ball, Ball]]:
        """Return states at the right end, and factors of what supports cut off, by branches."""
        branches = [(self._start(), self.flint.acb(1))]
        known: dict[int, Ball] = {}
        for node in range(len(self.chain.length) + 1):
            for held, T in self._points.get(node, ()):
                if held:
                    cut = [(*self._hold(frame, held, bounding), f) for frame, f in branches]
                    branches = [(frame, f * own) for frame, own, f in cut]
                else:
                    step = self._sum(T, powers, bounding)
                    branches = [(step * frame, f) for frame, f in branches]
            if node in self._pedestals:
                g, n = (self._value(part, powers, bounding) for part in self._pedestals[node])
                pulled = [(*self._hold(frame, (0,), bounding), f) for frame, f in branches]
                branches = [(frame, f * g) for frame, f in branches]
                branches += [(frame, f * own * n) for frame, own, f in pulled]
            for T in self._joints.get(node, ()):
                branches = [(T * frame, f) for frame, f in branches]
            if node < len(self.chain.length):
                kind, polynomial = self._matrices[node]
                if kind not in known:
                    known[kind] = self._sum(polynomial, powers, bounding).exp()
                branches = [(known[kind] * frame, f) for frame, f in branches]
        return branches

    def _value(self, part: list[Ball], powers: list[Ball], bounding: bool) -> Ball:
        """Return a polynomial of numbers, or what it does not exceed."""
        own = [abs(c) for c in part] if bounding else part
        return sum((c * power for c, power in zip(own, powers, strict=True)), self.flint.acb(0))

    def _pedestal(self, pedestal: Pedestal) -> tuple[list[Ball], list[Ball]]:
        """Return g and -n of a pedestal as polynomials, scaled; a support turns the sign of n."""
        arb = self.flint.arb
        m, k1, k2 = (arb(v) for v in pedestal)
        unit = self._units[0] / self._units[-1]
        below, above = (k1 + k2, -m), (-k1 * k2 * unit, k1 * m * unit)
        if self.variable == "omega2":
            return [*below, arb(0)], [*above, arb(0)]
        return [below[0], arb(0), -below[1]], [above[0], arb(0), -above[1]]

    def _sum(self, polynomial: list[Ball], powers: list[Ball], bounding: bool) -> Ball:
        """Return a polynomial whose coefficients are matrices, or their absolute values."""
        total, *rest = map(self._size, polynomial) if bounding else polynomial
        for power, T in zip(powers[1:], rest, strict=False):
            total = total + T * power
        return total

    def _size(self, T: Ball) -> Ball:
        """Return bounds on the absolute values of a matrix."""
        entries = [entry.abs_upper() for entry in T.entries()]
        return self.flint.acb_mat(T.nrows(), T.ncols(), entries)

    def _matrix(self, rows: Any, scale: Any = 1) -> Ball:
        """Return a matrix of SI rows in scaled units, times a number."""
        u, size = self._units, self.law.size
        entries = [
            self.flint.acb(rows[i][j]) * u[j] / u[i] * scale
            for i in range(size)
            for j in range(size)
        ]
        return self.flint.acb_mat(size, size, entries)

    def _segments(self, columns: Any) -> list[tuple[int, list[Ball]]]:
        """Return a number and the polynomial h A(z) of every segment; equal ones share both."""
        flint, names = self.flint, list(columns)
        known: dict[Any, tuple[int, list[Ball]]] = {}
        found = []
        for k, length in enumerate(self.chain.length.tolist()):
            values = tuple(columns[name][k].item() for name in names)
            if (length, values) not in known:
                own = {n: flint.acb(v) for n, v in zip(names, values, strict=True)}
                A0, A1 = (self._matrix(self.law.rates(own, flint.acb(w)), length) for w in (0, 1))
                of_omega2 = A1 - A0
                zero = of_omega2 * 0
                by_s = [A0, zero, -of_omega2]
                polynomial = [A0, of_omega2] if self.variable == "omega2" else by_s
                known[length, values] = len(known), polynomial
            found.append(known[length, values])
        return found

    def _steps(self, point: Point) -> list[tuple[tuple[int, ...], list[Ball]]]:
        """Return what is held, or a polynomial T(z), of the steps of a point before its joint."""
        point = replace(point, pedestal=None)
        steps: list[tuple[tuple[int, ...], list[Ball]]] = []
        if point.holds:
            steps.append((point.holds, []))
        exact = self._in_balls(point)
        if point.loads or point.damps or point.feeds_back:
            steps.append(((), self._load(exact)))
        return steps

    def _joint(self, point: Point) -> Ball:
        """Return the matrix of a joint."""
        T = np.eye(self.law.size)
        unit, given = T.tolist(), self.law.joint(replace(point, compliance=1.0), 1)[0]
        change = self._matrix((given - T).tolist(), self.flint.arb(point.compliance))
        return self._matrix(unit) + change

    def _load(self, point: Point) -> list[Ball]:
        """Return the step of masses, springs, dashpots and feedback as a polynomial."""

        def at(z: int) -> Ball:
            s = np.array([self.flint.acb(z)], dtype=object)
            if self.variable == "omega2":
                return self._matrix(self.law.load(point, s)[0])
            return self._matrix(self.law.load(moving(point, s), -s * s)[0])

        T0, T1, other = at(0), at(1), at(-1)
        half = self.flint.arb(0.5)
        return [T0, (T1 - other) * half, (T1 + other) * half - T0]

    def _in_balls(self, point: Point) -> Point:
        """Return a point with exact balls for its numbers."""
        new: dict[str, Any] = {}
        for field in fields(Point):
            value = getattr(point, field.name)
            if isinstance(value, float):
                new[field.name] = self.flint.arb(value)
            elif isinstance(value, tuple) and field.name.startswith("feedback"):
                new[field.name] = tuple(self.flint.arb(float(v)) for v in value)
        return replace(point, **new)

    def _start(self) -> Ball:
        """Return the states that the left end admits."""
        zeros = self.law.zeros(self.chain.left)
        free = [i for i in range(self.law.size) if i not in zeros]
        entries = [int(i == j) for i in range(self.law.size) for j in free]
        return self.flint.acb_mat(self.law.size, len(free), entries)

    def _end(self, frame: Ball) -> Ball:
        """Return what the right end wants to vanish."""
        rows = self.law.zeros(self.chain.right)
        entries = [frame[i, j] for i in rows for j in range(frame.ncols())]
        return self.flint.acb_mat(len(rows), frame.ncols(), entries)

    def _hold(self, frame: Ball, rows: tuple[int, ...], bounding: bool) -> tuple[Ball, Ball]:
        """Pass a support: the states with these displacements zero and their reactions free."""
        flint, size, d = self.flint, frame.nrows(), frame.ncols()
        if len(rows) == d:
            top = flint.acb_mat(d, d, [frame[i, j] for i in range(d) for j in range(d)])
            new = flint.acb_mat(size, d, [int(i == d + j) for i in range(size) for j in range(d)])
            return new, _permanent(top) if bounding else top.det()
        row, sign = rows[0], 1 if bounding else -1
        force, a, b = size - 1 - row, frame[row, 1], frame[row, 0]
        own = [frame[i, 0] * a + sign * (frame[i, 1] * b) for i in range(size)]
        own[row] = own[force] = flint.acb(0)
        entries = [v for i in range(size) for v in (own[i], int(i == force))]
        return flint.acb_mat(size, d, entries), flint.acb(1)


def _permanent(T: Ball) -> Ball:
    """Return the permanent of a matrix of one or two rows."""
    return T[0, 0] if T.nrows() == 1 else T[0, 0] * T[1, 1] + T[0, 1] * T[1, 0]
