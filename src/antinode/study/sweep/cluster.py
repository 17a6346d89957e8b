"""Blocks computed on a Dask cluster, by workers of the same build of antinode and no others.

The study travels once. A scheduler that no longer answers, or has no workers any more, ends the run
with a sentence; what is in the ledger stays.
"""

from __future__ import annotations

import pickle
import queue
import time
import uuid
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from typing import Any

from antinode.errors import ComputationError, InputError
from antinode.extras import import_extra
from antinode.study.design.points import points_of
from antinode.text import short

from .build import Build, this_build
from .executors import IN_HAND, MOST_BREAKS, some
from .work import Done, Plan, Target, compute_block

_SECONDS = 10  # for a scheduler to answer
_PATIENCE = 60  # seconds for a first worker
_LONGEST_WAIT = 600  # seconds without any worker, later
_TRIES = 10  # of a block whose worker dies
_SILENCE = 3.0  # seconds without a block after which the scheduler is asked whether it is there
_KEPT = "finished blocks of a store are kept: run the same command again"


def connect(scheduler: str) -> Any:
    """Return a client of a Dask scheduler.

    Raises
    ------
    InputError
        If Dask is not installed, or nobody answers at the address.
    """
    import logging

    dask = import_extra("distributed", "dask")
    for name in ("distributed", "distributed.client", "distributed.core"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        return dask.Client(scheduler, timeout=_SECONDS, set_as_default=False)
    except (OSError, ValueError, TimeoutError, TypeError) as error:
        raise InputError(
            f"no Dask scheduler answers at {short(scheduler)} within {_SECONDS} s; check the "
            "address, such as tcp://host:8786, and that 'dask scheduler' runs there"
        ) from error


def close(client: Any) -> None:
    """Let go of a client, whether its scheduler is there or not."""
    with suppress(Exception):  # of any library on the way
        client.close(timeout=5)


@lru_cache(maxsize=2)
def _unpacked(payload: bytes) -> Plan:
    study, rows, target = pickle.loads(payload)
    return Plan(points_of(study), rows, Target(*target) if target else None)


def _on_dask(payload: bytes, block: int, wanted: Build) -> Done | Build:
    """Compute a block, or tell that this is another build, which computes nothing."""
    own = this_build()
    return own if wanted.difference(own) else compute_block(_unpacked(payload), block)


def _same(payload: bytes) -> bytes:
    return payload


def run_on_dask(plan: Plan, blocks: Sequence[int], client: Any) -> Iterator[Done]:
    """Compute blocks on the workers of a Dask cluster, as many in hand as they can take.

    Raises
    ------
    InputError
        If the scheduler has no workers.
    ComputationError
        If the cluster fails, or a worker is another build of antinode.
    """
    _wait_for_workers(client)
    run = _Run(plan, client)
    rest = iter(blocks)
    try:
        threads = sum(client.nthreads().values()) or 2
        for block in some(rest, max(2, threads * IN_HAND)):
            run.submit(block)
        while run.waiting:
            done = run.next()
            if done is not None:
                yield done
                for block in some(rest, 1):
                    run.submit(block)
    finally:
        run.release()


class _Run:
    """Blocks that the cluster has in hand."""

    def __init__(self, plan: Plan, client: Any) -> None:
        import distributed

        self._dask: Any = distributed
        self._client, self._name, self._lost = client, f"antinode-{uuid.uuid4().hex[:12]}", 0
        target = tuple(plan.target) if plan.target else None
        payload = pickle.dumps((plan.points.study, plan.rows, target))
        self._plan = client.submit(_same, payload, key=f"{self._name}-study", retries=_TRIES)
        self._ready: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self.waiting: dict[Any, tuple[int, Any]] = {}
        self._heard = time.monotonic()

    def submit(self, block: int) -> None:
        """Hand a block to the cluster."""
        key = f"{self._name}-{self._lost}-{block}"
        future = self._client.submit(
            _on_dask, self._plan, block, this_build(), key=key, pure=False, retries=_TRIES
        )
        self.waiting[key] = block, future
        future.add_done_callback(lambda ended: self._ready.put(ended.key))

    def next(self) -> Done | None:
        """Return a block that is done; None where one must be computed again.

        Raises
        ------
        ComputationError
            If the cluster fails.
        """
        key = self._next_key()
        block, future = self.waiting.pop(key)
        try:
            result = future.result(timeout=_SECONDS)
        except (self._dask.KilledWorker, self._dask.CancelledError) as error:
            self._check_scheduler()
            self._lost += 1
            if self._lost > MOST_BREAKS:
                raise self._failed(error) from error
            self.submit(block)
            return None
        except OSError as error:
            if error.errno is not None:  # a worker's disk
                raise
            raise self._failed(error) from error
        except Exception as error:  # whatever a worker, or the way to it, raises
            raise self._failed(error) from error
        self._heard = time.monotonic()
        return _checked(result)

    def _next_key(self) -> Any:
        """Wait for a block; ask now and then whether the scheduler and workers are there."""
        while True:
            try:
                return self._ready.get(timeout=_SILENCE)
            except queue.Empty:
                self._check_scheduler()

    def _check_scheduler(self) -> None:
        """Refuse to wait for a scheduler that does not answer, or that has no workers."""
        try:
            about = self._client.sync(self._client.scheduler.identity, callback_timeout=_SECONDS)
        except Exception as error:  # of any library on the way
            raise ComputationError(
                f"the Dask scheduler no longer answers ({type(error).__name__}); {_KEPT}, with the "
                "address of one that runs"
            ) from error
        if about["workers"]:
            self._heard = time.monotonic()
        elif time.monotonic() - self._heard > _LONGEST_WAIT:
            raise ComputationError(
                f"the Dask scheduler has had no worker for {_LONGEST_WAIT} s; start some, e.g. "
                f"with 'dask worker' and its address; {_KEPT}"
            )

    def _failed(self, error: Exception) -> ComputationError:
        name, text = type(error).__name__, short(str(error))
        return ComputationError(f"the Dask cluster failed ({name}: {text}); {_KEPT}")

    def release(self) -> None:
        """Let go of all that is left."""
        for _, future in self.waiting.values():
            future.release()
        self.waiting.clear()
        self._plan.release()


def _checked(result: Any) -> Done:
    """Return what a worker of this build gives; refuse what others give."""
    own = this_build()
    if isinstance(result, Done) and not own.difference(result.build):
        return result
    build = result if isinstance(result, Build) else getattr(result, "build", None)
    told = own.difference(build) if isinstance(build, Build) else "does not say which it is"
    raise ComputationError(
        f"a Dask worker is another build of antinode: it {told}; nothing of it was taken. Install "
        f"the same on all workers; {_KEPT}"
    )


def _wait_for_workers(client: Any) -> None:
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise InputError(
            f"the Dask scheduler has no worker after {_PATIENCE} s; start some, e.g. with "
            "'dask worker' and its address"
        ) from error
