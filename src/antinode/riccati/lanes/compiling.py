"""Marks on what is compiled: numba reads them in the process that builds the library.

In every other process the functions are plain Python, which nobody calls but a test, and numba is
not imported: `riccati.lanes.library` loads the machine code.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

from typing import Any

_FAST = {"contract", "nsz", "arcp"}
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",  # a division by zero gives inf, and raises nothing
    "_nrt": False,  # nothing is allocated inside, and no array's references are counted
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}
_numba: list[Any] = []


def use_numba(numba: Any) -> None:
    """Let numba compile what is marked from now on: before the marked modules are imported."""
    _numba.append(numba)
    numba.extending.type_callable(wide_vectors)(lambda _: lambda: numba.types.none)
    numba.extending.lower_builtin(wide_vectors)(_prefer_wide)


def compiled(function: Any) -> Any:
    """Mark a function as compiled."""
    return _mark(function, _FAST)


def summing(function: Any) -> Any:
    """Mark a function as compiled whose sums may be taken in any order: several at once."""
    return _mark(function, _FAST | {"reassoc"})


def _mark(function: Any, fastmath: set[str]) -> Any:
    return _numba[0].njit(**_OPTIONS, fastmath=fastmath)(function) if _numba else function


def wide_vectors():
    """Ask LLVM for whole 512-bit vectors where the processor has them (it prefers halves)."""


def _prefer_wide(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
    attributes = builder.function.attributes
    if isinstance(attributes, set):
        set.add(attributes, '"prefer-vector-width"="512"')
    return context.get_dummy_value()
