"""The flow of the program in its imports: a module imports only what stands above it.

Physics leads to a beam, a beam to modes; the solver knows neither vehicles nor files. What a
command does not need is not imported, so that it starts quickly.
"""

import ast
import json
import subprocess
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import antinode
from cli_run import run

ROOT = Path(antinode.__file__).parent

ROOMS = {
    "riccati": (),
    "inputs": ("ground",),
    "beam": ("ground", "riccati", "inputs"),
    "modes": ("ground", "riccati", "beam"),
    "vehicle": ("ground", "riccati", "inputs", "beam", "modes"),
    "response": ("ground", "riccati", "inputs", "beam", "modes", "vehicle"),
    "stability": ("ground", "riccati", "inputs", "beam", "modes", "vehicle"),
    "show": ("ground", "riccati", "inputs", "beam", "modes", "vehicle", "response"),
    "examples": ("ground",),
    "study": (
        "ground",
        "riccati",
        "inputs",
        "beam",
        "modes",
        "vehicle",
        "stability",
        "response",
        "show",
    ),
    "exchange": ("ground", "riccati", "inputs", "beam", "modes", "response", "show"),
    "paper": ("ground", "riccati", "inputs", "beam", "modes", "vehicle", "show"),
    "report": (
        *("ground", "riccati", "inputs", "beam", "modes", "vehicle", "response", "show"),
        "study",
    ),
    "app": (
        *("ground", "riccati", "inputs", "beam", "modes", "vehicle", "stability"),
        *("response", "show", "examples", "study"),
    ),
    "cli": ("ground", "riccati", "inputs", "beam", "modes", "vehicle", "show", "examples"),
}
"""What a room may import when it is imported: itself, and these. A new room gets a line here."""

MOST_FILES, MOST_IN_ROOT, MOST_LINES, MOST_IN_FUNCTION = 22, 10, 500, 60
"""Files in a folder and in the package's own, lines of a file and of a function: symptoms."""

HEAVY = (
    "numba",
    "llvmlite",
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
    return imported(name, path, ast.parse(path.read_text(encoding="utf-8")).body)


def imported(name, path, body):
    """What a module imports of antinode by the statements of a body."""
    package = ["antinode", *name.split(".")]
    package = package if path.name == "__init__.py" else package[:-1]
    for node in body:
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


def room(name):
    """The room of a module: its first folder, or the ground."""
    first = name.partition(".")[0]
    return first if first in ROOMS else "ground"


FILES = {name: path for name, path in modules() if path.name != "__init__.py"}


@pytest.mark.parametrize("name", list(FILES))
def test_a_room_imports_only_the_rooms_below_it(name):
    mine = room(name)
    allowed = ROOMS.get(mine, ())
    for each in imports(name, FILES[name]):
        other = each.removeprefix("antinode.")
        fine = room(other) in (mine, *allowed) or mine == "ground"
        assert fine, f"{name} imports {other}"


def test_nothing_is_so_large_that_nobody_finds_anything():
    for folder in {path.parent for path in FILES.values()}:
        most = MOST_IN_ROOT if folder == ROOT else MOST_FILES
        assert len(list(folder.glob("*.py"))) <= most, folder
    for name, path in FILES.items():
        text = path.read_text(encoding="utf-8")
        assert len(text.splitlines()) <= MOST_LINES, name
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                assert node.end_lineno - node.lineno < MOST_IN_FUNCTION, f"{name}.{node.name}"


def every_import(node):
    """What is imported anywhere below a node, but for the types alone."""
    for inner in ast.iter_child_nodes(node):
        if isinstance(inner, ast.If) and ast.unparse(inner.test) == "TYPE_CHECKING":
            continue
        if isinstance(inner, ast.Import | ast.ImportFrom):
            yield inner
        yield from every_import(inner)


def test_no_import_runs_in_a_circle_lazy_ones_included():
    graph = {}
    for name, path in modules():
        body = list(every_import(ast.parse(path.read_text(encoding="utf-8"))))
        graph[f"antinode.{name}"] = set(imported(name, path, body)) - {f"antinode.{name}"}
    assert graph["antinode.cli.commands.modes"] >= {"antinode.show.printing"}  # a lazy one
    TopologicalSorter(graph).prepare()  # raises CycleError


def test_the_imports_are_seen():
    def seen(name):
        return set(imports(name, FILES[name]))

    assert "antinode.riccati.chain" in seen("beam.beam")
    assert "antinode.vehicle.hydrodynamics.fins" in seen("vehicle.forces")
    assert "antinode.riccati.points" in seen("riccati.chain")


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
    assert (
        not {
            "antinode.vehicle.loads",
            "antinode.vehicle.case",
            "antinode.show.figures",
            "antinode.show.schema",
            "antinode.modes.damped.modes",
            "antinode.riccati.damped.roots",
            "antinode.riccati.following.roots",
            "antinode.riccati.literal",
        }
        & own
    )


def test_a_vehicle_in_common_units_needs_no_more(tmp_path):
    run("init", tmp_path)
    heavy, own = imported_by(COMMAND, "modes", tmp_path / "case.toml")
    assert heavy == set()
    assert "antinode.show.figures" not in own


def test_other_units_need_pint(tmp_path):
    run("init", tmp_path)
    arguments = ("modes", tmp_path / "case.toml", "--set", "condition.speed=150knot")
    heavy, _ = imported_by(COMMAND, *arguments)
    assert heavy - {"scipy"} == {"pint"}  # pint looks whether there is a scipy


def test_help_and_init_import_no_numpy(tmp_path):
    for arguments in (["--help"], ["modes", "--help"], ["init", tmp_path]):
        code = COMMAND + "assert 'numpy' not in sys.modules and 'pydantic' not in sys.modules"
        assert imported_by(code, *arguments)[0] == set()
