"""The compiled kernel: loaded where it pays, shared where it is loaded already.

Importing numba and reading its cached code takes longer than many solves in numpy, so that nothing
here is imported before someone asks for it.
"""

from __future__ import annotations

import os
import sys
import tempfile
import threading
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from antinode.riccati import shapes
from antinode.riccati.laws import BENDING

_LARGE = 50_000  # segments times modes from which reading the cache takes less time than numpy
_HUGE = 800_000  # ... and compiling
_SOURCE = Path(__file__).parents[1] / "riccati" / "lanes" / "kernel.py"
_OWN_CACHE = Path(tempfile.gettempdir()) / "antinode-numba"
_ready: list[ModuleType] = []
_loading = threading.Lock()


def kernel() -> ModuleType:
    """Return `riccati.lanes.calls`, compiled or taken from numba's cache once a process."""
    with _loading:
        if not _ready:
            _ready.append(_prepare())
    return _ready[0]


def kernel_if_worthwhile(segments: int, modes: int) -> ModuleType | None:
    """Return the kernel if it is loaded, or if a solve takes longer without; else None."""
    size = segments * modes
    if _ready or size >= _HUGE or (size >= _LARGE and _is_cached()):
        return kernel()
    return None


def _is_cached() -> bool:
    """Tell whether numba has the kernel's code on disk, from its last date of change on."""
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    folders = [Path(chosen)] if chosen else [_SOURCE.parent / "__pycache__", _OWN_CACHE]
    index = f"{_SOURCE.stem}.find_roots-*.nbi"
    found = (path for folder in folders for path in folder.rglob(index))
    changed = _SOURCE.stat().st_mtime
    return any(path.stat().st_mtime > changed for path in found)


def shapes_for(segments: int, modes: int) -> ModuleType:
    """Return what has `mode_states` and `mode_energies`: compiled if worthwhile, or in numpy."""
    return kernel_if_worthwhile(segments, modes) or shapes


def _prepare() -> ModuleType:
    """Compile on a small chain, and tell on stderr if it takes long."""
    start = time.perf_counter()
    notice = threading.Timer(2.0, _say_if_compiling)
    notice.daemon = True
    notice.start()
    try:
        compiled = _import_kernel()
        _try(compiled)
    finally:
        notice.cancel()
    if compiled.compiled_here():
        _say(f"compiled the batch kernel in {time.perf_counter() - start:.1f} s")
    return compiled


def _try(compiled: Any) -> None:
    """Call everything once that is compiled."""
    one = np.ones((1, 1))
    one.flags.writeable = False
    out = [np.zeros((1, 1)) for _ in range(4)]
    counts = np.zeros((1, 1, 2), dtype=np.int64)
    ends = np.array([0, 0])
    compiled.solve_chains(*(one, one, one, one, ends, 2, 1e-10, (*out[:3], counts, out[3])))
    structure = tuple(one[0] for _ in range(3))
    guess = np.ones((1, 1))
    compiled.certify_guesses(structure, one, ends, 2, 1e-10, guess, (*out[:3], counts, out[3]))
    ones = BENDING.named(*(np.ones(8) for _ in range(3)))
    chain = compiled.Chain(BENDING, np.full(8, 0.125), ones)
    compiled.find_eigenvalues(chain, 3, zeros=2)
    omega2 = np.array([500.0])
    states = compiled.mode_states(chain, omega2, np.ones(1, np.int64))
    compiled.mode_energies(chain, states, omega2)
    tables = np.arange(2.0), *(np.ones((1, 2)) for _ in range(3))
    limits = 4.0, 1.0, 1
    beam = compiled.Tables(*tables, 0.0, np.zeros(0), False, limits, "free", "free", ())
    compiled.solve_beam(beam, 2, 1, 1, 1e-6, 1e-10)


def _import_kernel() -> ModuleType:
    """Import the kernel; keep its cache in a temporary folder if numba finds no other place."""
    try:
        from antinode.riccati.lanes import calls as compiled
    except RuntimeError as error:
        if "cannot cache" not in str(error):
            raise
        from numba import config

        settings: Any = config
        settings.CACHE_DIR = str(_OWN_CACHE)
        from antinode.riccati.lanes import calls as compiled
    return compiled


def _say_if_compiling() -> None:
    """Tell what takes long, unless it is a busy machine that reads the cache."""
    compiled = sys.modules.get("antinode.riccati.lanes.calls")
    if compiled is not None and compiled.compiled_here():
        _say("compiling the batch kernel, once; some 20 s")


def _say(text: str) -> None:
    sys.stderr.write(f"antinode: {text}\n")
    sys.stderr.flush()
