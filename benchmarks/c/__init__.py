"""The recursion in C, compiled where a compiler is at hand."""

import ctypes
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

FLAGS = ["-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math", "-shared", "-fPIC"]
WIDTHS = ("256", "512")  # of vectors; the faster one counts
_DOUBLES = ctypes.POINTER(ctypes.c_double)


@cache
def libraries():
    """Compiled libraries by width of vector; none without a compiler."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        return {}
    folder = tempfile.mkdtemp()
    found = {}
    for width in WIDTHS:
        path = f"{folder}/step{width}.so"
        command = [compiler, *FLAGS, f"-mprefer-vector-width={width}"]
        source = str(Path(__file__).with_name("step.c"))
        if subprocess.run([*command, source, "-o", path], capture_output=True).returncode == 0:
            library = ctypes.CDLL(path)
            library.calibrate.restype = ctypes.c_double
            found[width] = library
    return found


def repeat(library, table, state, last, times):
    """Pass the chain `times` times."""
    library.repeat(
        table.ctypes.data_as(_DOUBLES),
        ctypes.c_int(table.shape[1]),
        state.ctypes.data_as(_DOUBLES),
        ctypes.c_int(last),
        ctypes.c_int(times),
    )


def calibrate(library):
    library.calibrate(ctypes.c_long(2_000_000))
