r"""Stiffness that loses energy: complex eigenvalues followed from those without loss.

With loss factors the stiffness is K + i H, and H at most eta times the elastic energy. As H grows
from nothing no eigenvalue crosses a circle on which

    beta(s) = eta w norm(P^(1/2) A(s)^-1 P^(1/2)) < 1,   P = K_base + sigma M

because there ``A(s) + i t H`` is singular for no t in 0 ... 1, if w P is no less than the elastic
energy: if ``(1 - 1/w)`` of that with all springs and the axial force has no eigenvalue below
-sigma, which a count tells. A is the base chain with what acts besides (`damped.ratio`), so that
with R the inverse of the base chain's and b_i unit forces

    A^-1 = R - R b Z (I + G Z)^-1 b^T R,   norm(P^(1/2) R P^(1/2)) = max (l_k + sigma)/abs(l_k - l)

    norm(P^(1/2) R b_i)^2 = T_i = Im(l G_ii)/Im l + sigma S_i

The circle holds as many eigenvalues as without loss, which is proven. For a real s loss by a factor
has no meaning: there the change of s counts as an error. Where loads turn with the section
(`damped.turning`), their own beta makes the norm no larger than 1/(1 - that) times.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from antinode.riccati.arrays import Complex, Numbers
from antinode.riccati.chain import Chain, count_below, omega2_scale
from antinode.riccati.points import Point

from .chain import Damped
from .ratio import Ratio
from .roots import Circle, ComplexEigenvalue, ComplexRoots, rounding
from .search import Search

_WEIGHTS = 1.0, 1.25, 2.0, 5.0
_MOST_HALVINGS = 4
_RING = 16  # samples of D about an eigenvalue
_RADII = 1e-11, 1e-10, 1e-9, 1e-8, 1e-7
_STEPS = 4, 16, 64  # from no loss to all of it, where one does not do


def with_loss(
    damped: Damped, ratio: Ratio, roots: ComplexRoots, *, scales: bool = True
) -> ComplexRoots:
    """Return the eigenvalues of a chain with loss from those of it without.

    Parameters
    ----------
    damped : Damped
        With complex columns.
    ratio : Ratio
        Of the chain without loss.
    roots : ComplexRoots
        Of the same.
    scales : bool
        Whether the columns of shear go as its flexibility does: not Engesser's under axial force.
    """
    largest = largest_beta(damped, ratio, roots.circle) if scales else np.inf
    start = np.array([v.s for v in roots.eigenvalues], dtype=complex)
    upper = start.imag > 0
    everyone: Numbers = np.concatenate([start, start[upper].conj()])
    everyone = _traced(damped, everyone, roots.circle.radius)
    found = _enclosed(damped, everyone[: len(start)], start) if len(start) else []
    distinct = _distinct(everyone, roots.circle.radius)
    margin = min(roots.circle.margin, 1 - largest)
    circle = replace(roots.circle, margin=margin, loss=largest)
    return ComplexRoots(found, circle, distinct + roots.circle.at_zero)


def _traced(damped: Damped, start: Numbers, radius: float) -> Numbers:
    """Return where eigenvalues go as the loss grows: in steps that are shorter where two meet."""
    if not len(start):
        return start
    for steps in _STEPS:
        s = start
        for part in np.linspace(0, 1, steps + 1)[1:]:
            search = Search(_partly(damped, float(part)), 0, radius, False)
            s = search.run(np.asarray(s * (1 + 1e-9), dtype=complex), [])[0]
        if _distinct(s, np.inf) == _distinct(start, np.inf):
            break
    return s


def largest_beta(damped: Damped, ratio: Ratio, circle: Circle) -> float:
    """Return a bound on beta all along a circle; infinite where there is none."""
    bound = elastic_bound(damped)
    if bound is None:
        return np.inf
    weight, sigma = bound
    if circle.turning >= 1:
        return np.inf
    eta = largest_loss(damped)
    angles = np.linspace(0, np.pi, 49)
    for _ in range(_MOST_HALVINGS):
        s = circle.radius * np.exp(1j * angles)
        half = circle.radius * (angles[1] - angles[0]) / 2
        beta = eta * weight * ratio.inverse_norm(s, half, sigma) / (1 - circle.turning)
        if np.max(beta) < 1:
            return float(np.max(beta))
        angles = np.linspace(0, np.pi, 2 * len(angles) - 1)
    return float(np.max(beta))


def largest_loss(damped: Damped) -> float:
    """Return the largest loss factor of the segments."""
    assert damped.columns is not None
    found = 0.0
    for name in ("stiffness", "shear"):
        values = damped.columns.get(name)
        if values is not None:
            size = np.where(values.real == 0, 1.0, values.real)
            found = max(found, float(np.max(np.abs(values.imag / size))))
    return found


def elastic_bound(damped: Damped) -> tuple[float, float] | None:
    """Return w and sigma for which w (K + sigma M) is no less than the elastic energy."""
    base, scale = damped.base, omega2_scale(damped.base)
    for sigma in (0.0, *(scale * 10.0 ** np.arange(-2, 4))):
        for weight in _WEIGHTS:
            if _holds(base, weight, float(sigma)):
                return weight, float(sigma)
    return None


def _holds(base: Chain, weight: float, sigma: float) -> bool:
    share = 1 - 1 / weight
    if share == 0.0:  # nothing but springs that hold
        loaded = base.law.has_axial_force and bool(np.any(base.axial_force))
        softened = bool(np.any(base.columns.get("foundation", np.zeros(1)) < 0))
        return not loaded and not softened and all(map(_holds_back, base.points))
    if sigma == 0.0:
        return False
    columns = dict(base.columns) | {"stiffness": base.stiffness * share}
    for name in ("shear", "shear_turn", "shear_work"):
        if name in columns:
            columns[name] = columns[name] / share
    softer = replace(base, columns=columns)
    return bool(count_below(softer, [-sigma])[0] == 0)


def _holds_back(point: Point) -> bool:
    """Tell whether the springs of a point store energy in every motion."""
    k, turning, across = point.spring, point.rotational_spring, point.coupling
    return min(k, turning) >= 0 and k * turning >= across**2 and not point.own_load


def _partly(damped: Damped, part: float) -> Damped:
    """Return the chain with a part of its loss."""
    assert damped.columns is not None
    columns = {n: v.real + 1j * part * np.imag(v) for n, v in damped.columns.items()}
    return damped if part == 1.0 else replace(damped, columns=columns)


def _distinct(s: Complex, radius: float) -> int:
    """Return how many places in a circle differ."""
    inside = [z for z in s.tolist() if np.isfinite(z) and abs(z) < radius]
    kept: list[complex] = []
    for z in inside:
        if not any(abs(z - other) < 1e-8 * abs(z) for other in kept):
            kept.append(z)
    return len(kept)


def _enclosed(damped: Damped, s: Complex, start: Complex) -> list[ComplexEigenvalue]:
    """Put a circle about every eigenvalue, around which samples of D turn once."""
    turn = np.exp(2j * np.pi * np.arange(_RING) / _RING)
    error, sure = np.full(len(s), np.inf), np.zeros(len(s), bool)
    for radius in _RADII:
        open_ = np.flatnonzero(~sure)
        if not len(open_):
            break
        places = s[open_, None] + radius * np.abs(s[open_, None]) * turn
        value = damped.characteristic(places.ravel())[0].reshape(places.shape)
        angle = np.angle(np.roll(value, -1, axis=1) / value)
        once = np.abs(np.sum(angle, axis=1) / (2 * np.pi) - 1) < 1e-6
        once &= np.all(np.abs(angle - 2 * np.pi / _RING) < 0.5 * np.pi / _RING, axis=1)
        sure[open_[once]], error[open_[once]] = True, radius * np.abs(s[open_[once]])
    error = error + rounding(damped.chain, s)
    found = []
    for z, off, good, before in zip(s.tolist(), error.tolist(), sure.tolist(), start, strict=True):
        if before.imag == 0:
            found.append(ComplexEigenvalue(complex(z.real), off + abs(z.imag), good))
        else:
            found.append(ComplexEigenvalue(z, off, good))
    return sorted(found, key=lambda v: (v.s.imag, v.s.real))
