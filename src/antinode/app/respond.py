"""The response that the page shows: at once by two chains while something moves, then in full."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers
from antinode.beam.beam import Beam
from antinode.modes.hertz import hertz
from antinode.response.frequency import Model
from antinode.response.harmonic import HarmonicResult
from antinode.response.peaks import Peak, find_peaks, with_resonances
from antinode.response.solve import beam_response

from .asked import Wanted
from .quick import QUICK_FAMILY, Quick

_POINTS = 240  # of the curve, besides those at resonances
_LEAST_RATIO = 1e-4  # of damping, for points beside resonances


class Curve(NamedTuple):
    """A response over frequency.

    Attributes
    ----------
    frequency_hz : array, shape (k,)
    values : array, shape (k,)
        Complex, SI.
    peaks : tuple of Peak
    error : float
        Of the values; NaN while something moves.
    peak_error : float
        Of the sizes of the peaks; NaN while something moves.
    warnings : tuple of str
    """

    frequency_hz: Array
    values: Numbers
    peaks: tuple[Peak, ...]
    error: float = float("nan")
    peak_error: float = float("nan")
    warnings: tuple[str, ...] = ()


def _grid(wanted: Wanted, quick: Quick) -> Array:
    """Return frequencies with some beside the resonances that are known."""
    plain = np.geomspace(wanted.low, wanted.high, _POINTS)
    if wanted.output.family != QUICK_FAMILY:
        return plain
    resonance = hertz(np.maximum(quick.omega2, 0.0))
    ratio = np.full(len(resonance), max(wanted.damping.loss_factor / 2, _LEAST_RATIO))
    return with_resonances(plain, resonance, ratio)


def quick_curve(beam: Beam, wanted: Wanted, quick: Quick) -> Curve:
    """Return a response to about 1e-4, in some milliseconds: two chains, extrapolated."""
    model = Model(beam, [wanted.force], [wanted.output], wanted.damping, wanted.high)
    grid, family = _grid(wanted, quick), wanted.output.family
    first = model.first(family)
    for refinement in (first, 2 * first) if np.any(beam.varies(family)) else (first,):
        model.forced(family, refinement)
    values = wanted.amplitude * model.quick(grid)[0, 0]

    def sizes(places: Array) -> Array:
        return np.abs(wanted.amplitude * model.quick(places)[:, 0])

    peaks = find_peaks(sizes, grid, np.abs(values)[None, :])
    return Curve(grid, values, tuple(peaks[0]))


def full_curve(beam: Beam, wanted: Wanted, quick: Quick) -> Curve:
    """Return the response as `antinode response` computes it, with its error.

    Raises
    ------
    AntinodeError
        If there is none.
    """
    force, output = wanted.force, wanted.output
    result = beam_response(
        beam,
        "harmonic",
        frequency={"values": _grid(wanted, quick).tolist()},
        damping={"loss_factor": wanted.damping.loss_factor},
        forces=[{"x": force.x, "direction": force.direction, "amplitude": wanted.amplitude}],
        outputs=[{"x": output.x, "quantity": output.quantity, "direction": output.direction}],
    )
    assert isinstance(result, HarmonicResult)
    return Curve(
        result.frequency_hz,
        result.values[0],
        result.peaks[0],
        float(result.error[0]),
        float(result.peak_error[0]),
        result.warnings,
    )
