"""Static displacements of a vehicle under its loads: lateral (equations 38, 40) and axial (35).

Lateral, with the inertial load of equation 40 taken with its right sign::

    (EI u'')'' + (N u')' = q - m (a_Y + g + (x_M - x) beta)

so that ``Q = M' + N u'`` is the static shear force of the loads, and the slope obeys
``(EI theta')' + N theta = Q`` with M = EI theta' = 0 at both ends. The result is fixed only up to a
rigid motion: it is shown relative to the mean axis (no mass-weighted mean displacement or
rotation). Axial: ``du/dx = -N/EA``, relative to the nose.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam

from .case import Case

_PIECES = 2000  # uniform pieces of the length, at the least
_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_GAUSS, _WEIGHTS = (_GAUSS + 1) / 2, _WEIGHTS / 2


class StaticShape(NamedTuple):
    """Static displacements along the body.

    Attributes
    ----------
    x : array, shape (n + 1,)
        From the nose [m].
    lateral : array
        Deflection up, relative to the mean axis [m].
    slope : array
        Of the deflection [rad].
    moment : array
        Bending moment EI u'' with the axial force on the bent axis [N m].
    axial : array
        Displacement aft relative to the nose [m].
    """

    x: Array
    lateral: Array
    slope: Array
    moment: Array
    axial: Array


def static_shape(case: Case) -> StaticShape:
    """Return the static displacements of a vehicle in its condition.

    Parameters
    ----------
    case : Case

    Returns
    -------
    StaticShape
        On a grid that contains the stations and the forces.
    """
    beam = case.beam()
    x, k, t = _grid(beam)
    h = np.diff(x)
    N = _mean(lambda s: beam.axial_force_at(k, t + s * h / np.diff(beam.x)[k]))
    inverse_EI, inverse_EA = (
        _mean(lambda s, table=table: 1 / beam.at(table, k, t + s * h / np.diff(beam.x)[k]))
        for table in (beam.bending_stiffness, _axial_stiffness(beam))
    )
    Q = case.loads.shear_force(x, "right")[:-1], case.loads.shear_force(x, "left")[1:]
    theta, moment = _slope(h, N, inverse_EI, *Q)
    rise = h * (theta[:-1] + theta[1:]) / 2 - h**2 / 12 * inverse_EI * np.diff(moment)
    u = np.concatenate([[0.0], np.cumsum(rise)])
    mean, turn = _rigid_part(case, x, u)
    axial = -np.concatenate([[0.0], np.cumsum(h * N * inverse_EA)])
    return StaticShape(x, u - mean - turn * (x - case.loads.x_M), theta - turn, moment, axial)


def _axial_stiffness(beam: Beam) -> Array:
    assert beam.axial_stiffness is not None  # every vehicle has one
    return beam.axial_stiffness


def _grid(beam: Beam) -> tuple[Array, np.ndarray, Array]:
    """Return fine nodes, and of every piece between them its interval and where it starts in it."""
    pieces = np.ceil(np.diff(beam.x) / beam.length * _PIECES).astype(int)
    k = np.repeat(np.arange(len(pieces)), pieces)
    t = (np.arange(len(k)) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[k]
    return np.append(beam.x[k] + t * np.diff(beam.x)[k], beam.x[-1]), k, t


def _mean(values: object) -> Array:
    """Return the mean of a function of the place 0 ... 1 inside every piece."""
    assert callable(values)
    return np.asarray(sum(w * values(s) for s, w in zip(_GAUSS, _WEIGHTS, strict=True)))


def _slope(h: Array, N: Array, inverse_EI: Array, Q0: Array, Q1: Array) -> tuple[Array, Array]:
    """Solve (EI theta')' + N theta = Q, M = 0 at both ends, piece by piece; return theta and M."""
    n = len(h)
    states = np.zeros((2, n + 1, 2))  # [theta, M]: from unit slope without Q, and with Q from rest
    states[0, 0, 0] = 1.0
    for i in range(n):
        T, from_Q = _piece(h[i], N[i], inverse_EI[i], Q0[i], Q1[i])
        states[:, i + 1] = states[:, i] @ T.T
        states[1, i + 1] += from_Q
    alone, driven = states
    sensitive = abs(alone[-1, 1]) > 1e-9 * np.max(np.abs(N)) * np.sum(h)
    start = -driven[-1, 1] / alone[-1, 1] if sensitive else 0.0
    theta, moment = (start * alone + driven).T
    return theta, moment


def _piece(h: float, N: float, f: float, Q0: float, Q1: float) -> tuple[Array, Array]:
    """Return the transfer matrix of [theta, M] and the effect of a linear Q, to fourth order."""
    a = N * f * h * h
    c, s = 1 - a / 2 + a * a / 24, 1 - a / 6 + a * a / 120
    T = np.array([[c, f * h * s], [-N * h * s, c]])
    q, r = Q0, Q1 - Q0
    theta = f * h * h * (q * (1 / 2 - a / 24) + r * (1 / 6 - a / 120))
    return T, np.array([theta, h * (q * s + r * (1 / 2 - a / 24))])


def _rigid_part(case: Case, x: Array, u: Array) -> tuple[float, float]:
    """Return mass-weighted mean displacement and rotation about the centre of mass."""
    m0, m1, m2 = case.loads.mass_distribution.moments(x)
    mass, first, second = np.diff(m0), np.diff(m1), np.diff(m2)
    h, x0 = np.diff(x), x[:-1]
    slope = np.diff(u) / h
    x_M = case.loads.x_M
    linear = u[:-1] - slope * x0  # u = linear + slope x on every piece
    mean = np.sum(linear * mass + slope * first) / m0[-1]
    arm = np.sum(linear * (first - x_M * mass) + slope * (second - x_M * first))
    return float(mean), float(arm / case.loads.inertia)
