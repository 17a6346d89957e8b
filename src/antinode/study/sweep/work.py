"""What a worker does: compute the chunks of a block, and write them where it can.

A worker that sees the store of its run writes into it; one that does not gives the numbers back.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np

from antinode.study.cases.chunks import Arrays, compute_chunk
from antinode.study.design.points import Points

from .blocks import Blocks, Written
from .build import Build, kernel_digest, this_build
from .contents import TRACKED, outputs_of
from .disk import own_folder
from .memory import keep_memory


def run_file(store: Path) -> Path:
    """Return the file of a store that names the run which works on it."""
    return own_folder(store) / "run"


class Target(NamedTuple):
    """A store that a run writes into.

    Attributes
    ----------
    path : str
    run : str
        Name of the run.
    """

    path: str
    run: str

    def is_here(self) -> bool:
        """Tell whether this process sees the store, and the run still has it."""
        with suppress(OSError):
            return run_file(Path(self.path)).read_text() == self.run
        return False


class Plan(NamedTuple):
    """What is computed, in which portions, for which store.

    Attributes
    ----------
    points : Points
    rows : int
        Cases of a block: some whole chunks.
    target : Target or None
    """

    points: Points
    rows: int
    target: Target | None = None

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return -(-self.points.cases // self.rows)

    def cases(self, block: int) -> int:
        """Return the number of cases of a block."""
        return min(self.points.cases, (block + 1) * self.rows) - block * self.rows

    def chunks(self, block: int) -> range:
        """Return the chunks of a block."""
        each = -(-self.rows // self.points.study.run_table.chunk)
        return range(block * each, min(self.points.chunks, (block + 1) * each))


class Done(NamedTuple):
    """A block that was computed.

    Attributes
    ----------
    block : int
    build : Build
        Who computed it.
    kernel : str
        With which machine code.
    arrays : dict or None
        The numbers, if they are not written yet.
    written : Written or None
        About the files, if they are.
    """

    block: int
    build: Build
    kernel: str
    arrays: Arrays | None
    written: Written | None


def compute_block(plan: Plan, block: int) -> Done:
    """Compute a block, and write it if the store is here."""
    keep_memory()
    arrays = joined(compute_chunk(plan.points, chunk) for chunk in plan.chunks(block))
    return delivered(plan, block, arrays)


def delivered(plan: Plan, block: int, arrays: Arrays) -> Done:
    """Write a block if the store is here; else hand it over."""
    written = None
    if plan.target is not None and plan.target.is_here():
        written = blocks_of(plan).write(block, arrays)
    return Done(block, this_build(), kernel_digest(), None if written else arrays, written)


def blocks_of(plan: Plan) -> Blocks:
    """Return the blocks of a store that workers write."""
    assert plan.target is not None
    outputs = {k: v for k, v in outputs_of(plan.points).items() if k not in TRACKED}
    return Blocks(Path(plan.target.path), outputs, plan.rows, plan.points.cases)


def joined(parts: Iterable[Arrays]) -> Arrays:
    """Put arrays over cases in order together."""
    every = list(parts)
    return {name: np.concatenate([one[name] for one in every]) for name in every[0]}
