"""Figures: mode shapes, internal forces, and the vehicle to scale in its cavity (matplotlib)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from antinode.beam.families import FAMILIES
from antinode.errors import InputError
from antinode.modes.result import ModalResult, Mode
from antinode.whole import write_file

from .sketch import draw_beam, mark_stations
from .style import BODY, EDGE, GREY, INK, WATER, WIDTH, styled, zero_line
from .style import PALETTE as PALETTE
from .style import STYLE as STYLE
from .style import pyplot as pyplot
from .writing import check_output

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from antinode.beam.beam import Beam
    from antinode.beam.families import FamilyName
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads
    from antinode.vehicle.vehicle import FinSet, Vehicle

ENDINGS = (".png", ".svg", ".pdf")


def check_plot(path: Path) -> None:
    """Raise InputError if a figure of this name cannot be drawn, before any work is done."""
    check_output(path, ENDINGS)
    pyplot()


def save(figure: Figure, path: Path) -> None:
    """Write a figure to .png, .svg or .pdf."""
    try:
        with styled():
            kind = path.suffix[1:].lower()
            write_file(path, lambda partial: figure.savefig(partial, format=kind))
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror or error})") from error
    finally:
        pyplot().close(figure)


@styled()
def plot_modes(result: ModalResult, most: int = 6) -> Figure:
    """Draw a beam with what is attached, the shapes of every family, and the bending moments.

    The axial force stands below, where there is one.
    """
    beam, panels = result.beam, _panels(result, most)
    figure, axes = _stack((0.45, *[1.0] * (len(panels) + (not beam.is_unloaded))))
    draw_beam(beam, axes[0])
    _draw_panels(panels, result, axes[1:])
    if not beam.is_unloaded:
        _axial_force_of_beam(beam, axes[-1])
    for panel in axes[1:]:
        mark_stations(beam, panel)
    return _titled(figure, axes, f"{beam.name}: natural modes", "x from the left end [m]")


@styled()
def plot_beam(beam: Beam) -> Figure:
    """Draw a beam with what is attached, and its axial force, where there is one."""
    figure, axes = _stack((0.6,) if beam.is_unloaded else (0.6, 1.0))
    draw_beam(beam, axes[0])
    if not beam.is_unloaded:
        _axial_force_of_beam(beam, axes[1])
        mark_stations(beam, axes[1])
    return _titled(figure, axes, "", "x from the left end [m]")


@styled()
def plot_case(case: Case, result: ModalResult, most: int = 6) -> Figure:
    """Draw the vehicle in its cavity, its axial force and its modes, one above the other."""
    panels = _panels(result, most)
    figure, axes = _stack((0.7, *[1.0] * (1 + len(panels))))
    draw_vehicle(case, axes[0])
    draw_axial_force(case.loads, axes[1])
    _draw_panels(panels, result, axes[2:])
    return _titled(figure, axes, case_title(case), "x from the nose [m]")


@styled()
def plot_shapes(result: ModalResult, most: int = 6, origin: str = "the left end") -> Figure:
    """Draw shapes and moments alone."""
    panels = _panels(result, most)
    figure, axes = _stack((1.0,) * len(panels))
    _draw_panels(panels, result, axes)
    for panel in axes:
        mark_stations(result.beam, panel)
    return _titled(figure, axes, "", f"x from {origin} [m]")


@styled()
def plot_loads(case: Case, title: bool = True) -> Figure:
    """Draw the vehicle in its cavity and N, Q and M along it."""
    figure, axes = _stack((0.7, 1.0, 1.0, 1.0))
    draw_vehicle(case, axes[0])
    _draw_forces(case.loads, axes[1:])
    return _titled(figure, axes, case_title(case) if title else "", "x from the nose [m]")


@styled()
def plot_forces(loads: Loads) -> Figure:
    """Draw N, Q and M along the body."""
    figure, axes = _stack((1.0, 1.0, 1.0))
    _draw_forces(loads, axes)
    return _titled(figure, axes, "", "x from the nose [m]")


def _draw_forces(loads: Loads, axes: Any) -> None:
    draw_axial_force(loads, axes[0])
    x = _fine(loads)
    xx, Q = _both_sides(x, loads.shear_force(x, "left"), loads.shear_force(x, "right"))
    _filled(axes[1], xx, Q / 1e3, PALETTE[2])
    axes[1].set(title="Static shear force", ylabel="Q [kN]")
    _filled(axes[2], x, loads.bending_moment(x) / 1e3, PALETTE[3])
    axes[2].set(title="Static bending moment", ylabel="M [kN m]")


def _stack(heights: tuple[float, ...]) -> tuple[Figure, Any]:
    """Return a figure of panels one above the other, which share x."""
    figure: Figure
    figure, axes = pyplot().subplots(
        len(heights),
        1,
        figsize=(WIDTH, 1.6 * sum(heights) + 0.6),
        sharex=True,
        layout="constrained",
        height_ratios=heights,
        squeeze=False,
    )
    return figure, axes[:, 0]


def _titled(figure: Figure, axes: Any, title: str, label: str) -> Figure:
    axes[-1].set_xlabel(label)
    if title:
        figure.suptitle(title, x=0.01, ha="left")
    return figure


def _numbered(result: ModalResult, family: FamilyName, most: int) -> list[Mode]:
    """Return the modes 1, 2, ... of a family, rigid ones left out."""
    return [mode for mode in result.family(family) if mode.number][:most]


def case_title(case: Case) -> str:
    """Return the name of the vehicle and its condition in one line."""
    c = case.condition
    return (
        f"{case.vehicle.name}: V = {c.speed:g} m/s, \u03c3 = {case.loads.sigma:.4g}, "
        f"cavitator {np.degrees(c.cavitator_angle):.3g}\u00b0, thrust {c.thrust / 1e3:g} kN"
    )


class _Panel(NamedTuple):
    """Curves of one component of the states of some modes."""

    title: str
    modes: list[Mode]
    component: int
    symbol: str


def _panels(result: ModalResult, most: int) -> list[_Panel]:
    """Return a panel of shapes for every family that has any, and of moments where it bends."""
    panels = []
    for name in result.families:
        family, modes = FAMILIES[name], _numbered(result, name, most)
        if modes:
            shape = family.quantities[0].symbol
            panels.append(_Panel(f"{name.capitalize()} modes", modes, 0, shape))
        if modes and family.rotary:
            moment = family.quantities[2].symbol
            panels.append(_Panel(f"Their {name} moments", modes, 2, moment))
    return panels


def _draw_panels(panels: Sequence[_Panel], result: ModalResult, axes: Any) -> None:
    for panel, ax in zip(panels, axes, strict=False):
        _curves(ax, result.x, panel.modes, panel.component, scaled=panel.component > 0)
        ax.set(title=panel.title, ylabel=f"{panel.symbol} (largest 1) [-]")


def _curves(
    axes: Axes, x: np.ndarray, modes: list[Mode], component: int, scaled: bool = False
) -> None:
    for mode, colour in zip(modes, PALETTE * 10, strict=False):
        values = mode.states[:, component]
        size = float(np.max(np.abs(values))) if scaled else float(np.max(np.abs(mode.shape)))
        axes.plot(x, values / (size or 1.0), color=colour, label=mode_label(mode))
    zero_line(axes)
    if not scaled:
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def mode_label(mode: Mode) -> str:
    """Return the name of a mode and its frequency, or that it diverges, as in all figures."""
    if mode.omega2 < 0:
        return f"{mode.name}: divergent"
    return f"{mode.name}: {f'{mode.frequency_hz:#.4g}'.rstrip('.')} Hz"


def _axial_force_of_beam(beam: Beam, axes: Axes) -> None:
    k = np.repeat(np.arange(len(beam.x) - 1), 21)
    t = np.tile(np.linspace(0, 1, 21), len(beam.x) - 1)
    x = beam.x[k] + np.diff(beam.x)[k] * t
    _filled(axes, x, beam.axial_force_at(k, t) / 1e3, PALETTE[0])
    axes.set(title="Axial force (compression positive)", ylabel="N [kN]")


def draw_axial_force(loads: Loads, axes: Axes) -> None:
    """Draw N(x) with its steps at the forces."""
    x = _fine(loads)
    xx, N = _both_sides(x, loads.axial_force(x, "left"), loads.axial_force(x, "right"))
    _filled(axes, xx, N / 1e3, PALETTE[0])
    axes.set(title="Axial force (compression positive)", ylabel="N [kN]")


def _fine(loads: Loads) -> np.ndarray:
    return np.unique(np.concatenate([np.linspace(0, loads.length, 401), loads.breakpoints]))


def _both_sides(
    x: np.ndarray, left: np.ndarray, right: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    return np.repeat(x, 2), np.stack([left, right], axis=1).ravel()


def _filled(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    axes.plot(x, y, color=colour)
    axes.fill_between(x, y, color=colour, alpha=0.12, linewidth=0)
    zero_line(axes)


def draw_vehicle(case: Case, axes: Axes) -> None:
    """Draw the vehicle to scale in its cavity, seen from the side (body axis horizontal)."""
    vehicle, loads = case.vehicle, case.loads
    L = vehicle.length
    cavity = loads.cavity
    x = np.linspace(0, min(cavity.L_c, 1.06 * L), 600)
    middle, radius = cavity.axis_offset(x), cavity.radius(x)
    axes.fill_between(x, middle - radius, middle + radius, color=WATER, linewidth=0, label="cavity")
    axes.plot(x, middle + radius, color=PALETTE[5], linewidth=1.0)
    axes.plot(x, middle - radius, color=PALETTE[5], linewidth=1.0)
    xb = np.repeat(np.unique(np.concatenate([vehicle.stations.x, np.linspace(0, L, 200)])), 2)[1:-1]
    inner = (xb[0::2] + xb[1::2]) / 2
    body = np.repeat(vehicle.radius_at(inner), 2)
    if vehicle.interpolation != "step":
        body = vehicle.radius_at(xb)
    axes.fill_between(xb, -body, body, color=BODY, edgecolor=EDGE, linewidth=0.8)
    D_n = vehicle.cavitator.diameter
    axes.plot([0, 0], [-D_n / 2, D_n / 2], color=INK, linewidth=2.5, solid_capstyle="butt")
    for fins, load in zip(vehicle.fins, loads.fins, strict=True):
        _draw_fins(axes, vehicle, fins, load.position)
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(visible=False)
    axes.set(title="Vehicle in its cavity (to scale)", ylabel="height [m]")


def _draw_fins(axes: Axes, vehicle: Vehicle, fins: FinSet, x: float) -> None:
    """Draw each fin as it is seen from the side; those that point at the viewer are edges."""
    root = float(vehicle.radius_at(x))
    half = (fins.chord or (fins.tip_radius - root)) / 2
    for angle in fins.roll_angles:
        low, high = sorted((root * np.cos(angle), fins.tip_radius * np.cos(angle)))
        axes.fill(
            [x - half, x + half, x + half, x - half],
            [low, low, high, high],
            color=GREY,
            edgecolor=EDGE,
            linewidth=0.6,
        )
