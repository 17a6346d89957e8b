"""The commands of `antinode`: their arguments, their help and what each of them does."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from antinode.errors import ComputationError, InputError
from antinode.examples import EXAMPLES, write_example
from antinode.show.outcome import check_plot, draw, print_json, say_notes, say_written
from antinode.text import short
from antinode.version import __version__

from .options import (
    BeamSet,
    BucklingFactor,
    Exchange,
    FromFormat,
    Json,
    Output,
    ReportFile,
    ReportModes,
    ReportTolerance,
    Set,
    Solver,
    ToFormat,
)
from .study_commands import identify, sensitivity, sweep

if TYPE_CHECKING:
    from antinode.beam.file import BeamFile
    from antinode.modes.result import ModalResult
    from antinode.vehicle.case import Case

Values = Callable[[], dict[str, Any]]
app = App(
    name="antinode",
    version=__version__,
    help_format="markdown",
    suppress_keyboard_interrupt=False,
    help="""Natural frequencies and modes of slender vehicles in motion, and of any beam.

Start with **antinode init** and **antinode modes case.toml**, or with **antinode init --beam** and
**antinode beam beam.toml**.

Input files are TOML. Numbers are SI, angles in radians; a text carries its own unit: "80 mm",
"10 deg", "50 kN". Tables along the axis may be CSV files. **antinode schema** lists every key.
""",
)
_SOLVER, _OUTPUT, _EXCHANGE = Solver(), Output(), Exchange()


@app.command(sort_key=2)
def modes(
    case: Path, /, *, set_: Set = (), solver: Solver = _SOLVER, output: Output = _OUTPUT
) -> None:
    """Compute frequencies and modes of a vehicle in a condition: the main job.

    From the condition follow the cavity, the forces and the axial force N(x), positive in
    compression; under it the body vibrates as a free-free beam. Frequencies are in Hz, each with a
    bound on its error.

    - Example: **antinode modes case.toml**
    - Example: **antinode modes case.toml --set condition.speed=100m/s --plot modes.png**
    - Example: **antinode modes case.toml --modes 10 --json**

    Parameters
    ----------
    case
        A case file: vehicle and condition in TOML. 'antinode init' writes one.
    """
    _check_output(output, modal=True)
    from antinode.vehicle.case import load_case

    problem = load_case(case, set_)
    result = _solve(problem, solver)
    if output.plot:
        from antinode.show.figures import plot_case

        draw(plot_case(problem, result), output.plot)
    _write_modes(output, result, lambda: _case_dict(problem, result))
    if not output.json:
        from antinode.show.printing import console, show_condition, show_modes

        out = console()
        show_condition(out, problem)
        show_modes(out, result, problem.loads.warnings)


@app.command(sort_key=4)
def beam(
    file: Path,
    /,
    *,
    set_: BeamSet = (),
    solver: Solver = _SOLVER,
    buckling: BucklingFactor = False,
    output: Output = _OUTPUT,
) -> None:
    """Compute frequencies and modes of any beam, with no vehicle at all.

    The file gives mass, stiffness and axial force N (positive in compression) at stations, how the
    ends are held, and what is attached.

    - Example: **antinode beam beam.toml**
    - Example: **antinode beam beam.toml --set beam.ends.left=pinned --plot beam.svg**
    - Example: **antinode beam beam.toml --buckling -o beam.csv**

    Parameters
    ----------
    file
        A beam file in TOML. 'antinode init --beam' writes one.
    """
    _check_output(output, modal=True)
    from antinode.beam.file import load_beam

    result = _solve(load_beam(file, set_), solver)
    critical = None
    if buckling:
        from antinode.modes.buckling import buckling as find_factor

        critical = find_factor(result.beam, result.tolerance)
    found = {"buckling": critical.to_dict() if critical else None} if buckling else {}
    if output.plot:
        from antinode.show.figures import plot_modes

        draw(plot_modes(result), output.plot)
    _write_modes(output, result, lambda: result.to_dict() | found)
    if not output.json:
        from antinode.show.printing import console, show_beam, show_buckling, show_modes

        out = console()
        show_beam(out, result.beam)
        if buckling:
            show_buckling(out, critical)
        show_modes(out, result)


@app.command(sort_key=3)
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
    _check_output(output)
    from antinode.show.loads_table import condition_dict, loads_csv, loads_dataset, loads_dict
    from antinode.vehicle.case import load_case

    problem = load_case(case, set_)
    data = {**loads_dict(problem), "condition": condition_dict(problem)}
    if output.plot:
        from antinode.show.figures import plot_loads

        draw(plot_loads(problem), output.plot)
    if output.file:
        from antinode.show.writing import write_result

        write_result(output.file, data, lambda: loads_csv(problem), lambda: loads_dataset(problem))
        say_written(output.file)
    if output.json:
        print_json(data)
    else:
        from antinode.show.printing import console, show_loads

        show_loads(console(), problem)


@app.command(sort_key=1)
def init(
    folder: Path = Path(),
    /,
    *,
    beam: Annotated[
        bool, Parameter(help="Write a beam file instead.", negative="", show_default=False)
    ] = False,
    example: Annotated[
        str | None, Parameter(help=f"Write another example: {', '.join(EXAMPLES)}.")
    ] = None,
) -> None:
    """Write a commented, runnable case; never overwrite a file.

    - Example: **antinode init**
    - Example: **antinode init --beam my_beam**
    - Example: **antinode init --example tower my_tower**

    Parameters
    ----------
    folder
        Where to write; it is made if it does not exist.
    """
    if beam and example not in (None, "beam"):
        raise InputError(f"--beam and --example {short(example)} contradict: give one of them")
    written, command = write_example(example or ("beam" if beam else "starter"), folder)
    print("wrote " + ", ".join(str(path) for path in written))
    print(f"next: {command}")


app.command(sweep, sort_key=8)
app.command(sensitivity, sort_key=8)
app.command(identify, sort_key=8)


@app.command(sort_key=9)
def convert(
    source: Path,
    target: Path,
    /,
    *,
    from_: FromFormat = "",
    to: ToFormat = "",
    set_: BeamSet = (),
    exchange: Exchange = _EXCHANGE,
) -> None:
    """Convert a beam, or measurements, from one file format to another.

    The endings say which. Read are .toml, .csv, .xlsx, NASTRAN's .bdf and .nas, tables of sections
    of BModes and ElastoDyn in .dat, and measurements in .uff and .unv. Written are the beam as
    .toml, .csv or .xlsx, its modes as .json, .nc, .mat, .bdf, .uff or .vtu, and measurements as
    observations for **antinode identify** in .toml, .csv or .json.

    - Example: **antinode convert beam.toml beam.bdf --units mm-t-s**
    - Example: **antinode convert tower.dat tower.toml --length 87.6m --set beam.ends.left=clamped**
    - Example: **antinode convert measured.uff observations.csv**

    Parameters
    ----------
    source
        The file to read.
    target
        The file to write; one of that name is replaced.
    """
    from antinode.exchange.convert import Request
    from antinode.exchange.convert import convert as run

    say_notes(run(Request(source, target, from_, to, exchange.choices(set_), exchange.modes)))
    say_written(target)


@app.command(name="app", sort_key=10)
def app_(
    file: Path | None = None,
    /,
    *,
    set_: Set = (),
    host: Annotated[
        str, Parameter(help="Address to listen on; any but loopback asks for a token.")
    ] = "127.0.0.1",
    port: Annotated[int, Parameter(help="Port to listen on; 0 takes a free one.")] = 8050,
    show: Annotated[
        bool, Parameter(help="Open the page in the browser.", negative="", show_default=False)
    ] = False,
) -> None:
    """Serve a page to think with: sliders beside vehicle, forces, frequencies and modes.

    The page is for this machine alone, and loads nothing from outside. It ends with Ctrl-C.

    - Example: **antinode app**
    - Example: **antinode app case.toml --show**
    - Example: **antinode app beam.toml --port 8060**

    Parameters
    ----------
    file
        A case or beam file in TOML; by default the starter vehicle.
    """
    from antinode.app.server import run_app

    run_app(file, set_, host=host, port=port, show=show)


@app.command(sort_key=12)
def report(
    file: Path,
    /,
    *,
    output: ReportFile,
    set_: Set = (),
    modes: ReportModes = None,
    tolerance: ReportTolerance = None,
    json: Json = False,
) -> None:
    """Write a report on a case, a beam or a study that can be handed to a reviewer.

    The ending says what: .pdf or .html.

    Assumptions first, then inputs, loads with their checks, the ranges of the correlations,
    frequencies with errors and brackets, the effect of the axial force, shapes, sensitivities,
    warnings, and where it all comes from. The page loads nothing.

    - Example: **antinode report case.toml -o report.pdf**
    - Example: **antinode report beam.toml -o report.html --modes 4**

    Parameters
    ----------
    file
        A case, a beam or a study file in TOML.
    """
    from antinode.report.command import run_report

    run_report(file, set_, output, modes=modes, tolerance=tolerance, json=json)


@app.command(sort_key=5)
def schema(of: str = "case", /) -> None:
    """Print the JSON schema of an input file, every key with its unit and range.

    - Example: **antinode schema case**
    - Example: **antinode schema beam > beam.schema.json**

    Parameters
    ----------
    of
        case, beam, study or identify.
    """
    from antinode.show.schema import input_schema

    if of == "study":
        from antinode.study.design.schema import study_schema

        print_json(study_schema())
    elif of == "identify":
        from antinode.study.identify.schema import identification_schema

        print_json(identification_schema())
    else:
        print_json(input_schema(of))


@app.command(sort_key=6)
def verify(*, json: Json = False) -> None:
    """Check this installation against closed forms, in seconds.

    - Example: **antinode verify**
    """
    from antinode.modes.verify import ALLOWED, run_checks

    checks = run_checks()
    failed = sum(not check.passed for check in checks)
    if json:
        rows = [check.to_dict() for check in checks]
        print_json({"schema_version": 1, "allowed": ALLOWED, "checks": rows})
    else:
        from antinode.show.printing import show_checks

        show_checks(checks)
    if failed:
        raise ComputationError(f"{failed} of {len(checks)} checks failed; reinstall antinode")


@app.command(sort_key=7)
def reproduce(
    *,
    out: Annotated[
        Path | None, Parameter(help="Also write figures and a page into this folder.")
    ] = None,
    json: Json = False,
) -> None:
    """Compare a reconstructed vehicle with the tables of the paper behind antinode.

    The data of the paper's own vehicle are lost. **antinode init --example paper** writes the one
    that stands in for it. Exit code 1 if a difference is beyond the bounds that ship with it.

    - Example: **antinode reproduce**
    - Example: **antinode reproduce --out paper**
    """
    from antinode.paper.comparison import check_bounds, compare

    if out:
        from antinode.paper.writing import check_folder

        check_folder(out)
    comparison = compare()
    if json:
        print_json(comparison.to_dict())
    else:
        from antinode.paper.terminal import show_comparison
        from antinode.show.printing import console

        show_comparison(console(), comparison)
    if out:
        from antinode.paper.writing import write_all

        say_written(write_all(comparison, out))
    check_bounds(comparison)


def _solve(problem: Case | BeamFile, solver: Solver) -> ModalResult:
    """Solve a problem, by the settings of its file but for those given on the command line."""
    from antinode.modes.solve import solve_modes

    settings = problem.solve.overridden(modes=solver.modes, tolerance=solver.tolerance)
    return solve_modes(
        problem,
        settings.modes,
        tolerance=settings.tolerance,
        method=solver.method,
        normalisation=solver.shapes,
        unloaded=True,
    )


def _check_output(output: Output, *, modal: bool = False) -> None:
    """Refuse what cannot be written before any work is done."""
    if output.file and modal:
        from antinode.exchange.outputs import check_modal_output

        check_modal_output(output.file)
    elif output.file:
        from antinode.show.writing import ENDINGS, check_output

        check_output(output.file, ENDINGS)
    check_plot(output.plot)


def _case_dict(problem: Case, result: ModalResult) -> dict[str, Any]:
    """Return modes of a vehicle as plain values, with its condition and loads."""
    from antinode.show.loads_table import condition_dict, loads_summary

    data = result.to_dict()
    data["condition"], data["loads"] = condition_dict(problem), loads_summary(problem)
    data["warnings"] = [*problem.loads.warnings, *data["warnings"]]
    return data


def _write_modes(
    output: Output, result: ModalResult, to_dict: Callable[[], dict[str, Any]]
) -> None:
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
