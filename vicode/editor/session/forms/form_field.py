"""A value that a form shows and changes: how it is read from its owner, validated and written."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from vicode.editor.session.forms.pairs import find_error, find_lost_pairs, format_pairs, parse_pairs
from vicode.editor.session.gestures import number_text
from vicode.model.design import Code


def _accept(_value: Any) -> str:
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FormField:
    """A value of an owner (a state, a transition), as a form shows it: a text, a bool, or several texts.

    `write` returns the changed owner; `validate` returns an error message, or "" for a value that can be written.
    `find_loss` says why the value of an owner cannot be edited without a loss, or "". Texts for humans are `is_prose`.
    """

    label: str
    read: Callable[[Any], Any]
    write: Callable[[Any, Any], Any]
    hint: str = ""
    help: str = ""
    is_prose: bool = False
    validate: Callable[[Any], str] = _accept
    find_loss: Callable[[Any], str] = lambda _owner: ""

    @property
    def is_checked(self) -> bool:
        """Whether some texts are refused."""
        return self.validate is not _accept


def attribute(name: str, label: str, *, hint: str = "", parse: Callable[[Any], Any] = lambda value: value) -> FormField:
    """The field of an attribute that has the type of the field."""
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


def count(name: str, label: str, hint: str = "") -> FormField:
    """The field of a whole number, or None."""
    counted = replace(number(name, label, hint), validate=number_text.validate_count)
    return replace(counted, write=lambda owner, text: replace(owner, **{name: number_text.parse_count(text)}))


def number(name: str, label: str, hint: str = "") -> FormField:
    """The field of a number above 0, or None."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: number_text.format_number(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: number_text.parse_frequency(text)}),
        validate=number_text.validate_frequency,
    )


def names(name: str, label: str, hint: str = "") -> FormField:
    """The field of several names, separated by commas or blanks."""
    return FormField(
        label=label,
        hint=hint,
        read=lambda owner: ", ".join(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: tuple(text.replace(",", " ").split())}),
    )


def pairs(name: str, label: str, *, is_required: bool = False) -> FormField:
    """The field of assignments or arguments: lines `name = expression`."""

    def validate(text: str) -> str:
        is_missing = is_required and not text.strip()
        return "write a line such as count = 0, or remove this action" if is_missing else find_error(text)

    return FormField(
        label=label,
        read=lambda owner: format_pairs(getattr(owner, name)),
        write=lambda owner, text: replace(owner, **{name: parse_pairs(text)}),
        validate=validate,
        find_loss=lambda owner: find_lost_pairs(getattr(owner, name)),
    )
