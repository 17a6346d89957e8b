"""The flow of the program in its imports: a module imports only what stands left of it.

Physics leads to a beam, a beam to modes; the solver knows neither vehicles nor files. What a
command does not need is not imported, so that it starts quickly.
"""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

import antinode
from cli_run import run

ROOT = Path(antinode.__file__).parent

WORDS = ("errors", "text", "extras", "known_units", "units")
PHYSICS = (
    "vehicle",
    "condition",
    "model",
    "hydrodynamics.validity",
    "hydrodynamics.cavitator",
    "hydrodynamics.cavity",
    "hydrodynamics.fins",
    "hydrodynamics.planing",
    "hydrodynamics",
    "loads",
)
RICCATI = (
    "riccati",
    "riccati.points",
    "riccati.segment",
    "riccati.chain",
    "riccati.roots",
    "riccati.loads",
    "riccati.shapes",
    "riccati.lanes",
    "riccati.lane_shapes",
    "riccati.compiled",
    "riccati.literal",
)
BEAM = ("attachments", "beam", "limits", "axial")
MODES = ("result", "kernel", "modes", "batch", "frequencies", "buckling")
READING = ("explain", "override", "files")
INPUTS = ("attachment_tables", "beam_file", "case", "statics")
OUTPUTS = (
    "dataset",
    "loads_table",
    "plot_style",
    "svg",
    "beam_sketch",
    "figures",
    "verify",
    "printing",
    "schema",
    "outcome",
)
PAPER = (
    "paper",
    "paper.tables",
    "paper.comparison",
    "paper.terminal",
    "paper.scene",
    "paper.plates",
    "paper.vehicle_figures",
    "paper.mode_figures",
    "paper.difference_figure",
    "paper.gallery",
    "paper.page",
    "paper.writing",
)
STUDY = (
    "study",
    "study.progress",
    "study.paths",
    "study.observation_table",
    "study.identification_file",
    "study.columns",
    "study.derivatives",
    "study.effects",
    "study.response",
    "study.observations",
    "study.unknowns",
    "study.misfit",
    "study.fit",
    "study.estimates",
    "study.identification",
    "study.identification_words",
    "study.identification_tables",
    "study.identified_case",
    "study.identification_schema",
    "study.identification_report",
    "study.identification_command",
    "study.study_file",
    "study.design",
    "study.many_loads",
    "study.many_beams",
    "study.chunks",
    "study.executors",
    "study.store",
    "study.tracking",
    "study.sweep",
    "study.sweep_tables",
    "study.sweep_schema",
    "study.sweep_figures",
    "study.sweep_report",
    "study.sweep_command",
    "study.indices",
    "study.sensitivity",
    "study.sensitivity_command",
)
REPORT = (
    "report",
    "report.blocks",
    "report.numbers",
    "report.extras",
    "report.words",
    "report.provenance",
    "report.inputs",
    "report.load_sections",
    "report.modal_sections",
    "report.influence",
    "report.influence_section",
    "report.vehicle_report",
    "report.beam_report",
    "report.study_report",
    "report.html",
    "report.pdf",
    "report.command",
)
EXCHANGE = (
    "exchange",
    "exchange.units",
    "exchange.formats",
    "exchange.tabulated",
    "exchange.beam_toml",
    "exchange.station_csv",
    "exchange.workbook",
    "exchange.matlab",
    "exchange.vtk",
    "exchange.nastran_cards",
    "exchange.nastran_writer",
    "exchange.nastran_model",
    "exchange.nastran_line",
    "exchange.nastran_properties",
    "exchange.nastran_attached",
    "exchange.nastran_preload",
    "exchange.nastran_reader",
    "exchange.sections",
    "exchange.uff_writer",
    "exchange.frf",
    "exchange.uff_reader",
    "exchange.observation_rows",
    "exchange.outputs",
    "exchange.inputs",
    "exchange.convert",
)
EXAMPLES = ("examples",)
APP = (
    "app",
    "app.panels",
    "app.display",
    "app.inputs",
    "app.state",
    "app.source",
    "app.quick",
    "app.compute",
    "app.save",
    "app.curve",
    "app.panels.numbers",
    "app.panels.vehicle",
    "app.panels.forces",
    "app.panels.modes",
    "app.panels.frequencies",
    "app.panels.characteristic",
    "app.panels.curve",
    "app.panels.notes",
    "app.scene3d",
    "app.session",
    "app.elements",
    "app.fields",
    "app.stations",
    "app.page",
    "app.guard",
    "app.server",
)
COMMANDS = ("options", "study_options", "study_commands", "commands", "cli", "__main__")

MAY_IMPORT = {
    WORDS: (),
    PHYSICS: (WORDS,),
    RICCATI: (),
    BEAM: (WORDS[:1], RICCATI),
    MODES: (WORDS[:1], RICCATI, BEAM),
    READING: (WORDS, BEAM),
    INPUTS: (WORDS, PHYSICS, RICCATI, BEAM, READING),
    OUTPUTS: (WORDS, PHYSICS, RICCATI, BEAM, MODES, READING, INPUTS),
    PAPER: (WORDS, RICCATI, BEAM, MODES, INPUTS, OUTPUTS),
    STUDY: (WORDS, PHYSICS, RICCATI, BEAM, MODES, READING, INPUTS, OUTPUTS),
    REPORT: (WORDS, PHYSICS, RICCATI, BEAM, MODES, READING, INPUTS, OUTPUTS, STUDY),
    EXCHANGE: (WORDS, RICCATI, BEAM, MODES, READING, INPUTS, OUTPUTS),
    EXAMPLES: (WORDS,),
    APP: (WORDS, PHYSICS, RICCATI, BEAM, MODES, READING, INPUTS, OUTPUTS, EXAMPLES),
    COMMANDS: (EXAMPLES, WORDS, PHYSICS, RICCATI, BEAM, MODES, READING, INPUTS, OUTPUTS),
}
"""What the modules of a group import, beside those that stand before them in the group."""

HEAVY = (
    "numba",
    "matplotlib",
    "xarray",
    "scipy",
    "scipy.linalg",
    "scipy.optimize",
    "pint",
    "h5netcdf",
    "h5py",
    "mpmath",
    "pandas",
    "nicegui",
)


def modules():
    """Every module of the package with its path."""
    for path in sorted(ROOT.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(part for part in parts if part != "__init__")
        if name:
            yield name, path


def imports(name, path):
    """What a module imports of antinode when it is imported itself."""
    package = ["antinode", *name.split(".")]
    package = package if path.name == "__init__.py" else package[:-1]
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Import):
            found = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) + 1 - node.level] if node.level else []
            module = ".".join([*start, *filter(None, [node.module])])
            inner = [f"{module}.{alias.name}" for alias in node.names]
            found = [each if each in ALL else module for each in inner]
        else:
            continue
        yield from (each for each in found if each in ALL)


ALL = {f"antinode.{name}" for name, _ in modules()}


@pytest.mark.parametrize(("name", "path"), list(modules()))
def test_a_module_imports_only_what_stands_left_of_it(name, path):
    group = next((group for group in MAY_IMPORT if name in group), None)
    assert group is not None, f"{name} is new: give it a place in the lists above"
    allowed = {*group[: group.index(name)], *(n for part in MAY_IMPORT[group] for n in part)}
    wrong = {each.removeprefix("antinode.") for each in imports(name, path)} - allowed
    assert not wrong, f"{name} imports {wrong}"


def test_the_lists_name_no_module_that_is_gone():
    listed = {name for group in MAY_IMPORT for name in group}
    assert listed == {name for name, _ in modules()}


def test_the_imports_are_seen():
    assert "antinode.riccati.chain" in set(imports("beam", ROOT / "beam.py"))
    assert "antinode.hydrodynamics.fins" in set(imports("loads", ROOT / "loads.py"))
    assert "antinode.riccati.points" in set(imports("riccati.chain", ROOT / "riccati/chain.py"))


def imported_by(code, *arguments):
    """Names of the heavy libraries that a fresh process imports, and antinode's own modules."""
    ending = "import json, sys; print(json.dumps(sorted(sys.modules)), file=sys.stderr)"
    command = [sys.executable, "-c", f"{code}\n{ending}", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    names = json.loads(done.stderr.splitlines()[-1])
    heavy = {name for name in names if name in HEAVY}
    return heavy, {name for name in names if name.startswith("antinode")}


COMMAND = """
import sys
from antinode.cli import main
try:
    main()
except SystemExit as end:
    assert end.code == 0
"""

SI_BEAM = """
[beam]
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }
"""


def test_importing_antinode_imports_nothing():
    heavy, own = imported_by("import antinode")
    assert heavy == set()
    assert own == {"antinode"}


def test_a_beam_in_si_numbers_needs_numpy_alone(tmp_path):
    (tmp_path / "beam.toml").write_text(SI_BEAM)
    heavy, own = imported_by(COMMAND, "beam", tmp_path / "beam.toml")
    assert heavy == set()
    assert not {"antinode.loads", "antinode.case", "antinode.figures", "antinode.schema"} & own


def test_a_vehicle_in_common_units_needs_no_more(tmp_path):
    run("init", tmp_path)
    heavy, own = imported_by(COMMAND, "modes", tmp_path / "case.toml")
    assert heavy == set()
    assert "antinode.figures" not in own


def test_other_units_need_pint(tmp_path):
    run("init", tmp_path)
    arguments = ("modes", tmp_path / "case.toml", "--set", "condition.speed=150knot")
    heavy, _ = imported_by(COMMAND, *arguments)
    assert heavy - {"scipy"} == {"pint"}  # pint looks whether there is a scipy


def test_help_and_init_import_no_numpy(tmp_path):
    for arguments in (["--help"], ["modes", "--help"], ["init", tmp_path]):
        code = COMMAND + "assert 'numpy' not in sys.modules and 'pydantic' not in sys.modules"
        assert imported_by(code, *arguments)[0] == set()
