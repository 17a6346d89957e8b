"""Figures 3 to 8, 16 and 17: the vehicle, its cavity and its axial force (equations 1 to 22)."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arrays import Array
from antinode.show.figures import draw_vehicle
from antinode.show.style import GREY, INK, PALETTE, WIDTH, zero_line
from antinode.vehicle.case import Case

from .plates import letter, shades, sheet
from .scene import Scene, axial_force_curve
from .tables import TABLES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Drawn = tuple["Figure", str]
BLUE, RED, GREEN = PALETTE[:3]
_X = "x from the nose [m]"


# --- figure 3, with the forces of figure 1 -----------------------------------------------------


def vehicle(scene: Scene) -> Drawn:
    """Draw the vehicle in its cavity, to scale, and the forces on it."""
    case = scene.common
    L, reach = case.vehicle.length, _reach(case)
    left, right = -0.2 * L, 1.2 * L
    low = (-2.5 if case.loads.F_fY < 0 else -1.95) * reach
    high = (2.5 if case.loads.F_fY > 0 else 1.75) * reach
    figure, axes = sheet(0.62 + (WIDTH - 0.75) * (high - low) / (right - left))
    draw_vehicle(case, axes)
    axes.axhline(0, color=GREY, linewidth=0.6, linestyle=(0, (8, 3, 2, 3)), zorder=3)
    axes.plot(case.loads.x_M, 0, "o", color=INK, markersize=3.5, zorder=5)
    _axial_arrows(axes, case, reach)
    _lateral_arrows(axes, case, reach)
    axes.set_aspect("equal", adjustable="box")
    axes.set(title="", xlabel=_X, ylabel="height [m]", xlim=(left, right), ylim=(low, high))
    return figure, _vehicle_caption(case)


def _reach(case: Case) -> float:
    """Largest height of body, fins and cavity [m]."""
    return max(case.loads.cavity_diameter / 2, *(fins.tip_radius for fins in case.vehicle.fins))


def _vehicle_caption(case: Case) -> str:
    loads, c = case.loads, case.condition
    return (
        f"The vehicle in its cavity, to scale, seen from the side at V = {c.speed:g} m/s, "
        f"σ = {loads.sigma:g} and a cavitator angle of {np.degrees(c.cavitator_angle):.3g}°, with "
        "the forces of the paper's Figure 1: cavitator (eq. 2-6), fins (eq. 14 and 15), planing of "
        "the tail (eq. 16 and 17), thrust and weight. Arrows show where a force acts and which "
        "way; their lengths are not to scale. Cavity by eq. 7-13; the dash-dotted line is the body "
        f"axis, the dot the centre of mass. The body accelerates forward at {loads.a_X:.3g} m/s²."
    )


def _arrow(axes: Axes, tip: tuple[float, float], shift: tuple[float, float], colour: str) -> None:
    """Draw an arrow that ends at `tip` and comes from `shift` away."""
    style = {
        "arrowstyle": "-|>,head_width=0.22,head_length=0.45",
        "color": colour,
        "linewidth": 1.3,
    }
    start = (tip[0] + shift[0], tip[1] + shift[1])
    axes.annotate("", tip, start, arrowprops={**style, "shrinkA": 0, "shrinkB": 0}, zorder=6)


def _label(axes: Axes, at: tuple[float, float], text: str, colour: str, **options: Any) -> None:
    axes.text(*at, text, color=colour, fontsize=7.5, zorder=6, **options)


def _kN(force: float) -> str:
    return f"{force / 1e3:.3g} kN"


def _axial_arrows(axes: Axes, case: Case, reach: float) -> None:
    """Draw drag and thrust."""
    loads, L = case.loads, case.vehicle.length
    far = 0.11 * L
    _arrow(axes, (0, 0), (-far, 0), RED)
    at = (-0.02 * L, -0.15 * reach)
    _label(axes, at, f"$F_{{CX}}$ = {_kN(loads.F_CX)}", RED, va="top", ha="right")
    _arrow(axes, (L, 0), (far, 0), GREEN)
    at = (1.075 * L, 0.15 * reach)
    _label(axes, at, f"T = {_kN(loads.thrust)}", GREEN, va="bottom", ha="left")
    for fins, load in zip(case.vehicle.fins, loads.fins, strict=True):
        if load.F_fX > 0:
            top = fins.tip_radius * max(np.cos(fins.roll_angles))
            _arrow(axes, (load.position, top), (-far, 0), RED)
            text = f"$F_{{fX}}$ = {_kN(load.F_fX)}"
            _label(axes, (load.position - 0.1, 1.2 * reach), text, RED, va="bottom", ha="right")
    if loads.F_PX > 0:
        side = -1 if loads.F_PY >= 0 else 1
        R = float(case.vehicle.radius_at(loads.x_P))
        _arrow(axes, (loads.x_P, side * R), (-far, 0), RED)
        text = f"$F_{{PX}}$ = {_kN(loads.F_PX)}"
        _label(axes, (loads.x_P - 0.1, side * 1.35 * reach), text, RED, va="center", ha="right")


def _lateral_arrows(axes: Axes, case: Case, reach: float) -> None:
    """Draw lift and weight."""
    loads = case.loads
    forces = [(0.0, loads.F_CY, case.vehicle.cavitator.diameter / 2, "$F_{CY}$")]
    forces += [(fin.position, fin.F_fY, reach, "$F_{fY}$") for fin in loads.fins]
    for x, lift, start, text in forces:
        if lift:
            up = float(np.sign(lift))
            _arrow(axes, (x, up * (start + 1.2 * reach)), (0, -1.2 * up * reach), BLUE)
            at = (x + 0.1, up * (start + 1.1 * reach))
            _label(axes, at, f"{text} = {_kN(lift)}", BLUE, va="center", ha="left")
    if loads.F_PY:
        up = float(np.sign(loads.F_PY))
        tip = -up * float(case.vehicle.radius_at(loads.x_P))
        _arrow(axes, (loads.x_P, tip), (0, -up * 1.15 * reach), BLUE)
        at = (loads.x_P + 0.1, tip - up * 0.95 * reach)
        _label(axes, at, f"$F_{{PY}}$ = {_kN(loads.F_PY)}", BLUE, va="center", ha="left")
    _arrow(axes, (loads.x_M, -1.8 * reach), (0, 1.8 * reach), GREY)
    at = (loads.x_M + 0.1, -1.6 * reach)
    _label(axes, at, f"$P_M$ = {_kN(loads.weight)}", GREY, va="center", ha="left")


# --- figures 4 to 6 and 16: what the body is made of -------------------------------------------


def mass(scene: Scene) -> Drawn:
    """Draw the mass per length at the start."""
    total = scene.common.vehicle.mass_distribution(0.0).moments(_length(scene))[0]
    figure = _distribution(scene, "mass_per_length", 1.0, "mass per length m [kg/m]", BLUE)
    _band(figure, scene, "mass_per_length", 1.0, BLUE)
    return figure, (
        "Mass per length along the vehicle at t = 0 s, the ρA of eq. 29 to 39, "
        f"{total:,.0f} kg in all. It was found from the frequencies of Tables 1 to 5; the paper's "
        "own curve is lost. " + _BAND
    )


def axial_stiffness(scene: Scene) -> Drawn:
    """Draw EA."""
    figure = _distribution(
        scene, "axial_stiffness", 1e6, "axial stiffness EA [MN]", GREEN, along=True
    )
    return figure, (
        "Axial stiffness EA of eq. 34 along the vehicle; dashed, for it is an assumption: the "
        "tables hold bending frequencies only, on which EA has no influence."
    )


def bending_stiffness(scene: Scene) -> Drawn:
    """Draw EI."""
    figure = _distribution(scene, "bending_stiffness", 1e3, "bending stiffness EI [kN m²]", RED)
    _band(figure, scene, "bending_stiffness", 1e3, RED)
    return figure, (
        "Bending stiffness EI of eq. 39 along the vehicle, found from the frequencies of Tables 1 "
        "to 5 together with the mass. Frequencies fix the two up to a common factor, which the "
        "axial force sets. " + _BAND
    )


def _length(scene: Scene) -> float:
    return scene.common.vehicle.length


def _profile(scene: Scene, column: str, burnt: float = 0.0) -> tuple[Array, Array]:
    """Return x [m] and a property at both ends of every interval."""
    body = scene.common.vehicle
    x = body.stations.x
    if body.interpolation != "step":
        x = np.union1d(x, np.linspace(0, body.length, 301))
    section = body.section(x, burnt)
    return np.repeat(section.x, 2)[1:-1], np.asarray(getattr(section, column)).ravel()


def _distribution(
    scene: Scene, column: str, unit: float, label: str, colour: str, along: bool = False
) -> Figure:
    figure, axes = sheet(2.3)
    x, values = _profile(scene, column)
    axes.plot(x, values / unit, color=colour, linestyle="--" if along else "-")
    axes.fill_between(x, values / unit, color=colour, alpha=0.12, linewidth=0)
    axes.set(xlabel=_X, ylabel=label, xlim=(0, _length(scene)), ylim=(0, None))
    drawn: Figure = figure
    return drawn


_BAND = (
    "Darker: one standard deviation either way, as the identification states it at 16 places, "
    "straight between them; that the model is the authors' is assumed."
)


def deviations() -> dict[str, Array]:
    """Return x [m] and the relative standard deviations of the identified mass and EI there."""
    text = files("antinode.paper").joinpath("deviations.csv").read_text("utf-8").splitlines()
    values = np.array([row.split(",") for row in text[1:]], dtype=float)
    return dict(zip(text[0].split(","), values.T, strict=True))


def _band(figure: Figure, scene: Scene, column: str, unit: float, colour: str) -> None:
    known = deviations()
    x, values = _profile(scene, column)
    share = np.interp(x, known["x"], known[column])
    low, high = values * (1 - share) / unit, values * (1 + share) / unit
    figure.axes[0].fill_between(x, low, high, color=colour, alpha=0.25, linewidth=0)
    figure.axes[0].set_ylim(0, 1.05 * float(np.max(high)))


def mass_states(scene: Scene) -> Drawn:
    """Draw the mass per length at the start and after 10 s."""
    figure, axes = sheet(2.5)
    body = scene.common.vehicle
    x, full = _profile(scene, "mass_per_length", 0.0)
    _, burnt = _profile(scene, "mass_per_length", 1.0)
    totals = [body.mass_distribution(burn).moments(body.length)[0] for burn in (0.0, 1.0)]
    axes.fill_between(x, burnt, full, color=PALETTE[4], alpha=0.25, linewidth=0, label="burnt")
    axes.plot(x, full, color=BLUE, label=f"t = 0 s: {totals[0]:,.0f} kg")
    axes.plot(x, burnt, color=RED, linestyle="--", label=f"t = 10 s: {totals[1]:,.0f} kg")
    axes.set(xlabel=_X, ylabel="mass per length m [kg/m]", xlim=(0, body.length), ylim=(0, None))
    axes.legend(loc="upper right")
    return figure, (
        "Mass per length, the ρA of eq. 29 to 39, at the start, t = 0 s, and in the steady state, "
        "t = 10 s. The second rests on one row of the paper, the second of Table 5: six "
        "frequencies, so that only its broad course can be told."
    )


# --- figure 7: cavity profiles -----------------------------------------------------------------


def cavities(scene: Scene) -> Drawn:
    """Draw the walls and the axis of the cavity at the cavitation numbers of Table 1."""
    figure, (walls, axis) = sheet(4.6, 2, sharex=True, height_ratios=(1.45, 1))
    cases = scene.cases(1)
    body = cases[0].vehicle
    far = 1.12 * body.length
    for case, colour in zip(cases, shades(len(cases)), strict=True):
        _cavity(walls, axis, case, colour, far)
        if case in (cases[0], cases[-1]):
            _parts(axis, case, colour, far)
    _body(walls, scene.common)
    letter(walls, "cavity walls and body; heights are stretched", "a")
    walls.set(ylabel="height [m]")
    walls.grid(visible=False)
    walls.legend(title="σ", loc="center left", bbox_to_anchor=(1.0, 0.5))
    letter(axis, "cavity axis above body axis", "b")
    zero_line(axis)
    for style, text in (("-", "sum"), ("--", "$h_g$"), (":", "$-h_\\sigma$")):
        axis.plot([], [], color=INK, linestyle=style, label=text)
    axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    axis.set(xlabel=_X, ylabel="offset [mm]", xlim=(0, far))
    c = cases[0].condition
    return figure, (
        "Cavity against cavitation number, at the cavitator angle of "
        f"{np.degrees(c.cavitator_angle):.3g}° and V = {c.speed:g} m/s. (a) Walls by eq. 7-9 about "
        "the offset axis; grey: the body, in the steps of its stations, and its fins. (b) Offset "
        "of the cavity axis: rise by "
        "gravity h_g (eq. 10-12, made a length as the case's model says) and distortion h_σ by "
        "the cavitator's angle (eq. 13), which pushes the cavity away from the lift; the parts are "
        "shown for the smallest and the largest σ."
    )


def _cavity(walls: Axes, axis: Axes, case: Case, colour: Any, far: float) -> None:
    hole = case.loads.cavity
    x = np.linspace(0, 1, 400) ** 1.5 * min(far, hole.L_c)
    middle, R_c = hole.axis_offset(x), hole.radius(x)
    around = np.concatenate([middle + R_c, (middle - R_c)[::-1]])
    label = f"{case.loads.sigma:g}"
    if hole.L_c > far:
        walls.plot(x, middle - R_c, color=colour, linewidth=1.1)
        walls.plot(x, middle + R_c, color=colour, linewidth=1.1, label=label)
    else:
        walls.plot(np.concatenate([x, x[::-1]]), around, color=colour, linewidth=1.1, label=label)
    axis.plot(x, 1e3 * middle, color=colour, linewidth=1.2)


def _parts(axis: Axes, case: Case, colour: Any, far: float) -> None:
    """Draw the two parts of the offset by themselves."""
    hole = case.loads.cavity
    x = np.linspace(0, min(far, hole.L_c), 201)
    axis.plot(x, 1e3 * hole.gravity_rise(x), color=colour, linewidth=1.0, linestyle="--")
    axis.plot(x, -1e3 * hole.distortion(x), color=colour, linewidth=1.0, linestyle=":")


def _body(axes: Axes, case: Case) -> None:
    """Draw the outline of the body and its fins, seen from the side."""
    body = case.vehicle
    x = np.union1d(body.stations.x, np.linspace(0, body.length, 301))
    inner = (x[1:] + x[:-1]) / 2
    step = body.interpolation == "step"
    outline = np.repeat(body.radius_at(inner), 2) if step else body.radius_at(x).repeat(2)[1:-1]
    x = np.repeat(x, 2)[1:-1]
    axes.fill_between(x, -outline, outline, color="#C9CED6", edgecolor=GREY, linewidth=0.6)
    for fins, load in zip(body.fins, case.loads.fins, strict=True):
        root = float(body.radius_at(load.position))
        half = (fins.chord or fins.tip_radius - root) / 2
        for angle in fins.roll_angles:
            low, high = sorted((root * np.cos(angle), fins.tip_radius * np.cos(angle)))
            spot = [load.position - half, load.position + half]
            axes.fill_between(spot, low, high, color="#9AA3AF", linewidth=0)


# --- figures 8 and 17: axial force --------------------------------------------------------------


def axial_forces(scene: Scene) -> Drawn:
    """Draw N(x) in the conditions of Tables 1 to 4."""
    figure, panels = sheet(5.6, 2, 2, sharex=True, sharey=True)
    heads = ("σ", "V [m/s]", "α [deg]", "$x_{fin}$ [m]")
    for table, head, axes in zip(TABLES, heads, panels.flat, strict=False):
        lines = scene.comparison.table(table.number)
        for line, colour in zip(lines, shades(len(lines)), strict=True):
            x, N = axial_force_curve(line.case)
            axes.plot(x, N, color=colour, linewidth=1.1, label=table.value(line.row))
        letter(axes, table.title, "abcd"[table.number - 1])
        axes.legend(title=head, loc="best", ncols=2, columnspacing=1.0)
        zero_line(axes)
    for axes in panels[:, 0]:
        axes.set_ylabel("axial compression N [kN]")
    for axes in panels[-1]:
        axes.set(xlabel=_X, xlim=(0, _length(scene)))
    return figure, (
        "Axial compression N(x) in the conditions of Tables 1 to 4 (eq. 18 and 22): from the "
        "cavitator's drag at the nose to the thrust at the tail, through the inertia of the mass "
        "ahead, with steps at the fins and where the tail planes. (a) Cavitation number, (b) "
        "speed, (c) cavitator angle, (d) fin position; what does not vary is at 80 m/s, σ = 0.02, "
        "10°, fins at 5 m."
    )


def axial_forces_in_time(scene: Scene) -> Drawn:
    """Draw N(x) in the two conditions of Table 5."""
    figure, axes = sheet(2.7)
    styles = ((BLUE, "-", "t = 0 s"), (RED, "--", "t = 10 s"))
    for case, (colour, dashes, text) in zip(scene.cases(5), styles, strict=True):
        x, N = axial_force_curve(case)
        c = case.condition
        label = f"{text}: V = {c.speed:g} m/s, T = {_kN(c.thrust)}"
        axes.plot(x, N, color=colour, linestyle=dashes, label=label)
    zero_line(axes)
    axes.set(xlabel=_X, ylabel="axial compression N [kN]", xlim=(0, _length(scene)))
    axes.legend(loc="best")
    loads = scene.cases(5)[-1].loads
    return figure, (
        "Axial compression N(x) in the two conditions of Table 5 (eq. 18 and 22): at the start, "
        "where the thrust accelerates the full vehicle against little drag, and in the steady "
        f"state with the fuel burnt, where the drag of the cavitator takes up "
        f"{loads.F_CX / loads.thrust:.0%} of the thrust."
    )
