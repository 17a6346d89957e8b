"""What `antinode stability` does with inputs: along one, or over two."""

from __future__ import annotations

from pathlib import Path

from antinode.errors import InputError
from antinode.show.outcome import draw, print_json, say_written
from antinode.show.writing import to_json, write_text
from antinode.study.design.loading import load_subject
from antinode.study.progress import cases_progress

from .along import Range, loci_along, stability_along, stability_map
from .inputs import Problem, parse_line
from .result import Along, StabilityMap


def run_along(
    file: Path,
    assignments: tuple[str, ...],
    largest: float | None,
    *,
    along: str | None,
    map: str | None,
    points: int | None,
    rows: int,
    damping: str,
    json: bool,
    output: Path | None,
    plot: Path | None,
) -> None:
    """Find changes of stability along an input, or over a second one, and tell them."""
    if along and largest is not None:
        raise InputError("--to is for the load factor; the range of --along stands with it")
    problem = load_subject(file, assignments)
    first = parse_line(along, "--along") if along else None
    dampers = damping != "none"
    if map:
        _map(problem, first, map, largest, points, rows, dampers, json, output, plot)
        return
    assert first is not None
    key, low, high = first
    result = stability_along(problem, key, low, high, points=points, dampers=dampers)
    from antinode.show.stability import along_csv, show_along

    _written(result, output, along_csv(result))
    if plot:
        from antinode.show.stability_figures import plot_loci

        draw(plot_loci(loci_along(result)), plot)
    if json:
        print_json(result.to_dict())
        return
    from antinode.show.printing import console

    show_along(console(), result)


def _map(
    problem: Problem,
    first: Range | None,
    over: str,
    largest: float | None,
    points: int | None,
    rows: int,
    dampers: bool,
    json: bool,
    output: Path | None,
    plot: Path | None,
) -> None:
    result = stability_map(
        problem,
        first,
        parse_line(over, "--map"),
        rows=rows,
        dampers=dampers,
        largest=largest,
        points=points,
        progress=cases_progress(),
    )
    from antinode.show.stability import map_csv, show_map

    _written(result, output, map_csv(result))
    if plot:
        from antinode.show.stability_figures import plot_map

        line = result.line
        label = "factor on all axial forces" if line is None else str(line)
        top = (0.0, float("inf")) if line is None else (line.low, line.high)
        boundaries = {kind: result.boundary(kind) for kind in ("flutter", "divergence")}
        draw(plot_map(result.values, boundaries, (str(result.over), label), top), plot)
    if json:
        print_json(result.to_dict())
        return
    from antinode.show.printing import console

    show_map(console(), result)


def _written(result: Along | StabilityMap, path: Path | None, csv: str) -> None:
    if path is None:
        return
    plain = path.suffix.lower() == ".json"
    write_text(path, to_json(result.to_dict()) + "\n" if plain else csv)
    say_written(path)
