"""The rules of docs/semantics.md, each shown by stepping a component."""

from __future__ import annotations

from typing import Any

import pytest

from tests.bica.sample_player import Perception, Player, Search, Side
from vicode.bica import RESERVED_NAMES, Component, CyclicUseError, RealClock, Root, SimulatedClock, State

MS = 1_000_000


class World:
    """What the sample's hand-written components sense, and a log of what they do."""

    def __init__(self) -> None:
        self.ball_seen = False
        self.ball_distance = 5000.0
        self.fallen = False
        self.log: list[str] = []


class Robot:
    """A root with its clock and world, to step and look at."""

    def __init__(self, component_class: type[Component], **parameters: Any) -> None:
        self.clock = SimulatedClock()
        self.world = World()
        self.root = Root(component_class, clock=self.clock, world=self.world, on_error="stop", **parameters)

    def step(self, ms: int = 0) -> list[str]:
        """Let `ms` pass, run one iteration, and return what was logged in it."""
        self.clock.advance(ms * MS)
        self.world.log.clear()
        self.root.step()
        return list(self.world.log)


class Worker(Component):
    """Hand-written: logs its works and restarts."""

    frequency_hz = 10

    def restart(self) -> None:
        self.world.log.append("restart")

    def work(self) -> None:
        self.world.log.append("work")


class Switch(Component):
    """Steps a worker while it is on; `wish` is set by tests."""

    target: type[Component] = Worker

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.worker = root.component(self.target)
        self.wish = True
        self._set_states(State("On", self._in_on, leave=self._leave_on), State("Off", self._in_off))

    def _in_on(self, decide: bool = True) -> None:
        if decide and not self.wish:
            self._change_to("Off")
            return
        self._call(self.worker)

    def _leave_on(self) -> None:
        self.world.log.append("leave On")

    def _in_off(self, decide: bool = True) -> None:
        if decide and self.wish:
            self._change_to("On")


class ResumingWorker(Worker):
    resume = True


class ResumingSwitch(Switch):
    target = ResumingWorker


class Upper(Component):
    """Steps a switch while it is awake."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.switch = root.component(Switch)
        self.is_awake = True

    def work(self) -> None:
        if self.is_awake:
            self.switch.step()


def test_a_component_works_when_its_period_has_elapsed() -> None:
    robot = Robot(Worker)
    assert robot.step() == ["restart", "work"]
    assert robot.step(99) == []
    assert robot.step(1) == ["work"]


def test_a_late_component_runs_late_and_never_twice_to_catch_up() -> None:
    robot = Robot(Worker)
    robot.step()
    assert robot.step(370) == ["work"]
    assert robot.step(99) == []
    assert robot.step(1) == ["work"]


def test_a_component_without_frequency_works_at_every_step() -> None:
    robot = Robot(Perception)
    robot.world.ball_seen = True
    robot.step()
    assert robot.root.component(Perception).ball_seen
    robot.world.ball_seen = False
    robot.step()
    assert not robot.root.component(Perception).ball_seen


def test_a_component_that_was_left_out_restarts_and_works_at_once() -> None:
    robot = Robot(Switch)
    switch = robot.root.component(Switch)
    assert robot.step() == ["restart", "work"]
    switch.wish = False
    assert robot.step(10) == ["leave On"]
    switch.wish = True
    assert robot.step(10) == ["restart", "work"]


def test_a_resuming_component_restarts_only_once() -> None:
    robot = Robot(ResumingSwitch)
    switch = robot.root.component(ResumingSwitch)
    assert robot.step() == ["restart", "work"]
    switch.wish = False
    robot.step(10)
    switch.wish = True
    assert robot.step(10) == []
    assert robot.step(80) == ["work"]


def test_a_restart_goes_to_the_initial_state_without_leaving_the_old_one() -> None:
    robot = Robot(Upper)
    upper, switch = robot.root.component(Upper), robot.root.component(Switch)
    robot.step()
    switch.wish = False
    robot.step(10)
    assert switch.state == "Off"
    upper.is_awake = False
    robot.step(10)
    upper.is_awake = switch.wish = True
    assert robot.step(10) == ["restart", "work"]
    assert switch.state == "On"
    assert switch.state_time == switch.component_time == 0.0
    upper.is_awake = False
    assert robot.step(10) == []
    upper.is_awake = True
    assert robot.step(10) == ["restart", "work"], "the abandoned state On is not left"


def test_values_survive_a_restart() -> None:
    robot = Robot(Player)
    player = robot.root.component(Player)
    robot.step()
    robot.root.iteration += 5
    robot.step(1000)
    assert player.tries == 2


def test_requirements_are_stepped_when_it_is_not_time_to_work() -> None:
    robot = Robot(Player)
    perception = robot.root.component(Perception)
    robot.step()
    robot.world.ball_seen = True
    robot.step(10)
    assert perception.ball_seen
    assert robot.root.main.state == "LookForBall"


def test_called_components_are_stepped_again_with_the_last_parameters() -> None:
    robot = Robot(Player, side=Side.right)
    player, search = robot.root.component(Player), robot.root.component(Search)
    assert robot.step() == ["act", "search 0.5 right"]
    player.side = Side.left
    search.modulate(speed=9.0)
    assert robot.step(50) == ["search 0.5 right"], "the caller's own parameters, as last computed"
    assert robot.step(50) == ["act", "search 0.5 left"]


def test_parameters_left_out_take_their_defaults() -> None:
    robot = Robot(Search)
    search = robot.root.component(Search)
    search.modulate(speed=3.0)
    search.modulate()
    assert search.speed == 0.1


def test_a_change_leaves_enters_and_acts_in_one_iteration() -> None:
    robot = Robot(Player)
    player = robot.root.component(Player)
    robot.step()
    robot.world.ball_seen, robot.world.ball_distance = True, 1000.0
    assert robot.step(100) == ["enter FollowBall", "act", "walk"]
    assert player.state_time == 0.0
    assert player.component_time == 0.1
    assert robot.step(20) == [], "a change forgets the calls of the old state"
    robot.world.ball_seen = False
    assert robot.step(80) == ["act", "walk"]
    assert robot.step(1000) == ["leave FollowBall", "act", "search 0.5 left"]


def test_the_first_guard_that_holds_ends_the_decision() -> None:
    robot = Robot(Player)
    robot.world.ball_seen, robot.world.ball_distance = True, 50.0
    robot.step()
    assert robot.root.main.state == "FollowBall", "one change an iteration, though Kick is near"
    robot.step(100)
    assert robot.root.main.state == "Kick"


def test_stay_ends_the_decision_and_changes_nothing() -> None:
    robot = Robot(Player)
    robot.world.ball_seen, robot.world.ball_distance = True, 1000.0
    robot.step()
    assert robot.step(5000) == ["act", "walk"]
    assert robot.root.main.state_time == 5.0


def test_common_transitions_come_first_and_to_itself_changes_nothing() -> None:
    robot = Robot(Player)
    robot.world.ball_seen = robot.world.fallen = True
    assert robot.step() == ["act"]
    assert robot.root.main.state == "GetUp"
    assert robot.step(100) == ["act"]
    assert robot.root.main.state == "GetUp"
    assert robot.root.main.state_time == 0.1


@pytest.mark.parametrize(("last_ms", "state"), [(4999, "LookForBall"), (5000, "GetUp")])
def test_after_counts_from_the_entry(last_ms: int, state: str) -> None:
    robot = Robot(Player)
    robot.step()
    robot.step(last_ms)
    assert robot.root.main.state == state


def test_new_requirements_are_stepped_and_old_ones_not_twice() -> None:
    log: list[str] = []

    class Eye(Component):
        def work(self) -> None:
            log.append("eye")

    class Ear(Component):
        def work(self) -> None:
            log.append("ear")

    class Listener(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            eye, ear = root.component(Eye), root.component(Ear)
            self._set_states(
                State("Look", self._in_look, requires=(eye,)),
                State("Listen", self._in_listen, requires=(eye, ear), enter=lambda: log.append("enter")),
            )

        def _in_look(self, decide: bool = True) -> None:
            self._change_to("Listen")

        def _in_listen(self, decide: bool = True) -> None:
            log.append("act")

    Root(Listener, clock=SimulatedClock()).step()
    assert log == ["eye", "enter", "ear", "act"]


def test_done_is_told_while_it_is_stepped_and_one_iteration_longer() -> None:
    robot = Robot(Player)
    player = robot.root.component(Player)
    robot.world.ball_seen, robot.world.ball_distance = True, 50.0
    robot.step()
    assert not player.is_done
    robot.step(100)
    assert player.is_done
    robot.step(100)
    assert player.kicks == 2, "a final state keeps acting"
    robot.root.iteration += 1
    assert player.is_done
    robot.root.iteration += 1
    assert not player.is_done


def test_each_class_has_one_instance_a_root() -> None:
    root, other = Root(Player, world=World()), Root(Player, world=World())
    player = root.component(Player)
    assert player is root.main
    assert player.perception is root.component(Perception)
    assert player.perception is not other.component(Perception)
    assert [type(component) for component in root.components] == [Perception, Search, Player]


def test_components_that_use_each_other_are_refused() -> None:
    class First(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            root.component(Second)

    class Second(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            root.component(First)

    with pytest.raises(CyclicUseError, match="First -> Second -> First"):
        Root(First)


def test_every_public_name_of_a_component_is_reserved() -> None:
    public = {name for name in dir(Root(Worker).main) if not name.startswith("_")}
    assert public == RESERVED_NAMES


def test_clocks() -> None:
    clock = RealClock()
    assert 0 <= clock.now_ns() <= clock.now_ns()
    with pytest.raises(ValueError, match="back"):
        SimulatedClock().advance(-1)
