"""Cooperative states of a team: capacity, priorities and states that robots enter together."""

import pytest

from vicode.bica import Component, Root, SimulatedClock, State, Team, TeamMessage


class Defender(Component):
    """Enters the cooperative state `Block` as soon as it may."""

    capacity: int | None = None
    synchronized: int | None = None

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._set_states(
            State("Wait", self._in_wait),
            State("Block", self._in_block, capacity=self.capacity, synchronized=self.synchronized),
        )

    def _in_wait(self, decide: bool = True) -> None:
        if decide:
            self._change_to("Block")

    def _in_block(self, decide: bool = True) -> None:
        if decide:
            self._stay()


class SoleDefender(Defender):
    capacity = 1


class JointDefender(Defender):
    synchronized = 2


def step(root: Root, *messages: TeamMessage) -> TeamMessage:
    root.team.prepare()
    for message in messages:
        root.team.hear(message)
    root.step()
    return root.team.tell()


def message(
    component: type[Component], priority: int = 0, *, executed: bool = False, entering: bool = False
) -> TeamMessage:
    key = (component.__name__, "Block")
    return TeamMessage(priority, (key,) if executed else (), (key,) if entering else (), (key,))


@pytest.fixture
def sole() -> Root:
    return Root(SoleDefender, clock=SimulatedClock())


@pytest.fixture
def joint() -> Root:
    return Root(JointDefender, clock=SimulatedClock())


def test_a_free_state_is_entered_and_announced(sole: Root) -> None:
    assert step(sole) == message(SoleDefender, executed=True)
    assert sole.main.state == "Block"


def test_a_full_state_is_not_entered(sole: Root) -> None:
    other = message(SoleDefender, executed=True)
    assert step(sole, other) == message(SoleDefender, entering=True)
    assert sole.main.state == "Wait"


def test_a_full_state_is_a_conflict_for_a_robot_in_it(sole: Root) -> None:
    step(sole)
    assert not sole.main.conflict
    step(sole, message(SoleDefender, executed=True))
    assert sole.main.conflict


@pytest.mark.parametrize(
    ("own", "other", "state", "is_announced"),
    [(2, 1, "Block", False), (1, 2, "Wait", True), (1, 1, "Wait", False)],
)
def test_the_higher_priority_gets_the_last_place(own: int, other: int, state: str, is_announced: bool) -> None:
    root = Root(SoleDefender, clock=SimulatedClock())
    root.team.priority = own
    sent = step(root, message(SoleDefender, other, entering=True))
    assert root.main.state == state
    assert bool(sent.entering) == is_announced


def test_the_highest_priority_of_several_robots_counts(sole: Root) -> None:
    sole.team.priority = 2
    others = [message(SoleDefender, priority, entering=True) for priority in (3, 1)]
    step(sole, *others)
    assert sole.main.state == "Wait"


def test_a_robot_waits_until_the_team_has_answered(sole: Root) -> None:
    sole.team.ticks = 2
    states = []
    for _iteration in range(4):
        step(sole)
        states.append(sole.main.state)
    assert states == ["Wait", "Wait", "Block", "Block"]


def test_a_synchronized_state_needs_enough_robots(joint: Root) -> None:
    for _iteration in range(3):
        assert step(joint) == message(JointDefender, entering=True)
    assert joint.main.state == "Wait"


def test_a_synchronized_state_is_entered_when_all_robots_are_ready(joint: Root) -> None:
    active, ready = message(JointDefender), message(JointDefender, entering=True)
    for other in (active, active, ready):
        assert joint.main.state == "Wait"
        step(joint, other)
    assert joint.main.state == "Block"


def test_a_synchronized_state_is_entered_after_half_of_the_answer_time(joint: Root) -> None:
    joint.team.ticks = 4
    states = []
    for _iteration in range(5):
        step(joint, message(JointDefender, entering=True))
        states.append(joint.main.state)
    assert states == ["Wait", "Wait", "Wait", "Block", "Block"]


def test_messages_about_unknown_states_are_ignored(sole: Root) -> None:
    step(sole, message(JointDefender, executed=True, entering=True))
    assert sole.main.state == "Block"


def test_an_inactive_component_announces_nothing() -> None:
    root = Root(Component, clock=SimulatedClock())
    root.component(SoleDefender)
    assert step(root) == TeamMessage()


def test_messages_carry_the_priority() -> None:
    assert Team(priority=3).tell().priority == 3
