"""The store of a sweep: a zarr v3 group on disk that a kill at any moment cannot hurt.

Every variable is an array over cases, cut where the study cuts its chunks; `checksum` has a number
for each chunk, written after its data, and 0 until then. What a checksum does not confirm is
computed again.
"""

from __future__ import annotations

import errno
import hashlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.errors import ComputationError, InputError

from .folder import import_store

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


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

    def blocks(self, name: str) -> Iterator[npt.NDArray[Any]]:
        """Yield a variable chunk by chunk."""
        for chunk in range(self.chunks):
            start, stop = self._bounds(chunk)
            yield np.asarray(self.group[name][start:stop])

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
