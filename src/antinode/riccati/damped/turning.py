r"""Loads along the axis that turn with the section: complex eigenvalues, proven.

Such a load t adds ``-(w, T v) = -int t psi_v w_Y`` to the stiffness, along the whole beam: no few
displacements tell it. As it grows from nothing no eigenvalue crosses a circle on which

    beta(s) = c norm(P^(1/2) A(s)^-1 M^(1/2)) < 1,   P = K_base + sigma M

because A(s) + tau T is singular for no tau in 0 ... 1 there, if int t^2 psi^2/m <= c^2 (v, P v):
if the base chain, with ``t^2/(m c^2)`` more axial force, has no eigenvalue below -sigma, which a
count tells. A is the chain without these loads, with all else that acts. The circle holds as many
eigenvalues as without them, which is proven (`damped.roots`). Each stands in a circle of its own,
around which samples of D turn as often as it has members.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from antinode.riccati.arrays import Array, Complex, Numbers
from antinode.riccati.chain import Chain, count_below
from antinode.riccati.winding import Path

from .chain import Damped
from .ratio import Ratio, RatioSamples
from .roots import BaseEigenvalues, Circle, ComplexEigenvalue, Finder, rounding

_WEIGHTS = 1.0, 1.5, 3.0, 10.0, 100.0  # times the c of a long uniform beam
_SIGMA = 1.0, 8.0  # of the square of the radius
_MOST_HALVINGS = 3
_GAPS = 6  # circles that are tried
_RINGS = 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4
_CORNERS = 24


class TurningFinder(Finder):
    """Finds the eigenvalues of a chain with loads that turn within a circle.

    Parameters
    ----------
    damped : Damped
        Without loss.
    base, zeros, at_zero
        As of `Finder`.
    """

    def __init__(self, damped: Damped, base: BaseEigenvalues, zeros: int, at_zero: int) -> None:
        super().__init__(damped, base, zeros, at_zero)
        self.plain = damped.without_turning

    @property
    def ratio(self) -> Ratio:
        """G of the chain without these loads."""
        return Ratio(self.plain, self.poles)

    def _certify(self, below: int) -> tuple[Circle, Path, int]:
        """Return a circle that no eigenvalue crosses, through a gap of the base chain."""
        best: tuple[Circle, Path, int] | None = None
        for _ in range(_GAPS):
            circle, path, index = super()._certify(below)
            beta = self.largest_beta(circle.radius)
            margin = min(circle.margin, 1 - beta)
            here = replace(circle, margin=margin, turning=beta), self._quotient(path), index
            if margin > 0:
                return here
            best, below = best or here, index + 1
        assert best is not None
        return best

    def largest_beta(self, radius: float) -> float:
        """Return a bound on beta all along a circle; infinite where there is none."""
        bounds = [b for share in _SIGMA if (b := self._load_bound(share * radius**2)) is not None]
        angles = np.linspace(0, np.pi, 49)
        beta = np.full(1, np.inf)
        for _ in range(_MOST_HALVINGS if bounds else 0):
            s, half = radius * np.exp(1j * angles), radius * (angles[1] - angles[0]) / 2
            each = [
                c * self.ratio.inverse_norm(s, half, sigma, inertia=True) for c, sigma in bounds
            ]
            beta = min(each, key=lambda values: float(np.max(values)))
            if np.max(beta) < 1:
                break
            angles = np.linspace(0, np.pi, 2 * len(angles) - 1)
        return float(np.max(beta))

    def _load_bound(self, sigma: float) -> tuple[float, float] | None:
        """Return c with ``int t^2 psi^2/m <= c^2 (K + sigma M)``, and sigma."""
        base, load = self.damped.base, self.damped.chain.columns["tangential"]
        m, EI = base.mass, base.stiffness
        guess = float(np.max(np.abs(load) / (m * EI * m * m * sigma) ** 0.25)) / math.sqrt(2)
        for weight in _WEIGHTS if guess else ():
            c = 1.01 * weight * guess
            stronger = base.with_columns(axial_force=base.axial_force + (load / c) ** 2 / m)
            if _holds(stronger, sigma):
                return c, sigma
        return None if guess else (0.0, sigma)

    def _quotient(self, path: Path) -> Path:
        """Return a path with D over that of the base chain, for its sums of powers."""
        s = path.samples.at
        own, size = self.damped.characteristic(s)
        other, size_of_base = Damped(self.damped.base, form=self.damped.form).characteristic(s)
        value = own / other * np.exp(size - size_of_base)
        samples = path.samples
        assert isinstance(samples, RatioSamples)
        return path._replace(samples=samples._replace(value=value))

    def _enclosed(self, known: list[complex], steps: list[float]) -> list[ComplexEigenvalue]:
        """Put a ring about every eigenvalue around which D turns as often as it has members."""
        if not known:
            return []
        s: Complex = np.array(known)
        everyone: Complex = np.concatenate([s, s[s.imag > 0].conj()])
        error, members, sure = rings(self.damped, s, everyone)
        error = error + rounding(self.damped.chain, s)
        rows = zip(s.tolist(), error.tolist(), sure.tolist(), members.tolist(), strict=True)
        found = [_on_the_axis(ComplexEigenvalue(*row)) for row in rows]
        return sorted(found, key=lambda v: (v.s.imag, v.s.real))


def _on_the_axis(value: ComplexEigenvalue) -> ComplexEigenvalue:
    """Return a real eigenvalue as one."""
    if 0 < value.s.imag <= value.error and value.members == 1:
        return replace(value, s=complex(value.s.real), error=value.error + value.s.imag)
    return value


def _holds(chain: Chain, sigma: float) -> bool:
    try:
        return bool(count_below(chain, [-sigma])[0] == 0)
    except FloatingPointError:
        return False


def rings(damped: Damped, s: Complex, everyone: Numbers) -> tuple[Array, Array, Array]:
    """Return the radius of a ring about each place, how many are in it, and whether D says so.

    Parameters
    ----------
    damped : Damped
    s : array of complex, shape (k,)
    everyone : array of complex
        All eigenvalues that are known, conjugates too: as many as are inside are members.
    """
    turn = np.exp(2j * np.pi * np.arange(_CORNERS) / _CORNERS)
    error, sure = np.full(len(s), np.inf), np.zeros(len(s), bool)
    members = np.ones(len(s), int)
    for share in _RINGS:
        open_ = np.flatnonzero(~sure)
        if not len(open_):
            break
        radius = share * np.abs(s[open_])
        places = s[open_, None] + radius[:, None] * turn
        value = damped.characteristic(places.ravel())[0].reshape(places.shape)
        with np.errstate(all="ignore"):
            angle = np.angle(np.roll(value, -1, axis=1) / value)
        number = np.sum(np.abs(everyone - s[open_, None]) < radius[:, None], axis=1)
        good = np.abs(np.sum(angle, axis=1) / (2 * np.pi) - number) < 1e-6
        even = 2 * np.pi * number / _CORNERS
        good &= np.all(np.abs(angle - even[:, None]) < 0.5 * even[:, None], axis=1)
        sure[open_[good]], error[open_[good]] = True, radius[good]
        members[open_[good]] = number[good]
    return error, members, sure
