"""The transitions of a design for text formats, with full labels in priority order."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from vicode.diagram.transition_labels import transition_label
from vicode.model.design import COMMON, Design, Transition
from vicode.model.traversal import iter_transitions

EVERY_STATE = "every state"


@dataclass(frozen=True, slots=True, kw_only=True)
class TextTransition:
    """One transition; `source` is the name of a state or COMMON, `label` one line of text."""

    source: str
    target: str
    label: str


def list_transitions(design: Design, only: Collection[str] | None = None) -> Iterator[TextTransition]:
    """Every transition whose source and target exist; numbered if a state has several."""
    names = {state.name for state in design.states if only is None or state.name in only}
    located = [each for each in iter_transitions(design) if each.source == COMMON or each.source in names]
    counts = Counter(each.source for each in located)
    orders: Counter[str] = Counter()
    for each in located:
        assert isinstance(each.decision, Transition)
        orders[each.source] += 1
        if each.decision.to not in names:
            continue
        number = f"{orders[each.source]}. " if counts[each.source] > 1 else ""
        label = number + transition_label(each, design.time_unit, spell_out=True)
        yield TextTransition(source=each.source, target=each.decision.to, label=label.strip())


def describe_dangling_transitions(design: Design, only: Collection[str] | None = None) -> Iterator[str]:
    """A comment for every transition to a missing state, which cannot be drawn."""
    names = {state.name for state in design.states}
    for each in iter_transitions(design):
        assert isinstance(each.decision, Transition)
        is_wanted = only is None or each.source in only or each.source == COMMON
        if is_wanted and each.decision.to not in names:
            source = EVERY_STATE if each.source == COMMON else each.source
            words = f"not drawn: {source} to {each.decision.to}, because there is no such state"
            yield "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(words.split()))
