"""Random vibration: spectra of outputs, their rms with errors, crossings, peaks, who makes them.

    S_y = sum_jk conj(H_j) H_k S_jk,   rms^2 = int S_y df,   nu = sqrt(int f^2 S_y df / int S_y df)

One-sided densities over f [Hz]. A mode's share is what lies between the midpoints to its neighbours
in frequency; a force's share is what it makes together with those coherent with it: shares of
forces sum to one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arguments import ByValue
from antinode.arrays import Array, Numbers
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.methods import ResponseMethods

from .damping import Damping
from .equipment import Felt, Judge, Verdict, items_of
from .file import Problem, ResponseFile
from .frequency import Model
from .harmonic import bases, endless_at, output_keys, resonance_warnings
from .modal import Basis
from .modal_sum import modal_response
from .numbers import plain
from .peaks import Peak, find_peaks, with_resonances
from .quantities import Drive, Output
from .spectral.inputs import Inputs, inputs_of
from .spectral.moments import (
    Moments,
    OutputStatistics,
    by_modes,
    moments,
    statistics,
    without_bound,
)
from .units import spectral

_ENVELOPE = 41  # stations


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


def _band_of(problem: Problem) -> Array:
    """Return the frequencies of a file, or raise InputError where they are no band."""
    assert problem.file.frequency is not None
    frequency = problem.file.frequency.hertz()
    if len(frequency) < 2:
        raise InputError(
            f"{problem.where}: a random response needs a band: two frequencies or more"
        )
    return frequency


@out_of_range_is_an_error()
def solve_random(problem: Problem) -> RandomResult:
    """Compute the random response that a file asks for."""
    file, damping = problem.file, problem.damping
    frequency, inputs, items = _band_of(problem), inputs_of(problem), items_of(problem, "psd")
    band = float(frequency[0]), float(frequency[-1])
    drives, outputs = file.drives, (*file.outputs, *(item.output for item in items))
    model = Model(problem.beam, drives, outputs, damping, band[1], problem.backend)
    modes = bases(model)
    tolerance = file.response.tolerance
    resonance = np.concatenate([m.frequency_hz for m in modes])
    bends = inputs.kinks[(inputs.kinks > band[0]) & (inputs.kinks < band[1])]
    ratio = np.concatenate([m.ratio for m in modes])
    grid = with_resonances(np.union1d(frequency, bends), resonance, ratio)
    if damping.modal:
        summed = modal_response(model, frequency, file.response.modes, max(tolerance, 1e-6))
        model.use(summed.at, summed.doubt)
        H, error, wrong = summed.values, summed.error, summed.error
    else:
        beside = np.setdiff1d(grid, frequency)[: len(grid) if items else 0]
        H, error, wrong = model.response_with(frequency, beside, tolerance)
    psd = inputs.spectra_of(H, frequency)
    most = np.einsum("od,dk->ok", error, inputs.amplitudes(frequency))
    psd_error = np.max(2 * np.sqrt(psd) * most + most**2, axis=-1)

    def sizes(places: Array) -> Array:
        return inputs.spectra_of(model.quick(places), places)

    peaks = find_peaks(sizes, grid, sizes(grid))
    endless = [endless_at(modes, row, found, band) for row, found in enumerate(peaks)]
    kept = [row for row, mode in enumerate(endless) if not mode]
    own = moments(model.with_outputs(kept), inputs, modes, band, tolerance) if kept else None
    if own is not None and damping.modal:
        off = by_modes(summed, inputs, frequency, psd, kept, own.square)
        own = own._replace(error=own.error + off)
    found = _come_to(own, endless, file)
    shown, warnings = len(file.outputs), resonance_warnings(problem.beam, modes, *band)
    floor = np.max(np.maximum(error, wrong) @ inputs.amplitudes(grid), axis=-1) ** 2
    judge, verdicts = Judge(grid, modes, file.drive_names, 10.0), []
    for row, item in enumerate(items, shown):
        felt = _felt(row, model, inputs, float(floor[row]), grid)
        felt = felt._replace(endless=endless_at(modes, row, peaks[row], item.overlap(*band)))
        verdict = judge.verdict(item, felt, [peak.frequency_hz for peak in peaks[row]])
        verdicts.append(verdict.with_rms(found[row].rms))
    warnings += [told for verdict in verdicts for told in verdict.warnings]
    return RandomResult(
        problem.title,
        frequency,
        outputs[:shown],
        psd[:shown],
        psd_error[:shown],
        tuple(found[:shown]),
        tuple(map(tuple, peaks[:shown])),
        None if any(endless) else envelope_of(problem, inputs, modes, band),
        tuple(verdicts),
        file.random.duration,
        modes,
        damping,
        tuple(warnings),
    )


def _come_to(
    own: Moments | None, endless: Sequence[str], file: ResponseFile
) -> list[OutputStatistics]:
    """Return what all outputs come to, those too that nothing limits."""
    known = () if own is None else statistics(own, file.drive_names, file.random.duration)
    every = iter(known)
    return [without_bound(mode) if mode else next(every) for mode in endless]


def _felt(row: int, model: Model, inputs: Inputs, floor: float, grid: Array) -> Felt:
    """Return what a place feels: the spectrum of an output."""

    def shares(H: Numbers, f: Array) -> Array:
        return np.asarray(inputs.shares(H[row : row + 1], f)[0])

    def quick(f: Array) -> Array:
        return np.asarray(np.maximum(np.sum(shares(model.quick(f), f), axis=0), 0.0))

    def known(f: Array) -> tuple[Array, Array]:
        H, error = model.known(f)
        each = shares(H, f)
        most = np.sum(error[row] * inputs.amplitudes(f), axis=0)
        size = np.maximum(np.sum(each, axis=0), 0.0)
        return each, 2 * np.sqrt(size) * most + most**2

    return Felt(quick, known, floor if np.isfinite(floor) else float(np.max(known(grid)[1])))


def envelope_of(
    problem: Problem, inputs: Inputs, modes: tuple[Basis, ...], band: tuple[float, float]
) -> dict[str, Array] | None:
    """Return rms of acceleration and bending moment along the body; None without lateral ones."""
    file = problem.file
    if not file.random.envelope or file.direction != "lateral" or problem.damping.modal:
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
