"""Figures 9 to 15: characteristic functions and modes (equations 48 to 81), at sigma = 0.025."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import BENDING, LONGITUDINAL, FamilyName
from antinode.riccati.literal import riccati_characteristic, tmm_characteristic
from antinode.show.style import GREY, INK, zero_line

from .plates import COLOURS, letter, sheet
from .scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Drawn = tuple["Figure", str]
_HIGHEST = 70.0  # Hz
_BLUE, _RED, _GREEN, _PINK = COLOURS[:4]
_FAMILIES = (BENDING, LONGITUDINAL)
_AMPLITUDE = 1e-3  # m
_LINEAR = 0.05  # below it the scale of figure 9 is linear


# --- figure 9 -----------------------------------------------------------------------------------


def characteristic(scene: Scene) -> Drawn:
    """Draw the Riccati characteristic function with roots and poles, and that of the TMM."""
    figure, panels = sheet(5.6, 3, 2, height_ratios=(1.35, 1.15, 1.0), gridspec_kw={"hspace": 0.02})
    riccati, tmm = (_across(figure, panels, row) for row in (0, 1))
    _riccati(riccati, scene, _grid(scene, 0.0, _HIGHEST))
    letter(riccati, "Riccati: product of signs times det S", "a")
    riccati.set(xlim=(0, _HIGHEST), xlabel="frequency [Hz]")
    riccati.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    _transfer_matrix(tmm, scene)
    letter(tmm, "transfer matrices: size of the determinant", "b")
    for number, axes, mark in ((1, panels[2, 0], "c"), (5, panels[2, 1], "d")):
        _close_up(axes, scene, number, mark)
    return figure, (
        f"Characteristic functions at σ = {scene.modal.loads.sigma:g}. (a) The Riccati form, eq. "
        "74 and 80, bending times longitudinal, each scaled by the wave number at its frequency; "
        "the vertical scale is linear near zero and logarithmic from about 0.1 on. Roots are the "
        "natural frequencies. Poles lie where the vehicle with its tail clamped would vibrate; "
        "thanks to the product of signs both sides of a pole go the same way. The rotation of the "
        "free vehicle diverges: its ω² is negative and has no place on this axis. (b) The "
        "determinant of the transfer matrix method, eq. 66, over the size of its matrix: the same "
        "roots without poles, but it sinks with frequency towards the rounding of the computer, "
        "where it loses its sign. (c), (d) Close-ups of (a): a pole stands right beside a root."
    )


def _across(figure: Figure, panels: Any, row: int) -> Axes:
    """Join the panels of a row."""
    grid = panels[row, 0].get_gridspec()
    for axes in panels[row]:
        axes.remove()
    return figure.add_subplot(grid[row, :])


def _roots(scene: Scene, family: str) -> Array:
    found = np.array([mode.frequency_hz for mode in scene.elastic(family)])
    return found[found < _HIGHEST]


def _poles(scene: Scene, family: str) -> Array:
    modes = scene.clamped_tail.modes
    found = np.array([m.frequency_hz for m in modes if m.family == family and m.omega2 > 0])
    return found[found < _HIGHEST]


def _grid(scene: Scene, low: float, high: float) -> Array:
    """Frequencies that crowd round roots and poles [Hz]."""
    marks = np.concatenate([f(scene, family) for f in (_roots, _poles) for family in _FAMILIES])
    near = np.geomspace(1e-7, 1.0, 17)
    crowd = (marks[:, None] + np.concatenate([-near, near])).ravel()
    f = np.union1d(np.linspace(low, high, 201), crowd)
    return np.asarray(f[(f > max(low, 0.02)) & (f < high)])


def _riccati(axes: Axes, scene: Scene, f: Array) -> None:
    omega2 = (2 * math.pi * f) ** 2
    values = np.ones_like(f)
    for family in _FAMILIES:
        values = values * riccati_characteristic(_chain(scene, family), omega2)
    axes.plot(f, values, color=INK, linewidth=1.0, zorder=2)
    axes.set_yscale("asinh", linear_width=_LINEAR)
    ticks = [-100, -1, 0, 1, 100]
    axes.set_yticks(ticks, [f"{tick}".replace("-", "\u2212") for tick in ticks])
    axes.set_yticks([-10, -0.1, 0.1, 10], [], minor=True)
    axes.set(ylim=(-400, 400))
    _mark(axes, scene)
    zero_line(axes)
    axes.set(ylabel=r"$\Delta_{RTMM}$, scaled [-]")


def _mark(axes: Axes, scene: Scene) -> None:
    """Mark roots on the line of zero, and poles."""
    marks = ((BENDING, "o", _BLUE, "--"), (LONGITUDINAL, "s", _GREEN, ":"))
    for family, marker, colour, dashes in marks:
        roots = _roots(scene, family)
        axes.plot(
            roots,
            0 * roots,
            marker,
            color=colour,
            markersize=4.5,
            zorder=4,
            label=f"root, {family}",
        )
        for k, pole in enumerate(_poles(scene, family)):
            label = None if k else f"pole, {family}"
            axes.axvline(pole, color=_RED, linestyle=dashes, linewidth=0.9, zorder=1.5, label=label)


def _chain(scene: Scene, family: Any) -> Any:
    return scene.result.solutions[family].chain


def _transfer_matrix(axes: Axes, scene: Scene) -> None:
    f = _grid(scene, 0.0, _HIGHEST)
    omega2 = (2 * math.pi * f) ** 2
    values = np.ones_like(f)
    for family in _FAMILIES:
        values = values * tmm_characteristic(_chain(scene, family), omega2)
    size = np.abs(values)
    for sign, colour, text in ((1, INK, "positive"), (-1, _PINK, "negative")):
        part = np.where(np.sign(values) == sign, size, np.nan)
        axes.semilogy(f, part, color=colour, linewidth=1.2, label=text)
    axes.axhspan(1e-18, np.finfo(float).eps, color=GREY, alpha=0.18, linewidth=0, label="rounding")
    axes.set(xlim=(0, _HIGHEST), ylim=(1e-18, 10), xlabel="frequency [Hz]")
    axes.set(ylabel=r"$|\Delta_{TMM}|$, scaled [-]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def _close_up(axes: Axes, scene: Scene, number: int, mark: str) -> None:
    root = scene.result.mode(BENDING, number).frequency_hz
    poles = _poles(scene, BENDING)
    pole = float(poles[np.argmin(np.abs(poles - root))])
    half = 3.0 * abs(pole - root)
    low, high = root - half, root + half
    _riccati(axes, scene, _grid(scene, low, high))
    axes.set(xlim=(low, high), xlabel="frequency [Hz]")
    letter(axes, f"bending {number}", mark)


# --- figures 10 to 15 ---------------------------------------------------------------------------


@dataclass(frozen=True)
class StateFigure:
    """A figure of one component of the state of modes 1 to 6.

    Attributes
    ----------
    family : {"bending", "longitudinal"}
    index : int
        Of the component.
    factor : float
        From SI to the units of the label.
    label : str
        Along the vertical axis.
    caption : str
        With ``{at}`` for the cavitation number and ``{largest}`` for the amplitude.
    beside : bool
        Whether the same without axial force is drawn thinly beside it.
    """

    family: FamilyName
    index: int
    factor: float
    label: str
    caption: str
    beside: bool = False

    def __call__(self, scene: Scene) -> Drawn:
        """Draw it."""
        at = f"at σ = {scene.modal.loads.sigma:g}"
        largest = "of modes whose largest displacement is 1 mm"
        return self._drawn(scene), self.caption.format(at=at, largest=largest)

    def _drawn(self, scene: Scene) -> Figure:
        figure, panels = sheet(3.7, 2, sharex=True)
        modes = scene.elastic(self.family)
        x = np.linspace(0, scene.modal.vehicle.length, 401)
        states = scene.result.at(x, self.family)
        columns = {m.name: k for k, m in enumerate(scene.result.family(self.family))}
        plain = scene.unloaded.at(x, self.family) if self.beside else None
        places = {m.name: k for k, m in enumerate(scene.unloaded.family(self.family))}
        for axes, first, mark in ((panels[0], 0, "a"), (panels[1], 3, "b")):
            for k, dashes in zip(range(first, first + 3), ("-", "--", "-."), strict=True):
                values = states[:, columns[modes[k].name], self.index] * _AMPLITUDE * self.factor
                text = f"{modes[k].name}\n{modes[k].frequency_hz:.3f} Hz"
                axes.plot(x, values, color=COLOURS[k], linestyle=dashes, label=text)
                if plain is not None:
                    scale = _AMPLITUDE * self.factor
                    without = plain[:, places[modes[k].name], self.index] * scale
                    axes.plot(x, without, color=INK, linewidth=0.6, zorder=1.5)
            zero_line(axes)
            letter(axes, f"modes {first + 1} to {first + 3}", mark)
            axes.set_ylabel(self.label)
            axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), labelspacing=0.9)
        panels[1].set(xlabel="x from the nose [m]", xlim=(0, scene.modal.vehicle.length))
        drawn: Figure = figure
        return drawn


shapes_x = StateFigure(
    LONGITUDINAL,
    0,
    1e3,
    "X [mm]",
    "Longitudinal modes {at}: axial displacement X (eq. 48 and 81), positive aft, for a largest "
    "displacement of 1 mm. The axial force changes bending only, and EA is assumed: these "
    "frequencies are the reconstruction's own, not the paper's.",
)
shapes_y = StateFigure(
    BENDING,
    0,
    1e3,
    "Y [mm]",
    "Bending modes {at} under the axial force: lateral displacement Y (eq. 49 and 81), positive "
    "up, for a largest displacement of 1 mm. Thin: the same without axial force.",
    beside=True,
)
shapes_theta = StateFigure(
    BENDING,
    1,
    1e3,
    r"$\theta_z$ [mrad]",
    "Rotation θ_z = dY/dx (eq. 52) {largest}, {at}. x runs aft, so that a positive rotation is "
    "nose-down. Thin: the same without axial force.",
    beside=True,
)
forces_x = StateFigure(
    LONGITUDINAL,
    1,
    1e-3,
    "$Q_x$ [kN]",
    "Axial force Q_x = −EA dX/dx (eq. 55), compression positive, {largest}, {at}. It vanishes at "
    "both free ends. EA is assumed.",
)
forces_y = StateFigure(
    BENDING,
    3,
    1e-3,
    "$Q_y$ [kN]",
    "Lateral force Q_y = M_z' + N θ_z (eq. 54) {largest}, {at}. It keeps the direction across the "
    "undeformed axis, is continuous where N steps, and vanishes at both free ends.",
)
moments = StateFigure(
    BENDING,
    2,
    1e-3,
    "$M_z$ [kN m]",
    "Bending moment M_z = EI d²Y/dx² (eq. 53) {largest}, {at}. It vanishes at both free ends.",
)
