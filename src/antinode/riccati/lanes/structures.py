"""Arguments of compiled functions as words in memory: arrays by address and shape."""

from __future__ import annotations

import ctypes
import struct
from typing import Any, Generic, TypeVar

import numpy as np

RESULTS = 4
"""Words at the start, for what the function returns."""

_none = struct.pack(f"{8 * RESULTS}x")
_first_byte = ctypes.c_char.from_buffer


Structure = TypeVar("Structure", bound=tuple[Any, ...])


class Kept(Generic[Structure]):
    """A structure whose words are written once; a call takes their address.

    Parameters
    ----------
    structure : tuple
        What `packed` takes; its arrays are kept.
    """

    def __init__(self, structure: Structure) -> None:
        self.structure = structure
        words: list[Any] = []
        kinds: list[str] = []
        _collect(structure, words, kinds)
        self._words = ctypes.create_string_buffer(struct.pack("=" + "".join(kinds), *words))
        self.address = ctypes.addressof(self._words)


def packed(arguments: tuple[Any, ...]) -> bytearray:
    """Return arguments as words of eight bytes, after those for the results.

    Parameters
    ----------
    arguments : tuple
        Contiguous arrays of eight-byte numbers, or of bool; numbers; tuples of them; kept ones.
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
        elif isinstance(value, Kept):
            words.append(value.address)
            kinds.append("q")
        else:
            words.append(value)
            kinds.append("d" if isinstance(value, float) else "q")


def _address(array: Any) -> int:
    if not array.size:
        return 0
    try:
        return ctypes.addressof(_first_byte(array))
    except (TypeError, ValueError):  # read-only
        if not array.flags.c_contiguous:
            raise
        return int(array.ctypes.data)
