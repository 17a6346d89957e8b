"""Half-segments of intervals in which something varies, compiled: what `Beam.chain` makes.

Each step of an interval is two uniform half-segments whose 1/EI, m and N are averages of the values
at its two Gauss points with weights 1/2 +- sqrt(3)/3, the larger for the nearer point.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

GAUSS = 0.5 - math.sqrt(3) / 6
NEAR = 0.5 + math.sqrt(3) / 3
_MOST = 4096  # coarsest steps

_OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}
_compiled = numba.njit(**_OPTIONS)


@_compiled
def _at(a, b, t, log):
    return a * (b / a) ** t if log else a + (b - a) * t


@_compiled
def _coarsest(x, m, EI, varies, log, steepest, longest, halvings, interval, start, size):
    """Halve steps in which something varies until none is steep or long; return their number."""
    number = len(x) - 1
    for k in range(number):
        interval[k], start[k], size[k] = k, 0.0, 1.0
    phase, steep = np.empty(len(interval)), np.empty(len(interval))
    for _ in range(halvings):
        total = 0.0
        for i in range(number):
            k, left, right = interval[i], start[i], start[i] + size[i]
            ma, mb = _at(m[k, 0], m[k, 1], left, log), _at(m[k, 0], m[k, 1], right, log)
            sa, sb = _at(EI[k, 0], EI[k, 1], left, log), _at(EI[k, 0], EI[k, 1], right, log)
            steep[i] = max(ma / mb, mb / ma, sa / sb, sb / sa)
            wave = math.sqrt(math.sqrt(ma * mb) / math.sqrt(sa * sb))
            phase[i] = math.sqrt(wave) * (x[k + 1] - x[k]) * size[i]
            total += phase[i]
        more = 0
        for i in range(number):
            coarse = steep[i] > steepest or phase[i] > longest * total
            steep[i] = 1.0 if coarse and varies[interval[i]] else 0.0
            more += int(steep[i])
        if more == 0 or number + more > len(interval):
            return number if more == 0 else -1
        to = number + more - 1
        for i in range(number - 1, -1, -1):
            k, left, whole = interval[i], start[i], size[i]
            if steep[i] == 1.0:
                interval[to], start[to], size[to] = k, left + whole / 2, whole / 2
                interval[to - 1], start[to - 1], size[to - 1] = k, left, whole / 2
                to -= 2
            else:
                interval[to], start[to], size[to] = k, left, whole
                to -= 1
        number += more
    return number


@_compiled
def _fill(x, m, EI, N, varies, log, interval, start, size, number, refinement, own):
    """Set h, m, EI and N of all segments; return their number."""
    i = 0
    for s in range(number):
        k = interval[s]
        dx = x[k + 1] - x[k]
        if not varies[k]:
            own[0, i], own[1, i] = dx * size[s], m[k, 0]
            own[2, i], own[3, i] = EI[k, 0], N[k, 0]
            i += 1
            continue
        step = size[s] / refinement
        for r in range(refinement):
            t1 = start[s] + step * (r + GAUSS)
            t2 = start[s] + step * (r + 1.0 - GAUSS)
            m1, m2 = _at(m[k, 0], m[k, 1], t1, log), _at(m[k, 0], m[k, 1], t2, log)
            f1 = 1.0 / _at(EI[k, 0], EI[k, 1], t1, log)
            f2 = 1.0 / _at(EI[k, 0], EI[k, 1], t2, log)
            n1 = N[k, 0] + (N[k, 1] - N[k, 0]) * t1
            n2 = N[k, 0] + (N[k, 1] - N[k, 0]) * t2
            for half in range(2):
                w = NEAR if half == 0 else 1.0 - NEAR
                own[0, i], own[1, i] = dx * step / 2, w * m1 + (1.0 - w) * m2
                own[2, i] = 1.0 / (w * f1 + (1.0 - w) * f2)
                own[3, i] = w * n1 + (1.0 - w) * n2
                i += 1
    return i


class Halves:
    """The coarsest steps of one beam, and its segments for any refinement.

    Parameters
    ----------
    x : array, shape (n + 1,)
    m, EI, N : array, shape (n, 2)
        At both ends of every interval; N is linear between them.
    varies : array of bool, shape (n,)
    log : bool
        Whether m and EI vary logarithmically, or linearly.
    limits : tuple
        Steepest ratio over a step, longest share of the phase, and most halvings.

    Raises
    ------
    OverflowError
        If more steps are needed than fit.
    """

    def __init__(
        self,
        x: Array,
        m: Array,
        EI: Array,
        N: Array,
        varies: npt.NDArray[np.bool_],
        log: bool,
        limits: tuple[float, float, int],
    ) -> None:
        most = _MOST + len(x)
        self.tables = tuple(np.array(values, dtype=float) for values in (x, m, EI, N))
        self.varies, self.log = varies, log
        self.steps = np.empty(most, np.int64), np.empty(most), np.empty(most)
        x, m, EI, _ = self.tables
        self.number = _coarsest(x, m, EI, varies, log, *limits, *self.steps)
        if self.number < 0:
            raise OverflowError("too many steps")

    def segments(self, refinement: int) -> Array:
        """Return h, m, EI and N of the segments, shape (4, n)."""
        own = np.empty((4, 2 * self.number * refinement))
        n = _fill(*(*self.tables, self.varies, self.log, *self.steps, self.number, refinement, own))
        return own[:, :n]
