"""A state as files to keep: the case as TOML, its results as CSV, JSON and NetCDF."""

from __future__ import annotations

import json
import math
import re
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from antinode.show.dataset import modal_table, to_json, write_result
from antinode.show.loads_table import condition_dict, loads_summary

from .compute import Picture
from .state import State, plain, with_changes

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def case_toml(state: State) -> str:
    """Return the case or beam file with all changes, its stations inside, as TOML."""
    tables = plain(with_changes(state.file.tables, state.changes))
    head = f"# {state.file.origin}, saved by antinode app. Numbers are SI, angles in radians.\n"
    return head + "".join(_table(tables, ()))


def _table(table: Mapping[str, Any], path: tuple[str, ...]) -> list[str]:
    """Return the lines of a table: its own keys, then the tables inside."""
    own = [f"{_key(k)} = {_value(v)}\n" for k, v in table.items() if not _is_tables(v)]
    head = [f"\n[{'.'.join(map(_key, path))}]\n"] if path and own else []
    lines = head + own
    for key, inner in table.items():
        inside = (*path, key)
        if isinstance(inner, Mapping):
            lines += _table(inner, inside) or [f"\n[{'.'.join(map(_key, inside))}]\n"]
        elif _is_tables(inner):
            for entry in inner:
                lines += [f"\n[[{'.'.join(map(_key, inside))}]]\n"]
                lines += [f"{_key(k)} = {_value(v)}\n" for k, v in entry.items()]
    return lines


def _is_tables(value: Any) -> bool:
    """Tell whether a value stands below its table's own keys: a table, or a list of tables."""
    listed = isinstance(value, list) and bool(value)
    return isinstance(value, Mapping) or (listed and all(isinstance(v, Mapping) for v in value))


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _value(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=True)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)


_one_report = threading.Lock()


def report_file(state: State, ending: str) -> bytes:
    """Return the report on a state, .html or .pdf, as `antinode report` writes it.

    Raises
    ------
    AntinodeError
        If the input is wrong, or a library for it is not installed.
    """
    from antinode.report.command import make_report, write_report
    from antinode.report.extras import check_libraries

    with tempfile.TemporaryDirectory() as folder, _one_report:
        source = Path(folder) / ("case.toml" if state.is_vehicle else "beam.toml")
        output = Path(folder) / f"report{ending}"
        check_libraries(output)
        source.write_text(case_toml(state), encoding="utf-8")
        document, _ = make_report(source)
        write_report(document, output)
        return output.read_bytes()


def result_file(picture: Picture, ending: str) -> bytes:
    """Return a full result as a file: .csv, .json or .nc, as the command line writes it.

    Raises
    ------
    InputError
        If a library for it is not installed.
    """
    result = picture.full
    assert result is not None
    data = result.to_dict()
    if picture.case is not None:
        data["condition"] = condition_dict(picture.case)
        data["loads"] = loads_summary(picture.case)
        data["warnings"] = picture.warnings
    if ending == ".csv":
        return modal_table(result).encode()
    if ending == ".json":
        return (to_json(data) + "\n").encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"result{ending}"
        write_result(path, data, lambda: modal_table(result), result.to_dataset)
        return path.read_bytes()
