"""One self-contained HTML page: tables, figures with captions, and how the paper was read."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator
from html import escape
from importlib.resources import files
from string import Template

import numpy as np

from antinode.vehicle.case import Case
from antinode.version import __version__

from .comparison import Comparison, Line, size_of, within
from .plates import Plate
from .tables import MODES, TABLES, Table
from .terminal import verdict

Drawing = tuple[Plate, str, str]
"""A plate with its SVG and its caption."""

MISPRINTS = {(4, 5.8): "bending 3: misprint? 20.7051 stands beside 33.7051, and fits give 20.714"}
"""Table and value of a row with a number that the others contradict, and what is said there."""

_SYMBOL = re.compile(r"\b([^\W\d_]'?)_(\w+)\b")
_WORDS = ((r"\bsigma\b", "σ"), (r"\balpha\b", "α"), (r"\bomega\b", "ω"), (r"\btheta\b", "θ"))
_MORE = ((r"\blambda\b", "λ"), (r"\bbeta\b", "β"), (r" deg\b", "°"), (r"\^2\b", "²"))


def page(comparison: Comparison, drawings: Iterable[Drawing]) -> str:
    """Return the page."""
    template = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    vehicle = comparison.lines[0].case.vehicle.name
    return Template(template).substitute(
        version=__version__,
        vehicle=escape(vehicle),
        verdict=escape(verdict(comparison)),
        sizes="\n".join(_sizes(comparison)),
        tables="\n".join(_table(table, comparison.table(table.number)) for table in TABLES),
        figures="\n".join(_figure(*drawing) for drawing in drawings),
        contents="\n".join(_contents()),
        notes="\n".join(_notes()),
        choices="\n".join(_choices(comparison.lines[0].case)),
        density=f"{mean_density(comparison.lines[0].case):,.0f}",
    )


def mean_density(case: Case) -> float:
    """Return the mass of the full vehicle over its volume [kg/m^3]."""
    body = case.vehicle
    radius = body.section(body.stations.x, 0.0).radius
    slices = np.mean(radius**2, axis=1) * np.diff(body.stations.x)
    volume = np.pi * float(np.sum(slices))
    return float(body.mass_distribution(0.0).moments(body.length)[0]) / volume


def _choices(case: Case) -> Iterator[str]:
    defaults = type(case.model)().model_dump()
    for key, value in case.model.model_dump().items():
        if value is not None:
            other = "" if value == defaults[key] else f"; by default {defaults[key]}"
            yield f"<li><code>{key} = {escape(str(value))}</code>{escape(other)}</li>"


def _contents() -> Iterator[str]:
    for table in TABLES:
        yield f'<a href="#table-{table.number}">Table {table.number}</a>'


def _mathematical(text: str) -> str:
    """Return text as HTML, with Greek letters for their names and lowered indices."""
    text = escape(text, quote=False)
    for word, sign in (*_WORDS, *_MORE):
        text = re.sub(word, sign, text)
    return _SYMBOL.sub(r"<i>\1</i><sub>\2</sub>", text)


def _sizes(comparison: Comparison) -> Iterator[str]:
    groups = [(f"Table {t.number}", comparison.table(t.number)) for t in TABLES]
    groups += [("fitted rows", comparison.fitted), ("held-out rows", comparison.held_out)]
    for name, lines in [*groups, ("all rows", comparison.lines)]:
        yield _size_row(name, str(len(lines)), size_of(lines).worst, size_of(lines).rms)
    ok = "kept" if comparison.within_bounds else "broken"
    met = "met" if within(comparison.overall, comparison.target) else "not met"
    bounds, target = comparison.bounds, comparison.target
    yield _size_row(f"bound that ships with the vehicle: {ok}", "", bounds.worst, bounds.rms)
    yield _size_row(f"target: {met}", "", target.worst, target.rms)


def _size_row(name: str, rows: str, worst: float, rms: float) -> str:
    cells = f"<td>{rows}</td><td>{worst:.2e}</td><td>{rms:.2e}</td>"
    return f'<tr><th scope="row">{name}</th>{cells}</tr>'


def _table(table: Table, lines: tuple[Line, ...]) -> str:
    modes = "".join(f'<th scope="col">bending {m}</th>' for m in range(1, MODES + 1))
    body = "\n".join(_rows(table, line) for line in lines)
    title = f"<b>Table {table.number}</b> {table.title} ({_mathematical(table.held)})"
    return f"""<div class="wide"><table id="table-{table.number}" class="modes">
<caption>{title}. Frequencies in Hz.</caption>
<thead><tr><th scope="col">{_mathematical(table.head)}</th><th></th>{modes}</tr></thead>
<tbody>
{body}
</tbody></table></div>"""


def _rows(table: Table, line: Line) -> str:
    held = line.row.held_out
    mark = '<br><span class="mark">held out</span>' if held else ""
    if suspect := MISPRINTS.get((table.number, line.row.condition[table.varies])):
        mark += f'<br><span class="mark">{suspect}</span>'
    paper = "".join(f"<td>{f:.4f}</td>" for f in line.row.frequencies_hz)
    ours = "".join(f"<td>{f:.4f}</td>" for f in line.antinode_hz)
    less = "".join(f"<td>{_percent(d)}</td>" for d in line.differences)
    style = ' class="held"' if held else ""
    head = f'<th scope="rowgroup" rowspan="3">{table.value(line.row)}{mark}</th>'
    return (
        f"<tr{style}>{head}<td>paper</td>{paper}</tr>\n"
        f"<tr{style}><td>antinode</td>{ours}</tr>\n"
        f'<tr class="less{" held" if held else ""}"><td>difference</td>{less}</tr>'
    )


def _percent(difference: float) -> str:
    return f"{100 * difference:+.3f} %".replace("-", "−")


def _figure(plate: Plate, svg: str, caption: str) -> str:
    name = f"<b>{plate.heading}</b> <em>(reconstruction).</em>"
    return (
        f'<figure id="{plate.name}">\n{svg}\n'
        f"<figcaption>{name} {_mathematical(caption)}</figcaption>\n</figure>"
    )


def read_notes() -> list[dict[str, str]]:
    """Return how the paper was read: ``where``, ``printed``, ``taken`` and ``evidence``."""
    text = files(__package__).joinpath("notes.toml").read_text(encoding="utf-8")
    notes: list[dict[str, str]] = tomllib.loads(text)["note"]
    return notes


def _notes() -> Iterator[str]:
    for note in read_notes():
        cells = "".join(
            f"<td>{_mathematical(note[key])}</td>" for key in ("printed", "taken", "evidence")
        )
        yield f'<tr><th scope="row">{escape(note["where"])}</th>{cells}</tr>'
