"""Results as labelled arrays with units (xarray), and as files: CSV, JSON, NetCDF."""

from __future__ import annotations

import csv
import errno
import io
import json
import math
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode import __version__
from antinode.beam.families import FAMILIES
from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.modes.result import ModalResult, Mode
from antinode.text import short
from antinode.whole import write_file

if TYPE_CHECKING:
    import xarray

_SCALARS: tuple[tuple[str, str, str], ...] = (
    ("frequency_hz", "Hz", "natural frequency; NaN where divergent"),
    ("error_hz", "Hz", "the frequency of the beam lies within this of frequency_hz"),
    ("omega2", "rad^2/s^2", "eigenvalue"),
    ("error_omega2", "rad^2/s^2", "bound on the error of omega2"),
    ("growth_rate_per_s", "1/s", "growth rate of a divergent mode; NaN where omega2 >= 0"),
    ("modal_mass", "kg", "integral of m Y^2 of the shape as normalised"),
    ("shift", "1", "relative change of the frequency by the axial force"),
    ("model_error", "1", "first-order relative effect of shear and rotary inertia"),
)


def modal_dataset(result: ModalResult) -> xarray.Dataset:
    """Return a modal result as a Dataset over modes and position.

    Raises
    ------
    InputError
        If xarray is not installed.
    """
    xr = import_extra("xarray", "dataset")
    modes = result.modes
    data: dict[str, Any] = {
        name: ("mode", [_nan(getattr(m, name)) for m in modes], {"units": unit, "long_name": text})
        for name, unit, text in _SCALARS
    }
    data["family"] = ("mode", [m.family for m in modes])
    data["number"] = ("mode", [m.number for m in modes], {"long_name": "0 for rigid modes"})
    data["kind"] = ("mode", [m.kind for m in modes])
    data["bracket_omega2"] = (
        ("mode", "bound"),
        [m.bracket_omega2 for m in modes],
        {"units": "rad^2/s^2", "long_name": "encloses the eigenvalue of the segment chain"},
    )
    data["counts"] = (
        ("mode", "bound"),
        [m.counts for m in modes],
        {"units": "1", "long_name": "eigenvalues below either end of the bracket"},
    )
    for family in result.families:
        for i, (symbol, unit, text) in enumerate(FAMILIES[family].quantities):
            shapes = np.array([_component(m, family, i, len(result.x)) for m in modes])
            data[symbol] = (("mode", "x"), shapes, {"units": unit, "long_name": text})
    coordinates = {
        "mode": [m.name for m in modes],
        "x": ("x", result.x, {"units": "m", "long_name": "position from the left end (nose)"}),
        "bound": ["low", "high"],
    }
    dataset: xarray.Dataset = xr.Dataset(data, coordinates, attrs=_attributes(result))
    return dataset


def _component(mode: Mode, family: str, index: int, points: int) -> Any:
    return mode.states[:, index] if mode.family == family else np.full(points, np.nan)


def _attributes(result: ModalResult) -> dict[str, Any]:
    return {
        "title": f"Natural modes of {result.beam.name}",
        "source": f"antinode {__version__}",
        "method": result.method,
        "tolerance": result.tolerance,
        "normalisation": result.normalisation,
        "warnings": "\n".join(result.warnings),
    }


def _nan(value: float | None) -> float:
    return math.nan if value is None else value


def modal_table(result: ModalResult) -> str:
    """Return the modes as CSV with units in the header, one row a mode."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    units = ["" if unit == "1" else f" [{unit}]" for _, unit, _ in _SCALARS]
    header = [name + unit for (name, _, _), unit in zip(_SCALARS, units, strict=True)]
    writer.writerow(["family", "number", "name", "kind", *header])
    for m in result.modes:
        values = [_nan(getattr(m, name)) for name, _, _ in _SCALARS]
        cells = ["" if math.isnan(v) else repr(float(v)) for v in values]
        writer.writerow([m.family, m.number, m.name, m.kind, *cells])
    return out.getvalue()


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


def write_whole(path: Path, write: Callable[[Path], None]) -> None:
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
