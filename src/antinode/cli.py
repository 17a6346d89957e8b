"""The command line: `antinode COMMAND --help` shows an example under every command."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import App, CycloptsError, Group, Parameter

from . import __version__
from .errors import AntinodeError, InputError

if TYPE_CHECKING:
    from .buckling import Buckling
    from .case import Case
    from .result import ModalResult

app = App(
    name="antinode",
    version=__version__,
    help_format="markdown",
    help="""Natural frequencies and modes of slender vehicles in motion, and of any beam.

Start with **antinode init** and **antinode modes case.toml**, or with **antinode init --beam** and
**antinode beam beam.toml**.
""",
)
_output = Group("Output")
_solver = Group("Solver")

Set = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        help="Override an input, e.g. --set condition.speed=100m/s (repeatable).",
        negative="",
        show_default=False,
    ),
]
Json = Annotated[
    bool,
    Parameter(
        name="--json",
        help="Print one JSON object.",
        negative="",
        show_default=False,
        group=_output,
    ),
]
Out = Annotated[
    Path | None,
    Parameter(name=["-o", "--output"], help="Write the result: .csv, .json or .nc.", group=_output),
]
Plot = Annotated[
    Path | None,
    Parameter(name="--plot", help="Draw the result: .png, .svg or .pdf.", group=_output),
]
Modes = Annotated[
    int | None,
    Parameter(name="--modes", help="Elastic modes 1 ... n of each family.", group=_solver),
]
Tolerance = Annotated[
    float | None,
    Parameter(
        name="--tolerance",
        help="Largest relative error of a frequency by what varies inside segments.",
        group=_solver,
    ),
]
Method = Annotated[
    Literal["riccati", "tmm"],
    Parameter(
        name="--method",
        help="riccati, certified; or tmm, the transfer matrix scan, for comparison.",
        group=_solver,
    ),
]
Shapes = Annotated[
    Literal["amplitude", "mass"],
    Parameter(
        name="--shapes",
        help="Scale shapes to largest displacement 1, or unit modal mass.",
        group=_solver,
    ),
]


@app.command
def modes(
    case: Path,
    /,
    *,
    set_: Set = (),
    json: Json = False,
    output: Out = None,
    plot: Plot = None,
    modes: Modes = None,
    tolerance: Tolerance = None,
    method: Method = "riccati",
    shapes: Shapes = "amplitude",
) -> None:
    """Compute frequencies and modes of a vehicle in a condition: the main job.

    Example: **antinode modes case.toml --set condition.speed=100m/s --plot modes.png**

    Parameters
    ----------
    case
        A case file; 'antinode init' writes one.
    """
    _check_outputs(output, plot)
    from .case import load_case

    problem = load_case(case, set_)
    result = _solve(problem, problem.solve, modes, tolerance, method, shapes)
    data = {**result.to_dict(), "condition": _condition_dict(problem)}
    data["warnings"] = [*problem.loads.warnings, *data["warnings"]]
    if plot:
        from .figures import plot_case, save

        save(plot_case(problem, result), plot)
    _write(output, data, result)
    if json:
        _print_json(data)
        return
    from .printing import console, show_condition, show_modes, show_warnings

    out = console()
    show_condition(out, problem)
    show_modes(out, result)
    show_warnings(out, problem.loads.warnings)
    _say_written(output, plot)


@app.command
def beam(
    file: Path,
    /,
    *,
    set_: Set = (),
    json: Json = False,
    output: Out = None,
    plot: Plot = None,
    modes: Modes = None,
    tolerance: Tolerance = None,
    method: Method = "riccati",
    shapes: Shapes = "amplitude",
    buckling: Annotated[
        bool,
        Parameter(
            help="Also find the factor on the axial force at which the beam buckles.",
            negative="",
            show_default=False,
            group=_solver,
        ),
    ] = False,
) -> None:
    """Compute frequencies and modes of any beam, with no vehicle at all.

    Example: **antinode beam beam.toml --set beam.ends.left=pinned --plot beam.svg**

    Parameters
    ----------
    file
        A beam file; 'antinode init --beam' writes one.
    """
    _check_outputs(output, plot)
    from .beam_file import load_beam

    problem = load_beam(file, set_)
    result = _solve(problem, problem.solve, modes, tolerance, method, shapes)
    data = result.to_dict()
    critical = _buckling(result) if buckling else None
    if buckling:
        data["buckling"] = critical.to_dict() if critical else None
    if plot:
        from .figures import plot_modes, save

        save(plot_modes(result), plot)
    _write(output, data, result)
    if json:
        _print_json(data)
        return
    from .printing import console, show_beam, show_buckling, show_modes

    out = console()
    show_beam(out, result.beam)
    if buckling:
        show_buckling(out, critical)
    show_modes(out, result)
    _say_written(output, plot)


@app.command
def loads(
    case: Path,
    /,
    *,
    set_: Set = (),
    json: Json = False,
    output: Out = None,
    plot: Plot = None,
) -> None:
    """Compute the cavity, the forces, the accelerations and N, Q, M along the vehicle.

    Example: **antinode loads case.toml --set condition.cavitation_number=0.025 -o loads.csv**

    Parameters
    ----------
    case
        A case file; 'antinode init' writes one.
    """
    _check_outputs(output, plot)
    from .case import load_case
    from .loads_table import loads_csv, loads_dataset, loads_dict

    problem = load_case(case, set_)
    data = {**loads_dict(problem), "condition": _condition_dict(problem)}
    if plot:
        from .figures import plot_loads, save

        save(plot_loads(problem), plot)
    if output:
        from .dataset import write_result

        write_result(output, data, lambda: loads_csv(problem), lambda: loads_dataset(problem))
    if json:
        _print_json(data)
        return
    from .printing import console, show_loads

    show_loads(console(), problem)
    _say_written(output, plot)


@app.command
def init(
    folder: Path = Path(),
    /,
    *,
    beam: Annotated[bool, Parameter(help="Write a beam file instead.", negative="")] = False,
    example: Annotated[str | None, Parameter(help="Name of another example.")] = None,
) -> None:
    """Write a commented, runnable case; never overwrite a file.

    Example: **antinode init && antinode modes case.toml**

    Parameters
    ----------
    folder
        Where to write; it is made if it does not exist.
    """
    from .examples import write_example

    name = example or ("beam" if beam else "starter")
    written, command = write_example(name, folder)
    print("wrote " + ", ".join(str(path) for path in written))
    print(f"next: {command}")


@app.command
def schema(of: str = "case", /) -> None:
    """Print the JSON schema of an input file, every key with its unit and range.

    Example: **antinode schema case**

    Parameters
    ----------
    of
        case or beam.
    """
    from .beam_file import BeamFile
    from .case import Case

    models: dict[str, Any] = {"case": Case, "beam": BeamFile}
    if of not in models:
        raise InputError(f"there is no schema '{of}'; allowed are {', '.join(models)}")
    _print_json(models[of].model_json_schema())


@app.command
def verify(*, json: Json = False) -> None:
    """Check this installation against closed forms, in seconds.

    Example: **antinode verify**
    """
    from .verify import ALLOWED, run_checks

    checks = run_checks()
    failed = [check for check in checks if not check.passed]
    if json:
        rows = [
            {
                "name": c.name,
                "formula": c.formula,
                "modes": c.modes,
                "worst_relative_error": c.worst,
                "passed": c.passed,
            }
            for c in checks
        ]
        _print_json({"schema_version": 1, "allowed": ALLOWED, "checks": rows})
    else:
        from .printing import checks_table, console

        out = console()
        out.print(checks_table(checks))
        verdict = f"{len(failed)} of {len(checks)} checks failed" if failed else "all checks passed"
        out.print(f"{verdict} (allowed relative error of a frequency {ALLOWED:g})", highlight=False)
    if failed:
        sys.exit(1)


def _solve(
    problem: Any,
    settings: Any,
    modes: int | None,
    tolerance: float | None,
    method: Any,
    shapes: Any,
) -> ModalResult:
    from .modes import solve_modes

    return solve_modes(
        problem,
        settings.modes if modes is None else modes,
        tolerance=settings.tolerance if tolerance is None else tolerance,
        method=method,
        normalisation=shapes,
        unloaded=True,
    )


def _buckling(result: ModalResult) -> Buckling | None:
    from .buckling import buckling

    return buckling(result.beam, result.tolerance)


def _condition_dict(case: Case) -> dict[str, Any]:
    """Return the condition with its units in the keys."""
    units = {
        "speed": "m_per_s",
        "depth": "m",
        "cavity_pressure": "Pa",
        "cavitator_angle": "rad",
        "body_angle": "rad",
        "fin_position": "m",
        "thrust": "N",
    }
    values = case.condition.model_dump()
    named = {f"{key}_{units[key]}" if key in units else key: v for key, v in values.items()}
    return {**named, "cavitation_number": case.loads.sigma}


def _check_outputs(output: Path | None, plot: Path | None) -> None:
    """Refuse what cannot be written before any work is done."""
    if output:
        from .dataset import check_output

        check_output(output, (".csv", ".json", ".nc"))
    if plot:
        from .figures import check_plot

        check_plot(plot)


def _write(output: Path | None, data: dict[str, Any], result: ModalResult) -> None:
    if output:
        from .dataset import modal_table, write_result

        write_result(output, data, lambda: modal_table(result), result.to_dataset)


def _print_json(data: dict[str, Any]) -> None:
    from .dataset import to_json

    print(to_json(data))


def _say_written(*paths: Path | None) -> None:
    for path in paths:
        if path:
            print(f"wrote {path}", file=sys.stderr)


def main() -> None:
    """Run the command line; end with 0 done, 1 the computation failed, 2 the input was wrong."""
    try:
        app(print_error=False, exit_on_error=False, result_action="return_none")
    except CycloptsError as error:
        _fail(f"{_one_line(str(error))} See 'antinode --help'.", 2)
    except AntinodeError as error:
        _fail(_one_line(str(error)), error.exit_code)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _fail(sentence: str, code: int) -> None:
    print(f"antinode: {sentence}", file=sys.stderr)
    sys.exit(code)
