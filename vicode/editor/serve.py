"""Starts the editor's server: one process, reachable only from this machine by default."""

import asyncio
import atexit
import gc
import os
import secrets
import signal
import socket
import sys
import tempfile
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.platform import end_signals, user_id

if TYPE_CHECKING:
    from nicegui import App

    from vicode.editor.session import Library
    from vicode.editor.session.recovery.autosave import AutosaveService

STORAGE_VARIABLE = "NICEGUI_STORAGE_PATH"


@dataclass(frozen=True, slots=True, kw_only=True)
class ServerAddress:
    """Host and port of the server. `token` is required if other machines can connect."""

    host: str
    port: int
    token: str = ""

    @property
    def local_host(self) -> str:
        """Host name for connections from this machine."""
        return "127.0.0.1" if self.host in ("0.0.0.0", "::") else self.host  # noqa: S104 - compared, not bound

    @property
    def url(self) -> str:
        return self.page_url("/")

    def page_url(self, path: str) -> str:
        """URL of a page, with the token."""
        shown = f"[{self.local_host}]" if ":" in self.local_host else self.local_host
        return f"http://{shown}:{self.port}{path}" + (f"?token={self.token}" if self.token else "")


def choose_address(host: str, port: int | None) -> ServerAddress:
    """Return the address to listen on: `port`, or a free port for None and 0.

    The address has a token unless only this machine can connect.

    Raises:
        OSError: The port is taken, or this machine has no such address.
    """
    is_local = host in ("127.0.0.1", "localhost", "::1")
    token = "" if is_local else secrets.token_urlsafe(24)
    return ServerAddress(host=host, port=_free_port(host, port), token=token)


def serve(
    path: Path,
    address: ServerAddress,
    *,
    open_browser: bool = True,
    tour: bool = True,
    editor_command: tuple[str, ...] = (),
    robots: tuple[str, str, str] | None = None,
) -> None:
    """Serve the editor for `path` until it is stopped; `robots` is an address, its token, and the design to open first.

    Raises:
        OSError: The path cannot be read.
    """
    # Imported objects stay alive: collecting during the imports takes a tenth of the startup time.
    gc.disable()
    _prepare_nicegui()
    from nicegui import app, background_tasks, ui
    from starlette.middleware.gzip import GZipMiddleware

    from vicode.editor.connection_limits import LimitedHttpProtocol
    from vicode.editor.gc_policy import GcPolicy
    from vicode.editor.pages.routes import register_pages

    library = _open_library(path, address, editor_command, robots)
    _prepare_process()
    start = address.page_url(_first_page(library, robots[2] if robots else ""))
    register_pages(library, _start_autosave(library), tour=tour)
    _configure_app(app, address)
    app.on_startup(lambda: background_tasks.create(_announce(path, address, start), name="announce"))
    GcPolicy(app).freeze_gc()
    gc.enable()
    ui.run(
        host=address.host,
        port=address.port,
        title="vicode",
        dark=None,
        language="en-US",
        reload=False,
        show=start if open_browser else False,
        show_welcome_message=False,
        tailwind=False,
        reconnect_timeout=60,
        storage_secret=secrets.token_urlsafe(32),
        uvicorn_logging_level="warning",
        http=LimitedHttpProtocol,
        # Compression for local connections costs more time than it saves: 0.2 s per page load.
        gzip_middleware_factory=GZipMiddleware if address.token else None,
        ws_per_message_deflate=bool(address.token),
    )


def _prepare_nicegui() -> None:
    """Choose its folder, which is in the user's project by default, and skip an import that it does not need."""
    os.environ.setdefault(STORAGE_VARIABLE, str(Path(tempfile.gettempdir()) / f"vicode{user_id()}"))
    if "aiohttp" not in sys.modules:
        # engineio needs aiohttp only in its client, and runs without it; None makes the import fail.
        sys.modules["aiohttp"] = None  # type: ignore[assignment]
        import_module("engineio.async_client")
        del sys.modules["aiohttp"]


def _open_library(
    path: Path, address: ServerAddress, editor_command: tuple[str, ...], robots: tuple[str, str, str] | None
) -> "Library":
    from vicode.editor.session import Library
    from vicode.editor.session.external_editor import ExternalEditor, find_command

    # Other machines cannot start programs here.
    is_local = not address.token
    arguments = (editor_command or find_command()) if is_local else ()
    library = Library(path, external_editor=ExternalEditor(arguments=arguments, is_local=is_local))
    library.remove_leftovers()
    if robots is not None:
        library.robots.open(*robots[:2])
    return library


def _start_autosave(library: "Library") -> "AutosaveService":
    from vicode.editor.session.recovery.autosave import AutosaveService, read_delay_s
    from vicode.editor.session.recovery.recovery_store import open_recovery_store

    autosave = AutosaveService(library, open_recovery_store(), read_delay_s())
    # A second Ctrl-C skips the shutdown of the server.
    atexit.register(autosave.close)
    return autosave


def _prepare_process() -> None:
    from vicode.editor.connection_limits import raise_file_limit
    from vicode.editor.malformed_messages import shorten_socket_errors
    from vicode.editor.props_parser import serialize_props_parser

    serialize_props_parser()
    raise_file_limit()
    shorten_socket_errors()
    _end_on_hangup()


def _end_on_hangup() -> None:
    """End as for SIGTERM, which saves, when the terminal is closed; not if that is ignored, as by nohup."""
    for number in set(end_signals()) - {signal.SIGINT, signal.SIGTERM}:
        signal.signal(number, lambda _number, _frame: signal.raise_signal(signal.SIGTERM))


def _configure_app(app: "App", address: ServerAddress) -> None:
    from nicegui import run

    # A fork of a server with threads may hang.
    run.process_pool_start_method = "spawn"
    # Quasar's loading bar is a landmark without a name, and useless here: all traffic uses one socket.
    app.config.quasar_config.update({"loadingBar": {"skipHijack": True}, "ripple": False})
    from vicode.editor.access import TOKEN_COOKIE, AccessMiddleware

    hosts = ("127.0.0.1", "localhost", "::1") if not address.token else None
    app.add_middleware(AccessMiddleware, hosts=hosts, token=address.token, cookie=f"{TOKEN_COOKIE}_{address.port}")


def _startup_message(path: Path, address: ServerAddress, start: str) -> str:
    if path.is_dir() and start != address.url:
        return f"Serving {path} at {address.url} (press Ctrl-C to stop)\nOpen {start}"
    return f"Serving {path} at {start} (press Ctrl-C to stop)"


def _first_page(library: "Library", root: str) -> str:
    """Path of the initial page: the design of the file, of `root` or of the first agent, else the home page."""
    from vicode.editor.view.page_urls import design_url

    first = library.find_initial_design(root)
    return design_url(first[0].key, first[1]) if first else "/"


async def _announce(path: Path, address: ServerAddress, start: str) -> None:
    """Print the addresses once the server accepts connections: `on_startup` runs before it listens."""
    for _attempt in range(500):
        try:
            _reader, writer = await asyncio.open_connection(address.local_host, address.port)
        except OSError:
            await asyncio.sleep(0.02)
        else:
            writer.close()
            print(_startup_message(path, address, start), flush=True)  # noqa: T201
            return


def _free_port(host: str, port: int | None) -> int:
    """Return the requested port; for None the first free one from 8321, so that the address is stable between runs.

    Raises:
        OSError: The port is taken, or this machine has no such address.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    ports = (port,) if port is not None else (*range(8321, 8421), 0)
    reason = OSError("no port is free")
    for candidate in ports:
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((host, candidate))
            except OSError as error:
                reason = OSError(f"cannot listen on {host} port {candidate}: {error.strerror or error}")
                continue
            return int(probe.getsockname()[1])
    raise reason
