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
    located = [item for item in iter_transitions(design) if item.source == COMMON or item.source in names]
    counts = Counter(item.source for item in located)
    orders: Counter[str] = Counter()
    for item in located:
        assert isinstance(item.decision, Transition)
        orders[item.source] += 1
        if item.decision.to not in names:
            continue
        number = f"{orders[item.source]}. " if counts[item.source] > 1 else ""
        label = number + transition_label(item, design.time_unit, spell_out=True)
        yield TextTransition(source=item.source, target=item.decision.to, label=label.strip())


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
