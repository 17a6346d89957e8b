"""Harmonic responses: amplitudes of outputs under forces of given amplitudes, with their peaks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arguments import ByValue
from antinode.arrays import Array, Numbers
from antinode.beam.beam import Beam
from antinode.beam.limits import out_of_range_is_an_error
from antinode.methods import ResponseMethods

from .damping import Damping
from .equipment import Felt, Item, Judge, Verdict, items_of
from .file import Problem
from .frequency import Model
from .modal import Basis, basis, modes_below, orthogonal, without_orthogonality
from .modal_sum import modal_response
from .motion.loops import resonant
from .numbers import plain
from .peaks import Peak, find_peaks, with_resonances
from .quantities import Drive, Output

_DOUBTFUL = 0.5  # half-widths of a resonance
_NODE = 1e-9  # of the largest part of a mode in an output
_AT_ONE = 1e-6  # relative, of a peak and a resonance that are one
_ABOVE = 1.2  # of the highest frequency up to which resonances are looked up


@dataclass(frozen=True, eq=False, repr=False)
class HarmonicResult(ResponseMethods, ByValue):
    """Numbers amplitudes of outputs over frequency.

    Attributes
    ----------
    title : str
    frequency_hz : array, shape (k,)
    outputs : tuple of Output
    values : array, shape (outputs, k)
        Numbers amplitudes, time as exp(+i omega t), SI.
    error : array, shape (outputs,)
        Largest distance of any value from the beam's own, SI.
    peak_error : array, shape (outputs,)
        The same of the sizes of its peaks.
    shares : array, shape (outputs, drives, k)
        What each drive makes of it, complex.
    drives : tuple of Force or Base
    drive_names : tuple of str
    amplitudes : array, shape (drives,)
        Complex, SI.
    peaks : tuple of tuple of Peak
        Of each output, inside the band.
    modes : tuple of Basis
        What resonates, by family.
    verdicts : tuple of Verdict
        Of the equipment.
    damping : Damping
    warnings : tuple of str
    """

    title: str
    frequency_hz: Array
    outputs: tuple[Output, ...]
    values: Numbers = field(repr=False)
    error: Array
    peak_error: Array
    shares: Numbers = field(repr=False)
    drives: tuple[Drive, ...]
    drive_names: tuple[str, ...]
    amplitudes: Numbers
    peaks: tuple[tuple[Peak, ...], ...]
    modes: tuple[Basis, ...] = field(repr=False)
    verdicts: tuple[Verdict, ...]
    damping: Damping
    warnings: tuple[str, ...]

    kind = "harmonic"

    @property
    def passed(self) -> bool:
        """Whether all equipment is within what it is qualified for."""
        return all(verdict.passed for verdict in self.verdicts)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON."""
        rows = []
        for row, output in enumerate(self.outputs):
            rows.append(
                {
                    **output_keys(output),
                    "real": plain(self.values[row].real),
                    "imag": plain(self.values[row].imag),
                    "error": plain(self.error[row]),
                    "peak_error": plain(self.peak_error[row]),
                    "peaks": [peak.to_dict() for peak in self.peaks[row]],
                }
            )
        return {
            "schema_version": 1,
            "kind": self.kind,
            "name": self.title,
            "damping": self.damping.describe(),
            "frequency_hz": self.frequency_hz.tolist(),
            "outputs": rows,
            "equipment": [verdict.to_dict() for verdict in self.verdicts],
            "warnings": list(self.warnings),
        }

    def curves(self) -> list[tuple[Output, Drive | None, Array, Numbers, str]]:
        """Return output, drive, frequencies, output over drive and unit, for universal files."""
        return [
            (
                o,
                d,
                self.frequency_hz,
                self.shares[i, j] / self.amplitudes[j],
                f"{o.unit}/({d.unit})",
            )
            for i, o in enumerate(self.outputs)
            for j, d in enumerate(self.drives)
            if d.family == o.family
        ]

    def columns(self) -> list[tuple[str, Array]]:
        """Return a table: frequency, then real and imaginary part of each output."""
        table = [("frequency [Hz]", self.frequency_hz)]
        for output, values in zip(self.outputs, self.values, strict=True):
            table.append((f"{output.name}, real [{output.unit}]", values.real))
            table.append((f"{output.name}, imag [{output.unit}]", values.imag))
        return table


def output_keys(output: Output) -> dict[str, Any]:
    """Return what an output is, for JSON."""
    return {
        "x": output.x,
        "quantity": output.quantity,
        "direction": output.direction,
        "side": output.side,
        "relative": output.relative,
        "unit": output.unit,
    }


def bases(model: Model) -> tuple[Basis, ...]:
    """Return all modes up to a model's highest frequency, as a basis, of each driven family.

    Where an end force follows, or something feeds back, they are those of a beam near by, with
    the frequencies and ratios of the complex modes.
    """
    beam, backend = orthogonal(model.beam), model.backend
    number = {
        family: modes_below(beam, family, _ABOVE * model.highest_hz, backend) + 1
        for family in dict.fromkeys(drive.family for drive in model.drives)
    }
    found = (
        basis(beam, family, count, model.drives, model.outputs, model.damping, backend)
        for family, count in number.items()
    )
    coupled = bool(without_orthogonality(model.beam)) and not model.damping.modal
    return tuple(
        resonant(model, family, own) if coupled else own
        for family, own in zip(number, found, strict=True)
    )


def resonance_warnings(beam: Beam, modes: tuple[Basis, ...], low: float, high: float) -> list[str]:
    """Say which modes in a band have no damping, and if resonances are not known well enough."""
    why = without_orthogonality(beam)
    if why and any(own.doubt > _DOUBTFUL for own in modes):
        return [
            f"{why}: the response is exact, but its resonances are known to "
            f"{max(own.doubt for own in modes):.1g} of their half-widths only; a peak narrower "
            "than the frequencies are apart may be missed: give more of them"
        ]
    names = [
        name
        for own in modes
        for name, f, ratio in zip(own.names, own.frequency_hz, own.ratio, strict=True)
        if low <= f <= high and ratio == 0.0
    ]
    if not names:
        return []
    return [
        f"no damping: at {', '.join(names[:6])} the response grows without bound, and only how "
        "near a frequency comes to the resonance limits it; give [damping] loss_factor"
    ]


def endless_at(
    modes: tuple[Basis, ...], row: int, peaks: Sequence[Peak], band: tuple[float, float]
) -> str:
    """Return the first mode in a band without damping at which an output peaks; else nothing.

    At the node of a mode rounding peaks as well, but the mode has no part in it.
    """
    for own in modes:
        part = np.abs(own.outputs[row]) * np.max(np.abs(own.drives), axis=1)
        free = (own.ratio == 0.0) & (part > _NODE * np.max(part, initial=0.0))
        for k in np.flatnonzero(free):
            f = own.frequency_hz[k]
            near = (abs(peak.frequency_hz / f - 1) < _AT_ONE for peak in peaks)
            if band[0] <= f <= band[1] and any(near):
                return own.names[k]
    return ""


@out_of_range_is_an_error()
def solve_harmonic(problem: Problem) -> HarmonicResult:
    """Compute the response that a file asks for.

    Raises
    ------
    InputError
        If a station is off the beam, or the beam lacks what is asked for.
    """
    file, damping = problem.file, problem.damping
    assert file.frequency is not None
    frequency, amplitude = file.frequency.hertz(), file.amplitudes()
    items, shown = items_of(problem, "amplitude"), len(file.outputs)
    drives, outputs = file.drives, (*file.outputs, *(item.output for item in items))
    model = Model(problem.beam, drives, outputs, damping, float(frequency[-1]), problem.backend)
    modes = bases(model)
    resonance = np.concatenate([own.frequency_hz for own in modes])
    ratio = np.concatenate([own.ratio for own in modes])
    grid = with_resonances(frequency, resonance, ratio) if len(frequency) > 1 else frequency
    if damping.modal:
        summed = modal_response(model, frequency, file.response.modes, file.response.tolerance)
        H, error, wrong = summed.values, summed.error, summed.peak_error
        model.use(summed.at, summed.doubt)
    else:
        beside = np.setdiff1d(grid, frequency)
        H, error, wrong = model.response_with(frequency, beside, file.response.tolerance)
        wrong = np.maximum(error, wrong)
    shares = H * amplitude[:, None]

    def sizes(places: Array) -> Array:
        return np.asarray(np.abs(np.einsum("odk,d->ok", model.quick(places), amplitude)))

    peaks = find_peaks(sizes, grid, sizes(grid)) if len(grid) > 2 else [[] for _ in outputs]
    band = float(frequency[0]), float(frequency[-1])
    endless = [bool(endless_at(modes, row, found, band)) for row, found in enumerate(peaks)]
    wrong = np.where(endless, np.inf, wrong @ np.abs(amplitude))
    judge = Judge(grid, modes, file.drive_names, 20.0)
    verdicts = [
        _judged(judge, item, row, model, amplitude, peaks[row], wrong[row])
        for row, item in enumerate(items, shown)
    ]
    warnings = resonance_warnings(problem.beam, modes, *band)
    warnings += [told for verdict in verdicts for told in verdict.warnings]
    return HarmonicResult(
        problem.title,
        frequency,
        outputs[:shown],
        shares.sum(axis=1)[:shown],
        (error @ np.abs(amplitude))[:shown],
        wrong[:shown],
        shares[:shown],
        drives,
        file.drive_names,
        amplitude,
        tuple(map(tuple, peaks[:shown])),
        modes,
        tuple(verdicts),
        damping,
        tuple(warnings),
    )


def _judged(
    judge: Judge,
    item: Item,
    row: int,
    model: Model,
    amplitude: Numbers,
    peaks: Sequence[Peak],
    wrong: float,
) -> Verdict:
    """Compare what an item feels with what it may, at peaks and between them."""

    def quick(f: Array) -> Array:
        return np.asarray(np.abs(amplitude @ model.quick(f)[row]))

    def known(f: Array) -> tuple[Array, Array]:
        H, error = (part[row] for part in model.known(f))
        each, whole = np.abs(H * amplitude[:, None]), np.abs(amplitude @ H)
        part = each / np.maximum(np.sum(each, axis=0), 1e-300)
        return part * whole, np.abs(amplitude) @ error

    band = item.overlap(float(judge.frequency_hz[0]), float(judge.frequency_hz[-1]))
    floor = wrong if np.isfinite(wrong) else float(np.max(known(judge.frequency_hz)[1]))
    felt = Felt(quick, known, floor, endless_at(judge.modes, row, peaks, band))
    return judge.verdict(item, felt, [peak.frequency_hz for peak in peaks])
