"""Figures of studies for those who work in Python: drawn, and given as their axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from antinode.show.objects.plots import AxesArray, axes_of
from antinode.show.style import PALETTE, on_screen, styled, zero_line

from .sensitivity.command import tornado
from .sweep.figures import plot_sweep

if TYPE_CHECKING:
    import xarray

    from .design.file import Study
    from .identify.result import Identification
    from .sensitivity.sensitivity import SensitivityResult


def sweep_axes(study: Study, dataset: xarray.Dataset) -> AxesArray:
    """Draw the frequencies of a sweep against the first input, as `antinode sweep --plot` does.

    Parameters
    ----------
    study : Study
    dataset : xarray.Dataset
        What ``study.run()`` returned.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
    """
    with on_screen():
        return axes_of(plot_sweep(study, dataset))


def sensitivity_axes(result: SensitivityResult) -> AxesArray:
    """Draw the Sobol indices of every mode, largest inputs on top.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        One for each mode.
    """
    with on_screen():
        return axes_of(tornado(result))


def identification_axes(result: Identification) -> AxesArray:
    """Draw how far every fitted frequency is from the observed one, with its deviation.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        Frequencies, and their relative differences [%].
    """
    observed = np.array([c.observed_hz for c in result.comparisons])
    fitted = np.array([c.fitted_hz for c in result.comparisons])
    sd = np.array([c.sd_hz for c in result.comparisons])
    at = np.arange(1, len(observed) + 1)
    with on_screen(), styled() as plt:
        figure, (above, below) = plt.subplots(
            2, 1, figsize=(7.1, 4.6), sharex=True, layout="constrained", height_ratios=(1.4, 1)
        )
        above.plot(at, observed, "o", ms=7, mfc="none", color=PALETTE[0], label="observed")
        above.plot(at, fitted, "x", color=PALETTE[1], label="fitted")
        above.set(ylabel="frequency [Hz]", title=f"{result.name}: identified")
        above.legend()
        relative = 100 * (fitted / observed - 1)
        below.errorbar(at, relative, 100 * sd / observed, fmt="o", ms=4, color=PALETTE[0])
        zero_line(below)
        below.set(xlabel="observed frequency, in order", ylabel="fitted less observed [%]")
    return axes_of(figure)
