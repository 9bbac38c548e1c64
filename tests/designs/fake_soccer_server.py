"""A server that speaks as rcssserver in synchronous mode: it says what its script says, and collects the commands."""

import select
import socket
import sys
from collections.abc import Sequence

# What a player in the center who looks at the right goal sees.
FLAGS = "((f c t) 34 -90) ((f c b) 34 90) ((g r) 52.5 0) ((f r t) 62.5 -33) ((f r b) 62.5 33)"
BODY = "(view_mode high narrow) (stamina 7950 1 130600) (speed 0.2 0) (head_angle 0) (kick 0)"


def cycle(number: int, seen: str = "", heard: str = "", body: str = BODY) -> list[str]:
    """The messages of a cycle."""
    said = [f"(hear {number} referee {heard})"] if heard else []
    return [f"(sense_body {number} {body})", *said, f"(see {number} {FLAGS} {seen})", f"(think {number})"]


class FakeServer:
    """Sends each player the messages of a cycle, and those of the next when all players are done.

    Args:
        cycles: The messages of each cycle.
        port: 0 selects a free one.
        mode: What a player is told who joins.
    """

    def __init__(self, cycles: Sequence[Sequence[str]], port: int = 0, *, mode: str = "before_kick_off") -> None:
        self.cycles = cycles
        self._mode = mode
        self.commands: list[list[str]] = []
        """By player, in the order of joining."""
        self._entrance = _open(port)
        self._players: dict[socket.socket, tuple[str, int]] = {}
        self._current = 0
        self.address: tuple[str, int] = self._entrance.getsockname()

    def serve(self, timeout_s: float = 10.0) -> None:
        """Play until all cycles are over, or nothing comes."""
        done: set[socket.socket] = set()
        gone = 0
        while self._current < len(self.cycles) and (not self._players or gone < len(self._players)):
            ready, _, _ = select.select([self._entrance, *self._players], [], [], timeout_s)
            if not ready:
                break
            for each in ready:
                text, address = each.recvfrom(8192)
                if each is self._entrance:
                    self._join(address)
                    continue
                self._commands_of(each).append(text.decode())
                gone += text == b"(bye)"
                if text == b"(done)":
                    done.add(each)
            if self._players and len(done) == len(self._players):
                done.clear()
                self._current += 1
                for each in self._players if self._current < len(self.cycles) else ():
                    self._say(each, self.cycles[self._current])
        for each in (self._entrance, *self._players):
            each.close()

    def stop(self) -> None:
        """Play no more, as if all players had left."""
        for each in self._players:
            each.sendto(b"(bye)", each.getsockname())

    def _commands_of(self, player: socket.socket) -> list[str]:
        return self.commands[list(self._players).index(player)]

    def _join(self, address: tuple[str, int]) -> None:
        player = _open(0)
        self._players[player] = address
        params = "(server_param (goal_width 14.02) (synch_mode 1))"
        self._say(player, [f"(init l {len(self._players)} {self._mode})", params, *self.cycles[self._current]])
        self.commands.append([])

    def _say(self, player: socket.socket, messages: Sequence[str]) -> None:
        for message in messages:
            player.sendto(message.encode() + b"\0", self._players[player])


def _open(port: int) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    opened.bind(("127.0.0.1", port))
    return opened


if __name__ == "__main__":
    ball = "((b) 0.7 0 0 0)"
    script = [cycle(0), cycle(0, ball, "kick_off_l"), *(cycle(n, ball, "play_on") for n in range(1, 30))]
    script += [cycle(30, ball, "goal_l_1"), cycle(31, heard="time_over")]
    given = dict(argument.removeprefix("server::").split("=") for argument in sys.argv[1:])
    FakeServer(script, int(given["port"])).serve()
