"""`antinode response`: what a beam does under forces and moving supports."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from antinode.cli.options import OUTPUT, Json, assignments, option

if TYPE_CHECKING:
    from antinode.response.file import Problem

ResponseSet = Annotated[
    tuple[str, ...],
    assignments(
        "response file",
        "--set damping.loss_factor=0.01, --set forces.0.x=2m",
        "; entries of a list count from 0",
    ),
]

ResultFile = Annotated[
    Path | None,
    option(
        OUTPUT,
        "Write the result to a file: .json, .csv (a table), or .uff (dataset 58).",
        "-o",
        "--output",
    ),
]
PlotFile = Annotated[Path | None, option(OUTPUT, "Draw the result: .png, .svg or .pdf.")]
ModelFile = Annotated[
    Path | None,
    option(OUTPUT, "Also write A, B, C, D of its modes to a file of MATLAB's: .mat."),
]


def response(
    file: Path,
    /,
    *,
    set_: ResponseSet = (),
    json: Json = False,
    output: ResultFile = None,
    plot: PlotFile = None,
    state_space: ModelFile = None,
) -> None:
    """Compute what equipment feels and what a structure must carry.

    The response file names a beam or a case, its damping, forces or moving supports, and what is
    asked: harmonic amplitudes, random vibration, histories, shock spectra, and the margins of
    equipment, each with its error. Exit code 3 unless all equipment is within what it is qualified
    for, its margin's error included.

    - Example: **antinode response response.toml**
    - Example: **antinode response response.toml --plot response.png**
    - Example: **antinode response response.toml --set damping.loss_factor=0.005 --json**

    Parameters
    ----------
    file
        A response file in TOML. 'antinode init --example response' writes one with its beam.
    """
    from antinode.response.file import load_response
    from antinode.response.solve import solve_one_response
    from antinode.show.outcome import check_plot, draw, print_json, say_written

    check_plot(plot)
    if output:
        from antinode.exchange.responses import check_response_output, write_response

        check_response_output(output)
    problem = load_response(file, set_)
    if state_space:
        _write_state_space(problem, state_space)
    result = solve_one_response(problem)
    if output:
        write_response(output, result)
        say_written(output)
    if plot:
        from antinode.show.response_figures import plot_response

        draw(plot_response(result), plot)
    if json:
        print_json(result.to_dict())
    else:
        from antinode.show.printing import console
        from antinode.show.response_table import show_response

        show_response(console(), result)
    if not getattr(result, "passed", True):
        sys.exit(3)


def _write_state_space(problem: Problem, path: Path) -> None:
    """Write the modes of a problem as a model in time."""
    from antinode.response.state_space import state_space
    from antinode.show.outcome import say_written
    from antinode.show.writing import check_output, write_whole

    check_output(path, (".mat",))
    file = problem.file
    modes = file.response.modes or 10
    model = state_space(problem.beam, file.drives, file.outputs, modes, damping=problem.damping)
    write_whole(path, model.write_mat)
    say_written(path)
