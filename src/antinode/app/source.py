"""Where a page gets its file: a path of the command line, an example, files dropped on the page.

A dropped case may name its table of stations only if that table is dropped with it: nothing that a
browser sends makes the server read a file of its own.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path, PurePath

from antinode.beam.file import ALL_COLUMNS as BEAM_COLUMNS
from antinode.errors import AntinodeError, InputError
from antinode.examples import EXAMPLES, write_example
from antinode.inputs.reading import read_tables, read_toml, toml_source
from antinode.vehicle.case import COLUMNS as CASE_COLUMNS

from .state import File, State

MOST_BYTES = 20_000_000
"""Largest upload, all files together."""
_MOST_FILES = 10


def read_file(path: Path, assignments: Iterable[str] = (), *, own: bool = True) -> File:
    """Read a case or beam file with its table of stations.

    Raises
    ------
    InputError
        If anything in it is wrong.
    """
    first = read_toml(path)
    table = "beam" if "beam" in first and "vehicle" not in first else "vehicle"
    columns = BEAM_COLUMNS if table == "beam" else CASE_COLUMNS
    tables = read_tables(path, assignments, table, columns).tables
    file = File(tables, path.name, own, toml_source(path))
    _ = State(file).problem
    return file


def read_example(name: str) -> File:
    """Read one of the examples that `antinode init` writes."""
    if name not in EXAMPLES:
        raise InputError(f"there is no example '{name[:40]}'; allowed are {', '.join(EXAMPLES)}")
    with tempfile.TemporaryDirectory() as folder:
        written, _ = write_example(name, Path(folder))
        path = next(file for file in written if file.suffix == ".toml")
        return replace(read_file(path, own=False), origin=f"{name}.toml")


def read_dropped(files: Mapping[str, bytes]) -> File:
    """Read a case or beam file from what was dropped on the page: TOML, and CSV beside it.

    Parameters
    ----------
    files : mapping
        Contents by name.

    Raises
    ------
    InputError
        If there is not one TOML file, it names a file that was not dropped, or is wrong.
    """
    contents = {PurePath(name.replace("\\", "/")).name: data for name, data in files.items()}
    tomls = [name for name in contents if name.lower().endswith(".toml")]
    if len(tomls) != 1 or len(contents) > _MOST_FILES:
        names = ", ".join(sorted(contents))[:100]
        raise InputError(
            f"received {names or 'no file'}; drop one TOML file, with its CSV table if it has one"
        )
    if sum(map(len, contents.values())) > MOST_BYTES:
        raise InputError(f"the files are larger than {MOST_BYTES / 1e6:g} MB; drop smaller ones")
    with tempfile.TemporaryDirectory() as folder:
        try:
            return _from_folder(Path(folder), contents, tomls[0])
        except AntinodeError as error:
            raise type(error)(str(error).replace(f"{folder}/", "")) from error


def _from_folder(folder: Path, contents: Mapping[str, bytes], name: str) -> File:
    for each, data in contents.items():
        (folder / each).write_bytes(data)
    tables = read_toml(folder / name)
    for key in ("vehicle", "beam"):
        inner = tables.get(key)
        stations = inner.get("stations") if isinstance(inner, dict) else None
        if isinstance(stations, str) and stations not in contents:
            raise InputError(
                f"{name}: {key}.stations is '{stations[:60]}', which was not dropped with it; "
                "drop both files together"
            )
    return read_file(folder / name, own=False)
