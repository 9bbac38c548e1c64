"""Serves a site on this machine and reloads its pages after each build.

The server inserts the reload script into pages; the files on disk do not contain it.
"""

import json
import posixpath
import secrets
import threading
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from http import HTTPStatus
from pathlib import Path
from urllib.parse import parse_qs, unquote, urlsplit

from vicode.docsite.not_found import not_found_page
from vicode.local_server import NOT_FOUND, HttpAnswer, LocalServer
from vicode.templating import read_asset

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

    def follow(self, build: str) -> Iterator[str]:
        """The changes since a build, now and after each new build, or after a timeout; ends after `close`."""
        number = -1
        while not self._is_closed:
            yield self.message_since(build)
            number = self._wait(number)

    def _wait(self, number: int) -> int:
        """Wait for another build than this one, up to a timeout, and return its number."""
        with self._condition:
            self._condition.wait_for(lambda: self._is_closed or self._build_number != number, timeout=_PING_S)
            return self._build_number


class SiteServer:
    """Serves a folder on this machine, in background threads. Call `close` when done."""

    def __init__(self, folder: Path, broadcaster: ReloadBroadcaster, port: int = 0) -> None:
        """Listen on a port; by default, on a free one.

        Raises:
            OSError: The port is taken.
        """
        self._folder, self._broadcaster = folder.resolve(), broadcaster
        self._server = LocalServer(self._answer, port)
        self.url = self._server.url

    def close(self) -> None:
        self._broadcaster.close()
        self._server.close()

    def __enter__(self) -> "SiteServer":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def _answer(self, request: str) -> HttpAnswer | Iterator[str]:
        """A file of the site, or the event stream."""
        address = urlsplit(request)
        if address.path == f"{_INTERNAL_PREFIX}events":
            return self._broadcaster.follow(parse_qs(address.query).get("since", [""])[0])
        if not address.path.startswith(_INTERNAL_PREFIX):
            return self._read_file(unquote(address.path))
        name = address.path.removeprefix(_INTERNAL_PREFIX)
        if name not in ("live_reload.js", "live_reload.css"):
            return NOT_FOUND
        return HttpAnswer(content=read_asset(f"docsite/{name}").encode(), kind=_TYPES[Path(name).suffix])

    def _read_file(self, path: str) -> HttpAnswer:
        content = _read_site_file(self._folder, path)
        kind = _TYPES.get(posixpath.splitext(path)[1], _TYPES[".html"])
        if content is not None and kind != _TYPES[".html"]:
            return HttpAnswer(content=content, kind=kind)
        html = not_found_page("/") if content is None else content.decode("utf-8", "replace")
        return HttpAnswer(
            content=add_reload_script(html, self._broadcaster.build_id).encode(),
            kind=_TYPES[".html"],
            status=HTTPStatus.NOT_FOUND if content is None else HTTPStatus.OK,
        )


def add_reload_script(html: str, build_id: str) -> str:
    style = f'<link rel="stylesheet" href="{_INTERNAL_PREFIX}live_reload.css">'
    script = f'<script src="{_INTERNAL_PREFIX}live_reload.js" data-build="{build_id}" defer></script>'
    return html.replace("</head>", f"{style}\n{script}\n</head>", 1)


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
