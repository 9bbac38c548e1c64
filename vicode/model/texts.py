"""Enumeration and replacement of the texts of a design."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import (
    Assign,
    Call,
    Code,
    CompetenceStep,
    DecisionGroup,
    Declaration,
    Design,
    DiagramNote,
    Interrupt,
    InvariantProperty,
    Latch,
    Layer,
    ReachProperty,
    RunCode,
    State,
    Stay,
    Transition,
)
from vicode.model.traversal import iter_code, iter_constructs, iter_decisions, iter_expressions

Rewrite = Callable[[str], str]


class TextKind(StrEnum):
    """The kind of a text."""

    CODE = "code"
    EXPRESSION = "expression"
    DOC = "doc"


@dataclass(frozen=True, slots=True, kw_only=True)
class LocatedText:
    """A text with its path; `language` is set for code only."""

    path: DesignPath
    kind: TextKind
    text: str
    language: str = ""


def iter_texts(design: Design) -> Iterator[LocatedText]:
    """Yield the searchable texts: docs, expressions, and code in all languages."""
    for path, doc in _iter_docs(design):
        if doc:
            yield LocatedText(path=path, kind=TextKind.DOC, text=doc)
    for expression in iter_expressions(design):
        yield LocatedText(path=expression.path, kind=TextKind.EXPRESSION, text=expression.text)
    for placed in iter_code(design):
        for language, text in placed.code.texts:
            yield LocatedText(path=(*placed.path, language), kind=TextKind.CODE, text=text, language=language)


def rewrite_text(design: Design, path: DesignPath, rewrite: Rewrite) -> Design:
    """Rewrite the text at a path from `iter_texts`. An unknown path changes nothing."""
    changed: Design = _rewrite(design, path, rewrite)
    return changed


def _iter_docs(design: Design) -> Iterator[tuple[DesignPath, str]]:
    yield ("doc",), design.doc
    for section, declaration in design.declarations():
        yield (section, declaration.name, "doc"), declaration.doc
    yield ("common", "doc"), design.common.doc
    for state in design.states:
        yield ("states", state.name, "doc"), state.doc
    for located in iter_decisions(design):
        yield (*located.path, "doc"), located.decision.doc
    for path, construct in iter_constructs(design):
        yield (*path, "doc"), construct.doc
    for note in design.notes:
        yield ("notes", note.name, "text"), note.text


# Path keys that differ from attribute names.
_ATTRIBUTE_BY_KEY: Mapping[type, Mapping[str, str]] = {
    DecisionGroup: {"else": "otherwise"},
    Call: {"with": "arguments"},
    Assign: {"set": "values"},
    Declaration: {"default": "initial"},
    Layer: {"for": "hold"},
}
_GUARD_KEYS = ("when", "after", "code")


def _rewrite(value: Any, path: DesignPath, rewrite: Rewrite) -> Any:
    """Rewrite the text at a path below a value. Return the value unchanged if the path does not exist."""
    if not path:
        return rewrite(value) if isinstance(value, str) else value
    key, rest = path[0], path[1:]
    match value:
        case tuple():
            return tuple(_rewrite_item(item, index, path, rewrite) for index, item in enumerate(value))
        case Code(texts=texts):
            return replace(value, texts=tuple((name, rewrite(text) if name == key else text) for name, text in texts))
        case Transition() | Stay() | DecisionGroup() if key in _GUARD_KEYS:
            return replace(value, guard=_rewrite(value.guard, path, rewrite))
    attribute = _ATTRIBUTE_BY_KEY.get(type(value), {}).get(str(key), str(key))
    if not hasattr(value, attribute):
        return value
    return replace(value, **{attribute: _rewrite(getattr(value, attribute), rest, rewrite)})


def _rewrite_item(item: Any, at: int, path: DesignPath, rewrite: Rewrite) -> Any:
    """Rewrite a list item if the first key is its index or name."""
    key, rest = path[0], path[1:]
    match item:
        case State() | Declaration() | DiagramNote() | Latch() | CompetenceStep() | Layer() if isinstance(key, str):
            return _rewrite(item, rest, rewrite) if item.name == key else item
        case Call(alias=alias, arguments=arguments) if isinstance(key, str):
            # In `modulates`, parameters follow the alias directly.
            return replace(item, arguments=_rewrite(arguments, rest, rewrite)) if alias == key else item
        case (str(name), str(text)):
            return (name, rewrite(text)) if name == key and not rest else item
        case Transition() | Stay() | DecisionGroup() | Assign() | Call() | RunCode() if at == key:
            return _rewrite(item, rest, rewrite)
        case ReachProperty() | InvariantProperty() | Interrupt() if at == key:
            return _rewrite(item, rest, rewrite)
        case _:
            return item
