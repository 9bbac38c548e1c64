"""A design as PlantUML."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping

from vicode.diagram.frames import FrameGroup, nest_frames
from vicode.diagram.node_ids import assign_ids
from vicode.diagram.text_transitions import EVERY_STATE, describe_dangling_transitions, list_transitions
from vicode.model.design import COMMON, Design, DiagramNote

_RESERVED = frozenset({
    "as", "choice", "class", "down", "end", "entrypoint", "exitpoint", "fork", "frame", "hide", "history", "join",
    "json", "left", "legend", "note", "remove", "right", "scale", "show", "skinparam", "start", "state", "title",
    "up",
})  # fmt: skip
# Names of states and ids made from them do not start like this.
FRAME_PREFIX, NOTE_PREFIX = "_frame", "_note"
# Characters of its markup and preprocessor; doubled ones only change the style.
_MARKUP = re.compile(r"[^\w .,()=+\-*/'!?|:]|([*/_\-'.])\1+|^[!']")


def write_plantuml(design: Design, *, only: Collection[str] | None = None) -> str:
    """The text of the whole design, or of some states and the transitions between them."""
    names = [state.name for state in design.states if only is None or state.name in only]
    lines = list(list_transitions(design, only))
    commons = [COMMON] if any(line.source == COMMON for line in lines) else []
    ids = assign_ids((*names, *commons), _RESERVED)
    text = ["@startuml", f"title {escape(design.component)}", "hide empty description", "left to right direction"]
    groups = nest_frames(design, only)
    grouped = {name for group in groups for name in group.members}
    text += [_state(name, ids) for name in names if name not in grouped]
    text += _frames(groups, names, ids)
    text += [f'note "{_note_text(note.text)}" as {NOTE_PREFIX}{number}' for number, note in _notes(design, only)]
    text += [f'state "{EVERY_STATE}" as {ids[name]} #line.dashed' for name in commons]
    if design.initial in names:
        text.append(f"[*] --> {ids[design.initial]}")
    for line in lines:
        edge = "-[dashed]->" if line.source == COMMON else "-->"
        label = f" : {escape(line.label)}" if line.label else ""
        text.append(f"{ids[line.source]} {edge} {ids[line.target]}{label}")
    text += [f"' {words}" for words in describe_dangling_transitions(design, only)]
    text += [f"{ids[state.name]} --> [*]" for state in design.states if state.final and state.name in ids]
    return "\n".join((*text, "@enduml")) + "\n"


def _state(name: str, ids: Mapping[str, str]) -> str:
    return f'state "{escape(name)}" as {ids[name]}'


def _frames(
    groups: Iterable[FrameGroup], names: Iterable[str], ids: Mapping[str, str], number: str = ""
) -> Iterator[str]:
    """Frames as composite states, which PlantUML draws around states without further meaning."""
    for index, group in enumerate(groups):
        yield f'state "{escape(group.name)}" as {FRAME_PREFIX}{number}{index} {{'
        yield from (_state(name, ids) for name in names if name in group.own_states)
        yield from _frames(group.groups, names, ids, f"{number}{index}_")
        yield "}"


def _notes(design: Design, only: Collection[str] | None) -> Iterator[tuple[int, DiagramNote]]:
    """The notes of a whole diagram; those of a part are not known."""
    yield from enumerate(design.notes if only is None else ())


def _note_text(text: str) -> str:
    return "\\n".join(escape(line) for line in text.strip().splitlines())


def escape(text: str) -> str:
    """One line that PlantUML displays literally."""
    line = "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(text.split()))
    return _MARKUP.sub(lambda match: "".join(f"<U+{ord(letter):04X}>" for letter in match.group()), line)
