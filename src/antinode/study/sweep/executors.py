"""Where chunks are computed: in this process, in a pool of processes, or on a Dask cluster.

Each yields chunks with their arrays in any order, and the same numbers. A worker that dies loses
nothing: what it had in hand is computed again.
"""

from __future__ import annotations

import multiprocessing
import pickle
import uuid
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from typing import Any

import numpy as np

from antinode.errors import ComputationError, InputError
from antinode.extras import import_extra
from antinode.study.cases.chunks import Arrays, compute_chunk
from antinode.study.design.file import Study
from antinode.study.design.points import Points, points_of
from antinode.text import short

Done = Iterator[tuple[int, Arrays]]
_IN_HAND = 3  # chunks that wait for each worker
_MOST_BREAKS = 20  # pools that may die without a chunk between them
_SECONDS = 10  # for a scheduler to answer
_PATIENCE = 60  # seconds for a first worker
_TRIES = 10  # of a chunk whose worker dies


def run_here(points: Points, chunks: Sequence[int]) -> Done:
    """Compute chunks in this process, one after the other."""
    for chunk in chunks:
        yield chunk, compute_chunk(points, chunk)


_points: list[Points] = []


def _start_worker(study: Study) -> None:
    _points[:] = [points_of(study)]


def _in_worker(chunk: int) -> Arrays:
    return compute_chunk(_points[0], chunk)


def run_in_pool(points: Points, chunks: Sequence[int], workers: int) -> Done:
    """Compute chunks in processes of their own, started afresh (spawn).

    Raises
    ------
    ComputationError
        If the processes die again and again.
    """
    left, breaks = list(reversed(chunks)), 0
    while left:
        finished: set[int] = set()
        try:
            for chunk, arrays in _one_pool(points, list(reversed(left)), workers):
                finished.add(chunk)
                breaks = 0
                yield chunk, arrays
        except BrokenProcessPool as error:
            breaks += 1
            if breaks > _MOST_BREAKS:
                raise ComputationError(
                    "the worker processes die again and again (is there too little memory?); "
                    "take fewer --workers, or a smaller run.chunk"
                ) from error
        left = [chunk for chunk in left if chunk not in finished]


def _one_pool(points: Points, chunks: Sequence[int], workers: int) -> Done:
    """Yield chunks from one pool until all are done or a worker dies."""
    pool = ProcessPoolExecutor(
        workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_start_worker,
        initargs=(points.study,),
    )
    waiting: dict[Future[Arrays], int] = {}
    rest = iter(chunks)
    try:
        while True:
            for chunk in _some(rest, workers * _IN_HAND - len(waiting)):
                waiting[pool.submit(_in_worker, chunk)] = chunk
            if not waiting:
                return
            done, _ = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                chunk = waiting.pop(future)
                yield chunk, future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _some(rest: Iterator[int], number: int) -> list[int]:
    return [chunk for _, chunk in zip(range(number), rest, strict=False)]


def connect(scheduler: str) -> Any:
    """Return a client of a Dask scheduler.

    Raises
    ------
    InputError
        If Dask is not installed, or nobody answers at the address.
    """
    import logging

    dask = import_extra("distributed", "dask")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    try:
        return dask.Client(scheduler, timeout=_SECONDS, set_as_default=False)
    except (OSError, ValueError, TimeoutError, TypeError) as error:
        raise InputError(
            f"no Dask scheduler answers at {short(scheduler)} within {_SECONDS} s; check the "
            "address, such as tcp://host:8786, and that 'dask scheduler' runs there"
        ) from error


@lru_cache(maxsize=2)
def _unpacked(payload: bytes) -> Points:
    return points_of(pickle.loads(payload))


def _on_dask(payload: bytes, chunk: int) -> Arrays:
    return compute_chunk(_unpacked(payload), chunk)


def run_on_dask(points: Points, chunks: Sequence[int], client: Any) -> Done:
    """Compute chunks on the workers of a Dask cluster, as many in hand as they can take.

    Raises
    ------
    InputError
        If the scheduler has no workers.
    ComputationError
        If the cluster fails.
    """
    import distributed

    dask: Any = distributed
    _wait_for_workers(client)
    rest, payload = iter(chunks), pickle.dumps(points.study)

    run, lost = f"antinode-{uuid.uuid4().hex[:12]}", 0

    def submit(chunk: int) -> Any:
        key = f"{run}-{lost}-{chunk}"
        return client.submit(_on_dask, payload, chunk, key=key, pure=False, retries=_TRIES)

    try:
        threads = sum(client.nthreads().values()) or 2
        first = [submit(chunk) for chunk in _some(rest, max(2, threads * _IN_HAND))]
        pending = dask.as_completed(first, loop=client.loop)
        for future in pending:
            chunk = int(future.key.rpartition("-")[2])
            try:
                arrays = future.result()
            except (dask.KilledWorker, dask.CancelledError):
                lost += 1
                if lost > _MOST_BREAKS:
                    raise
                pending.add(submit(chunk))
                continue
            yield chunk, arrays
            future.release()
            for more in _some(rest, 1):
                pending.add(submit(more))
    except (OSError, RuntimeError, dask.CancelledError, dask.KilledWorker) as error:
        raise ComputationError(
            f"the Dask cluster failed ({type(error).__name__}: {short(str(error))}); finished "
            "chunks are kept: run the same command again"
        ) from error


def _wait_for_workers(client: Any) -> None:
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise InputError(
            f"the Dask scheduler has no worker after {_PATIENCE} s; start some, e.g. with "
            "'dask worker' and its address"
        ) from error


def joined(parts: Iterable[Arrays]) -> Arrays:
    """Put chunks in order together."""
    chunks = list(parts)
    return {name: np.concatenate([c[name] for c in chunks]) for name in chunks[0]}
