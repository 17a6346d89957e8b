"""What the commands `modes` and `beam` share: solving, and where their results go."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.show.outcome import check_plot, draw, print_json, say_notes, say_written

from .options import Output, Solver

if TYPE_CHECKING:
    from antinode.beam.file import BeamFile
    from antinode.modes.result import ModalResult
    from antinode.vehicle.case import Case


def check_modal_output(output: Output, effects: Path | None = None) -> None:
    """Refuse what cannot be written before any work is done."""
    if output.file:
        from antinode.exchange.outputs import check_modal_output as check

        check(output.file)
    check_plot(output.plot)
    check_plot(effects)


def solve(problem: Case | BeamFile, solver: Solver) -> ModalResult:
    """Solve a problem, by the settings of its file but for those given on the command line."""
    from antinode.modes.solve import solve_one

    settings = problem.solve.overridden(modes=solver.modes, tolerance=solver.tolerance)
    return solve_one(
        problem,
        settings.modes,
        tolerance=settings.tolerance,
        method=solver.method,
        normalisation=solver.shapes,
        unloaded=True,
        damping=solver.damping,
    )


def draw_effects(result: ModalResult, path: Path | None) -> None:
    """Draw what each effect does, if that is asked for."""
    if path:
        from antinode.show.each_effect import each_effect, plot_each_effect

        draw(plot_each_effect(each_effect(result)), path)


def write_modes(output: Output, result: ModalResult, to_dict: Callable[[], dict[str, Any]]) -> None:
    """Write modes to the file, and as JSON to stdout, as asked for."""
    if not (output.file or output.json):
        return
    data = to_dict()
    if output.file:
        from antinode.exchange.outputs import Modes, write_modes

        say_notes(write_modes(output.file, Modes(result, data)))
        say_written(output.file)
    if output.json:
        print_json(data)
