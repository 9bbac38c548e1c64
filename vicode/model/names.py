"""What may be a name, and names in other spellings."""

import keyword
import re
import unicodedata

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z", re.ASCII)
_STATE_NAME = re.compile(r"[A-Za-z0-9_]+\Z", re.ASCII)
_WORD_BOUNDARY = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


def is_valid_name(text: str) -> bool:
    """A name of a component, alias, parameter, output, variable, constant, enumeration or element."""
    return bool(_NAME.match(text)) and len(text) <= 80


def is_valid_state_name(text: str) -> bool:
    """A state's name may also begin with a digit: `1e3`, `on`, `2_steps`."""
    return bool(_STATE_NAME.match(text)) and len(text) <= 80


def name_from_text(text: str) -> str:
    """The name that a text comes nearest to: `My robot` as `MyRobot`; empty if there is none."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    words = re.findall(r"[A-Za-z0-9_]+", plain)
    name = "".join(word[:1].upper() + word[1:] for word in words).lstrip("0123456789_")
    name = name[:1].upper() + name[1:]
    return name if is_valid_name(name) else ""


def snake_case(name: str) -> str:
    """`LookForBall` as `look_for_ball`."""
    return _WORD_BOUNDARY.sub("_", name).lower()


def python_attribute_name(name: str) -> str:
    """A name of XABSL as an attribute of Python: `ball.seen` as `ball_seen`, `class` as `class_`."""
    plain = name.replace(".", "_")
    return f"{plain}_" if keyword.iskeyword(plain) else plain
