"""Copy, duplicate and paste parts of a design.

The system clipboard holds them as the text of a design file that contains only the selection. Pasted text is untrusted.
"""

import re
from collections import defaultdict
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from typing import ClassVar

from vicode.diagram.layered_layout import complete_layout, note_position
from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures.edits import EditResult
from vicode.editor.view import ItemKind, ItemRef
from vicode.findings import Severity
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import Design, Point
from vicode.model.fragments import (
    FragmentSelection,
    InsertResult,
    append_decisions,
    duplicate_decision,
    extract_fragment,
    insert_fragment,
)
from vicode.model.names import is_valid_name, is_valid_state_name
from vicode.model.traversal import find_decision
from vicode.services import messages
from vicode.store import read_design, save_design

MAX_CHARACTERS = 400_000
_HEAD = "vicode: 1\ncomponent: Part\n"
_SECTION = re.compile(r"^(states|common|uses|notes) *:", re.MULTILINE)
_PASTE_OFFSET = (40, 90)
_GRID = 10


@dataclass(frozen=True, slots=True, kw_only=True)
class DuplicateGesture:
    """Duplicate states, frames and notes at a small offset, or else transitions."""

    kind: ClassVar = "duplicate"
    items: tuple[ItemRef, ...]

    def apply(self, document: DocumentSession) -> EditResult:
        design = document.design
        wanted = _parse_selection(self.items)
        part = _with_positions(extract_fragment(design, replace(wanted, common=False, aliases=())), design)
        if part.states or part.notes:
            joined = insert_fragment(design, part, available=(), offset=_free_offset(design, part, _PASTE_OFFSET))
            document.edit(texts.insert_items("duplicate", joined.states, joined.notes), lambda _design: joined.design)
            return _select_inserted(joined)
        paths = sorted((path for path in wanted.decisions if find_decision(design, path)), key=str, reverse=True)
        if not paths:
            return EditResult(error="select states or transitions to duplicate")

        def change(old: Design) -> Design:
            for path in paths:
                old = duplicate_decision(old, path)
            return old

        document.edit(texts.duplicate_transitions(len(paths)), change)
        if len(paths) > 1:
            return EditResult()
        return EditResult(
            new_selection=(ItemRef(kind="transitions", id=transition_key((*paths[0][:-1], int(paths[0][-1]) + 1))),)
        )


def copy_as_text(design: Design, items: Iterable[ItemRef]) -> str | None:
    """The selected items as text; None if none of them can be copied."""
    part = _with_positions(extract_fragment(design, _parse_selection(items)), design)
    if not part.states and not part.common.transitions and not part.notes:
        return None
    try:
        return save_design(part)
    except ValueError:
        # Two states have the same name, which is a finding already.
        return None


def paste(
    document: DocumentSession, text: str, at: Point, known_components: Collection[str], targets: Iterable[ItemRef]
) -> EditResult:
    """Insert a text from the clipboard, centered at the pointer.

    Args:
        document: The target.
        text: The text.
        at: The position of the pointer.
        known_components: The components of the project.
        targets: The selection; transitions copied without their state are added to the selected states.
    """
    part = _read_part(text)
    if isinstance(part, str):
        return EditResult(error=part)
    design = document.design
    if not part.states and not part.notes and part.common.at is None:
        return _paste_decisions(
            document, part, known_components, [target.id for target in targets if target.kind == "states"]
        )
    positioned = _with_positions(part, part)
    middle = _middle(_points(positioned))
    by = (_to_grid(at[0] - middle[0]), _to_grid(at[1] - middle[1]))
    joined = insert_fragment(
        design, positioned, available=known_components, offset=_free_offset(design, positioned, by)
    )
    document.edit(texts.insert_items("paste", joined.states, joined.notes), lambda _design: joined.design)
    return _select_inserted(joined)


def _paste_decisions(document: DocumentSession, part: Design, known: Collection[str], names: list[str]) -> EditResult:
    names = [name for name in names if document.design.state(name) is not None]
    if not names:
        return EditResult(error="select the states to add these transitions to, then paste")
    joined = append_decisions(document.design, part, names, available=known)
    document.edit("paste transitions", lambda _design: joined.design)
    return replace(_select_inserted(joined), new_selection=None)


def _read_part(text: str) -> Design | str:
    """The design in a text, or the error message."""
    if len(text) > MAX_CHARACTERS or not _SECTION.search(text):
        return texts.NOTHING_TO_PASTE
    read = read_design(text if re.search(r"^vicode *:", text, re.MULTILINE) else _HEAD + text, "clipboard")
    errors = [finding for finding in read.findings if finding.severity is Severity.ERROR]
    if read.design is None or errors:
        return f"{texts.NOTHING_TO_PASTE}: {errors[0].message}" if errors else texts.NOTHING_TO_PASTE
    design = read.design
    wrong = [state.name for state in design.states if not is_valid_state_name(state.name)]
    wrong += [use.alias for use in design.uses if not is_valid_name(use.alias)]
    if wrong:
        return f"{texts.NOTHING_TO_PASTE}: {messages.invalid_name(wrong[0])}"
    return design if design.states or design.common.transitions or design.notes else texts.NOTHING_TO_PASTE


def _parse_selection(items: Iterable[ItemRef]) -> FragmentSelection:
    named: defaultdict[str, list[str]] = defaultdict(list)
    for item in items:
        named[item.kind].append(item.id)
    return FragmentSelection(
        states=named["states"],
        decisions=[parse_transition_key(key) for key in named["transitions"]],
        aliases=named["components"],
        frames=named["frames"],
        notes=named["notes"],
        common=bool(named["common"]),
    )


def _with_positions(part: Design, design: Design) -> Design:
    """The part with explicit positions, computed where the design has none."""
    layout = complete_layout(design)
    states = (replace(state, at=_rounded(layout.states[state.name])) for state in part.states)
    uses = (replace(use, at=_rounded(layout.uses[use.alias])) for use in part.uses)
    order = {note.name: index for index, note in enumerate(design.notes)}
    notes = (replace(note, at=_rounded(note_position(note, order[note.name]))) for note in part.notes)
    return replace(part, states=tuple(states), uses=tuple(uses), notes=tuple(notes))


def _free_offset(design: Design, part: Design, by: Point) -> Point:
    """The first offset, in steps from `by`, at which no pasted state or note covers another exactly."""
    taken = {_rounded(at) for at in complete_layout(design).states.values()}
    taken |= {_rounded(note.at) for note in design.notes if note.at}
    while any((x + by[0], y + by[1]) in taken for x, y in _points(part)):
        by = (by[0] + _PASTE_OFFSET[0], by[1] + _PASTE_OFFSET[1])
    return by


def _points(part: Design) -> list[Point]:
    """The centers of states and notes."""
    points = (*(state.at for state in part.states), *(note.at for note in part.notes))
    return [at for at in points if at is not None]


def _middle(points: list[Point]) -> Point:
    if not points:
        return (0, 0)
    xs, ys = [x for x, _y in points], [y for _x, y in points]
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)


def _rounded(at: Point) -> Point:
    return (round(at[0]), round(at[1]))


def _to_grid(value: float) -> float:
    return round(value / _GRID) * _GRID


def _select_inserted(joined: InsertResult) -> EditResult:
    note = texts.paste_note(joined.added, dict.fromkeys(joined.missing))
    inserted: tuple[tuple[ItemKind, tuple[str, ...]], ...] = (
        ("states", joined.states),
        ("frames", joined.frames),
        ("notes", joined.notes),
    )
    selection = tuple(ItemRef(kind=kind, id=name) for kind, names in inserted for name in names)
    return EditResult(new_selection=selection, note=note)
