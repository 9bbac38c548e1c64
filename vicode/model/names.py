"""Validation and conversion of names."""

import keyword
import re
import unicodedata

MAX_NAME_LENGTH = 80
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z", re.ASCII)
_STATE_NAME = re.compile(r"[A-Za-z0-9_]+\Z", re.ASCII)
_WORD_BOUNDARY = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


def is_valid_name(text: str) -> bool:
    """Return whether a text is valid as any name other than that of a state."""
    return bool(_NAME.match(text)) and len(text) <= MAX_NAME_LENGTH


def is_valid_state_name(text: str) -> bool:
    """Return whether a text is a valid state name, which may also start with a digit or underscore."""
    return bool(_STATE_NAME.match(text)) and len(text) <= MAX_NAME_LENGTH


def name_from_text(text: str) -> str:
    """Convert a text to a name, such as `My robot` to `MyRobot`. Return an empty string if this fails."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    words = re.findall(r"[A-Za-z0-9_]+", plain)
    name = "".join(word[:1].upper() + word[1:] for word in words).lstrip("0123456789_")
    name = name[:1].upper() + name[1:]
    return name if is_valid_name(name) else ""


def snake_case(name: str) -> str:
    """Convert a name such as `LookForBall` to `look_for_ball`."""
    return _WORD_BOUNDARY.sub("_", name).lower()


def identifier_stem(text: str) -> str:
    """Convert any text to a part of an identifier."""
    return re.sub(r"[^a-z0-9]+", "_", snake_case(text), flags=re.ASCII).strip("_") or "x"


def python_attribute_name(name: str) -> str:
    """Convert an XABSL name to a Python attribute: `ball.seen` to `ball_seen`, `class` to `class_`."""
    plain = name.replace(".", "_")
    return f"{plain}_" if keyword.iskeyword(plain) else plain


def package_name(name: str) -> str:
    """Convert a project name, which may be any text, to a package name."""
    stem = identifier_stem(name)
    return f"project_{stem}" if stem[0].isdigit() else stem
