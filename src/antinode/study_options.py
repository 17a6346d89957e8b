"""The options of the commands that run studies, with their help."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Group, Parameter

from .options import Json, _whole

_input = Group("Input", sort_key=1)
_work = Group("Work", sort_key=2)
_output = Group("Output", sort_key=3)

StudySet = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        help="Override a key of the study file: --set design.number=4096 (repeatable).",
        negative="",
        show_default=False,
        group=_input,
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class Sweep:
    """Where a sweep is computed, and where it goes."""

    modes: Annotated[
        int | None,
        Parameter(
            converter=_whole,
            help="Modes of each family, up to 100; default: the file's, or 6.",
            group=_work,
        ),
    ] = None
    output: Annotated[
        Path | None,
        Parameter(
            name=["-o", "--output"],
            help="Folder of a store, such as sweep.zarr, with which a later run goes on; or a file "
            "(.nc, .csv) that is written at the end.",
            group=_output,
        ),
    ] = None
    workers: Annotated[
        int | None,
        Parameter(
            converter=_whole,
            help="Processes; default: one for each processor, or this one alone for a small study.",
            group=_work,
        ),
    ] = None
    scheduler: Annotated[
        str | None,
        Parameter(
            help="Address of a Dask scheduler, tcp://host:8786, whose workers compute.", group=_work
        ),
    ] = None
    plot: Annotated[
        Path | None,
        Parameter(
            help="Draw frequencies against the first input: .png, .svg or .pdf.", group=_output
        ),
    ] = None
    overwrite: Annotated[
        bool,
        Parameter(
            help="Replace a store of another study.", negative="", show_default=False, group=_output
        ),
    ] = False
    json: Json = False

    def assignments(self, given: tuple[str, ...]) -> tuple[str, ...]:
        """Return the overrides of the study file, the number of modes among them."""
        return given if self.modes is None else (*given, f"solve.modes={self.modes}")


@Parameter(name="*")
@dataclass(frozen=True)
class Sensitivity:
    """What is uncertain, how it is sampled, and where the result goes."""

    uncertain: Annotated[
        tuple[str, ...],
        Parameter(
            help="An uncertain input with its standard deviation, normal about the case's value: "
            "--uncertain speed=2% --uncertain thrust=3kN (repeatable).",
            negative="",
            show_default=False,
            group=_input,
        ),
    ] = ()
    samples: Annotated[
        int | None,
        Parameter(
            converter=_whole,
            help="Samples of each arrangement, best a power of 2; default: design.number, or 1024.",
            group=_work,
        ),
    ] = None
    workers: Annotated[
        int | None, Parameter(converter=_whole, help="Processes; default: 1.", group=_work)
    ] = None
    store: Annotated[
        Path | None,
        Parameter(help="Folder that keeps all cases, as -o of sweep does.", group=_output),
    ] = None
    plot: Annotated[
        Path | None,
        Parameter(help="Draw a tornado of indices: .png, .svg or .pdf.", group=_output),
    ] = None
    json: Json = False
