"""The response that the page shows: by three chains while something moves, then in full."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers
from antinode.beam.beam import Beam
from antinode.modes.hertz import hertz
from antinode.response.damping import Damping
from antinode.response.frequency import Model
from antinode.response.harmonic import HarmonicResult
from antinode.response.modal_sum import modal_response
from antinode.response.peaks import Peak, find_peaks, with_resonances
from antinode.response.quantities import Force
from antinode.response.solve import beam_response

from .asked import Wanted
from .quick import QUICK_FAMILY, Quick

_POINTS = 240  # of the curve, besides those at resonances
_LEAST_RATIO = 1e-4  # of damping, for points beside resonances
_BY_MODES = 1e-2  # of a sum of modes, while something moves


class Curve(NamedTuple):
    """A response over frequency.

    Attributes
    ----------
    frequency_hz : array, shape (k,)
    values : array, shape (k,)
        Complex, SI.
    peaks : tuple of Peak
    error : float
        Of the values.
    peak_error : tuple of float
        Of the size of each peak.
    warnings : tuple of str
    """

    frequency_hz: Array
    values: Numbers
    peaks: tuple[Peak, ...]
    error: float
    peak_error: tuple[float, ...]
    warnings: tuple[str, ...] = ()


def _grid(wanted: Wanted, quick: Quick) -> Array:
    """Return frequencies with some beside the resonances that are known."""
    plain = np.geomspace(wanted.low, wanted.high, _POINTS)
    if wanted.output.family != QUICK_FAMILY:
        return plain
    resonance = hertz(np.maximum(quick.omega2, 0.0))
    return with_resonances(plain, resonance, _ratios(wanted.damping, resonance))


def _ratios(damping: Damping, resonance_hz: Array) -> Array:
    """Return about how wide resonances are."""
    if damping.rayleigh is not None:
        return damping.rayleigh.ratio(2 * np.pi * np.maximum(resonance_hz, 1e-6))
    ratio = damping.modal[0] if damping.modal else damping.loss_factor / 2
    return np.full(len(resonance_hz), max(ratio, _LEAST_RATIO))


def quick_curve(beam: Beam, wanted: Wanted, quick: Quick) -> Curve:
    """Return a response in some milliseconds, with its errors: three chains, or some modes."""
    model = Model(beam, [wanted.drive], [wanted.output], wanted.damping, wanted.high)
    grid, a = _grid(wanted, quick), wanted.amplitude
    if wanted.damping.modal:
        return _summed(model, grid, a)
    values, error = (a * part[0, 0] for part in model.judged(grid))

    def sizes(places: Array) -> Array:
        return np.abs(a * model.quick(places)[:, 0])

    peaks = tuple(find_peaks(sizes, grid, np.abs(values)[None, :])[0])
    return Curve(grid, values, peaks, float(np.max(error)), _of_peaks(model, peaks, a))


def _of_peaks(model: Model, peaks: tuple[Peak, ...], amplitude: float) -> tuple[float, ...]:
    """Return the error of each peak: the largest where it may be."""
    if not peaks:
        return ()
    places, back = np.unique([(*p.bracket_hz, p.frequency_hz) for p in peaks], return_inverse=True)
    error = amplitude * model.judged(places)[1][0, 0]
    return tuple(np.max(error[back.reshape(-1, 3)], axis=1).tolist())


def _summed(model: Model, grid: Array, amplitude: float) -> Curve:
    """Return a response by ratios of modes."""
    found = modal_response(model, grid, None, _BY_MODES)

    def sizes(places: Array) -> Array:
        return np.abs(amplitude * found.at(places)[:, 0])

    peaks = tuple(find_peaks(sizes, grid, sizes(grid))[0])
    error, wrong = (amplitude * float(part[0, 0]) for part in (found.error, found.peak_error))
    return Curve(grid, amplitude * found.values[0, 0], peaks, error, (wrong,) * len(peaks))


def full_curve(beam: Beam, wanted: Wanted, quick: Quick) -> Curve:
    """Return the response as `antinode response` computes it, with its error.

    Raises
    ------
    AntinodeError
        If there is none.
    """
    drive, output, rayleigh = wanted.drive, wanted.output, wanted.damping.rayleigh
    driven: dict[str, Any] = {"direction": drive.direction, "amplitude": wanted.amplitude}
    lost: dict[str, Any] = {"loss_factor": wanted.damping.loss_factor}
    if wanted.damping.modal:
        lost = {"modal": wanted.damping.modal}
    elif rayleigh is not None:
        ends = wanted.low, wanted.high
        ratios = [float(rayleigh.ratio(np.array(2 * np.pi * f))) for f in ends]
        lost = {"rayleigh": {"ratios": ratios, "frequencies": ends}}
    given = {"forces": [{"x": drive.x, **driven}]} if isinstance(drive, Force) else {"base": driven}
    result = beam_response(
        beam,
        "harmonic",
        frequency={"values": _grid(wanted, quick).tolist()},
        damping=lost,
        outputs=[{"x": output.x, "quantity": output.quantity, "direction": output.direction}],
        **given,
    )
    assert isinstance(result, HarmonicResult)
    return Curve(
        result.frequency_hz,
        result.values[0],
        result.peaks[0],
        float(result.error[0]),
        (float(result.peak_error[0]),) * len(result.peaks[0]),
        result.warnings,
    )
