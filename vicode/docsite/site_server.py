"""Serves a site on this machine and reloads its pages after each build.

The server inserts the reload script into pages; the files on disk do not contain it.
"""

import json
import posixpath
import secrets
import threading
from collections.abc import Iterable
from dataclasses import dataclass, field
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs, unquote, urlsplit

from vicode.docsite.not_found import not_found_page
from vicode.templating import read_asset

HOST = "127.0.0.1"
_INTERNAL_PREFIX = "/-/"
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
_PING_S = 15.0


@dataclass(slots=True)
class ReloadBroadcaster:
    """Publishes builds to all browsers: changed files and current errors."""

    errors: str = ""
    _server_id: str = field(default_factory=lambda: secrets.token_hex(4))
    _build_number: int = 0
    _changed: dict[str, int] = field(default_factory=dict)
    _condition: threading.Condition = field(default_factory=threading.Condition)
    _is_closed: bool = False

    @property
    def build_id(self) -> str:
        return f"{self._server_id}.{self._build_number}"

    def publish(self, changed: Iterable[str], errors: str) -> None:
        """Announce changed files by URL path, and the current errors."""
        with self._condition:
            self._build_number += 1
            self._changed |= dict.fromkeys(changed, self._build_number)
            self.errors = errors
            self._condition.notify_all()

    def close(self) -> None:
        """Release all waiting requests."""
        with self._condition:
            self._is_closed = True
            self._condition.notify_all()

    def message_since(self, build: str) -> str:
        """The changes since a build as JSON; for an unknown build, all files."""
        name, _dot, number = build.partition(".")
        is_known = name == self._server_id and number.isdecimal()
        changed = [path for path, at in self._changed.items() if at > int(number)] if is_known else ["*"]
        return json.dumps({"changed": sorted(changed), "errors": self.errors})

    def wait(self, number: int) -> int | None:
        """Wait for a new build, up to a timeout; return its number, or None after `close`."""
        with self._condition:
            self._condition.wait_for(lambda: self._is_closed or self._build_number != number, timeout=_PING_S)
            return None if self._is_closed else self._build_number


class SiteServer:
    """Serves a folder on this machine, in background threads. Call `close` when done."""

    def __init__(self, folder: Path, broadcaster: ReloadBroadcaster, port: int = 0) -> None:
        """Listen on a port; by default, on a free one.

        Raises:
            OSError: The port is taken.
        """
        self._broadcaster = broadcaster
        self._server = _HttpServer(folder.resolve(), broadcaster, port)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://{HOST}:{self._server.server_port}/"

    def close(self) -> None:
        self._broadcaster.close()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def __enter__(self) -> "SiteServer":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()


def add_reload_script(html: str, build_id: str) -> str:
    style = f'<link rel="stylesheet" href="{_INTERNAL_PREFIX}live_reload.css">'
    script = f'<script src="{_INTERNAL_PREFIX}live_reload.js" data-build="{build_id}" defer></script>'
    return html.replace("</head>", f"{style}\n{script}\n</head>", 1)


class _HttpServer(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, folder: Path, news: ReloadBroadcaster, port: int) -> None:
        self.folder, self.broadcaster = folder, news
        super().__init__((HOST, port), _RequestHandler)


class _RequestHandler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: _HttpServer

    def do_GET(self) -> None:
        """Send a file of the site, or the event stream."""
        address = urlsplit(self.path)
        if not self._has_local_host():
            self._send(HTTPStatus.FORBIDDEN, b"This server answers to 127.0.0.1 and localhost alone.\n", "text/plain")
        elif address.path == f"{_INTERNAL_PREFIX}events":
            self._send_events(parse_qs(address.query).get("since", [""])[0])
        elif address.path.startswith(_INTERNAL_PREFIX):
            self._send_internal(address.path.removeprefix(_INTERNAL_PREFIX))
        else:
            self._send_file(unquote(address.path))

    def _has_local_host(self) -> bool:
        """Check the host name against DNS rebinding: a foreign page sends its own name as the host."""
        port = self.server.server_port
        return self.headers.get("Host") in (f"{HOST}:{port}", f"localhost:{port}")

    def _send_internal(self, name: str) -> None:
        if name not in ("live_reload.js", "live_reload.css"):
            self._send(HTTPStatus.NOT_FOUND, b"", "text/plain")
            return
        self._send(HTTPStatus.OK, read_asset(f"docsite/{name}").encode(), _TYPES[Path(name).suffix])

    def _send_file(self, path: str) -> None:
        content = _read_site_file(self.server.folder, path)
        status = HTTPStatus.NOT_FOUND if content is None else HTTPStatus.OK
        kind = _TYPES.get(posixpath.splitext(path)[1], _TYPES[".html"])
        if content is None or kind == _TYPES[".html"]:
            html = not_found_page("/") if content is None else content.decode("utf-8", "replace")
            content, kind = add_reload_script(html, self.server.broadcaster.build_id).encode(), _TYPES[".html"]
        self._send(status, content, kind)

    def _send_events(self, build: str) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        number: int | None = None
        try:
            while True:
                text = f"data: {self.server.broadcaster.message_since(build)}\n\n"
                self.wfile.write(text.encode())
                self.wfile.flush()
                number = self.server.broadcaster.wait(-1 if number is None else number)
                if number is None:
                    return
        except OSError:
            # The browser disconnected.
            return

    def _send(self, status: HTTPStatus, content: bytes, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - as the library has it
        """Suppress the request log."""


def _read_site_file(folder: Path, path: str) -> bytes | None:
    """The file at a URL path; only generated files inside the folder."""
    name = path.removeprefix("/")
    if not name or name.endswith("/"):
        name += "index.html"
    try:
        file = (folder / name).resolve()
        is_meant = file.is_relative_to(folder) and file.suffix in _TYPES
        return file.read_bytes() if is_meant else None
    except (OSError, ValueError):
        return None
