"""Compiles the library: files of machine code, made by numba and LLVM in a process of their own.

    python -m antinode.riccati.lanes.build PART FILE

Numba translates each marked function that a part needs once, whatever constants it is called with;
all are put into one LLVM module and optimised together. What it has besides - a module for each
function, with copies of all that it calls, each optimised and translated for itself, and wrappers
for Python - is left away.
"""

# mypy: ignore-errors

from __future__ import annotations

import ctypes
import gc
import sys
from pathlib import Path
from typing import Any

import numpy as np

from . import compiling
from .library import HELPERS, PREFIX, Part
from .structures import CONTIGUOUS, DATA, FLAGS, NOT_CALLED, SHAPE, Kept

_WORD = 8


def machine_code(part: Part) -> bytes:
    """Return the object file of the entries of a part, each under its name after `PREFIX`."""
    import numba

    _check_arrays()
    compiling.use_numba(numba)
    modules = _gather_modules()
    from .entries import ENTRIES

    symbols = {_compile_entry(*entry): PREFIX + name for name, entry in ENTRIES[part].items()}
    return _optimised(modules, symbols, unrolled=part != "shapes")


def _check_arrays() -> None:
    """Make sure that arrays keep their fields where `structures` says."""
    sample = np.zeros((3, 5))[1:]

    def field(place):
        return ctypes.c_int64.from_address(id(sample) + place).value

    sizes = (ctypes.c_int64 * 2).from_address(field(SHAPE))
    whole, parts = field(FLAGS), sample[:, ::2]
    if (
        field(DATA) != sample.ctypes.data
        or tuple(sizes) != sample.shape
        or not whole & CONTIGUOUS
        or ctypes.c_int64.from_address(id(parts) + FLAGS).value & CONTIGUOUS
    ):
        raise RuntimeError("numpy keeps arrays otherwise than this code expects")


def _gather_modules() -> list[Any]:
    """Have numba put every function's LLVM module into a list, and do nothing else with it."""
    from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
    from numba.core.registry import cpu_target

    modules: list[Any] = []

    class Gathered(JITCodeLibrary):
        def add_llvm_module(self, module):
            self._final_module.link_in(module)

        def finalize(self):
            self._finalized = True
            modules.append(self._final_module)

        def get_pointer_to_function(self, _name):
            self._ensure_finalized()
            return 0

    class Codegen(JITCPUCodegen):
        _library_class = Gathered

        def set_env(self, _name, _environment):
            pass

    cpu_target.target_context._internal_codegen = Codegen("antinode")
    return modules


def _compile_entry(function: Any, arguments: tuple[Any, ...]) -> str:
    """Compile a function that takes the addresses of words and of results; return its symbol."""
    import numba
    from numba import types

    kept = [isinstance(value, Kept) for value in arguments]
    given = [v.structure if isinstance(v, Kept) else v for v in arguments]
    read = _Reading(types.Tuple([numba.typeof(v) for v in given]), kept)
    all_contiguous, unpack, give = read.contiguity(), read.arguments(), _give()

    def entry(words, results):
        results[NOT_CALLED] = 0
        if all_contiguous(words):
            give(results, function(*unpack(words)))
        else:
            results[NOT_CALLED] = 1

    words = types.CPointer(types.int64)
    made = numba.cfunc(
        types.void(words, words),
        error_model="numpy",
        _nrt=False,
        pipeline_class=compiling.few_passes(),
    )(entry)
    return str(made._wrapper_name)


class _Reading:
    """Intrinsics that read arguments of the words that `structures.words_of` makes.

    Parameters
    ----------
    whole : numba tuple type
        Of the arguments.
    kept : list of bool
        Which of them are kept: their words stand where one word says.
    """

    def __init__(self, whole: Any, kept: list[bool]) -> None:
        self.whole, self.kept = whole, kept

    def arguments(self) -> Any:
        """Return an intrinsic that makes the arguments."""
        from numba.extending import intrinsic

        def unpack(_typing, words):
            def generate(context, builder, _signature, arguments):
                items = [
                    _value(context, builder, typ, iter(leaves))
                    for typ, leaves in self._leaves(builder, arguments[0])
                ]
                return context.make_tuple(builder, self.whole, items)

            return self.whole(words), generate

        return intrinsic(unpack)

    def contiguity(self) -> Any:
        """Return an intrinsic that tells whether all arrays are contiguous."""
        from numba.core import types
        from numba.extending import intrinsic

        def all_contiguous(_typing, words):
            def generate(_context, builder, _signature, arguments):
                pointer = arguments[0].type
                flags = pointer.pointee(CONTIGUOUS)
                for _, leaves in self._leaves(builder, arguments[0]):
                    for typ, word in leaves:
                        if isinstance(typ, types.Array):
                            head = builder.inttoptr(word, pointer)
                            flags = builder.and_(flags, _word(builder, head, FLAGS // _WORD))
                return builder.icmp_signed("!=", flags, flags.type(0))

            return types.boolean(words), generate

        return intrinsic(all_contiguous)

    def _leaves(self, builder: Any, words: Any) -> Any:
        """Yield the type of every argument, and of all in it the type and the word."""
        place = 0
        for typ, apart in zip(self.whole, self.kept, strict=True):
            types_in = list(_flat(typ))
            start, base = place, words
            if apart:
                start, base = 0, builder.inttoptr(_word(builder, words, place), words.type)
            place += 1 if apart else len(types_in)
            yield typ, [(t, _word(builder, base, start + k)) for k, t in enumerate(types_in)]


def _flat(typ: Any) -> Any:
    """Yield the types of all arrays and numbers in one."""
    from numba.core import types

    if isinstance(typ, types.BaseTuple):
        for each in typ:
            yield from _flat(each)
    else:
        yield typ


def _word(builder: Any, base: Any, place: int) -> Any:
    from numba.core import cgutils

    return builder.load(cgutils.gep_inbounds(builder, base, place))


def _value(context: Any, builder: Any, typ: Any, leaves: Any) -> Any:
    """Return a value of its words."""
    from numba.core import types

    if isinstance(typ, types.BaseTuple):
        items = [_value(context, builder, each, leaves) for each in typ]
        return context.make_tuple(builder, typ, items)
    _, word = next(leaves)
    if isinstance(typ, types.Array):
        return _array(context, builder, typ, word)
    if isinstance(typ, types.Float):
        return builder.bitcast(word, context.get_value_type(typ))
    return context.cast(builder, word, types.int64, typ)


def _array(context: Any, builder: Any, typ: Any, word: Any) -> Any:
    """Return an array that is a view of the object at an address."""
    from numba.core import types
    from numba.np import arrayobj

    made = arrayobj.make_array(typ)(context, builder)
    pointer = word.type.as_pointer()
    head = builder.inttoptr(word, pointer)
    data = builder.inttoptr(_word(builder, head, DATA // _WORD), made.data.type)
    sizes = builder.inttoptr(_word(builder, head, SHAPE // _WORD), pointer)
    shape = [_word(builder, sizes, k) for k in range(typ.ndim)]
    itemsize = context.get_constant(
        types.intp, context.get_abi_sizeof(context.get_data_type(typ.dtype))
    )
    strides = [itemsize]
    for size in shape[:0:-1]:
        strides.insert(0, builder.mul(strides[0], size))
    arrayobj.populate_array(made, data, shape, strides, itemsize, None)
    return made._getvalue()


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


def _optimised(modules: list[Any], symbols: dict[str, str], *, unrolled: bool) -> bytes:
    """Link all modules into one, optimise it as numba would, and return its object code.

    Where short loops over lanes are not unrolled they become vectors.
    """
    import llvmlite.binding as llvm
    from numba.core.registry import cpu_target

    codegen = cpu_target.target_context._internal_codegen
    whole = llvm.parse_assembly(str(codegen._create_empty_module("antinode")))
    for module in modules:
        whole.link_in(module)
    for function in whole.functions:
        if function.name in symbols:
            function.name = symbols[function.name]
        elif not function.is_declaration:
            function.linkage = "internal"
    for speed, vectorise in ((0, False), (3, True)):  # first short functions into their callers
        settings = llvm.create_pipeline_tuning_options(speed_level=speed)
        settings.loop_vectorization, settings.slp_vectorization = vectorise, False
        settings.loop_unrolling = unrolled
        builder = llvm.create_pass_builder(codegen._tm, settings)
        manager = builder.getModulePassManager()
        if not speed:
            manager.add_loop_rotate_pass()
            manager.add_instruction_combine_pass()
            manager.add_jump_threading_pass()
        else:  # functions too long for their callers raise nothing either
            manager.add_ipsccp_pass()
            manager.add_simplify_cfg_pass()
            manager.add_global_dead_code_eliminate_pass()
            manager.add_strip_dead_prototype_pass()
        manager.run(whole, builder)
    whole.verify()
    outside = {f.name for f in whole.functions if f.is_declaration and "llvm." not in f.name}
    if outside - set(HELPERS):
        raise RuntimeError(f"compiled code calls {sorted(outside - set(HELPERS))} from outside")
    return bytes(codegen._tm.emit_object(whole))


def main(part: Part, target: str) -> None:
    """Write a part of the library."""
    gc.disable()
    Path(target).write_bytes(machine_code(part))


if __name__ == "__main__":
    main(*sys.argv[1:3])
