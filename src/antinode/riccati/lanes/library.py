"""The compiled functions as machine code: kept in a file, loaded without numba.

The code is the same whoever made it: it is always made by a process of its own (`build`), kept
under a name that tells its sources, the compiler's versions and the processor, and loaded from
there. Loading takes some tens of milliseconds. It comes in parts, each made when it is first asked
for: who wants frequencies does not wait for responses to be compiled.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import struct
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal

from .structures import HEAD, NOT_CALLED, Results, layout_of, reader_of

PREFIX = "antinode_"
"""Of the symbols of entries."""

HELPERS = {
    "exp": "exp",
    "expm1": "expm1",
    "log": "log",
    "log1p": "log1p",
    "memset": "memset",
    "memcpy": "memcpy",
}
HELPERS |= {"memset": "memset", "memcpy": "memcpy"}
HELPERS |= {"sqrt": "sqrt", "numba_frexp": "frexp", "numba_ldexp": "ldexp"}
"""What the machine code may call from outside, and the name in the C library."""

Part = Literal["roots", "shapes", "forced", "complex"]
"""Of the library, as in `riccati.lanes.entries`."""

Entry = tuple[Any, struct.Struct, Callable[[tuple[Any, ...]], tuple[Any, ...]]]
"""A function; how its words are written; how they are had from its arguments."""

_FOLDER = Path(__file__).parent
_MORE_SOURCES = [_FOLDER.parent / name for name in ("convergence.py", "reasons.py")]
_NOT_COMPILED = {"__init__.py", "calls.py", "scratch.py", "single.py", "states.py"}
_CHECK = 32  # bytes of a digest, before the code
_PATIENCE = 2.0  # s
_loading = threading.Lock()
_loaded: dict[Part, Library] = {}


class LibraryError(RuntimeError):
    """The compiled library cannot be had."""


class Library:
    """Compiled functions by name: a part of `riccati.lanes.entries`.

    Parameters
    ----------
    code : bytes
        An object file of this processor.

    Attributes
    ----------
    digest : str
        Of the code: libraries of one digest give the same to the last bit.
    """

    def __init__(self, code: bytes) -> None:
        self.digest = hashlib.sha256(code).hexdigest()
        import llvmlite.binding as llvm

        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        for symbol, name in HELPERS.items():
            llvm.add_symbol(symbol, _address_in_c(name))
        machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
        self._object = llvm.ObjectFileRef.from_data(code)
        self._engine.add_object_file(self._object)
        self._engine.finalize_object()
        self._entries: dict[str, Entry] = {}

    def call(self, name: str, *arguments: Any) -> list[int]:
        """Call a function; return the whole numbers that it gives.

        Raises
        ------
        ValueError
            If an array is not contiguous.
        """
        function, layout, words_of = self._entries.get(name) or self._entry(name, arguments)
        results = Results()
        function(layout.pack(*words_of(arguments)), results)
        if results[NOT_CALLED]:
            raise ValueError(f"an array that {name} takes is not contiguous")
        return results[:NOT_CALLED]

    def _entry(self, name: str, arguments: tuple[Any, ...]) -> Entry:
        """Return a function, and how its words are had and written: as those of its first call."""
        address = self._engine.get_function_address(PREFIX + name)
        function = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_void_p)(address)
        words_of = reader_of(arguments)
        self._entries[name] = function, layout_of(words_of(arguments)), words_of
        return self._entries[name]


def library(part: Part = "roots") -> Library:
    """Return compiled functions: loaded once a process, and made before if they are missing.

    Raises
    ------
    LibraryError
        If they cannot be made, or loaded.
    """
    if part not in _loaded:
        with _loading:
            if part not in _loaded:
                _loaded[part] = Library(_code(part))
    return _loaded[part]


def _address_in_c(name: str) -> int:
    """Return where a function of the C library stands."""
    for library in _c_libraries():
        if hasattr(library, name):
            return int(ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0)
    raise LibraryError(f"the C library of this machine has no function {name}")


@cache
def _c_libraries() -> list[Any]:
    if sys.platform == "win32":
        return [ctypes.CDLL("ucrtbase"), ctypes.CDLL("vcruntime140")]
    whole = ctypes.CDLL(None)
    if hasattr(whole, "ldexp"):
        return [whole]
    from ctypes.util import find_library

    return [whole, ctypes.CDLL(find_library("m"))]


def _code(part: Part) -> bytes:
    """Return the machine code of a part: from a folder that has it, or newly made."""
    name = f"kernel-{part}-{_key()}.bin"
    for folder in _folders():
        code = _read(folder / name)
        if code:
            return code
    for folder in _folders():
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            with _locked(folder / f"{name}.lock"):
                return _read(folder / name) or _made(part, folder / name)
        except OSError:
            continue  # not writable
    raise LibraryError(
        "the compiled code can be kept nowhere; let ANTINODE_CACHE_DIR name a writable folder, "
        'or solve with backend="numpy"'
    )


def _key() -> str:
    """Return what the machine code depends on, in short: sources, compilers, processor."""
    import llvmlite.binding as llvm

    found = hashlib.sha256()
    for path in [*sorted(_FOLDER.rglob("*.py")), *_MORE_SOURCES]:
        if path.name not in _NOT_COMPILED:
            found.update(path.name.encode() + path.read_bytes())
    features = llvm.get_host_cpu_features().flatten()
    for part in (
        *(version("numba"), version("llvmlite"), version("numpy"), platform.python_version()),
        *(llvm.get_process_triple(), llvm.get_host_cpu_name(), features, str(HEAD)),
    ):
        found.update(part.encode() + b"\n")
    return found.hexdigest()[:24]


def _folders() -> Iterator[Path]:
    """Yield where the code may be kept.

    That is where the environment says; else beside the sources, in the user's cache, or among the
    temporary files.
    """
    chosen = os.environ.get("ANTINODE_CACHE_DIR") or os.environ.get("NUMBA_CACHE_DIR")
    if chosen:
        yield Path(chosen)
        return
    yield _FOLDER / "__pycache__"
    if sys.platform == "win32":
        own = os.environ.get("LOCALAPPDATA")
    elif sys.platform == "darwin":
        own = os.path.expanduser("~/Library/Caches")
    else:
        own = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    if own and os.path.isabs(own):
        yield Path(own) / "antinode"
    user = os.getuid() if hasattr(os, "getuid") else ""
    yield Path(tempfile.gettempdir()) / f"antinode-{user}"


def _read(path: Path) -> bytes | None:
    """Return the code of a file; None if there is none, or a damaged or foreign one."""
    try:
        if hasattr(os, "getuid") and path.stat().st_uid not in (os.getuid(), 0, _owner()):
            return None
        data = path.read_bytes()
    except OSError:
        return None
    check, code = data[:_CHECK], data[_CHECK:]
    return code if code and hashlib.sha256(code).digest() == check else None


def _owner() -> int:
    """Return the owner of the sources, whose code is trusted as they are."""
    return _FOLDER.stat().st_uid


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Hold a lock that a process loses when it ends; where locks do not work, hold none."""
    with path.open("ab") as handle:
        with suppress(OSError):
            _lock(handle.fileno())
        yield


def _lock(handle: int) -> None:
    try:
        import fcntl
    except ImportError:  # Windows
        import msvcrt

        windows: Any = msvcrt
        for _ in range(60):  # ten tries of a second each
            try:
                windows.locking(handle, windows.LK_LOCK, 1)
                return
            except OSError:
                continue
    else:
        fcntl.flock(handle, fcntl.LOCK_EX)


def _made(part: Part, path: Path) -> bytes:
    """Make the code in a process of its own, keep it, and tell of it if that takes long."""
    handle, name = tempfile.mkstemp(prefix=path.stem, dir=path.parent)
    os.close(handle)
    try:
        with _notice():
            _build(part, name)
        code = Path(name).read_bytes()
        Path(name).write_bytes(hashlib.sha256(code).digest() + code)
        os.replace(name, path)
    finally:
        Path(name).unlink(missing_ok=True)
    return code


def _build(part: Part, target: str) -> None:
    """Run `build` in a fresh process that finds the same packages, and no settings of numba."""
    command = f"import sys; sys.path[:] = {sys.path!r}; from {__package__} import build; "
    kept = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    kept["PYTHONHASHSEED"] = "0"  # the order of sets is that of the code
    done = subprocess.run(
        [sys.executable, "-c", f"{command}build.main({part!r}, {target!r})"],
        check=False,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        env=kept,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    )
    if done.returncode or not Path(target).stat().st_size:
        told = done.stderr.strip().splitlines()
        raise LibraryError(
            f"the solver could not be compiled ({told[-1] if told else 'its process was stopped'}"
            '); reinstall numba and llvmlite, or solve with backend="numpy"'
        )


@contextmanager
def _notice() -> Iterator[None]:
    """Say on stderr that something is compiled, if it takes long, and how long it took."""
    start = time.perf_counter()
    notice = threading.Timer(_PATIENCE, _say, ("compiling the batch kernel, once; some 10 s",))
    notice.daemon = True
    notice.start()
    try:
        yield
    finally:
        notice.cancel()
    took = time.perf_counter() - start
    if took > _PATIENCE:
        _say(f"compiled the batch kernel in {took:.1f} s")


def _say(text: str) -> None:
    sys.stderr.write(f"antinode: {text}\n")
    sys.stderr.flush()
