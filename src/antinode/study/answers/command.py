"""What `antinode ask` does: open a store or solve a study, answer, print, draw, write."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.errors import InputError
from antinode.show.outcome import check_plot, draw, print_json, say_written
from antinode.study.design.file import Study
from antinode.study.design.loading import load_study
from antinode.study.design.points import points_of
from antinode.study.progress import cases_progress, end_progress
from antinode.study.sweep.contents import blank
from antinode.study.sweep.folder import import_store, open_store
from antinode.study.sweep.sweep import sweep
from antinode.text import short

from .answers import Answers
from .report import show_answers
from .search import Found, search

if TYPE_CHECKING:
    import xarray


def run_ask(
    file: Path,
    assignments: Iterable[str],
    *,
    where: str | None,
    define: Iterable[str],
    share: Iterable[str],
    smallest: Iterable[str],
    largest: Iterable[str],
    quantiles: Iterable[str],
    number: int,
    search: bool,
    map: str | None,
    plot: Path | None,
    output: Path | None,
    json: bool,
) -> None:
    """Answer what is asked of a store or a study.

    Raises
    ------
    InputError
        If a formula cannot be read, or the file is neither.
    """
    check_plot(plot)
    axes = _axes(map, plot)
    if not 1 <= number <= 10_000:
        raise InputError(f"--number is {number}; 1 to 10000 are allowed")
    defined = _definitions(define)
    extremes = [(text, False) for text in smallest] + [(text, True) for text in largest]
    numbers = (*(text for text, _ in extremes), *quantiles, *(axes or ()))

    def check(dataset: xarray.Dataset) -> None:
        asked = Answers(dataset, where, defined)
        for text in share:
            asked.condition(text)
        for text in numbers:
            asked.number(text)

    study, dataset = _asked(file, assignments, check, needs_study=search)
    answers = Answers(dataset, where, defined)
    data = _data(answers, where, share, quantiles, extremes, number)
    if where:
        data["asked"] = _share(Answers(dataset, None, defined), where)
    if study and search:
        data["searches"] = [
            _found(_searched(study, dataset, text, at_top, defined)) for text, at_top in extremes
        ]
    if axes and plot:
        from .figures import plot_map

        draw(plot_map(answers, *axes), plot)
    if output:
        _write(dataset, output)
    if json:
        print_json(data)
    else:
        from antinode.show.printing import console

        show_answers(console(), data)


def _data(
    answers: Answers,
    where: str | None,
    share: Iterable[str],
    quantiles: Iterable[str],
    extremes: Iterable[tuple[str, bool]],
    number: int,
) -> dict[str, Any]:
    """Return the answers as plain values."""
    return {
        "schema_version": 1,
        "name": str(answers.dataset.attrs["title"]),
        "cases": int(answers.dataset.sizes["case"]),
        "where": where,
        "asked": None,
        "shares": [_share(answers, text) for text in share],
        "quantiles": [_quantiles(answers, text) for text in quantiles],
        "worst": [_worst(answers, text, number, at_top) for text, at_top in extremes],
        "searches": [],
    }


def _asked(
    file: Path,
    assignments: Iterable[str],
    check: Callable[[xarray.Dataset], None],
    *,
    needs_study: bool,
) -> tuple[Study | None, xarray.Dataset]:
    """Return the cases of a store, or those of a study file, solved here when all is checked."""
    assignments = tuple(assignments)
    if file.is_dir():
        if assignments:
            raise InputError(f"--set changes a study file, and {file} is a store; leave it out")
        if needs_study:
            raise InputError(f"--search needs the study file, and {file} is its store; name that")
        dataset = open_store(file)
        check(dataset)
        return None, dataset
    study = load_study(file, assignments)
    import_store()
    check(blank(points_of(study)))
    try:
        return study, sweep(study, progress=cases_progress())
    finally:
        end_progress()


def _definitions(given: Iterable[str]) -> dict[str, str]:
    found = {}
    for text in given:
        name, equals, formula = text.partition("=")
        if not equals or formula.startswith("="):
            raise InputError(f"--define {short(text)}: write e.g. --define 'gap = f2 - f1'")
        found[name.strip()] = formula.strip()
    return found


def _axes(text: str | None, plot: Path | None) -> tuple[str, str, str] | None:
    if text is None:
        if plot:
            raise InputError("--plot draws what --map names, e.g. --map 'speed, thrust, f1'")
        return None
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 3 or not plot:
        raise InputError(
            "--map takes two axes and what is shown, e.g. --map 'speed, thrust, f1' --plot map.png"
        )
    return parts[0], parts[1], parts[2]


def _share(answers: Answers, text: str) -> dict[str, Any]:
    found = answers.share(text)
    return {**found._asdict(), "share": found.share}


def _quantiles(answers: Answers, text: str) -> dict[str, Any]:
    return answers.quantiles(text)._asdict()


def _worst(answers: Answers, text: str, number: int, largest: bool) -> dict[str, Any]:
    return answers.worst(text, number, largest=largest)._asdict()


def _searched(
    study: Study,
    dataset: xarray.Dataset,
    text: str,
    largest: bool,
    define: Mapping[str, str],
) -> Found:
    return search(study, dataset, text, largest=largest, define=define)


def _found(found: Found) -> dict[str, Any]:
    return found._asdict()


def _write(dataset: xarray.Dataset, path: Path) -> None:
    """Write all cases as a table: .csv, or .parquet where a library for it is installed."""
    from antinode.show.writing import check_output, write_result
    from antinode.study.sweep.tables import sweep_csv

    check_output(path, (".csv", ".parquet"))
    if path.suffix.lower() == ".csv":
        write_result(path, {}, lambda: sweep_csv(dataset), lambda: dataset)
    else:
        from .tables import write_parquet

        write_parquet(dataset, path)
    say_written(path)
