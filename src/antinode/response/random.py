"""Random vibration: spectra of outputs, their rms with errors, crossings, peaks, who makes them.

    S_y = sum_jk conj(H_j) H_k S_jk,   rms^2 = int S_y df,   nu = sqrt(int f^2 S_y df / int S_y df)

One-sided densities over f [Hz]. Of a stationary Gaussian output the mean of the largest value in a
duration T is ``rms (g + 0.5772/g)``, ``g = sqrt(2 ln(nu T))`` (Davenport, Proc. Inst. Civ. Eng. 28
(1964) 187). A mode's share is what lies between the midpoints to its neighbours in frequency; a
force's share is what it makes together with those coherent with it: shares of forces sum to one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from antinode.arguments import ByValue
from antinode.arrays import Array, Numbers
from antinode.beam.families import FamilyName
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.methods import ResponseMethods

from .damping import Damping
from .equipment import Item, Verdict, items_of
from .file import Problem
from .forced import NOISE, largest_of_unit, refined_all
from .frequency import Model
from .harmonic import bases, output_keys, resonance_warnings
from .integrals import Pieces, integrate, pieces_of
from .modal import Basis
from .modal_sum import ModalSum, modal_response
from .numbers import plain
from .peaks import Peak, find_peaks, with_resonances
from .quantities import Drive, Output
from .spectra import Spectrum, spectrum_from
from .units import spectral

EULER = 0.5772156649015329
_ENVELOPE = 41  # stations
_NOISE = 1e-16  # share of a mean square, an rms of 1e-8, below which there is but rounding


class Inputs:
    """The spectra of all drives, and how they go together.

    Parameters
    ----------
    spectra : sequence of Spectrum
        One for each drive.
    coherence : array, shape (drives, drives), complex, optional
        ``S_jk/sqrt(S_jj S_kk)``; independent by default.

    Raises
    ------
    InputError
        If no random forces can go together so.
    """

    def __init__(self, spectra: Sequence[Spectrum], coherence: Numbers | None = None) -> None:
        self.spectra = tuple(spectra)
        n = len(self.spectra)
        self.coherence = np.eye(n, dtype=complex) if coherence is None else coherence
        if np.min(np.linalg.eigvalsh(self.coherence)) < -1e-9:
            raise InputError(
                "coherence: no random forces can be coherent so; if 1 goes with 2 and 2 with 3, "
                "then 1 must go with 3: give that coherence too"
            )

    @property
    def kinks(self) -> Array:
        """Where any of the spectra bends [Hz]."""
        return np.unique(np.concatenate([s.frequency_hz for s in self.spectra]))

    def amplitudes(self, frequency_hz: Array) -> Array:
        """Return the roots of the spectra, shape (drives, k)."""
        return np.asarray(np.sqrt(np.array([s.at(frequency_hz) for s in self.spectra])))

    def shares(self, H: Numbers, frequency_hz: Array) -> Array:
        """Return what each drive makes of the outputs' spectra, (outputs, drives, k)."""
        X = H * self.amplitudes(frequency_hz)
        together = np.einsum("jl,olk->ojk", self.coherence, X)
        return np.asarray(np.real(np.conj(X) * together))

    def spectra_of(self, H: Numbers, frequency_hz: Array) -> Array:
        """Return the outputs' spectra, (outputs, k)."""
        return np.asarray(np.maximum(np.sum(self.shares(H, frequency_hz), axis=1), 0.0))


class Moments(NamedTuple):
    """Integrals of the outputs' spectra."""

    square: Array
    """Mean squares, shape (outputs,)."""
    second: Array
    """int f^2 S_y df, shape (outputs,)."""
    error: Array
    """Of the mean squares, absolute."""
    by_mode: Array
    """Mean squares by cell, shape (outputs, cells)."""
    by_drive: Array
    """Mean squares by drive, shape (outputs, drives)."""
    bounds: Array
    """Of the cells [Hz], shape (cells + 1,)."""
    owners: tuple[str, ...]
    """The mode of each cell."""


@dataclass(frozen=True)
class OutputStatistics:
    """What a random output comes to.

    Attributes
    ----------
    rms, error : float
        Root mean square over the band, and how wrong it may be, SI.
    crossings_per_s : float
        Upward crossings of the mean.
    peak : float
        Mean of the largest value in the duration; NaN where it hardly crosses the mean.
    by_mode : tuple of (str, float, float, float)
        Mode, share of the mean square, and between which frequencies [Hz].
    by_drive : tuple of (str, float)
        Force, and its share.
    """

    rms: float
    error: float
    crossings_per_s: float
    peak: float
    by_mode: tuple[tuple[str, float, float, float], ...]
    by_drive: tuple[tuple[str, float], ...]


@dataclass(frozen=True, eq=False, repr=False)
class RandomResult(ResponseMethods, ByValue):
    """Spectra of outputs, and what they come to.

    Attributes
    ----------
    title : str
    frequency_hz : array, shape (k,)
    outputs : tuple of Output
    psd : array, shape (outputs, k)
        One-sided [unit^2/Hz].
    psd_error : array, shape (outputs,)
        Largest error of the psd at these frequencies.
    statistics : tuple of OutputStatistics
    peaks : tuple of tuple of Peak
        Of the spectra.
    envelope : dict or None
        Stations `x`, and rms of `acceleration` and `bending_moment` there.
    verdicts : tuple of Verdict
        Of the equipment.
    duration_s : float
    modes : tuple of Basis
    damping : Damping
    warnings : tuple of str
    """

    title: str
    frequency_hz: Array
    outputs: tuple[Output, ...]
    psd: Array = field(repr=False)
    psd_error: Array
    statistics: tuple[OutputStatistics, ...]
    peaks: tuple[tuple[Peak, ...], ...]
    envelope: dict[str, Array] | None
    verdicts: tuple[Verdict, ...]
    duration_s: float
    modes: tuple[Basis, ...] = field(repr=False)
    damping: Damping
    warnings: tuple[str, ...]

    kind = "random"

    @property
    def passed(self) -> bool:
        """Whether all equipment is within what it is qualified for."""
        return all(verdict.passed for verdict in self.verdicts)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON."""
        return {
            "schema_version": 1,
            "kind": self.kind,
            "name": self.title,
            "damping": self.damping.describe(),
            "duration_s": self.duration_s,
            "frequency_hz": self.frequency_hz.tolist(),
            "outputs": [self._row(row) for row in range(len(self.outputs))],
            "envelope": None
            if self.envelope is None
            else {key: plain(values) for key, values in self.envelope.items()},
            "equipment": [verdict.to_dict() for verdict in self.verdicts],
            "warnings": list(self.warnings),
        }

    def _row(self, row: int) -> dict[str, Any]:
        output, own = self.outputs[row], self.statistics[row]
        return {
            **output_keys(output),
            "psd_unit": spectral(output.unit),
            "psd": plain(self.psd[row]),
            "psd_error": plain(self.psd_error[row]),
            "rms": plain(own.rms),
            "error": plain(own.error),
            "three_sigma": plain(3 * own.rms),
            "crossings_per_s": plain(own.crossings_per_s),
            "peak": plain(own.peak),
            "by_mode": [
                {"mode": name, "share": plain(share), "from_hz": low, "to_hz": high}
                for name, share, low, high in own.by_mode
            ],
            "by_force": [{"force": name, "share": plain(share)} for name, share in own.by_drive],
            "peaks": [peak.to_dict() for peak in self.peaks[row]],
        }

    def curves(self) -> list[tuple[Output, Drive | None, Array, Array, str]]:
        """Return output, no drive, frequencies, spectrum and unit, for universal files."""
        rows = zip(self.outputs, self.psd, strict=True)
        return [(o, None, self.frequency_hz, psd, spectral(o.unit)) for o, psd in rows]

    def columns(self) -> list[tuple[str, Array]]:
        """Return a table: frequency, then the spectrum of each output."""
        rows = zip(self.outputs, self.psd, strict=True)
        return [
            ("frequency [Hz]", self.frequency_hz),
            *((f"{output.name} [{spectral(output.unit)}]", psd) for output, psd in rows),
        ]


def moments(
    model: Model,
    inputs: Inputs,
    modes: tuple[Basis, ...],
    band: tuple[float, float],
    tolerance: float,
) -> Moments:
    """Integrate the outputs' spectra over a band, each resonance at its own scale.

    Parameters
    ----------
    model : Model
        Not by ratios of modes.
    tolerance : float
        Relative, of the mean squares.
    """
    names = [name for own in modes for name in own.names]
    resonance = np.concatenate([own.frequency_hz for own in modes])
    ratio = np.concatenate([own.ratio for own in modes])
    real = resonance > 0
    names = [name for name, keep in zip(names, real, strict=True) if keep]
    pieces, bounds, owner = pieces_of(*band, resonance[real], ratio[real], inputs.kinks)
    count, top = len(bounds) - 1, band[1] ** 2
    last: dict[str, Array] = {}

    def compute(levels: dict[FamilyName, int]) -> Array:
        parts, wrong = _integrals(model, inputs, levels, pieces, count, tolerance / 10)
        square = np.sum(parts[:, 0], axis=-1)
        last.update(parts=parts, wrong=wrong[:, 0])
        return np.stack([square, np.sum(parts[:, 1], axis=-1) / top], axis=1)[:, :, None]

    first = {family: model.first(family) for family in model.families}
    better, error = refined_all(
        model.beam, first, compute, tolerance, [o.unit for o in model.outputs], NOISE**1.5
    )
    parts = last["parts"]
    square = better[:, 0, 0]
    return Moments(
        square,
        better[:, 1, 0] * top,
        error[:, 0, 0] + last["wrong"] + 1e-10 * square,
        parts[:, 0],
        np.sum(parts[:, 2:], axis=-1),
        bounds,
        tuple(names[k] for k in owner) if names else ("",) * count,
    )


def _integrals(
    model: Model,
    inputs: Inputs,
    levels: dict[FamilyName, int],
    pieces: Pieces,
    count: int,
    tolerance: float,
) -> tuple[Array, Array]:
    """Return integrals (outputs, 2 + drives, cells): of S, f^2 S, and the drives' shares of S."""
    number, kinds = len(model.outputs), 2 + len(inputs.spectra)

    def integrand(frequency_hz: Array) -> Array:
        shares = inputs.shares(model.on(levels, frequency_hz), frequency_hz)
        S = np.sum(shares, axis=1, keepdims=True)
        return np.concatenate([S, frequency_hz**2 * S, shares], axis=1).reshape(number * kinds, -1)

    units = [output.unit for output in model.outputs]

    def scales(whole: Array) -> Array:
        """Measure by the outputs' own; by the largest of a unit where rounding is all there is."""
        own = whole.reshape(number, kinds)
        own = np.maximum(own, _NOISE * largest_of_unit(own, units))
        own[:, 2:] = own[:, :1]
        return own.ravel()

    parts, error = integrate(integrand, pieces, count, tolerance, scales)
    return parts.reshape(number, kinds, count), error.reshape(number, kinds)


def _by_modes(
    summed: ModalSum, inputs: Inputs, frequency_hz: Array, psd: Array, square: Array
) -> Array:
    """Return how far the errors of summed modes move the mean squares.

    A resonance that is off in frequency takes what is at the ends of the band out of it or in, and
    meets another input there: that is less than ten times its relative error.
    """
    most = np.einsum("od,dk->ok", summed.peak_error, inputs.amplitudes(frequency_hz))
    wrong = np.max(2 * np.sqrt(psd) * most + most**2, axis=-1)
    relative = np.max(wrong / np.maximum(np.max(psd, axis=-1), 1e-300))
    ends = summed.shift_hz * (psd[:, 0] + psd[:, -1])
    return np.asarray((relative + 10 * summed.shift_hz / frequency_hz[0]) * square + ends)


def statistics(
    own: Moments, names: Sequence[str], duration_s: float
) -> tuple[OutputStatistics, ...]:
    """Return what the outputs come to."""
    found = []
    for row, square in enumerate(own.square.tolist()):
        rms, safe = float(np.sqrt(square)), square if square > 0 else 1.0
        nu = float(np.sqrt(max(own.second[row], 0.0) / safe))
        by_drive = [(n, float(v / safe)) for n, v in zip(names, own.by_drive[row], strict=True)]
        found.append(
            OutputStatistics(
                rms,
                float(own.error[row] / (2 * np.sqrt(safe))),
                nu,
                davenport(rms, nu, duration_s),
                _by_mode(own, row, safe),
                tuple(sorted(by_drive, key=lambda item: -item[1])),
            )
        )
    return tuple(found)


def _by_mode(own: Moments, row: int, whole: float) -> tuple[tuple[str, float, float, float], ...]:
    """Return modes with their shares and bands, the largest first."""
    merged: dict[str, tuple[str, float, float, float]] = {}
    for k, name in enumerate(own.owners):
        low, high = float(own.bounds[k]), float(own.bounds[k + 1])
        _, share, first, _ = merged.get(name, (name, 0.0, low, high))
        merged[name] = name, share + float(own.by_mode[row, k] / whole), first, high
    return tuple(sorted(merged.values(), key=lambda item: -item[1]))


def davenport(rms: float, crossings_per_s: float, duration_s: float) -> float:
    """Return the mean of the largest value in a duration; NaN for less than two crossings."""
    number = crossings_per_s * duration_s
    if number < 2:
        return float("nan")
    g = float(np.sqrt(2 * np.log(number)))
    return rms * (g + EULER / g)


def inputs_of(problem: Problem) -> Inputs:
    """Return the spectra of a file's drives.

    Raises
    ------
    InputError
        If a spectrum does not cover the band, or forces that go together are not there.
    """
    file = problem.file
    assert file.frequency is not None
    f = file.frequency.hertz()
    spectra = []
    for (name, table), drive in zip(file.drive_tables(), file.drives, strict=True):
        where = f"{problem.where}: {name}.psd"
        spectrum = spectrum_from(table.psd, spectral(drive.unit), problem.folder, where)
        spectrum.check_covers(float(f[0]), float(f[-1]))
        spectra.append(spectrum)
    names = list(file.drive_names)
    coherence = np.eye(len(names), dtype=complex)
    for k, entry in enumerate(file.coherence):
        for name in entry.forces:
            if names.count(name) != 1:
                raise InputError(
                    f"{problem.where}: coherence.{k}: there is no one force named '{name}'; forces "
                    f"are {', '.join(names)}"
                )
        i, j = (names.index(name) for name in entry.forces)
        coherence[i, j] = np.sqrt(entry.value) * np.exp(1j * entry.phase)
        coherence[j, i] = np.conj(coherence[i, j])
    return Inputs(spectra, coherence)


@out_of_range_is_an_error()
def solve_random(problem: Problem) -> RandomResult:
    """Compute the random response that a file asks for."""
    file, damping = problem.file, problem.damping
    assert file.frequency is not None
    frequency, inputs = file.frequency.hertz(), inputs_of(problem)
    if len(frequency) < 2:
        raise InputError(
            f"{problem.where}: a random response needs a band: two frequencies or more"
        )
    band = float(frequency[0]), float(frequency[-1])
    items = items_of(problem, "psd")
    drives, outputs = file.drives, (*file.outputs, *(item.output for item in items))
    model = Model(problem.beam, drives, outputs, damping, band[1], problem.backend)
    modes = bases(model)
    tolerance = file.response.tolerance
    if damping.modal:
        summed = modal_response(model, frequency, file.response.modes, max(tolerance, 1e-6))
        model.use(summed.at)
        H, error = summed.values, summed.error
    else:
        H, error = model.response(frequency, tolerance)
    psd = inputs.spectra_of(H, frequency)
    most = np.einsum("od,dk->ok", error, inputs.amplitudes(frequency))
    psd_error = np.max(2 * np.sqrt(psd) * most + most**2, axis=-1)
    own = moments(model, inputs, modes, band, tolerance)
    if damping.modal:
        own = own._replace(error=own.error + _by_modes(summed, inputs, frequency, psd, own.square))
    found = statistics(own, file.drive_names, file.random.duration)
    resonance = np.concatenate([m.frequency_hz for m in modes])
    grid = with_resonances(frequency, resonance, np.concatenate([m.ratio for m in modes]))

    def sizes(places: Array) -> Array:
        return inputs.spectra_of(model.quick(places), places)

    peaks = find_peaks(sizes, grid, sizes(grid))
    shown, warnings = len(file.outputs), resonance_warnings(problem.beam, modes, *band)
    verdicts = [
        _judge(item, shown + k, model, inputs, modes, peaks[shown + k], grid, file.drive_names)
        for k, item in enumerate(items)
    ]
    return RandomResult(
        problem.title,
        frequency,
        outputs[:shown],
        psd[:shown],
        psd_error[:shown],
        found[:shown],
        tuple(map(tuple, peaks[:shown])),
        envelope_of(problem, inputs, modes, band) if file.random.envelope else None,
        tuple(verdict.with_rms(found[shown + k].rms) for k, verdict in enumerate(verdicts)),
        file.random.duration,
        modes,
        damping,
        tuple(warnings),
    )


def _judge(
    item: Item,
    row: int,
    model: Model,
    inputs: Inputs,
    modes: tuple[Basis, ...],
    peaks: Sequence[Peak],
    grid: Array,
    names: Sequence[str],
) -> Verdict:
    """Compare an item's spectrum with what is allowed, at peaks and between them."""
    places = item.places(grid, [peak.frequency_hz for peak in peaks])
    shares = inputs.shares(model.quick(places)[row : row + 1], places)[0]
    return item.judged(places, shares, 10.0, modes, names)


def envelope_of(
    problem: Problem, inputs: Inputs, modes: tuple[Basis, ...], band: tuple[float, float]
) -> dict[str, Array] | None:
    """Return rms of acceleration and bending moment along the body; None without lateral ones."""
    file = problem.file
    if file.direction != "lateral" or problem.damping.modal:
        return None
    x = np.linspace(problem.beam.x[0], problem.beam.x[-1], _ENVELOPE)
    outputs = [
        Output(float(place), quantity)
        for quantity in ("acceleration", "bending_moment")
        for place in x
    ]
    model = Model(problem.beam, file.drives, outputs, problem.damping, band[1], problem.backend)
    own = moments(model, inputs, modes, band, 1e-4)
    rms = np.sqrt(own.square).reshape(2, -1)
    error = own.error / (2 * np.sqrt(np.maximum(own.square, 1e-300)))
    return {
        "x": x,
        "acceleration_rms": rms[0],
        "acceleration_error": error[: len(x)],
        "bending_moment_rms": rms[1],
        "bending_moment_error": error[len(x) :],
    }
