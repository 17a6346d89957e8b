"""Files written whole or not at all: beside their place first, then put there.

Only a plain file is replaced, and its mode kept. A link is followed to what it names; a device, a
pipe, or a file of several names is written through.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

_SYSTEM = ("/dev/", "/proc/")


def write_file(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file by a function that writes it under another name.

    Raises
    ------
    OSError
        If it cannot be written; then what stood there still does.
    """
    if not is_replaceable(path):
        with TemporaryDirectory() as folder:
            whole = Path(folder) / (path.name or "file")
            write(whole)
            put(whole, path)
        return
    place = _place(path)
    partial = place.with_name(f".{place.name}.partial")
    try:
        write(partial)
        put(partial, path)
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def put(whole: Path, path: Path) -> None:
    """Put a finished file in the place of another one.

    Raises
    ------
    OSError
        If it cannot be put there.
    """
    if not is_replaceable(path):
        _pour(whole, path)
        return
    place = _place(path)
    if place.exists():
        whole.chmod(stat.S_IMODE(place.stat().st_mode))
    whole.replace(place)


def is_replaceable(path: Path) -> bool:
    """Tell whether a file can be replaced, or must be written through."""
    if str(path.absolute()).startswith(_SYSTEM):
        return False
    place = _place(path)
    if not os.access(place.parent, os.W_OK):
        return False
    return not place.exists() or (place.is_file() and place.stat().st_nlink == 1)


def _place(path: Path) -> Path:
    """Return what a path names in the end, links followed."""
    place = Path(os.path.realpath(path))
    if place.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return place


def _pour(whole: Path, path: Path) -> None:
    """Write the contents of a file into another one, which stays itself."""
    with whole.open("rb") as source:
        if _is_stdout(path):
            sys.stdout.flush()
            shutil.copyfileobj(source, sys.stdout.buffer)
            sys.stdout.flush()
            return
        with path.open("wb") as target:
            shutil.copyfileobj(source, target)


def _is_stdout(path: Path) -> bool:
    """Tell whether a path is standard output by another name."""
    if not hasattr(sys.stdout, "buffer") or not str(path.absolute()).startswith(_SYSTEM):
        return False
    with suppress(OSError, ValueError):
        return os.path.samestat(path.stat(), os.fstat(sys.stdout.fileno()))
    return False
