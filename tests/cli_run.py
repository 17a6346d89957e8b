"""Running the command line inside the test's process, on the examples that ship with antinode."""

import io
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import NamedTuple

from antinode.cli import main


class Ended(NamedTuple):
    """How a command ended: exit code, and what it printed."""

    code: int
    out: str
    err: str


def run(*arguments):
    """Run `antinode` with these arguments."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            main([str(argument) for argument in arguments])
        except SystemExit as end:
            return Ended(end.code, out.getvalue(), err.getvalue())
    raise AssertionError("main ends the process")


def python(*arguments):
    """Return the command that runs antinode in a process of its own."""
    return [sys.executable, "-c", "from antinode.cli import main; main()", *map(str, arguments)]


def refused(ended, *words, code=2):
    """Assert that a command said no in one clear sentence that holds these words."""
    assert ended.code == code, ended
    assert ended.out == "", ended
    assert ended.err.startswith("antinode: "), ended
    assert ended.err.endswith("\n"), ended
    assert ended.err.count("\n") == 1, ended
    assert 20 < len(ended.err) < 700, ended
    for noise in ("Traceback", "Value error", "pydantic", "function-", "bug in antinode"):
        assert noise not in ended.err, ended
    for word in words:
        assert word in ended.err, (word, ended.err)


def contents(folder):
    """Return the names and bytes of all files under a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def replaced(path: Path, old, new):
    """Replace a piece of a file that must be in it."""
    text = path.read_text(encoding="utf-8")
    assert old in text, (path, old)
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
