"""Parts of designs as texts for the clipboard of the system, and texts from there as parts of designs.

The text is a design file with only what was selected. What comes back may have been written by anybody.
"""

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import Any

from vicode.diagram import place
from vicode.editor.session.document import Document
from vicode.editor.session.gestures import Outcome, point_of
from vicode.editor.view import Selected, path_of_key, transition_key
from vicode.findings import Severity
from vicode.model.design import Design, Point
from vicode.model.names import is_name, is_state_name
from vicode.model.parts import Joined, Wanted, append_decisions, part_of, put_in, repeat_decision
from vicode.model.walks import decision_at
from vicode.store import read_design, save_design

MOST_CHARACTERS = 400_000
_HEAD = "vicode: 1\ncomponent: Part\n"
_SECTION = re.compile(r"^(states|common|uses) *:", re.MULTILINE)
_NOTHING = "the clipboard holds no part of a design"
_BESIDE = (40, 90)
_GRID = 10


def copied(design: Design, items: Iterable[Mapping[str, Any]]) -> str | None:
    """The selected things as text; None when there is nothing among them that can be copied."""
    part = _with_places(part_of(design, _wanted(items)), design)
    if not part.states and not part.common.transitions:
        return None
    try:
        return save_design(part)
    except ValueError:
        # Two states of one name, which the findings tell already.
        return None


def duplicate(document: Document, payload: Mapping[str, Any]) -> Outcome:
    """Make the selected states once more, a little beside, or else the selected transitions."""
    design = document.design
    wanted = _wanted(payload["items"])
    part = _with_places(part_of(design, replace(wanted, common=False, aliases=())), design)
    if part.states:
        joined = put_in(design, part, known=(), by=_free_shift(design, part, _BESIDE))
        document.edit(f"duplicate {_count(joined)}", lambda _design: joined.design)
        return _selecting(joined)
    paths = sorted((path for path in wanted.decisions if decision_at(design, path)), key=str, reverse=True)
    if not paths:
        return Outcome(refused="select states or transitions to duplicate them")

    def change(old: Design) -> Design:
        for path in paths:
            old = repeat_decision(old, path)
        return old

    document.edit("duplicate transition" if len(paths) == 1 else f"duplicate {len(paths)} transitions", change)
    if len(paths) > 1:
        return Outcome()
    return Outcome(select=(Selected(of="transitions", id=transition_key((*paths[0][:-1], int(paths[0][-1]) + 1))),))


def paste(document: Document, payload: Mapping[str, Any], known: Collection[str], onto: Iterable[Selected]) -> Outcome:
    """Put a text from the clipboard into the design, its middle where the hand is.

    Args:
        document: where it goes.
        payload: the text and the place.
        known: the components of the project.
        onto: what is selected; transitions that have left their state go to the states among it.
    """
    part = _read_part(payload["text"])
    if isinstance(part, str):
        return Outcome(refused=part)
    design = document.design
    if not part.states and part.common.at is None:
        return _paste_decisions(document, part, known, [each.id for each in onto if each.of == "states"])
    placed = _with_places(part, part)
    middle = _middle([state.at for state in placed.states if state.at is not None])
    x, y = point_of(payload)
    by = (_to_grid(x - middle[0]), _to_grid(y - middle[1]))
    joined = put_in(design, placed, known=known, by=_free_shift(design, placed, by))
    document.edit(f"paste {_count(joined)}", lambda _design: joined.design)
    return _selecting(joined)


def _paste_decisions(document: Document, part: Design, known: Collection[str], names: list[str]) -> Outcome:
    names = [name for name in names if document.design.state(name) is not None]
    if not names:
        return Outcome(refused="select the states that shall get these transitions, then paste")
    joined = append_decisions(document.design, part, names, known=known)
    document.edit("paste transitions", lambda _design: joined.design)
    return replace(_selecting(joined), select=None)


def _read_part(text: object) -> Design | str:
    """The design a text holds, or in words why it holds none."""
    if not isinstance(text, str) or len(text) > MOST_CHARACTERS or not _SECTION.search(text):
        return _NOTHING
    read = read_design(text if re.search(r"^vicode *:", text, re.MULTILINE) else _HEAD + text, "clipboard")
    errors = [finding for finding in read.findings if finding.severity is Severity.ERROR]
    if read.design is None or errors:
        return f"{_NOTHING}: {errors[0].message}" if errors else _NOTHING
    design = read.design
    wrong = [each.name for each in design.states if not is_state_name(each.name)]
    wrong += [use.alias for use in design.uses if not is_name(use.alias)]
    if wrong:
        return f"{_NOTHING}: '{wrong[0][:40]}' is no name"
    return design if design.states or design.common.transitions else _NOTHING


def _wanted(items: Iterable[Mapping[str, Any]]) -> Wanted:
    named: dict[str, list[str]] = {"states": [], "transitions": [], "components": [], "links": [], "common": []}
    for item in items:
        named[item["of"]].append(str(item["id"]))
    return Wanted(
        states=named["states"],
        decisions=[path_of_key(key) for key in named["transitions"]],
        aliases=named["components"],
        common=bool(named["common"]),
    )


def _with_places(part: Design, whole: Design) -> Design:
    """The part with places for all that the file leaves to the drawing."""
    places = place(whole)
    states = (replace(state, at=_rounded(places.states[state.name])) for state in part.states)
    uses = (replace(use, at=_rounded(places.uses[use.alias])) for use in part.uses)
    return replace(part, states=tuple(states), uses=tuple(uses))


def _free_shift(design: Design, part: Design, by: Point) -> Point:
    """A shift that hides no state exactly behind the pasted ones."""
    taken = {_rounded(at) for at in place(design).states.values()}
    while any(state.at is not None and (state.at[0] + by[0], state.at[1] + by[1]) in taken for state in part.states):
        by = (by[0] + _BESIDE[0], by[1] + _BESIDE[1])
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


def _count(joined: Joined) -> str:
    match joined.states:
        case []:
            return "common transitions"
        case [name]:
            return name
        case names:
            return f"{len(names)} states"


def _selecting(joined: Joined) -> Outcome:
    words = ", ".join(dict.fromkeys(joined.missing))
    note = f"Not to be had in this project: {words}" if words else ""
    return Outcome(select=tuple(Selected(of="states", id=name) for name in joined.states), note=note)
