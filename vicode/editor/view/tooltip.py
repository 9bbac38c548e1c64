"""The tooltip of an item: its code, and all else that the drawing does not show."""

from collections.abc import Iterable, Iterator, Sequence

from vicode.analysis.machines import MachineAnalysis
from vicode.editor.view.selection import ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Action, Assign, Call, Code, Design, RunCode
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.model.words import describe_fields

Sections = list[dict[str, str]]
_MAX_LINES = 12
_MAX_LINE_LENGTH = 90
_DRAWN = ("color", "final", "disabled", "requires", "to", "alias", "component", "states")


def tooltip_sections(project: Project, design: Design, item: ItemRef) -> Sections:
    """The code of an item, and what the drawing does not show of it, as shortened sections {"name", "text"}."""
    texts = [(name, "\n".join(lines)) for name, lines in _sections(design, item, project.languages)]
    if item.kind == "states":
        texts.append(("lasts", _describe_time(project, design, item.id)))
    return [{"name": name, "text": _cut(text)} for name, text in texts if text]


def _sections(design: Design, item: ItemRef, languages: Sequence[str]) -> Iterator[tuple[str, Iterable[str]]]:
    match item.kind:
        case "transitions":
            located = find_decision(design, parse_transition_key(item.id))
            if located is not None:
                guard = located.decision.guard
                yield "holds when", (_text(guard.code, languages),) if guard.code else ()
                fields = describe_fields(guard, ("when", "after"))
                yield "more", (*fields, *describe_fields(located.decision, ("doc", *_DRAWN)))
        case "states":
            state = design.state(item.id)
            if state is not None:
                phases = (("enter", state.enter), ("do", state.all_actions), ("leave", state.leave))
                yield from ((name, _lines(actions, languages)) for name, actions in phases)
                yield "more", describe_fields(state, ("doc", *_DRAWN))
        case "common":
            yield "do", _lines(design.common.actions, languages)
            yield "more", describe_fields(design.common, _DRAWN)
        case "frames" | "components":
            owner = design.frame(item.id) if item.kind == "frames" else design.use(item.id)
            yield "more", describe_fields(owner, _DRAWN) if owner is not None else ()


def _describe_time(project: Project, design: Design, state: str) -> str:
    """How long a state lasts whatever the inputs are, as the guards prove; "" if nothing is proved."""
    machine = MachineAnalysis(project, design)
    time = machine.time_in(state) if machine.live_in(state) else None
    if time is None:
        return ""
    unit, ns_per_unit = design.time_unit or "s", machine.guards.conditions.table.ns_per_unit
    least, most = time.at_least_ns / ns_per_unit, (time.at_most_ns or 0) / ns_per_unit
    if time.at_most_ns is None:
        return f"at least {least:.6g} {unit}" if time.at_least_ns else ""
    if time.at_most_ns == 0:
        return "one iteration"
    if not time.at_least_ns:
        return f"at most {most:.6g} {unit}"
    return f"{least:.6g} {unit}" if f"{least:.6g}" == f"{most:.6g}" else f"{least:.6g} to {most:.6g} {unit}"


def _lines(actions: Iterable[Action], languages: Sequence[str]) -> Iterator[str]:
    for action in actions:
        match action:
            case Assign(values=values):
                yield from (f"{name} = {text}" for name, text in values)
            case Call(alias=alias, arguments=arguments):
                yield f"{alias}({', '.join(f'{name}={text}' for name, text in arguments)})"
            case RunCode(code=code):
                yield _text(code, languages)
        yield from describe_fields(action, ("values", "alias", "arguments"))


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
