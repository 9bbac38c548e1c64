"""Plays a match of two versions of a design in this process: `python -m vicode.bica.match`, which a tournament starts.

Each robot has its own root. All see the same instant: the world moves on when each has stepped. The two versions have
modules of the same names, so those of the first are forgotten before the second is imported; the classes keep theirs.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Protocol

from .clock import SimulatedClock
from .errors import print_error
from .loader import UserCodeError, load_attribute, load_component, wrap_user_errors
from .root import Root
from .team import Team


class RobotWorld(Protocol):
    """The world of one robot in a match: what it perceives and commands, and its radio."""

    def hear(self, team: Team) -> None:
        """Call `team.prepare()`, and `team.hear` for each message that has arrived."""
        ...

    def tell(self, team: Team) -> None:
        """Send `team.tell()` to the other robots."""
        ...


class MatchWorld(Protocol):
    """What `start_match(seed)` of a world returns.

    Attributes:
        tick_ns: Time between two iterations in nanoseconds.
        teams: The worlds of the robots of the home team and of the other one.
        goals: The goals of both.
        finished: Whether the match is over.
    """

    tick_ns: int
    teams: Sequence[Sequence[RobotWorld]]

    @property
    def goals(self) -> tuple[int, int]: ...
    @property
    def finished(self) -> bool: ...
    def advance(self, now_ns: int) -> None:
        """Move robots and ball until `now_ns`."""
        ...


def main() -> int:
    parser = argparse.ArgumentParser(description="Play a match; the world is that of the first version.")
    parser.add_argument("components", nargs=2, help="the root components of both versions, as module:Class")
    parser.add_argument("--world", required=True, help="the world, as module:Class")
    parser.add_argument("--path", action="append", default=[], help="folders of the first version, then of the second")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=600.0, help="end of a match that is not finished")
    parser.add_argument("--exchange", action="store_true", help="the second version is the home team")
    options = parser.parse_args()
    half = len(options.path) // 2
    try:
        _enter_folders(options.path[:half])
        world, first = load_attribute(options.world), load_component(options.components[0])
        if not callable(getattr(world, "start_match", None)):
            raise UserCodeError(f"{options.world} has no start_match(seed), which a tournament needs")
        _leave_folders(options.path[:half])
        _enter_folders(options.path[half:])
        classes = [first, load_component(options.components[1])]
        with wrap_user_errors("the match failed"):
            summary = play(world.start_match(options.seed), classes, options)
    except UserCodeError as error:
        print_error(str(error))
        return 2
    sys.stdout.write(json.dumps({"summary": summary}) + "\n")
    return 0


def _enter_folders(folders: Sequence[str]) -> None:
    sys.path[:0] = folders


def _leave_folders(folders: Sequence[str]) -> None:
    sys.path[:] = [folder for folder in sys.path if folder not in folders]
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) or next(iter(getattr(module, "__path__", ())), "")
        if any(Path(file).is_relative_to(folder) for folder in folders):
            del sys.modules[name]


def play(match: MatchWorld, classes: Sequence[type[Any]], options: argparse.Namespace) -> dict[str, Any]:
    """Play a match until it is finished; return its summary, with the goals of both versions."""
    clock = SimulatedClock()
    teams = classes[::-1] if options.exchange else classes
    with ExitStack() as closing:
        roots = [
            closing.enter_context(Root(component_class, clock=clock, world=world))
            for component_class, worlds in zip(teams, match.teams, strict=True)
            for world in worlds
        ]
        while not match.finished and clock.now_ns() < options.seconds * 1e9:
            for root in roots:
                root.world.hear(root.team)
                root.step()
            for root in roots:
                root.world.tell(root.team)
            clock.advance(match.tick_ns)
            match.advance(clock.now_ns())
        stopped = "finished" if match.finished else "limit"
    goals = match.goals[::-1] if options.exchange else match.goals
    more = getattr(match, "summary", dict)()
    return {
        "stopped": stopped,
        "state": "",
        "time_ns": clock.now_ns(),
        "errors": sum(root.errors.total() for root in roots),
        "world": {**more, "goals_a": goals[0], "goals_b": goals[1]},
    }


if __name__ == "__main__":
    sys.exit(main())
