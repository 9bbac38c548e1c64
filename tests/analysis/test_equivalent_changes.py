"""Changes of a design that are proved to have no effect, and others."""

import pytest

from vicode.analysis.decision_targets import is_equivalent
from vicode.analysis.machines import MachineAnalysis
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design, Guard, State, Transition
from vicode.model.project import Project


def make(first: str, second: str, *, dead: str = "true") -> Design:
    """Two transitions from A to B and C, and a state that is never active."""
    return Design(
        component="Machine",
        parameters=(
            Declaration(name="x", type="float", range=(0, 10)),
            Declaration(name="free", type="float"),
            Declaration(name="n", type="int"),
        ),
        initial="A",
        states=(
            State(
                name="A",
                transitions=(
                    Transition(to="B", guard=Guard(when=first)),
                    Transition(to="C", guard=Guard(when=second)),
                ),
            ),
            State(name="B"),
            State(name="C"),
            State(name="Dead", transitions=(Transition(to="A", guard=Guard(when=dead)),)),
        ),
    )


SECOND: DesignPath = ("states", "A", "transitions", 1, "when")


@pytest.mark.parametrize(
    ("first", "second", "changed", "expected"),
    [
        # The earlier transition is taken for 3.
        ("x <= 3", "x < 5", "x != 3 and x < 5", True),
        ("x < 3", "x < 5", "x != 3 and x < 5", False),
        # Outside of the range.
        ("x < 3", "x < 20", "x < 30", True),
        ("x < 3", "x < 20", "x < 9", False),
        # Only nan tells them apart.
        ("free < 3", "free >= 3", "not (free < 3)", False),
        ("x < 3", "x >= 3", "not (x < 3)", True),
        # The order of whole numbers.
        ("n < 3", "n > 3", "n >= 4", True),
        ("n < 3", "n > 3", "n >= 3", False),
    ],
)
def test_a_guard_under_earlier_ones(first: str, second: str, changed: str, *, expected: bool) -> None:
    design = make(first, second)
    machine = MachineAnalysis(Project(name="p", components=(), designs=(design,)), design)
    assert is_equivalent(machine, make(first, changed), SECOND) is expected


def test_a_change_of_a_state_that_is_never_active() -> None:
    design = make("x < 3", "x < 5")
    machine = MachineAnalysis(Project(name="p", components=(), designs=(design,)), design)
    assert is_equivalent(machine, make("x < 3", "x < 5", dead="false"), ("states", "Dead", "transitions", 0, "when"))
