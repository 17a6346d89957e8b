r"""Eigenvalues inside a circle by their sums of powers: smooth where they meet, and past it.

The characteristic function D of a chain is entire in omega^2, with real coefficients. On a circle
about c that holds n of its zeros z_i and keeps off the others, with ``t = lambda - c``,

    log(D / t^n) = sum_i log(1 - (z_i - c)/t) + what is analytic inside,

so that the coefficient of ``t^-k`` of its Laurent series is ``-s_k/k`` with the sums of powers
``s_k = sum_i (z_i - c)^k``. The trapezoidal rule finds it to rounding: its error falls as the 2m-th
power of how far the zeros are off the circle. n is the number of turns of D. Of one zero s_1 tells
where it is; of two ``2 s_2 - s_1^2 = (z_1 - z_2)^2`` tells whether they are real or a pair. Both
are analytic in whatever the chain depends on, also where the zeros meet and are not.

D is the determinant of the last frame times those of all changes of basis (`riccati.chain`), in
units that do not depend on omega^2.

Delves and Lyness, Math. Comp. 21 (1967) 543.
"""

from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np

from antinode.arrays import Array
from antinode.riccati.arrays import Complex
from antinode.riccati.chain import (
    Chain,
    block_starts,
    characteristic,
    end_frame,
    multiply_groups,
    point_steps,
    split_long,
)
from antinode.riccati.frames import hold, orthonormalise
from antinode.riccati.laws import Units

POINTS = 32
"""On half a circle."""


class Sums(NamedTuple):
    """What a circle holds."""

    centre: float
    radius: float
    number: int
    """Zeros inside, with multiplicity."""
    first: float
    """Sum of their distances from the centre."""
    second: float
    """Sum of the squares of these."""
    rounding: float
    """Of the sums, in the radius and its square: what is left where nothing should be."""

    @property
    def apart(self) -> float:
        """Square of the distance of two zeros; negative of a pair."""
        return 2 * self.second - self.first**2


def sums(chain: Chain, centre: float, radius: float, points: int = POINTS) -> Sums:
    """Return the sums of powers of the eigenvalues inside a circle on the real axis.

    Parameters
    ----------
    chain : Chain
    centre, radius : float
        [rad^2/s^2].
    points : int
        On half a circle; the other half is conjugate.
    """
    angle = math.pi * (np.arange(points) + 0.5) / points
    t = np.exp(1j * angle)
    logarithm = _log_characteristic(chain, centre + radius * t)
    phase = np.unwrap(logarithm.imag)
    start, end = (1.5 * phase[i] - 0.5 * phase[j] for i, j in ((0, 1), (-1, -2)))
    turns = (end - start) / math.pi
    number = round(float(turns)) if math.isfinite(turns) else 0
    phase = phase - math.pi * np.round(start / math.pi) - number * angle
    rest = logarithm.real - np.mean(logarithm.real) + 1j * phase
    first, second, far = (-k * float(np.mean((rest * t**k).real)) for k in (1, 2, points - 1))
    return Sums(centre, radius, number, first * radius, second * radius**2, abs(far) / points)


def _log_characteristic(chain: Chain, omega2: Complex) -> Complex:
    """Return the logarithm of the characteristic function, up to a constant; shape (k,)."""
    largest = float(np.max(np.abs(omega2)))
    fine = split_long(chain, largest)
    starts, lanes = block_starts(fine, largest), len(omega2)
    scale = np.full(lanes, fine.scale_length(np.array([largest]))[0])
    unit = Units(scale, fine.reference[0])
    units = fine.law.state_units(unit)
    columns = {name: values[:, None] for name, values in fine.columns.items()}
    law, at_omega2 = fine.law, cast(Array, omega2)
    U = multiply_groups(law.transfer(fine.length[:, None], columns, at_omega2, unit), starts)
    at = {point.node: point for point in fine.points}
    total = np.zeros(lanes, complex)
    F = cast(Array, end_frame(fine, 0, units).astype(complex))
    for k, node in enumerate([*starts.tolist(), len(fine.length)]):
        for _, step, held in point_steps(law, at[node], at_omega2, units) if node in at else ():
            F, more = _passed(F, step, held)
            total = total + more
        if k < len(starts):
            F, more = _passed(F, U[k], ())
            total = total + more
    return np.asarray(total + np.log(characteristic(fine, F, units)))


def _passed(F: Array, U: Array, held: tuple[int, ...]) -> tuple[Array, Complex]:
    """Pass a frame through a step; return it with the logarithm of what it lost in size."""
    if not held:
        F, R = orthonormalise(U @ F)
        return F, np.asarray(np.sum(np.log(np.diagonal(R, axis1=-2, axis2=-1)), axis=-1))
    before = F
    F, back, factor = hold(F, held)
    if len(held) == before.shape[-1]:
        return F, np.log(factor.astype(complex))
    row = held[0]
    own = np.hypot(np.abs(before[:, row, 0]), np.abs(before[:, row, 1]))
    kept = np.sqrt(np.sum(np.abs(back[:, :, 0]) ** 2, axis=-1))
    return F, np.log((own / kept).astype(complex))
