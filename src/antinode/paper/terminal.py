"""The tables of the paper beside antinode's, on the terminal (rich)."""

from __future__ import annotations

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table as RichTable
from rich.text import Text

from .comparison import Bounds, Comparison, Line, size_of, within
from .tables import MODES, TABLES, Table

RECONSTRUCTION = (
    "RECONSTRUCTION: the data of the paper's vehicle are lost. This is one vehicle that comes near "
    "its tables; others would too."
)


def show_comparison(out: Console, comparison: Comparison) -> None:
    """Print Tables 1 to 5, then the sizes of the differences and the verdict."""
    out.print(RECONSTRUCTION, highlight=False)
    for table in TABLES:
        out.print()
        out.print(
            f"[bold]Table {table.number}[/bold]  {table.title} ({table.held})", highlight=False
        )
        out.print(_frequencies(table, comparison.table(table.number)))
    out.print("[bold]Relative differences[/bold], (antinode - paper) / paper", highlight=False)
    out.print(_sizes(comparison))
    out.print(verdict(comparison), highlight=False)


def verdict(comparison: Comparison) -> str:
    """Return in one sentence which bounds hold."""
    ok, target = comparison.within_bounds, within(comparison.overall, comparison.target)
    kept = "The bounds that ship with the vehicle are " + ("kept" if ok else "BROKEN")
    aim = "The target is " + ("met." if target else "not met.")
    return f"{kept}: {_pair(comparison.bounds)} over all 30 rows. {aim}"


def _pair(bounds: Bounds) -> str:
    return f"at most {bounds.worst:.3g} at worst and {bounds.rms:.3g} rms"


def _frequencies(table: Table, lines: tuple[Line, ...]) -> RichTable:
    shown = _table(table.head, "[Hz]", *(f"f{mode}" for mode in range(1, MODES + 1)))
    for line in lines:
        mark = " *" if line.row.held_out else ""
        paper = (f"{f:.4f}" for f in line.row.frequencies_hz)
        shown.add_row(Text(table.value(line.row) + mark), "paper", *paper)
        shown.add_row("", "antinode", *(f"{f:.4f}" for f in line.antinode_hz))
        shown.add_row("", "difference", *(_percent(d) for d in line.differences), style="dim")
    if any(line.row.held_out for line in lines):
        shown.caption = "* held out of the fit"
        shown.caption_justify = "left"
    return shown


def _sizes(comparison: Comparison) -> RichTable:
    shown = _table("", "rows", "worst", "rms")
    for table in TABLES:
        _size(shown, f"Table {table.number}", comparison.table(table.number))
    shown.add_section()
    _size(shown, "fitted", comparison.fitted)
    _size(shown, "held out", comparison.held_out)
    _size(shown, "all", comparison.lines)
    shown.add_section()
    for name, bounds in (("bound", comparison.bounds), ("target", comparison.target)):
        shown.add_row(name, "", f"{bounds.worst:.2e}", f"{bounds.rms:.2e}")
    return shown


def _size(shown: RichTable, name: str, lines: tuple[Line, ...]) -> None:
    size = size_of(lines)
    shown.add_row(name, str(len(lines)), f"{size.worst:.2e}", f"{size.rms:.2e}")


def _table(*headings: str) -> RichTable:
    shown = RichTable(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for position, heading in enumerate(headings):
        left = position == 0 or heading == "[Hz]"
        shown.add_column(Text(heading), justify="left" if left else "right", no_wrap=True)
    return shown


def _percent(difference: float) -> str:
    return f"{100 * difference:+.3f} %"
