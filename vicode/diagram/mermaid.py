"""A design as Mermaid (stateDiagram-v2), for READMEs and wikis."""

import re
from collections.abc import Collection, Iterator, Mapping

from vicode.diagram.layered_layout import complete_layout
from vicode.diagram.node_ids import assign_ids
from vicode.diagram.notes import nearest_states
from vicode.diagram.text_transitions import EVERY_STATE, describe_dangling_transitions, list_transitions
from vicode.model.design import COMMON, Design

# Keywords of the grammar, and property names of JavaScript objects.
_RESERVED = frozenset({
    "accdescr", "acctitle", "as", "class", "classdef", "click", "constructor", "default", "direction", "end",
    "hasownproperty", "hide", "href", "note", "prototype", "root", "scale", "state", "statediagram", "style",
    "tostring", "valueof",
})  # fmt: skip
# Other characters are written as character references, which Mermaid decodes before parsing.
_UNSAFE = re.compile(r"[^\w .,()=+\-*/'!?|]")

_END_NOTE = re.compile(r"end\s+note", re.IGNORECASE)


def write_mermaid(design: Design, *, only: Collection[str] | None = None) -> str:
    """The text of the whole design, or of some states and the transitions between them."""
    names = [state.name for state in design.states if only is None or state.name in only]
    lines = list(list_transitions(design, only))
    ids = assign_ids((*names, *([COMMON] if any(line.source == COMMON for line in lines) else ())), _RESERVED)
    text = ["---", f'title: "{escape(design.component)}"', "---", "stateDiagram-v2", "    direction LR"]
    shown = {name: EVERY_STATE if name == COMMON else name for name in ids}
    for name in (*names, *(name for name in ids if name == COMMON)):
        is_plain = ids[name] == shown[name]
        text.append(f"    {ids[name]}" if is_plain else f'    state "{escape(shown[name])}" as {ids[name]}')
    if design.initial in names:
        text.append(f"    [*] --> {ids[design.initial]}")
    for line in lines:
        label = f" : {escape(line.label)}" if line.label else ""
        text.append(f"    {ids[line.source]} --> {ids[line.target]}{label}")
    text += _notes(design, ids) if only is None else ()
    text += [f"    %% {words}" for words in describe_dangling_transitions(design, only)]
    text += [f"    {ids[state.name]} --> [*]" for state in design.states if state.final and state.name in ids]
    return "\n".join(text) + "\n"


def _notes(design: Design, ids: Mapping[str, str]) -> Iterator[str]:
    """Notes at the nearest states: others have no place in Mermaid."""
    nearest = nearest_states(design, complete_layout(design))
    for note in design.notes:
        lines = [_END_NOTE.sub("end#32;note", escape(line)) for line in note.text.strip().splitlines()]
        if note.name in nearest and lines:
            yield f"    note right of {ids[nearest[note.name]]}"
            yield from (f"        {line}" for line in lines)
            yield "    end note"


def escape(text: str) -> str:
    """One line that Mermaid displays literally."""
    line = "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(text.split()))
    return _UNSAFE.sub(lambda match: f"#{ord(match.group())};", line)
