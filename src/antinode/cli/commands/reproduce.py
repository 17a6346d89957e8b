"""`antinode reproduce`: a reconstructed vehicle against the paper's tables."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from antinode.cli.options import Json
from antinode.show.outcome import print_json, say_written


def reproduce(
    *,
    out: Annotated[
        Path | None, Parameter(help="Also write figures and a page into this folder.")
    ] = None,
    json: Json = False,
) -> None:
    """Compare a reconstructed vehicle with the tables of the paper behind antinode.

    The data of the paper's own vehicle are lost. **antinode init --example paper** writes the one
    that stands in for it. Exit code 1 if a difference is beyond the bounds that ship with it.

    - Example: **antinode reproduce**
    - Example: **antinode reproduce --out paper**
    """
    from antinode.paper.comparison import check_bounds, compare

    if out:
        from antinode.paper.writing import check_folder

        check_folder(out)
    comparison = compare()
    if json:
        print_json(comparison.to_dict())
    else:
        from antinode.paper.terminal import show_comparison
        from antinode.show.printing import console

        show_comparison(console(), comparison)
    if out:
        from antinode.paper.writing import write_all

        say_written(write_all(comparison, out))
    check_bounds(comparison)
