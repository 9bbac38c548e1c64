"""A server for browsers on this machine: answers of one piece, and streams of server-sent events."""

import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

HOST = "127.0.0.1"


@dataclass(frozen=True, slots=True, kw_only=True)
class HttpAnswer:
    """The answer to a request; `kind` is its MIME type."""

    content: bytes = b""
    kind: str = "text/plain"
    status: HTTPStatus = HTTPStatus.OK


NOT_FOUND = HttpAnswer(status=HTTPStatus.NOT_FOUND)
_FORBIDDEN = HttpAnswer(content=b"This server answers to 127.0.0.1 and localhost alone.\n", status=HTTPStatus.FORBIDDEN)

AnswerRequest = Callable[[str], HttpAnswer | Iterator[str]]
"""Answers the path and query of a request: in one piece, or with the texts of events, where "" is no event."""


class LocalServer:
    """Serves in background threads. Call `close` when done; event streams must end before."""

    def __init__(self, answer: AnswerRequest, port: int = 0) -> None:
        """Listen on a port; by default, on a free one.

        Raises:
            OSError: The port is taken.
        """
        self._server = _HttpServer((HOST, port), _RequestHandler)
        self._server.answer = answer
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://{HOST}:{self._server.server_port}/"

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _HttpServer(ThreadingHTTPServer):
    daemon_threads = True
    answer: AnswerRequest


class _RequestHandler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: _HttpServer

    def do_GET(self) -> None:
        """Send an answer or an event stream."""
        port = self.server.server_port
        # A foreign page that resolves its own name to this machine (DNS rebinding) sends that name.
        is_local = self.headers.get("Host") in (f"{HOST}:{port}", f"localhost:{port}")
        answer = self.server.answer(self.path) if is_local else _FORBIDDEN
        if isinstance(answer, HttpAnswer):
            self._send(answer)
        else:
            self._send_events(answer)

    def _send(self, answer: HttpAnswer) -> None:
        self.send_response(answer.status)
        self.send_header("Content-Type", answer.kind)
        self.send_header("Content-Length", str(len(answer.content)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.end_headers()
        self.wfile.write(answer.content)

    def _send_events(self, events: Iterator[str]) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        try:
            for text in events:
                self.wfile.write(f"data: {text}\n\n".encode() if text else b": waiting\n\n")
        except OSError:
            # The browser disconnected.
            return

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - as the library has it
        """Suppress the request log."""
