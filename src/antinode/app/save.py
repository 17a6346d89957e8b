"""A state as files to keep: the case as TOML, its results as CSV, JSON and NetCDF."""

from __future__ import annotations

import tempfile
import threading
import tomllib
from pathlib import Path

from antinode.inputs.toml_writing import toml_text, with_values
from antinode.show.loads_table import modes_dict
from antinode.show.tables import modal_table
from antinode.show.writing import to_json, write_result

from .compute import Answer
from .state import State, with_changes


def case_toml(state: State) -> str:
    """Return the case or beam file with all changes, its stations inside, its comments kept."""
    file = state.file
    tables = with_changes(file.tables, state.changes)
    if file.text:
        return with_values(file.text, tomllib.loads(file.text), tables)
    head = f"# {file.origin}, saved by antinode app. Numbers are SI, angles in radians.\n\n"
    return head + toml_text(tables)


_one_report = threading.Lock()


def report_file(state: State, ending: str) -> bytes:
    """Return the report on a state, .html or .pdf, as `antinode report` writes it.

    Raises
    ------
    AntinodeError
        If the input is wrong, or a library for it is not installed.
    """
    from antinode.report.command import make_report, write_report
    from antinode.report.formats import check_libraries

    with tempfile.TemporaryDirectory() as folder, _one_report:
        source = Path(folder) / ("case.toml" if state.is_vehicle else "beam.toml")
        output = Path(folder) / f"report{ending}"
        check_libraries(output)
        source.write_text(case_toml(state), encoding="utf-8")
        document, _ = make_report(source)
        write_report(document, output)
        return output.read_bytes()


def result_file(answer: Answer, ending: str) -> bytes:
    """Return a full result as a file: .csv, .json or .nc, as the command line writes it.

    Raises
    ------
    InputError
        If a library for it is not installed.
    """
    result = answer.full
    assert result is not None
    data = result.to_dict() if answer.case is None else modes_dict(answer.case, result)
    if ending == ".csv":
        return modal_table(result).encode()
    if ending == ".json":
        return (to_json(data) + "\n").encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"result{ending}"
        write_result(path, data, lambda: modal_table(result), result.to_dataset)
        return path.read_bytes()
