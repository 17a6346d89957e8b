"""`antinode init`: examples as files."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from antinode.errors import InputError
from antinode.examples import EXAMPLES, write_example
from antinode.text import short


def init(
    folder: Path = Path(),
    /,
    *,
    beam: Annotated[
        bool, Parameter(help="Write a beam file instead.", negative="", show_default=False)
    ] = False,
    example: Annotated[
        str | None, Parameter(help=f"Write another example: {', '.join(EXAMPLES)}.")
    ] = None,
) -> None:
    """Write a commented, runnable case; never overwrite a file.

    - Example: **antinode init**
    - Example: **antinode init --beam my_beam**
    - Example: **antinode init --example tower my_tower**

    Parameters
    ----------
    folder
        Where to write; it is made if it does not exist.
    """
    if beam and example not in (None, "beam"):
        raise InputError(f"--beam and --example {short(example)} contradict: give one of them")
    written, command = write_example(example or ("beam" if beam else "starter"), folder)
    print("wrote " + ", ".join(str(path) for path in written))
    print(f"next: {command}")
