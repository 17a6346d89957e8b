"""What Python callers pass: choices by name, whole numbers, arrays; values that compare."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import fields
from operator import index
from typing import Any, ClassVar, get_args

import numpy as np

from .arrays import Array
from .errors import InputError
from .text import short


def choice(name: str, value: object, literal: Any) -> None:
    """Raise InputError unless an argument is one of the words of a `Literal`."""
    if not (isinstance(value, str) and value in literal.__args__):
        words = ", ".join(map(repr, get_args(literal)))
        raise InputError(f"{name} is {short(value)}; allowed are {words}")


def wanted(name: str, value: object, kind: type, made: str) -> None:
    """Raise InputError unless an argument is of a type; `made` says how one is had."""
    if not isinstance(value, kind):
        raise InputError(f"{name} is {short(value)}; a {kind.__name__} is wanted, such as {made}")


def whole(name: str, value: object, most: int, what: str = "") -> int:
    """Return an argument that counts, 1 ... `most`, as a plain int.

    Raises
    ------
    InputError
        If it is no whole number (2.5, but also 3.0, as everywhere in Python), or out of range.
    """
    try:
        if isinstance(value, bool | np.bool_):
            raise TypeError("a truth value counts nothing")
        number = index(value)  # type: ignore[arg-type]
    except TypeError as error:
        raise InputError(
            f"{name} is {short(value)}; a whole number (int) 1 ... {most} is allowed{what}"
        ) from error
    if not 1 <= number <= most:
        raise InputError(f"{name} is {short(number)}; allowed are 1 ... {most}{what}")
    return number


def within(name: str, value: object, low: float, high: float, what: str = "") -> float:
    """Return an argument that is a real number from `low` to `high`, or raise InputError."""
    try:
        if isinstance(value, str | bytes | complex):
            raise TypeError(type(value))
        number = float(value)  # type: ignore[arg-type]
        if low <= number <= high:
            return number
    except (TypeError, ValueError):
        pass
    raise InputError(f"{name} is {short(value)}; allowed are {low:g} ... {high:g}{what}")


def numbers(name: str, values: Any) -> Array:
    """Return values as an array of floats, not copied where it is one already.

    Raises
    ------
    InputError
        If something in it is no real number, or a value is masked: what stands behind a mask is
        not meant to be used.
    """
    if type(values) is np.ndarray and values.dtype == np.float64:
        return values
    masked: Any = sys.modules.get("numpy.ma")  # nothing is masked before someone imports it
    if masked and isinstance(values, masked.MaskedArray) and masked.is_masked(values):
        row = int(np.argwhere(np.atleast_1d(masked.getmaskarray(values)))[0, 0])
        raise InputError(f"{name}: row {row + 1} is masked; fill every value in, or drop the row")
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "biufO" or _has_none(array):
            raise TypeError(array.dtype.name)
        return np.asarray(array, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"{name} is {short(values)}; an array of real numbers in SI units is wanted"
        ) from error


def _has_none(array: Any) -> bool:
    return array.dtype.kind == "O" and any(value is None for value in array.flat)


def owned(name: str, values: Any) -> Array:
    """Return `numbers` as a read-only array that nobody else can write to."""
    array = numbers(name, values)
    if array.base is None and not array.flags.writeable:
        return array
    own: Array = np.array(array, dtype=float)
    own.flags.writeable = False
    return own


class ByValue:
    """A frozen dataclass with arrays that compares and hashes by what it holds."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if type(self) is not type(other):
            return NotImplemented
        return all(_equal(a, b) for a, b in zip(_values(self), _values(other), strict=True))

    def __hash__(self) -> int:
        return hash(tuple(_hashable(value) for value in _values(self)))


def _values(item: ByValue) -> Iterable[Any]:
    return (getattr(item, f.name) for f in fields(item) if f.compare)


def _equal(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return np.array_equal(a, b, equal_nan=True)
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(_equal(a[key], b[key]) for key in a)
    return bool(a == b or (a != a and b != b))


def _hashable(value: Any) -> Any:
    """Return what hashes alike for equal values: zeros of either sign, NaN, arrays, dicts."""
    if isinstance(value, np.ndarray):
        number = value + 0.0
        return value.shape, np.where(np.isnan(number), np.nan, number).tobytes()
    if isinstance(value, dict):
        return tuple((key, _hashable(item)) for key, item in value.items())
    if isinstance(value, float) and value != value:
        return "nan"
    return value
