"""Logs a malformed message of a socket as one line; the libraries log a traceback for each."""

import logging
from collections.abc import Iterator
from types import TracebackType

_LOGGERS = ("uvicorn.error", "engineio.server", "socketio.server", "asyncio")
_SOCKET_PACKAGES = ("engineio", "socketio")
# What the handlers of messages call before a message is known to be valid.
_DECODING_MODULES = ("nicegui.nicegui", "nicegui.json.orjson_wrapper", "nicegui.json.builtin_wrapper", "json.decoder")


def shorten_socket_errors() -> None:
    """Shorten the log records of messages that NiceGUI 3.18, socketio 5 or engineio 4 cannot decode."""
    for name in _LOGGERS:
        logging.getLogger(name).addFilter(shorten_record)


def shorten_record(record: logging.LogRecord) -> bool:
    """Replace the traceback if a message could not be decoded; drop the one that uvicorn logs for a second Ctrl-C."""
    if record.name == "uvicorn.error" and "KeyboardInterrupt" in str(record.msg):
        return False
    error = record.exc_info[1] if record.exc_info else None
    if error is not None and _is_decoding_error(error):
        record.msg = f"Malformed message from a browser: {type(error).__name__}: {str(error)[:200]!r}"
        record.args, record.exc_info, record.exc_text = (), None, None
    return True


def _is_decoding_error(error: BaseException) -> bool:
    """Whether no code behind the socket libraries was running."""
    modules = list(_iter_modules(error.__traceback__))
    inner = next((index for index, name in enumerate(reversed(modules)) if name.startswith(_SOCKET_PACKAGES)), None)
    return inner is not None and all(name in _DECODING_MODULES for name in modules[len(modules) - inner :])


def _iter_modules(traceback: TracebackType | None) -> Iterator[str]:
    while traceback is not None:
        yield str(traceback.tb_frame.f_globals.get("__name__"))
        traceback = traceback.tb_next
