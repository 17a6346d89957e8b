"""Figures for those who work in Python: drawn as the commands draw them, given as their axes.

    axes = beam.modes().plot()
    axes[0].figure.savefig("modes.png")

Nothing is written or shown: a notebook shows the figure by itself, elsewhere `pyplot.show` does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from antinode.modes.solve import beam_of
from antinode.show.figures import plot_beam, plot_forces, plot_loads, plot_modes
from antinode.show.response_figures import plot_response
from antinode.show.style import on_screen

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult
    from antinode.modes.solve import HasBeam
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads

AxesArray = npt.NDArray[np.object_]
"""Axes of matplotlib, from top to bottom."""


def axes_of(figure: Figure) -> AxesArray:
    """Return the axes of a figure, in the order in which they were made."""
    axes = np.empty(len(figure.axes), dtype=object)
    axes[:] = figure.axes
    return axes


def beam_axes(problem: Beam | HasBeam) -> AxesArray:
    """Draw a beam with what is attached, and its axial force, where there is one.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        From top to bottom.
    """
    with on_screen():
        return axes_of(plot_beam(beam_of(problem)))


def modes_axes(result: ModalResult, most: int = 6) -> AxesArray:
    """Draw a beam, the shapes of every family, the bending moments, and the axial force.

    Parameters
    ----------
    result : ModalResult
    most : int
        Modes of each family.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        From top to bottom.
    """
    with on_screen():
        return axes_of(plot_modes(result, most))


def case_axes(case: Case) -> AxesArray:
    """Draw the vehicle in its cavity, and N, Q and M along it.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        From top to bottom.
    """
    with on_screen():
        return axes_of(plot_loads(case))


def loads_axes(loads: Loads) -> AxesArray:
    """Draw N, Q and M along the body.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        From top to bottom.
    """
    with on_screen():
        return axes_of(plot_forces(loads))


def response_axes(result: Any) -> AxesArray:
    """Draw a response: a panel for each output, and one for each unit of equipment.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        From top to bottom.
    """
    with on_screen():
        return axes_of(plot_response(result))
