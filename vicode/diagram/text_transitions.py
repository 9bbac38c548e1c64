"""The transitions of a design for text formats, with full labels in priority order."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from vicode.diagram.drawn_transitions import draw_transitions
from vicode.model.design import COMMON, Design, Transition
from vicode.model.traversal import iter_transitions

EVERY_STATE = "every state"


@dataclass(frozen=True, slots=True, kw_only=True)
class TextTransition:
    """One transition; `source` and `target` are the name of a state or COMMON, `label` one line of text."""

    source: str
    target: str
    label: str


def list_transitions(design: Design, only: Collection[str] | None = None) -> Iterator[TextTransition]:
    """Every transition whose source and target exist; numbered if a state has several.

    A transition that is drawn with an arrowhead at both ends is followed by the one back.
    """
    names = {state.name for state in design.states if only is None or state.name in only}
    listed = [drawn for drawn in draw_transitions(design, only) if drawn.source in {COMMON, *names}]
    counts = Counter(drawn.source for drawn in listed)
    orders: Counter[str] = Counter()
    for drawn in listed:
        orders[drawn.source] += 1
        if drawn.target not in names:
            continue
        number = f"{orders[drawn.source]}. " if counts[drawn.source] > 1 else ""
        yield TextTransition(source=drawn.source, target=drawn.target, label=(number + drawn.full_label).strip())
        if drawn.leads_back:
            yield TextTransition(source=drawn.target, target=drawn.source, label="back")


def describe_dangling_transitions(design: Design, only: Collection[str] | None = None) -> Iterator[str]:
    """A comment for every transition to a missing state, which cannot be drawn."""
    names = {state.name for state in design.states}
    for located in iter_transitions(design):
        assert isinstance(located.decision, Transition)
        is_wanted = only is None or located.source in only or located.source == COMMON
        if is_wanted and located.decision.to not in names:
            source = EVERY_STATE if located.source == COMMON else located.source
            words = f"not drawn: {source} to {located.decision.to}, because there is no such state"
            yield "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(words.split()))
