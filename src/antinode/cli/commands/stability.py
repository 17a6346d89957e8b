"""`antinode stability`: where a beam diverges or flutters, by a factor on its axial forces."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from antinode.cli.options import OUTPUT, SOLVER, Json, assignments, option

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.stability.result import Stability

StabilitySet = Annotated[
    tuple[str, ...],
    assignments(
        "file",
        "--set beam.ends.right_follower=0.5, --set condition.speed=100m/s",
        "; entries of a list count from 0",
    ),
]
Largest = Annotated[
    float | None,
    option(
        SOLVER,
        "Largest factor; default: where four modes have lost stability, or 1000 times the first "
        "that does.",
        "--to",
    ),
]
Tolerance = Annotated[
    float,
    option(
        SOLVER,
        "Largest relative error of a factor by what varies inside segments, 1e-12 to 0.1.",
        "--tolerance",
    ),
]
ResultFile = Annotated[
    Path | None,
    option(OUTPUT, "Write the result to a file: .json, or .csv (a table).", "-o", "--output"),
]
PlotFile = Annotated[
    Path | None,
    option(
        OUTPUT, "Draw frequencies and growth against the factor (root loci): .png, .svg or .pdf."
    ),
]


def stability(
    file: Path,
    /,
    *,
    set_: StabilitySet = (),
    to: Largest = None,
    tolerance: Tolerance = 1e-9,
    json: Json = False,
    output: ResultFile = None,
    plot: PlotFile = None,
) -> None:
    """Find where a beam or a vehicle's body loses stability: divergence (buckling) and flutter.

    A factor multiplies all axial forces, from 0 upwards; stiffness, mass and springs stay. Every
    change of stability up to and including the first flutter is told, of elastic modes and of rigid
    rotations, with a bracket that is proven. Dashpots and loss factors are left out of these; with
    them the first loss of stability is told beside.

    - Example: **antinode stability beam.toml**
    - Example: **antinode stability beam.toml --set beam.ends.right_follower=0.5 --json**
    - Example: **antinode stability case.toml --to 20 --plot loci.svg**

    Parameters
    ----------
    file
        A beam file, a table of stations, or a vehicle's case.
    """
    from antinode.show.outcome import check_plot, draw, print_json, say_written
    from antinode.show.writing import check_output

    check_plot(plot)
    if output:
        check_output(output, (".json", ".csv"))
    beam = _beam_of(file, set_)
    from antinode.stability.stability import stability as find

    result = find(beam, to, tolerance=tolerance)
    if output:
        _write(result, output)
        say_written(output)
    if plot:
        from antinode.show.stability import plot_loci
        from antinode.stability.loci import root_loci

        draw(plot_loci(root_loci(beam, result)), plot)
    if json:
        print_json(result.to_dict())
        return
    from antinode.show.printing import console, show_beam
    from antinode.show.stability import show_stability

    out = console()
    show_beam(out, beam)
    show_stability(out, result, beam)


def _beam_of(file: Path, assignments: tuple[str, ...]) -> Beam:
    """Return the beam of a beam file, of a table of stations, or of a vehicle's case."""
    from antinode.beam.file import TABLES, load_beam

    if file.suffix.lower() not in TABLES:
        from antinode.inputs.reading import read_toml

        if "vehicle" in read_toml(file):
            from antinode.vehicle.case import load_case

            return load_case(file, assignments).beam()
    return load_beam(file, assignments).beam()


def _write(result: Stability, path: Path) -> None:
    """Write a result by the ending of its file."""
    from antinode.show.stability import stability_csv
    from antinode.show.writing import to_json, write_text

    json = path.suffix.lower() == ".json"
    write_text(path, to_json(result.to_dict()) + "\n" if json else stability_csv(result))
