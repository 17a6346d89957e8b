"""What the terminal shows: tables of modes and loads, warnings, what was left out (rich)."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console, JustifyMethod
from rich.markup import escape
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from antinode.beam.attachments import name_of
from antinode.modes.result import ModalResult, Mode, not_modelled
from antinode.text import counted, one_line

from . import complex_table

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.modes.buckling import Buckling
    from antinode.modes.verify import Check
    from antinode.vehicle.case import Case
    from antinode.vehicle.end_forces import Choice
    from antinode.vehicle.statics import StaticShape

_WIDTH = 104
_LEAST_WIDTH = 60
_LONGEST_NAME = 80
_MOST_SHOWN = 6  # frequencies for each choice of the end forces
_MOST_LISTED = 4  # attachments that are shown one by one


def console() -> Console:
    """Return the console for results: as wide as the terminal, or 104 columns where there is none.

    The environment variable COLUMNS says otherwise. Below 60 columns the terminal breaks lines
    itself: tables would lose digits.
    """
    plain = Console()
    if plain.is_terminal:
        return plain if plain.width >= _LEAST_WIDTH else Console(width=_LEAST_WIDTH)
    columns = os.environ.get("COLUMNS", "")
    width = int(columns) if columns.isdecimal() and len(columns) < 5 else _WIDTH
    return Console(width=max(width, _LEAST_WIDTH), color_system=None)


def new_table(*headings: str, left: Collection[int] = (0,)) -> Table:
    """Return an empty table; columns hold numbers, to the right, but for those in `left`.

    The first column may wrap if it is one of these.
    """
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for k, heading in enumerate(headings):
        side: JustifyMethod = "left" if k in left else "right"
        table.add_column(Text(heading), justify=side, no_wrap=k > 0 or k not in left)
    return table


def _row(table: Table, *cells: str) -> None:
    """Add a row of plain text, in which no bracket is a mark."""
    table.add_row(*(Text(cell) for cell in cells))


def show_modes(
    out: Console,
    result: ModalResult,
    warnings: Sequence[str] = (),
    beside: Callable[[], None] | None = None,
) -> None:
    """Print the table of modes and what stands beside it, warnings, and what is left out."""
    if result.beam.is_timoshenko:
        out.print(f"[dim]{_theory_text(result.beam)}[/dim]", highlight=False)
    out.print(modes_table(result, out))
    if beside is not None:
        beside()
    if result.method == "tmm":
        out.print(f"[dim]{_BY_TMM}[/dim]", highlight=False)
    show_warnings(out, [*warnings, *result.warnings])
    show_left_out(out, not_modelled(result.beam, result.is_complex))


def show_left_out(out: Console, missing: Sequence[str]) -> None:
    """Print what the model leaves out."""
    out.print(f"[dim]Not in the model: {escape('; '.join(missing))}.[/dim]", highlight=False)


THEORIES = {"timoshenko": "Timoshenko", "euler_bernoulli": "Euler-Bernoulli"}
"""What theories are called."""


def _theory_text(beam: Beam) -> str:
    """Name the theory where it is not Euler-Bernoulli's."""
    form = {"haringx": "Haringx", "engesser": "Engesser"}[beam.shear_form]
    if not beam.has_shear:
        return "Timoshenko's theory, rigid in shear: with rotary inertia alone"
    return f"Timoshenko's theory: shear (with the axial force by {form}) and rotary inertia solved"


_BY_TMM = (
    "By the transfer matrix scan, for comparison: no error bound, and what the axial force does to "
    "each mode is left to the default method."
)

_HEADINGS = {
    "mode": "mode",
    "kind": "kind",
    "frequency [Hz]": "f [Hz]",
    "+- error [Hz]": "+- [Hz]",
    "by axial force": "by N",
    "by shear, rot. inertia": "by shear",
}
"""Headings of the table of modes, and what they shrink to on a narrow terminal."""
_KEPT = ((0, 1, 2, 3, 4, 5), (0, 2, 3, 4, 5), (0, 2, 3, 5), (0, 2, 5))
"""Columns that a narrow terminal keeps: what shear does is often the largest error of all."""


def modes_table(result: ModalResult, out: Console) -> Table:
    """Return the table of modes that fits the console: in short words, or with fewer columns."""
    if result.is_complex:
        words = (complex_table.HEADINGS, complex_table.BRIEF)
        empty = (new_table(*w, left=(0, 1)) for w in words)
        tables = (complex_table.fill(t, result.modes, frequency_text) for t in empty)
        return fitting(tables, out)
    choices = ((_KEPT[0], False), *((kept, True) for kept in _KEPT))
    return fitting((_modes_table(result, *choice) for choice in choices), out)


def fitting(tables: Iterable[Table], out: Console, *, wrapped: bool = False) -> Table:
    """Return the first table that fits the console, or else the last one.

    Its first column may wrap between words where that is allowed.
    """
    for table in tables:
        if _is_whole(table, out) if wrapped else _natural_width(table, out) <= out.width:
            break
    return table


def _natural_width(table: Table, out: Console) -> int:
    return Measurement.get(out, out.options.update(width=10 * _WIDTH), table).maximum


def _is_whole(table: Table, out: Console) -> bool:
    """Tell whether the console shows all of a table's text."""
    with out.capture() as shown:
        out.print(table)
    text = shown.get()
    words = {word for cell in table.columns[0].cells for word in str(cell).split()}
    return _CUT not in text and all(word in text for word in words)


_CUT = "\N{HORIZONTAL ELLIPSIS}"
"""What rich puts where text does not fit; a column that has no room at all it leaves out."""


def _modes_table(result: ModalResult, kept: Sequence[int], brief: bool) -> Table:
    headings = tuple(_HEADINGS.values() if brief else _HEADINGS)
    table = new_table(*(headings[k] for k in kept), left=(0, 1) if 1 in kept else (0,))
    family = ""
    for mode in result.modes:
        if family and mode.family != family:
            table.add_section()
        family = mode.family
        cells = mode_cells(mode, brief)
        if result.method == "tmm":
            cells = (*cells[:3], "", "", *cells[5:])
        if 1 not in kept and mode.kind == "divergent":
            cells = (f"{cells[0]} (grows)", *cells[1:])
        _row(table, *(cells[k] for k in kept))
    return table


def mode_cells(mode: Mode, brief: bool) -> tuple[str, ...]:
    """Return a mode as the cells of a table: name, kind, frequency, error, and two effects."""
    name = mode.name
    if mode.omega2 < 0:
        growth = f"{mode.growth_rate_per_s:.5g} /s"
        error = f"{mode.error_growth_rate_per_s:.1e}"
        return (
            name,
            "divergent",
            growth if brief else f"grows at {growth}",
            error,
            "",
            "",
        )
    zero = mode.omega2 == 0.0
    return (
        name,
        mode.kind,
        "0" if zero else frequency_text(mode),
        "exact" if zero and not mode.error_hz > 0 else f"{mode.error_hz:.1e}",
        percent(mode.shift),
        "" if mode.by_shear is None else percent(mode.by_shear),
    )


def frequency_text(mode: Mode) -> str:
    """Return the frequency with as many decimals as its error leaves, 4 at least, 6 at most.

    Where no error is known, 6. One of which they would leave less than four digits has six digits.
    """
    if 0.0 < mode.frequency_hz < 1e-3:
        return f"{mode.frequency_hz:.6g}"
    size = 1e-6 if math.isnan(mode.error_hz) else max(mode.error_hz, 1e-300)
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
    loads = case.loads
    name = _plain(case.vehicle.name)
    out.print(f"[bold]{name}[/bold]  {_condition_text(case)}", highlight=False)
    out.print(
        f"cavity {loads.cavity.L_c:.3g} m long, {loads.cavity.D_c:.3g} m wide; drag: "
        f"{_drag_text(case)}; thrust {_kN(loads.thrust)} kN",
        highlight=False,
    )
    out.print(
        f"acceleration {loads.a_X:.3g} m/s^2 forward, {loads.a_Y:.3g} m/s^2 up, {loads.beta:.3g} "
        f"rad/s^2 nose-up{loads.unbalanced}",
        highlight=False,
    )
    ends = loads.axial_force(np.array([0.0, case.vehicle.length]))
    out.print(
        f"axial force N from {_kN(ends[0])} kN at the nose to {_kN(ends[1])} kN at the tail "
        f"(compression positive); {loads.mass:.5g} kg; balance at the ends closes to "
        f"{loads.checks.worst:.0e}",
        highlight=False,
    )
    if case.added_masses:
        from .water import added_mass_text

        out.print(added_mass_text(case), highlight=False)


def _drag_text(case: Case) -> str:
    """Return the drag of each kind of force."""
    loads, extra = case.loads, case.condition.extra_drag
    planing = "none" if loads.F_PX == 0 and loads.F_PY == 0 else f"{_kN(loads.F_PX)} kN"
    parts = [
        f"cavitator {_kN(loads.F_CX)} kN",
        f"fins {_kN(loads.F_fX)} kN",
        f"planing {planing}",
        f"extra {_kN(extra)} kN" if extra else "",
    ]
    return ", ".join(part for part in parts if part)


def _condition_text(case: Case) -> str:
    c = case.condition
    parts = [
        f"V = {c.speed:g} m/s",
        f"sigma = {case.loads.sigma:.4g}",
        f"cavitator {math.degrees(c.cavitator_angle):.4g} deg",
        f"body {math.degrees(c.body_angle):.4g} deg" if c.body_angle else "",
        f"T = {c.thrust / 1e3:g} kN",
        f"fins at {c.fin_position:g} m" if case.vehicle.fins and c.fin_position is not None else "",
        end_force_text(case.model.follow),
        THEORIES[case.model.theory],
        f"burnt {c.burn_fraction:.0%}" if len(case.vehicle.stations.mass_per_length) > 1 else "",
    ]
    return ", ".join(part for part in parts if part)


def end_force_text(follow: tuple[float, float]) -> str:
    """Return what the end forces do in a few words; shares of the cavitator's drag and thrust."""
    words = {
        (0.0, 0.0): "end forces of fixed direction",
        (0.0, 1.0): "thrust follows the body",
        (1.0, 1.0): "end forces follow the body",
    }
    nose, tail = follow
    return words.get(follow, f"follow the body: thrust {tail:g}, cavitator {nose:g}")


def show_end_forces(out: Console, choices: Sequence[Choice]) -> None:
    """Print the bending frequencies for every choice of the end forces, a row each."""
    if not choices:
        return
    shown = min(len(choices[0].frequencies_hz), _MOST_SHOWN)
    tables = (_end_force_table(choices, number) for number in range(shown, 0, -1))
    out.print(fitting(tables, out, wrapped=True))


def _end_force_table(choices: Sequence[Choice], shown: int) -> Table:
    table = new_table("bending f [Hz], if", *map(str, range(1, shown + 1)))
    for choice in choices:
        missing = "diverges" if choice.proven else ""
        found = choice.frequencies_hz[:shown]
        values = [f"{f:.4f}" if math.isfinite(f) else missing for f in found]
        marks = "" if choice.proven else " (not proven)"
        _row(table, choice.name + (" (this file)" if choice.stated else marks), *values)
    return table


def show_water(out: Console, case: Case, result: ModalResult) -> None:
    """Print what the water does as the body vibrates, device by device, and what that changes."""
    if not case.tangents:
        return
    from antinode.response.units import STANDARD_GRAVITY

    from .water import contact_ends, side_by_side, water_notes

    headings = "spring [kN/m]", "dashpot [N s/m]", "turns with it [kN/rad]", "contact to [mm]"
    table = new_table("the water at", "x [m]", *headings)
    for t in case.tangents:
        numbers = t.x, t.spring / 1e3, t.dashpot, t.following / 1e3
        room = f"{t.room * 1e3:.3g}" if math.isfinite(t.room) else ""
        _row(table, t.name, *(f"{value + 0.0:.4g}" for value in numbers), room)
    out.print(table)
    rows = side_by_side(case, result)
    shown = min(*map(len, rows.values()), _MOST_SHOWN)
    table = new_table("bending f [Hz] that oscillate", *map(str, range(1, shown + 1)))
    for name, found in rows.items():
        _row(table, name, *(f"{m.frequency_hz:.4f}" for m in found[:shown]))
    if ends := contact_ends(case, result)[:shown]:
        g = (f"{end.acceleration / STANDARD_GRAVITY:.3g}" for end in ends)
        _row(table, "contact ends, at the tail [g]", *g)
        _row(table, "  largest along the body [mm]", *(f"{e.largest * 1e3:.3g}" for e in ends))
    out.print(table)
    for line in water_notes(case, result):
        out.print(f"[dim]{line}[/dim]", highlight=False)


def _plain(name: str) -> str:
    """Return a name from a file without what a terminal would obey."""
    return escape(one_line(name, _LONGEST_NAME))


def _kN(force: float) -> str:
    return f"{force / 1e3:.4g}"


def show_loads(out: Console, case: Case, shape: StaticShape) -> None:
    """Print forces, accelerations, checks and validity ranges of a case."""
    from antinode.vehicle.statics import FRAME

    from .loads_table import BRIEF_HEADINGS, EXPLANATION, HEADINGS, loads_warnings

    show_condition(out, case)
    for note in case.notes:
        out.print(f"[dim]note:[/dim] {escape(note)}", highlight=False)
    out.print(_forces_table(case))
    choices = ((HEADINGS, 4), (HEADINGS, 2), (BRIEF_HEADINGS, 2))
    out.print(fitting((_internal_table(case, shape, *choice) for choice in choices), out))
    out.print(f"[dim]{EXPLANATION}{FRAME}[/dim]", highlight=False)
    out.print(fitting((_validity_table(case, brief) for brief in (False, True)), out))
    show_warnings(out, loads_warnings(case, shape))


def _forces_table(case: Case) -> Table:
    loads = case.loads
    table = new_table("force", "x [m]", "drag, aft [N]", "lift, up [N]")
    for force in loads.forces:
        _row(table, force.name, f"{force.x:.4g}", f"{force.F_X:.6g}", f"{force.F_Y:.6g}")
    _row(table, "thrust", f"{case.vehicle.length:.4g}", f"{-loads.thrust:.6g}", "")
    _row(table, "weight", f"{loads.x_M:.4g}", "", f"{-loads.weight:.6g}")
    table.add_section()
    forward, up = f"{-loads.a_X:.5g} m/s^2", f"{loads.a_Y:.5g} m/s^2"
    _row(table, "acceleration of the body", "", forward, up)
    _row(table, "angular, nose-up", "", "", f"{loads.beta:.5g} rad/s^2")
    return table


def _internal_table(
    case: Case, shape: StaticShape, headings: Iterable[str], decimals: int
) -> Table:
    from .loads_table import internal_rows

    table = new_table(*headings, left=())
    for position, *forces in internal_rows(case, shape, 9).tolist():
        texts = (f"{round(force, decimals) + 0.0:.{decimals}f}" for force in forces)
        _row(table, f"{position:.3f}", *texts)
    return table


def _validity_table(case: Case, brief: bool) -> Table:
    """Return the ranges; a narrow terminal has all but the verdict in one column."""
    words: tuple[str, ...] = ("correlation", "quantity", "value", "valid range", "")
    if brief:
        words = ("correlation: quantity; valid range", "")
    table = new_table(*words, left=range(len(words)))
    for row in case.loads.validity:
        high = "" if math.isinf(row.high) else f" ... {row.high:g}"
        low = f"from {row.low:g}" if math.isinf(row.high) else f"{row.low:g}"
        mark = "inside" if row.inside else "OUTSIDE"
        if brief:
            found = f"{row.correlation}: {row.quantity} = {row.value:.4g}; {low}{high}"
            _row(table, found, mark)
        else:
            _row(table, row.correlation, row.quantity, f"{row.value:.4g}", low + high, mark)
    return table


def show_beam(out: Console, beam: Beam) -> None:
    """Print what the beam is, in two lines."""
    e = beam.ends
    out.print(
        f"[bold]{_plain(beam.name)}[/bold]  {beam.length:.5g} m, {beam.mass:.5g} kg, "
        f"{counted(len(beam.x) - 1, 'interval')} ({beam.interpolation}), {e.left} - {e.right}, "
        f"{THEORIES['timoshenko' if beam.is_timoshenko else 'euler_bernoulli']}",
        highlight=False,
    )
    if beam.attachments:
        out.print(f"attached: {_attached(beam)}", highlight=False)
    every = np.arange(len(beam.x) - 1)
    N = np.stack([beam.axial_force_at(every, np.full(len(every), t)) for t in (0.0, 1.0)])
    force = "no axial force"
    if not beam.is_unloaded:
        force = f"axial force N from {_kN(N.min())} to {_kN(N.max())} kN (compression positive)"
    out.print(force, highlight=False)


def _attached(beam: Beam) -> str:
    """Return what is attached, each with its station, or how many there are of each kind."""
    if len(beam.attachments) <= _MOST_LISTED:
        return ", ".join(f"{name_of(item)} at {item.x:.5g} m" for item in beam.attachments)
    kinds = Counter(map(name_of, beam.attachments))
    plurals = {"point mass": "point masses"}
    return ", ".join(counted(n, kind, plurals.get(kind, "")) for kind, n in kinds.items())


def show_buckling(out: Console, critical: Buckling | None) -> None:
    """Print the load factor at which the first supported mode diverges."""
    text = "no factor on the axial force buckles it: it is nowhere in compression"
    if critical is not None:
        text = (
            f"buckles at [bold]{critical.load_factor:.6g}[/bold] +- {critical.error:.1e} "
            "times its axial force (first supported mode, forces of fixed direction)"
        )
    out.print(text, highlight=False)


def show_checks(checks: Sequence[Check]) -> None:
    """Print the table of built-in checks and the verdict."""
    from antinode.modes.verify import ALLOWED

    failed = sum(not check.passed for check in checks)
    out = console()
    out.print(fitting((checks_table(checks, brief) for brief in (False, True)), out))
    verdict = f"{failed} of {len(checks)} checks failed" if failed else "all checks passed"
    out.print(f"{verdict} (allowed relative error of a frequency {ALLOWED:g})", highlight=False)


def checks_table(checks: Iterable[Check], brief: bool = False) -> Table:
    """Return the table of built-in checks, or what of it a narrow terminal holds."""
    headings: tuple[str, ...] = ("check", "closed form", "modes", "worst relative error", "")
    if brief:
        headings = ("check", "worst", "")
    table = new_table(*headings, left=(0, len(headings) - 1, *((1, 3) if not brief else ())))
    for check in checks:
        cells = (check.name, check.formula, str(check.modes), f"{check.worst:.1e}")
        mark = "passed" if check.passed else "FAILED"
        _row(table, *(cells[::3] if brief else cells), mark)
    return table
