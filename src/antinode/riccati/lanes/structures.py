"""Arguments of compiled functions as words in memory: arrays by address and shape."""

from __future__ import annotations

import ctypes
import struct
from typing import Any

import numpy as np

RESULTS = 3
"""Words at the start, for what the function returns."""

_none = struct.pack(f"{8 * RESULTS}x")
_first_byte = ctypes.c_char.from_buffer


def packed(arguments: tuple[Any, ...]) -> bytearray:
    """Return arguments as words of eight bytes, after those for the results.

    Parameters
    ----------
    arguments : tuple
        Contiguous arrays of eight-byte numbers, or of bool; numbers; and tuples of them.
    """
    words: list[Any] = []
    kinds: list[str] = []
    _collect(arguments, words, kinds)
    return bytearray(_none + struct.pack("=" + "".join(kinds), *words))


def _collect(arguments: tuple[Any, ...], words: list[Any], kinds: list[str]) -> None:
    for value in arguments:
        if isinstance(value, np.ndarray):
            words.append(_address(value))
            words.extend(value.shape)
            kinds.append("q" * (1 + value.ndim))
        elif isinstance(value, tuple):
            _collect(value, words, kinds)
        else:
            words.append(value)
            kinds.append("d" if isinstance(value, float) else "q")


def _address(array: Any) -> int:
    try:
        return ctypes.addressof(_first_byte(array))
    except (TypeError, ValueError):  # read-only, or empty
        if not array.flags.c_contiguous:
            raise
        return int(array.ctypes.data)
