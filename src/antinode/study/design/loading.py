"""A study file read with what it names: the case or the beam, a table of cases, a response."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from antinode.beam.file import TABLES, BeamFile, load_beam
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.reading import read_beside_case, read_toml
from antinode.vehicle.case import Case, load_case

from .file import Choices, Study, StudyFile, StudyInput
from .points import check_table
from .response import read_response
from .table import open_table


def load_study(path: str | Path, assignments: Iterable[str] = ()) -> Study:
    """Read a study file with its case.

    Parameters
    ----------
    path : str or Path
        A TOML file.
    assignments : iterable of str
        Overrides of the study file such as ``"design.number=4096"``.

    Raises
    ------
    InputError
        If anything in it is wrong.
    """
    path = Path(path)
    tables, where = read_beside_case(path, assignments, "a study file")
    file = validate(StudyFile, tables, where)
    kept: dict[str, Any] = {
        field.alias or name: getattr(file, name) for name, field in Choices.model_fields.items()
    }
    if "outputs" not in file.model_fields_set:
        del kept["outputs"]
    if file.design.table is not None:
        if file.inputs or file.design.kind != "zip":
            say = "leave out [[inputs]], and write kind = 'zip'"
            raise InputError(f"{where}: design.table stands for all inputs; {say}")
        table = open_table(path.parent / file.design.table)
        kept["inputs"] = tuple(StudyInput(key=key) for key in table.names)
        kept["table"] = table
    case = load_subject(path.parent / file.case)
    if file.response is not None:
        kept["response"] = read_response(path.parent / file.response, path.parent / file.case)
    study = Study(case=case, **kept)
    check_table(study)
    return study


def load_subject(path: Path, assignments: Iterable[str] = ()) -> Case | BeamFile:
    """Read what a study varies something in: the case of a vehicle, or a beam file."""
    tables = {"beam": {}} if path.suffix.lower() in TABLES else read_toml(path)
    if "beam" in tables and "vehicle" not in tables:
        return load_beam(path, assignments)
    return load_case(path, assignments)
