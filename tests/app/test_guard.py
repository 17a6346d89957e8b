"""Who may talk to the server."""

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from antinode.app.guard import LOOPBACK, Guard
from antinode.app.server import _free_port, first_state, opened
from antinode.errors import InputError
from app_browser import run_async
from cli_run import run


async def answer(scope, receive, send):
    """An application that reads all of a body and says yes."""
    more = True
    while more and scope["type"] == "http":
        message = await receive()
        if message["type"] == "http.disconnect":
            return
        more = message.get("more_body", False)
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"yes"})


def ask(guard, headers=(), query=b"", kind="http", body=(b"",)):
    """Send one request through a guard; return the messages that come back."""
    scope = {"type": kind, "headers": list(headers), "query_string": query, "path": "/"}
    parts = [{"type": "http.request", "body": b, "more_body": True} for b in body]
    parts[-1]["more_body"] = False
    sent = []

    async def receive():
        return parts.pop(0)

    async def send(message):
        sent.append(message)

    run_async(guard(scope, receive, send))
    return sent


HERE = (b"host", b"127.0.0.1:8050")


def status(sent):
    return sent[0].get("status", sent[0]["type"])


def test_its_own_page_passes():
    sent = ask(Guard(answer, 100, hosts=LOOPBACK), [HERE, (b"origin", b"http://127.0.0.1:8050")])
    assert status(sent) == 200
    assert (b"x-content-type-options", b"nosniff") in sent[0]["headers"]


@pytest.mark.parametrize(
    ("headers", "code"),
    [
        ([(b"host", b"evil.example")], 403),
        ([HERE, (b"origin", b"http://evil.example")], 403),
        ([HERE, (b"origin", b"null")], 403),
        ([(b"host", b"[::1")], 400),
        ([HERE, (b"origin", b"http://[::1")], 400),
        ([HERE, (b"content-length", b"101")], 413),
        ([HERE, (b"content-length", b"-1")], 413),
        ([], 403),
    ],
)
def test_others_are_refused(headers, code):
    assert status(ask(Guard(answer, 100, hosts=LOOPBACK), headers)) == code


def test_a_foreign_page_gets_no_websocket():
    headers = [HERE, (b"origin", b"http://evil.example")]
    sent = ask(Guard(answer, 100, hosts=LOOPBACK), headers, kind="websocket")
    assert status(sent) == "websocket.close"


def test_a_body_that_grows_too_large_is_cut():
    assert ask(Guard(answer, 100), [HERE], body=(b"x" * 60, b"x" * 60)) == []


def test_a_token_is_asked_for_and_kept_in_a_cookie():
    guard = Guard(answer, 100, token="secret")
    assert status(ask(guard, [HERE])) == 401
    assert status(ask(guard, [HERE], query=b"token=wrong")) == 401
    assert status(ask(guard, [HERE, (b"cookie", "antinode-token=\u00e9".encode("latin-1"))])) == 401
    sent = ask(guard, [HERE], query=b"token=secret")
    cookie = dict(sent[0]["headers"])[b"set-cookie"]
    assert b"HttpOnly" in cookie
    assert b"SameSite=Strict" in cookie
    assert status(ask(guard, [HERE, (b"cookie", cookie.partition(b";")[0])])) == 200


def test_a_port_that_is_taken_is_a_sentence():
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=f"port {port} on 127.0.0.1 cannot be used"):
            _free_port("127.0.0.1", port)
    with pytest.raises(InputError, match="cannot be used"):
        _free_port("127.0.0.1", 99_999)


def test_a_wrong_file_ends_the_command(tmp_path):
    done = run("app", str(tmp_path / "none.toml"))
    assert done.code == 2
    assert "no such file" in done.err


def test_a_damaged_link_opens_the_first_state():
    state = first_state(None)
    shown, complaint = opened(state, {"set": "{"})
    assert shown is state
    assert "damaged" in complaint
