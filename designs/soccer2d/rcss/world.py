"""The client of one player: what it knows of the match, and the commands that it sends."""

import cmath
import math
import select
import socket
from typing import Any

from .landmarks import LANDMARKS, locate, relative
from .messages import parse

CYCLE_NS = 100_000_000
_FAR = 130.0
_GOAL_X = 52.5
_AIMS = (0.0, -3.0, 3.0, -6.0, 6.0)
_KICKS = ("kick_off", "kick_in", "free_kick", "indirect_free_kick", "goal_kick", "corner_kick", "goalie_catch_ball")
_WAITING = ("before_kick_off", "goal", "half_time", "time_over", "time_up")
_IMAGE_TIMEOUT_S = 0.05
_SILENCE_S = 1.0
"""After so long without a message, the program may check whether it has to end."""
_REMEMBERED_CYCLES = 5
_BUFFERED_CYCLES = 10
"""After so many cycles at once, the buffer of the socket may have been full, and newer messages dropped."""
_NEAREST_MATE, _FARTHEST_MATE = 4.0, 30.0


class World:
    """Connects to the server, which sets the pace (`clock: world`): one iteration is one cycle of the server.

    All values are in the view of the own team: its goal is at x = -52.5.

    Args:
        team: Players with the same name are a team.
        goalkeeper: Whether the player may catch the ball.
        server: Address of the server.
        timeout_s: The match ends if the server is silent for so long.

    Raises:
        OSError: No server answers, or it refuses the player.
    """

    def __init__(
        self,
        *,
        team: str = "vicode",
        goalkeeper: bool = False,
        server: tuple[str, int] = ("127.0.0.1", 6000),
        timeout_s: float = 10.0,
    ) -> None:
        self.finished = False
        self.situation = "waiting"
        self.x, self.y, self.heading, self.neck, self.speed = 0.0, 0.0, 0.0, 0.0, 0.0
        self.stamina = 8000.0
        self.ball_x = self.ball_y = self.ball_direction = 0.0
        self.ball_distance, self.ball_age = _FAR, 1000.0
        self.goal_distance, self.goal_direction = _FAR, 0.0
        self.mate_is_free = False
        self.mate_distance, self.mate_direction = _FAR, 0.0
        self.mate_to_ball = self.opponent_distance = _FAR
        self.cycle = self._server_time = 0
        self.goals = self.conceded = 0
        self._team, self._timeout_s = team, timeout_s
        self._is_synchronous = False
        self._position = self._ball = 0j
        self._ball_cycle = -10_000
        self._mates: list[tuple[int, complex]] = []
        self._body_command = self._neck_command = ""
        self._sent_cycle = 0
        self._silent_s = 0.0
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.settimeout(timeout_s)
        self._server = server
        self.side, self.number = "l", 0
        self._join(goalkeeper=goalkeeper)

    # Commands: those of the last step of a cycle count.

    def dash(self, *, power: float) -> None:
        self._body_command = f"(dash {power:.1f})"

    def turn(self, *, angle: float) -> None:
        """Turn the body by `angle`; a player who runs turns less, so the command is larger."""
        self._body_command = f"(turn {max(-180.0, min(180.0, angle * (1 + 5 * self.speed))):.1f})"

    def kick(self, *, power: float, direction: float) -> None:
        self._body_command = f"(kick {power:.1f} {direction:.1f})"

    def catch(self, *, direction: float) -> None:
        self._body_command = f"(catch {direction:.1f})"

    def move(self, *, to_x: float, to_y: float) -> None:
        self._body_command = f"(move {to_x:.1f} {to_y:.1f})"

    def turn_neck(self, *, angle: float) -> None:
        self._neck_command = f"(turn_neck {angle:.1f})"

    # The run

    def now_ns(self) -> int:
        """Return the time of the server."""
        return self.cycle * CYCLE_NS

    def next_cycle(self) -> int:
        """Send the commands unless they are sent, take the newest cycle, and return how many have begun."""
        self.send_commands()
        before = self.cycle
        self.receive_cycle()
        if self.cycle - before > _BUFFERED_CYCLES and not self._is_synchronous:
            self.receive_cycle()
        return 0 if self.finished else self.cycle - before

    def hold(self) -> None:
        """Drop the commands of this cycle: a player who is not commanded slows down and stops."""
        self._body_command = self._neck_command = ""

    def receive_cycle(self) -> None:
        """Take the messages of the newest cycle: in real time until the image, in synchronous mode until `(think)`."""
        has_begun = is_complete = False
        while not self.finished and (not is_complete or select.select([self._socket], [], [], 0)[0]):
            wait_s = min(_SILENCE_S, self._timeout_s)
            if has_begun:
                wait_s = self._timeout_s if self._is_synchronous else _IMAGE_TIMEOUT_S
            self._socket.settimeout(wait_s)
            try:
                kind = self.update(parse(self._socket.recv(8192).decode("utf-8", "replace").strip("\0")))
            except ValueError:
                continue
            except TimeoutError:
                self._silent_s += 0.0 if has_begun else wait_s
                self.finished = self._silent_s >= self._timeout_s
                break
            except OSError:
                self.finished = True
                break
            self._silent_s = 0.0
            if kind == "sense_body":
                has_begun, is_complete = True, False
            is_complete = is_complete or (has_begun and kind == ("think" if self._is_synchronous else "see"))

    def send_commands(self) -> None:
        """Send the commands of this cycle; a server in synchronous mode continues when all players have sent theirs."""
        if self._sent_cycle == self.cycle:
            return
        self._sent_cycle = self.cycle
        done = "(done)" if self._is_synchronous and self.cycle else ""
        for command in (self._body_command, self._neck_command, done):
            if command:
                self._send(command)
        self._body_command = self._neck_command = ""

    def close(self) -> None:
        self._send("(bye)")
        self._socket.close()

    def snapshot(self) -> dict[str, object]:
        """Return the position and the score."""
        return {"x": self.x, "y": self.y, "score": f"{self.goals}:{self.conceded}", "situation": self.situation}

    def summary(self) -> dict[str, object]:
        """Return the result of the match."""
        result = {"team": self._team, "side": self.side, "number": self.number, "cycles": self.cycle}
        return {**result, "goals": self.goals, "conceded": self.conceded}

    # The server

    def _join(self, *, goalkeeper: bool) -> None:
        self._send(f"(init {self._team} (version 18){' (goalie)' if goalkeeper else ''})")
        # Another port of the server answers, and serves this player from now on.
        try:
            text, self._server = self._socket.recvfrom(8192)
        except TimeoutError:
            self._socket.close()
            raise TimeoutError(f"no server answers at {self._server[0]}:{self._server[1]}") from None
        match parse(text.decode("utf-8", "replace").strip("\0")):
            case ["init", ("l" | "r") as side, number, mode]:
                self._send("(synch_see)")
                self._send("(change_view narrow)")
                self.side, self.number = side, int(number)
                self._obey(mode)
            case answer:
                self._socket.close()
                raise ConnectionRefusedError(f"the server refuses the player: {' '.join(map(str, answer))}")

    def _send(self, command: str) -> None:
        self._socket.sendto(command.encode(), self._server)

    # Messages

    def update(self, message: list[Any]) -> str:
        """Take a message of the server and return its kind."""
        match message:
            case ["sense_body", time, *fields]:
                # The time stands still while the ball is not in play, and jumps if messages were lost.
                self.cycle += max(1, int(time) - self._server_time) if self.cycle else 1
                self._server_time = int(time)
                self._sense({name: values for name, *values in fields})
            case ["see", _time, *objects]:
                # Of objects that are far away, only the direction is seen.
                self._see([(each[0], relative(float(each[1]), float(each[2]))) for each in objects if len(each) > 2])
            case ["hear", _time, "referee", said]:
                self._obey(said)
            case ["server_param", *parameters]:
                self._is_synchronous = ["synch_mode", "1"] in parameters
        return str(message[0])

    def _sense(self, fields: dict[str, list[str]]) -> None:
        self.stamina = float(fields["stamina"][0])
        self.speed = float(fields["speed"][0])
        self.neck = float(fields["head_angle"][0])
        self.ball_age = round((self.cycle - self._ball_cycle) * CYCLE_NS / 1e9, 1)

    def _see(self, objects: list[tuple[list[str], complex]]) -> None:
        """Update position, ball and players; places are relative to the direction of view until they are turned."""
        view = locate((LANDMARKS[name], place) for each, place in objects if (name := " ".join(each)) in LANDMARKS)
        if view is not None:
            direction = view[1] - self.neck + (180 if self.side == "r" else 0)
            self._position = -view[0] if self.side == "r" else view[0]
            self.x, self.y = round(self._position.real, 2), round(self._position.imag, 2)
            self.heading = round((direction + 180) % 360 - 180, 1)
        turned = [(name, place * relative(1, self.neck)) for name, place in objects]
        for name, place in turned:
            if name[0] in ("b", "B"):
                self._ball, self._ball_cycle, self.ball_age = self._to_field(place), self.cycle, 0.0
        self.ball_x, self.ball_y = round(self._ball.real, 2), round(self._ball.imag, 2)
        self.ball_distance, self.ball_direction = self._from_body(self._ball)
        known = [(name[1], place) for name, place in turned if name[0] == "p" and len(name) > 1]
        self._look_at_players(
            mates=[place for team, place in known if team == self._team],
            opponents=[place for team, place in known if team != self._team],
        )

    def _look_at_players(self, *, mates: list[complex], opponents: list[complex]) -> None:
        self._mates = [known for known in self._mates if self.cycle - known[0] < _REMEMBERED_CYCLES]
        self._mates += [(self.cycle, self._to_field(mate)) for mate in mates]
        self.mate_to_ball = round(min((abs(mate - self._ball) for _seen, mate in self._mates), default=_FAR), 1)
        self.opponent_distance = round(min(map(abs, opponents), default=_FAR), 1)
        free = [mate for mate in mates if self._to_field(mate).real > self.x and _is_free(mate, opponents)]
        self.mate_is_free = bool(free)
        self.mate_distance, self.mate_direction = _polar(min(free, key=abs)) if free else (_FAR, 0.0)
        aims = [self._to_body(complex(_GOAL_X, y)) for y in _AIMS]
        self.goal_distance, self.goal_direction = _polar(max(aims, key=lambda aim: _gap(aim, opponents)))

    def _obey(self, said: str) -> None:
        """Take a message of the referee, such as `kick_in_l` or `goal_r_2`."""
        words = said.split("_")
        if words[0] == "goal" and words[-1].isdigit():
            if words[1] == self.side:
                self.goals = int(words[-1])
            else:
                self.conceded = int(words[-1])
        if said in ("play_on", "drop_ball"):
            self.situation = "play_on"
        elif said.startswith(_WAITING) and not said.startswith("goal_kick"):
            self.situation = "waiting"
        elif said.rpartition("_")[0] in _KICKS and words[-1] == self.side:
            self.situation = "our_kick"
        else:
            self.situation = "their_kick"
        self.finished = self.finished or said == "time_over"

    # Coordinates

    def _to_field(self, place: complex) -> complex:
        return self._position + place * relative(1, self.heading)

    def _to_body(self, place: complex) -> complex:
        return (place - self._position) * relative(1, -self.heading)

    def _from_body(self, place: complex) -> tuple[float, float]:
        return _polar(self._to_body(place))


def _polar(place: complex) -> tuple[float, float]:
    """Return distance and direction in degrees."""
    return round(abs(place), 2), round(math.degrees(cmath.phase(place)), 1)


def _gap(place: complex, others: list[complex]) -> float:
    """Return the angle in degrees between a place and the next of the others that are nearer."""
    angles = (abs(math.degrees(cmath.phase(other / place))) for other in others if 0 < abs(other) < abs(place))
    return min(angles, default=180.0)


def _is_free(mate: complex, opponents: list[complex]) -> bool:
    return _NEAREST_MATE < abs(mate) < _FARTHEST_MATE and _gap(mate, opponents) > 12
