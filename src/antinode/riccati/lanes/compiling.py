"""Marks on what is compiled: numba reads them in the process that builds the library.

In every other process the functions are plain Python, which nobody calls but a test, and numba is
not imported: `riccati.lanes.library` loads the machine code.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

from functools import cache
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


def apart(function: Any) -> Any:
    """Mark a function as compiled whose arrays never overlap: short loops over lanes need that."""
    return _mark(function, _FAST, apart=True)


def _mark(function: Any, fastmath: set[str], *, apart: bool = False) -> Any:
    if not _numba:
        return function
    options = {**_OPTIONS, "pipeline_class": few_passes(apart)}
    made = _numba[0].njit(**options, fastmath=fastmath)(function)
    _compile_once(made)
    return made


def _compile_once(made: Any) -> None:
    """Let a function be compiled for types alone: numba would do it for every constant anew.

    LLVM carries constants into functions by itself.
    """
    unliteral, of_types = _numba[0].types.unliteral, made.get_call_template

    def get_call_template(given, named):
        named = {name: unliteral(typ) for name, typ in named.items()}
        return of_types(tuple(map(unliteral, given)), named)

    made.get_call_template = get_call_template


@cache
def few_passes(apart: bool = False) -> Any:
    """Return a pipeline of numba's with those passes alone that functions here need.

    They have no closures, contexts or objects, inline nothing, and prune no branches. `apart` says
    that no two arrays of a function's arguments overlap.
    """
    from numba.core import compiler, typed_passes, untyped_passes
    from numba.core.compiler_machinery import PassManager

    class FewPasses(compiler.CompilerBase):
        def define_pipelines(self):
            self.state.flags.noalias = apart
            manager = PassManager("few passes")
            for which in (
                untyped_passes.TranslateByteCode,
                untyped_passes.FixupArgs,
                untyped_passes.IRProcessing,
                untyped_passes.GenericRewrites,
                untyped_passes.ReconstructSSA,
                typed_passes.NopythonTypeInference,
                typed_passes.PreLowerStripPhis,
                typed_passes.IRLegalization,
                typed_passes.NativeLowering,
                typed_passes.NoPythonBackend,
            ):
                manager.add_pass(which, which.__name__)
            manager.finalize()
            return [manager]

    return FewPasses


def wide_vectors():
    """Ask LLVM for whole 512-bit vectors where the processor has them (it prefers halves)."""


def _prefer_wide(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
    attributes = builder.function.attributes
    if isinstance(attributes, set):
        set.add(attributes, '"prefer-vector-width"="512"')
    return context.get_dummy_value()
