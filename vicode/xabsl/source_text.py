"""Decodes the bytes of XABSL files and encodes their texts; no other module does.

The format has no encoding: teams write comments and titles in that of their editors. A file that is valid UTF-8 is read
as UTF-8, because texts in other encodings hardly ever are; others in the specified encoding, or else as Windows-1252.
"""

import codecs
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

ENCODINGS = (
    *("utf-8", "cp1252", "latin-1", "iso8859-2", "iso8859-15", "cp1250", "cp1251", "cp1253", "cp1254"),
    *("koi8-r", "koi8-u", "gbk", "gb18030", "big5", "shift_jis", "cp932", "euc_jp", "euc_kr"),
)
"""The encodings that can be specified; in each, ASCII characters are single bytes of the same value."""

_DEFAULT = "cp1252"
_TITLES = {"cp1252": "Windows-1252", "utf-8": "UTF-8", "utf-8-sig": "UTF-8"}
_UNDEFINED = (0x81, 0x8D, 0x8F, 0x90, 0x9D)
_WINDOWS_1252 = {byte: bytes([byte]).decode("cp1252") for byte in range(0x80, 0xA0) if byte not in _UNDEFINED}
"""The characters of Windows-1252 by their bytes, where it differs from latin-1."""
_WESTERN = ("cp1252", "latin-1", "iso8859-15")
_NOT_WESTERN = re.compile(rb"[\x80-\xff]{4,}|[\x83\x86-\x90\x98-\xaa\xac-\xba\xbc-\xff]{3,}|[\x81\x8d\x8f\x90\x9d]")
"""In Western languages, letters with accents stand alone or in pairs, perhaps in quotation marks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EncodedText:
    """The text of a file.

    Attributes:
        encoding: One of ENCODINGS, or "utf-8-sig" for a file with a byte order mark, which is not part of the text.
        doubtful_at: The first character where the bytes do not look like text in this encoding, None if all do.
        invalid_at: The first character whose bytes are not in this encoding, None if all are.
    """

    text: str
    encoding: str = "utf-8"
    doubtful_at: int | None = None
    invalid_at: int | None = None


ReadText = Callable[[Path], str | EncodedText]
"""Reads a file; a plain text is one that is not stored."""


class SourceEncodingError(ValueError):
    """A text cannot be written in the encoding of its file."""


def read_source(path: Path, encoding: str = "") -> EncodedText:
    """Read a file; `encoding` is that of files that are not UTF-8.

    Raises:
        OSError: The file cannot be read.
    """
    return decode_source(path.read_bytes(), encoding)


def decode_source(data: bytes, encoding: str = "") -> EncodedText:
    """Decode the content of a file; `encoding` is that of content that is not UTF-8."""
    try:
        if data.startswith(codecs.BOM_UTF8):
            return EncodedText(text=data.decode("utf-8-sig"), encoding="utf-8-sig")
        # Only ASCII is both; what is added to such a file gets the encoding of the others.
        return EncodedText(text=data.decode("utf-8"), encoding=(data.isascii() and encoding) or "utf-8")
    except UnicodeDecodeError:
        encoding = encoding or _DEFAULT
    doubtful = _NOT_WESTERN.search(data) if encoding in _WESTERN else None
    doubtful_at = doubtful.start() if doubtful else None
    if encoding == "cp1252":
        # Unlike the codec, latin-1 maps every byte to a character.
        text = data.decode("latin-1").translate(_WINDOWS_1252)
        return EncodedText(text=text, encoding=encoding, doubtful_at=doubtful_at)
    try:
        return EncodedText(text=data.decode(encoding), encoding=encoding, doubtful_at=doubtful_at)
    except UnicodeDecodeError as error:
        invalid_at = len(data[: error.start].decode(encoding))
        return EncodedText(text=data.decode(encoding, "replace"), encoding=encoding, invalid_at=invalid_at)


def encode_source(text: str, encoding: str, old: bytes | None = None) -> bytes:
    """Encode a text; `old` is the content that it replaces.

    Raises:
        SourceEncodingError: The encoding does not have a character of the text, or cannot write the old content.
    """
    try:
        if old is not None and _encode(decode_source(old, encoding).text, encoding) != old:
            raise SourceEncodingError(
                f"has bytes that {encoding_title(encoding)} does not write back; save it as UTF-8"
            )
        return _encode(text, encoding)
    except UnicodeEncodeError as error:
        character = error.object[error.start]
        title = encoding_title(encoding)
        raise SourceEncodingError(f"is in {title}, which does not have '{character}'; replace it") from error


def encoding_title(encoding: str) -> str:
    return _TITLES.get(encoding, encoding)


def find_codec(name: str) -> str | None:
    """The encoding of ENCODINGS with a name, such as "windows-1252"; None if there is none."""
    try:
        codec = codecs.lookup(name).name
    except (LookupError, ValueError):
        return None
    return next((each for each in ENCODINGS if codecs.lookup(each).name == codec), None)


def _encode(text: str, encoding: str) -> bytes:
    if encoding == "cp1252":
        return text.translate({ord(char): byte for byte, char in _WINDOWS_1252.items()}).encode("latin-1")
    return text.encode(encoding)
