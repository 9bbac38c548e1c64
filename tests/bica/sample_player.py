"""A component as the generator writes it, with most features of a design; used by the tests of the runtime."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

from vicode.bica import Component, State

if TYPE_CHECKING:
    from vicode.bica import Root


class Side(Enum):
    """The side to look at first."""

    left = "left"
    right = "right"


class Perception(Component):
    """Hand-written component that reads sensor values from the world."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.ball_seen = False
        self.ball_distance = 0.0
        self.fallen = False

    def work(self) -> None:
        self.ball_seen = self.world.ball_seen
        self.ball_distance = self.world.ball_distance
        self.fallen = self.world.fallen


class Search(Component):
    """Hand-written component that turns the head."""

    frequency_hz = 20

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.speed = 0.0
        self.side = Side.left

    def modulate(self, *, speed: float = 0.1, side: Side = Side.left) -> None:
        self.speed = speed
        self.side = side

    def work(self) -> None:
        self.world.log.append(f"search {self.speed} {self.side.name}")


class Player(Component):
    """A short version of the forward player."""

    design_file = "designs/player.yaml"
    frequency_hz = 10

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.perception = root.component(Perception)
        self.search = root.component(Search)
        self.side = Side.left
        self.kicks = 0
        self.tries = 0
        self._set_states(
            State("LookForBall", self._in_look_for_ball, requires=(self.perception,)),
            State(
                "FollowBall",
                self._in_follow_ball,
                requires=(self.perception,),
                enter=self._enter_follow_ball,
                leave=self._leave_follow_ball,
            ),
            State("GetUp", self._in_get_up, requires=(self.perception,)),
            State("Kick", self._in_kick, final=True),
        )

    def modulate(self, *, side: Side = Side.left) -> None:
        """Set the parameters."""
        self.side = side

    def _decide_common(self) -> bool:
        """Test the common transitions; return whether one of them ended the decision."""
        if self.perception.fallen:
            self._change_to("GetUp", "falls")
            return True
        return False

    def _act_common(self) -> None:
        """Run the common actions."""
        self.world.log.append("act")

    def _in_look_for_ball(self, decide: bool = True) -> None:
        """Look around until the ball is seen."""
        if decide and self._decide_common():
            return
        if decide:
            if self.perception.ball_seen and self.perception.ball_distance < 4000:
                self._change_to("FollowBall")
                return
            if self.root.now_ns - self._entered_ns >= 5_000_000_000:  # after 5 s
                self._change_to("GetUp", "gives_up")
                return
        self._act_common()
        self.tries = self.tries + 1
        self._call(self.search, speed=0.5, side=self.side)

    def _in_follow_ball(self, decide: bool = True) -> None:
        """Walk to the ball."""
        if decide and self._decide_common():
            return
        if decide:
            if self.perception.ball_seen:
                if self.perception.ball_distance < 100:
                    self._change_to("Kick")
                    return
                self._stay()
                return
            if self._when_ball_lost():
                self._change_to("LookForBall")
                return
        self._act_common()
        self._do_walk()

    def _enter_follow_ball(self) -> None:
        self.world.log.append("enter FollowBall")

    def _leave_follow_ball(self) -> None:
        self.world.log.append("leave FollowBall")

    def _when_ball_lost(self) -> bool:
        """Return whether the ball has been lost for more than a second."""
        return self.state_time > 1.0

    def _do_walk(self) -> None:
        self.world.log.append("walk")

    def _in_get_up(self, decide: bool = True) -> None:
        if decide and self._decide_common():
            return
        if decide:
            self._change_to("LookForBall")
            return
        self._act_common()

    def _in_kick(self, decide: bool = True) -> None:
        if decide and self._decide_common():
            return
        self._act_common()
        self.kicks = self.kicks + 1
