"""Files from the browser: one address for all pages, each page with a key of its own.

A route for each page, as NiceGUI's own element for uploads makes it, is kept by caches of its web
framework after the page has gone, with all that the page holds.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, Protocol
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from starlette.requests import Request
    from starlette.responses import Response

ADDRESS = "/antinode/files"
MOST_FILES = 10


class Taker(Protocol):
    """A page that takes files."""

    async def take_files(self, files: dict[str, bytes]) -> None:
        """Take contents by name."""


_takers: WeakValueDictionary[str, Taker] = WeakValueDictionary()


def register(key: str, taker: Taker) -> None:
    """Let files that are sent with a key go to a page, as long as it lives."""
    _takers[key] = taker


def route() -> Callable[[Request], Coroutine[Any, Any, Response]]:
    """Return what answers to the address."""
    from starlette.formparsers import MultiPartException
    from starlette.responses import PlainTextResponse

    async def receive(request: Request) -> Response:
        taker = _takers.get(request.query_params.get("page", ""))
        if taker is None:
            return PlainTextResponse("this page is no longer open; load it again", 404)
        try:
            async with request.form(max_files=MOST_FILES, max_fields=0) as form:
                files = {
                    str(file.filename): await file.read()
                    for _, file in form.multi_items()
                    if not isinstance(file, str)
                }
        except MultiPartException:
            return PlainTextResponse(f"at most {MOST_FILES} files can be dropped at once", 400)
        await taker.take_files(files)
        return PlainTextResponse("taken")

    return receive
