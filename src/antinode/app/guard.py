"""Who may talk to the server: this page alone, with the token where there is one, in small pieces.

An ASGI layer around everything. It refuses foreign origins (another page in the same browser), host
names that are not the server's own (DNS rebinding), bodies that are too large, and, once a token is
set, whoever does not bring it in the link or in the cookie that the link leaves.
"""

from __future__ import annotations

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs, urlsplit

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
ASGIApp = Callable[[Scope, Receive, Send], Awaitable[None]]

COOKIE = "antinode-token"
LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})


class Guard:
    """Let requests pass that may.

    Parameters
    ----------
    app : callable
        The ASGI application.
    most_bytes : int
        Largest body.
    token : str
        Asked for if not empty.
    hosts : frozenset of str
        Names that the server may be called by; empty for any.
    """

    def __init__(
        self,
        app: ASGIApp,
        most_bytes: int,
        token: str = "",
        hosts: frozenset[str] = frozenset(),
    ) -> None:
        self._app, self._most, self._token, self._hosts = app, most_bytes, token, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = {k.decode("latin-1").lower(): v.decode("latin-1") for k, v in scope["headers"]}
        refusal = self._refusal(scope, headers)
        if refusal is None:
            await self._app(scope, self._counted(receive), self._marked(scope, send))
        elif scope["type"] == "http":
            await _refuse(send, *refusal)
        else:
            await receive()
            await send({"type": "websocket.close", "code": 1008})

    def _refusal(self, scope: Scope, headers: dict[str, str]) -> tuple[int, str] | None:
        host, origin = headers.get("host", ""), headers.get("origin", "")
        try:
            name, page = urlsplit(f"//{host}").hostname or "", urlsplit(origin).netloc
        except ValueError:  # "[::1"
            return 400, "the name of the server cannot be read"
        if self._hosts and name not in self._hosts:
            return 403, "this server answers on its own address only"
        if origin and page != host:
            return 403, "requests from other pages are refused"
        if not self._is_known(scope, headers):
            return 401, "a token is needed: open the link that antinode app has printed"
        size = headers.get("content-length", "0")
        if not size.isdigit() or int(size) > self._most:
            return 413, f"at most {self._most / 1e6:g} MB are accepted"
        return None

    def _is_known(self, scope: Scope, headers: dict[str, str]) -> bool:
        """Whether the token is in the link or in the cookie."""
        if not self._token:
            return True
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            cookie = None
        brought = [_token_in(scope), cookie.value if cookie else ""]
        return any(hmac.compare_digest(t.encode(), self._token.encode()) for t in brought)

    def _counted(self, receive: Receive) -> Receive:
        """Count what arrives, for bodies without a length."""
        left = self._most

        async def counting() -> Message:
            nonlocal left
            message = await receive()
            if message["type"] == "http.request":
                left -= len(message.get("body", b""))
                if left < 0:
                    return {"type": "http.disconnect"}
            return message

        return counting

    def _marked(self, scope: Scope, send: Send) -> Send:
        """Leave the cookie with whoever brought the token in the link; lock the page down."""
        brings = bool(self._token) and bool(_token_in(scope))

        async def marking(message: Message) -> None:
            if message["type"] == "http.response.start":
                extra = [
                    (b"x-content-type-options", b"nosniff"),
                    (b"referrer-policy", b"no-referrer"),
                    (b"x-frame-options", b"DENY"),
                ]
                if brings:
                    cookie = f"{COOKIE}={self._token}; Path=/; HttpOnly; SameSite=Strict"
                    extra.append((b"set-cookie", cookie.encode()))
                message = {**message, "headers": [*message.get("headers", []), *extra]}
            await send(message)

        return marking


def _token_in(scope: Scope) -> str:
    raw: bytes = scope.get("query_string", b"")
    return parse_qs(raw.decode("latin-1")).get("token", [""])[0]


async def _refuse(send: Send, status: int, sentence: str) -> None:
    headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": f"antinode: {sentence}\n".encode()})
