"""A line of states and transitions is read, or refused with a reason; what exists is not created again."""

import pytest

from vicode.model.design import Design, Guard, State, Transition
from vicode.model.transition_line import TransitionLine, add_line, is_transition_line, parse_transition_line

READ = (
    ("Idle -> Drive", ("Idle", "Drive"), ("",)),
    ("Idle->Drive", ("Idle", "Drive"), ("",)),
    ("Idle --> Drive → Pour", ("Idle", "Drive", "Pour"), ("", "")),
    ("Idle -order-> Drive -distance < 0.5-> Pour", ("Idle", "Drive", "Pour"), ("order", "distance < 0.5")),
    ("  Idle - order -> Drive", ("Idle", "Drive"), ("order",)),
    ("Idle --order--> Drive", ("Idle", "Drive"), ("order",)),
    ("A -x - 1 > 3-> B", ("A", "B"), ("x - 1 > 3",)),
    ("A -x > -3-> B", ("A", "B"), ("x > -3",)),
    ("A -x>y-> A", ("A", "A"), ("x>y",)),
    ("A -(-x > 3)-> B", ("A", "B"), ("(-x > 3)",)),
)
REFUSED = (
    ("Idle ->", "after an arrow"),
    ("-> Idle", "before an arrow"),
    ("Idle -> -> Pour", "after an arrow"),
    ("Idle order -> Drive", "'order' must stand between"),
    ("Idle -distance <-> Drive", "'distance <' is not a guard"),
    ("Idle -a or after 2 s-> Drive", "is not a guard"),
    ("Idle --x > 3-> Drive", "is not a guard"),
    ("Idle -> my drive", "'my drive' is not a name"),
    ("Idle -> Dr/ive", "is not a name"),
    ("Idle -> " + "x" * 2000, "at most"),
)


@pytest.mark.parametrize(("text", "states", "guards"), READ)
def test_states_and_guards_are_read(text: str, states: tuple[str, ...], guards: tuple[str, ...]) -> None:
    assert is_transition_line(text)
    line = parse_transition_line(text, "")
    assert line == TransitionLine(states=states, guards=tuple(Guard(when=each) for each in guards))


@pytest.mark.parametrize(("text", "reason"), REFUSED)
def test_other_lines_are_refused_with_a_reason(text: str, reason: str) -> None:
    assert is_transition_line(text)
    refusal = parse_transition_line(text, "")
    assert isinstance(refusal, str)
    assert reason in refusal


def test_times_are_read_as_in_guards() -> None:
    line = parse_transition_line("A -20 s-> B -x < 0.5 after 500 ms-> A", "ms")
    assert isinstance(line, TransitionLine)
    assert line.guards == (Guard(after="20000"), Guard(when="x < 0.5", after="500"))


@pytest.mark.parametrize("text", ["", "idle", "a - b > c", "Idle > Drive"])
def test_a_search_is_no_line(text: str) -> None:
    assert not is_transition_line(text)


def test_what_exists_is_used_and_the_rest_is_added() -> None:
    design = Design(
        component="Robot",
        initial="Idle",
        states=(
            State(name="Idle", transitions=(Transition(to="Drive", guard=Guard(when="order")),)),
            State(name="Drive"),
        ),
    )
    line = parse_transition_line("Idle -order-> Drive -20 s-> Pour -> Idle -> Drive", "")
    assert isinstance(line, TransitionLine)
    assert line.missing_states(design) == ("Pour",)
    grown = add_line(design, line)
    arrows = [
        (state.name, each.to, each.guard)
        for state in grown.states
        for each in state.transitions
        if isinstance(each, Transition)
    ]
    assert arrows == [
        ("Idle", "Drive", Guard(when="order")),
        ("Idle", "Drive", Guard()),
        ("Drive", "Pour", Guard(after="20")),
        ("Pour", "Idle", Guard()),
    ]
    assert add_line(grown, line) == grown


def test_the_first_state_of_a_new_design_is_initial() -> None:
    line = parse_transition_line("Idle -> Drive -> Idle", "")
    assert isinstance(line, TransitionLine)
    assert add_line(Design(component="Robot"), line).initial == "Idle"
