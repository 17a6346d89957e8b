"""Memory that a process keeps for its next chunk.

glibc gives large arrays back to the system at once, and takes them from it again, page by page: a
fifth of the time of a sweep. A process that computes chunks keeps some for the next one.
"""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from functools import cache

_TRIM, _TOP, _MMAP = -1, -2, -3  # M_TRIM_THRESHOLD, M_TOP_PAD, M_MMAP_THRESHOLD of malloc.h
_KEPT = 1 << 26  # bytes


@cache
def keep_memory() -> None:
    """Let this process keep some 64 MB, where the C library has a setting for it."""
    if sys.platform != "linux":
        return
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for setting, size in ((_MMAP, _KEPT >> 1), (_TRIM, 2 * _KEPT), (_TOP, _KEPT)):
            mallopt(setting, size)
