"""Studies, sensitivities and identifications in one line, and as they stand in a notebook."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from antinode.show.objects.cards import card, html_table
from antinode.show.objects.pictures import COLOURS, Picture, bars_picture
from antinode.text import counted

from .design.points import points_of
from .sweep.report import by_shear, warning_texts

if TYPE_CHECKING:
    from antinode.arrays import Array

    from .design.file import Study
    from .design.points import Points
    from .identify.file import IdentificationProblem
    from .identify.result import Identification
    from .sensitivity.sensitivity import SensitivityResult

_MOST_DOTS = 400


def study_line(study: Study) -> str:
    """Return a study in one line."""
    points = points_of(study)
    return f"<Study '{_name(study)}': {_about(study, points)}>"


def _name(study: Study) -> str:
    return study.name or study.subject.name


def _about(study: Study, points: Points) -> str:
    varied = ", ".join(v.name for v in points.variables) or "nothing varies"
    return f"{counted(points.cases, 'case')} ({study.design.kind}) over {varied}"


def study_card(study: Study) -> str:
    """Return a study as HTML: what varies, and the first cases over the first two inputs."""
    points = points_of(study)
    values = points.values(0)
    rows = [
        (v.name, v.unit or "1", f"{low:.5g}", f"{high:.5g}")
        for v, low, high in zip(points.variables, *_range(values), strict=True)
    ]
    tables = [html_table(("input", "unit", "least", "most"), rows, (0, 1))] if rows else []
    return card(_name(study), _about(study, points), _cloud(points, values), tables)


def _range(values: Array) -> tuple[Array, Array]:
    return np.min(values, axis=0), np.max(values, axis=0)


def _cloud(points: Points, values: Array) -> str:
    """Return the cases as dots, over the first input and the second."""
    if not points.variables:
        return ""
    chosen = values[:: max(1, len(values) // _MOST_DOTS)]
    x = chosen[:, 0]
    second = chosen[:, 1] if values.shape[1] > 1 else np.zeros(len(x))
    low, high = float(second.min()), float(second.max())
    words = f"{points.variables[0].name}" + (
        f", {points.variables[1].name} upwards" if values.shape[1] > 1 else ""
    )
    tall = 70.0 if high > low else 20.0
    picture = Picture((float(x.min()), float(x.max())), tall + 28, "the cases")
    for a, b in zip(x, second, strict=True):
        picture.dot(float(a), 6 + (tall - 8) * (1 - (b - low) / (high - low or 1.0)), COLOURS[0], 2)
    picture.word(picture.low, tall + 22, words)
    return str(picture)


def sensitivity_line(result: SensitivityResult) -> str:
    """Return sensitivities in one line."""
    return (
        f"<SensitivityResult '{result.name}': {counted(len(result.modes), 'mode')} by "
        f"{', '.join(result.inputs)}; {counted(result.cases, 'case')}, {result.failed} failed>"
    )


def sensitivity_card(result: SensitivityResult) -> str:
    """Return sensitivities as HTML: bands of the frequencies, and total indices of the first."""
    rows = [
        (
            *(m.name, *(f"{v:.5g}" for v in (m.nominal, m.mean, m.sd, *m.band))),
            by_shear(m.model_error, m.effect_of_shear),
        )
        for m in result.modes
    ]
    headings = ("mode", "nominal [Hz]", "mean [Hz]", "sd [Hz]", "95 % from", "to", "by shear")
    about = (
        f"{counted(result.samples, 'sample')}, {counted(result.cases, 'case')}, "
        f"{result.failed} failed"
    )
    picture = ""
    if result.modes:
        first = result.modes[0]
        order = np.argsort(-np.nan_to_num(first.indices.total))
        bars = [(result.inputs[k], float(first.indices.total[k])) for k in order.tolist()]
        picture = bars_picture(bars, f"total Sobol indices of {first.name}", "")
        about += f"; bars: total indices of {first.name}"
    told = warning_texts(result.warnings, result.cases)
    return card(result.name, about, picture, [html_table(headings, rows)], told)


def problem_line(problem: IdentificationProblem) -> str:
    """Return an identification that is not done yet in one line."""
    return f"<IdentificationProblem '{problem.subject.name}': {_asked(problem)}>"


def _asked(problem: IdentificationProblem) -> str:
    what = [
        counted(len(problem.observations), "row of observations", "rows of observations"),
        counted(len(problem.parameters), "parameter"),
        counted(len(problem.distributions), "distribution"),
    ]
    return ", ".join(what)


def problem_card(problem: IdentificationProblem) -> str:
    """Return an identification that is not done yet as HTML: what may change."""
    rows = [(p.key, "number") for p in problem.parameters]
    rows += [(d.column, "along the body") for d in problem.distributions]
    tables = [html_table(("may change", "as"), rows, (0, 1))]
    return card(problem.subject.name, _asked(problem), tables=tables)


def identification_line(result: Identification) -> str:
    """Return an identification in one line."""
    return f"<Identification '{result.name}': {_found(result)}>"


def _found(result: Identification) -> str:
    return (
        f"{counted(len(result.comparisons), 'frequency', 'frequencies')} in "
        f"{counted(len(result.problem.observations), 'row')}: rms difference "
        f"{100 * result.rms_relative:.2g} %, worst {100 * result.worst_relative:.2g} %"
        + (", interrupted" if result.interrupted else "")
    )


def identification_card(result: Identification) -> str:
    """Return an identification as HTML: how far off every frequency is, and what was found."""
    bars = [
        (f"{c.label or c.row} {c.family} {c.number}", 100 * c.relative) for c in result.comparisons
    ]
    found = [
        (
            *(p.name, p.unit or "1", f"{p.start:.5g}", f"{p.value:.6g}"),
            *(f"{p.sd:.2g}" if math.isfinite(p.sd) else "", f"{100 * p.determined:.0f} %"),
        )
        for p in result.parameters
    ]
    compared = [
        (
            *(str(c.label or c.row), f"{c.family} {c.number}", f"{c.observed_hz:.5g}"),
            *(f"{c.fitted_hz:.5g}", f"{100 * c.relative:+.2f} %"),
        )
        for c in result.comparisons
    ]
    tables = [
        html_table(("unknown", "unit", "start", "found", "sd", "determined"), found, (0, 1)),
        html_table(("row", "mode", "observed [Hz]", "fitted [Hz]", "off"), compared, (0, 1)),
    ]
    picture = bars_picture(bars, "fitted less observed", "%")
    return card(result.name, _found(result), picture, tables, result.warnings)
