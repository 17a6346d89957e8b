"""Static displacements of a vehicle under its loads: lateral (equations 38, 40) and axial (35).

Lateral, with the inertial load of equation 40 taken with its right sign::

    (EI u'')'' + (N u')' = q - m (a_Y + g + (x_M - x) beta)

so that ``Q = M' + N u'`` is the static shear force of the loads, and the turn of the sections obeys
``(EI theta')' + N theta = Q`` with M = EI theta' = 0 at both ends. With shear (`riccati.lateral`)

    M' = alpha Q - (N + s N^2) theta,   u' = alpha theta - s Q,   alpha = 1 + sN.

The result is fixed only up to a
rigid motion: it is shown relative to the mean axis (no mass-weighted mean displacement or
rotation). Axial: ``du/dx = -N/EA``, relative to the nose.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Integers
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
        Turn of the sections [rad]: without shear, the slope of the deflection.
    moment : array
        Bending moment EI theta' with the axial force on the bent axis [N m].
    axial : array
        Displacement aft relative to the nose [m].
    diverging : int
        Directions of bending in which the compression is past buckling, rigid rotation among them.
    """

    x: Array
    lateral: Array
    slope: Array
    moment: Array
    axial: Array
    diverging: int


FRAME = (
    "u_Y: static deflection, up, from the mean axis (it has no mean displacement and no mean "
    "rotation, weighted by mass). u_X: static displacement, aft, from the nose. In both all forces "
    "keep the direction that they have on the straight body."
)
"""What the displacements are measured from."""


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

    def mean(values: Callable[[Array], Array]) -> Array:
        return _mean(lambda s: values(t + s * h / np.diff(beam.x)[k]))

    N = mean(lambda at: beam.axial_force_at(k, at))
    inverse_EI, inverse_EA = (
        mean(lambda at, name=name: 1 / beam.column_at(name, k, at))  # type: ignore[misc]
        for name in ("bending_stiffness", "axial_stiffness")
    )
    s, sN, sN2 = (mean(of) for of in _in_shear(beam, k))
    Q = case.loads.shear_force(x, "right")[:-1], case.loads.shear_force(x, "left")[1:]
    theta, moment = _slope(h, N + sN2, inverse_EI, *((1 + sN) * q for q in Q))
    turn = h * (theta[:-1] + theta[1:]) / 2 - h**2 / 12 * inverse_EI * np.diff(moment)
    rise = (1 + sN) * turn - s * h * (Q[0] + Q[1]) / 2
    u = np.concatenate([[0.0], np.cumsum(rise)])
    shift, tilt = _rigid_part(case, x, u)
    axial = -np.concatenate([[0.0], np.cumsum(h * N * inverse_EA)])
    lateral = u - shift - tilt * (x - case.loads.x_M)
    diverging = _diverging(h, N + sN2, inverse_EI)
    return StaticShape(x, lateral, theta - tilt, moment, axial, diverging)


def _in_shear(beam: Beam, k: Integers) -> tuple[Callable[[Array], Array], ...]:
    """Return s, sN and sN^2 at fractions of intervals; nothing where the beam is rigid in shear."""

    def flexibility(at: Array) -> Array:
        if not beam.has_shear:
            return np.zeros(len(k))
        kGA = beam.column_at("shear_stiffness", k, at)
        engesser = beam.shear_form == "engesser"
        return np.asarray(1 / (kGA - beam.axial_force_at(k, at) if engesser else kGA))

    def times(power: int) -> Callable[[Array], Array]:
        return lambda at: np.asarray(flexibility(at) * beam.axial_force_at(k, at) ** power)

    return flexibility, times(1), times(2)


def deflection_warnings(case: Case, shape: StaticShape) -> list[str]:
    """Return what the static deflection says against the loads it is computed from.

    Parameters
    ----------
    case : Case
    shape : StaticShape
        Its static displacements.
    """
    return [_PAST_BUCKLING] if shape.diverging > 1 else [*_beyond_clearance(case, shape)]


_PAST_BUCKLING = (
    "The compression is past buckling: there is no bent shape at which the body would stay, and "
    "u_Y and EI u'' mean nothing: reduce the axial forces or stiffen the body."
)


def _beyond_clearance(case: Case, shape: StaticShape) -> Iterator[str]:
    """Compare the deflection with the room in the cavity, or where there is none with the body."""
    most, room = float(np.max(np.abs(shape.lateral))), _clearance(case, shape.x)
    against = f"the clearance between body and cavity of at most {room:.3g} m"
    if room <= 0:
        room = float(np.max(case.vehicle.stations.radius))
        against = f"the body's radius of {room:.3g} m"
    if most > room:
        yield (
            f"The static deflection u_Y of up to {most:.3g} m is beyond {against}: planing, fins, "
            "N, Q and M are those of the undeformed body, and others act on the bent one; stiffen "
            "the body, or bring the lateral forces nearer to balance."
        )


def _clearance(case: Case, x: Array) -> float:
    """Return the largest distance between body and cavity on the narrower side [m].

    Both sides of every node count, for the radius may jump there.
    """
    cavity = case.loads.cavity
    x = np.concatenate([x, np.nextafter(x, 0.0)])[np.tile(x <= cavity.L_c, 2)]
    room = cavity.radius(x) - case.vehicle.radius_at(x) - np.abs(cavity.axis_offset(x))
    return float(np.max(room))


def _diverging(h: Array, N: Array, inverse_EI: Array) -> int:
    """Count the negative eigenvalues of ``int EI theta'^2 - N theta^2`` over slopes theta.

    They are as many as the modes with omega^2 < 0 (Sylvester); linear theta on every piece, whose
    tridiagonal matrix has as many negative pivots.
    """
    k, m = 1 / (h * inverse_EI), N * h / 6
    inner = k - 2 * m
    diagonal = np.append(inner, 0.0) + np.append(0.0, inner)
    count, pivot = 0, 1.0
    for a, b in zip(diagonal.tolist(), [0.0, *(-k - m).tolist()], strict=True):
        pivot = (a - b * b / pivot) or 1e-300
        count += pivot < 0
    return count


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
