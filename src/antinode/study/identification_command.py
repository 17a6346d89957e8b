"""What `antinode identify` does: read, fit with progress, write, print."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from .identification import identify
from .identification_file import load_identification
from .identification_report import end_progress, show_identification, stderr_progress
from .identified_case import check_folder, write_identification


def run_identification(
    file: Path, assignments: Iterable[str], folder: Path | None, *, overwrite: bool, json: bool
) -> None:
    """Identify, and give the result out.

    Raises
    ------
    KeyboardInterrupt
        After an interrupted fit, once the best values so far are written and printed.
    """
    if folder:
        check_folder(folder, overwrite=overwrite)
    problem = load_identification(file, assignments)
    try:
        result = identify(problem, progress=stderr_progress())
    finally:
        end_progress()
    if folder:
        written = write_identification(result, folder, overwrite=overwrite)
        sys.stderr.write("wrote " + ", ".join(map(str, written)) + "\n")
    if json:
        from antinode.dataset import to_json

        sys.stdout.write(to_json(result.to_dict()) + "\n")
    else:
        from antinode.printing import console

        show_identification(console(), result)
    if result.interrupted:
        sys.stdout.flush()
        raise KeyboardInterrupt
