"""Where `antinode` starts: it runs a command and turns every failure into one sentence on stderr.

Exit codes: 0 done, 1 the computation failed, 2 the input was wrong, 3 a verdict is no, 130
interrupted.
"""

from __future__ import annotations

import io
import os
import sys
import warnings
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TextIO

from cyclopts import CycloptsError, UnusedCliTokensError

from antinode.errors import AntinodeError
from antinode.text import one_line, short

from .app import app, import_all

_LONGEST = 600  # characters of a sentence
_BUG = (
    "this is a bug in antinode; please report it with the traceback that ANTINODE_DEBUG=1 in the "
    "environment shows"
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and end the process with its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        By default those of the process.
    """
    sys.stdout, sys.stderr = (s or _nowhere() for s in (sys.stdout, sys.stderr))  # closed: `>&-`
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    sys.exit(_run(arguments))


def _run(arguments: Sequence[str] | None) -> int:
    """Run a command and return the exit code; say why it failed."""
    arguments = sys.argv[1:] if arguments is None else arguments
    debug = bool(os.environ.get("ANTINODE_DEBUG"))
    try:
        with warnings.catch_warnings():
            if not debug:
                warnings.simplefilter("ignore")
            if not arguments or arguments[0].startswith("-"):
                import_all()
            app(arguments, print_error=False, exit_on_error=False, result_action="return_none")
        sys.stdout.flush()
    except CycloptsError as error:
        return _fail(_usage(error), 2)
    except AntinodeError as error:
        return _fail(str(error), error.exit_code)
    except SystemExit as end:
        if isinstance(end.__context__, BrokenPipeError):  # rich ends so where nobody reads
            return 0
        raise
    except (KeyboardInterrupt, BrokenPipeError) as error:
        _close_stdout()
        return _fail("interrupted", 130) if isinstance(error, KeyboardInterrupt) else 0
    except OSError as error:
        if debug:
            raise
        return _fail(f"{_what_failed(error)}; make room, or check the disk and the folder", 1)
    except MemoryError:
        return _fail("there is not enough memory; ask for fewer modes or a larger tolerance", 1)
    except Exception as error:
        if debug:
            raise
        return _fail(f"{type(error).__name__}: {error}; {_BUG}", 1)
    return 0


def _what_failed(error: OSError) -> str:
    """Say what the system would not do, and with which file."""
    name = f"{short(str(error.filename))}: " if error.filename else ""
    return f"{name}a file could not be read or written ({error.strerror or error})"


def _usage(error: CycloptsError) -> str:
    """Say what is wrong with the command line."""
    command = " ".join(["antinode", *(error.command_chain or ())])
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        return f"{short(error.unused_tokens[0])} is one argument too many (see '{command} --help')"
    return f"{str(error).rstrip('.')} (see '{command} --help')"


def _nowhere() -> TextIO:
    return Path(os.devnull).open("w", encoding="utf-8")


def _close_stdout() -> None:
    """Let nothing be written to a pipe that nobody reads."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _fail(sentence: str, code: int) -> int:
    """Print a sentence, shortened in its middle if need be, and return the exit code."""
    print(f"antinode: {one_line(sentence, _LONGEST)}", file=sys.stderr)
    return code
