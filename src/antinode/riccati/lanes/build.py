"""Compiles the library: one file of machine code, made by numba and LLVM in a process of its own.

    python -m antinode.riccati.lanes.build FILE

Numba translates each marked function once; all are put into one LLVM module and optimised
together. What it has besides - a module for each function, with copies of all that it calls, each
optimised and translated for itself, and wrappers for Python - is left away.
"""

# mypy: ignore-errors

from __future__ import annotations

import gc
import sys
from pathlib import Path
from typing import Any

from .library import HELPERS, PREFIX
from .structures import RESULTS, Kept

_WORD = 8


def machine_code() -> bytes:
    """Return the object file of all entries, each under its name after `PREFIX`."""
    import numba

    from . import compiling

    compiling.use_numba(numba)
    parts = _gather_modules()
    from .entries import ENTRIES

    symbols = {_compile_entry(*ENTRIES[name]): PREFIX + name for name in ENTRIES}
    return _optimised(parts, symbols)


def _gather_modules() -> list[Any]:
    """Have numba put every function's LLVM module into a list, and do nothing else with it."""
    from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
    from numba.core.registry import cpu_target

    parts: list[Any] = []

    class Gathered(JITCodeLibrary):
        def add_llvm_module(self, module):
            self._final_module.link_in(module)

        def finalize(self):
            self._finalized = True
            parts.append(self._final_module)

        def get_pointer_to_function(self, _name):
            self._ensure_finalized()
            return 0

    class Codegen(JITCPUCodegen):
        _library_class = Gathered

        def set_env(self, _name, _environment):
            pass

    cpu_target.target_context._internal_codegen = Codegen("antinode")
    return parts


def _compile_entry(function: Any, arguments: tuple[Any, ...]) -> str:
    """Compile a function that takes one address; return its symbol."""
    import numba
    from numba import types

    kept = [isinstance(value, Kept) for value in arguments]
    given = [v.structure if isinstance(v, Kept) else v for v in arguments]
    unpack, give = _unpacking(types.Tuple([numba.typeof(v) for v in given]), kept), _give()

    def entry(words):
        give(words, function(*unpack(words)))

    signature = types.void(types.CPointer(types.int64))
    made = numba.cfunc(signature, error_model="numpy", _nrt=False)(entry)
    return str(made._wrapper_name)


def _unpacking(whole: Any, kept: list[bool]) -> Any:
    """Return an intrinsic that makes arguments of the words that `structures.packed` makes.

    The words of those that are kept stand where one word says.
    """
    from numba.core import cgutils, types
    from numba.extending import intrinsic
    from numba.np import arrayobj

    def word(builder, words, place):
        return builder.load(cgutils.gep_inbounds(builder, words, place))

    def array(context, builder, typ, words, place):
        made = arrayobj.make_array(typ)(context, builder)
        data = builder.inttoptr(word(builder, words, place), made.data.type)
        shape = [word(builder, words, place + 1 + k) for k in range(typ.ndim)]
        itemsize = context.get_abi_sizeof(context.get_data_type(typ.dtype))
        strides = [context.get_constant(types.intp, itemsize)]
        for size in shape[:0:-1]:
            strides.insert(0, builder.mul(strides[0], size))
        arrayobj.populate_array(
            made, data, shape, strides, context.get_constant(types.intp, itemsize), None
        )
        return made._getvalue(), place + 1 + typ.ndim

    def value(context, builder, typ, words, place):
        if isinstance(typ, types.Array):
            return array(context, builder, typ, words, place)
        if isinstance(typ, types.BaseTuple):
            items = []
            for each in typ:
                item, place = value(context, builder, each, words, place)
                items.append(item)
            return context.make_tuple(builder, typ, items), place
        raw = word(builder, words, place)
        if isinstance(typ, types.Float):
            return builder.bitcast(raw, context.get_value_type(typ)), place + 1
        return context.cast(builder, raw, types.int64, typ), place + 1

    def unpack(_typing, words):
        def generate(context, builder, _signature, arguments):
            items, place, words = [], RESULTS, arguments[0]
            for typ, apart in zip(whole, kept, strict=True):
                if apart:
                    elsewhere = builder.inttoptr(word(builder, words, place), words.type)
                    item, place = value(context, builder, typ, elsewhere, 0)[0], place + 1
                else:
                    item, place = value(context, builder, typ, words, place)
                items.append(item)
            return context.make_tuple(builder, whole, items)

        return whole(words), generate

    return intrinsic(unpack)


def _give() -> Any:
    """Return an intrinsic that puts the numbers a function returns into the first words."""
    from numba.core import cgutils, types
    from numba.extending import intrinsic

    def give(_typing, words, results):
        def generate(context, builder, _signature, arguments):
            pointer, given = arguments
            parts = [] if results == types.none else [(results, given)]
            if isinstance(results, types.BaseTuple):
                parts = list(zip(results, cgutils.unpack_tuple(builder, given), strict=True))
            for k, (typ, part) in enumerate(parts):
                if not isinstance(typ, types.Float):
                    part = context.cast(builder, part, typ, types.int64)
                part = builder.bitcast(part, pointer.type.pointee)
                builder.store(part, cgutils.gep_inbounds(builder, pointer, k))
            return context.get_dummy_value()

        return types.none(words, results), generate

    return intrinsic(give)


def _optimised(parts: list[Any], symbols: dict[str, str]) -> bytes:
    """Link all modules into one, optimise it as numba would, and return its object code."""
    import llvmlite.binding as llvm
    from numba.core.registry import cpu_target

    codegen = cpu_target.target_context._internal_codegen
    whole = llvm.parse_assembly(str(codegen._create_empty_module("antinode")))
    for part in parts:
        whole.link_in(part)
    for function in whole.functions:
        if function.name in symbols:
            function.name = symbols[function.name]
        elif not function.is_declaration:
            function.linkage = "internal"
    for speed, vectorise in ((0, False), (3, True)):  # first short functions into their callers
        settings = llvm.create_pipeline_tuning_options(speed_level=speed)
        settings.loop_vectorization, settings.slp_vectorization = vectorise, False
        builder = llvm.create_pass_builder(codegen._tm, settings)
        manager = builder.getModulePassManager()
        if not speed:
            manager.add_loop_rotate_pass()
            manager.add_instruction_combine_pass()
            manager.add_jump_threading_pass()
        manager.run(whole, builder)
    whole.verify()
    outside = {f.name for f in whole.functions if f.is_declaration and "llvm." not in f.name}
    if outside - set(HELPERS):
        raise RuntimeError(f"compiled code calls {sorted(outside - set(HELPERS))} from outside")
    return bytes(codegen._tm.emit_object(whole))


def main(target: str) -> None:
    """Write the library."""
    gc.disable()
    Path(target).write_bytes(machine_code())


if __name__ == "__main__":
    main(sys.argv[1])
