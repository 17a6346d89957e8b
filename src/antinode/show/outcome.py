"""What every command does with its result: drawn, printed as JSON, and said to be written.

What is heavy is imported where it is used, so that a command which draws nothing starts quickly.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.text import one_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def check_plot(path: Path | None) -> None:
    """Raise InputError if a figure is asked for that cannot be drawn, before any work is done."""
    if path:
        from .figures import check_plot as check

        check(path)


def draw(figure: Figure, path: Path) -> None:
    """Write a figure, and say so."""
    from .figures import save

    save(figure, path)
    say_written(path)


def print_json(data: dict[str, Any]) -> None:
    """Print one JSON object."""
    from .writing import to_json

    sys.stdout.write(to_json(data) + "\n")


def say_notes(notes: Iterable[str]) -> None:
    """Say what a file leaves out."""
    for note in notes:
        sys.stderr.write(f"note: {one_line(note, 300)}\n")


def say_written(*paths: Path) -> None:
    """Say which files were written."""
    sys.stderr.write("wrote " + ", ".join(map(str, paths)) + "\n")
