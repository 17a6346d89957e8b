"""Mass along an axis, with exact integrals, and parts that add to it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from antinode.arrays import Array, Interpolation
from antinode.inputs.columns import Column, finite, increasing
from antinode.inputs.units import Frozen

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2


@dataclass(frozen=True, eq=False)
class MassDistribution:
    """Mass per length along the axis, with exact integrals.

    Parameters
    ----------
    x : ndarray (n+1,)
        Bounds of the intervals [m].
    ends : ndarray (n, 2)
        Mass per length at both ends of each interval [kg/m].
    interpolation : {"step", "linear", "log"}
        How it runs between the ends.
    """

    x: Array
    ends: Array
    interpolation: Interpolation

    def __add__(self, other: MassDistribution) -> MassDistribution:
        """Return the sum of two distributions, each zero outside its own range.

        Raises
        ------
        ValueError
            If one is logarithmic: the sum would not be.
        """
        kinds = {self.interpolation, other.interpolation}
        if "log" in kinds:
            raise ValueError("masses interpolated by 'log' cannot be added: use step or linear")
        x = np.union1d(self.x, other.x)
        how: Interpolation = "step" if kinds == {"step"} else "linear"
        return MassDistribution(x, self.between(x) + other.between(x), how)

    def between(self, x: Array) -> Array:
        """Return the mass per length at both ends of the intervals between `x`, (n, 2) [kg/m]."""
        middle = (x[:-1] + x[1:]) / 2
        k = np.clip(np.searchsorted(self.x, middle) - 1, 0, len(self.ends) - 1)
        size = self.x[k + 1] - self.x[k]
        a, b = self.ends[k].T
        sides = []
        for points in (x[:-1], x[1:]):
            t = (points - self.x[k]) / size
            sides.append(a * (b / a) ** t if self.interpolation == "log" else a + (b - a) * t)
        inside = (middle > self.x[0]) & (middle < self.x[-1])
        return np.where(inside[:, None], np.stack(sides, axis=1), 0.0)

    def at(self, x: Array) -> Array:
        """Return the mass per length at `x` [kg/m]; aft of the step where it jumps."""
        k = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.ends) - 1)
        a, b = self.ends[k].T
        t = (x - self.x[k]) / (self.x[k + 1] - self.x[k])
        return np.asarray(a * (b / a) ** t if self.interpolation == "log" else a + (b - a) * t)

    def moments(self, x: ArrayLike) -> Array:
        """Return the integrals of m, m x and m x^2 from the nose to `x`.

        Parameters
        ----------
        x : array_like
            Where the integrals end [m].

        Returns
        -------
        ndarray (3, ...)
            Mass [kg], first moment [kg m] and second moment [kg m^2] about the nose.
        """
        x = np.asarray(x, dtype=float)
        k = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.ends) - 1)
        return self._table[:, k] + self._partial(k, x - self.x[k])

    @cached_property
    def _table(self) -> Array:
        """Moments at the bounds of the intervals, (3, n+1)."""
        each = self._partial(np.arange(len(self.ends)), np.diff(self.x))
        return np.concatenate([np.zeros((3, 1)), np.cumsum(each, axis=1)], axis=1)

    def _partial(self, k: NDArray[np.intp], s: Array) -> Array:
        """Moments about the nose of the first `s` metres of the intervals `k`."""
        J0, J1, J2 = self._log(k, s) if self.interpolation == "log" else self._polynomial(k, s)
        x = self.x[k]
        return np.stack([J0, x * J0 + J1, x * x * J0 + 2 * x * J1 + J2])

    def _polynomial(self, k: NDArray[np.intp], s: Array) -> list[Array]:
        a = self.ends[k, 0]
        b = (self.ends[k, 1] - a) / (self.x[k + 1] - self.x[k])
        return [a * s ** (p + 1) / (p + 1) + b * s ** (p + 2) / (p + 2) for p in range(3)]

    def _log(self, k: NDArray[np.intp], s: Array) -> list[Array]:
        a, ratio = self.ends[k, 0], self.ends[k, 1] / self.ends[k, 0]
        t = s[..., None] * _NODES
        m = a[..., None] * ratio[..., None] ** (t / (self.x[k + 1] - self.x[k])[..., None])
        return [s * np.sum(_WEIGHTS * m * t**p, axis=-1) for p in range(3)]


class MassTable(Frozen):
    """A part that adds mass along some of the length, such as a tank: `[[...masses]]`."""

    name: str = Field(default="part", max_length=200, description="what it is")
    interpolation: Literal["step", "linear"] = Field(
        default="step", description="how mass_per_length runs between its rows"
    )
    x: Annotated[Array, Column("m")] = Field(description="position [m], increasing")
    mass_per_length: Annotated[Array, Column("kg/m")] = Field(
        description="added mass per length [kg/m], at least 0"
    )
    burns: bool = Field(
        default=False, description="whether it vanishes with burn_fraction (a vehicle's fuel)"
    )

    @model_validator(mode="after")
    def _check_table(self) -> Self:
        increasing(self.x)
        m = self.mass_per_length
        if len(m) != len(self.x):
            raise ValueError(f"mass_per_length has {len(m)} rows, but x has {len(self.x)}")
        finite("mass_per_length", m)
        for i in np.flatnonzero(m < 0)[:1]:
            raise ValueError(f"mass_per_length, row {i + 1}: received {m[i]:g}; must be at least 0")
        return self

    def distribution(self, burn_fraction: float = 0.0) -> MassDistribution:
        """Return the mass along the axis."""
        m = self.mass_per_length * ((1 - burn_fraction) if self.burns else 1.0)
        after = m[:-1] if self.interpolation == "step" else m[1:]
        return MassDistribution(self.x, np.stack([m[:-1], after], axis=1), self.interpolation)


def check_on_body(masses: tuple[MassTable, ...], start: float, end: float, how: str) -> None:
    """Raise ValueError unless every part lies on the body and can be added to its table."""
    for part in masses:
        if part.x[0] < start or part.x[-1] > end:
            raise ValueError(
                f"the part '{part.name}' runs from {part.x[0]:g} to {part.x[-1]:g} m, but the body "
                f"from {start:g} to {end:g} m: correct its x"
            )
        if how == "log":
            raise ValueError("parts cannot be added to a table with interpolation = 'log'")
