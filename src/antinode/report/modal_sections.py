"""Frequencies with errors, brackets and counts; what the axial force does; shapes."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from antinode.beam.families import BENDING
from antinode.modes.buckling import buckling_of
from antinode.modes.hertz import hertz
from antinode.modes.result import ModalResult, Mode
from antinode.show.style import pyplot, styled

from .blocks import Block, Figure, Section, Table, paragraph, runs, table
from .numbers import apart, number, percent, small

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing


def drawn(name: str, figure: Drawing, caption: str) -> Figure:
    """Return a figure of matplotlib as a block, its text as text."""
    out = io.StringIO()
    with styled() as plt:
        plt.rcParams["svg.hashsalt"] = name
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    pyplot().close(figure)
    return Figure(name, out.getvalue(), runs(caption))


def frequency_section(result: ModalResult) -> Section:
    """Return the table of frequencies with what certifies them."""
    pieces = ", ".join(f"{n} ({family})" for family, n in result.segments.items())
    return Section(
        "Frequencies",
        (
            paragraph(
                "The counts stand beside each bracket: so many modes lie below its lower and its "
                "upper end, rigid and divergent ones included. Uniform segments: "
                f"{pieces}; tolerance {number(result.tolerance)}."
            ),
            _frequency_table(result.modes),
        ),
    )


def _frequency_table(modes: Sequence[Mode]) -> Table:
    head = (
        "mode",
        "kind",
        "f [Hz]",
        "± error [Hz]",
        "bracket [Hz]",
        "counts",
        "shear, rot. inertia",
    )
    rows = [_frequency_row(mode) for mode in modes]
    marked = [k for k, mode in enumerate(modes) if mode.number and mode.kind == "divergent"]
    return table(
        "Modes in order of ω^2. The last column tells what shear and rotary inertia do: solved, or "
        "estimated where the theory leaves them out.",
        head,
        rows,
        left=(0, 1),
        marked=marked,
    )


def _frequency_row(mode: Mode) -> tuple[str, ...]:
    counts = "–" if mode.counts[0] < 0 else f"{mode.counts[0]}, {mode.counts[1]}"
    if mode.omega2 < 0:
        rate = f"grows at {number(mode.growth_rate_per_s)} /s"
        error = small(mode.error_growth_rate_per_s)
        return mode.name, mode.kind, rate, f"{error} /s", "–", counts, "–"
    zero = mode.omega2 == 0
    exact = zero and not mode.error_hz > 0
    low, high = apart(*mode.bracket_hz)
    return (
        mode.name,
        mode.kind,
        "0" if zero else _frequency(mode),
        "exact" if exact else small(mode.error_hz),
        "–" if exact else f"{low} … {high}",
        counts,
        percent(mode.by_shear),
    )


def _frequency(mode: Mode) -> str:
    """Return the frequency with the digits that its error leaves, at most 9."""
    share = mode.error_hz / mode.frequency_hz if mode.frequency_hz else 1.0
    digits = min(9, max(4, math.floor(-math.log10(max(share, 1e-12)))))
    return number(mode.frequency_hz, digits)


def axial_section(result: ModalResult) -> Section:
    """Return what the axial force does to each mode, and how far it is from buckling."""
    rows = [
        (
            mode.name,
            number(hertz(mode.unloaded_omega2), 7),
            number(mode.frequency_hz, 7) if mode.omega2 >= 0 else "divergent",
            percent(mode.shift),
        )
        for mode in result.family(BENDING)
        if mode.number and mode.unloaded_omega2 is not None
    ]
    head = ("mode", "without N [Hz]", "with N [Hz]", "change")
    blocks: list[Block] = [paragraph(_buckling_words(result))]
    if rows:
        blocks.append(table("Bending modes without and with the axial force.", head, rows))
    return Section("Effect of the axial force", tuple(blocks))


def _buckling_words(result: ModalResult) -> str:
    if result.beam.is_unloaded:
        return "There is no axial force."
    if any(result.beam.following()):
        return (
            "The force of an end turns with it. No load factor of buckling is given: it belongs to "
            "forces of fixed direction, and a beam under forces that turn may flutter first."
        )
    buckles = buckling_of(result)
    words = "Compression lowers bending frequencies, tension raises them; the others keep theirs. "
    if buckles is None:
        return words + "No factor on this axial force buckles the beam."
    return words + (
        "The first supported bending mode starts to diverge (buckles) at "
        f"{number(buckles.load_factor, 6)} ± {small(buckles.error)} times this axial force, its "
        "distribution and its direction kept."
    )


def result_in_brief(result: ModalResult) -> str:
    """Return the first modes in one sentence."""
    parts = [_in_words(mode) for mode in result.family(BENDING) if mode.number][:3]
    text = "; ".join(parts) + "." if parts else ""
    return text[:1].upper() + text[1:]


def _in_words(mode: Mode) -> str:
    if mode.omega2 < 0:
        return f"{mode.name} diverges, at {number(mode.growth_rate_per_s, 4)} /s"
    shift = "" if math.isnan(mode.shift) else f" ({percent(mode.shift)} by the axial force)"
    return f"{mode.name}: {_frequency(mode)} Hz{shift}"
