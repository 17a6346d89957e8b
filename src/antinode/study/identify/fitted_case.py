"""A case written as files: TOML with its stations as CSV beside it, ready to run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from antinode.errors import InputError
from antinode.vehicle.case import Case
from antinode.vehicle.options import Model
from antinode.vehicle.vehicle import Stations
from antinode.whole import put

from .result import Identification
from .tables import comparison_csv, parameter_csv

FILES = (
    "case.toml",
    "stations.csv",
    "observed_and_fitted.csv",
    "parameters.csv",
    "identification.json",
)


def check_folder(folder: Path, *, overwrite: bool) -> None:
    """Refuse a folder that cannot take the files, before any work is done.

    Raises
    ------
    InputError
        If a file exists already, or the folder is none.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: this is no folder; name another one for the results")
    there = [name for name in FILES if (folder / name).exists()]
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
    from antinode.show.dataset import to_json

    check_folder(folder, overwrite=overwrite)
    texts = dict(
        zip(
            FILES,
            (
                case_toml(result.case, _comment(result)),
                stations_csv(result.case.vehicle.stations, result.case.vehicle.interpolation),
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


def case_toml(case: Case, comment: str = "") -> str:
    """Return a case as TOML that names its stations stations.csv.

    Parameters
    ----------
    case : Case
    comment : str
        Lines for the top of the file.
    """
    tables = case.model_dump(exclude_none=True)
    tables["vehicle"]["stations"] = "stations.csv"
    tables["model"] = {
        k: v for k, v in tables["model"].items() if v != Model.model_fields[k].default
    }
    return comment + "".join(_table(tables, ())).lstrip("\n")


def _table(table: Mapping[str, Any], path: tuple[str, ...]) -> list[str]:
    """Return the lines of a table: its own keys first, then the tables inside."""
    lines = [f"{key} = {_value(v)}\n" for key, v in table.items() if not _is_table(v)]
    head = [f"\n[{'.'.join(path)}]\n"] if path and lines else []
    lines = head + lines
    for key, inner in table.items():
        if isinstance(inner, Mapping):
            lines += _table(inner, (*path, key))
        elif _is_table(inner):
            for entry in inner:
                lines.append(f"\n[[{'.'.join((*path, key))}]]\n")
                lines += [f"{k} = {_value(v)}\n" for k, v in entry.items()]
    return lines


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) or (
        isinstance(value, list | tuple) and bool(value) and isinstance(value[0], Mapping)
    )


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, np.ndarray | list | tuple):
        return f"[{', '.join(_value(v) for v in value)}]"
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value.item() if isinstance(value, np.generic) else value)


def _text(text: str) -> str:
    """Return a TOML string."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\U{ord(c):08X}" for c in escaped) + '"'


def stations_csv(stations: Stations, interpolation: str) -> str:
    """Return a table of stations as CSV; a stepped one is closed by its last x."""
    columns = list(stations.columns())
    lines = [",".join(["x [m]", *(f"{name} [{unit}]" for name, _, unit in columns)])]
    last = len(stations.x) - 1
    for k, x in enumerate(stations.x.tolist()):
        closing = k == last and interpolation == "step"
        cells = ["" if closing else repr(float(column[k])) for _, column, _ in columns]
        lines.append(",".join([repr(x), *cells]))
    return "\n".join(lines) + "\n"
