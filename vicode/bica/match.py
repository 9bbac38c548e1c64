"""Plays a match of two versions of a design: `python -m vicode.bica.match`.

Each robot has its own root. All see the same instant: the world moves on when each has stepped. Both versions have
modules of the same names, so those of the first are forgotten before the second is imported; its classes keep them.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from .clock import SimulatedClock
from .component import Component
from .errors import print_error
from .loader import UserCodeError, load_attribute, load_component, wrap_user_errors
from .root import Root


def main() -> int:
    """Play a match in the world of the first version, and print its summary as JSON."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    add = parser.add_argument
    add("components", nargs=2, help="the root components of both versions, as module:Class")
    add("--world", required=True, help="a world with start_match(seed), as module:Class")
    add(
        "--path", action="append", default=[], help="folders of modules: those of the first version, then as many again"
    )
    add("--seed", type=int, default=1)
    add("--seconds", type=float, default=600.0, help="end of a match that is not finished")
    add("--exchange", action="store_true", help="the second version is the home team")
    options = parser.parse_args()
    middle = len(options.path) // 2
    first, second = options.path[:middle], options.path[middle:]
    try:
        sys.path[:0] = first
        world, home = load_attribute(options.world), load_component(options.components[0])
        _forget_modules(first)
        sys.path[:0] = second
        teams = (home, load_component(options.components[1]))
        with wrap_user_errors("the match failed"):
            summary = play(world.start_match(options.seed), teams, options.seconds, exchange=options.exchange)
    except UserCodeError as error:
        print_error(str(error))
        return 2
    sys.stdout.write(json.dumps({"summary": summary}) + "\n")
    return 0


def play(match: Any, teams: Sequence[type[Component]], seconds: float, *, exchange: bool = False) -> dict[str, Any]:
    """Play a match and return its summary, with the goals of both teams as `goals_a` and `goals_b`.

    Args:
        match: What `start_match` of a world returns (docs/team.md).
        teams: The root components of the robots of both teams.
        seconds: When to stop a match that is not finished.
        exchange: Whether the second team is the home team, whose worlds are the first of the match.
    """
    clock, order = SimulatedClock(), -1 if exchange else 1
    with ExitStack() as closing:
        roots = [
            closing.enter_context(Root(team, clock=clock, world=world))
            for team, worlds in zip(teams[::order], match.teams, strict=True)
            for world in worlds
        ]
        while not match.finished and clock.now_ns() < seconds * 1e9:
            for root in roots:
                root.world.hear(root.team)
                root.step()
            for root in roots:
                root.world.tell(root.team)
            clock.advance(match.tick_ns)
            match.advance(clock.now_ns())
        goals_a, goals_b = match.goals[::order]
        summary = {
            "stopped": "finished" if match.finished else "limit",
            "state": "",
            "time_ns": clock.now_ns(),
            "world": {**match.summary(), "goals_a": goals_a, "goals_b": goals_b},
        }
    # Those of closing included.
    return {**summary, "errors": sum(root.errors.total() for root in roots)}


def _forget_modules(folders: Sequence[str]) -> None:
    sys.path[:] = [folder for folder in sys.path if folder not in folders]
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) or next(iter(getattr(module, "__path__", ())), "")
        if any(Path(file).is_relative_to(folder) for folder in folders):
            del sys.modules[name]


if __name__ == "__main__":
    sys.exit(main())
