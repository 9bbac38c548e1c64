"""`vicode bridge --reload`: generates or compiles again after each change, and exchanges the code of all robots."""

import argparse
import asyncio
import sys
import threading
from pathlib import Path

from vicode.bica.reload import Reloader
from vicode.bridge.behaviors import BehaviorCatalog, BehaviorError, DesignBehavior
from vicode.bridge.robot import Robot
from vicode.bridge.server import BridgeServer
from vicode.cli.bridge_behaviors import load_behaviors, load_world
from vicode.cli.console import describe_os_error
from vicode.services.file_changes import iter_changes
from vicode.services.project_loader import DESIGN_SUFFIXES, XABSL_SUFFIXES

_SUFFIXES = (".py", *DESIGN_SUFFIXES, *XABSL_SUFFIXES)


class BridgeReloader:
    """Exchanges the code of the robots of a server when its files change.

    Designs keep states, times and values; XABSL agents start anew. The world keeps its code.

    Args:
        server: The server, of which the ticks run in the current event loop.
        args: The arguments of the command.
        folder: The folder with the generated code.
    """

    def __init__(self, server: BridgeServer, args: argparse.Namespace, folder: Path) -> None:
        self._server, self._args, self._folder = server, args, folder
        self._loop = asyncio.get_running_loop()
        path = Path(args.path).resolve()
        project = path if path.is_dir() else path.parent
        self._watched = [project] if args.import_path is None else [project, args.import_path.resolve()]
        self._reloaders: dict[str, Reloader] = {}

    def start(self) -> None:
        """Watch in a thread that ends with the process."""
        threading.Thread(target=self._watch, daemon=True).start()

    def follow(self, robot: Robot) -> None:
        """Remember the code with which a robot starts."""
        if isinstance(robot.behavior, DesignBehavior):
            folders = (str(self._folder / "python"), *map(str, self._watched))
            self._reloaders[robot.name] = Reloader(robot.behavior.root, folders)

    def _watch(self) -> None:
        changes = iter_changes(self._watched, _SUFFIXES)
        # The first is no change.
        next(changes, None)
        for _change in changes:
            try:
                self._load_again()
            except OSError as error:
                print(f"vicode: {describe_os_error(error)}", file=sys.stderr)

    def _load_again(self) -> None:
        loaded = load_behaviors(self._args, self._folder)
        world = loaded if isinstance(loaded, int) else load_world(self._args.world or loaded.settings.world, loaded)
        if isinstance(loaded, int) or isinstance(world, int):
            print("vicode: not reloaded; the old code keeps running", file=sys.stderr)
            return
        self._loop.call_soon_threadsafe(self._exchange, loaded.catalog)

    def _exchange(self, catalog: BehaviorCatalog) -> None:
        """Exchange the code of all robots, between two ticks."""
        self._server.catalog = catalog
        for robot in self._server.all_robots:
            robot.catalog = catalog
            for line in self._reload(robot):
                self._server.on_event(robot.name, line)

    def _reload(self, robot: Robot) -> list[str]:
        if isinstance(robot.behavior, DesignBehavior):
            return self._reloaders[robot.name].reload()
        if robot.behavior is None:
            return []
        try:
            self._server.start_behavior(robot, robot.behavior_name)
        except BehaviorError as error:
            return [f"not reloaded: {error}; the old code keeps running"]
        return []
