"""Parts of designs as texts for the clipboard of the system, and texts from there as parts of designs.

The text is a design file with only what was selected. What comes back may have been written by anybody.
"""

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import Any

from vicode.diagram import complete_layout
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures import EditResult, parse_point
from vicode.editor.view import ItemRef, parse_transition_key, transition_key
from vicode.findings import Severity
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
from vicode.store import read_design, save_design

MAX_CHARACTERS = 400_000
_HEAD = "vicode: 1\ncomponent: Part\n"
_SECTION = re.compile(r"^(states|common|uses) *:", re.MULTILINE)
_NOTHING = "the clipboard holds no part of a design"
_PASTE_OFFSET = (40, 90)
_GRID = 10


def copy_as_text(design: Design, items: Iterable[Mapping[str, Any]]) -> str | None:
    """The selected things as text; None when there is nothing among them that can be copied."""
    part = _with_places(extract_fragment(design, _parse_selection(items)), design)
    if not part.states and not part.common.transitions:
        return None
    try:
        return save_design(part)
    except ValueError:
        # Two states of one name, which the findings tell already.
        return None


def duplicate_items(document: DocumentSession, payload: Mapping[str, Any]) -> EditResult:
    """Make the selected states once more, a little beside, or else the selected transitions."""
    design = document.design
    wanted = _parse_selection(payload["items"])
    part = _with_places(extract_fragment(design, replace(wanted, common=False, aliases=())), design)
    if part.states:
        joined = insert_fragment(design, part, available=(), offset=_free_offset(design, part, _PASTE_OFFSET))
        document.edit(f"duplicate {_describe_inserted(joined)}", lambda _design: joined.design)
        return _select_inserted(joined)
    paths = sorted((path for path in wanted.decisions if find_decision(design, path)), key=str, reverse=True)
    if not paths:
        return EditResult(error="select states or transitions to duplicate them")

    def change(old: Design) -> Design:
        for path in paths:
            old = duplicate_decision(old, path)
        return old

    document.edit("duplicate transition" if len(paths) == 1 else f"duplicate {len(paths)} transitions", change)
    if len(paths) > 1:
        return EditResult()
    return EditResult(
        new_selection=(ItemRef(kind="transitions", id=transition_key((*paths[0][:-1], int(paths[0][-1]) + 1))),)
    )


def paste(
    document: DocumentSession, payload: Mapping[str, Any], known_components: Collection[str], targets: Iterable[ItemRef]
) -> EditResult:
    """Put a text from the clipboard into the design, its middle where the hand is.

    Args:
        document: where it goes.
        payload: the text and the place.
        known_components: the components of the project.
        targets: what is selected; transitions that have left their state go to the states among it.
    """
    part = _read_part(payload["text"])
    if isinstance(part, str):
        return EditResult(error=part)
    design = document.design
    if not part.states and part.common.at is None:
        return _paste_decisions(
            document, part, known_components, [each.id for each in targets if each.kind == "states"]
        )
    placed = _with_places(part, part)
    middle = _middle([state.at for state in placed.states if state.at is not None])
    x, y = parse_point(payload)
    by = (_to_grid(x - middle[0]), _to_grid(y - middle[1]))
    joined = insert_fragment(design, placed, available=known_components, offset=_free_offset(design, placed, by))
    document.edit(f"paste {_describe_inserted(joined)}", lambda _design: joined.design)
    return _select_inserted(joined)


def _paste_decisions(document: DocumentSession, part: Design, known: Collection[str], names: list[str]) -> EditResult:
    names = [name for name in names if document.design.state(name) is not None]
    if not names:
        return EditResult(error="select the states that shall get these transitions, then paste")
    joined = append_decisions(document.design, part, names, available=known)
    document.edit("paste transitions", lambda _design: joined.design)
    return replace(_select_inserted(joined), new_selection=None)


def _read_part(text: object) -> Design | str:
    """The design a text holds, or in words why it holds none."""
    if not isinstance(text, str) or len(text) > MAX_CHARACTERS or not _SECTION.search(text):
        return _NOTHING
    read = read_design(text if re.search(r"^vicode *:", text, re.MULTILINE) else _HEAD + text, "clipboard")
    errors = [finding for finding in read.findings if finding.severity is Severity.ERROR]
    if read.design is None or errors:
        return f"{_NOTHING}: {errors[0].message}" if errors else _NOTHING
    design = read.design
    wrong = [each.name for each in design.states if not is_valid_state_name(each.name)]
    wrong += [use.alias for use in design.uses if not is_valid_name(use.alias)]
    if wrong:
        return f"{_NOTHING}: '{wrong[0][:40]}' is no name"
    return design if design.states or design.common.transitions else _NOTHING


def _parse_selection(items: Iterable[Mapping[str, Any]]) -> FragmentSelection:
    named: dict[str, list[str]] = {"states": [], "transitions": [], "components": [], "links": [], "common": []}
    for item in items:
        named[item["of"]].append(str(item["id"]))
    return FragmentSelection(
        states=named["states"],
        decisions=[parse_transition_key(key) for key in named["transitions"]],
        aliases=named["components"],
        common=bool(named["common"]),
    )


def _with_places(part: Design, whole: Design) -> Design:
    """The part with places for all that the file leaves to the drawing."""
    places = complete_layout(whole)
    states = (replace(state, at=_rounded(places.states[state.name])) for state in part.states)
    uses = (replace(use, at=_rounded(places.uses[use.alias])) for use in part.uses)
    return replace(part, states=tuple(states), uses=tuple(uses))


def _free_offset(design: Design, part: Design, by: Point) -> Point:
    """A shift that hides no state exactly behind the pasted ones."""
    taken = {_rounded(at) for at in complete_layout(design).states.values()}
    while any(state.at is not None and (state.at[0] + by[0], state.at[1] + by[1]) in taken for state in part.states):
        by = (by[0] + _PASTE_OFFSET[0], by[1] + _PASTE_OFFSET[1])
    return by


def _middle(points: list[Point]) -> Point:
    if not points:
        return (0, 0)
    xs, ys = [x for x, _y in points], [y for _x, y in points]
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)


def _rounded(at: Point) -> Point:
    return (round(at[0]), round(at[1]))


def _to_grid(value: float) -> float:
    return round(value / _GRID) * _GRID


def _describe_inserted(joined: InsertResult) -> str:
    match joined.states:
        case []:
            return "common transitions"
        case [name]:
            return name
        case names:
            return f"{len(names)} states"


def _select_inserted(joined: InsertResult) -> EditResult:
    words = ", ".join(dict.fromkeys(joined.missing))
    note = f"Not to be had in this project: {words}" if words else ""
    return EditResult(new_selection=tuple(ItemRef(kind="states", id=name) for name in joined.states), note=note)
