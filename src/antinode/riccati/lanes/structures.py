"""Arguments of compiled functions as words in memory: an array by the address of its object.

Compiled code reads what it must know of an array - data, shape, whether it is contiguous - where
numpy keeps it, as every extension in C does. A structure is a tuple of arrays and numbers, word
after word; a kept one is a single word that says where its words are.
"""

from __future__ import annotations

import ctypes
import struct
from typing import Any, Generic, TypeVar

import numpy as np

RESULTS = 4
"""Words for what a function returns."""

NOT_CALLED = RESULTS - 1
"""The word that is not zero where it was not called: an array is not contiguous."""

HEAD = object.__basicsize__
"""Bytes of an object before its own fields."""

DATA, SHAPE, FLAGS = HEAD, HEAD + 16, HEAD + 48
"""Bytes before three fields of an array (`PyArrayObject_fields` of numpy's C interface)."""

CONTIGUOUS = 1
"""Among the flags."""

Structure = TypeVar("Structure", bound=tuple[Any, ...])
Results = ctypes.c_int64 * RESULTS


class Kept(Generic[Structure]):
    """A structure whose words are written once; a call takes their address.

    Parameters
    ----------
    structure : tuple
        What `words_of` takes; its arrays are kept.
    """

    def __init__(self, structure: Structure) -> None:
        self.structure = structure
        words = words_of(structure)
        self._words = ctypes.create_string_buffer(layout_of(words).pack(*words))
        self.address = ctypes.addressof(self._words)


def words_of(arguments: tuple[Any, ...]) -> list[Any]:
    """Return one number for every array, number and kept structure among arguments.

    Parameters
    ----------
    arguments : tuple
        Contiguous arrays of eight-byte numbers, or of bool; numbers; tuples of them; kept ones. A
        caller holds them while the words are in use.
    """
    words: list[Any] = []
    _collect(arguments, words)
    return words


def layout_of(words: list[Any]) -> struct.Struct:
    """Return how words are written: a float as such, all others as whole numbers."""
    return struct.Struct("=" + "".join("d" if isinstance(w, float) else "q" for w in words))


def _collect(arguments: tuple[Any, ...], words: list[Any]) -> None:
    for value in arguments:
        kind = type(value)
        if kind is np.ndarray:
            words.append(id(value))
        elif kind is Kept:
            words.append(value.address)
        elif isinstance(value, tuple):
            _collect(value, words)
        else:
            words.append(value)
