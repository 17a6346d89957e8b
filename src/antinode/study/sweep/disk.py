"""Bytes on a disk that stay there: whatever is written here has reached it, power cut or not."""

from __future__ import annotations

import os
import uuid
from contextlib import suppress
from pathlib import Path


def own_folder(store: Path) -> Path:
    """Return the folder of a store for what no reader of zarr needs.

    It is inside an array: readers warn of what they do not know beside arrays.
    """
    return store / "reason" / ".antinode"


def partial_folder(store: Path) -> Path:
    """Return the folder of a store for files that are not whole yet."""
    return own_folder(store) / "partial"


def write_lasting(store: Path, file: Path, data: bytes) -> None:
    """Write a file of a store whole: its bytes, then its name, both on the disk on return.

    Parameters
    ----------
    store : Path
        The folder that holds the file, perhaps in further folders.
    file : Path
    data : bytes

    Raises
    ------
    OSError
        If it cannot be written; then what stood there still does.
    """
    partial = partial_folder(store) / uuid.uuid4().hex
    partial.parent.mkdir(parents=True, exist_ok=True)
    try:
        with partial.open("wb") as handle:
            handle.write(data)
            handle.flush()
            os.fsync(handle.fileno())
        file.parent.mkdir(parents=True, exist_ok=True)
        partial.replace(file)
    finally:
        partial.unlink(missing_ok=True)


def append_lasting(file: Path, data: bytes) -> None:
    """Append to a file; the bytes are on the disk on return."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("ab") as handle:
        handle.write(data)
        handle.flush()
        os.fsync(handle.fileno())


def keep_names(store: Path, files: list[Path]) -> None:
    """Bring the names of files, and of the folders between them and their store, onto the disk."""
    folders = {folder for file in files for folder in file.parents if _within(folder, store)}
    for folder in sorted(folders, reverse=True):
        keep_folder(folder)


def _within(folder: Path, store: Path) -> bool:
    return folder == store or store in folder.parents


def keep_folder(folder: Path) -> None:
    """Bring the names in a folder onto the disk, where the system can."""
    with suppress(OSError):  # Windows opens no folders
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
