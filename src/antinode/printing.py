"""What the terminal shows: tables of modes and loads, warnings, what was left out (rich)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .result import NOT_MODELLED, ModalResult, Mode

if TYPE_CHECKING:
    from .beam import Beam
    from .buckling import Buckling
    from .case import Case
    from .verify import Check

_WIDTH = 104


def console() -> Console:
    """Return the console for results, wide enough for the tables when output is not a terminal."""
    plain = Console()
    return plain if plain.is_terminal else Console(width=_WIDTH, color_system=None)


def show_modes(out: Console, result: ModalResult) -> None:
    """Print the table of modes, then warnings and what the model leaves out."""
    out.print(modes_table(result))
    show_warnings(out, result.warnings)
    out.print(f"[dim]Not in the model: {'; '.join(NOT_MODELLED)}.[/dim]", highlight=False)


def modes_table(result: ModalResult) -> Table:
    """Return the table: family, number, kind, frequency +- error, shift, model column."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("mode")
    table.add_column("kind")
    table.add_column("frequency [Hz]", justify="right")
    table.add_column("+- error [Hz]", justify="right")
    table.add_column("by axial force", justify="right")
    table.add_column("by shear, rot. inertia", justify="right")
    family = ""
    for mode in result.modes:
        if family and mode.family != family:
            table.add_section()
        family = mode.family
        table.add_row(*_cells(mode))
    return table


def _cells(mode: Mode) -> tuple[str, ...]:
    name = mode.name if mode.number else f"{mode.family} {mode.name}"
    if mode.omega2 < 0:
        growth = f"grows at {mode.growth_rate_per_s:.5g} /s"
        return name, "divergent", growth, f"{mode.error_growth_rate_per_s:.1e}", "", ""
    exact = mode.omega2 == 0.0
    return (
        name,
        mode.kind,
        "0" if exact else frequency_text(mode),
        "exact" if exact else f"{mode.error_hz:.1e}",
        percent(mode.shift),
        "" if mode.model_error is None else percent(mode.model_error),
    )


def frequency_text(mode: Mode) -> str:
    """Return the frequency with as many decimals as its error leaves, 4 at least, 6 at most."""
    size = max(mode.error_hz, 1e-300)
    decimals = int(np.clip(math.floor(-math.log10(size)), 1, 6 if mode.frequency_hz < 1e3 else 3))
    return f"{mode.frequency_hz:.{max(decimals, 4)}f}"


def percent(fraction: float) -> str:
    """Return a fraction as a signed percentage; nothing for NaN."""
    if math.isnan(fraction):
        return ""
    return f"{100 * fraction:+.3g} %" if abs(fraction) > 5e-9 else "0 %"


def show_warnings(out: Console, warnings: Iterable[str]) -> None:
    """Print each warning on its own, marked."""
    for warning in warnings:
        out.print(f"[yellow]warning:[/yellow] {escape(warning)}", highlight=False)


def show_condition(out: Console, case: Case) -> None:
    """Print the condition and the loads in a few lines."""
    c, loads = case.condition, case.loads
    out.print(f"[bold]{escape(case.vehicle.name)}[/bold]  {_condition_text(case)}", highlight=False)
    planing = "none" if loads.F_PX == 0 and loads.F_PY == 0 else f"{_kN(loads.F_PX)} kN"
    out.print(
        f"cavity {loads.cavity.L_c:.3g} m long, {loads.cavity.D_c:.3g} m wide; drag: cavitator "
        f"{_kN(loads.F_CX)} kN, fins {_kN(loads.F_fX)} kN, planing {planing}; "
        f"thrust {_kN(c.thrust)} kN; acceleration {loads.a_X:.3g} m/s^2",
        highlight=False,
    )
    ends = loads.axial_force(np.array([0.0, case.vehicle.length]))
    out.print(
        f"axial force N from {_kN(ends[0])} kN at the nose to {_kN(ends[1])} kN at the tail "
        f"(compression positive); {loads.mass:.5g} kg; balance at the ends closes to "
        f"{loads.checks.worst:.0e}",
        highlight=False,
    )


def _condition_text(case: Case) -> str:
    c = case.condition
    parts = [
        f"V = {c.speed:g} m/s",
        f"sigma = {case.loads.sigma:.4g}",
        f"cavitator {math.degrees(c.cavitator_angle):.4g} deg",
        f"body {math.degrees(c.body_angle):.4g} deg" if c.body_angle else "",
        f"T = {c.thrust / 1e3:g} kN",
        f"fins at {c.fin_position:g} m" if c.fin_position is not None else "",
        f"burnt {c.burn_fraction:.0%}" if len(case.vehicle.stations.mass_per_length) > 1 else "",
    ]
    return ", ".join(part for part in parts if part)


def _kN(force: float) -> str:
    return f"{force / 1e3:.4g}"


def show_loads(out: Console, case: Case) -> None:
    """Print forces, accelerations, checks and validity ranges of a case."""
    show_condition(out, case)
    out.print(_forces_table(case))
    out.print(_internal_table(case))
    out.print(_validity_table(case))
    show_warnings(out, case.loads.warnings)


def _forces_table(case: Case) -> Table:
    loads = case.loads
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("force", "x [m]", "drag, aft [N]", "lift, up [N]"):
        table.add_column(heading, justify="left" if heading == "force" else "right")
    for force in loads.forces:
        table.add_row(force.name, f"{force.x:.4g}", f"{force.F_X:.6g}", f"{force.F_Y:.6g}")
    table.add_row("thrust", f"{case.vehicle.length:.4g}", f"{-loads.thrust:.6g}", "")
    table.add_row("weight", f"{loads.x_M:.4g}", "", f"{-loads.weight:.6g}")
    table.add_section()
    table.add_row(
        "acceleration of the body",
        "",
        f"{-loads.a_X:.5g} m/s^2",
        f"{loads.a_Y:.5g} m/s^2",
    )
    table.add_row("angular, nose-up", "", "", f"{loads.beta:.5g} rad/s^2")
    return table


def _internal_table(case: Case) -> Table:
    loads, x = case.loads, np.linspace(0, case.vehicle.length, 9)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("x [m]", "N [kN]", "Q [kN]", "M [kN m]"):
        table.add_column(heading, justify="right")
    rows = (
        x,
        loads.axial_force(x) / 1e3,
        loads.shear_force(x) / 1e3,
        loads.bending_moment(x) / 1e3,
    )
    for position, N, Q, M in zip(*rows, strict=True):
        table.add_row(f"{position:.3f}", f"{N:.4f}", f"{Q:.4f}", f"{M:.4f}")
    return table


def _validity_table(case: Case) -> Table:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("correlation", "quantity", "value", "valid range", ""):
        table.add_column(heading)
    for row in case.loads.validity:
        high = "" if math.isinf(row.high) else f" ... {row.high:g}"
        low = f"from {row.low:g}" if math.isinf(row.high) else f"{row.low:g}"
        mark = "inside" if row.inside else "[bold]outside[/bold]"
        table.add_row(row.correlation, row.quantity, f"{row.value:.4g}", low + high, mark)
    return table


def show_beam(out: Console, beam: Beam) -> None:
    """Print what the beam is, in two lines."""
    e = beam.ends
    out.print(
        f"[bold]{escape(beam.name)}[/bold]  {beam.length:.5g} m, {beam.mass:.5g} kg, "
        f"{len(beam.x) - 1} intervals ({beam.interpolation}), {e.left} - {e.right}",
        highlight=False,
    )
    every = np.arange(len(beam.x) - 1)
    N = np.stack([beam.axial_force_at(every, np.full(len(every), t)) for t in (0.0, 1.0)])
    force = "no axial force"
    if not beam.is_unloaded:
        force = f"axial force N from {_kN(N.min())} to {_kN(N.max())} kN (compression positive)"
    out.print(force, highlight=False)


def show_buckling(out: Console, critical: Buckling | None) -> None:
    """Print the load factor at which the first supported mode diverges."""
    text = "no factor on the axial force buckles it: it is nowhere in compression"
    if critical is not None:
        text = (
            f"buckles at [bold]{critical.load_factor:.6g}[/bold] +- {critical.error:.1e} "
            "times its axial force (first supported mode, forces of fixed direction)"
        )
    out.print(text, highlight=False)


def checks_table(checks: Iterable[Check]) -> Table:
    """Return the table of built-in checks."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("check", "closed form", "modes", "worst relative error", ""):
        table.add_column(heading, justify="right" if heading in ("modes",) else "left")
    for check in checks:
        mark = "passed" if check.passed else "[bold red]FAILED[/bold red]"
        table.add_row(check.name, check.formula, str(check.modes), f"{check.worst:.1e}", mark)
    return table
