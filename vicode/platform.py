"""What operating systems do differently: locks of files, folders of the user, sessions of processes, signals."""

import _thread
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from filelock import BaseFileLock

CACHE_VARIABLE = "VICODE_CACHE"
STATE_VARIABLE = "VICODE_STATE"


def take_lock(file: Path, timeout_s: float = 0.0) -> "BaseFileLock | None":
    """Lock a file that exists only for this, until `release()` or the end of the program; it is created.

    Args:
        file: The file.
        timeout_s: How long to wait for another program that has locked it; negative: without end.

    Returns:
        The lock; None if another program still has it.

    Raises:
        OSError: The file cannot be opened, or its file system has no locks.
    """
    from filelock import FileLock, Timeout

    lock = FileLock(file, timeout=timeout_s, mode=0o600, thread_local=False)
    try:
        lock.acquire(poll_interval=0.002)
    except Timeout:
        return None
    return lock


def state_folder() -> Path:
    """The folder of persistent state: VICODE_STATE, else `vicode` in the user's state folder."""
    from platformdirs import user_state_path

    given = os.environ.get(STATE_VARIABLE)
    return Path(given) if given else user_state_path("vicode", appauthor=False)


def cache_folder() -> Path:
    """The folder of what can be made again: VICODE_CACHE, else `vicode` in the user's cache folder."""
    from platformdirs import user_cache_path

    given = os.environ.get(CACHE_VARIABLE)
    return Path(given) if given else user_cache_path("vicode", appauthor=False)


def user_id() -> str:
    """The number of the user, to tell apart the temporary files of users; "" where each has a temporary folder."""
    return f"-{os.getuid()}" if hasattr(os, "getuid") else ""


def limit_resource(name: str, most: int | None = None) -> None:
    """Set a limit of this process, soft and hard; nothing happens where the system has no such limit.

    Args:
        name: Its name in the module `resource`, such as "RLIMIT_DATA".
        most: The limit, reduced to the hard limit; None: the hard limit.
    """
    # Windows has no such module; macOS refuses "unlimited", which it reports.
    with suppress(ImportError, AttributeError, ValueError, OSError):
        import resource

        system: Any = resource
        hard = system.getrlimit(getattr(system, name))[1]
        if most is not None and (hard == system.RLIM_INFINITY or most < hard):
            hard = most
        system.setrlimit(getattr(system, name), (hard, hard))


def flush_folder(folder: Path) -> None:
    """Make the names of files in a folder durable; Windows cannot open folders and does it by itself."""
    if hasattr(os, "O_DIRECTORY"):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def session_options() -> dict[str, Any]:
    """Arguments for starting a process to which the terminal sends no signals."""
    if hasattr(subprocess, "CREATE_NEW_PROCESS_GROUP"):
        return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
    return {"start_new_session": True}


def kill_session(process_id: int) -> None:
    """Kill a process that was started with `session_options`, and what it started."""
    import psutil

    with suppress(psutil.Error):
        leader = psutil.Process(process_id)
        for each in (*leader.children(recursive=True), leader):
            with suppress(psutil.Error):
                each.kill()
    if hasattr(os, "killpg") and hasattr(signal, "SIGKILL"):
        # Also processes whose parent has ended.
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process_id, signal.SIGKILL)


def is_running(process_id: int) -> bool:
    """Whether a process exists; another one may have got its number meanwhile."""
    import psutil

    return psutil.pid_exists(process_id)


def end_signals() -> Iterator[int]:
    """The signals that end a program, without those that it was told to ignore, as by nohup."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK"):
        number = getattr(signal, name, None)
        if number is not None and (number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN):
            yield number


def send_end_signal(process: "subprocess.Popen[str]", number: int) -> None:
    """Forward a signal that ends programs to one that was started with `session_options`."""
    process.send_signal(getattr(signal, "CTRL_BREAK_EVENT", number))


def interrupt_main_thread() -> None:
    """Raise KeyboardInterrupt in the main thread, on Windows not before it has read what it waits for."""
    if sys.platform == "win32":
        _thread.interrupt_main()
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
