"""The options of the commands that run studies, with their help."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .options import INPUT, OUTPUT, WORK, Json, assignments, flag, option, whole

StudySet = Annotated[tuple[str, ...], assignments("study file", "--set design.number=4096")]
IdentifySet = Annotated[tuple[str, ...], assignments("identification file", "--set fit.starts=8")]
Folder = Annotated[
    Path | None,
    option(OUTPUT, "Write the fitted case, tables and JSON into this folder.", "-o", "--output"),
]
Overwrite = Annotated[bool, flag(OUTPUT, "Write over files of an earlier run.", "--overwrite")]


@Parameter(name="*")
@dataclass(frozen=True)
class Sweep:
    """Where a sweep is computed, and where it goes."""

    modes: Annotated[
        int | None,
        whole(WORK, "Modes of each family, up to 100; default: the file's, or 6."),
    ] = None
    output: Annotated[
        Path | None,
        option(
            OUTPUT,
            "Folder of a store, such as sweep.zarr, with which a later run goes on; or a file "
            "(.nc, .csv) that is written at the end.",
            "-o",
            "--output",
        ),
    ] = None
    workers: Annotated[
        int | None,
        whole(
            WORK,
            "Processes; default: one for each processor, or this one alone for a small study.",
        ),
    ] = None
    scheduler: Annotated[
        str | None,
        option(WORK, "Address of a Dask scheduler, tcp://host:8786, whose workers compute."),
    ] = None
    plot: Annotated[
        Path | None,
        option(OUTPUT, "Draw frequencies against the first input: .png, .svg or .pdf."),
    ] = None
    overwrite: Annotated[bool, flag(OUTPUT, "Replace a store of another study.")] = False
    json: Json = False


@Parameter(name="*")
@dataclass(frozen=True)
class Ask:
    """What is asked of the cases, and where the answers go."""

    where: Annotated[
        str | None,
        option(INPUT, "Ask only cases in which this holds: --where 'speed < 100 and f1 > 2'."),
    ] = None
    define: Annotated[
        tuple[str, ...],
        flag(INPUT, "A formula with a name: --define 'gap = f2 - f1' (repeatable)."),
    ] = ()
    share: Annotated[
        tuple[str, ...],
        flag(WORK, "The share of cases in which this holds: --share 'f1 > 5' (repeatable)."),
    ] = ()
    smallest: Annotated[
        tuple[str, ...],
        flag(WORK, "The cases in which this is smallest, with their inputs (repeatable)."),
    ] = ()
    largest: Annotated[
        tuple[str, ...],
        flag(WORK, "The cases in which this is largest, with their inputs (repeatable)."),
    ] = ()
    quantiles: Annotated[
        tuple[str, ...],
        flag(WORK, "A table of how this is spread over the cases (repeatable)."),
    ] = ()
    number: Annotated[int, whole(WORK, "Of smallest and largest cases.")] = 5
    search: Annotated[
        bool,
        flag(WORK, "Also look for smaller or larger ones inside the bounds of a study file."),
    ] = False
    map: Annotated[
        str | None,
        option(OUTPUT, "Two axes and what --plot draws over them: --map 'speed, thrust, f1'."),
    ] = None
    plot: Annotated[Path | None, option(OUTPUT, "Draw the map: .png, .svg or .pdf.")] = None
    output: Annotated[
        Path | None,
        option(OUTPUT, "Write all cases as a table: .csv or .parquet.", "-o", "--output"),
    ] = None
    json: Json = False


@Parameter(name="*")
@dataclass(frozen=True)
class Sensitivity:
    """What is uncertain, how it is sampled, and where the result goes."""

    uncertain: Annotated[
        tuple[str, ...],
        flag(
            INPUT,
            "An uncertain input with its standard deviation, normal about the case's value: "
            "--uncertain speed=2% --uncertain thrust=3kN (repeatable).",
        ),
    ] = ()
    samples: Annotated[
        int | None,
        whole(
            WORK,
            "Samples of each arrangement, best a power of 2; default: design.number, or 1024.",
        ),
    ] = None
    workers: Annotated[int | None, whole(WORK, "Processes; default: 1.")] = None
    scheduler: Annotated[
        str | None,
        option(WORK, "Address of a Dask scheduler, tcp://host:8786, whose workers compute."),
    ] = None
    store: Annotated[
        Path | None,
        option(OUTPUT, "Folder that keeps all cases, as -o of sweep does."),
    ] = None
    overwrite: Annotated[bool, flag(OUTPUT, "Replace a store of another study.")] = False
    plot: Annotated[
        Path | None, option(OUTPUT, "Draw a tornado of indices: .png, .svg or .pdf.")
    ] = None
    json: Json = False
