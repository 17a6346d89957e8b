"""Figures: mode shapes, internal forces, and the vehicle to scale in its cavity (matplotlib)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .dataset import check_output
from .errors import InputError
from .result import ModalResult, Mode

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .case import Case
    from .vehicle import FinSet, Vehicle

ENDINGS = (".png", ".svg", ".pdf")
PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#5A5A5A")
"""Colours that stay apart for colour-blind eyes (Okabe and Ito)."""

STYLE: Any = {
    "font.size": 9,
    "font.family": "DejaVu Sans",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.grid": True,
    "grid.color": "#E3E6EA",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "axes.edgecolor": "#6B7280",
    "lines.linewidth": 1.6,
    "legend.frameon": False,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "figure.dpi": 120,
    "savefig.dpi": 160,
}
"""Settings of matplotlib that all figures share."""


def pyplot() -> Any:
    """Return matplotlib.pyplot, drawing to files; raise InputError if it is not installed."""
    try:
        import matplotlib
    except ImportError as error:
        raise InputError(
            "matplotlib is not installed; add it with: pip install 'antinode[plot]'"
        ) from error
    matplotlib.use("Agg", force=False)
    import matplotlib.pyplot as plt

    return plt


def check_plot(path: Path) -> None:
    """Raise InputError if a figure of this name cannot be drawn, before any work is done."""
    check_output(path, ENDINGS)
    pyplot()


def save(figure: Figure, path: Path) -> None:
    """Write a figure to .png, .svg or .pdf."""
    import matplotlib
    import matplotlib.pyplot as plt

    try:
        with matplotlib.rc_context(STYLE):
            figure.savefig(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror or error})") from error
    finally:
        plt.close(figure)


def plot_modes(result: ModalResult, most: int = 6) -> Figure:
    """Draw bending shapes, their moments, longitudinal shapes and the axial force of a beam."""
    plt = pyplot()
    with plt.rc_context(STYLE):
        longitudinal = [m for m in result.family("longitudinal") if m.number]
        rows = 2 + bool(longitudinal) + (not result.beam.is_unloaded)
        figure: Figure
        figure, axes = plt.subplots(
            rows, 1, figsize=(8.0, 2.1 * rows + 0.6), sharex=True, layout="constrained"
        )
        _shape_panels(result, axes, most)
        if not result.beam.is_unloaded:
            _axial_force_of_beam(result, axes[-1])
        axes[-1].set_xlabel("x from the left end [m]")
        figure.suptitle(f"{result.beam.name}: natural modes", fontweight="bold", x=0.01, ha="left")
    return figure


def plot_case(case: Case, result: ModalResult, most: int = 6) -> Figure:
    """Draw the vehicle in its cavity, its axial force and its modes, one above the other."""
    plt = pyplot()
    with plt.rc_context(STYLE):
        figure: Figure
        figure, axes = plt.subplots(
            5,
            1,
            figsize=(8.4, 10.8),
            sharex=True,
            layout="constrained",
            height_ratios=(0.7, 1, 1, 1, 1),
        )
        draw_vehicle(case, axes[0])
        draw_axial_force(case, axes[1])
        _shape_panels(result, axes[2:], most)
        axes[-1].set_xlabel("x from the nose [m]")
        figure.suptitle(_case_title(case), fontweight="bold", x=0.01, ha="left")
    return figure


def plot_loads(case: Case) -> Figure:
    """Draw the vehicle in its cavity and N, Q and M along it."""
    plt = pyplot()
    with plt.rc_context(STYLE):
        figure: Figure
        figure, axes = plt.subplots(
            4,
            1,
            figsize=(8.4, 8.6),
            sharex=True,
            layout="constrained",
            height_ratios=(0.7, 1, 1, 1),
        )
        draw_vehicle(case, axes[0])
        draw_axial_force(case, axes[1])
        x = _fine(case)
        loads = case.loads
        xx, Q = _both_sides(x, loads.shear_force(x, "left"), loads.shear_force(x, "right"))
        _filled(axes[2], xx, Q / 1e3, PALETTE[2])
        axes[2].set(title="Static shear force", ylabel="Q [kN]")
        _filled(axes[3], x, loads.bending_moment(x) / 1e3, PALETTE[3])
        axes[3].set(title="Static bending moment", ylabel="M [kN m]", xlabel="x from the nose [m]")
        figure.suptitle(_case_title(case), fontweight="bold", x=0.01, ha="left")
    return figure


def _case_title(case: Case) -> str:
    c = case.condition
    return (
        f"{case.vehicle.name}: V = {c.speed:g} m/s, \u03c3 = {case.loads.sigma:.4g}, "
        f"cavitator {np.degrees(c.cavitator_angle):.3g}\u00b0, thrust {c.thrust / 1e3:g} kN"
    )


def _shape_panels(result: ModalResult, axes: Any, most: int) -> None:
    bending = [m for m in result.family("bending") if m.number][:most]
    longitudinal = [m for m in result.family("longitudinal") if m.number][:most]
    _curves(axes[0], result.x, bending, 0)
    axes[0].set(title="Bending modes", ylabel="Y (largest 1)")
    _curves(axes[1], result.x, bending, 2, scaled=True)
    axes[1].set(title="Their bending moments", ylabel="M (largest 1)")
    if longitudinal and len(axes) > 2:
        _curves(axes[2], result.x, longitudinal, 0)
        axes[2].set(title="Longitudinal modes", ylabel="X (largest 1)")


def _curves(
    axes: Axes, x: np.ndarray, modes: list[Mode], component: int, scaled: bool = False
) -> None:
    for mode, colour in zip(modes, PALETTE * 10, strict=False):
        values = mode.states[:, component]
        size = float(np.max(np.abs(values))) if scaled else float(np.max(np.abs(mode.shape)))
        text = _mode_label(mode)
        axes.plot(x, values / (size or 1.0), color=colour, label=text)
    axes.axhline(0, color="#6B7280", linewidth=0.7)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)


def _mode_label(mode: Mode) -> str:
    value = f"{mode.frequency_hz:.4g} Hz" if mode.omega2 >= 0 else "divergent"
    return f"{mode.number}: {value}"


def _axial_force_of_beam(result: ModalResult, axes: Axes) -> None:
    beam = result.beam
    k = np.repeat(np.arange(len(beam.x) - 1), 21)
    t = np.tile(np.linspace(0, 1, 21), len(beam.x) - 1)
    x = beam.x[k] + np.diff(beam.x)[k] * t
    _filled(axes, x, beam.axial_force_at(k, t) / 1e3, PALETTE[0])
    axes.set(title="Axial force (compression positive)", ylabel="N [kN]")


def draw_axial_force(case: Case, axes: Axes) -> None:
    """Draw N(x) with its steps at the forces."""
    x = _fine(case)
    loads = case.loads
    xx, N = _both_sides(x, loads.axial_force(x, "left"), loads.axial_force(x, "right"))
    _filled(axes, xx, N / 1e3, PALETTE[0])
    axes.set(title="Axial force (compression positive)", ylabel="N [kN]")


def _fine(case: Case) -> np.ndarray:
    return np.unique(
        np.concatenate([np.linspace(0, case.vehicle.length, 401), case.loads.breakpoints])
    )


def _both_sides(
    x: np.ndarray, left: np.ndarray, right: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    return np.repeat(x, 2), np.stack([left, right], axis=1).ravel()


def _filled(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    axes.plot(x, y, color=colour)
    axes.fill_between(x, y, color=colour, alpha=0.12, linewidth=0)
    axes.axhline(0, color="#6B7280", linewidth=0.7)


def draw_vehicle(case: Case, axes: Axes) -> None:
    """Draw the vehicle to scale in its cavity, seen from the side (body axis horizontal)."""
    vehicle, loads = case.vehicle, case.loads
    L = vehicle.length
    cavity = loads.cavity
    x = np.linspace(0, min(cavity.L_c, 1.06 * L), 600)
    middle, radius = cavity.axis_offset(x), cavity.radius(x)
    axes.fill_between(
        x, middle - radius, middle + radius, color="#DCEBF7", linewidth=0, label="cavity"
    )
    axes.plot(x, middle + radius, color=PALETTE[5], linewidth=1.0)
    axes.plot(x, middle - radius, color=PALETTE[5], linewidth=1.0)
    xb = np.repeat(np.unique(np.concatenate([vehicle.stations.x, np.linspace(0, L, 200)])), 2)[1:-1]
    inner = (xb[0::2] + xb[1::2]) / 2
    body = np.repeat(vehicle.radius_at(inner), 2)
    if vehicle.interpolation != "step":
        body = vehicle.radius_at(xb)
    axes.fill_between(xb, -body, body, color="#B8BEC7", edgecolor="#4B5563", linewidth=0.8)
    D_n = vehicle.cavitator.diameter
    axes.plot([0, 0], [-D_n / 2, D_n / 2], color="#111827", linewidth=2.5, solid_capstyle="butt")
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
            color="#7C8592",
            edgecolor="#4B5563",
            linewidth=0.6,
        )
