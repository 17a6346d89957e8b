"""The compiled kernel: loaded where it pays, shared where it is loaded already.

Importing numba and reading its cached code takes longer than many solves in numpy, so that nothing
here is imported before someone asks for it.
"""

from __future__ import annotations

import sys
import tempfile
import threading
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

_LARGE = 100_000  # segments times modes from which loading takes less time than numpy
_ready: list[ModuleType] = []
_loading = threading.Lock()


def kernel() -> ModuleType:
    """Return `riccati.lanes`, compiled or taken from numba's cache once a process."""
    with _loading:
        if not _ready:
            _ready.append(_prepare())
    return _ready[0]


def kernel_if_worthwhile(segments: int, modes: int) -> ModuleType | None:
    """Return the kernel if it is loaded, or if a solve takes longer without; else None."""
    if _ready or segments * modes >= _LARGE:
        return kernel()
    return None


def _prepare() -> ModuleType:
    """Compile on a small chain, and tell on stderr if it takes long."""
    start = time.perf_counter()
    notice = threading.Timer(2.0, _say_if_compiling)
    notice.daemon = True
    notice.start()
    try:
        lanes = _import_kernel()
        _try(lanes)
    finally:
        notice.cancel()
    if lanes.compiled_here():
        _say(f"compiled the batch kernel in {time.perf_counter() - start:.1f} s")
    return lanes


def _try(lanes: Any) -> None:
    """Call everything once that is compiled."""
    one = np.ones((1, 1))
    one.flags.writeable = False
    out = [np.zeros((1, 1)) for _ in range(4)]
    counts = np.zeros((1, 1, 2), dtype=np.int64)
    ends = np.array([0, 0])
    lanes.solve_chains(*(one, one, one, one, ends, 2, 1e-10, (*out[:3], counts, out[3])))
    structure = tuple(one[0] for _ in range(3))
    lanes.certify_guesses(structure, one, ends, 2, 1e-10, one, (*out[:3], counts, out[3]))
    chain = lanes.Chain(*(np.ones(1) for _ in range(4)))
    lanes.find_eigenvalues(chain, 3, zeros=2)


def _import_kernel() -> ModuleType:
    """Import the kernel; keep its cache in a temporary folder if numba finds no other place."""
    try:
        from .riccati import lanes
    except RuntimeError as error:
        if "cannot cache" not in str(error):
            raise
        from numba import config

        settings: Any = config
        settings.CACHE_DIR = str(Path(tempfile.gettempdir()) / "antinode-numba")
        from .riccati import lanes
    return lanes


def _say_if_compiling() -> None:
    """Tell what takes long, unless it is a busy machine that reads the cache."""
    lanes = sys.modules.get("antinode.riccati.lanes")
    if lanes is not None and lanes.compiled_here():
        _say("compiling the batch kernel, once; some 20 s")


def _say(text: str) -> None:
    sys.stderr.write(f"antinode: {text}\n")
    sys.stderr.flush()
