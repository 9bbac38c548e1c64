"""The console of `vicode attach`: prints the state changes of robots, and reads commands from standard input.

The main thread reads, so that line editing and Ctrl-C work as in any program; another one runs the connection.
"""

import asyncio
import contextlib
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from vicode.cli.attach import describe_changes, describe_connection
from vicode.findings import escape_text
from vicode.platform import interrupt_main_thread
from vicode.robots import AttachError, RobotAddress
from vicode.services.running_robots.console import ConsoleError, RobotConsole
from vicode.services.running_robots.robot_link import LinkStatus, RobotLink
from vicode.store import open_project

_PROMPT = "> "
_COLUMN = 32
_POLL_S = 0.02


def run_console(address: RobotAddress, token: str, path: Path) -> int:
    """Run commands until the input ends; 1 if a command of a script failed or the connection ended.

    Raises:
        AttachError: The robot cannot be attached to.
    """
    project, terminal = open_project(path).project, _Terminal()
    terminal.link.open(str(address), token)
    thread = threading.Thread(target=lambda: asyncio.run(terminal.stay_attached()), name="robots")
    thread.start()
    try:
        loop, link = terminal.attached.result(), terminal.link
        print(describe_connection(address, link.robots, control=link.control), file=sys.stderr, flush=True)
        console = RobotConsole(link, lambda: project, waits=not terminal.is_interactive)
        return terminal.run(lambda line: asyncio.run_coroutine_threadsafe(console.run(line), loop).result(), console)
    except KeyboardInterrupt:
        if not terminal.problem:
            raise
        print(f"vicode: {terminal.problem}", file=sys.stderr)
        return 1
    finally:
        terminal.is_over.set()
        thread.join()


class _Terminal:
    """Standard input and output: of a user, or of a script."""

    def __init__(self) -> None:
        self.link = RobotLink()
        self.attached: Future[asyncio.AbstractEventLoop] = Future()
        self.is_over = threading.Event()
        self.problem = ""
        """Why the connection ended."""
        self.is_interactive = sys.stdin.isatty()
        self._shown_prompt: Callable[[], str] | None = None
        """Returns the prompt and what is typed behind it; None while no command is read."""
        self._seen: set[str] = set()
        self._paused: set[str] = set()

    def run(self, run: Callable[[str], str], console: RobotConsole) -> int:
        """Run each line; a script ends at the first command that fails."""
        lines: Iterable[str] = self._read_lines(console.complete) if self.is_interactive else sys.stdin
        for number, line in enumerate(lines, start=1):
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            if line.strip() in ("exit", "quit"):
                return 0
            try:
                answer = run(line)
            except ConsoleError as error:
                if not self.is_interactive:
                    print(f"vicode: line {number}: {escape_text(str(error))}", file=sys.stderr)
                    return 1
                answer = str(error)
            print("\n".join(map(escape_text, answer.expandtabs(_COLUMN).splitlines())), flush=True)
        return 0

    async def stay_attached(self) -> None:
        """Print what arrives until the console is over; interrupt it when the connection ends."""
        link = self.link
        link.messages.subscribe(self._show_message)
        link.start()
        while not self.is_over.is_set() and link.status in (LinkStatus.CONNECTING, LinkStatus.CONNECTED):
            if link.status is LinkStatus.CONNECTED and not self.attached.done():
                self.attached.set_result(asyncio.get_running_loop())
            await asyncio.sleep(_POLL_S)
        self.problem = link.problem
        link.close()
        if not self.attached.done():
            self.attached.set_exception(AttachError(self.problem))
        elif not self.is_over.is_set():
            interrupt_main_thread()

    def _show_message(self, message: Mapping[str, Any]) -> None:
        robot, is_paused = str(message["robot"]), message.get("paused") is True
        lines = describe_changes(message, self._seen, is_alone=len(self.link.robots) == 1)
        if is_paused and robot not in self._paused:
            lines.append(f"{escape_text(robot)} is paused")
        self._paused = self._paused | {robot} if is_paused else self._paused - {robot}
        prompt = self._shown_prompt() if self._shown_prompt else ""
        for line in lines:
            print(f"\r\x1b[K{line}\n{prompt}" if prompt else f"{line}\n", end="", flush=True)

    def _read_lines(self, complete: Callable[[str], tuple[str, ...]]) -> Iterator[str]:
        """Lines of a terminal, with history and completion where Python has readline."""
        typed: Callable[[], str] = str
        if sys.platform != "win32":
            with contextlib.suppress(ImportError):
                import readline

                typed, bind = readline.get_line_buffer, "tab: complete"
                readline.set_completer_delims(" \t()")
                readline.set_completer(lambda _word, index: (*complete(typed()[: readline.get_endidx()]), None)[index])
                readline.parse_and_bind("bind ^I rl_complete" if "libedit" in (readline.__doc__ or "") else bind)
        with contextlib.suppress(EOFError):
            while True:
                self._shown_prompt = lambda: f"{_PROMPT}{typed()}"
                line = input(_PROMPT)
                self._shown_prompt = None
                yield line
        print()
