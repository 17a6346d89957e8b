"""Critical loads, and critical values of inputs, on the terminal and as CSV."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.text import Text

from antinode.text import counted

from .printing import fitting, new_table, show_left_out, show_warnings

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from rich.table import Table

    from antinode.stability.influence import Influence
    from antinode.stability.result import CriticalLoad, DampedLoss, Stability
    from antinode.study.along.result import Along, StabilityMap

_CHANGES = {
    "lost": "lost",
    "regained": "regained",
    "merged": "diverging modes begin to flutter",
}
_HEADINGS = "modes", "factor", "+-", "kind", "f [Hz]", "stability", "bracket by"
_KEPT = ((0, 1, 2, 3, 4, 5, 6), (0, 1, 2, 3, 4, 6), (0, 1, 3, 4, 6), (0, 1, 3, 6), (0, 1, 3))
"""Columns that a narrow terminal keeps."""
_PROOFS = {"counts": "counts", "winding": "winding number", "none": "not proven"}


def show_stability(out: Console, result: Stability) -> None:
    """Print every change of stability, what lies between, warnings, and what is left out."""
    if result.critical:
        tables = (_critical_table(result.critical, kept) for kept in _KEPT)
        out.print(fitting(tables, out, wrapped=True))
    else:
        out.print("stable, whatever the factor" if result.range[1] == float("inf") else "stable")
    if result.damped is not None:
        out.print(Text(_with_dampers(result.damped)))
    out.print(f"[dim]{_between(result)}[/dim]", highlight=False)
    show_warnings(out, result.warnings)
    show_left_out(out, result.not_modelled)


def _critical_table(critical: Sequence[CriticalLoad], kept: Sequence[int]) -> Table:
    headings = [_HEADINGS[k] for k in kept]
    table = new_table(*headings, left=[i for i, k in enumerate(kept) if k in (0, 3, 5, 6)])
    for each in critical:
        cells = _cells(each)
        table.add_row(*(Text(cells[k]) for k in kept))
    return table


def _cells(each: CriticalLoad) -> tuple[str, ...]:
    flutter = each.kind == "flutter"
    return (
        " with ".join(each.modes),
        f"{each.load_factor:.10g}",
        f"{each.error:.1e}",
        each.kind,
        f"{each.frequency_hz:.7g}" if flutter else "",
        _CHANGES[each.change],
        _PROOFS[each.certificate.kind],
    )


def _with_dampers(damped: DampedLoss) -> str:
    at = f" at {damped.frequency_hz:.7g} Hz" if damped.frequency_hz else ""
    proven = "" if damped.proven else ", not proven"
    error = max(abs(end - damped.load_factor) for end in damped.bracket)
    return (
        f"With its dashpots and loss factors: {damped.mode}, {damped.kind}{at} from "
        f"{damped.load_factor:.8g} +- {error:.1g}{proven}."
    )


def _between(result: Stability) -> str:
    """Return what was looked at, and why nothing is missing."""
    last, force = result.range[1], result.largest_force
    text = f"Factors on all axial forces (largest {force:.6g} N), 0 to {last:.7g}. "
    if result.complete == "counts":
        return text + "All forces keep their direction: counts prove that no change is missing."
    return text + (
        f"Between the brackets the modes were followed in {counted(result.steps, 'step')}: that "
        "none is missing there is not proven."
    )


def stability_csv(result: Stability) -> str:
    """Return the changes of stability as CSV with units in the header, one a row."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    names = "kind", "load_factor", "low", "high", "error", "frequency [Hz]", "modes", "change"
    writer.writerow([*names, "certificate"])
    for each in result.critical:
        numbers = each.load_factor, *each.bracket, each.error, each.frequency_hz
        told = " + ".join(each.modes), each.change, each.certificate.kind
        writer.writerow([each.kind, *(repr(float(v)) for v in numbers), *told])
    return out.getvalue()


def show_influence(
    out: Console, critical: Sequence[CriticalLoad], moved: Sequence[Influence | None]
) -> None:
    """Print what moves each critical factor, in percent for each percent."""
    told = [own for own in moved if own is not None]
    names = [n for n in _SHARES if n in _ALWAYS or any(np.any(own.columns[n]) for own in told)]
    headings = "% of the factor for each %", *(_SHARES[n] for n in names), "springs", "point masses"
    table = new_table(*headings, left=[0])
    for each, own in zip(critical, moved, strict=True):
        if own is not None:
            name = f"{each.kind} at {each.load_factor:.6g}"
            numbers = *(np.sum(own.columns[n]) for n in names), own.springs, own.point_masses
            table.add_row(name, *(f"{v + 0.0:.4f}" for v in numbers))
    out.print(table)


_ALWAYS = "bending_stiffness", "mass_per_length"
_SHARES = {
    "bending_stiffness": "EI",
    "shear_stiffness": "kGA",
    "mass_per_length": "mass",
    "rotary_inertia": "rho I",
    "foundation_stiffness": "foundation",
}


def show_along(out: Console, result: Along) -> None:
    """Print every change of stability along an input, and what was looked at."""
    if result.critical:
        names = "modes", f"{result.line}", "+-", "kind", "f [Hz]", "stability", "bracket by"
        table = new_table(*names, left=[0, 3, 5, 6])
        for each in result.critical:
            low, high = each.bracket
            table.add_row(
                Text(" with ".join(each.modes)),
                f"{each.value:.10g}",
                f"{max(high - each.value, each.value - low):.1e}",
                each.kind,
                f"{each.frequency_hz:.7g}" if each.kind == "flutter" else "",
                each.change,
                "winding number" if each.proven else "not proven",
            )
        out.print(table)
    else:
        out.print("no change of stability")
    motions = counted(result.found.unstable, "motion")
    start = f"At the start {motions} already growing. " if result.found.unstable else ""
    steps = counted(result.found.solved, "value")
    text = (
        f"{start}{result.line} from {result.line.low:g} to {result.found.reach:.7g}, all modes "
        f"solved at {steps}: that nothing else happens between is not proven."
    )
    out.print(f"[dim]{text}[/dim]", highlight=False)
    show_warnings(out, result.warnings)
    show_left_out(out, result.not_modelled)


def show_map(out: Console, result: StabilityMap) -> None:
    """Print where stability is first lost, over a second input."""
    along = "factor" if result.line is None else str(result.line)
    table = new_table(str(result.over), f"divergence: {along}", f"flutter: {along}", "", left=[3])
    both = (result.boundary(kind) for kind in ("divergence", "flutter"))
    for value, divergence, flutter, reason in zip(
        result.values, *both, result.reasons, strict=True
    ):
        cells = ("" if np.isnan(v) else f"{v:.8g}" for v in (divergence, flutter))
        table.add_row(f"{value:.6g}", *cells, Text(reason))
    out.print(table)
    show_left_out(out, result.not_modelled)


def along_csv(result: Along) -> str:
    """Return the changes of stability along an input as CSV, one a row."""
    names = "kind", str(result.line), "low", "high", "frequency [Hz]", "modes", "change", "proven"
    rows = [
        (c.kind, c.value, *c.bracket, c.frequency_hz, " + ".join(c.modes), c.change, c.proven)
        for c in result.critical
    ]
    return _csv(names, rows)


def map_csv(result: StabilityMap) -> str:
    """Return where stability is first lost over a second input as CSV, one value a row."""
    along = "load_factor" if result.line is None else str(result.line)
    names = str(result.over), f"divergence {along}", f"flutter {along}", "reason"
    both = (result.boundary(kind).tolist() for kind in ("divergence", "flutter"))
    return _csv(names, zip(result.values.tolist(), *both, result.reasons, strict=True))


def _csv(names: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(names)
    for row in rows:
        writer.writerow([repr(v) if isinstance(v, float) else v for v in row])
    return out.getvalue()
