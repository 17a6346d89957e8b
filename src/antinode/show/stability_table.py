"""Critical loads on the terminal, and as CSV."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from antinode.modes.result import not_modelled
from antinode.text import counted

from .printing import new_table, show_left_out, show_warnings

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.stability.result import CriticalLoad, DampedLoss, Stability

_CHANGES = {
    "lost": "lost",
    "regained": "regained",
    "merged": "diverging modes begin to flutter",
}
_PROOFS = {"counts": "counts", "winding": "winding number", "none": "not proven"}


def show_stability(out: Console, result: Stability, beam: Beam) -> None:
    """Print every change of stability, what lies between, warnings, and what is left out."""
    if result.critical:
        headings = "factor", "+-", "kind", "f [Hz]", "modes", "stability", "bracket by"
        table = new_table(*headings, left=(2, 4, 5, 6))
        for each in result.critical:
            table.add_row(*(Text(cell) for cell in _cells(each)))
        out.print(table)
    else:
        out.print("stable, whatever the factor" if result.range[1] == float("inf") else "stable")
    if result.damped is not None:
        out.print(Text(_with_dampers(result.damped)))
    out.print(f"[dim]{_between(result)}[/dim]", highlight=False)
    show_warnings(out, result.warnings)
    show_left_out(out, not_modelled(beam))


def _cells(each: CriticalLoad) -> tuple[str, ...]:
    flutter = each.kind == "flutter"
    return (
        f"{each.load_factor:.10g}",
        f"{each.error:.1e}",
        each.kind,
        f"{each.frequency_hz:.7g}" if flutter else "",
        " with ".join(each.modes),
        _CHANGES[each.change],
        _PROOFS[each.certificate.kind],
    )


def _with_dampers(damped: DampedLoss) -> str:
    at = f" at {damped.frequency_hz:.7g} Hz" if damped.frequency_hz else ""
    proven = "" if damped.proven else ", not proven"
    return (
        f"With its dashpots and loss factors: {damped.mode}, {damped.kind}{at} from "
        f"{damped.load_factor:.8g}{proven}."
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
