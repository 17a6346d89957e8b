"""The blocks of a store: some chunks of every variable, a zarr chunk in a file of its own.

The bytes are those of zarr's codecs `bytes` and `zstd` with its checksum: whoever reads a damaged
file gets an error, not numbers.
"""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .contents import Output
from .disk import keep_names, write_lasting

LEVEL = 0
"""Of the compression by zstd: its default."""
Arrays = Mapping[str, npt.NDArray[Any]]


class Written(NamedTuple):
    """What is known of the files of a block: their digest, and size and time [ns] of each."""

    digest: str
    files: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Blocks:
    """Where and how variables over cases are kept.

    Attributes
    ----------
    path : Path
        The store.
    outputs : mapping
        The variables by name.
    rows : int
        Cases of a block.
    cases : int
    """

    path: Path
    outputs: Mapping[str, Output]
    rows: int
    cases: int

    @property
    def number(self) -> int:
        """Number of blocks."""
        return -(-self.cases // self.rows)

    def bounds(self, block: int) -> tuple[int, int]:
        """Return the first case of a block, and the first of the next one."""
        return block * self.rows, min(self.cases, (block + 1) * self.rows)

    def files(self, block: int) -> list[Path]:
        """Return the files of a block."""
        return [self._file(name, block) for name in self.outputs]

    def _file(self, name: str, block: int) -> Path:
        rest = ["0"] * (len(self.outputs[name].dims) - 1)
        return self.path.joinpath(name, "c", str(block), *rest)

    def write(self, block: int, arrays: Arrays) -> Written:
        """Write a block; it is on the disk on return.

        Raises
        ------
        OSError
            If the disk is full, or fails.
        """
        digest, files = _new_digest(), self.files(block)
        for (name, output), file in zip(self.outputs.items(), files, strict=True):
            data = self._encoded(arrays[name], output)
            digest.update(data)
            write_lasting(self.path, file, data)
        keep_names(self.path, files)
        return Written(digest.hexdigest(), self.stats(block))

    def _encoded(self, values: npt.NDArray[Any], output: Output) -> bytes:
        dtype = np.dtype(output.dtype).newbyteorder("<")
        whole = np.full((self.rows, *output.shape[1:]), fill_value(output), dtype=dtype)
        whole[: len(values)] = values
        return bytes(_zstd().encode(whole))

    def stats(self, block: int) -> tuple[tuple[int, int], ...]:
        """Return size and time of change of the files of a block.

        Raises
        ------
        OSError
            If one is missing.
        """
        found = (file.stat() for file in self.files(block))
        return tuple((about.st_size, about.st_mtime_ns) for about in found)

    def digest(self, block: int) -> str:
        """Return the digest of the files of a block as they are.

        Raises
        ------
        OSError
            If one is missing.
        """
        digest = _new_digest()
        for file in self.files(block):
            digest.update(file.read_bytes())
        return str(digest.hexdigest())

    def agree(self, block: int, written: Written) -> bool:
        """Tell whether the files of a block are as they were written."""
        try:
            return self.stats(block) == written.files or self.digest(block) == written.digest
        except OSError:
            return False

    def read(self, name: str, block: int) -> npt.NDArray[Any]:
        """Return a variable of a block."""
        start, stop = self.bounds(block)
        output = self.outputs[name]
        data = _zstd().decode(self._file(name, block).read_bytes())
        dtype = np.dtype(output.dtype).newbyteorder("<")
        whole = np.frombuffer(data, dtype).reshape(-1, *output.shape[1:])
        return np.asarray(whole[: stop - start], dtype=output.dtype)

    def each(self, name: str) -> Iterator[npt.NDArray[Any]]:
        """Yield a variable block by block."""
        for block in range(self.number):
            yield self.read(name, block)


def fill_value(output: Output) -> float:
    """Return what stands where nothing was written."""
    return np.nan if output.dtype.startswith("f") else -1


def _zstd() -> Any:
    """Return zarr's own library for its codec."""
    numcodecs: Any = importlib.import_module("numcodecs.zstd")
    return numcodecs.Zstd(level=LEVEL, checksum=True)


def _new_digest() -> Any:
    return hashlib.blake2b(digest_size=8)
