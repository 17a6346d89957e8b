"""The options that several commands share, with their help."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

if TYPE_CHECKING:
    from antinode.exchange.inputs import Choices

INPUT = Group("Input", sort_key=1)
SOLVER = Group("Solver", sort_key=2)
WORK = Group("Work", sort_key=2)
OUTPUT = Group("Output", sort_key=3)


def option(group: Group, text: str, *names: str, **more: Any) -> Parameter:
    """Return an option with its help; without names it has that of its argument."""
    return Parameter(name=names or None, help=text, group=group, **more)


def flag(group: Group, text: str, *names: str) -> Parameter:
    """Return an option that is given or not, once or often; no default is shown."""
    return option(group, text, *names, negative="", show_default=False)


def whole(group: Group, text: str, *names: str) -> Parameter:
    """Return an option that takes a whole number; cyclopts itself would round 2.5."""
    return option(group, text, *names, converter=_to_whole)


def _to_whole(_: Any, tokens: Sequence[Any]) -> int:
    try:
        return int(tokens[0].value)
    except ValueError:
        raise ValueError(f"{tokens[0].value[:40]!r} is no whole number") from None


def assignments(file: str, example: str, more: str = "") -> Parameter:
    """Return the option that overrides keys of a file."""
    return flag(INPUT, f"Override a key of the {file}: {example} (repeatable{more}).", "--set")


_LISTS = "; entries of a list count from 0"
Set = Annotated[
    tuple[str, ...],
    assignments(
        "file", "--set condition.speed=100m/s, --set vehicle.fins.0.thickness=20mm", _LISTS
    ),
]
BeamSet = Annotated[
    tuple[str, ...],
    assignments(
        "file", "--set beam.ends.left=pinned, --set beam.stations.axial_force.0=100kN", _LISTS
    ),
]
Json = Annotated[
    bool,
    flag(OUTPUT, "Print one JSON object in place of tables; units stand in its keys.", "--json"),
]
BucklingFactor = Annotated[
    bool,
    flag(
        SOLVER, "Also find the factor on the axial force at which the beam buckles.", "--buckling"
    ),
]

Prove = Annotated[
    bool,
    flag(
        SOLVER,
        "Also prove in ball arithmetic that no mode is missing in a region, and none further off "
        "than its error; needs the extra 'prove'. Exit code 3 if it is not proven.",
        "--prove",
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class Solver:
    """What to compute, and how."""

    modes: Annotated[
        int | None,
        whole(
            SOLVER,
            "Elastic modes 1 ... n of each family, up to 500; default: the file's, or 6.",
        ),
    ] = None
    tolerance: Annotated[
        float | None,
        option(
            SOLVER,
            "Largest relative error of a frequency by what varies inside segments, 1e-12 to 0.1; "
            "default: the file's, or 1e-6.",
        ),
    ] = None
    method: Annotated[
        Literal["riccati", "tmm"],
        option(SOLVER, "riccati, certified; or tmm, the transfer matrix scan, for comparison."),
    ] = "riccati"
    damping: Annotated[
        Literal["auto", "none", "complex"],
        option(
            SOLVER,
            "Complex modes with damping ratio and growth: auto, where dashpots or point feedback "
            "act; complex, always, with loss factors too; none, as if there were no dashpots.",
        ),
    ] = "auto"
    shapes: Annotated[
        Literal["amplitude", "mass"],
        option(SOLVER, "Scale shapes to largest displacement 1, or unit modal mass."),
    ] = "amplitude"


@Parameter(name="*")
@dataclass(frozen=True)
class Output:
    """Where the result goes."""

    json: Json = False
    file: Annotated[
        Path | None,
        option(
            OUTPUT,
            "Write the result to a file: .csv (a table), .json, or .nc (NetCDF, with shapes); "
            "modes also as .xlsx, .mat, .vtu, .uff, .bdf or .inp.",
            "-o",
            "--output",
        ),
    ] = None
    plot: Annotated[Path | None, option(OUTPUT, "Draw the result: .png, .svg or .pdf.")] = None


Effects = Annotated[
    Path | None,
    option(
        OUTPUT,
        "Draw what each effect does to the bending modes, each solved with and without it: axial "
        "force, ends that follow, shear, rotary inertia, foundation, added mass.",
        "--effects",
    ),
]
ReportFile = Annotated[
    Path, option(OUTPUT, "The report to write: .pdf or .html.", "-o", "--output")
]
ReportModes = Annotated[
    int | None,
    whole(SOLVER, "Elastic modes 1 ... n of each family; default: the file's, or 6.", "--modes"),
]
ReportTolerance = Annotated[
    float | None,
    option(
        SOLVER,
        "Largest relative error of a frequency; default: the file's, or 1e-6.",
        "--tolerance",
    ),
]
ReportResponses = Annotated[
    tuple[Path, ...],
    option(
        INPUT,
        "A response file of this case or beam: a chapter for it. May be repeated.",
        "--response",
    ),
]
ReportAuthor = Annotated[str, option(OUTPUT, "Who answers for it, under the title.", "--author")]
ReportRevision = Annotated[str, option(OUTPUT, "Its revision, under the title.", "--revision")]
ReportChecked = Annotated[
    str,
    option(OUTPUT, "Who has checked it; left to fill in by hand if nobody has.", "--checked-by"),
]
FromFormat = Annotated[
    str,
    option(
        INPUT,
        "Format of the input, where its ending does not say: toml, csv, xlsx, nastran, sections, "
        "uff.",
        "--from",
        show_default=False,
    ),
]
ToFormat = Annotated[
    str,
    option(
        OUTPUT,
        "Format of the output, where its ending does not say: toml, csv, xlsx, json, netcdf, mat, "
        "nastran, calculix, uff, vtk.",
        "--to",
        show_default=False,
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class Exchange:
    """What the files of other programs leave open."""

    modes: Annotated[
        int | None,
        whole(
            OUTPUT,
            "Elastic modes of each family in an output with modes; default: the file's, or 6.",
        ),
    ] = None
    analysis: Annotated[
        Literal["modes", "unloaded", "statsub", "buckling"],
        option(
            OUTPUT,
            "What a NASTRAN or CalculiX deck is for: modes under the axial force, as every solver "
            "reads it; modes without it; statsub, modes under it by a static subcase of NASTRAN; "
            "buckling.",
        ),
    ] = "modes"
    units: Annotated[
        Literal["SI", "mm-t-s", "mm-kg-ms", "in-lbf-s", "ft-lbf-s"],
        option(
            INPUT,
            "Units of NASTRAN, CalculiX and UFF files, which do not say them: SI; mm-t-s (N, MPa); "
            "mm-kg-ms (kN, GPa); in-lbf-s (mass in lbf s^2/inch); ft-lbf-s (slug).",
        ),
    ] = "SI"
    elements: Annotated[
        str,
        option(
            INPUT,
            "Elements of a larger NASTRAN model that make up the beam: 100:140, or 7,12,100:140.",
            show_default=False,
        ),
    ] = ""
    plane: Annotated[
        int,
        whole(
            INPUT,
            "Plane of bending where a file has two: 1 or 2 (NASTRAN's; flap or fore-aft is 1, edge "
            "or side-side 2; y is 1, z 2).",
        ),
    ] = 1
    length: Annotated[
        str | None,
        option(INPUT, "Length of the beam where stations are fractions of it: 87.6m."),
    ] = None

    def choices(self, assignments: tuple[str, ...]) -> Choices:
        """Return them as the readers want them."""
        from antinode.errors import InputError
        from antinode.exchange.inputs import Choices, elements_of
        from antinode.exchange.units import SYSTEMS
        from antinode.inputs.units import to_si

        if self.plane not in (1, 2):
            raise InputError(f"--plane {self.plane} is none; planes are 1 and 2")
        try:
            length = None if self.length is None else to_si(self.length, "m")
        except ValueError as error:
            given = str(self.length)[:40]
            raise InputError(f"--length {given!r}: {error}; write e.g. 87.6m") from error
        if length is not None and not 0 < length < 1e9:
            raise InputError(f"--length is {length:g} m; it must be positive and below 1e9 m")
        elements = elements_of(self.elements)
        return Choices(assignments, SYSTEMS[self.units], self.plane, length, elements)
