"""`antinode identify`: parameters that explain observed frequencies."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.options import Json
from antinode.cli.study_options import Folder, IdentifySet, Overwrite


def identify(
    file: Path,
    /,
    *,
    set_: IdentifySet = (),
    folder: Folder = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> None:
    """Find the numbers of a vehicle, or of a beam, that explain observed frequencies.

    The file names a case or a beam file, observations of it, and what of it may change: numbers,
    numbers of every row, and distributions along the body. Printed are observed against fitted
    frequencies, values with standard deviations, and what the data leave open. Ctrl-C ends it with
    the best values so far (exit code 130).

    - Example: **antinode identify identify.toml -o fitted**
    - Example: **antinode identify identify.toml --set fit.starts=8 --json**

    Parameters
    ----------
    file
        An identification file in TOML. 'antinode schema identify' lists its keys.
    """
    from antinode.study.identify.command import run_identification

    run_identification(file, set_, folder, overwrite=overwrite, json=json)
