"""What `antinode sensitivity` does: read, sample, print, draw."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from antinode.beam.file import TABLES
from antinode.errors import InputError
from antinode.inputs.reading import read_toml
from antinode.show.outcome import check_plot, draw, print_json
from antinode.show.printing import fitting, new_table, show_left_out, show_warnings
from antinode.study.design.file import Study, StudyInput
from antinode.study.design.loading import load_study, load_subject
from antinode.study.progress import cases_progress, end_progress
from antinode.study.sweep.report import by_shear, warning_texts
from antinode.text import counted, short

from .sensitivity import ModeSensitivity, NumberSensitivity, SensitivityResult, sensitivity

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHOWN = 6


def run_sensitivity(
    file: Path,
    assignments: Iterable[str],
    uncertain: Sequence[str],
    *,
    samples: int | None,
    workers: int | None,
    scheduler: str | None,
    store: Path | None,
    overwrite: bool,
    plot: Path | None,
    json: bool,
) -> None:
    """Compute sensitivities, and give the result out."""
    check_plot(plot)
    if scheduler is not None and workers is not None:
        raise InputError("--workers and --scheduler contradict: give one of them")
    study = read_uncertain(file, assignments, uncertain)
    try:
        result = sensitivity(
            study,
            samples,
            workers=workers or 1,
            scheduler=scheduler,
            store=store,
            overwrite=overwrite,
            progress=cases_progress(),
        )
    finally:
        end_progress()
    if plot:
        draw(tornado(result), plot)
    if json:
        print_json(result.to_dict())
    else:
        from antinode.show.printing import console

        show_sensitivity(console(), result)


def read_uncertain(file: Path, assignments: Iterable[str], uncertain: Sequence[str]) -> Study:
    """Read a study file; or a case or a beam file, whose uncertain inputs are given one by one."""
    inputs = tuple(_uncertain_input(text) for text in uncertain)
    if file.suffix.lower() in TABLES or {"vehicle", "beam"} & set(read_toml(file)):
        if not inputs:
            raise InputError(
                f"{file}: this is a case, or a beam; say what is uncertain, e.g. --uncertain "
                "speed=2%, or name a study file"
            )
        return Study(case=load_subject(file, assignments), inputs=inputs)
    study = load_study(file, assignments)
    return study.model_copy(update={"inputs": (*study.inputs, *inputs)})


def _uncertain_input(text: str) -> StudyInput:
    """Read ``thrust=5%`` or ``thrust=2kN``: a normal distribution about the case's value."""
    key, equals, size = (part.strip() for part in text.partition("="))
    if not equals or not key or not size:
        raise InputError(
            f"--uncertain {short(text)}: write an input and its standard deviation, "
            "e.g. speed=2% or thrust=3kN"
        )
    if not size.endswith("%"):
        return StudyInput(key=key, distribution="normal", sd=size)
    try:
        share = float(size[:-1]) / 100
    except ValueError:
        raise InputError(f"--uncertain {short(text)}: '{size[:20]}' is no number") from None
    return StudyInput(key=key, distribution="normal", sd=share, factor=True)


def show_sensitivity(out: Console, result: SensitivityResult) -> None:
    """Print bands, then the inputs that matter for each mode."""
    out.print(
        f"[bold]{result.name}[/bold]: {counted(result.samples, 'sample')}, "
        f"{counted(result.cases, 'case')}, {result.failed} failed",
        highlight=False,
    )
    out.print(fitting((_bands(result, kept) for kept in _BANDS_KEPT), out))
    out.print(fitting((_indices(result, kept) for kept in _INDICES_KEPT), out))
    if result.responses:
        out.print(fitting((_number_bands(result, kept) for kept in _NUMBER_BANDS_KEPT), out))
        out.print(fitting((_number_indices(result, kept) for kept in _INDICES_KEPT), out))
    show_warnings(out, warning_texts(result.warnings, result.cases))
    show_left_out(out, result.not_modelled)


_BANDS = ("mode", "nominal [Hz]", "mean [Hz]", "sd [Hz]", "95 % from", "to", "by shear")
_BANDS_KEPT = (range(7), (0, 2, 3, 4, 5, 6), (0, 2, 3, 6))
_INDICES = ("mode", "input", "total index", "+-", "first index", "+-", "% per %")
_INDICES_KEPT = (range(7), (0, 1, 2, 3, 4, 6), (0, 1, 2, 3))
"""Columns that narrower terminals keep."""


def _bands(result: SensitivityResult, kept: Sequence[int]) -> Table:
    table = new_table(*(_BANDS[k] for k in kept))
    for m in result.modes:
        numbers = (f"{v:.5g}" for v in (m.nominal, m.mean, m.sd, *m.band))
        cells = (m.name, *numbers, by_shear(m.model_error, m.effect_of_shear))
        table.add_row(*(cells[k] for k in kept))
    return table


_NUMBER_BANDS = ("response", "nominal", "mean", "sd", "95 % from", "to", "unit", "+-")
_NUMBER_BANDS_KEPT = (range(8), (0, 2, 3, 4, 5, 6, 7), (0, 2, 3, 6))


def _number_bands(result: SensitivityResult, kept: Sequence[int]) -> Table:
    left = tuple(k for k, column in enumerate(kept) if column in (0, 6))
    table = new_table(*(_NUMBER_BANDS[k] for k in kept), left=left)
    for r in result.responses:
        numbers = (f"{v:.5g}" for v in (r.nominal, r.mean, r.sd, *r.band))
        error = f"{r.error:.1e}" if np.isfinite(r.error) else ""
        cells = (r.label, *numbers, r.unit, error)
        table.add_row(*(Text(cells[k]) for k in kept))
    return table


def _indices(result: SensitivityResult, kept: Sequence[int]) -> Table:
    return _indices_of("mode", "% per %", [(m.name, m) for m in result.modes], result, kept)


def _number_indices(result: SensitivityResult, kept: Sequence[int]) -> Table:
    rows = [(r.label, r) for r in result.responses]
    return _indices_of("response", "% (dB) per %", rows, result, kept)


def _indices_of(
    first: str,
    last: str,
    rows: Sequence[tuple[str, ModeSensitivity | NumberSensitivity]],
    result: SensitivityResult,
    kept: Sequence[int],
) -> Table:
    left = tuple(k for k, column in enumerate(kept) if column < 2)
    heads = (first, *_INDICES[1:-1], last)
    table = new_table(*(heads[k] for k in kept), left=left)
    for name, m in rows:
        order = np.argsort(-np.nan_to_num(m.indices.total))[:_SHOWN]
        for number, k in enumerate(order.tolist()):
            halves = [np.ptp(b[k]) / 2 for b in (m.indices.total_band, m.indices.first_band)]
            indices = (m.indices.total[k], halves[0], m.indices.first[k], halves[1])
            cells: tuple[str | Text, ...] = (
                Text(name if number == 0 else ""),
                Text(result.inputs[k]),
                *(f"{v:.3f}" for v in indices),
                f"{m.elasticity[k]:+.4f}" if np.isfinite(m.elasticity[k]) else "",
            )
            table.add_row(*(cells[column] for column in kept))
    return table


def tornado(result: SensitivityResult) -> Figure:
    """Draw the total and first indices of every mode, largest inputs on top."""
    from antinode.show.figures import PALETTE, STYLE, pyplot

    plt, modes = pyplot(), result.modes[:6]
    rows = -(-len(modes) // 2)
    with plt.rc_context(STYLE):
        figure: Figure
        figure, panels = plt.subplots(
            rows, min(2, len(modes)), squeeze=False, layout="constrained", sharex=True,
            figsize=(8.4, rows * (0.9 + 0.3 * min(len(result.inputs), 8))),
        )  # fmt: skip
        for m, axes in zip(modes, panels.ravel(), strict=False):
            order = np.argsort(np.nan_to_num(m.indices.total))[-8:]
            y = np.arange(len(order))
            total, band = m.indices.total[order], m.indices.total_band[order]
            error = np.abs(band.T - total)
            axes.barh(y, total, 0.7, color=PALETTE[5], label="total")
            axes.barh(y, m.indices.first[order], 0.35, color=PALETTE[0], label="first order")
            axes.errorbar(total, y, xerr=error, fmt="none", ecolor="#374151", linewidth=1)
            names = [result.inputs[k].replace("_", " ").replace(":", ", ") for k in order]
            axes.set_yticks(y, names)
            axes.set_title(f"{m.name}: {m.mean:.4g} Hz, sd {m.sd:.2g} Hz", loc="left")
            axes.grid(visible=False, axis="y")
        for axes in panels.ravel()[len(modes) :]:
            axes.set_visible(False)
        for axes in panels[-1]:
            axes.set_xlabel("Sobol index: share of the variance")
        panels[0, -1].legend(loc="lower right")
    return figure
