"""The server of the page: on loopback unless told otherwise, with a token then."""

from __future__ import annotations

import asyncio
import logging
import secrets
import sys
import warnings
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from antinode.errors import AntinodeError, InputError
from antinode.extras import import_extra

if TYPE_CHECKING:
    from .state import State

_UPLOAD_ROOM = 1_000_000  # bytes of a form around its files


def run_app(
    path: Path | None,
    assignments: Iterable[str] = (),
    *,
    host: str = "127.0.0.1",
    port: int = 8050,
    show: bool = False,
) -> None:
    """Serve the page until it is stopped.

    Parameters
    ----------
    path : Path or None
        A case or beam file; None the starter case.
    assignments : iterable of str
        Overrides as with `--set`.
    host : str
        Address to listen on. Beyond loopback a token is needed, which the printed link holds.
    port : int
        0 takes a free one.
    show : bool
        Whether to open the page in the browser.

    Raises
    ------
    InputError
        If the file is wrong, NiceGUI is not installed, or the port is taken.
    """
    state = first_state(path, assignments)
    _import_nicegui()
    from .guard import LOOPBACK

    port = _free_port(host, port)
    token = "" if host in LOOPBACK else secrets.token_urlsafe(24)
    link = f"http://{_in_url(_reachable(host))}:{port}/" + (f"?token={token}" if token else "")
    sys.stderr.write(f"antinode: the page is at {link} (Ctrl-C ends it)\n")
    sys.stderr.flush()
    serve(state, host, port, token, show=show)


def first_state(path: Path | None, assignments: Iterable[str] = ()) -> State:
    """Return what the page shows first."""
    from .source import read_example, read_file
    from .state import File, State

    if path is not None:
        return State(read_file(path, assignments))
    return State(File(read_example("starter").tables, "starter.toml"))


def serve(state: State, host: str, port: int, token: str = "", *, show: bool = False) -> None:
    """Build the application and run it."""
    from nicegui import app, ui

    from .guard import LOOPBACK, Guard
    from .quick import warm_up
    from .source import MOST_BYTES

    hosts = LOOPBACK if host in LOOPBACK else frozenset[str]()
    app.add_middleware(
        Guard,
        most_bytes=MOST_BYTES + _UPLOAD_ROOM,
        token=token,
        hosts=hosts,
    )
    app.on_startup(warm_up)
    add_page(state)
    logging.getLogger("nicegui").setLevel(logging.ERROR)
    ui.run(
        host=host,
        port=port,
        title="antinode",
        favicon=Path(__file__).parent / "static" / "favicon.svg",
        show=show,
        reload=False,
        reconnect_timeout=30.0,
        show_welcome_message=False,
        binding_refresh_interval=None,
        tailwind=False,
        uvicorn_logging_level="error",
    )


def add_page(state: State) -> None:
    """Register the page; each visitor starts from `state`, or from what the link says."""
    from nicegui import app, ui
    from starlette.requests import Request

    from .page import Page  # before the first visit: the kernel is loaded in a thread meanwhile
    from .uploads import ADDRESS, route

    app.add_route(ADDRESS, route(), methods=["POST"])

    async def index(request: Request) -> None:
        # beside the event loop: a link may hold a whole file
        Page(*await asyncio.to_thread(opened, state, dict(request.query_params)))

    index.__annotations__["request"] = Request
    ui.page("/", title="antinode")(index)


def opened(state: State, query: dict[str, str]) -> tuple[State, str]:
    """Return what a link asks for, and what is wrong with it; then what can be shown of it."""
    try:
        asked = state.from_query(query)
        _ = asked.original
    except InputError as error:
        return state, str(error)
    try:
        _ = asked.problem
    except AntinodeError as error:
        return replace(asked, changes={}), f"the link's values are left out: {error}"
    return asked, ""


def _import_nicegui() -> None:
    """Import NiceGUI, or say how to install it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import_extra("nicegui", "web")


def _free_port(host: str, port: int) -> int:
    """Return the port, a free one for 0, or say that it is taken."""
    import socket

    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            say = "name another one with --port, or 0 for any free one"
            raise InputError(f"port {port} on {host} cannot be used ({reason}); {say}") from error
        return int(probe.getsockname()[1])


def _reachable(host: str) -> str:
    """Return an address that a browser can open: for "all of this machine", one of them."""
    import socket

    if host not in ("0.0.0.0", "::", ""):
        return host
    family, beyond = (
        (socket.AF_INET6, "2001:db8::1") if ":" in host else (socket.AF_INET, "192.0.2.1")
    )
    with socket.socket(family, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((beyond, 9))  # chooses the way out; nothing is sent
            return str(probe.getsockname()[0])
        except OSError:
            return socket.gethostname()


def _in_url(host: str) -> str:
    return f"[{host}]" if ":" in host else host
