"""The store of a sweep: a zarr v3 group on disk that a kill at any moment cannot hurt.

Every variable is an array over cases, cut where the study cuts its chunks; `checksum` has a number
for each chunk, written after its data, and 0 until then. What a checksum does not confirm is
computed again. One run at a time holds the lock.
"""

from __future__ import annotations

import errno
import hashlib
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.errors import ComputationError, InputError
from antinode.extras import import_extra
from antinode.text import short

if TYPE_CHECKING:
    import xarray

FORMAT = 1
TIMESTAMPS = ("created", "finished")
"""Attributes that differ from run to run."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
_KEYS = {
    "antinode_version": "of another version of antinode",
    "case_hash": "of another case",
    "study_hash": "of another study",
}


class Variable(NamedTuple):
    """A variable of the result.

    Attributes
    ----------
    dims : tuple of str
        "case" first.
    shape : tuple of int
    dtype : str
    attrs : dict
        Units and meaning.
    """

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    dtype: str
    attrs: dict[str, Any]


def import_store() -> Any:
    """Return zarr; raise InputError if a library of the `sweep` extra is not installed."""
    import_extra("xarray", "sweep")
    return import_extra("zarr", "sweep")


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock of a store; it goes with the process, however that ends.

    Raises
    ------
    InputError
        If another run holds it, or the folder cannot be written.
    """
    file = path.with_name(f".{path.name}.lock")
    try:
        handle = file.open("a")
    except OSError as error:
        raise InputError(cannot_write(path, error)) from error
    try:
        if not _take(handle.fileno()) or not _is_same(handle.fileno(), file):
            raise InputError(
                f"{path}: another run works on this store; wait until it ends, or name another"
            )
        try:
            yield
        finally:
            with suppress(OSError):
                file.unlink()
    finally:
        handle.close()


def _take(handle: int) -> bool:
    """Take the lock if it is free."""
    try:
        import fcntl
    except ImportError:  # Windows
        import msvcrt

        windows: Any = msvcrt
        try:
            windows.locking(handle, windows.LK_NBLCK, 1)
        except OSError:
            return False
        return True
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _is_same(handle: int, file: Path) -> bool:
    """Tell whether the lock is that of the file which is there now."""
    try:
        return os.fstat(handle).st_ino == file.stat().st_ino
    except OSError:
        return False


def cannot_write(path: Path, error: OSError) -> str:
    """Say why a store cannot be written."""
    reason = error.strerror or str(error)
    return f"{short(str(path))} cannot be written ({reason}); name another folder"


class Store:
    """A store that is open for writing.

    Parameters
    ----------
    path : Path
    chunk : int
        Cases in a chunk.
    cases : int
    """

    def __init__(self, path: Path, chunk: int, cases: int) -> None:
        self.path, self.chunk, self.cases = path, chunk, cases
        self.group = import_store().open_group(path, mode="r+")

    @property
    def chunks(self) -> int:
        """Number of chunks; a last entry of `checksum` stands for what comes after them."""
        return -(-self.cases // self.chunk)

    def write(self, chunk: int, arrays: Mapping[str, npt.NDArray[Any]]) -> None:
        """Write a chunk: first its data, then its checksum.

        Raises
        ------
        ComputationError
            If the disk is full, or fails.
        """
        start, stop = self._bounds(chunk)
        with self._failing():
            for name, values in arrays.items():
                self.group[name][start:stop] = values
            self.group["checksum"][chunk] = checksum(arrays)

    def finish(self, arrays: Mapping[str, npt.NDArray[Any]], attrs: Mapping[str, Any]) -> None:
        """Write what comes after all chunks, over all cases."""
        with self._failing():
            for name, values in arrays.items():
                self.group[name][:] = values
            self.group.attrs.update(attrs)
            self.group["checksum"][self.chunks] = checksum(arrays)

    def unfinished(self, names: tuple[str, ...], after: tuple[str, ...]) -> list[int]:
        """Return the chunks that are not there, or not as they were written.

        Where all are, but not what comes `after` them, the number behind the last one.

        Raises
        ------
        InputError
            If the store has lost a variable.
        """
        self._check_arrays((*names, *after))
        wanted = self._checksums()
        left = [c for c in range(self.chunks) if not self._holds(c, int(wanted[c]), names)]
        if not left and not self._holds_after(int(wanted[self.chunks]), after):
            left.append(self.chunks)
        return left

    def _checksums(self) -> list[int]:
        """Return the checksums that can be read; 0 for those that are damaged."""
        found = []
        for chunk in range(self.chunks + 1):
            try:
                found.append(int(self.group["checksum"][chunk]))
            except Exception:  # whatever a codec says of bytes that are not its own
                found.append(0)
        return found

    def mend(self, name: str, values: npt.NDArray[Any]) -> None:
        """Write a coordinate that is known beforehand again, if it is damaged."""
        if not self._checked(checksum({name: values}), (name,), slice(None)):
            with self._failing():
                self.group[name][:] = values

    def _check_arrays(self, names: tuple[str, ...]) -> None:
        for name in (*names, "checksum"):
            try:
                fits = name == "checksum" or self.group[name].shape[0] == self.cases
            except Exception:  # zarr has errors of its own for what is missing or damaged
                fits = False
            if not fits:
                raise InputError(
                    f"{self.path}: {name} is damaged beyond repair; add --overwrite to begin anew"
                )

    def _holds(self, chunk: int, wanted: int, names: tuple[str, ...]) -> bool:
        start, stop = self._bounds(chunk)
        return wanted != 0 and self._checked(wanted, names, slice(start, stop))

    def _holds_after(self, wanted: int, names: tuple[str, ...]) -> bool:
        return wanted != 0 and self._checked(wanted, names, slice(None))

    def _checked(self, wanted: int, names: tuple[str, ...], part: slice) -> bool:
        try:
            return checksum({name: self.group[name][part] for name in names}) == wanted
        except Exception:  # whatever a codec says of bytes that are not its own
            return False

    def read(self, name: str) -> npt.NDArray[Any]:
        """Return a whole variable."""
        return np.asarray(self.group[name][:])

    def _bounds(self, chunk: int) -> tuple[int, int]:
        return chunk * self.chunk, min(self.cases, (chunk + 1) * self.chunk)

    @contextmanager
    def _failing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            wanted = self._kept()
            kept = f"{wanted} of {self.chunks} chunks are kept: "
            if error.errno in _FULL:
                raise ComputationError(
                    f"{self.path}: no space is left on the disk; {kept}make room and run the same "
                    "command again"
                ) from error
            reason = error.strerror or str(error)
            raise ComputationError(
                f"{self.path}: writing failed ({reason}); {kept}run the same command again"
            ) from error

    def _kept(self) -> int:
        with suppress(Exception):
            return int(np.count_nonzero(self._checksums()[:-1]))
        return 0


def checksum(arrays: Mapping[str, npt.NDArray[Any]]) -> int:
    """Return a number of 64 bits that stands for the arrays; never 0."""
    digest = hashlib.blake2b(digest_size=8)
    for name in sorted(arrays):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(arrays[name]).tobytes())
    return int.from_bytes(digest.digest(), "little") or 1


def create(
    path: Path,
    variables: Mapping[str, Variable],
    fixed: Mapping[str, tuple[str, npt.NDArray[Any], dict[str, Any]]],
    attrs: Mapping[str, Any],
    chunk: int,
) -> None:
    """Make an empty store: all or nothing appears at `path`.

    Parameters
    ----------
    path : Path
    variables : mapping
        What is written chunk by chunk.
    fixed : mapping
        Coordinates that are known: dimension, values, attributes.
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
        cases = 0
        for name, v in variables.items():
            cases = v.shape[0]
            empty = np.nan if v.dtype.startswith("f") else -1
            group.create_array(
                name,
                shape=v.shape,
                chunks=(min(chunk, v.shape[0]), *v.shape[1:]),
                dtype=v.dtype,
                fill_value=empty,
                dimension_names=v.dims,
                attributes=v.attrs,
            )
        for name, (dim, values, about) in fixed.items():
            array = group.create_array(
                name,
                shape=values.shape,
                dtype=values.dtype,
                chunks=values.shape,
                dimension_names=(dim,),
                attributes=about,
            )
            array[:] = values
        group.create_array(
            "checksum",
            shape=(-(-cases // chunk) + 1,),
            chunks=(1,),
            dtype="uint64",
            fill_value=0,
            dimension_names=("chunk",),
            attributes={"long_name": "of the data of each chunk; 0 until they are there"},
        )
        partial.rename(path)
    except OSError as error:
        shutil.rmtree(partial, ignore_errors=True)
        raise InputError(cannot_write(path, error)) from error


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
    if found.get("store_format") != attrs["store_format"]:
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


def remove(path: Path, attrs: Mapping[str, Any]) -> None:
    """Remove a store; refuse to remove anything else."""
    zarr = import_store()
    try:
        found = dict(zarr.open_group(path, mode="r").attrs)
    except Exception as error:
        raise InputError(f"{path} is no store of a sweep and is kept; name another") from error
    if "store_format" not in found:
        raise InputError(f"{path} is no store of a sweep and is kept; name another")
    assert attrs
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


def labelled(dataset: xarray.Dataset) -> xarray.Dataset:
    """Return the Dataset of a store with its inputs and names as coordinates."""
    names = dataset.attrs["mode_names"]
    coordinates: dict[str, Any] = {"mode": list(names)}
    if "track" in dataset.sizes:
        coordinates["track"] = list(names)
    inputs = [name for name in dataset.attrs["input_names"] if name in dataset]
    kept = dataset.drop_vars("checksum", errors="ignore")
    return kept.assign_coords(coordinates).set_coords([*inputs, *_present(kept, ("point",))])


def _present(dataset: xarray.Dataset, names: tuple[str, ...]) -> list[str]:
    return [name for name in names if name in dataset.variables]
