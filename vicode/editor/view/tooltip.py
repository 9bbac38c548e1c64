"""The tooltip of an item: its code, which the drawing does not show."""

from collections.abc import Iterable, Sequence

from vicode.editor.view.selection import ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Action, Assign, Call, Code, Design, RunCode
from vicode.model.traversal import find_decision

Sections = list[dict[str, str]]
_MAX_LINES = 12
_MAX_LINE_LENGTH = 90


def tooltip_sections(design: Design, item: ItemRef, languages: Sequence[str]) -> Sections:
    """The code of a state, a transition or the common section, as shortened sections {"name", "text"}."""
    if item.kind == "transitions":
        return _guard(design, item.id, languages)
    texts = ((name, "\n".join(_lines(actions, languages))) for name, actions in _phases(design, item))
    return [{"name": name, "text": _cut(text)} for name, text in texts if text]


def _phases(design: Design, item: ItemRef) -> tuple[tuple[str, tuple[Action, ...]], ...]:
    state = design.state(item.id) if item.kind == "states" else None
    if state is not None:
        return (("enter", state.enter), ("do", state.all_actions), ("leave", state.leave))
    return (("do", design.common.actions),) if item.kind == "common" else ()


def _guard(design: Design, key: str, languages: Sequence[str]) -> Sections:
    located = find_decision(design, parse_transition_key(key))
    code = located.decision.guard.code if located else None
    return [{"name": "holds when", "text": _cut(_text(code, languages))}] if code else []


def _lines(actions: Iterable[Action], languages: Sequence[str]) -> Iterable[str]:
    for action in actions:
        match action:
            case Assign(values=values):
                yield from (f"{name} = {text}" for name, text in values)
            case Call(alias=alias, arguments=arguments):
                yield f"{alias}({', '.join(f'{name}={text}' for name, text in arguments)})"
            case RunCode(code=code):
                yield _text(code, languages)


def _text(code: Code, languages: Sequence[str]) -> str:
    """The text in the first language that has one."""
    written = (code.in_language(language) for language in languages)
    return next((text for text in written if text), "").strip("\n")


def _cut(text: str) -> str:
    lines = [
        line if len(line) <= _MAX_LINE_LENGTH else line[: _MAX_LINE_LENGTH - 1] + "…" for line in text.splitlines()
    ]
    if len(lines) <= _MAX_LINES:
        return "\n".join(lines)
    return "\n".join([*lines[: _MAX_LINES - 1], f"… {len(lines) - _MAX_LINES + 1} more lines"])
