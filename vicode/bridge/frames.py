"""Frames of the bridge: bytes to messages and back, for lines of JXI and for JSON lines. Pure functions, no I/O.

A JXI line is `TARGET:p1,p2,…`; a JSON line is an object. Parameters of JXI stay bytes until someone reads them.
"""

import json
import math
import re
from collections.abc import Iterable
from typing import Any, NoReturn

GREETING = b"Robot connection accepted\n"
MAX_LINE_BYTES = 65_536

_TARGET = re.compile(rb"[A-Za-z_][\w.-]{0,63}", re.ASCII)
_SHOWN_BYTES = 60
_LARGEST_SHORT_FLOAT = 1e16


def _reject_constant(name: str) -> NoReturn:
    raise ValueError(name)


# json.loads and json.dumps would make one for each call.
_DECODER = json.JSONDecoder(parse_constant=_reject_constant)
_ENCODER = json.JSONEncoder(separators=(",", ":"), allow_nan=False)


class FrameError(ValueError):
    """A line that is no message; the text says why, in one line."""


class LineDecoder:
    """Splits a stream into lines, whatever the chunks are.

    Of a line that is too long, `MAX_LINE_BYTES + 1` bytes are kept: it is recognized, and the rest costs nothing.
    """

    __slots__ = ("_rest",)

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        """Return the lines that are complete now, without their ends; empty lines are left out."""
        first, newline, after = data.partition(b"\n")
        if not newline:
            self._rest = _limit(self._rest + data)
            return []
        lines = [_limit(self._rest + first), *after.split(b"\n")]
        self._rest = _limit(lines.pop())
        return [line for line in (each.rstrip(b"\r") for each in lines) if line]


def _limit(line: bytes) -> bytes:
    return line if len(line) <= MAX_LINE_BYTES else line[: MAX_LINE_BYTES + 1]


def is_json(first_byte: bytes) -> bool:
    """Whether a client that starts with this byte speaks JSON lines; all others speak JXI."""
    return first_byte == b"{"


def decode_jxi(line: bytes) -> tuple[str, bytes]:
    """Return the target of a JXI line, and its parameters as they were sent.

    Raises:
        FrameError: The line is too long, or it has no target.
    """
    _check_length(line)
    target, colon, parameters = line.partition(b":")
    name = target.strip()
    if not colon or _TARGET.fullmatch(name) is None:
        raise FrameError(f"expected TARGET:p1,p2, found {show_bytes(line)}")
    return name.decode("ascii"), parameters


def split_parameters(parameters: bytes) -> list[str]:
    """Return the parameters of a JXI line; there are none in an empty text.

    Raises:
        FrameError: They are not UTF-8.
    """
    try:
        text = parameters.decode()
    except UnicodeDecodeError:
        raise FrameError(f"expected UTF-8, found {show_bytes(parameters)}") from None
    return [each.strip() for each in text.split(",")] if text.strip() else []


def encode_jxi(target: str, parameters: Iterable[object]) -> bytes:
    """Return a JXI line. A text cannot contain commas and line breaks there: they become spaces."""
    return f"{target}:{','.join(map(_format, parameters))}\n".encode(errors="replace")


def decode_json(line: bytes) -> dict[str, Any]:
    """Return the object of a JSON line.

    Raises:
        FrameError: The line is too long, not JSON, or not an object.
    """
    _check_length(line)
    try:
        message = _DECODER.decode(line.decode())
    except (ValueError, RecursionError):
        raise FrameError(f"expected a JSON object, found {show_bytes(line)}") from None
    if not isinstance(message, dict):
        raise FrameError(f"expected a JSON object, found {show_bytes(line)}")
    return message


def encode_json(message: dict[str, Any]) -> bytes:
    """Return a JSON line.

    Raises:
        ValueError: A number is not finite.
    """
    return _ENCODER.encode(message).encode() + b"\n"


def shorten(number: float) -> float:
    """Return an equal int for a float without a fraction, which is written shorter: 5 instead of 5.0."""
    if abs(number) < _LARGEST_SHORT_FLOAT and number == int(number):
        return int(number)
    return number


def show_bytes(line: bytes) -> str:
    """Return the start of a line as printable ASCII, for messages."""
    text = ascii(line[:_SHOWN_BYTES].decode("latin-1"))
    return f"{text} …" if len(line) > _SHOWN_BYTES else text


def _check_length(line: bytes) -> None:
    if len(line) > MAX_LINE_BYTES:
        raise FrameError(f"a line has at most {MAX_LINE_BYTES} bytes; this one starts with {show_bytes(line)}")


def _format(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(shorten(value)) if math.isfinite(value) else str(value)
    return re.sub(r"[,\r\n]", " ", str(value))
