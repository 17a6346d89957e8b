"""Objects as they stand in a notebook: a title, a small picture, a table, what to know of them.

Plain HTML without scripts. Colours are those of the page around, so that it may be light or dark.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.beam.attachments import name_of
from antinode.beam.checks import TABLES
from antinode.inputs.reading import COLUMN_UNITS
from antinode.modes.solve import beam_of
from antinode.show.printing import end_force_text, mode_cells
from antinode.show.response_table import JUDGED, error_words, scale_of
from antinode.text import counted

from .lines import about_beam, span_of
from .pictures import (
    bars_picture,
    beam_picture,
    case_picture,
    curve_picture,
    loads_picture,
    modes_picture,
)

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult
    from antinode.modes.solve import HasBeam
    from antinode.stability.result import Stability
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads

MOST_ROWS = 24
_STYLE = (
    "<style>.antinode-card{font-family:system-ui,sans-serif;font-size:13px;line-height:1.45;"
    "max-width:46em;margin:.3em 0;color:inherit}"
    ".antinode-card table{border-collapse:collapse;margin:.4em 0;font-size:12px;"
    "background:transparent;border:none;width:auto;display:table}"
    ".antinode-card tr{background:transparent !important}"
    ".antinode-card th,.antinode-card td{padding:.15em .7em .15em 0;text-align:right;border:none;"
    "background:transparent;color:inherit}"
    ".antinode-card th{font-weight:600;border-bottom:1px solid currentColor;opacity:.75}"
    ".antinode-card .l{text-align:left}"
    ".antinode-card .about{opacity:.75}.antinode-card ul{margin:.3em 0;padding-left:1.2em}"
    ".antinode-card .warning::marker{content:'\\26a0  '}</style>"
)


def card(
    title: str,
    about: str,
    picture: str = "",
    tables: Iterable[str] = (),
    warnings: Iterable[str] = (),
) -> str:
    """Return an object as HTML.

    Parameters
    ----------
    title, about : str
        Its name, and what it is in a line.
    picture : str
        An SVG.
    tables : iterable of str
        As `html_table` returns them.
    warnings : iterable of str
        What a reader should know before trusting it.
    """
    told = "".join(f'<li class="warning">{escape(text)}</li>' for text in warnings)
    return (
        f'<div class="antinode-card">{_STYLE}<div><b>{escape(title)}</b> '
        f'<span class="about">{escape(about)}</span></div>{picture}{"".join(tables)}'
        f"{f'<ul>{told}</ul>' if told else ''}</div>"
    )


def html_table(
    headings: Sequence[str], rows: Sequence[Sequence[str]], left: Sequence[int] = (0,)
) -> str:
    """Return a table; what is beyond `MOST_ROWS` is counted."""

    def cells(row: Sequence[str], tag: str) -> str:
        return "".join(
            f"<{tag}{' class=l' if k in left else ''}>{escape(str(cell))}</{tag}>"
            for k, cell in enumerate(row)
        )

    body = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows[:MOST_ROWS])
    if len(rows) > MOST_ROWS:
        more = f"... {len(rows) - MOST_ROWS} more"
        body += f'<tr><td class=l colspan="{len(headings)}">{more}</td></tr>'
    return f"<table><thead><tr>{cells(headings, 'th')}</tr></thead><tbody>{body}</tbody></table>"


def beam_card(problem: Beam | HasBeam) -> str:
    """Return a beam as HTML: its sketch, and the range of every column."""
    beam = beam_of(problem)
    rows = []
    for name in TABLES:
        table = getattr(beam, name)
        if table is None or (name == "axial_force" and beam.is_unloaded):
            continue
        ends = table[:, [0, -1]]
        numbers = (f"{ends[0, 0]:.4g}", f"{ends[-1, 1]:.4g}", f"{ends.min():.4g}")
        rows.append((name, COLUMN_UNITS[name] or "1", *numbers, f"{ends.max():.4g}"))
    tables = [html_table(("column", "unit", "left", "right", "least", "most"), rows, (0, 1))]
    if beam.attachments:
        attached = [(name_of(item), f"{item.x:.5g}") for item in beam.attachments]
        tables.append(html_table(("attached", "x [m]"), attached))
    return card(beam.name, about_beam(beam), beam_picture(beam), tables)


def case_card(case: Case) -> str:
    """Return a vehicle in its condition as HTML: in its cavity, with the loads that follow."""
    c, loads = case.condition, case.loads
    about = (
        f"{case.vehicle.length:.5g} m, {loads.mass:.5g} kg, V = {c.speed:g} m/s, "
        f"sigma = {loads.sigma:.4g}, cavitator {math.degrees(c.cavitator_angle):.3g} deg, thrust "
        f"{c.thrust / 1e3:g} kN, {end_force_text(case.model.follow)}"
    )
    warnings = [*case.notes, *loads.warnings]
    return card(case.vehicle.name, about, case_picture(case), [_forces(loads)], warnings)


def _forces(loads: Loads) -> str:
    rows = [(f.name, f"{f.x:.4g}", f"{f.F_X:.5g}", f"{f.F_Y:.5g}") for f in loads.forces]
    rows.append(("thrust", f"{loads.length:.4g}", f"{-loads.thrust:.5g}", "0"))
    rows.append(("weight", f"{loads.x_M:.4g}", "", f"{-loads.weight:.5g}"))
    return html_table(("force", "x [m]", "aft [N]", "up [N]"), rows)


def loads_card(loads: Loads) -> str:
    """Return loads as HTML: N along the body, and every force."""
    about = (
        f"{loads.mass:.5g} kg, {loads.a_X:.3g} m/s^2 forward, {loads.a_Y:.3g} m/s^2 up, "
        f"{loads.beta:.3g} rad/s^2 nose-up{loads.unbalanced}; balance at the ends closes to "
        f"{loads.checks.worst:.0e}"
    )
    return card("Loads", about, loads_picture(loads), [_forces(loads)], loads.warnings)


def modes_card(result: ModalResult) -> str:
    """Return modes as HTML: the first shapes, and every frequency with its error."""
    all_rows = [mode_cells(mode, brief=False) for mode in result.modes]
    every = ("mode", "kind", "f [Hz]", "± error", "by axial force", "by shear")
    kept = [k for k in range(len(every)) if any(row[k] for row in all_rows)]
    headings, rows = [every[k] for k in kept], [[row[k] for k in kept] for row in all_rows]
    certificate = result.certificate.get("kind", "counts")
    about = f"{about_beam(result.beam)}; certified by {certificate}"
    if certificate == "none":
        about = f"{about_beam(result.beam)}; not certified"
    tables = [html_table(headings, rows, (0, 1))]
    return card(result.beam.name, about, modes_picture(result), tables, result.warnings)


def stability_card(result: Stability) -> str:
    """Return critical loads as HTML: a bar up to each factor, and what happens there."""
    rows = [
        (
            *(each.kind, ", ".join(each.modes), f"{each.load_factor:.7g}", f"{each.error:.1e}"),
            f"{each.frequency_hz:.6g}" if each.kind == "flutter" else "",
            each.change + ("" if each.proven else ", not proven"),
        )
        for each in result.critical
    ]
    about = f"factors on the axial forces from {result.range[0]:g} to {result.range[1]:.6g}"
    headings = ("kind", "modes", "factor", "± error", "f [Hz]", "stability")
    tables = [html_table(headings, rows, (0, 1, 5))] if rows else []
    bars = [(f"{each.kind}, {each.modes[0]}", each.load_factor) for each in result.critical]
    picture = bars_picture(bars, "critical load factors", "")
    told = about if rows else f"{about}: stable"
    return card(result.name, told, picture, tables, result.warnings)


def response_card(result: Any) -> str:
    """Return a response as HTML: its curves, its outputs, and the verdict on equipment."""
    about = f"{result.kind} response, {span_of(result)}, damping {result.damping.describe()}"
    tables = [html_table(("output", "largest", "unit"), _output_rows(result), (0, 2))]
    verdicts = getattr(result, "verdicts", ())
    if verdicts:
        rows = [
            (
                *(v.name, f"{v.x:.4g}", JUDGED[v.verdict], v.margin_words),
                *(error_words(v.error_db), f"{v.frequency_hz:.4g}", v.mode),
            )
            for v in verdicts
        ]
        judged = ("verdict", "margin [dB]", "± error", "at [Hz]", "mode")
        tables.append(html_table(("equipment", "x [m]", *judged), rows, (0, 2, 6)))
    return card(result.title, about, _response_picture(result), tables, result.warnings)


def _curves_of(result: Any) -> Any:
    """Return what a response draws: a row for each output."""
    for name in ("psd", "srs", "values"):
        rows = getattr(result, name, None)
        if rows is not None:
            return rows
    raise TypeError(type(result))


def _output_rows(result: Any) -> list[tuple[str, str, str]]:
    rows: list[tuple[str, str, str]] = []
    for output, values in zip(result.outputs, _curves_of(result), strict=True):
        size = scale_of(output.unit)
        largest, unit = float(np.max(np.abs(values))) / size.factor, size.unit
        if result.kind == "random":
            largest = result.statistics[len(rows)].rms / size.factor
            unit = f"{size.unit} rms"
        rows.append((output.name, f"{largest:.4g}", unit))
    return rows


def _response_picture(result: Any) -> str:
    rows = [np.abs(row) for row in _curves_of(result)][:4]
    if not rows:
        return ""
    names = [output.name for output in result.outputs[:4]]
    if hasattr(result, "frequency_hz"):
        return curve_picture(result.frequency_hz, rows, names, span_of(result), log=True)
    rows = [np.asarray(row) for row in _curves_of(result)][:4]
    return curve_picture(result.time_s, rows, names, span_of(result), log=False)


def warnings_of(found: Iterable[dict[str, Any]]) -> list[str]:
    """Return warnings that were counted over cases, in words."""
    return [f"{w['message']} ({counted(int(w['count']), 'case')})" for w in found]
