"""Where blocks are computed on this machine: in this process, or in a pool of processes.

Each yields blocks in any order, and the same numbers. A worker that dies loses nothing: what it had
in hand is computed again. A worker whose parent dies, however, ends at once.
"""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

from antinode.errors import ComputationError, InputError
from antinode.study.design.file import Study
from antinode.study.design.points import points_of

from .work import Done, Plan, Target, compute_block

IN_HAND = 3
"""Blocks that wait for each worker."""
MOST_BREAKS = 20
"""Workers that may die without a block between them."""
_UNGUARDED = 78  # exit code of a worker that runs the script of its parent


def run_here(plan: Plan, blocks: Sequence[int]) -> Iterator[Done]:
    """Compute blocks in this process, one after the other."""
    for block in blocks:
        yield compute_block(plan, block)


_plan: list[Plan] = []


def _start_worker(study: Study, rows: int, target: Target | None) -> None:
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _plan[:] = [Plan(points_of(study), rows, target)]


def _end_with_parent() -> None:
    """Wait for the end of the process that started this one, and end too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        multiprocessing.connection.wait([parent.sentinel])
        os._exit(1)


def _in_worker(block: int) -> Done:
    return compute_block(_plan[0], block)


def refuse_second_script() -> None:
    """End this process, if it is a worker that runs the script of its parent again.

    A fresh process imports the main script first. One that starts a sweep while it is imported has
    no guard; the parent says so.
    """
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        os._exit(_UNGUARDED)


def run_in_pool(plan: Plan, blocks: Sequence[int], workers: int) -> Iterator[Done]:
    """Compute blocks in processes of their own, started afresh (spawn).

    Raises
    ------
    InputError
        If the script that runs starts itself again in every process.
    ComputationError
        If the processes die again and again.
    """
    left, breaks = list(blocks), 0
    while left:
        finished: set[int] = set()
        try:
            for done in _one_pool(plan, left, workers):
                finished.add(done.block)
                breaks = 0
                yield done
        except BrokenProcessPool as error:
            breaks += 1
            if breaks == 1:
                _check_guard()
            if breaks > MOST_BREAKS:
                raise ComputationError(
                    "the worker processes die again and again (is there too little memory?); "
                    "take fewer --workers, or a smaller run.chunk"
                ) from error
        left = [block for block in left if block not in finished]


def _check_guard() -> None:
    """Start one process that does nothing; refuse a script that does not let it."""
    probe = multiprocessing.get_context("spawn").Process(target=_nothing)
    probe.start()
    probe.join()
    if probe.exitcode == _UNGUARDED:
        raise InputError(
            "the script starts its sweep again in every worker process; put it under "
            "'if __name__ == \"__main__\":', or take workers=1"
        )


def _nothing() -> None:
    return


def _one_pool(plan: Plan, blocks: Sequence[int], workers: int) -> Iterator[Done]:
    """Yield blocks from one pool until all are done or a worker dies."""
    pool = ProcessPoolExecutor(
        workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_start_worker,
        initargs=(plan.points.study, plan.rows, plan.target),
    )
    waiting: set[Future[Done]] = set()
    rest = iter(blocks)
    try:
        while True:
            for block in some(rest, workers * IN_HAND - len(waiting)):
                waiting.add(pool.submit(_in_worker, block))
            if not waiting:
                return
            done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def some(rest: Iterator[int], number: int) -> list[int]:
    """Return the next blocks, at most so many."""
    return [block for _, block in zip(range(number), rest, strict=False)]
