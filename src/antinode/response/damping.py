"""Damping: what makes a beam lose energy, and how it enters equations of motion.

Time is ``exp(+i omega t)``: a stiffness that loses energy has a positive imaginary part, and a
displacement lags behind its force.

- loss factor eta: EI, EA, GJ and the shear stiffness times ``1 + i eta`` at every frequency; not
  springs, joints, foundation;
- modal: a viscous ratio for each mode. No beam has just these: responses are sums of modes;
- Rayleigh: ``C = alpha M + beta K``, fitted to two ratios at two frequencies. All of K and M: the
  response is that of the undamped chain at ``omega^2 (1 - i alpha/omega)/(1 + i beta omega)``, its
  displacements over ``1 + i beta omega``;
- dashpots of the beam always count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.arguments import numbers
from antinode.arrays import Array, Numbers
from antinode.errors import InputError
from antinode.riccati.forced import Lanes


@dataclass(frozen=True)
class Rayleigh:
    """``C = alpha M + beta K``.

    Attributes
    ----------
    alpha : float
        [1/s].
    beta : float
        [s].
    """

    alpha: float
    beta: float

    @classmethod
    def fitted(cls, ratios: tuple[float, float], frequencies_hz: tuple[float, float]) -> Rayleigh:
        """Return the damping that has two given ratios at two frequencies [Hz].

        Raises
        ------
        InputError
            If the frequencies are alike or not positive, or it would drive a mode.
        """
        (low, high), (a, b) = (2 * np.pi * f for f in frequencies_hz), ratios
        if not (low > 0 and high > 0 and low != high):
            raise InputError(
                f"damping.rayleigh.frequencies are {frequencies_hz[0]:g} and "
                f"{frequencies_hz[1]:g} Hz; give two different ones above 0"
            )
        beta = 2 * (b * high - a * low) / (high**2 - low**2)
        alpha = 2 * a * low - beta * low**2
        if alpha < 0 or beta < 0:
            raise InputError(
                f"damping.rayleigh: ratios {a:g} and {b:g} at {frequencies_hz[0]:g} and "
                f"{frequencies_hz[1]:g} Hz need alpha = {alpha:.3g} 1/s, beta = {beta:.3g} s; both "
                "must be at least 0: bring the ratios nearer to each other"
            )
        return cls(float(alpha), float(beta))

    def ratio(self, omega: Array) -> Array:
        """Return the damping ratio at a frequency [rad/s]."""
        return np.asarray(self.alpha / (2 * omega) + self.beta * omega / 2)


@dataclass(frozen=True)
class Damping:
    """How a beam is damped, besides its dashpots.

    Parameters
    ----------
    loss_factor : float
        eta, 0 or positive; where the beam has a column of its own, that counts as well.
    modal : tuple of float
        Viscous ratios of modes 1, 2, ...; the last one holds for all further ones.
    rayleigh : Rayleigh, optional
    """

    loss_factor: float = 0.0
    modal: tuple[float, ...] = ()
    rayleigh: Rayleigh | None = None

    def __post_init__(self) -> None:
        given = [bool(self.loss_factor), bool(self.modal), self.rayleigh is not None]
        if sum(given) > 1:
            raise InputError(
                "damping: loss_factor, modal and rayleigh exclude each other; give one"
            )
        numbers("damping.loss_factor", self.loss_factor)
        numbers("damping.modal", list(self.modal))
        if not 0 <= self.loss_factor < 10:
            raise InputError(f"damping.loss_factor is {self.loss_factor:g}; 0 to 10 is allowed")
        for number, ratio in enumerate(self.modal, 1):
            if not 0 <= ratio < 10:
                raise InputError(
                    f"damping.modal, entry {number}, is {ratio:g}; 0 to 10 is allowed: a ratio, "
                    "not percent"
                )

    def ratio(self, mode: int) -> float:
        """Return the viscous ratio of mode 1, 2, ... where ratios are given for modes."""
        return self.modal[min(mode, len(self.modal)) - 1]

    def lanes(self, omega: Array) -> tuple[Lanes, Numbers]:
        """Return how frequencies stand in the chain, and what displacements are multiplied by."""
        if self.rayleigh is None:
            return Lanes((omega**2).astype(complex), 1j * omega), np.ones(len(omega), complex)
        stiff = 1 / (1 + 1j * self.rayleigh.beta * omega)
        omega2 = omega * (omega - 1j * self.rayleigh.alpha) * stiff
        return Lanes(omega2, 1j * omega * stiff), stiff

    def describe(self) -> str:
        """Say in words what is damped."""
        if self.modal:
            return "ratios of modes " + ", ".join(f"{ratio:g}" for ratio in self.modal)
        if self.rayleigh is not None:
            alpha, beta = self.rayleigh.alpha, self.rayleigh.beta
            return f"Rayleigh, fitted: alpha = {alpha:.5g} 1/s, beta = {beta:.5g} s"
        if self.loss_factor:
            return f"loss factor {self.loss_factor:g}"
        return "none"


UNDAMPED = Damping()
