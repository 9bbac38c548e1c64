"""Who may speak to the editor's server, and how much at once."""

import asyncio
import socket
from typing import Any

import pytest

from vicode.editor.access import MAX_BODY_BYTES, TOKEN_COOKIE, AccessMiddleware
from vicode.editor.serve import ServerAddress, choose_address

Headers = dict[str, str]


async def _application(scope: Any, receive: Any, send: Any) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"page"})


def ask(guard: AccessMiddleware, headers: Headers, **scope: Any) -> list[dict[str, Any]]:
    sent: list[dict[str, Any]] = []
    bodies = iter(scope.pop("bodies", [b""]))
    body = next(bodies)

    async def receive() -> dict[str, Any]:
        nonlocal body
        current, body = body, next(bodies, None)
        return {"type": "http.request", "body": current or b"", "more_body": body is not None}

    async def send(message: Any) -> None:
        sent.append(message)

    raw = [(name.encode(), value.encode()) for name, value in headers.items()]
    whole = {"type": "http", "method": "GET", "path": "/", "query_string": b"", "headers": raw, **scope}
    asyncio.run(guard(whole, receive, send))
    return sent


LOCAL = AccessMiddleware(_application, hosts=("127.0.0.1", "localhost", "::1"))
OPEN = AccessMiddleware(_application, hosts=None, token="secret")


@pytest.mark.parametrize(
    ("headers", "scope", "status"),
    [
        ({"host": "127.0.0.1:8321"}, {}, 200),
        ({"host": "localhost:8321"}, {}, 200),
        ({"host": "[::1]:8321"}, {}, 200),
        ({"host": "evil.example"}, {}, 403),
        ({"host": "127.0.0.1.evil.example"}, {}, 403),
        ({"host": "evil.example@127.0.0.1"}, {}, 200),
        ({}, {}, 403),
        ({"host": "[::1"}, {}, 403),
        ({"host": "127.0.0.1:1", "origin": "http://[::1"}, {"method": "POST"}, 403),
        ({"host": "127.0.0.1:1", "origin": "http://evil.example"}, {}, 200),
        ({"host": "127.0.0.1:1", "origin": "http://evil.example"}, {"method": "POST"}, 403),
        ({"host": "127.0.0.1:1", "origin": "null"}, {"method": "POST"}, 403),
        ({"host": "127.0.0.1:1", "origin": "http://127.0.0.1:2"}, {"method": "POST"}, 403),
        ({"host": "127.0.0.1:1", "origin": "http://127.0.0.1:1"}, {"method": "POST"}, 200),
        ({"host": "127.0.0.1:1", "origin": "http://evil.example"}, {"path": "/_nicegui_ws/socket.io/"}, 403),
    ],
)
def test_hosts_and_origins(headers: Headers, scope: dict[str, Any], status: int) -> None:
    assert ask(LOCAL, headers, **scope)[0]["status"] == status


@pytest.mark.parametrize(
    ("origin", "kind"), [("http://evil.example", "websocket.close"), ("http://127.0.0.1:1", "websocket.accept")]
)
def test_foreign_sockets_are_closed(origin: str, kind: str) -> None:
    assert ask(LOCAL, {"host": "127.0.0.1:1", "origin": origin}, type="websocket")[0]["type"] == kind


def fetched(site: str, mode: str, dest: str, **more: str) -> Headers:
    given = {"host": "127.0.0.1:1", "sec-fetch-site": site, "sec-fetch-mode": mode, "sec-fetch-dest": dest, **more}
    return {name.replace("_", "-"): value for name, value in given.items()}


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        (fetched("none", "navigate", "document"), 200),
        (fetched("same-origin", "cors", "empty"), 200),
        (fetched("same-origin", "no-cors", "script"), 200),
        (fetched("cross-site", "navigate", "document"), 200),
        (fetched("same-site", "navigate", "document"), 200),
        (fetched("cross-site", "no-cors", "image"), 403),
        (fetched("cross-site", "cors", "empty"), 403),
        (fetched("same-site", "no-cors", "empty"), 403),
        (fetched("cross-site", "navigate", "iframe"), 403),
        (fetched("cross-site", "navigate", "object"), 403),
        (fetched("cross-site", "navigate", "document", sec_purpose="prefetch;prerender"), 403),
        (fetched("cross-site", "no-cors", "document"), 403),
        (fetched("later", "no-cors", "image"), 403),
    ],
)
def test_other_sites_may_link_to_the_editor_but_not_load_it(headers: Headers, status: int) -> None:
    assert ask(LOCAL, headers)[0]["status"] == status


def test_a_socket_of_another_site_is_closed_without_an_origin() -> None:
    assert ask(LOCAL, fetched("cross-site", "websocket", "websocket"), type="websocket")[0]["type"] == "websocket.close"


def test_answers_cannot_be_framed() -> None:
    headers = dict(ask(LOCAL, {"host": "localhost"})[0]["headers"])
    assert headers[b"content-security-policy"] == b"frame-ancestors 'none'"
    assert headers[b"x-content-type-options"] == b"nosniff"


def test_a_body_is_counted_as_it_comes() -> None:
    small = ask(LOCAL, {"host": "localhost"}, method="POST", bodies=[b"x" * 1000] * 3)
    assert small[0]["status"] == 200
    large = ask(
        LOCAL, {"host": "localhost"}, method="POST", bodies=[b"x" * 1_000_000] * (MAX_BODY_BYTES // 1_000_000 + 2)
    )
    assert large[0]["status"] == 413


def test_a_body_that_says_it_is_too_large_is_not_read() -> None:
    headers = {"host": "localhost", "content-length": str(MAX_BODY_BYTES + 1)}
    assert ask(LOCAL, headers, method="POST")[0]["status"] == 413
    assert ask(LOCAL, {**headers, "content-length": "9" * 30}, method="POST")[0]["status"] == 200
    assert ask(LOCAL, {**headers, "content-length": "²"}, method="POST")[0]["status"] == 200


def test_a_server_others_can_reach_asks_for_its_token() -> None:
    assert ask(OPEN, {"host": "robot:1"})[0]["status"] == 403
    assert ask(OPEN, {"host": "robot:1", "cookie": f"{TOKEN_COOKIE}=wrong"})[0]["status"] == 403
    assert ask(OPEN, {"host": "robot:1", "cookie": f"{TOKEN_COOKIE}=secret"})[0]["status"] == 200
    assert ask(OPEN, {"host": "robot:1"}, query_string=b"token=wrong")[0]["status"] == 403


def test_the_token_moves_from_the_address_into_a_cookie() -> None:
    answer = ask(OPEN, {"host": "robot:1"}, path="//evil.example/x", query_string=b"token=secret&a=b")[0]
    headers = dict(answer["headers"])
    assert answer["status"] == 303
    assert headers[b"location"] == b"/evil.example/x?a=b"
    assert b"HttpOnly" in headers[b"set-cookie"]


def test_a_token_is_made_for_every_address_but_this_machine() -> None:
    assert choose_address("127.0.0.1", 0).token == ""
    address = choose_address("0.0.0.0", 0)
    assert len(address.token) > 20
    assert address.url == f"http://127.0.0.1:{address.port}/?token={address.token}"
    assert ServerAddress(host="::1", port=8000).url == "http://[::1]:8000/"


def test_an_address_that_cannot_be_had_is_told_before_anything_starts() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(OSError, match=rf"127\.0\.0\.1 port {port}"):
            choose_address("127.0.0.1", port)
    with pytest.raises(OSError, match=r"192\.0\.2\.1"):
        choose_address("192.0.2.1", 0)
