"""`antinode loads`: cavity, forces, N, Q and M of a vehicle in a condition."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.options import Output, Set
from antinode.show.outcome import check_plot, draw, print_json, say_written

_OUTPUT = Output()


def loads(case: Path, /, *, set_: Set = (), output: Output = _OUTPUT) -> None:
    """Compute the cavity, the forces, the accelerations and N, Q, M along the vehicle.

    Axial force N is positive in compression, shear force Q up on the part ahead, bending moment
    M = EI Y''. What is outside the range of a correlation is marked.

    - Example: **antinode loads case.toml**
    - Example: **antinode loads case.toml --set condition.cavitation_number=0.025 -o loads.csv**

    Parameters
    ----------
    case
        A case file: vehicle and condition in TOML. 'antinode init' writes one.
    """
    _check(output)
    from antinode.show.loads_table import condition_dict, loads_csv, loads_dataset, loads_dict
    from antinode.vehicle.case import load_case
    from antinode.vehicle.statics import static_shape

    problem = load_case(case, set_)
    shape = static_shape(problem)
    data = {**loads_dict(problem, shape), "condition": condition_dict(problem)}
    if output.plot:
        from antinode.show.figures import plot_loads

        draw(plot_loads(problem), output.plot)
    if output.file:
        from antinode.show.writing import write_result

        write_result(
            output.file,
            data,
            lambda: loads_csv(problem, shape),
            lambda: loads_dataset(problem, shape),
        )
        say_written(output.file)
    if output.json:
        print_json(data)
    else:
        from antinode.show.printing import console, show_loads

        show_loads(console(), problem, shape)


def _check(output: Output) -> None:
    """Refuse what cannot be written before any work is done."""
    if output.file:
        from antinode.show.writing import ENDINGS, check_output

        check_output(output.file, ENDINGS)
    check_plot(output.plot)
