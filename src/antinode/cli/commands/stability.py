"""`antinode stability`: where a beam diverges or flutters, by a factor on its axial forces."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from antinode.cli.options import INPUT, OUTPUT, SOLVER, Json, assignments, flag, option, whole
from antinode.errors import InputError

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
Influence = Annotated[
    bool,
    flag(
        SOLVER,
        "Tell as well what moves each critical factor: exact derivatives, in percent for each "
        "percent of stiffness, mass and springs.",
        "--influence",
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


@Parameter(name="*")
@dataclass(frozen=True)
class Inputs:
    """Which inputs of the file take the place of the load factor."""

    along: Annotated[
        str | None,
        option(
            INPUT,
            "Follow an input of the file, as studies name it, in place of the load factor: --along "
            "'condition.speed = 60 m/s .. 140 m/s'. A column is multiplied by a factor.",
        ),
    ] = None
    map: Annotated[
        str | None,
        option(
            INPUT,
            "Tell the critical values of --along, or of the load factor, over a second input: "
            "--map 'condition.thrust = 10 kN .. 30 kN'.",
        ),
    ] = None
    points: Annotated[
        int | None,
        whole(
            SOLVER,
            "Even values along --along at which modes are solved first; default: 33, on a map 17.",
        ),
    ] = None
    rows: Annotated[int, whole(SOLVER, "Values of the second input of --map.")] = 11
    damping: Annotated[
        Literal["auto", "none"],
        option(SOLVER, "none leaves dashpots and loss factors out along --along."),
    ] = "auto"


_INPUTS = Inputs()


def stability(
    file: Path,
    /,
    *,
    set_: StabilitySet = (),
    inputs: Inputs = _INPUTS,
    to: Largest = None,
    tolerance: Tolerance = 1e-9,
    influence: Influence = False,
    json: Json = False,
    output: ResultFile = None,
    plot: PlotFile = None,
) -> None:
    """Find where a beam or a vehicle's body loses stability: divergence (buckling) and flutter.

    A factor multiplies all axial forces, from 0 upwards; stiffness, mass and springs stay. Every
    change of stability up to and including the first flutter is told, of elastic modes and of rigid
    rotations, with a bracket that is proven. Dashpots and loss factors are left out of these; with
    them the first loss of stability is told beside.

    With **--along** any input of the file takes the place of the factor; loads, mass and stiffness
    follow it, and dashpots, feedback and loss factors count. **--map** repeats either over a second
    input.

    - Example: **antinode stability beam.toml --set beam.ends.right_follower=0.5 --json**
    - Example: **antinode stability case.toml --to 20 --plot loci.svg**
    - Example: **antinode stability case.toml --along 'condition.speed = 60 m/s .. 140 m/s'**
    - Example: **antinode stability case.toml --map 'condition.thrust = 10 kN .. 30 kN'**

    Parameters
    ----------
    file
        A beam file, a table of stations, or a vehicle's case.
    """
    from antinode.show.outcome import check_plot
    from antinode.show.writing import check_output

    check_plot(plot)
    if output:
        check_output(output, (".json", ".csv"))
    if inputs.along or inputs.map:
        from antinode.study.along.command import run_along

        run_along(file, set_, to, json=json, output=output, plot=plot, **vars(inputs))
        return
    if inputs.points is not None:
        raise InputError("--points is for --along: the steps along the load factor find themselves")
    beam = _beam_of(file, set_)
    _along_factor(beam, to, tolerance, influence, json, output, plot)


def _along_factor(
    beam: Beam,
    to: float | None,
    tolerance: float,
    influence: bool,
    json: bool,
    output: Path | None,
    plot: Path | None,
) -> None:
    """Find the critical factors of a beam, and tell them."""
    from antinode.show.outcome import draw, print_json, say_written

    result = beam.stability(to, tolerance=tolerance)
    moved = None
    if influence:
        from antinode.stability.influence import influences

        moved = influences(beam, result.critical)
    if output:
        _write(result, output)
        say_written(output)
    if plot:
        from antinode.show.stability_figures import plot_loci
        from antinode.stability.loci import root_loci

        draw(plot_loci(root_loci(beam, result)), plot)
    if json:
        data = result.to_dict()
        for row, each in zip(data["critical"], moved or (), strict=False):
            row["influence"] = None if each is None else each.to_dict()
        print_json(data)
        return
    from antinode.show.printing import console, show_beam
    from antinode.show.stability import show_influence, show_stability

    out = console()
    show_beam(out, beam)
    show_stability(out, result)
    if moved is not None:
        show_influence(out, result.critical, moved)


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
