"""The world of one robot, and the match that all robots share."""

import cmath
import math
from random import Random
from typing import Any

from pitch.physics import HALF_LENGTH, STEP_S, Pitch, Robot
from pitch.radio import Packet, Radio
from vicode.bica import Team

TICK_NS = 100_000_000
MATCH_S = 300.0
ROBOTS = 3
_SIGHT, _MISSED = 3.0, 0.1
_ALIVE_S = 0.5
_ANSWER_TICKS = 5
_FAR, _LONG_AGO = 100.0, 100.0


class Match:
    """Two teams on a pitch. A seed and the same commands give the same match.

    Attributes:
        tick_ns: Time between two iterations of the robots.
        teams: The worlds of the robots of the home team and of the other one.
    """

    tick_ns = TICK_NS

    def __init__(self, seed: int, *, robots: tuple[int, int] = (ROBOTS, ROBOTS)) -> None:
        self._ticks = 0
        seats = [(side, number) for side, count in zip((1, -1), robots, strict=True) for number in range(1, count + 1)]
        self.pitch = Pitch([Robot(side=s, number=n, noise=Random(f"{seed}/body {s} {n}")) for s, n in seats])
        radios = {side: Radio(f"{seed}/radio {side}", ROBOTS) for side in (1, -1)}
        worlds = [World(seed, match=self, robot=robot, radio=radios[robot.side]) for robot in self.pitch.robots]
        self.teams = tuple([world for world in worlds if world.robot.side == side] for side in (1, -1))

    @property
    def finished(self) -> bool:
        return self.now_s >= MATCH_S

    @property
    def now_s(self) -> float:
        return self._ticks * TICK_NS / 1e9

    @property
    def goals(self) -> tuple[int, int]:
        """The goals of the home team and of the other one."""
        return self.pitch.goals[1], self.pitch.goals[-1]

    def place_alone(self, world: "World") -> None:
        """Let one robot play on the empty pitch."""
        self.teams[0].append(world)
        self.pitch = Pitch([world.robot])

    def advance(self, now_ns: int) -> None:
        """Execute the commands until `now_ns`, then let all robots look."""
        while (self._ticks + 1) * TICK_NS <= now_ns:
            self._ticks += 1
            for _step in range(round(TICK_NS / 1e9 / STEP_S)):
                self.pitch.step()
            for world in (*self.teams[0], *self.teams[1]):
                world.hold()
                world.look()

    def summary(self) -> dict[str, Any]:
        return {"kicks": self.pitch.kicks, "dropped_balls": self.pitch.dropped_balls}


class World:
    """What one robot perceives and commands; x points to the goal that its team attacks.

    Without a match, the robot is alone on the pitch.
    """

    def __init__(
        self, seed: int = 1, *, match: Match | None = None, robot: Robot | None = None, radio: Radio | None = None
    ) -> None:
        self.x = self.y = self.heading = 0.0
        self.ball_x = self.ball_y = self.ball_distance = self.ball_bearing = self.ball_age = 0.0
        self.goal_distance = self.shot_direction = 0.0
        self.mate_to_ball = self.mate_to_goal = _FAR
        self.match = match or Match(seed, robots=(0, 0))
        self.robot = robot or Robot(side=1, number=ROBOTS, noise=Random(f"{seed}/body"))
        self._radio = radio or Radio(f"{seed}/radio", ROBOTS)
        self._noise = Random(f"{seed}/eyes {self.robot.side} {self.robot.number}")
        self._seen_s, self._ball = 0.0, 0j
        self._heard: dict[int, Packet] = {}
        if match is None:
            self.match.place_alone(self)
        self.look()

    @classmethod
    def start_match(cls, seed: int) -> Match:
        """The match that `vicode tournament` plays."""
        return Match(seed)

    # Commands: they hold for one iteration.

    def walk(self, *, forward: float, left: float, turn: float) -> None:
        self.robot.walking, self.robot.turning = complex(forward, left), math.radians(turn)

    def kick(self, *, power: float) -> None:
        self.robot.kick_power = power

    def hold(self) -> None:
        """Stop: a robot stands unless it is commanded again."""
        self.robot.walking, self.robot.turning, self.robot.kick_power = 0j, 0.0, 0.0

    # Alone

    def advance(self, now_ns: int) -> None:
        self.match.advance(now_ns)

    @property
    def finished(self) -> bool:
        return self.match.finished

    def summary(self) -> dict[str, Any]:
        return {"goals": self.match.goals[0], **self.match.summary()}

    def snapshot(self) -> dict[str, Any]:
        ball = self.match.pitch.ball
        return {"x": self.robot.at.real, "y": self.robot.at.imag, "ball_x": ball.real, "ball_y": ball.imag}

    # Perception

    def look(self) -> None:
        """Update what the robot knows: its place, and the ball if it is in sight and not missed."""
        draw, side = self._noise, self.robot.side
        place = side * self.robot.at + complex(draw.gauss(0, 0.02), draw.gauss(0, 0.02))
        self.x, self.y = place.real, place.imag
        turned = math.degrees(self.robot.heading) + (0 if side > 0 else 180) + draw.gauss(0, 1.5)
        self.heading = (turned + 180) % 360 - 180
        ball = side * self.match.pitch.ball
        distance = abs(ball - side * self.robot.at)
        is_missed, error = draw.random() < _MISSED, complex(draw.gauss(0, 0.04), draw.gauss(0, 0.04))
        if distance < _SIGHT and not is_missed:
            self._ball, self._seen_s = ball + error * distance, self.match.now_s
        self._place_ball()

    def _place_ball(self) -> None:
        place = complex(self.x, self.y)
        self.ball_x, self.ball_y = self._ball.real, self._ball.imag
        self.ball_age = round(self.match.now_s - self._seen_s, 1)
        gap = self._ball - place
        self.ball_distance = abs(gap)
        self.ball_bearing = math.degrees(cmath.phase(gap * cmath.rect(1, -math.radians(self.heading))))
        self.shot_direction = math.degrees(cmath.phase(HALF_LENGTH + 0.1 - self._ball))
        self.goal_distance = abs(place + HALF_LENGTH)

    # Team messages

    def hear(self, team: Team) -> None:
        """Give a team the newest messages of the others; the robot at the ball has the highest priority."""
        now_s = self.match.now_s
        for packet in self._radio.receive(self.robot.number, now_s):
            known = self._heard.get(packet.sender)
            if known is None or known.sent_s < packet.sent_s:
                self._heard[packet.sender] = packet
        alive = [packet for packet in self._heard.values() if now_s - packet.sent_s < _ALIVE_S]
        for packet in alive:
            if packet.sent_s - packet.ball_age > self._seen_s:
                self._ball, self._seen_s = packet.ball, packet.sent_s - packet.ball_age
        self._place_ball()
        self.mate_to_ball = min((packet.ball_distance for packet in alive), default=_FAR)
        self.mate_to_goal = min((math.hypot(packet.x + HALF_LENGTH, packet.y) for packet in alive), default=_FAR)
        team.ticks = _ANSWER_TICKS
        # Robots with equal priority would yield to each other.
        team.priority = -round(1000 * self.ball_distance) * (ROBOTS + 1) + self.robot.number
        team.prepare()
        for packet in alive:
            team.hear(packet.states)

    def tell(self, team: Team) -> None:
        """Send what the robot does and knows."""
        self._radio.send(
            Packet(
                sender=self.robot.number,
                sent_s=self.match.now_s,
                states=team.tell(),
                x=self.x,
                y=self.y,
                ball=self._ball,
                ball_distance=self.ball_distance,
                ball_age=self.ball_age,
            )
        )
