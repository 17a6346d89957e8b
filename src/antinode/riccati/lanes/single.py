"""One chain in compiled code: evaluations and root searches."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import Chain, Evaluation
from antinode.riccati.reasons import TABLE_TOO_SMALL

from .laws import FORMS
from .library import library
from .scratch import scratch
from .workspace import NO_MORE, POINT, Task, new_chain, new_roots


class Found(NamedTuple):
    """Consecutive eigenvalues of one chain, each with its certificate [rad^2/s^2]."""

    reason: int
    omega2: Array
    low: Array
    high: Array
    counts: Integers
    rounding: Array
    evaluations: int


def more_columns(chain: Chain) -> Array:
    """Return what segments have besides as the rows of `workspace.Chain.more`."""
    if chain.is_plain:
        return NO_MORE
    none = np.zeros(len(chain.length))
    return np.stack([chain.columns.get(name, none) for name in chain.law.more])


class SingleChain:
    """One chain made dimensionless, ready for evaluations and root searches.

    Parameters
    ----------
    chain : Chain
        Without supports that need frames.
    """

    def __init__(self, chain: Chain) -> None:
        form, n = FORMS[chain.law], len(chain.length)
        self.sign = form.sign(chain.left, chain.right)
        ends = form.ends[chain.left], form.ends[chain.right]
        number = form.number if chain.is_plain else form.with_more
        own = new_chain(number, *ends, n, not chain.is_plain)
        own.more[:] = more_columns(chain)
        own.length[:], own.mass[:], own.stiffness[:] = chain.length, chain.mass, chain.stiffness
        if chain.law.has_axial_force:
            own.force[:] = chain.axial_force
        units = np.empty(4)
        library().call("scale", own, units)
        self.unit, L, m0, stiffness = units.tolist()
        own.following[:] = np.array(chain.following) * (L * L / stiffness)
        self.follows = chain.follows
        if chain.points:
            own.marks[[point.node for point in chain.points]] = np.arange(len(chain.points))
            rows = np.array([form.point(point, L, stiffness, m0) for point in chain.points])
            own = own._replace(points=rows.reshape(-1, POINT))
        self.chain = own

    def __call__(self, omega2: Array) -> Evaluation:
        """Evaluate the chain at every omega^2 [rad^2/s^2]."""
        scaled, columns = omega2 / self.unit, len(self.chain.length)
        largest = float(np.max(np.abs(scaled)))
        while True:
            table = scratch.table(columns)
            pieces = library().call("prepare", self.chain, largest, table)[0]
            if pieces <= table.shape[1]:
                break
            columns = pieces
        if pieces < 0:
            worst = float(np.max(np.abs(omega2)))
            raise FloatingPointError(f"omega^2 = {worst:g} is out of reach for this chain")
        count, value = np.empty(len(scaled), np.int64), np.empty(len(scaled))
        library().call("evaluate", self.chain, scaled, table, scratch.lanes, count, value)
        return Evaluation(count * 0 - 1 if self.follows else count, self.sign * value)

    def roots(self, below: int, number: int, width: float) -> Found:
        """Bracket and certify eigenvalues below + 1 ... below + number.

        Parameters
        ----------
        width : float
            Relative width of the brackets in omega^2.
        """
        task, found, search = Task(below, width, True), new_roots(number), scratch.search(number)
        columns = len(self.chain.length) + 8
        while True:
            reason, total, _ = library().call(
                "find_roots",
                *(self.chain, task, False, 0.0, found),
                *(scratch.table(columns), scratch.lanes, search),
            )
            if reason != TABLE_TOO_SMALL:
                break
            columns = total
        omega2, low, high, rounding = (
            self.unit * v for v in (found.omega2, found.low, found.high, found.rounding)
        )
        return Found(reason, omega2, low, high, found.counts, rounding, total)
