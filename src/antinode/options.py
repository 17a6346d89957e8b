"""The options that several commands share, with their help."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

if TYPE_CHECKING:
    from .exchange.inputs import Choices

_input = Group("Input", sort_key=1)
_solver = Group("Solver", sort_key=2)
_output = Group("Output", sort_key=3)


def _whole(_: Any, tokens: Sequence[Any]) -> int:
    """Convert a token to a whole number; cyclopts itself would round 2.5."""
    try:
        return int(tokens[0].value)
    except ValueError:
        raise ValueError(f"{tokens[0].value[:40]!r} is no whole number") from None


def _set(example: str) -> Parameter:
    """Return the option that overrides keys of a file."""
    return Parameter(
        name="--set",
        help=f"Override a key of the file: {example} (repeatable; entries of a list count from 0).",
        negative="",
        show_default=False,
        group=_input,
    )


Set = Annotated[
    tuple[str, ...], _set("--set condition.speed=100m/s, --set vehicle.fins.0.thickness=20mm")
]
BeamSet = Annotated[
    tuple[str, ...],
    _set("--set beam.ends.left=pinned, --set beam.stations.axial_force.0=100kN"),
]
Json = Annotated[
    bool,
    Parameter(
        name="--json",
        help="Print one JSON object in place of tables; units stand in its keys.",
        negative="",
        show_default=False,
        group=_output,
    ),
]
BucklingFactor = Annotated[
    bool,
    Parameter(
        name="--buckling",
        help="Also find the factor on the axial force at which the beam buckles.",
        negative="",
        show_default=False,
        group=_solver,
    ),
]


IdentifySet = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        help="Override a key of the identification file: --set fit.starts=8 (repeatable).",
        negative="",
        show_default=False,
        group=_input,
    ),
]
Folder = Annotated[
    Path | None,
    Parameter(
        name=["-o", "--output"],
        help="Write the fitted case, tables and JSON into this folder.",
        group=_output,
    ),
]
Overwrite = Annotated[
    bool,
    Parameter(
        name="--overwrite",
        help="Write over files of an earlier run.",
        negative="",
        show_default=False,
        group=_output,
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class Solver:
    """What to compute, and how."""

    modes: Annotated[
        int | None,
        Parameter(
            converter=_whole,
            help="Elastic modes 1 ... n of each family, up to 500; default: the file's, or 6.",
            group=_solver,
        ),
    ] = None
    tolerance: Annotated[
        float | None,
        Parameter(
            help="Largest relative error of a frequency by what varies inside segments, 1e-12 to "
            "0.1; default: the file's, or 1e-6.",
            group=_solver,
        ),
    ] = None
    method: Annotated[
        Literal["riccati", "tmm"],
        Parameter(
            help="riccati, certified; or tmm, the transfer matrix scan, for comparison.",
            group=_solver,
        ),
    ] = "riccati"
    shapes: Annotated[
        Literal["amplitude", "mass"],
        Parameter(
            help="Scale shapes to largest displacement 1, or unit modal mass.", group=_solver
        ),
    ] = "amplitude"


@Parameter(name="*")
@dataclass(frozen=True)
class Output:
    """Where the result goes."""

    json: Json = False
    file: Annotated[
        Path | None,
        Parameter(
            name=["-o", "--output"],
            help="Write the result to a file: .csv (a table), .json, or .nc (NetCDF, with shapes); "
            "modes also as .xlsx, .mat, .vtu, .uff or .bdf.",
            group=_output,
        ),
    ] = None
    plot: Annotated[
        Path | None,
        Parameter(help="Draw the result: .png, .svg or .pdf.", group=_output),
    ] = None


ReportFile = Annotated[
    Path,
    Parameter(name=["-o", "--output"], help="The report to write: .pdf or .html.", group=_output),
]
ReportModes = Annotated[
    int | None,
    Parameter(
        name="--modes",
        converter=_whole,
        help="Elastic modes 1 ... n of each family; default: the file's, or 6.",
        group=_solver,
    ),
]
ReportTolerance = Annotated[
    float | None,
    Parameter(
        name="--tolerance",
        help="Largest relative error of a frequency; default: the file's, or 1e-6.",
        group=_solver,
    ),
]
FromFormat = Annotated[
    str,
    Parameter(
        name="--from",
        help="Format of the input, where its ending does not say: toml, csv, xlsx, nastran, "
        "sections, uff.",
        group=_input,
        show_default=False,
    ),
]
ToFormat = Annotated[
    str,
    Parameter(
        name="--to",
        help="Format of the output, where its ending does not say: toml, csv, xlsx, json, netcdf, "
        "mat, nastran, uff, vtk.",
        group=_output,
        show_default=False,
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class Exchange:
    """What the files of other programs leave open."""

    modes: Annotated[
        int | None,
        Parameter(
            converter=_whole,
            help="Elastic modes of each family in an output with modes; default: the file's, or 6.",
            group=_output,
        ),
    ] = None
    units: Annotated[
        Literal["SI", "mm-t-s"],
        Parameter(help="Units of NASTRAN and UFF files that do not say them.", group=_input),
    ] = "SI"
    plane: Annotated[
        int,
        Parameter(
            converter=_whole,
            help="Plane of bending where a file has two: 1 or 2 (NASTRAN's; flap or fore-aft is 1, "
            "edge or side-side 2; y is 1, z 2).",
            group=_input,
        ),
    ] = 1
    length: Annotated[
        str | None,
        Parameter(
            help="Length of the beam where stations are fractions of it: 87.6m.", group=_input
        ),
    ] = None

    def choices(self, assignments: tuple[str, ...]) -> Choices:
        """Return them as the readers want them."""
        from .errors import InputError
        from .exchange.inputs import Choices
        from .exchange.units import SYSTEMS
        from .units import to_si

        if self.plane not in (1, 2):
            raise InputError(f"--plane {self.plane} is none; planes are 1 and 2")
        try:
            length = None if self.length is None else to_si(self.length, "m")
        except ValueError as error:
            given = str(self.length)[:40]
            raise InputError(f"--length {given!r}: {error}; write e.g. 87.6m") from error
        if length is not None and not 0 < length < 1e9:
            raise InputError(f"--length is {length:g} m; it must be positive and below 1e9 m")
        return Choices(assignments, SYSTEMS[self.units], self.plane, length)
