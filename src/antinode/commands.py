"""The commands of `antinode`: their arguments, their help and what each of them does."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from . import __version__
from .errors import ComputationError, InputError
from .examples import EXAMPLES, write_example
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
from .study_options import Folder, IdentifySet, Overwrite, Sensitivity, StudySet, Sweep
from .text import one_line, short

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .beam_file import BeamFile
    from .case import Case
    from .result import ModalResult

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
_SWEEP, _SENSITIVITY = Sweep(), Sensitivity()


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
    from .case import load_case
    from .loads_table import condition_dict, loads_summary

    problem = load_case(case, set_)
    result = _solve(problem, solver)
    data = result.to_dict()
    data["condition"], data["loads"] = condition_dict(problem), loads_summary(problem)
    data["warnings"] = [*problem.loads.warnings, *data["warnings"]]
    if output.plot:
        from .figures import plot_case

        _draw(plot_case(problem, result), output.plot)
    _write_modes(output, data, result)
    if not output.json:
        from .printing import console, show_condition, show_modes

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
    from .beam_file import load_beam

    result = _solve(load_beam(file, set_), solver)
    data, critical = result.to_dict(), None
    if buckling:
        from .buckling import buckling as find_factor

        critical = find_factor(result.beam, result.tolerance)
        data["buckling"] = critical.to_dict() if critical else None
    if output.plot:
        from .figures import plot_modes

        _draw(plot_modes(result), output.plot)
    _write_modes(output, data, result)
    if not output.json:
        from .printing import console, show_beam, show_buckling, show_modes

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
    from .case import load_case
    from .loads_table import condition_dict, loads_csv, loads_dataset, loads_dict

    problem = load_case(case, set_)
    data = {**loads_dict(problem), "condition": condition_dict(problem)}
    if output.plot:
        from .figures import plot_loads

        _draw(plot_loads(problem), output.plot)
    if output.file:
        from .dataset import write_result

        write_result(output.file, data, lambda: loads_csv(problem), lambda: loads_dataset(problem))
        _say_written(output.file)
    if output.json:
        _print_json(data)
    else:
        from .printing import console, show_loads

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


@app.command(sort_key=8)
def sweep(
    study: Path,
    /,
    *,
    set_: StudySet = (),
    options: Sweep = _SWEEP,
) -> None:
    """Compute the frequencies of many cases: grids, tables, time histories, samples.

    The study file names a case, the inputs of it that vary, and how. With a store, **-o
    sweep.zarr**, an interrupted sweep goes on where it was, whatever ended it: run the same command
    again. Cases that fail are NaN with a reason. Exit code 1 if all cases fail.

    - Example: **antinode sweep study.toml --plot sweep.png**
    - Example: **antinode sweep study.toml -o sweep.zarr --workers 2**
    - Example: **antinode sweep study.toml -o sweep.zarr --scheduler tcp://cluster:8786**

    Parameters
    ----------
    study
        A study file in TOML. 'antinode init --example sweep' writes one with its case.
    """
    from .study.sweep_command import run_sweep

    run_sweep(
        study,
        options.assignments(set_),
        options.output,
        workers=options.workers,
        scheduler=options.scheduler,
        plot=options.plot,
        overwrite=options.overwrite,
        json=options.json,
    )


@app.command(sort_key=8)
def sensitivity(
    file: Path,
    /,
    *,
    set_: StudySet = (),
    options: Sensitivity = _SENSITIVITY,
) -> None:
    """Compute which inputs the frequencies depend on, and how uncertain they make them.

    For every mode: mean, deviation and 95 % band over the distributions of the inputs, Sobol
    indices (first order and total, with 95 % intervals), and the derivative at the case in % per %.

    - Example: **antinode sensitivity case.toml --uncertain speed=2% --uncertain thrust=5%**
    - Example: **antinode sensitivity samples.toml --samples 2048 --plot tornado.png**

    Parameters
    ----------
    file
        A study file whose inputs have distributions; or a case file, with --uncertain.
    """
    from .study.sensitivity_command import run_sensitivity

    run_sensitivity(
        file,
        set_,
        options.uncertain,
        samples=options.samples,
        workers=options.workers,
        store=options.store,
        plot=options.plot,
        json=options.json,
    )


@app.command(sort_key=8)
def identify(
    file: Path,
    /,
    *,
    set_: IdentifySet = (),
    folder: Folder = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> None:
    """Find the parameters of a vehicle that explain observed frequencies.

    The file names a case, observations of it, and what of it may change: numbers, numbers of every
    row, and distributions along the body. Printed are observed against fitted frequencies, values
    with standard deviations, and what the data leave open. Ctrl-C ends it with the best values so
    far (exit code 130).

    - Example: **antinode identify identify.toml -o fitted**
    - Example: **antinode identify identify.toml --set fit.starts=8 --json**

    Parameters
    ----------
    file
        An identification file in TOML. 'antinode schema identify' lists its keys.
    """
    from .study.identification_command import run_identification

    run_identification(file, set_, folder, overwrite=overwrite, json=json)


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
    from .exchange.convert import Request
    from .exchange.convert import convert as run

    _say_notes(run(Request(source, target, from_, to, exchange.choices(set_), exchange.modes)))
    _say_written(target)


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
    from .app.server import run_app

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
    from .report.command import run_report

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
    from .schema import input_schema

    if of == "study":
        from .study.sweep_schema import study_schema

        _print_json(study_schema())
    elif of == "identify":
        from .study.identification_schema import identification_schema

        _print_json(identification_schema())
    else:
        _print_json(input_schema(of))


@app.command(sort_key=6)
def verify(*, json: Json = False) -> None:
    """Check this installation against closed forms, in seconds.

    - Example: **antinode verify**
    """
    from .verify import ALLOWED, run_checks

    checks = run_checks()
    failed = sum(not check.passed for check in checks)
    if json:
        rows = [check.to_dict() for check in checks]
        _print_json({"schema_version": 1, "allowed": ALLOWED, "checks": rows})
    else:
        from .printing import show_checks

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
    from .paper.comparison import check_bounds, compare

    if out:
        from .paper.writing import check_folder

        check_folder(out)
    comparison = compare()
    if json:
        _print_json(comparison.to_dict())
    else:
        from .paper.terminal import show_comparison
        from .printing import console

        show_comparison(console(), comparison)
    if out:
        from .paper.writing import write_all

        _say_written(write_all(comparison, out))
    check_bounds(comparison)


def _solve(problem: Case | BeamFile, solver: Solver) -> ModalResult:
    """Solve a problem, by the settings of its file but for those given on the command line."""
    from .beam_file import Solve
    from .explain import validate
    from .modes import solve_modes

    given = {"modes": solver.modes, "tolerance": solver.tolerance}
    chosen = problem.solve.model_dump() | {k: v for k, v in given.items() if v is not None}
    settings = validate(Solve, chosen, "command line")
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
        from .exchange.outputs import check_modal_output

        check_modal_output(output.file)
    elif output.file:
        from .dataset import ENDINGS, check_output

        check_output(output.file, ENDINGS)
    if output.plot:
        from .figures import check_plot

        check_plot(output.plot)


def _draw(figure: Figure, path: Path) -> None:
    from .figures import save

    save(figure, path)
    _say_written(path)


def _write_modes(output: Output, data: dict[str, Any], result: ModalResult) -> None:
    """Write modes to the file, and as JSON to stdout, as asked for."""
    if output.file:
        from .exchange.outputs import Modes, write_modes

        _say_notes(write_modes(output.file, Modes(result, data)))
        _say_written(output.file)
    if output.json:
        _print_json(data)


def _print_json(data: dict[str, Any]) -> None:
    from .dataset import to_json

    print(to_json(data))


def _say_notes(notes: Iterable[str]) -> None:
    """Say what a file leaves out."""
    for note in notes:
        print(f"note: {one_line(note, 300)}", file=sys.stderr)


def _say_written(path: Path) -> None:
    print(f"wrote {path}", file=sys.stderr)
