"""Guards as people type them: an expression, a time, or both, such as "distance < 0.5 after 2 s".

The text is split at a phrase that can only be a time ("20 s", "after 20 s", "after TIMEOUT"), at its end or at its
beginning; the other part must be an expression. What is an expression as a whole is not split, and neither is what
has two readings, such as "a or b after 2 s": it stays as typed, and the check reports it.
"""

import ast
import re
from dataclasses import replace
from decimal import Decimal

from vicode.model.design import Guard
from vicode.model.python_parser import parse_single_expression

_MAX_LENGTH = 1000
_SECONDS = "s"
_UNITS_MS = {
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), Decimal(1)),
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), Decimal(1000)),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), Decimal(60_000)),
    **dict.fromkeys(("h", "hour", "hours"), Decimal(3_600_000)),
}
_NUMBER = r"(?:\d+\.?\d*|\.\d+)"
_UNIT = rf"\s*(?:{'|'.join(_UNITS_MS)})\b"
_DURATION = rf"(?P<duration>{_NUMBER}{_UNIT}(?:\s+{_NUMBER}{_UNIT})*)"
# A number without a unit is in the unit of the design; a name is that of a constant.
_PLAIN = rf"(?P<plain>{_NUMBER}|[^\W\d]\w*)(?!{_UNIT})"
_WHEN = r"(?P<when>.+?)"
_PATTERNS = tuple(
    re.compile(pattern, re.IGNORECASE | re.DOTALL | re.ASCII)
    for pattern in (
        rf"(?:after\s+)?{_DURATION}",
        rf"after\s+{_PLAIN}",
        rf"{_WHEN}\s*(?P<join>,(?!\d)|&&|\band\b)\s*(?:after\s+)?{_DURATION}",
        rf"{_WHEN}\s*(?P<join>,(?!\d)|&&|\band\b)\s*after\s+{_PLAIN}",
        rf"{_WHEN}(?P<join>\s)\s*after\s+(?:{_DURATION})",
        rf"{_WHEN}(?P<join>\s)\s*after\s+{_PLAIN}",
        rf"(?:after\s+)?{_DURATION}\s*(?P<join>,(?!\d)|:|&&|\band\b|\bif\b|\bwhen\b)\s*{_WHEN}",
        rf"after\s+{_PLAIN}\s*(?P<join>,(?!\d)|:|&&|\band\b|\bif\b|\bwhen\b)\s*{_WHEN}",
        rf"after\s+{_DURATION}(?P<join>\s)\s*{_WHEN}",
    )
)
_CLEAR_JOINS = (",", ":", "if", "when")


def read_guard(text: str, time_unit: str) -> Guard | None:
    """The expression and the time of a text, the time in `time_unit` ("" for seconds); None if it stays as typed."""
    text = text.strip()
    if len(text) > _MAX_LENGTH or _parse(text) is not None:
        return None
    for pattern in _PATTERNS:
        match = pattern.fullmatch(text)
        if match is None or not (after := _read_time(match, time_unit)):
            continue
        found = match.groupdict()
        when = (found.get("when") or "").strip()
        if not when or _can_be_joined(when, found["join"].lower()):
            return Guard(when=when, after=after)
    return None


def write_guard(guard: Guard, time_unit: str) -> str | None:
    """The text of the expression and the time of a guard; None if `read_guard` would not split it into the same two."""
    when, after = " ".join(guard.when.split()), guard.after
    if not after:
        text = when
    else:
        unit = f" {time_unit or _SECONDS}" if re.fullmatch(_NUMBER, after) else ""
        join = "" if not when else " " if _can_be_joined(when, " ") else ", "
        text = f"{when}{join}after {after}{unit}"
    read = change_guard(Guard(), text, time_unit)
    return text if (read.when, read.after) == (when, after) else None


def parse_guard(text: str, time_unit: str) -> Guard | None:
    """The guard that a text means; None if it is neither empty nor an expression nor has a readable time."""
    text = text.strip()
    if not text or _parse(text) is not None:
        return Guard(when=text)
    return read_guard(text, time_unit)


def change_guard(guard: Guard, text: str, time_unit: str) -> Guard:
    """The guard with the expression and the time of a text; its code stays, and so do its line breaks."""
    typed = read_guard(text, time_unit) or Guard(when=text.strip())
    when = guard.when if typed.when == " ".join(guard.when.split()) else typed.when
    return replace(guard, when=when, after=typed.after)


def settle_guard(guard: Guard, time_unit: str) -> Guard:
    """The guard with a time that was typed with a unit, or into the expression, where it belongs.

    A second time stays where it was typed.
    """
    time = read_guard(guard.after, time_unit)
    if time is not None and not time.when:
        guard = replace(guard, after=time.after)
    typed = read_guard(guard.when, time_unit)
    if typed is None or guard.after not in ("", typed.after):
        return guard
    return replace(guard, when=typed.when, after=typed.after)


def _read_time(match: re.Match[str], time_unit: str) -> str:
    """The time as the text of an expression; "" if it is none."""
    found, unit_ms = match.groupdict(), _UNITS_MS[time_unit or _SECONDS]
    plain = found.get("plain") or ""
    parts = re.findall(rf"({_NUMBER})\s*([a-z]+)", found.get("duration") or "", re.IGNORECASE | re.ASCII)
    if len(parts) == 1 and _UNITS_MS[parts[0][1].lower()] == unit_ms:
        plain = parts[0][0]
    elif parts:
        total_ms = sum((Decimal(number) * _UNITS_MS[unit.lower()] for number, unit in parts), Decimal(0))
        plain = format((total_ms / unit_ms).normalize(), "f")
    return plain if _parse(plain) is not None else ""


def _can_be_joined(when: str, join: str) -> bool:
    """Whether a text is an expression of which the time cannot be read as the last or first part."""
    tree = _parse(when)
    if tree is None:
        return False
    is_open = isinstance(tree, ast.IfExp | ast.Lambda) or (isinstance(tree, ast.BoolOp) and isinstance(tree.op, ast.Or))
    is_bracketed = when.startswith("(") and when.endswith(")") and _parse(when[1:-1].strip()) is not None
    return join in _CLEAR_JOINS or is_bracketed or not is_open


def _parse(text: str) -> ast.expr | None:
    try:
        return parse_single_expression(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
