"""`antinode app`: the page, served."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from antinode.cli.options import Set


def page(
    file: Path | None = None,
    /,
    *,
    set_: Set = (),
    host: Annotated[
        str, Parameter(help="Address to listen on; any but loopback asks for a token.")
    ] = "127.0.0.1",
    port: Annotated[int, Parameter(help="Port to listen on; 0 takes a free one.")] = 8050,
    show: Annotated[
        bool, Parameter(help="Open the page in the browser.", negative="", show_default=False)
    ] = False,
) -> None:
    """Serve a page to think with: sliders beside vehicle, forces, frequencies and modes.

    The page is for this machine alone, and loads nothing from outside. It ends with Ctrl-C.

    - Example: **antinode app**
    - Example: **antinode app case.toml --show**
    - Example: **antinode app beam.toml --port 8060**

    Parameters
    ----------
    file
        A case or beam file in TOML; by default the starter vehicle.
    """
    from antinode.app.server import run_app

    run_app(file, set_, host=host, port=port, show=show)
