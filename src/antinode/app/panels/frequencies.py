"""Frequencies as a table with bars beside a pinned baseline; modes near an excitation flagged."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from antinode.app.compute import Answer
from antinode.app.quick import QUICK_FAMILY
from antinode.app.state import View
from antinode.beam.families import FamilyName
from antinode.modes.hertz import error_hz, hertz
from antinode.modes.result import Mode


class Row(NamedTuple):
    """A mode of the table.

    Attributes
    ----------
    name : str
    hertz, error : float
        Frequency and the bound on its error [Hz]; NaN where it does not oscillate.
    shift, shear : float or None
        Relative changes by the axial force, and by shear and rotary inertia.
    damping : str
        Of a complex mode: how it decays or grows.
    """

    name: str
    hertz: float
    error: float
    shift: float = math.nan
    shear: float | None = None
    damping: str = ""
    kind: str = "elastic"


def frequencies_data(answer: Answer, view: View) -> dict[str, Any]:
    """Return rows, bars, band and excitation lines, and what the model leaves out."""
    rows = frequency_rows(answer, view.family)
    baseline = dict(view.baseline)
    shown = [_shown(row, baseline.get(row.name), view) for row in rows]
    marks = [*(view.band or ()), *view.lines, *(r["baseline"] or 0.0 for r in shown)]
    top = max([r["hz"] or 0.0 for r in shown] + marks, default=1.0) or 1.0
    return {
        "family": view.family,
        "rows": shown,
        "top": 1.06 * top,
        "band": list(view.band) if view.band else None,
        "lines": list(view.lines),
        "margin": view.margin,
        "chosen": view.body,
        "pinned": bool(baseline),
        "damped": any(row.damping for row in rows),
        "quick": answer.full is None,
        "left_out": [short_name(words) for words in answer.left_out],
    }


def short_name(words: str) -> str:
    """Return what is left out without what is said of it."""
    return words.partition(" (")[0].partition(":")[0]


def frequency_rows(answer: Answer, family: FamilyName) -> list[Row]:
    """Return the modes 1, 2, ... of a family; of the quick answer only those of its family."""
    if answer.full is not None:
        modes = [mode for mode in answer.full.modes if mode.family == family and mode.number]
        return [_row(mode) for mode in modes[:12]]
    if family != QUICK_FAMILY:
        return []
    quick = answer.quick
    values = zip(quick.omega2.tolist(), quick.error.tolist(), strict=True)
    return [
        Row(f"{family} {n}", hertz(w2), error_hz(w2, e), kind=_kind(w2))
        for n, (w2, e) in enumerate(values, 1)
    ]


def _kind(omega2: float) -> str:
    return "divergent" if omega2 < 0 else "elastic"


def _row(mode: Mode) -> Row:
    still = mode.kind in ("divergent", "overdamped")
    values = (math.nan, math.nan) if still else (mode.frequency_hz, mode.error_hz)
    return Row(mode.name, *values, mode.shift, mode.by_shear, damping_text(mode), mode.kind)


def damping_text(mode: Mode) -> str:
    """Say how a complex mode decays or grows; empty for a real one."""
    if mode.eigenvalue is None and not mode.growth:
        return ""
    if mode.kind in ("divergent", "overdamped", "flutter"):
        return f"{mode.eigenvalue_per_s.real:+.3g} /s"
    if abs(mode.eigenvalue_per_s.real) <= mode.error_growth_rate_per_s:
        return "0"
    return f"{100 * mode.damping_ratio:.3g}%"


def _shown(row: Row, baseline: float | None, view: View) -> dict[str, Any]:
    still = math.isnan(row.hertz)
    changed = bool(baseline) and not still
    return {
        "name": row.name,
        "number": row.name.rpartition(" ")[2],
        "hz": None if still else row.hertz,
        "text": row.kind if still else f"{row.hertz:.6g}",
        "kind": row.kind,
        "error": "" if math.isnan(row.error) else f"{row.error:.0e}",
        "shift": "" if math.isnan(row.shift) else change_text(row.shift, 1),
        "shear": "" if still or row.shear is None else change_text(row.shear, 1),
        "damping": row.damping,
        "baseline": baseline,
        "change": change_text(row.hertz / baseline - 1, 2) if baseline and changed else "",
        "flag": "" if still else flag(row.hertz, view),
    }


def change_text(change: float, digits: int) -> str:
    """Write a relative change with its sign; what rounds to nothing has none."""
    text = f"{change:+.{digits}%}"
    return text if any(digit in text for digit in "123456789") else text[1:]


def flag(frequency: float, view: View) -> str:
    """Say that a frequency lies in the equipment band, or within the margin of band or line."""
    if view.band and view.band[0] <= frequency <= view.band[1]:
        return "in the equipment band"
    for mark in (*(view.band or ()), *view.lines):
        if abs(frequency - mark) <= view.margin * mark:
            return f"within {view.margin:.0%} of {mark:g} Hz"
    return ""


def baseline_of(answer: Answer) -> tuple[tuple[str, float], ...]:
    """Return the frequencies of an answer, to be pinned."""
    families = answer.full.families if answer.full else (QUICK_FAMILY,)
    rows = [row for family in families for row in frequency_rows(answer, family)]
    return tuple((row.name, float(f"{row.hertz:.7g}")) for row in rows if not math.isnan(row.hertz))
