"""Loads on a body in motion: axial force, shear force and bending moment along it.

With x [m] aft from the nose and the accelerations of `balance.py`

- ``N(x) = F_CX + a_X m_ahead(x) + sum F_X [x > x_i]``, compression positive: the cavitator's drag
  at the nose, the thrust at the tail;
- ``Q' = q - m (a_Y + g + (x_M - x) beta)`` and ``M' = Q``, where q are the lateral forces: Q is the
  force up on the part ahead of x, and M = EI Y''. Both vanish at both free ends.

The integrals over the mass are exact, so the balance closes to rounding.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 21-26. There the distance X runs forward from the tail:
X = L - x. The weight, a body force, is missing in its eq. 24 and 26.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antinode.arrays import Array, distinct
from antinode.beam.mass import MassDistribution
from antinode.errors import InputError
from antinode.methods import LoadsMethods

from .condition import OperatingCondition, Water
from .forces import FinLoads, ForceOnBody, drag_ahead, forces_of
from .hydrodynamics.cavitation_number import cavitation_of
from .hydrodynamics.cavity import Cavity
from .hydrodynamics.planing import Planing
from .hydrodynamics.validity import Validity
from .load_warnings import validity_of
from .many_loads import LoadNumbers, ManyLoads, loads_of_many
from .numbers import ManyCases
from .options import Model
from .vehicle import Vehicle

Side = Literal["left", "right"]

_BALANCED = 1.0
"""Lateral accelerations below this are small [m/s^2]: a tenth of the weight."""


class FinLoad(NamedTuple):
    """The forces of one set of fins.

    Attributes
    ----------
    position : float
        x of the set [m].
    immersion : tuple of float
        Length of each fin outside the cavity [m].
    F_fX, F_fY : float
        Drag, positive aft, and lift, positive up [N].
    """

    position: float
    immersion: tuple[float, ...]
    F_fX: float
    F_fY: float


class Checks(NamedTuple):
    """What is left of N, Q and M at the ends, over the largest force (and the length).

    Attributes
    ----------
    axial_nose, axial_tail : float
        N at the nose less the cavitator's drag, N at the tail less the thrust [-].
    shear_nose, shear_tail : float
        Q at the ends [-].
    moment_nose, moment_tail : float
        M at the ends [-].
    """

    axial_nose: float
    axial_tail: float
    shear_nose: float
    shear_tail: float
    moment_nose: float
    moment_tail: float

    @property
    def worst(self) -> float:
        """The largest of the six, as a size [-]."""
        return max(map(abs, self))


@dataclass(frozen=True, eq=False, repr=False)
class Loads(LoadsMethods, LoadNumbers[float]):
    """Everything that acts on the body in one condition: the `LoadNumbers`, and what follows.

    Parameters
    ----------
    cavity : Cavity
        The cavity.
    cavity_pressure, depth : float or None
        Given or implied pressure in the cavity [Pa] and depth [m]; None where nothing says so.
    fins : tuple of FinLoad
        Forces of each set of fins.
    planing : Planing
        Planing state and forces.
    thrust : float
        Thrust at the tail, forward [N].
    gravity : float
        g [m/s^2].
    forces : tuple of ForceOnBody
        Forces on the body but the thrust, cavitator first.
    mass_distribution : MassDistribution
        Mass along the axis.
    axial_model : {"exact", "element_midpoint"}
        How N runs between the breakpoints.
    warnings : tuple of str
        What is doubtful, and what to do about it.
    validity : tuple of Validity
        Every checked range.
    """

    cavity: Cavity
    cavity_pressure: float | None
    depth: float | None
    fins: tuple[FinLoad, ...]
    planing: Planing
    thrust: float
    gravity: float
    forces: tuple[ForceOnBody[float], ...]
    mass_distribution: MassDistribution
    axial_model: Literal["exact", "element_midpoint"]
    warnings: tuple[str, ...]
    validity: tuple[Validity, ...]

    def __call__(self) -> Self:
        """Return the loads themselves: ``case.loads()`` reads like the other methods."""
        return self

    @property
    def length(self) -> float:
        """Length of the body [m]."""
        return float(self.mass_distribution.x[-1])

    @property
    def weight(self) -> float:
        """Weight m g [N]."""
        return self.mass * self.gravity

    @property
    def drag(self) -> float:
        """Drag of all forces, aft [N]."""
        return float(drag_ahead(self.forces, lambda _: True))

    @property
    def largest_lateral_acceleration(self) -> float:
        """The largest of ``a_Y + beta (x_M - x)`` along the body, as a size [m/s^2]."""
        return max(abs(self.a_Y + self.beta * (self.x_M - x)) for x in (0.0, self.length))

    @property
    def is_balanced(self) -> bool:
        """Whether the lateral forces leave less than 1 m/s^2 anywhere along the body."""
        return self.largest_lateral_acceleration < _BALANCED

    @property
    def axial_inertia(self) -> float:
        """Factor on the mass ahead in N [m/s^2]: a_X, or 0 with N constant between stations."""
        return self.a_X if self.axial_model == "exact" else 0.0

    @cached_property
    def breakpoints(self) -> Array:
        """Positions between which `axial_jump` is constant [m], (n+1,).

        The stations, and with the exact axial force the forces between nose and tail.
        """
        x = self.mass_distribution.x
        if self.axial_model == "element_midpoint":
            return x
        return distinct(np.concatenate([x, [force.x for force in self.forces]]))

    @cached_property
    def axial_jump(self) -> Array:
        """Part of N that is constant on each interval of the breakpoints [N], (n,).

        N(x) is this plus `axial_inertia` times the mass ahead of x.
        """
        x = self.breakpoints
        middle = (x[:-1] + x[1:]) / 2
        if self.axial_model == "exact":
            return self._drag_ahead(middle, "left")
        ahead = self.mass_distribution.moments(x)[0]
        inertia = self.a_X * (ahead[:-1] + ahead[1:]) / 2
        return np.asarray(self._drag_ahead(middle, "left") + inertia)

    def axial_force(self, x: ArrayLike, side: Side = "left") -> Array:
        """Return the axial compression N.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].
        side : {"left", "right"}
            The value just ahead of `x`, or just aft of it, where it jumps. At the tail every force
            counts, and at the nose the cavitator's.

        Returns
        -------
        ndarray
            N, compression positive [N].
        """
        x = self._on_body(x)
        if self.axial_model == "exact":
            ahead = self.mass_distribution.moments(x)[0]
            return np.asarray(self._drag_ahead(x, side) + self.a_X * ahead)
        k = np.searchsorted(self.breakpoints, x, side=side) - 1
        return self.axial_jump[np.clip(k, 0, len(self.axial_jump) - 1)]

    def shear_force(self, x: ArrayLike, side: Side = "left") -> Array:
        """Return the shear force Q = M', the force up on the part ahead of `x`.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].
        side : {"left", "right"}
            The value just ahead of `x`, or just aft of it, where it jumps. At the tail every force
            counts.

        Returns
        -------
        ndarray
            Q, up positive [N].
        """
        x = self._on_body(x)
        J0, J1, _ = self.mass_distribution.moments(x)
        c = self._inertial_load
        lift = sum(force.F_Y * self._counts(force, x, side) for force in self.forces)
        return np.asarray(lift - c * J0 + self.beta * J1)

    def bending_moment(self, x: ArrayLike) -> Array:
        """Return the bending moment M = EI Y'', of the loads alone.

        Parameters
        ----------
        x : array_like
            Positions on the body [m].

        Returns
        -------
        ndarray
            M [N m].
        """
        x = self._on_body(x)
        J0, J1, J2 = self.mass_distribution.moments(x)
        c = self._inertial_load
        lift = sum(force.F_Y * np.maximum(x - force.x, 0) for force in self.forces)
        return np.asarray(lift - c * (x * J0 - J1) + self.beta * (x * J1 - J2))

    @cached_property
    def checks(self) -> Checks:
        """What is left at the ends of N, Q and M, relative to the largest force."""
        sizes = [abs(part) for force in self.forces for part in (force.F_X, force.F_Y)]
        F, L = max(*sizes, self.thrust, self.weight, 1e-300), self.length
        ends = np.array([0.0, L])
        N = self._drag_ahead(ends, "left") + self.a_X * self.mass_distribution.moments(ends)[0]
        N = (N - [self.F_CX, self.thrust]) / F
        Q, M = self.shear_force(ends) / F, self.bending_moment(ends) / (F * L)
        return Checks(*map(float, (*N, *Q, *M)))

    @property
    def _inertial_load(self) -> float:
        """Inertial and weight load per mass at the nose [m/s^2]."""
        return self.a_Y + self.gravity + self.x_M * self.beta

    def _on_body(self, x: ArrayLike) -> Array:
        x = np.asarray(x, dtype=float)
        if not ((x >= 0) & (x <= self.length)).all():
            raise InputError(f"x = {x} m is not on the body: must lie within 0 and {self.length:g}")
        return x

    def _counts(self, force: ForceOnBody[float], x: Array, side: Side) -> NDArray[np.bool_]:
        """Whether a force counts as ahead of `x`: all of them do at the tail."""
        return (x > force.x if side == "left" else x >= force.x) | (x >= self.length)

    def _drag_ahead(self, x: Array, side: Side) -> Array:
        return np.asarray(drag_ahead(self.forces, lambda f: self._counts(f, x, side)) + 0 * x)

    @property
    def unbalanced(self) -> str:
        """What the body does for want of balance, in words that follow on its accelerations."""
        drag, thrust, across = self.drag / 1e3, self.thrust / 1e3, self.largest_lateral_acceleration
        slows = f"; drag {drag:.4g} kN is above thrust {thrust:.4g} kN: the body slows down"
        turns = f"; not in balance: up to {across:.3g} m/s^2 across the body"
        return (slows if self.a_X < 0 else "") + ("" if self.is_balanced else turns)

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        p = self.planing
        yield (
            f"cavity: sigma {self.sigma:.4g}, length {self.cavity.L_c:.4g} m, "
            f"largest diameter {self.cavity.D_c:.4g} m"
        )
        yield (
            f"forces [N]: cavitator {self.F_CX:.5g} aft, {self.F_CY:.5g} up; "
            f"fins {self.F_fX:.5g} aft, {self.F_fY:.5g} up; "
            f"planing {p.F_PX:.5g} aft, {p.F_PY:.5g} up at x = {p.x_P:.4g} m; "
            f"thrust {self.thrust:.5g}; weight {self.weight:.5g}"
        )
        yield (
            f"body: {self.mass:.5g} kg, centre of mass at x = {self.x_M:.4g} m; "
            f"acceleration {self.a_X:.4g} m/s^2 forward, {self.a_Y:.4g} m/s^2 up, "
            f"{self.beta:.4g} rad/s^2 nose-up{self.unbalanced}"
        )
        yield f"balance of N, Q and M at the ends closes to {self.checks.worst:.1e}"
        yield from (f"warning: {warning}" for warning in self.warnings)


def compute_loads(
    vehicle: Vehicle,
    condition: OperatingCondition,
    water: Water | None = None,
    model: Model | None = None,
) -> Loads:
    """Work out cavity, forces, accelerations and internal loads of a vehicle in a condition.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle.
    condition : OperatingCondition
        How it moves.
    water : Water, optional
        The water; by default fresh water at 20 C.
    model : Model, optional
        The choices that the equations leave open; by default those of `Model`.

    Returns
    -------
    Loads
        The loads, with warnings, ranges of validity and checks.

    Raises
    ------
    InputError
        If the input contradicts itself or cannot be: pressures, or fins that are off the body.
    ComputationError
        If the loads are beyond what numbers can hold.
    """
    cases = ManyCases(vehicle, condition, water or Water(), model or Model())
    return loads_of_case(loads_of_many(cases), 0)


def loads_of_case(many: ManyLoads, case: int) -> Loads:
    """Return the loads of one of many cases.

    Raises
    ------
    InputError, ComputationError
        If the case is refused: the reason.
    """
    many.refusals.check(case)
    found, cases, mass = many.hydrodynamics, many.cases, many.mass_distribution
    own = mass.ends[case] if mass.ends.ndim == 3 else mass.ends
    return Loads(
        **{name: float(v[case]) for name, v in many.numbers.items()},
        cavity=found.cavity.of(case),
        cavity_pressure=(state := cavitation_of(found.state, case)).cavity_pressure,
        depth=state.depth,
        fins=tuple(_fin_load(fin, case) for fin in found.fins),
        planing=found.planing.of(case),
        thrust=float(cases.number("condition", "thrust")[case]),
        gravity=float(cases.number("water", "gravity")[case]),
        forces=forces_of(found.forces, case),
        mass_distribution=MassDistribution(mass.x, own, mass.interpolation),
        axial_model=cases.model.axial_force,
        warnings=tuple(w.sentence(case) for w in many.warnings if w.concerns[case]),
        validity=validity_of(many.ranges, case),
    )


def _fin_load(fin: FinLoads, case: int) -> FinLoad:
    immersion = tuple(map(float, fin.immersion[:, case]))
    return FinLoad(
        float(fin.position[case]), immersion, float(fin.F_fX[case]), float(fin.F_fY[case])
    )
