"""The cavitation number, eq. 1: ``sigma = (p_atm + rho g depth - p_c) / (rho V^2 / 2)``.

p_c is the vapour pressure unless a cavity (ventilation) pressure is given. Sigma alone says nothing
about depth; with the depth it implies a cavity pressure, with that pressure a depth.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 1.
"""

from __future__ import annotations

from typing import Generic, NamedTuple, TypeVar

import numpy as np

from antinode.arrays import Array
from antinode.vehicle.condition import OperatingCondition, Water
from antinode.vehicle.refusals import CAVITATION, Refusals

_AGREEMENT = 1e-3  # of sigma q, within which sigma, depth and cavity pressure may disagree

T = TypeVar("T")


class Cavitation(NamedTuple, Generic[T]):
    """The state of cavitation: sigma, and what it implies where enough is known.

    Attributes
    ----------
    sigma : float, or array (cases,)
        Cavitation number [-].
    cavity_pressure : float, array or None
        Pressure in the cavity [Pa]; None where sigma alone is given.
    depth : float, array or None
        Depth [m]; None where it neither is given nor follows.
    """

    sigma: T
    cavity_pressure: T | None
    depth: T | None


class Stream(NamedTuple):
    """What the cavitation number depends on, arrays (cases,); None where it is not given.

    Attributes
    ----------
    speed, density, gravity, atmospheric_pressure, vapour_pressure : array
        V [m/s], rho [kg/m^3], g [m/s^2], p_atm and p_v [Pa].
    sigma, depth, cavity_pressure : array or None
        As given [-, m, Pa]; sigma or the depth is.
    """

    speed: Array
    density: Array
    gravity: Array
    atmospheric_pressure: Array
    vapour_pressure: Array
    sigma: Array | None
    depth: Array | None
    cavity_pressure: Array | None

    @property
    def dynamic_pressure(self) -> Array:
        """Rho V^2 / 2 [Pa]."""
        return self.density * self.speed**2 / 2

    def static_pressure(self, depth: Array) -> Array:
        """Return the pressure of the water at a depth [Pa]."""
        return self.atmospheric_pressure + self.density * self.gravity * depth


def cavitation(stream: Stream, refusals: Refusals) -> Cavitation[Array]:
    """Work out sigma, cavity pressure and depth from those that are given, case by case.

    Cases in which they contradict each other, or cannot be, are refused.
    """
    if stream.sigma is None:
        return _from_depth(stream, refusals)
    if stream.depth is not None:
        return _from_sigma_and_depth(stream, stream.sigma, stream.depth, refusals)
    if stream.cavity_pressure is not None:
        return _from_pressure(stream, stream.sigma, stream.cavity_pressure, refusals)
    return Cavitation(stream.sigma, None, None)


def resolve_cavitation(condition: OperatingCondition, water: Water) -> Cavitation[float]:
    """Work out sigma, cavity pressure and depth of one condition.

    Parameters
    ----------
    condition : OperatingCondition
        Gives sigma or depth, and perhaps the cavity pressure.
    water : Water
        Gives the pressures and the density.

    Returns
    -------
    Cavitation
        Given and implied values.

    Raises
    ------
    InputError
        If the given values contradict each other, or cannot be.
    """
    surroundings = (water.density, water.gravity, water.atmospheric_pressure, water.vapour_pressure)
    given = (condition.cavitation_number, condition.depth, condition.cavity_pressure)
    each = [None if v is None else np.array([v]) for v in (condition.speed, *surroundings, *given)]
    refusals = Refusals(1)
    with np.errstate(all="ignore"):
        state = cavitation(Stream(*each), refusals)  # type: ignore[arg-type]
    refusals.check(0)
    return cavitation_of(state, 0)


def cavitation_of(state: Cavitation[Array], case: int) -> Cavitation[float]:
    """Return one case of several; NaN stands for what does not follow."""
    sigma, pressure, depth = (None if v is None else float(v[case]) for v in state)
    assert sigma is not None
    return Cavitation(sigma, pressure, None if depth is None or np.isnan(depth) else depth)


def _from_depth(stream: Stream, refusals: Refusals) -> Cavitation[Array]:
    depth, p_c = stream.depth, stream.cavity_pressure
    assert depth is not None
    p_c = stream.vapour_pressure if p_c is None else p_c
    sigma = (stream.static_pressure(depth) - p_c) / stream.dynamic_pressure

    def words(k: int) -> str:
        made = (
            f"condition.depth = {depth[k]:g} m, {stream.speed[k]:g} m/s and {p_c[k]:g} Pa in the "
            f"cavity make the cavitation number {sigma[k]:.4g}"
        )
        return f"{made}; it must lie between 0 and 1: change speed, depth or cavity_pressure"

    refusals.refuse(~((sigma > 0) & (sigma < 1)), CAVITATION, words)
    return Cavitation(sigma, p_c, depth)


def _from_sigma_and_depth(
    stream: Stream, sigma: Array, depth: Array, refusals: Refusals
) -> Cavitation[Array]:
    """Imply a cavity pressure, which must not be negative, nor disagree with a given one."""
    p_c = stream.static_pressure(depth) - sigma * stream.dynamic_pressure
    given, allowed = stream.cavity_pressure, _AGREEMENT * sigma * stream.dynamic_pressure

    def implied(k: int) -> str:
        both = f"condition.cavitation_number = {sigma[k]:g} and depth = {depth[k]:g} m"
        return f"{both} imply a cavity pressure of {p_c[k]:.6g} Pa"

    def negative(k: int) -> str:
        return f"{implied(k)}, which must be at least 0: leave out the depth"

    refusals.refuse(p_c < 0, CAVITATION, negative)
    if given is not None:

        def differs(k: int) -> str:
            say = f"they may differ by {allowed[k]:.3g} Pa (0.1 % of sigma q): leave out one of the"
            return f"{implied(k)}, but cavity_pressure = {given[k]:.6g} Pa; {say} three"

        refusals.refuse(np.abs(given - p_c) > allowed, CAVITATION, differs)
    return Cavitation(sigma, p_c, depth)


def _from_pressure(
    stream: Stream, sigma: Array, p_c: Array, refusals: Refusals
) -> Cavitation[Array]:
    """Imply a static pressure, hence a depth, by sigma and the cavity pressure."""
    p, p_atm = p_c + sigma * stream.dynamic_pressure, stream.atmospheric_pressure

    def words(k: int) -> str:
        both = f"condition.cavitation_number = {sigma[k]:g} and cavity_pressure = {p_c[k]:g} Pa"
        say = f"below the atmosphere's {p_atm[k]:g} Pa: leave out one of them"
        return f"{both} imply a static pressure of {p[k]:.6g} Pa, {say}"

    refusals.refuse(p < p_atm * (1 - 1e-9), CAVITATION, words)
    weight = stream.density * stream.gravity
    return Cavitation(sigma, p_c, np.where(weight > 0, np.maximum(0.0, p - p_atm) / weight, np.nan))
