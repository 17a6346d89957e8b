"""What `antinode sweep` does: read, compute with progress, print, write, draw."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.errors import ComputationError, InputError
from antinode.show.outcome import check_plot, draw, print_json, say_written
from antinode.study.design.file import Study
from antinode.study.design.loading import load_study
from antinode.study.design.points import Points, points_of
from antinode.study.progress import cases_progress, end_progress

from .report import show_sweep, summary
from .sweep import sweep

if TYPE_CHECKING:
    import xarray

_FILES = (".nc", ".csv")
_STORES = (".zarr", "")
_SMALL = 20_000  # cases that one process solves before others have started


def run_sweep(
    file: Path,
    assignments: Iterable[str],
    *,
    output: Path | None,
    modes: int | None,
    workers: int | None,
    scheduler: str | None,
    plot: Path | None,
    overwrite: bool,
    json: bool,
) -> None:
    """Compute a study, and give the result out.

    Raises
    ------
    ComputationError
        If no case could be solved.
    """
    to_file = output is not None and output.suffix.lower() in _FILES
    check_plot(plot)
    if output and not to_file and output.suffix.lower() not in _STORES and not output.is_dir():
        raise InputError(
            f"{output}: a sweep is written as {', '.join(_FILES)}, or into a folder, a store, "
            "called .zarr or without an ending: name another"
        )
    if to_file and output:
        from antinode.show.writing import check_output

        check_output(output, _FILES)
    more = () if modes is None else (f"solve.modes={modes}",)
    study = load_study(file, (*assignments, *more))
    points = points_of(study)
    dataset = _swept(study, points, None if to_file else output, workers, scheduler, overwrite)
    data = summary(points, dataset)
    if plot:
        from .figures import plot_sweep

        draw(plot_sweep(study, dataset), plot)
    if to_file and output:
        _export(dataset, output, data)
        say_written(output)
    _print(data, f", in {output}" if output and not to_file else "", json=json)
    if data["failed"] == data["cases"]:
        worst = max(data["failures"], key=lambda f: f["cases"])
        raise ComputationError(
            f"all {data['cases']} cases failed, {worst['cases']} of them because "
            f"{worst['reason']}; check the ranges of the inputs"
        )


def _swept(
    study: Study,
    points: Points,
    store: Path | None,
    workers: int | None,
    scheduler: str | None,
    overwrite: bool,
) -> xarray.Dataset:
    if scheduler is not None and workers is not None:
        raise InputError("--workers and --scheduler contradict: give one of them")
    small = points.cases <= _SMALL or points.chunks < 3
    chosen = workers if workers is not None else 1 if small else os.cpu_count() or 1
    try:
        return sweep(
            study,
            store,
            workers=chosen,
            scheduler=scheduler,
            overwrite=overwrite,
            progress=cases_progress(),
        )
    finally:
        end_progress()


def _print(data: dict[str, Any], stored: str, *, json: bool) -> None:
    if json:
        print_json(data)
        return
    from antinode.show.printing import console

    show_sweep(console(), data, stored)


def _export(dataset: xarray.Dataset, path: Path, data: dict[str, Any]) -> None:
    """Write a Dataset to a file: .nc with everything, .csv with one row a case."""
    from antinode.show.writing import write_result

    from .tables import sweep_csv, without_lists

    write_result(path, data, lambda: sweep_csv(dataset), lambda: without_lists(dataset))
