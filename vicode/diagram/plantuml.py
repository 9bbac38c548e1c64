"""A design as PlantUML."""

import re
from collections.abc import Collection

from vicode.diagram.node_ids import assign_ids
from vicode.diagram.text_transitions import EVERY_STATE, describe_dangling_transitions, list_transitions
from vicode.model.design import COMMON, Design

_RESERVED = frozenset({
    "as", "choice", "class", "down", "end", "entrypoint", "exitpoint", "fork", "frame", "hide", "history", "join",
    "json", "left", "legend", "note", "remove", "right", "scale", "show", "skinparam", "start", "state", "title",
    "up",
})  # fmt: skip
# Characters of its markup and preprocessor; doubled ones only change the style.
_MARKUP = re.compile(r"[^\w .,()=+\-*/'!?|:]|([*/_\-'.])\1+|^[!']")


def write_plantuml(design: Design, *, only: Collection[str] | None = None) -> str:
    """The text of the whole design, or of some states and the transitions between them."""
    names = [state.name for state in design.states if only is None or state.name in only]
    lines = list(list_transitions(design, only))
    commons = [COMMON] if any(line.source == COMMON for line in lines) else []
    ids = assign_ids((*names, *commons), _RESERVED)
    text = ["@startuml", f"title {escape(design.component)}", "hide empty description", "left to right direction"]
    text += [f'state "{escape(name)}" as {ids[name]}' for name in names]
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


def escape(text: str) -> str:
    """One line that PlantUML displays literally."""
    line = "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(text.split()))
    return _MARKUP.sub(lambda match: "".join(f"<U+{ord(letter):04X}>" for letter in match.group()), line)
