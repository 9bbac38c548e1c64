"""Access control of the editor's server: allowed hosts and origins, the token, and the request size.

NiceGUI checks neither Host nor Origin: without this, any web page could control a local editor by DNS rebinding.
"""

import hmac
from collections.abc import Collection
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, quote, urlencode, urlsplit

from starlette.types import ASGIApp, Message, Receive, Scope, Send

TOKEN_COOKIE = "vicode_token"  # noqa: S105 - the name of a cookie
MAX_BODY_BYTES = 8_000_000
_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"content-security-policy", b"frame-ancestors 'none'"),
    (b"referrer-policy", b"no-referrer"),
)


class RequestTooLargeError(Exception):
    """The body of a request exceeds `MAX_BODY_BYTES`."""


@dataclass(eq=False)
class AccessMiddleware:
    """ASGI middleware that checks host, origin, token and size of each request.

    Args:
        app: The application to protect.
        hosts: Accepted host names. None accepts each host and requires a `token`.
        token: Required in the cookie or in the query of the first request, unless empty.
        cookie: Name of the cookie. Browsers send the cookies of a host to all its ports, so each editor has its own.
    """

    app: ASGIApp
    hosts: Collection[str] | None
    token: str = ""
    cookie: str = TOKEN_COOKIE

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Forward the request, or answer 403 (413 if the body is too large)."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = {name.lower(): value.decode("latin-1") for name, value in scope["headers"]}
        is_token_in_query = self._token_in_query(scope)
        if not self._is_allowed(scope, headers) or not (self._has_token(headers) or is_token_in_query):
            await _refuse(scope, send, 403)
        elif _declared_length(headers) > MAX_BODY_BYTES:
            await _refuse(scope, send, 413)
        elif is_token_in_query and scope["type"] == "http" and scope["method"] == "GET":
            await self._remember_token(scope, send)
        else:
            await self._forward(scope, receive, send)

    def _is_allowed(self, scope: Scope, headers: dict[bytes, str]) -> bool:
        host = headers.get(b"host", "")
        if self.hosts is not None and _parts(f"//{host}")[0] not in self.hosts:
            return False
        if _is_embedded_elsewhere(headers):
            return False
        origin = headers.get(b"origin")
        changes = scope["type"] == "websocket" or scope.get("method") not in ("GET", "HEAD")
        if origin is None:
            return True
        is_socket_path = str(scope["path"]).startswith("/_nicegui_ws")
        return not (changes or is_socket_path) or _parts(origin)[1] == host

    def _has_token(self, headers: dict[bytes, str]) -> bool:
        if not self.token:
            return True
        try:
            cookie = SimpleCookie(headers.get(b"cookie", "")).get(self.cookie)
        except CookieError:
            return False
        return cookie is not None and hmac.compare_digest(cookie.value.encode(), self.token.encode())

    def _token_in_query(self, scope: Scope) -> bool:
        if not self.token:
            return False
        token = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        return hmac.compare_digest(token.encode(), self.token.encode())

    async def _remember_token(self, scope: Scope, send: Send) -> None:
        """Move the token from the URL, where it would be visible, to a cookie."""
        query = parse_qs(scope["query_string"].decode("latin-1"))
        query.pop("token", None)
        rest = urlencode(query, doseq=True)
        # A path that starts with two slashes would redirect to another host.
        location = "/" + quote(scope["path"].lstrip("/")) + (f"?{rest}" if rest else "")
        cookie = f"{self.cookie}={self.token}; Path=/; HttpOnly; SameSite=Strict"
        headers = [(b"location", location.encode("latin-1")), (b"set-cookie", cookie.encode()), *_HEADERS]
        await send({"type": "http.response.start", "status": 303, "headers": headers})
        await send({"type": "http.response.body", "body": b""})

    async def _forward(self, scope: Scope, receive: Receive, send: Send) -> None:
        received_bytes = 0

        async def receive_counted() -> Message:
            nonlocal received_bytes
            message = await receive()
            received_bytes += len(message.get("body", b""))
            if scope["type"] == "http" and received_bytes > MAX_BODY_BYTES:
                raise RequestTooLargeError
            return message

        is_started = False
        # NiceGUI's scripts and styles do not depend on the session. Without it, the response has neither Vary nor a
        # cookie, so that browsers take it from their cache, also after a restart.
        is_static = scope["type"] == "http" and str(scope["path"]).startswith("/_nicegui/") and "session" in scope

        async def send_with_headers(message: Message) -> None:
            nonlocal is_started
            if message["type"] == "http.response.start":
                is_started = True
                if is_static:
                    scope["session"] = type(scope["session"])()
                message = {**message, "headers": [*message.get("headers", []), *_HEADERS]}
            await send(message)

        try:
            await self.app(scope, receive_counted, send_with_headers)
        except RequestTooLargeError:
            if not is_started:
                await _refuse(scope, send, 413)


def _is_embedded_elsewhere(headers: dict[bytes, str]) -> bool:
    """Whether a page of another origin made the request, as for an image or a frame: it would build a page for nothing.

    Following a link is allowed. Browsers send these headers to addresses of this machine and with HTTPS.
    """
    if headers.get(b"sec-fetch-site", "none") in ("none", "same-origin"):
        return False
    is_link = headers.get(b"sec-fetch-mode") == "navigate" and headers.get(b"sec-fetch-dest") == "document"
    return not is_link or b"sec-purpose" in headers


def _declared_length(headers: dict[bytes, str]) -> int:
    length = headers.get(b"content-length", "")
    return int(length) if length.isdecimal() and len(length) < 20 else 0


def _parts(address: str) -> tuple[str, str]:
    """Return host name and host with port of a URL; empty strings if it is invalid."""
    try:
        parts = urlsplit(address)
    except ValueError:
        return "", ""
    return parts.hostname or "", parts.netloc


async def _refuse(scope: Scope, send: Send, status: int) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    text = b"Forbidden host or origin. Open the URL printed by 'vicode edit'.\n"
    headers = [(b"content-type", b"text/plain; charset=utf-8"), *_HEADERS]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": text})
