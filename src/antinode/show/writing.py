"""Results as files, whole or not at all: names are checked before any work is done."""

from __future__ import annotations

import errno
import json
import math
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.text import short
from antinode.whole import write_file

if TYPE_CHECKING:
    import xarray


def to_json(data: object) -> str:
    """Return strict JSON of a result's dictionary: null stands for NaN and infinity."""
    return json.dumps(_plain(data), indent=2, allow_nan=False)


def _plain(value: object) -> object:
    """Return a value of Python's own types that JSON has, recursively."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_result(
    path: Path,
    data: dict[str, Any],
    table: Callable[[], str],
    dataset: Callable[[], xarray.Dataset],
    kind: str = "",
) -> None:
    """Write a result as .json, .csv or .nc, whole or not at all; `kind` stands for the ending.

    Raises
    ------
    InputError
        If the ending is another, the file cannot be written, or a library for it is not installed.
    """
    writers: dict[str, Callable[[Path], None]] = {
        ".json": lambda p: write_text(p, to_json(data) + "\n"),
        ".csv": lambda p: write_text(p, table()),
        ".nc": lambda p: _write_netcdf(p, dataset()),
    }
    if not kind:
        check_output(path, ENDINGS)
    write_whole(path, writers[kind or path.suffix.lower()])


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file whole or not at all, by a function that writes it under another name.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    try:
        write_file(path, write)
    except OSError as error:
        raise InputError(_cannot_write(path, error)) from error


ENDINGS = (".csv", ".json", ".nc")


def check_output(path: Path, endings: Iterable[str]) -> None:
    """Raise InputError if a file of this name cannot be written, before any work is done."""
    if path.suffix.lower() not in endings:
        allowed = ", ".join(endings)
        raise InputError(f"{path}: the ending says what to write; allowed are {allowed}")
    try:
        folder, exists = path.is_dir(), path.exists()
        if not folder and not path.parent.is_dir():
            raise InputError(f"{path}: there is no folder {path.parent}; make it, or name another")
        if not folder and not os.access(path if exists else path.parent, os.W_OK):
            raise PermissionError(errno.EACCES, "Permission denied")
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(_cannot_write(path, error)) from error
    if folder:
        raise InputError(f"{path}: this is a folder; name a file in it")
    if path.suffix.lower() == ".nc":
        for module in ("xarray", "h5netcdf"):
            import_extra(module, "dataset")
    if path.is_file() and path.suffix.lower() == ".csv" and _is_station_table(path):
        raise InputError(f"{path}: this is a table of stations, an input; name another file")


def _cannot_write(path: Path, error: Exception) -> str:
    reason = (getattr(error, "strerror", None) or str(error)).partition(" (")[0]
    return f"{short(str(path))} cannot be written ({reason}); name another file or folder"


def _is_station_table(path: Path) -> bool:
    """Tell whether a CSV file is an input, which must not be overwritten."""
    with path.open(encoding="utf-8", errors="replace") as file:
        return "mass_per_length" in file.read(10_000)


def write_text(path: Path, text: str) -> None:
    """Write a text in UTF-8."""
    path.write_text(text, encoding="utf-8")


def _write_netcdf(path: Path, dataset: xarray.Dataset) -> None:
    dataset.to_netcdf(path, engine="h5netcdf")
