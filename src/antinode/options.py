"""The options that several commands share, with their help."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Group, Parameter

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
            help="Write the result to a file: .csv (a table), .json, or .nc (NetCDF, with shapes).",
            group=_output,
        ),
    ] = None
    plot: Annotated[
        Path | None,
        Parameter(help="Draw the result: .png, .svg or .pdf.", group=_output),
    ] = None
