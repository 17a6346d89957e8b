"""Responses on the terminal: what each output does, where it peaks, by which force."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from antinode.response.units import STANDARD_GRAVITY

from .printing import fitting, new_table, show_warnings

if TYPE_CHECKING:
    from antinode.response.equipment import Verdict
    from antinode.response.harmonic import HarmonicResult
    from antinode.response.modal import Basis
    from antinode.response.random import RandomResult
    from antinode.response.shock import ShockResult
    from antinode.response.spectral.moments import OutputStatistics
    from antinode.response.transient import TransientResult

_MOST_PEAKS = 4
JUDGED = {"yes": "within", "no": "EXCEEDED", "not decided": "NOT DECIDED"}
VERDICTS = {"yes": "yes", "no": "NO", "not decided": "not decided"}
Row = tuple[str, ...]


class Rows(NamedTuple):
    """A table as texts.

    Attributes
    ----------
    heads : tuple of str
    rows : sequence of tuple of str
    left : tuple of int
        Columns of words.
    narrow : sequence of tuple of int
        Columns that are kept where there is less and less room.
    """

    heads: Row
    rows: Sequence[Row]
    left: tuple[int, ...]
    narrow: Sequence[tuple[int, ...]]


def show_response(out: Console, result: Any) -> None:
    """Print a response of any kind."""
    out.print(Text(f"{result.title}: {result.kind} response, damping: {result.damping.describe()}"))
    out.print(Text(response_band(result)))
    _show_rows(out, response_rows(result))
    if result.kind == "random":
        _show_envelope(out, result)
    if result.kind != "transient":
        _show_verdicts(out, result.verdicts)
    show_warnings(out, result.warnings)


def response_rows(result: Any) -> Rows:
    """Return what a response of any kind comes to, output by output, as texts."""
    rows: Rows = _ROWS[result.kind](result)
    return rows


def response_band(result: Any) -> str:
    """Say over which frequencies or times a response runs."""
    if result.kind == "transient":
        t = result.time_s
        return f"{t[0]:g} to {t[-1]:g} s, {len(t)} times; {result.count} modes and a static rest"
    f = result.frequency_hz
    band = f"{f[0]:g} to {f[-1]:g} Hz"
    if result.kind == "random":
        return f"band {band}, exposure {result.duration_s:g} s"
    if result.kind == "shock":
        return f"oscillators of {band}, Q = {result.q:g}; {result.count} modes"
    return f"{len(f)} frequencies, {band}"


def _show_rows(out: Console, own: Rows) -> None:
    """Print a table; where the console is narrow, with the first choice of columns that fits."""
    every = tuple(range(len(own.heads)))
    tables = (_table(own, kept) for kept in (every, *own.narrow))
    out.print(fitting(tables, out, wrapped=True))


def _table(own: Rows, kept: tuple[int, ...]) -> Table:
    left = [i for i, k in enumerate(kept) if k in own.left]
    table = new_table(*(own.heads[k] for k in kept), left=left)
    for row in own.rows:
        table.add_row(*(Text(row[k]) for k in kept))
    return table


def _harmonic_rows(result: HarmonicResult) -> Rows:
    f = result.frequency_hz
    rows: list[Row] = []
    for row, output in enumerate(result.outputs):
        highest = sorted(result.peaks[row], key=lambda peak: -peak.size)[:_MOST_PEAKS]
        for peak in highest:
            cells = (
                f"{peak.frequency_hz:.6g}",
                f"{peak.size:.5g}",
                output.unit,
                f"{result.peak_error[row]:.1e}",
                mode_near(result.modes, peak.frequency_hz),
            )
            name = output.name if peak is highest[0] else ""
            rows.append((name, *cells))
        if not highest:
            k = int(np.argmax(np.abs(result.values[row])))
            largest = (f"{f[k]:.6g}", f"{abs(result.values[row, k]):.5g}", output.unit)
            rows.append((output.name, *largest, f"{result.error[row]:.1e}", "no peak"))
    heads = ("output", "peak [Hz]", "amplitude", "unit", "+-", "mode")
    return Rows(heads, rows, (0, 3, 5), [(0, 1, 2, 3, 4)])


def mode_near(modes: tuple[Basis, ...], frequency_hz: float) -> str:
    """Return the mode whose frequency is nearest, or nothing if none is within a tenth."""
    names = [
        (abs(f / frequency_hz - 1), name)
        for own in modes
        for name, f in zip(own.names, own.frequency_hz, strict=True)
        if f > 0
    ]
    distance, name = min(names, default=(1.0, ""))
    return name if distance < 0.1 else ""


def _random_rows(result: RandomResult) -> Rows:
    rows: list[Row] = []
    for output, own in zip(result.outputs, result.statistics, strict=True):
        size = scale_of(output.unit)
        cells = (
            f"{own.rms / size.factor:.5g}",
            size.unit,
            f"{own.error / size.factor:.1e}",
            f"{3 * own.rms / size.factor:.4g}",
            f"{own.peak / size.factor:.4g}",
            f"{own.crossings_per_s:.4g}",
            mostly(own),
        )
        rows.append((output.name, *cells))
    heads = ("output", "rms", "unit", "+-", "3 sigma", "largest", "up/s", "mostly by")
    narrow = [(0, 1, 2, 3, 4, 5, 7), (0, 1, 2, 3, 4, 5, 6), (0, 1, 2, 3, 4, 5), (0, 1, 2, 3)]
    return Rows(heads, rows, (0, 2, 7), narrow)


def mostly(own: OutputStatistics) -> str:
    """Say which mode and which force make most of an output."""
    if not own.by_mode or own.rms == 0:
        return ""
    name, share = own.by_mode[0][:2]
    words = f"{name} ({100 * share:.0f} %)" if name else ""
    if len(own.by_drive) > 1:
        force, part = own.by_drive[0]
        words += f", {force} ({100 * part:.0f} %)"
    return words


def _show_envelope(out: Console, result: RandomResult) -> None:
    if result.envelope is None:
        return
    x = result.envelope["x"]
    for key, unit in (("acceleration_rms", "m/s^2"), ("bending_moment_rms", "N m")):
        values = result.envelope[key]
        k = int(np.argmax(values))
        size = scale_of(unit)
        words = key.removesuffix("_rms").replace("_", " ")
        out.print(
            Text(
                f"{words} along the body: at most {values[k] / size.factor:.5g} {size.unit} rms, "
                f"at {x[k]:.4g} m"
            )
        )


def _show_verdicts(out: Console, verdicts: Sequence[Verdict]) -> None:
    """Print the equipment line by line."""
    if verdicts:
        _show_rows(out, verdict_rows(verdicts))


def verdict_rows(verdicts: Sequence[Verdict]) -> Rows:
    """Return what equipment feels against what it may, line by line, as texts."""
    rows: list[Row] = []
    for own in verdicts:
        rms = "" if own.rms is None else f"{own.rms / STANDARD_GRAVITY:.3g}"
        cells = (
            f"{own.x:.5g}",
            own.margin_words,
            error_words(own.error_db),
            VERDICTS[own.verdict],
            f"{own.frequency_hz:.5g}",
            own.mode,
            own.force,
            rms,
        )
        rows.append((own.name, *cells))
    judged = ("margin [dB]", "+-", "verdict", "at [Hz]", "mode", "force", "rms [g]")
    narrow = [(0, *range(2, 9)), (0, *range(2, 8)), (0, *range(2, 7)), (0, 2, 3, 4)]
    return Rows(("equipment", "x [m]", *judged), rows, (0, 4, 6, 7), narrow)


def error_words(error_db: float) -> str:
    """Return the error of a margin; nothing where the margin is said in words."""
    return f"{error_db:.1e}" if 0 < error_db < np.inf else ""


class Shown(NamedTuple):
    """A unit that people read, and what it is in SI."""

    factor: float
    unit: str


def scale_of(unit: str) -> Shown:
    """Return g for accelerations, else SI."""
    return Shown(STANDARD_GRAVITY, "g") if unit == "m/s^2" else Shown(1.0, unit)


def _transient_rows(result: TransientResult) -> Rows:
    found = zip(result.outputs, result.largest, result.peak_error, strict=True)
    rows: list[Row] = []
    for output, (time, value), error in found:
        size = scale_of(output.unit)
        cells = (f"{value / size.factor:.5g}", size.unit, f"{error / size.factor:.1e}")
        rows.append((output.name, *cells, f"{time:.5g}"))
    return Rows(("output", "largest", "unit", "+-", "at [s]"), rows, (0, 2), [(0, 1, 2, 3)])


def _shock_rows(result: ShockResult) -> Rows:
    f = result.frequency_hz
    rows: list[Row] = []
    for row, output in enumerate(result.outputs):
        size, k = scale_of(output.unit), int(np.argmax(result.srs[row]))
        cells = (f"{result.srs[row, k] / size.factor:.5g}", size.unit)
        more = (f"{result.off[row, k] / size.factor:.1e}", f"{f[k]:.5g}")
        rows.append((output.name, *cells, *more))
    heads = ("output", "largest SRS", "unit", "+-", "at [Hz]")
    return Rows(heads, rows, (0, 2), [(0, 1, 2, 3)])


_ROWS: dict[str, Any] = {
    "harmonic": _harmonic_rows,
    "random": _random_rows,
    "transient": _transient_rows,
    "shock": _shock_rows,
}
