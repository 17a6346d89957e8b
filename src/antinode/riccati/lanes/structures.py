"""Arguments of compiled functions as words in memory: an array by the address of its object.

Compiled code reads what it must know of an array - data, shape, whether it is contiguous - where
numpy keeps it, as every extension in C does. A structure is a tuple of arrays and numbers, word
after word; a kept one is a single word that says where its words are.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Iterator, Sequence
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
    return [word for _, word in _words("", arguments)]


def reader_of(arguments: tuple[Any, ...]) -> Callable[[tuple[Any, ...]], tuple[Any, ...]]:
    """Return what gives the words of all arguments of these types: `words_of`, but no walk."""
    places = "".join(f"{place}, " for place, _ in _words("given", arguments))
    reader: Callable[[tuple[Any, ...]], tuple[Any, ...]] = eval(f"lambda given: ({places})")
    return reader


def layout_of(words: Sequence[Any]) -> struct.Struct:
    """Return how words are written: a float as such, all others as whole numbers."""
    return struct.Struct("=" + "".join("d" if isinstance(w, float) else "q" for w in words))


def _words(name: str, arguments: tuple[Any, ...]) -> Iterator[tuple[str, Any]]:
    """Yield how each word is had from a tuple of this name, and the word."""
    for k, value in enumerate(arguments):
        place, kind = f"{name}[{k}]", type(value)
        if kind is np.ndarray:
            yield f"id({place})", id(value)
        elif kind is Kept:
            yield f"{place}.address", value.address
        elif isinstance(value, tuple):
            yield from _words(place, value)
        else:
            yield place, value
