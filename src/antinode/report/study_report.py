"""The report on a study: what varies, tracked frequencies, failures, and Sobol indices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.beam.file import BeamFile
from antinode.study.design.file import Study, shear_output
from antinode.study.design.points import Points, points_of
from antinode.study.sensitivity.sensitivity import SensitivityResult, sensitivity
from antinode.study.sweep.figures import plot_sweep
from antinode.study.sweep.report import by_shear, summary, warning_texts
from antinode.study.sweep.sweep import sweep
from antinode.text import counted
from antinode.vehicle.case import Case

from .blocks import Block, Document, Section, paragraph, runs, table, warnings
from .inputs import beam_inputs, case_inputs
from .modal_sections import drawn
from .numbers import number, percent
from .provenance import Source, provenance_section, today
from .vehicle_report import facts, warned, warnings_section
from .words import method_section

if TYPE_CHECKING:
    import xarray

_MOST_ROWS = 25
_SAMPLED = ("random", "latin_hypercube", "sobol", "saltelli")
_MOST_SAMPLES = 512  # of each arrangement for the indices


def study_report(study: Study, source: Source, command: str) -> tuple[Document, list[str]]:
    """Return the document on a study, which is solved here, and its warnings."""
    points, data = points_of(study), sweep(study)
    found = summary(points, data)
    told = [
        f"{counted(each['cases'], 'case')} failed: {each['text'] or each['reason']}"
        for each in found["failures"]
    ]
    told += warning_texts(found["warnings"], points.cases)
    uncertainty, left_out = _uncertainty(study)
    sections = [
        method_section(
            study.solve.families,
            vehicle=isinstance(study.case, Case),
            sheared=shear_output(study.case) == "effect_of_shear",
        ),
        Section("The study", tuple(_study(study, found))),
        *_inputs(study.case),
        Section("Frequencies", tuple(_frequencies(study, points, data, found))),
        *uncertainty,
        warnings_section([*told, *left_out]),
        provenance_section(source, _run_facts(study, found), command),
    ]
    document = Document(
        title=f"Natural vibration of {study.subject.name}: a study",
        subtitle=study.name or counted(points.cases, "case"),
        facts=facts(source),
        brief=tuple(map(runs, _brief(found, [*told, *left_out]))),
        sections=tuple(sections),
        date=today(),
    )
    return document, [*told, *left_out]


def _inputs(case: Case | BeamFile) -> list[Section]:
    """Return what the study does not vary."""
    if isinstance(case, Case):
        return [Section("The case that varies", ()), *case_inputs(case)[1:]]
    (inputs,) = beam_inputs(case, case.beam())
    return [replace(inputs, title="The beam that varies")]


def _brief(found: dict[str, Any], told: list[str]) -> list[str]:
    inputs = ", ".join(each["name"].replace("_", " ") for each in found["inputs"])
    ranges = [
        f"{each['name']} from {number(each['least_hz'])} to {number(each['largest_hz'])} Hz"
        for each in found["modes"][:3]
    ]
    return [
        f"{counted(found['cases'], 'case')} over {inputs}; {found['failed']} failed, "
        f"{found['past_buckling']} past buckling.",
        "; ".join(ranges)[:1].upper() + "; ".join(ranges)[1:] + "." if ranges else "",
        warned(told),
    ]


def _study(study: Study, found: dict[str, Any]) -> Iterator[Block]:
    yield paragraph(f"Design: {_DESIGNS[study.design.kind]}, {counted(found['cases'], 'case')}.")
    rows = [
        (f"`{each['key']}`", number(each["least"]), number(each["largest"]), each["unit"] or "-")
        for each in found["inputs"]
    ]
    head = ("input", "from", "to", "unit")
    yield table("What varies; all else is the case's.", head, rows, left=(0, 3))


_DESIGNS = {
    "grid": "every combination of the values",
    "zip": "the values side by side, as in a table or a history",
    "random": "random samples",
    "latin_hypercube": "a Latin hypercube",
    "sobol": "a Sobol sequence",
    "saltelli": "samples in Saltelli's arrangement",
}


def _frequencies(
    study: Study, points: Points, data: xarray.Dataset, found: dict[str, Any]
) -> Iterator[Block]:
    if "frequency_hz" not in data:
        yield paragraph("The study keeps no frequencies: they are not among its outputs.")
        return
    tracked = "tracked_frequency_hz" in data
    how = "Modes are followed from case to case by their shapes (MAC)." if tracked else ""
    yield drawn("sweep", plot_sweep(study, data), f"Frequencies over the study. {how}".strip())
    yield _ranges(found["modes"])
    if study.design.kind not in _SAMPLED:
        yield _cases(points, data, "tracked_frequency_hz" if tracked else "frequency_hz")


def _ranges(modes: list[dict[str, Any]]) -> Block:
    """Return the frequencies' ranges, with both errors beside them."""
    head = ("mode", "cases", "least [Hz]", "mean [Hz]", "largest [Hz]", "± error [Hz]", _SHEAR)
    rows = [
        [
            each["name"],
            str(each["cases"]),
            *(_number(each[key], 6) for key in ("least_hz", "mean_hz", "largest_hz")),
            _number(each["largest_error_hz"], 2),
            _shear(each["largest_model_error"], each["largest_effect_of_shear"]),
        ]
        for each in modes
    ]
    caption = (
        "Ranges. The error is the largest among the cases; so is what the last column tells: what "
        "shear and rotary inertia do, solved, or estimated where the theory leaves them out."
    )
    return table(caption, head, rows)


_SHEAR = "shear, rot. inertia"


def _number(value: float | None, digits: int) -> str:
    return "–" if value is None else number(value, digits)


def _shear(estimated: float | None, solved: float | None) -> str:
    return by_shear(estimated, solved).replace("-", "−") or "–"


def _cases(points: Points, data: xarray.Dataset, quantity: str) -> Block:
    """Return the frequencies of all cases, or of evenly chosen ones."""
    count = points.cases
    chosen = np.unique(np.linspace(0, count - 1, min(count, _MOST_ROWS)).round().astype(int))
    inputs = [(v.name, v.unit) for v in points.variables][:3]
    names = [str(name) for name in data["mode"].values][:6]
    marked = np.flatnonzero(np.asarray(data["reason"][chosen]) != 0).tolist()
    head = ["case", *(_headed(*each) for each in inputs), *(f"{name} [Hz]" for name in names)]
    hz = np.asarray(data[quantity][chosen])
    rows = []
    for k, case in enumerate(chosen.tolist()):
        given = [number(float(data[name][case])) for name, _ in inputs]
        rows.append([str(case), *given, *(number(float(v), 6) for v in hz[k, : len(names)])])
    caption = "Tracked frequencies" if quantity.startswith("tracked") else "Frequencies"
    if len(chosen) < count:
        caption += f", {len(chosen)} of {count} cases"
    if marked:
        caption += "; marked are those past buckling or without an answer"
    return table(f"{caption}.", head, rows, left=(), marked=marked)


def _headed(name: str, unit: str) -> str:
    return f"{name.replace('_', ' ')} [{unit or '-'}]"


def _uncertainty(study: Study) -> tuple[list[Section], list[str]]:
    """Return the section on Sobol indices of a study whose inputs are sampled, and its warnings."""
    if study.design.kind not in _SAMPLED:
        return [], []
    result = sensitivity(study, min(study.design.number or _MOST_SAMPLES, _MOST_SAMPLES))
    told = warning_texts(result.left_out, result.cases)
    blocks = [*_index_blocks(result), *([warnings(told)] if told else [])]
    return [Section("Uncertainty and its causes", tuple(blocks))], told


def _index_blocks(result: SensitivityResult) -> Iterator[Block]:
    yield paragraph(
        f"From {counted(result.samples, 'sample')} in Saltelli's arrangement "
        f"({counted(result.cases, 'case')}, {result.failed} failed). A total index is the share "
        "of the variance of a frequency that an input has a part in, a first-order index the share "
        "that it makes alone; ± is half the 95 % interval. The last column is the local "
        "derivative at the case itself, percent for one percent."
    )
    bands = [
        [
            m.name,
            *(number(v, 5) for v in (m.nominal, m.mean, m.sd, *m.band)),
            _shear(m.model_error, m.effect_of_shear),
        ]
        for m in result.modes
    ]
    head = ("mode", "the case [Hz]", "mean [Hz]", "sd [Hz]", "95 % from", "to", _SHEAR)
    yield table("Frequencies over the distributions of the inputs.", head, bands)
    rows = [row for m in result.modes for row in _index_rows(result, m)]
    yield table("Sobol indices.", _INDEX_HEAD, rows, left=(0, 1))


_INDEX_HEAD = ("mode", "input", "total", "±", "first", "±", "% per %")


def _index_rows(result: SensitivityResult, mode: Any) -> Iterator[list[str]]:
    for place, k in enumerate(np.argsort(-np.nan_to_num(mode.indices.total)).tolist()):
        i = mode.indices
        halves = [float(np.ptp(band[k])) / 2 for band in (i.total_band, i.first_band)]
        yield [
            "" if place else mode.name,
            result.inputs[k].replace("_", " "),
            f"{i.total[k]:.3f}",
            f"{halves[0]:.3f}",
            f"{i.first[k]:.3f}".replace("-", "−"),
            f"{halves[1]:.3f}",
            percent(float(mode.elasticity[k]) / 100),
        ]


def _run_facts(study: Study, found: dict[str, Any]) -> dict[str, str]:
    return {
        "method": "Riccati transfer matrices, many cases side by side",
        "tolerance": f"{number(study.solve.tolerance)} of a frequency",
        "cases": f"{found['cases']}, {found['failed']} failed",
        "seed of the samples": str(study.design.seed),
    }
