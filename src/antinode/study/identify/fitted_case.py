"""A case or a beam written as files: TOML with its stations as CSV beside it, ready to run."""

from __future__ import annotations

import tomllib
from contextlib import suppress
from pathlib import Path
from typing import Any

from antinode.arrays import Array
from antinode.beam.file import ALL_COLUMNS, BeamFile
from antinode.errors import InputError
from antinode.inputs.reading import COLUMN_UNITS
from antinode.inputs.toml_writing import toml_text, with_values
from antinode.study.design.subject import Given, subject_of
from antinode.vehicle.options import Model
from antinode.whole import put

from .result import Identification
from .tables import comparison_csv, parameter_csv

STATIONS = "stations.csv"
TABLES = "observed_and_fitted.csv", "parameters.csv", "identification.json"


def file_names(case: Given) -> tuple[str, ...]:
    """Return the names of the files that are written."""
    return ("beam.toml" if isinstance(case, BeamFile) else "case.toml", STATIONS, *TABLES)


def check_folder(folder: Path, case: Given, *, overwrite: bool) -> None:
    """Refuse a folder that cannot take the files, before any work is done.

    Raises
    ------
    InputError
        If a file exists already, or the folder is none.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: this is no folder; name another one for the results")
    there = [name for name in file_names(case) if (folder / name).exists()]
    if there and not overwrite:
        raise InputError(
            f"{folder / there[0]} exists already and is kept; name another folder, or add "
            "--overwrite"
        )


def write_identification(
    result: Identification, folder: Path, *, overwrite: bool = False
) -> list[Path]:
    """Write the fitted case, the tables and the JSON of an identification into a folder.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        If a file exists already, or the folder cannot be written.
    """
    from antinode.show.writing import to_json

    check_folder(folder, result.case, overwrite=overwrite)
    texts = dict(
        zip(
            file_names(result.case),
            (
                case_toml(
                    result.case, _comment(result), result.problem.case, result.problem.case_text
                ),
                stations_csv(result.case),
                comparison_csv(result),
                parameter_csv(result),
                to_json(result.to_dict()) + "\n",
            ),
            strict=True,
        )
    )
    written: list[Path] = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            partial = folder / f".{name}.partial"
            partial.write_text(text, encoding="utf-8")
            written.append(partial)
        for partial in written:
            put(partial, folder / partial.name[1 : -len(".partial")])
    except OSError as error:
        for partial in written:
            with suppress(OSError):
                partial.unlink(missing_ok=True)
        raise InputError(f"{folder} cannot be written ({error.strerror}); name another") from error
    return [folder / name for name in texts]


def _comment(result: Identification) -> str:
    state = (
        "the best values so far of an interrupted identification"
        if result.interrupted
        else ("identified from observed frequencies")
    )
    return (
        f"# {state}: {len(result.comparisons)} frequencies in {len(result.problem.observations)} "
        f"rows, rms difference {result.rms_relative:.2e}, worst {result.worst_relative:.2e}.\n"
        "# Numbers are SI, angles in radians. parameters.csv has the standard deviations.\n"
    )


def case_toml(case: Given, comment: str = "", start: Given | None = None, text: str = "") -> str:
    """Return a case or a beam as TOML that names its stations stations.csv.

    Parameters
    ----------
    case : Case or BeamFile
    comment : str
        Lines for the top of the file.
    start : Case or BeamFile, optional
        The case that it began with.
    text : str
        The file of that one: what did not change stays as it is written there.
    """
    if start is None or not text:
        return f"{comment}\n{toml_text(_tables(case, STATIONS))}"
    of = "beam" if isinstance(case, BeamFile) else "vehicle"
    before = _tables(start, tomllib.loads(text)[of]["stations"])
    return f"{comment}\n{with_values(text, before, _tables(case, STATIONS))}"


def _tables(case: Given, stations: Any) -> dict[str, Any]:
    """Return a case as the tables of its file; choices of the model only where they are made."""
    if isinstance(case, BeamFile):
        table = case.table.model_dump(exclude_none=True)
        said = {k: v for k, v in table.items() if not isinstance(v, tuple) or v}
        return {"beam": said | {"stations": stations}}
    tables = case.model_dump(exclude_none=True)
    tables["vehicle"]["stations"] = stations
    tables["model"] = {
        k: v for k, v in tables["model"].items() if v != Model.model_fields[k].default
    }
    return tables


def stations_csv(case: Given) -> str:
    """Return the stations of a case or a beam as CSV; a stepped table is closed by its last x."""
    subject = subject_of(case)
    columns = _columns(case)
    lines = [",".join(["x [m]", *(_heading(name, unit) for name, _, unit in columns)])]
    last = len(subject.x) - 1
    for k, x in enumerate(subject.x.tolist()):
        closing = k == last and subject.interpolation == "step"
        cells = ["" if closing else repr(float(column[k])) for _, column, _ in columns]
        lines.append(",".join([repr(x), *cells]))
    return "\n".join(lines) + "\n"


def _columns(case: Given) -> list[tuple[str, Array, str]]:
    """Return name, values and unit of the columns of stations."""
    if not isinstance(case, BeamFile):
        return list(case.vehicle.stations.columns())
    given = case.table.stations.given(ALL_COLUMNS[1:])
    return [(name, column, COLUMN_UNITS[name]) for name, column in given.items()]


def _heading(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name
