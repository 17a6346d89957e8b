"""One freedom that obeys the wave equation: a bar along its axis, a shaft about it (eq. 48)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import Array, Integers
from .law import Columns, Forms, Law, LawName, Squares, Units, softest
from .points import Point, wave_energies, wave_joint, wave_load
from .segment import wave_transfer

if TYPE_CHECKING:
    from .chain import Chain

_ENDS: Mapping[str, tuple[int, ...]] = {"free": (), "fixed": (0,)}


class Wave(Law):
    """One freedom u with the force ``F = sign K u'`` and ``F' = -sign m omega^2 u`` (equation 48).

    The bar's Q counts compression positive, a shaft's T the torque on a section that faces +x.
    """

    columns = "mass", "stiffness"
    ends = _ENDS
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
        return softest(columns, starts)

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

    def rates(self, column: Mapping[str, Any], omega2: Any) -> list[list[Any]]:
        """Return equation 48."""
        sign = int(self.sign)
        return [[0, sign / column["stiffness"]], [-sign * omega2 * column["mass"], 0]]

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

    def slope(self, columns: Columns, z: Array) -> Array:
        """Return u' = s F / K."""
        return np.asarray(self.sign * z[..., 1] / columns["stiffness"])

    def squares(self, columns: Columns, z: Array) -> Array:
        """Return u^2 and F^2, and zeros where lateral motion has turn, shear and force."""
        u, F = z[..., 0], z[..., 1]
        return np.stack([u**2, 0 * u, F**2, 0 * u, 0 * u])

    def forms(self, columns: Columns, squares: Squares) -> Forms:
        """Return m u^2 and F^2/K."""
        strain = (1 / columns["stiffness"]) @ squares.moment
        return Forms(columns["mass"] @ squares.displacement, strain, 0 * strain, strain)

    def densities(self, columns: Columns, z: Array, omega2: float) -> dict[str, Array]:
        """Return those of motion and strain."""
        u2, _, F2, _, _ = self.squares(columns, z)
        mass, stiffness = columns["mass"][:, None], columns["stiffness"][:, None]
        return {"kinetic": omega2 * mass * u2, self.name: F2 / stiffness}

    def point_energies(
        self, point: Point, state: Array, last: bool, moved: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Return those of a mass, a spring and a joint."""
        return wave_energies(point, state, last, self.sign)
