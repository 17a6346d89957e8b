"""Responses as sums of modes, with a static rest for those left out, and how wrong that is.

    H(omega) = sum c_n b_n / (omega_n^2 - omega^2 + 2 i zeta_n omega_n omega) + rest

The rest is what the modes left out do at rest: at ``omega^2 = -sigma``, where nothing resonates and
free beams too have an answer, the undamped chain tells the whole and the sum its part. Stated as
error is how far half of the modes are from all of them, which is more than what all still lack, and
how far their own errors move the sum: beside a resonance of zeta = 1e-4 a relative error of 1e-8 of
its frequency is 1e-4 of the response. The peak itself, and integrals over it, are not moved so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array, Integers, Numbers
from antinode.beam.families import FamilyName
from antinode.errors import ComputationError
from antinode.riccati.forced import Lanes

from .damping import UNDAMPED
from .forced import Forced, refined
from .frequency import Model
from .modal import MOST_MODES, Basis, basis, modes_below
from .quantities import Base, Drive, Output

SHAPE = 100.0
"""Relative error of a shape over the largest of all omega^2, at most: these are extrapolated."""
_TAIL = 0.25
"""What modes left out do beyond their rest, over the upper half of those that are summed, at most:
their shares fall at least like 1/n^4, but not their signs."""
_MORE = 2.0  # modes beyond the highest frequency, in frequencies
_FEWEST = 12


@dataclass(frozen=True)
class ModalSum:
    """A sum of modes with its static rest.

    Attributes
    ----------
    values : array, shape (outputs, drives, k)
        Outputs over drives, complex.
    error : array, shape (outputs, drives)
        Of the modes left out, of the static rest, and of the modes themselves.
    peak_error : array, shape (outputs, drives)
        The same at peaks, wherever they are: a frequency that is off moves a peak, no more.
    shift_hz : float
        How far a resonance may be from its frequency, at most, in the band.
    modes : int
        How many were summed, in all families.
    at : callable
        The same at other frequencies [Hz].
    doubt : callable
        How wrong each number there is, (outputs, drives, k).
    """

    values: Numbers
    error: Array
    peak_error: Array
    shift_hz: float
    modes: int
    at: Callable[[Array], Numbers]
    doubt: Callable[[Array], Array]


def modal_response(
    model: Model, frequency_hz: Array, modes: int | None, tolerance: float
) -> ModalSum:
    """Return the response of a model by modes of given damping.

    Parameters
    ----------
    modes : int, optional
        Of each family; by default as many as the tolerance takes.

    Raises
    ------
    ComputationError
        If no number of modes meets the tolerance, and none is given.
    """
    parts: list[Summed] = []
    bounds, settled = np.zeros((2, len(model.outputs), len(model.drives)))
    high = _MORE * model.highest_hz
    for family in model.families:
        number = modes or max(_FEWEST, modes_below(model.beam, family, high, model.backend))
        while True:
            part = Summed(model, family, number)
            error = part.error(frequency_hz)
            size = np.max(np.abs(part.at(frequency_hz)), axis=-1)
            if modes or np.all(error <= max(tolerance, 1e-9) * size + 1e-300):
                break
            if 2 * number > MOST_MODES:
                if np.all(error <= 0.01 * size + 1e-300):
                    break
                raise ComputationError(
                    f"{number} modes do not reach 1 % of the response; give a loss factor in place "
                    "of ratios of modes: then no mode is left out"
                )
            number *= 2
        parts.append(part)
        bounds += error + part.moved(frequency_hz)
        resonance = part.basis.frequency_hz
        inside = (resonance > frequency_hz[0]) & (resonance < frequency_hz[-1])
        places = np.concatenate([frequency_hz, resonance[inside]])
        settled += part.error(places) + part.moved(places, still=True)

    def at(places: Array) -> Numbers:
        return np.asarray(sum(part.at(places) for part in parts))

    def doubt(places: Array) -> Array:
        return np.asarray(sum(p.errors(places) + p.moves(places) for p in parts))

    count = sum(len(part.basis.omega2) for part in parts)
    shift = max((part.shift_hz(frequency_hz) for part in parts), default=0.0)
    return ModalSum(at(frequency_hz), bounds, settled, shift, count, at, doubt)


class Summed:
    """The modes of one family, summed."""

    def __init__(self, model: Model, family: FamilyName, modes: int) -> None:
        self.model, self.family = model, family
        self.basis = basis(
            model.beam, family, modes, model.drives, model.outputs, model.damping, model.backend
        )
        self.whole, self.whole_error = static_whole(model, family, self.shift)
        self.rest = self.whole - self._static(self.basis)

    @property
    def shift(self) -> float:
        """Sigma [rad^2/s^2]: below zero by the first elastic omega^2 and all divergence."""
        omega2 = self.basis.omega2
        elastic = omega2[omega2 > 1e-9 * np.max(np.abs(omega2))]
        return float(np.min(elastic) + 2 * np.max(np.maximum(-omega2, 0.0)))

    def rest_of(self, kept: Integers) -> Array:
        """Return the static rest beside some of the modes alone, (outputs, drives)."""
        return np.asarray(self.whole - self._static(self.basis.chosen(kept)))

    def _static(self, own: Basis) -> Array:
        """Return the sum at -sigma, of displacements, without rates, (outputs, drives)."""
        return own.outputs @ (own.drives / (own.omega2 + self.shift)[:, None])

    def at(self, frequency_hz: Array) -> Numbers:
        """Return outputs over drives, (outputs, drives, k)."""
        return self._sum(self.basis, self.rest, frequency_hz)

    def _sum(self, own: Basis, rest: Array, frequency_hz: Array) -> Numbers:
        omega = 2 * np.pi * frequency_hz
        coordinates = modal_coordinates(own, omega)
        H = np.einsum("on,kni->oik", own.outputs, coordinates) + rest[:, :, None]
        H = H + 1j * omega * np.einsum("on,kni->oik", own.drag, coordinates)
        return outputs_of(H, self.model.outputs, self.model.drives, omega, self.family)

    def error(self, frequency_hz: Array) -> Array:
        """Return the largest of `errors`, (outputs, drives)."""
        return np.asarray(np.max(self.errors(frequency_hz), axis=-1))

    def moved(self, frequency_hz: Array, still: bool = False) -> Array:
        """Return the largest of `moves`, (outputs, drives)."""
        return np.asarray(np.max(self.moves(frequency_hz, still), axis=-1))

    def errors(self, frequency_hz: Array) -> Array:
        """Return how far half of the modes are from all of them, and what is wrong at rest."""
        order = np.argsort(self.basis.omega2, kind="stable")
        half = order[: (len(order) + 1) // 2]
        few = self._sum(self.basis.chosen(half), self.rest_of(half), frequency_hz)
        missing = np.abs(self.at(frequency_hz) - few)
        upper = self.basis.chosen(order[(len(order) + 1) // 2 :])
        coordinates = modal_coordinates(upper, 2 * np.pi * frequency_hz)
        beyond = np.abs(coordinates - upper.drives / (upper.omega2 + self.shift)[:, None])
        missing = np.maximum(missing, _TAIL * self._sizes(upper, beyond, frequency_hz))
        rates = outputs_of(
            np.ones(missing.shape, complex) * self.whole_error[:, :, None],
            self.model.outputs,
            self.model.drives,
            2 * np.pi * frequency_hz,
            self.family,
            ground=False,
        )
        return np.asarray(missing + np.abs(rates))

    def moves(self, frequency_hz: Array, still: bool = False) -> Array:
        """Return how far the errors of the modes move the sum; `still`: but for their frequency."""
        own, omega = self.basis, 2 * np.pi * frequency_hz
        stiff = own.omega2 - omega[:, None] ** 2 + 1j * omega[:, None] * np.diag(own.damping)
        elastic = np.maximum(np.abs(own.omega2), 1e-9 * np.max(np.abs(own.omega2)))
        relative = SHAPE * np.max(own.doubts / elastic) + np.zeros(stiff.shape)
        if not still:
            relative = relative + own.doubts / np.abs(stiff)
        sizes = np.abs(modal_coordinates(own, omega)) * relative[:, :, None]
        return self._sizes(own, sizes, frequency_hz)

    def _sizes(self, own: Basis, sizes: Array, frequency_hz: Array) -> Array:
        """Return sums of moduli, (outputs, drives, k), of sizes (k, n, drives)."""
        omega, outputs = 2 * np.pi * frequency_hz, self.model.outputs
        c = np.abs(own.outputs)[:, None] + omega[:, None] * np.abs(own.drag)[:, None]
        H = np.einsum("okn,kni->oik", c, sizes).astype(complex)
        H = outputs_of(H, outputs, self.model.drives, omega, self.family, ground=False)
        return np.abs(H)

    def shift_hz(self, frequency_hz: Array) -> float:
        """Return how far a resonance between the first and the last frequency may be off [Hz]."""
        own, f = self.basis, self.basis.frequency_hz
        inside = (f > frequency_hz[0] / 1.1) & (f < frequency_hz[-1] * 1.1)
        off = own.doubts[inside] / (8 * np.pi**2 * f[inside])
        return float(np.max(off, initial=0.0))


def modal_coordinates(own: Basis, omega: Array) -> Numbers:
    """Return the modal coordinates under unit drives, shape (k, n, drives)."""
    inertia = own.omega2 - omega[:, None] ** 2
    C = own.damping
    if not np.any(C - np.diag(np.diag(C))):
        stiff = inertia + 1j * omega[:, None] * np.diag(C)
        return np.asarray(own.drives / stiff[:, :, None])
    D = 1j * omega[:, None, None] * C
    D[:, np.arange(len(C)), np.arange(len(C))] += inertia
    return np.asarray(
        np.linalg.solve(D, np.broadcast_to(own.drives, (len(omega), *own.drives.shape)))
    )


def outputs_of(
    H: Numbers,
    outputs: tuple[Output, ...],
    drives: tuple[Drive, ...],
    omega: Array,
    family: FamilyName,
    ground: bool = True,
) -> Numbers:
    """Return outputs from their relative components by unit forces and ground accelerations.

    The ground's own motion is added, motions are differentiated, and all is put over what is given
    of the ground.
    """
    H = np.array(H)
    s = 1j * omega
    for case, drive in enumerate(drives):
        if isinstance(drive, Base) and drive.family == family:
            H[:, case] *= s**2
            for row, output in enumerate(outputs):
                if ground and output.family == family and output.moves and not output.relative:
                    H[row, case] += 1.0
            H[:, case] /= s**drive.rate
    for row, output in enumerate(outputs):
        H[row] *= s**output.rate
    return H


def static_whole(model: Model, family: FamilyName, shift: float) -> tuple[Array, Array]:
    """Return what all modes do at ``omega^2 = -shift``, relative to the ground, and its error."""
    lanes = Lanes(np.array([-shift + 0j]), np.zeros(1, complex))
    rows = model.rows(family)
    outputs = tuple(
        Output(o.x, o.quantity, o.direction, o.side, relative=o.moves)
        for o in (model.outputs[row] for row in rows)
    )
    whole, error = (np.zeros((len(model.outputs), len(model.drives))) for _ in range(2))

    def compute(refinement: int) -> Array:
        forced = Forced(
            model.beam, family, model.drives, outputs, UNDAMPED, refinement, model.backend
        )
        H = forced.on(lanes)[:, :, 0].real
        for case, drive in enumerate(model.drives):
            if isinstance(drive, Base):
                H[:, case] /= shift  # by the acceleration of the ground, sigma times its motion
        return H[:, :, None]

    values, wrong = refined(
        model.beam, family, compute, model.first(family), 1e-9, [o.unit for o in outputs]
    )
    whole[rows], error[rows] = np.real(values[:, :, 0]), wrong[:, :, 0]
    return whole, error + 1e-12 * np.abs(whole)
