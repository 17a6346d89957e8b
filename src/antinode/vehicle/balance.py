"""Mass and rigid-body balance, eq. 18-20, of many bodies at once.

``a_X = (T - sum F_X) / m``, ``a_Y = sum F_Y / m - g``, ``beta = sum F_Y (x_M - x) / I``: forward,
up and nose-up positive; drag F_X is positive aft, lift F_Y up. The integrals over the mass are
exact.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 18-20. The weight, a body force, is all of m g.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.mass import MassDistribution

from .forces import ForceOnBody
from .numbers import ManyCases


class RigidBody(NamedTuple):
    """Mass and accelerations of bodies as a whole, arrays (cases,).

    Attributes
    ----------
    mass : array
        Mass [kg].
    x_M : array
        Centre of mass [m].
    inertia : array
        Moment of inertia about the centre of mass [kg m^2].
    a_X, a_Y : array
        Accelerations, forward and up positive [m/s^2].
    beta : array
        Angular acceleration, nose-up positive [rad/s^2].
    """

    mass: Array
    x_M: Array
    inertia: Array
    a_X: Array
    a_Y: Array
    beta: Array


def mass_of(cases: ManyCases) -> MassDistribution:
    """Return the mass along the axis, with a leading dimension where it varies among the cases."""
    states = [cases.column("mass_per_length", s) for s in cases.vehicle.stations.mass_per_length]
    return cases.vehicle.mass_distribution(cases.burn_fraction, states)


def balance(
    mass: MassDistribution, forces: Sequence[ForceOnBody[Array]], thrust: Array, gravity: Array
) -> RigidBody:
    """Return the rigid-body motion under the forces and the thrust, eq. 18-20."""
    m, J1, J2 = (np.broadcast_to(J, thrust.shape) for J in mass.moments_ahead[..., -1])
    x_M = J1 / m
    inertia = J2 - x_M * J1
    a_X = (thrust - sum(f.F_X for f in forces)) / m
    a_Y = sum(f.F_Y for f in forces) / m - gravity
    beta = sum(f.F_Y * (x_M - f.x) for f in forces) / inertia
    return RigidBody(m, x_M, inertia, a_X, a_Y, beta)
