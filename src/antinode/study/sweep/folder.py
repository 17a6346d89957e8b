"""The folder of a store: made whole or not at all, told from others, removed, opened to read."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.errors import InputError
from antinode.extras import import_extra

from .contents import Coordinate, Output, labelled
from .lock import cannot_write

if TYPE_CHECKING:
    import xarray

_KEYS = {
    "store_format": "of another version of antinode",
    "antinode_version": "of another version of antinode",
    "case_hash": "of another case",
    "study_hash": "of another study",
}


def import_store() -> Any:
    """Return zarr; raise InputError if a library of the `sweep` extra is not installed."""
    import_extra("xarray", "sweep")
    return import_extra("zarr", "sweep")


def create(
    path: Path,
    outputs: Mapping[str, Output],
    fixed: Mapping[str, Coordinate],
    attrs: Mapping[str, Any],
    chunk: int,
) -> None:
    """Make an empty store: all or nothing appears at `path`.

    Parameters
    ----------
    path : Path
    outputs : mapping
        What is written chunk by chunk.
    fixed : mapping
        Coordinates that are known.
    attrs : mapping
        Of the group.
    chunk : int
        Cases in a chunk.

    Raises
    ------
    InputError
        If the folder cannot be written.
    """
    zarr = import_store()
    partial = path.with_name(f".{path.name}.partial")
    try:
        shutil.rmtree(partial, ignore_errors=True)
        group = zarr.open_group(partial, mode="w", zarr_format=3, attributes=dict(attrs))
        for name, output in outputs.items():
            _add_output(group, name, output, chunk)
        for name, coordinate in fixed.items():
            _add_coordinate(group, name, coordinate)
        _add_checksum(group, -(-attrs["cases"] // chunk) + 1)
        partial.rename(path)
    except OSError as error:
        shutil.rmtree(partial, ignore_errors=True)
        raise InputError(cannot_write(path, error)) from error


def _add_output(group: Any, name: str, output: Output, chunk: int) -> None:
    group.create_array(
        name,
        shape=output.shape,
        chunks=(min(chunk, output.shape[0]), *output.shape[1:]),
        dtype=output.dtype,
        fill_value=np.nan if output.dtype.startswith("f") else -1,
        dimension_names=output.dims,
        attributes=output.attrs,
    )


def _add_coordinate(group: Any, name: str, coordinate: Coordinate) -> None:
    array = group.create_array(
        name,
        shape=coordinate.values.shape,
        dtype=coordinate.values.dtype,
        chunks=coordinate.values.shape,
        dimension_names=(coordinate.dim,),
        attributes=coordinate.attrs,
    )
    array[:] = coordinate.values


def _add_checksum(group: Any, number: int) -> None:
    group.create_array(
        "checksum",
        shape=(number,),
        chunks=(1,),
        dtype="uint64",
        fill_value=0,
        dimension_names=("chunk",),
        attributes={"long_name": "of the data of each chunk; 0 until they are there"},
    )


def check_same(path: Path, attrs: Mapping[str, Any]) -> None:
    """Refuse a folder that is no store, or that of another case, study or version.

    Raises
    ------
    InputError
    """
    zarr = import_store()
    try:
        found = dict(zarr.open_group(path, mode="r").attrs)
    except Exception as error:  # zarr has errors of its own for what is no group
        raise InputError(
            f"{path} exists already and is no store of a sweep; name another"
        ) from error
    if "store_format" not in found:
        raise InputError(f"{path} exists already and is no store of a sweep; name another")
    for key, words in _KEYS.items():
        if found.get(key) != attrs[key]:
            detail = ""
            if key == "antinode_version":
                detail = f" ({found.get(key)}, this is {attrs[key]})"
            raise InputError(
                f"{path} is the store {words}{detail}; name another store, or add --overwrite to "
                "replace it"
            )


def remove(path: Path) -> None:
    """Remove a store; refuse to remove anything else."""
    zarr = import_store()
    try:
        found = dict(zarr.open_group(path, mode="r").attrs)
    except Exception as error:
        raise InputError(f"{path} is no store of a sweep and is kept; name another") from error
    if "store_format" not in found:
        raise InputError(f"{path} is no store of a sweep and is kept; name another")
    try:
        shutil.rmtree(path)
    except OSError as error:
        raise InputError(cannot_write(path, error)) from error


def open_store(path: str | Path) -> xarray.Dataset:
    """Open a store as a Dataset; values are read when they are used.

    Raises
    ------
    InputError
        If it is no store of a sweep.
    """
    import_store()
    import xarray

    try:
        dataset = xarray.open_zarr(path, consolidated=False, chunks=None)
    except Exception as error:
        raise InputError(f"{path}: this is no store of a sweep; check the path") from error
    if "store_format" not in dataset.attrs:
        raise InputError(f"{path}: this is no store of a sweep; check the path")
    return labelled(dataset)
