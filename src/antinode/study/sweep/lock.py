"""The lock of a store: one run at a time holds it; it goes with the process, however that ends."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from antinode.errors import InputError
from antinode.text import short


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
