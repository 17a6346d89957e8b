"""The store of a sweep: a zarr v3 group on disk that a kill at any moment cannot hurt.

Variables are cut into blocks of whole chunks. Whoever computes a block writes its files; when they
are on the disk, the one run that holds the store enters the block into the ledger. What the ledger
does not confirm is computed again.
"""

from __future__ import annotations

import errno
import shutil
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.errors import ComputationError
from antinode.study.design.points import Points

from .blocks import Blocks, Written
from .contents import TRACKED, outputs_of
from .disk import keep_folder, partial_folder, write_lasting
from .documents import METADATA, attributes_of, group_document
from .ledger import Ledger, Record
from .work import Done, Plan, Target, blocks_of, run_file

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class Store:
    """A store that is open for writing.

    Parameters
    ----------
    path : Path
    points : Points
    rows : int
        Cases of a block.
    """

    def __init__(self, path: Path, points: Points, rows: int) -> None:
        self.path, self.points = path, points
        self.plan = Plan(points, rows, Target(str(path.resolve()), uuid.uuid4().hex))
        self.blocks = blocks_of(self.plan)
        outputs = {k: v for k, v in outputs_of(points).items() if k in TRACKED}
        self._after = Blocks(path, outputs, rows, points.cases)
        self._ledger = Ledger(path)

    @contextmanager
    def run(self) -> Iterator[None]:
        """Name this run as the one that works on the store, as long as it does.

        Raises
        ------
        ComputationError
            If the disk is full, or fails, for this process or a worker.
        """
        target, place = self.plan.target, run_file(self.path)
        assert target is not None
        try:
            with self._failing():
                place.write_text(target.run)
                yield
        finally:
            with suppress(OSError):
                if place.read_text() == target.run:
                    place.unlink()
                    shutil.rmtree(partial_folder(self.path), ignore_errors=True)

    def left(self) -> list[int]:
        """Return the blocks that are not there, or not as they were written."""
        return [block for block in range(self.blocks.number) if not self._is_done(block)]

    def _is_done(self, block: int) -> bool:
        record = self._ledger.records.get(block)
        return (
            record is not None
            and record.cases == self.plan.cases(block)
            and self.blocks.agree(block, Written(record.digest, record.files))
        )

    @property
    def finished(self) -> bool:
        """Whether all that comes after the blocks is there."""
        try:
            told = "finished" in attributes_of((self.path / METADATA).read_bytes())
        except (OSError, ValueError):
            return False
        return told and all(map(self._is_after, range(self._after.number)))

    def _is_after(self, block: int) -> bool:
        if not self._after.outputs:
            return True
        record = self._ledger.records.get(-1 - block)
        return record is not None and self._after.agree(block, Written(record.digest, record.files))

    def take(self, done: Done) -> None:
        """Enter a block into the ledger; write it first if nobody has.

        Raises
        ------
        ComputationError
            If the store is not there any more.
        """
        self._check_place()
        written = done.written
        if written is None or not self.blocks.agree(done.block, written):
            written = self._written_here(done)
        cases = self.plan.cases(done.block)
        self._ledger.add(Record(done.block, cases, *written, done.kernel))

    def _written_here(self, done: Done) -> Written:
        if done.arrays is None:
            raise ComputationError(
                f"{self.path}: block {done.block} is not as a worker says that it wrote it; do all "
                "of them see the same folder? What is in the ledger is kept: run the same command "
                "again"
            )
        return self.blocks.write(done.block, done.arrays)

    def _check_place(self) -> None:
        """Refuse to write where the store no longer is."""
        assert self.plan.target is not None
        if not self.plan.target.is_here():
            raise ComputationError(
                f"{self.path}: the store was moved, removed or replaced while the sweep ran; put "
                "it back, or name its new place, and run the same command again"
            )

    def finish(self, arrays: Mapping[str, npt.NDArray[Any]], attrs: Mapping[str, Any]) -> None:
        """Write what comes after all blocks, over all cases, and the attributes known then."""
        self._check_place()
        for block in range(self._after.number if arrays else 0):
            start, stop = self._after.bounds(block)
            written = self._after.write(block, {k: v[start:stop] for k, v in arrays.items()})
            self._ledger.add(Record(-1 - block, stop - start, *written, ""))
        document = (self.path / METADATA).read_bytes()
        write_lasting(self.path, self.path / METADATA, with_attributes(document, attrs))
        keep_folder(self.path)

    def read(self, name: str) -> npt.NDArray[Any]:
        """Return a whole variable."""
        return np.concatenate(list(self.blocks.each(name)))

    @contextmanager
    def _failing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            if error.errno is None:  # of no disk
                raise
            kept = f"{self._kept()} of {self.points.chunks} chunks are kept: "
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
        done = [block for block in self._ledger.records if block >= 0]
        return sum(len(self.plan.chunks(block)) for block in done)


def with_attributes(document: bytes, attrs: Mapping[str, Any]) -> bytes:
    """Return the metadata of a group with some attributes added."""
    import json

    whole = json.loads(document)
    found = {**whole["attributes"], **attrs}
    return group_document(found, whole["consolidated_metadata"]["metadata"])
