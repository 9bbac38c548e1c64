"""The values that forms show and change: how each is read from its owner, validated and written."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.languages import LANGUAGES
from vicode.model.design import Code, DecisionGroup, Stay, Transition


@dataclass(frozen=True, slots=True, kw_only=True)
class FormField:
    """A value of an owner (a state, a transition), as a form shows it: a text, or a bool.

    `write` returns the changed owner; `validate` returns an error message, or "" for a value that can be written.
    """

    label: str
    read: Callable[[Any], Any]
    write: Callable[[Any, Any], Any]
    hint: str = ""
    validate: Callable[[Any], str] = lambda _value: ""


def attribute(name: str, label: str, *, hint: str = "", parse: Callable[[Any], Any] = lambda value: value) -> FormField:
    """The field of an attribute that is a text or a bool."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: getattr(owner, name),
        write=lambda owner, value: replace(owner, **{name: parse(value)}),
    )


def part(name: str, field: FormField) -> FormField:
    """The field of a part of the owner, such as the guard of a transition."""
    return replace(
        field,
        read=lambda owner: field.read(getattr(owner, name)),
        write=lambda owner, value: replace(owner, **{name: field.write(getattr(owner, name), value)}),
    )


def code(name: str, language: str, label: str, hint: str = "") -> FormField:
    """The field of a code in one language."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: (written.in_language(language) if (written := getattr(owner, name)) else "") or "",
        write=lambda owner, text: replace(owner, **{name: replace_text(getattr(owner, name), language, text)}),
    )


def replace_text(written: Code | None, language: str, text: str) -> Code:
    """Replace the text in one language; texts in other languages stay. Without any text, the Python text is empty."""
    # A YAML block of several lines ends with a newline; a single line does not.
    ended = text + "\n" if "\n" in text and not text.endswith("\n") else text
    texts = dict(written.texts if written else ())
    if text.strip():
        python = {"python": ended} if language == "python" else {}
        return Code(texts=tuple({**python, **texts, language: ended}.items()))
    texts.pop(language, None)
    return Code(texts=tuple((texts or {"python": text if language == "python" else ""}).items()))


DESCRIPTION = attribute("doc", "Description")
_PREDICATE = "Predicate (body of a function that returns a bool)"
_GUARD: Mapping[DesignPath, FormField] = {
    ("guard", "when"): part("guard", attribute("when", "When", hint="always")),
    ("guard", "after"): part("guard", attribute("after", "After")),
    **{("guard", "code", language): part("guard", code("code", language, _PREDICATE)) for language in LANGUAGES},
    ("doc",): DESCRIPTION,
    ("disabled",): attribute("disabled", "Disabled (never tested)"),
}
_FIELDS: Mapping[type, Mapping[DesignPath, FormField]] = {
    Transition: {("to",): attribute("to", "To"), **_GUARD},
    Stay: _GUARD,
    DecisionGroup: _GUARD,
}


def field_of(owner: object, path: DesignPath) -> FormField | None:
    """The field at a path of an owner; None if there is none."""
    return _FIELDS.get(type(owner), {}).get(path)
