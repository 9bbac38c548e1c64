"""Hides from vicode what another system does not have; each interpreter with this folder on its path runs it first.

`VICODE_TEST_SYSTEM` is "windows" or "macos". Only modules of vicode see the difference: the standard library of Linux
needs the names.
"""

import builtins
import os
import sys
from types import ModuleType
from typing import Any

SYSTEM = os.environ.get("VICODE_TEST_SYSTEM", "")
_POSIX = {
    "os": (
        *(
            "fork",
            "killpg",
            "getuid",
            "geteuid",
            "getgid",
            "getegid",
            "getpgid",
            "setsid",
            "setpgid",
            "statvfs",
            "uname",
        ),
        *("mkfifo", "O_NOFOLLOW", "O_DIRECTORY", "O_NONBLOCK", "WIFEXITED", "WTERMSIG", "WNOHANG", "pipe2", "chown"),
        *("pread", "pwrite", "nice", "getpriority", "sched_getaffinity", "posix_spawn", "waitid", "wait3", "wait4"),
    ),
    "signal": (
        *("SIGHUP", "SIGKILL", "SIGALRM", "SIGSTOP", "SIGBUS", "SIGXFSZ", "SIGPIPE", "SIGQUIT", "SIGUSR1", "SIGCHLD"),
        *("setitimer", "ITIMER_REAL", "alarm", "pthread_sigmask", "SIG_BLOCK", "sigwait", "pause", "siginterrupt"),
    ),
    "socket": ("AF_UNIX",),
    "asyncio": ("open_unix_connection", "start_unix_server"),
}
_MISSING_MODULES = (
    "fcntl",
    "resource",
    "termios",
    "pty",
    "tty",
    "pwd",
    "grp",
    "curses",
    "readline",
    "syslog",
    "uvloop",
)
_LIBRARIES = ("pathlib", "os", "shutil", "contextlib", "tempfile")
_LINUX_CALLS = ("prctl", "unshare", "umount2", "malloc_trim")


class _Without(ModuleType):
    """A module without some names."""

    def __init__(self, module: ModuleType, hidden: frozenset[str]) -> None:
        super().__init__(module.__name__)
        self.__dict__["_of"], self.__dict__["_hidden"] = module, hidden

    def __getattr__(self, name: str) -> Any:
        if name in self._hidden:
            raise AttributeError(f"module '{self._of.__name__}' has no attribute '{name}' on {SYSTEM}")
        return getattr(self._of, name)

    def __setattr__(self, name: str, value: object) -> None:
        setattr(self._of, name, value)

    def __dir__(self) -> list[str]:
        return [name for name in dir(self._of) if name not in self._hidden]


class _LibraryWithout:
    """The C library without the calls of Linux."""

    def __init__(self, library: object) -> None:
        self._library = library

    def __getattr__(self, name: str) -> Any:
        if name in _LINUX_CALLS:
            raise AttributeError(f"dlsym({name}): symbol not found")
        return getattr(self._library, name)


def _hide() -> None:
    original, replaced = builtins.__import__, dict[str, ModuleType]()
    hidden = _POSIX if SYSTEM == "windows" else {"os": (), "ctypes": ("memfd_create",)}

    def replace(name: str) -> ModuleType:
        if name not in replaced:
            replaced[name] = _Without(sys.modules[name], frozenset(hidden[name]))
            if name == "os" and SYSTEM == "windows":
                replaced[name].__dict__["open"] = _open_file
            if name == "ctypes":
                load = sys.modules[name].CDLL
                replaced[name].__dict__["CDLL"] = lambda *values, **named: _LibraryWithout(load(*values, **named))
        return replaced[name]

    def import_(name: str, globals: Any = None, *rest: Any, **named: Any) -> ModuleType:  # noqa: A002 - its name
        user = str((globals or {}).get("__name__", ""))
        if not (user == "vicode" or user.startswith("vicode.")):
            return original(name, globals, *rest, **named)
        if SYSTEM == "windows" and name in _MISSING_MODULES:
            raise ModuleNotFoundError(f"No module named '{name}' on {SYSTEM}", name=name)
        module = original(name, globals, *rest, **named)
        return replace(name) if name in hidden and module is sys.modules.get(name) else module

    builtins.__import__ = import_


def _open_file(path: Any, flags: int, *rest: Any, **named: Any) -> int:
    if os.path.isdir(path):
        raise PermissionError(13, "Permission denied", os.fspath(path))
    return os.open(path, flags, *rest, **named)


def _refuse_open_files(event: str, arguments: tuple[Any, ...]) -> None:
    """Windows neither moves nor deletes files that a program has open."""
    if event not in ("os.rename", "os.remove") or not _is_called_by_vicode():
        return
    for path in arguments[: 2 if event == "os.rename" else 1]:
        if isinstance(path, str | bytes | os.PathLike) and _is_open(os.path.realpath(os.fsdecode(path))):
            raise PermissionError(13, "The process cannot access the file because it is being used", os.fsdecode(path))


def _is_open(path: str) -> bool:
    for number in os.listdir("/proc/self/fd"):
        try:
            if os.readlink(f"/proc/self/fd/{number}") == path:
                return True
        except OSError:
            pass
    return False


def _is_called_by_vicode() -> bool:
    frame = sys._getframe(2)
    while frame is not None and frame.f_globals.get("__name__") in (
        "pathlib",
        "os",
        "shutil",
        "contextlib",
        "tempfile",
    ):
        frame = frame.f_back
    return frame is not None and str(frame.f_globals.get("__name__")).startswith("vicode.")


if SYSTEM:
    _hide()
    if SYSTEM == "windows":
        sys.addaudithook(_refuse_open_files)
