"""What `antinode identify` does: read, fit with progress, write, print."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from antinode.show.outcome import print_json, say_written
from antinode.study.progress import end_progress, text_progress

from .file import load_identification
from .fitted_case import check_folder, write_identification
from .identification import identify
from .report import show_identification


def run_identification(
    file: Path, assignments: Iterable[str], folder: Path | None, *, overwrite: bool, json: bool
) -> None:
    """Identify, and give the result out.

    Raises
    ------
    KeyboardInterrupt
        After an interrupted fit, once the best values so far are written and printed.
    """
    problem = load_identification(file, assignments)
    if folder:
        check_folder(folder, problem.case, overwrite=overwrite)
    try:
        result = identify(problem, progress=text_progress())
    finally:
        end_progress()
    if folder:
        say_written(*write_identification(result, folder, overwrite=overwrite))
    if json:
        print_json(result.to_dict())
    else:
        from antinode.show.printing import console

        show_identification(console(), result)
    if result.interrupted:
        sys.stdout.flush()
        raise KeyboardInterrupt
