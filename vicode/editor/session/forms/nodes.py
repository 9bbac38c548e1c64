"""The nodes of a form, as the browser draws it: fields, rows, sections and lists of one item of a design.

Python decides what a form contains; the browser draws it and holds what its user has typed. Paths of fields are
relative to the item.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, Literal

from vicode.findings import DesignPath

OptionList = Literal["states", "uses"]
"""A list of options that many forms share; `FormData.lists` has its values."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Title:
    """The heading of the form; the name is a link if `opens` is the id of an item."""

    text: str
    name: str = ""
    opens: tuple[str, str] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TextField:
    """A text in one or several lines. A `code` text is set in a monospace font, without corrections of the browser."""

    path: DesignPath
    label: str
    value: str
    hint: str = ""
    is_code: bool = False
    is_long: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """A choice of one option of a shared list; `value` may be none of them."""

    path: DesignPath
    label: str
    value: str
    options: OptionList


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """A checkbox."""

    path: DesignPath
    label: str
    value: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeText:
    """A code editor with completion and marks; "expression" is a single one, `language` else a key of LANGUAGES."""

    path: DesignPath
    label: str
    value: str
    language: str
    title: str = ""
    """The title of its tab, with several languages."""
    hint: str = ""
    can_open: bool = False
    """Whether the text can be opened in the user's own editor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Languages:
    """The texts of a code, one tab for each language."""

    label: str
    texts: tuple[CodeText, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """The heading of a part of the form."""

    text: str
    hint: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionRow:
    """A decision of a list, with those of a group below it."""

    target: str
    guard: str
    is_disabled: bool
    then: tuple["DecisionRow", ...] = ()
    otherwise: tuple["DecisionRow", ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Decisions:
    """The list of decisions at a path, with buttons that add, move and remove them."""

    path: DesignPath
    rows: tuple[DecisionRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Button:
    """A button that requests a `FormAction`."""

    label: str
    action: str
    path: DesignPath = ()
    icon: str = ""
    is_danger: bool = False


Node = Title | TextField | Choice | Check | CodeText | Languages | Heading | Decisions | Button
"""A part of a form."""


def form_json(nodes: Sequence[Node]) -> str:
    """The nodes as JSON: objects with the kind as "is", without the fields that have their defaults."""
    return json.dumps([_to_json(node) for node in nodes], separators=(",", ":"), ensure_ascii=False)


def _to_json(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_to_json(each) for each in value]
    if not hasattr(value, "__dataclass_fields__"):
        return value
    shown = {each.name: getattr(value, each.name) for each in fields(value)}
    defaults = {each.name: each.default for each in fields(value)}
    kept = {name: _to_json(content) for name, content in shown.items() if content != defaults[name]}
    return {"is": type(value).__name__, **kept}
