"""A process that has loaded all that an editor needs, and splits off an editor when asked to.

Loading takes most of a start, and there is an editor for almost every test. One line of JSON is read for each:
{"arguments", "environment", "log"}; its process is told as one line.
"""

import json
import os
import pkgutil
import signal
import sys
import threading
from importlib import import_module
from pathlib import Path
from typing import Any

# What an editor imports when it starts and with its first page.
LATE = (
    "uvicorn.lifespan.on",
    "uvicorn.loops.auto",
    "uvicorn.protocols.http.auto",
    "uvicorn.protocols.websockets.auto",
)


def main() -> None:
    """Load, then split off editors until nobody asks any more."""
    for name in LATE:
        import_module(name)
    package = import_module("vicode.editor")
    for module in pkgutil.walk_packages(package.__path__, "vicode.editor."):
        import_module(module.name)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    for line in sys.stdin:
        # A thread would not come along.
        assert threading.active_count() == 1
        process = os.fork()
        if process == 0:
            become_editor(json.loads(line))
        sys.stdout.write(f"{process}\n")
        sys.stdout.flush()


def become_editor(order: dict[str, Any]) -> None:
    """Do what the command line would do, in this process."""
    from nicegui import app

    from vicode.cli import main as run

    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    log = os.open(order["log"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    nothing = os.open(os.devnull, os.O_RDONLY)
    for old, new in ((nothing, 0), (log, 1), (log, 2)):
        os.dup2(old, new)
    os.environ.clear()
    os.environ.update(order["environment"])
    app.storage.path = Path(os.environ["NICEGUI_STORAGE_PATH"]).resolve()
    try:
        run(order["arguments"])
    finally:
        sys.stdout.flush()
        os._exit(1)


if __name__ == "__main__":
    main()
