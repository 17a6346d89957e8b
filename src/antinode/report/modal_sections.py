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
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing
    from matplotlib.transforms import Bbox

_BESIDE = 0.03  # in, around panels that are cut out of a figure


def drawn(name: str, figure: Drawing, caption: str) -> Figure:
    """Return a figure of matplotlib as a block, its text as text."""
    svg = _svg(name, figure)
    pyplot().close(figure)
    return Figure(name, svg, runs(caption))


def drawn_on_pages(name: str, figure: Drawing, caption: str, most: int = 3) -> list[Figure]:
    """Return a figure of panels one below the other as blocks of at most so many panels each."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # panels stay where they are
    rows: dict[float, list[Axes]] = {}  # two axes share a place where one has two scales
    for axes in figure.axes:
        rows.setdefault(round(axes.get_position().y0, 6), []).append(axes)
    panels = [rows[y] for y in sorted(rows, reverse=True)]
    if len(panels) <= most:
        return [drawn(name, figure, caption)]
    parts = [panels[k : k + most] for k in range(0, len(panels), most)]
    boxes = [_around(figure, part, top=part is parts[0]) for part in parts]
    blocks = []
    for k, box in enumerate(boxes, 1):
        own = name if k == 1 else f"{name}_{k}"
        said = caption if k == 1 else "The same, further panels."
        blocks.append(Figure(own, _svg(own, figure, box), runs(said)))
    pyplot().close(figure)
    return blocks


def _around(figure: Drawing, panels: Sequence[Sequence[Axes]], *, top: bool) -> Bbox:
    """Return the full width around some panels [in]; up to the figure's title at its top."""
    from matplotlib.transforms import Bbox

    own = (axes.get_tightbbox() for panel in panels for axes in panel)
    whole = Bbox.union([box for box in own if box is not None])
    width, height = (float(size) for size in figure.get_size_inches())
    low, high = whole.y0 / figure.dpi - _BESIDE, whole.y1 / figure.dpi + _BESIDE
    return Bbox.from_extents(0.0, max(low, 0.0), width, height if top else high)


def _svg(name: str, figure: Drawing, part: Bbox | None = None) -> str:
    out = io.StringIO()
    with styled() as plt:
        plt.rcParams["svg.hashsalt"] = name
        about = {"Date": None, "Creator": None}
        figure.savefig(out, format="svg", metadata=about, bbox_inches=part)
    return out.getvalue()


def frequency_section(result: ModalResult) -> Section:
    """Return the table of frequencies with what certifies them."""
    pieces = ", ".join(f"{n} ({family})" for family, n in result.segments.items())
    solved = f"Uniform segments: {pieces}; tolerance {number(result.tolerance)}."
    if result.is_complex:
        blocks = paragraph(f"{_proof(result)} {solved}"), _complex_table(result.modes)
        return Section("Frequencies", blocks)
    return Section(
        "Frequencies",
        (
            paragraph(
                "The counts stand beside each bracket: so many modes lie below its lower and its "
                f"upper end, rigid and divergent ones included. {solved}"
            ),
            _frequency_table(result.modes),
        ),
    )


def _proof(result: ModalResult) -> str:
    """Say how far a list with complex modes is proven."""
    certificate = result.certificate
    if certificate.get("kind") == "none":
        return "Modes are complex. That none of them is missing is not proven here."
    radius = number(certificate["region"]["abs_s_below"], 4)
    return (
        f"Modes are complex. All with abs(s) < {radius} /s were found, and no others: the turns of "
        "the characteristic function around that circle, and around each eigenvalue, prove it."
    )


def _error_of_s(mode: Mode) -> float:
    return 2 * math.pi * mode.error_hz if mode.error_per_s is None else mode.error_per_s


def _complex_table(modes: Sequence[Mode]) -> Table:
    head = "mode", "kind", "f [Hz]", "damping ratio", "growth [1/s]", "± error [1/s]"
    rows = [
        (
            mode.name,
            mode.kind,
            "–" if mode.omega2 < 0 else "0" if mode.omega2 == 0 else _frequency(mode),
            number(mode.damping_ratio, 4),
            number(mode.eigenvalue_per_s.real, 5),
            small(_error_of_s(mode)),
        )
        for mode in modes
    ]
    marked = [k for k, m in enumerate(modes) if m.number and m.kind in ("divergent", "flutter")]
    return table(
        "Modes exp(s t) in order of abs(Im s): frequency abs(Im s)/2π, damping ratio −Re s/abs(s), "
        "growth Re s. The error is that of s.",
        head,
        rows,
        left=(0, 1),
        marked=marked,
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
