"""`antinode modes`: frequencies and modes of a vehicle in a condition."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.modal import check_modal_output, draw_effects, solve, write_modes
from antinode.cli.options import Effects, Output, Set, Solver
from antinode.show.outcome import draw

_SOLVER, _OUTPUT = Solver(), Output()


def modes(
    case: Path,
    /,
    *,
    set_: Set = (),
    solver: Solver = _SOLVER,
    effects: Effects = None,
    output: Output = _OUTPUT,
) -> None:
    """Compute frequencies and modes of a vehicle in a condition: the main job.

    From the condition follow the cavity, the forces and the axial force N(x), positive in
    compression; under it the body vibrates as a free-free beam. Frequencies are in Hz, each with a
    bound on its error.

    - Example: **antinode modes case.toml**
    - Example: **antinode modes case.toml --set condition.speed=100m/s --plot modes.png**
    - Example: **antinode modes case.toml --modes 10 --json**
    - Example: **antinode modes case.toml --effects effects.png**

    Parameters
    ----------
    case
        A case file: vehicle and condition in TOML. 'antinode init' writes one.
    """
    check_modal_output(output, effects)
    from antinode.vehicle.case import load_case

    problem = load_case(case, set_)
    result = solve(problem, solver)
    if output.plot:
        from antinode.show.figures import plot_case

        draw(plot_case(problem, result), output.plot)
    draw_effects(result, effects)
    if output.file or output.json:
        from antinode.show.loads_table import modes_dict

        write_modes(output, result, lambda: modes_dict(problem, result))
    if not output.json:
        from antinode.show.printing import (
            console,
            show_condition,
            show_end_forces,
            show_modes,
            show_water,
        )
        from antinode.vehicle.end_forces import compare_end_forces

        def beside() -> None:
            show_end_forces(out, compare_end_forces(problem, result))
            show_water(out, problem, result)

        out = console()
        show_condition(out, problem)
        show_modes(out, result, problem.loads.warnings, beside=beside)
