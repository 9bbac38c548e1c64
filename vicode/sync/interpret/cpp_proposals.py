"""Proposes edits of a design for changed tokens of its C++ source."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from vicode.model.design import Assign, Call, Design, Guard, State, Transition
from vicode.model.edits import remove_decisions, replace_action, replace_decision, update_state
from vicode.model.traversal import LocatedAction, LocatedDecision, iter_actions, iter_decisions
from vicode.sync.same_code import find_token_spans, plain_token

Words = Sequence[str]
_CPP_TOKENS = {
    "and": ("&", "&"),
    "or": ("|", "|"),
    "not": ("!",),
    **{name: (name, "(", ")") for name in ("state_time", "component_time")},
}
"""What generated code has in place of words of expressions."""
_TO_DESIGN = (
    (r"& &", " and "),
    (r"\| \|", " or "),
    (r"! =", " != "),
    (r"([<>=]) =", r" \1= "),
    (r"!", " not "),
    (r"\b(state_time|component_time) \( \)", r"\1"),
    (r"\b(\w+) \. is_done \( \)", r"done(\1)"),
    (r" : : ", "."),
    (r" ?\. ?", "."),
    (r"\( ", "("),
    (r" ([),])", r"\1"),
    (r"(\w) \(", r"\1("),
    (r"\b(and|or|not)\(", r"\1 ("),
    (r" +", " "),
)
_TRANSITION = re.compile(r"if \( (?P<when>.*) \) \{ change_to \( State : : (?P<to>\w+) \) ; return ; \}")


@dataclass(frozen=True, slots=True)
class _Slot:
    """A text of a state (or of COMMON) in the design, and what sets it."""

    state: str
    text: str
    set: Callable[[str], Design]


def propose_cpp(design: Design, old: Words, new: Words, before: Words, after: Words) -> Iterator[Design]:
    """Propose designs for the replacement of tokens.

    Args:
        design: The design.
        old: The tokens of the generated code.
        new: The tokens in their place.
        before: The generated tokens before them.
        after: The generated tokens from `old` on.
    """
    state = _state_at(design, before)
    yield from _changed_texts(design, state, (old, new), before, after[len(old) :])
    if not new:
        decisions = (located for located in iter_decisions(design) if state in ("", located.source))
        yield from (remove_decisions(design, [located.path]) for located in decisions)
    if not old:
        yield from _added_transitions(design, state, new, before)


def _state_at(design: Design, before: Words) -> str:
    """The state whose case the tokens end in; "" if that is not known."""
    for index in range(len(before) - 1, -1, -1):
        if before[index] == "case":
            name = before[index + 4] if index + 4 < len(before) else ""
            return name if any(state.name == name for state in design.states) else ""
        if before[index] in ("void", "bool"):
            return ""
    return ""


def _changed_texts(
    design: Design, state: str, change: tuple[Words, Words], before: Words, after: Words
) -> Iterator[Design]:
    old, new = change
    slots = [slot for slot in _iter_slots(design) if state in ("", slot.state)]
    # An insertion is found by the token before or behind it.
    for left, right in ((0, 0), (1, 0), (0, 1), (1, 1)):
        was = (*before[len(before) - left :], *old, *after[:right])
        now = (*before[len(before) - left :], *new, *after[:right])
        for slot in slots if was else ():
            for start, end in _find(slot.text, was):
                yield slot.set(_replaced(slot.text, start, end, to_design(now)))
    if len(old) == len(new) == 1:
        yield from _changed_times(design, *old, *new)


def _changed_times(design: Design, old: str, new: str) -> Iterator[Design]:
    """Propose other numbers of `after`, which are nanoseconds in C++."""
    values = [each.replace("'", "") for each in (old, new)]
    if not all(each.isdecimal() for each in values):
        return
    unit = 1e6 if design.time_unit == "ms" else 1e9
    for located in iter_decisions(design):
        guard = located.decision.guard
        if re.fullmatch(r"[\d.]+", guard.after) and float(guard.after) * unit == float(values[0]):
            changed = replace(guard, after=f"{int(values[1]) / unit:.12g}")
            yield replace_decision(design, located.path, replace(located.decision, guard=changed))


def _added_transitions(design: Design, source: str, new: Words, before: Words) -> Iterator[Design]:
    """Propose a transition at each place of the state, or of all states."""
    for words in _rotations(new, before):
        found = _TRANSITION.fullmatch(" ".join(words))
        if found is None:
            continue
        transition = Transition(to=found["to"], guard=Guard(when=to_design(found["when"].split(" "))))
        for state in (each for each in design.states if source in ("", each.name)):
            for index in range(len(state.transitions) + 1):
                items = (*state.transitions[:index], transition, *state.transitions[index:])
                yield update_state(design, state.name, partial(replace, transitions=items))


def _rotations(new: Words, before: Words) -> Iterator[Words]:
    """The insertion, and the same one further ahead: the tokens at its end may be those before it."""
    words, ahead = list(new), list(before)
    for _step in range(len(words)):
        yield words
        if not ahead or ahead[-1] != words[-1]:
            return
        words.insert(0, words.pop())
        ahead.pop()


def _iter_slots(design: Design) -> Iterator[_Slot]:
    for located in iter_decisions(design):
        decision = located.decision
        if decision.guard.when:
            yield _Slot(located.source, decision.guard.when, partial(_with_when, design, located))
        if isinstance(decision, Transition):
            yield _Slot(located.source, decision.to, partial(_with_target, design, located, decision))
    for placed in iter_actions(design):
        action = placed.action
        pairs = action.values if isinstance(action, Assign) else action.arguments if isinstance(action, Call) else ()
        for index, (_name, text) in enumerate(pairs):
            yield _Slot(placed.state, text, partial(_with_value, design, placed, index))


def _with_when(design: Design, located: LocatedDecision, text: str) -> Design:
    guard = replace(located.decision.guard, when=text)
    return replace_decision(design, located.path, replace(located.decision, guard=guard))


def _with_target(design: Design, located: LocatedDecision, transition: Transition, text: str) -> Design:
    return replace_decision(design, located.path, replace(transition, to=text))


def _with_value(design: Design, placed: LocatedAction, index: int, text: str) -> Design:
    """The design with another assigned value, or another argument of a call."""
    action = placed.action
    if isinstance(action, Assign):
        return replace_action(design, placed.path, replace(action, values=_with(action.values, index, text)))
    assert isinstance(action, Call)
    changed = replace(action, arguments=_with(action.arguments, index, text))
    if placed.phase != "modulates":
        return replace_action(design, placed.path, changed)

    def change(state: State) -> State:
        return replace(state, modulates=tuple(changed if each is action else each for each in state.modulates))

    return update_state(design, placed.state, change)


def _with(pairs: tuple[tuple[str, str], ...], index: int, text: str) -> tuple[tuple[str, str], ...]:
    return tuple((name, text if at == index else value) for at, (name, value) in enumerate(pairs))


def _find(text: str, words: Words) -> Iterator[tuple[int, int]]:
    """The places of C++ tokens in an expression of the design."""
    found = [(word, span) for each, span in find_token_spans(text) for word in _CPP_TOKENS.get(each, (each,))]
    own = [plain_token(word) for word, _span in found]
    wanted = [plain_token(word) for word in words]
    for start in range(len(own) - len(wanted) + 1):
        if own[start : start + len(wanted)] == wanted:
            yield found[start][1][0], found[start + len(wanted) - 1][1][1]


def _replaced(text: str, start: int, end: int, new: str) -> str:
    if new:
        return text[:start] + new + text[end:]
    return f"{text[:start].rstrip()} {text[end:].lstrip()}".strip()


def to_design(words: Words) -> str:
    """C++ tokens as an expression of the design."""
    text = " ".join(map(plain_token, words))
    for pattern, replacement in _TO_DESIGN:
        text = re.sub(pattern, replacement, text)
    return text.strip()
