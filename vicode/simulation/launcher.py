"""Starts a program that ends with all its descendants, and where the system allows it, in a sandbox.

Run as a script with the standard library only: `python launcher.py CONFIG`, where CONFIG is a `LaunchConfig` as JSON.

In the sandbox, the program sees the given folders and no other files, has no network, and cannot see or signal other
processes. It consists of namespaces of Linux: user, mount, network, process, and IPC (`man 7 namespaces`), and a filter
of system calls (`man 2 seccomp`). Every mount is read-only except the temporary files: if the editor runs as root, the
program still owns root's files, also those in /proc/sys and /dev.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import json
import os
import resource
import signal
import struct
import sys
import time
from typing import TYPE_CHECKING, Any, TypedDict

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_PR_SET_PDEATHSIG, _PR_SET_SECCOMP, _PR_SET_CHILD_SUBREAPER, _PR_SET_NO_NEW_PRIVS = 1, 22, 36, 38
_SECCOMP_MODE_FILTER = 2
_CLONE_NEWNS, _CLONE_NEWUSER = 0x00020000, 0x10000000
# Mount, IPC, user, process and network namespaces.
_NAMESPACES = _CLONE_NEWNS | 0x08000000 | 0x10000000 | 0x20000000 | 0x40000000
_MS_RDONLY, _MS_NOSUID, _MS_NODEV, _MS_REMOUNT, _MS_BIND, _MS_REC, _MS_PRIVATE = 1, 2, 4, 32, 4096, 16384, 1 << 18
_MNT_DETACH = 2
# Flags of a mount that a user namespace must keep, as `statvfs` and `mount` name them.
_KEPT_FLAGS = {2: 2, 4: 4, 8: 8, 1024: 1024, 2048: 2048, 4096: 1 << 21}
# A flag of /proc/PID/stat.
_PF_EXITING = 4
_PIVOT_ROOT = {"x86_64": 155, "aarch64": 41}
_SYSTEM_PATHS = (
    *("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/opt"),
    *("/etc/ld.so.cache", "/etc/localtime", "/etc/alternatives"),
)
# Not zero: a shared mapping of it is memory that no limit counts.
_DEVICES = ("null", "full", "random", "urandom")
_VARIABLES = (
    *("PATH", "HOME", "TMPDIR", "LANG", "LANGUAGE", "TZ", "TERM", "VIRTUAL_ENV", "LD_LIBRARY_PATH"),
    *("CC", "CXX", "CPATH", "CPLUS_INCLUDE_PATH", "LIBRARY_PATH", "CCACHE_DISABLE", "OMP_NUM_THREADS"),
)
_VARIABLE_PREFIXES = ("LC_", "PYTHON")
# Numbers of system calls on x86_64 and aarch64 (`asm/unistd.h`).
_ARCHITECTURES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
_FORBIDDEN_CALLS = (
    *((319, 279), (447, 447), (29, 194)),  # memory that no limit counts: memfd_create, memfd_secret, shmget
    *((272, 97), (308, 268)),  # namespaces: unshare, setns
    *((248, 217), (249, 218), (250, 219)),  # keys of the user: add_key, request_key, keyctl
    *((425, 425), (321, 280), (323, 282), (298, 241)),  # io_uring_setup, bpf, userfaultfd, perf_event_open
)
_CLONE, _CLONE3, _MMAP = (56, 220), (435, 435), (9, 222)
_MAP_SHARED, _MAP_ANONYMOUS = 1, 32
_FIRST_X32_CALL = 0x40000000
_INNER_ID = 1000
_MAX_PROCESSES, _MAX_FILES, _MAX_FILE_BYTES = 64, 256, 64 << 20


class LaunchConfig(TypedDict):
    """What to start; `readable` and `writable` are paths that the sandbox contains, `root` an empty folder for it.

    The launcher removes the folder `temporary` when it is terminated, also by the end of the editor.
    """

    command: list[str]
    is_isolated: bool
    readable: list[str]
    writable: list[str]
    root: str
    temporary: str


assert sys.platform == "linux"


def main() -> int:
    """Start the program and return its exit code after all its descendants have ended."""
    config: LaunchConfig = json.loads(sys.argv[1])
    libc = _Libc()
    editor = os.getppid()
    libc.check(libc.prctl(_PR_SET_CHILD_SUBREAPER, 1))
    folder = os.getcwd()
    if config["is_isolated"]:
        _enter_namespaces(libc)
    child = os.fork()
    if child == 0:
        libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if config["is_isolated"]:
            # The launcher keeps its own root.
            libc.check(libc.unshare(_CLONE_NEWNS))
            _enter_root(libc, config, folder)
            _run_first_process(libc, config["command"])
        os.execv(config["command"][0], config["command"])
    signal.signal(signal.SIGTERM, lambda *_: _end(config, 128 + signal.SIGTERM))
    signal.signal(signal.SIGABRT, lambda *_: os.kill(child, signal.SIGABRT))
    libc.check(libc.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM))
    if os.getppid() != editor:
        _end(config, 1)
    for descriptor in (0, 1):
        # Only the program may hold the pipes, so that their ends are seen.
        os.dup2(os.open(os.devnull, os.O_RDWR), descriptor)
    status = _wait_for(child)
    # After an orderly end the files are not needed.
    if status == 0 or _has_ended(editor):
        _end(config, 0 if status == 0 else 1)
    _kill_descendants()
    return _exit_like(status)


class _Libc:
    """Calls of the C library that Python lacks."""

    def __init__(self) -> None:
        library: Any = ctypes.CDLL(None, use_errno=True)
        self.prctl, self.unshare, self.syscall = library.prctl, library.unshare, library.syscall
        self._mount, self._umount = library.mount, library.umount2
        self._mount.argtypes = (ctypes.c_char_p,) * 3 + (ctypes.c_ulong, ctypes.c_char_p)

    def check(self, result: int) -> None:
        if result != 0:
            number = ctypes.get_errno()
            raise OSError(number, os.strerror(number))

    def mount(self, source: str, target: str, kind: str = "", flags: int = 0, options: str = "") -> None:
        self.check(self._mount(source.encode(), target.encode(), kind.encode(), flags, options.encode()))

    def filter_calls(self) -> None:
        """Refuse some system calls of this process and its children; needs PR_SET_NO_NEW_PRIVS."""
        lines = ctypes.create_string_buffer(_call_filter())
        program = ctypes.create_string_buffer(struct.pack("@HP", (len(lines) - 1) // 8, ctypes.addressof(lines)))
        self.check(self.prctl(_PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.c_void_p(ctypes.addressof(program)), 0, 0))

    def unmount(self, target: str) -> None:
        self.check(self._umount(target.encode(), _MNT_DETACH))


def _enter_namespaces(libc: _Libc) -> None:
    user, group = os.getuid(), os.getgid()
    libc.check(libc.unshare(_NAMESPACES))
    for name, text in (
        ("setgroups", "deny"),
        # Not 0: then the program has no capabilities.
        ("uid_map", f"{_INNER_ID} {user} 1"),
        ("gid_map", f"{_INNER_ID} {group} 1"),
    ):
        with open(f"/proc/self/{name}", "w", encoding="ascii") as file:
            file.write(text)


def _enter_root(libc: _Libc, config: LaunchConfig, folder: str) -> None:
    """Make the given folders the only files."""
    root = config["root"]
    libc.mount("none", "/", flags=_MS_REC | _MS_PRIVATE)
    libc.mount("tmpfs", root, "tmpfs", _MS_NOSUID | _MS_NODEV, "size=64m,nr_inodes=64k,mode=755")
    bound: list[str] = []
    for path in sorted({*_SYSTEM_PATHS, *config["readable"]}, key=len):
        if os.path.islink(path) and path in _SYSTEM_PATHS:
            os.makedirs(os.path.dirname(root + path), exist_ok=True)
            os.symlink(os.readlink(path), root + path)
        elif os.path.exists(path) and not _is_below(path, bound):
            _bind(libc, path, root + path)
            bound.append(path)
    for name in ("/tmp", "/dev/shm", "/proc", "/old"):  # noqa: S108 - in the new root
        os.makedirs(root + name, exist_ok=True)
    for device in _DEVICES:
        with open(f"{root}/dev/{device}", "w", encoding="ascii"):
            libc.mount(f"/dev/{device}", f"{root}/dev/{device}", flags=_MS_BIND)
    with contextlib.suppress(OSError):
        # Some containers hide parts of /proc; the program does without.
        libc.mount("proc", f"{root}/proc", "proc", _MS_NOSUID | _MS_NODEV)
    for target in _mounts_below(root):
        _make_read_only(libc, target)
    for path in config["writable"]:
        _bind(libc, path, root + path)
    libc.check(libc.syscall(_PIVOT_ROOT[os.uname().machine], root.encode(), f"{root}/old".encode()))
    os.chdir("/")
    libc.unmount("/old")
    os.rmdir("/old")
    os.chdir(folder)
    libc.check(libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))


def _bind(libc: _Libc, source: str, target: str) -> None:
    os.makedirs(target if os.path.isdir(source) else os.path.dirname(target), exist_ok=True)
    if not os.path.isdir(source):
        open(target, "w", encoding="ascii").close()
    libc.mount(source, target, flags=_MS_BIND | _MS_REC)


def _mounts_below(root: str) -> list[str]:
    """The mounts in a folder, also those that came with a mounted folder."""
    with open("/proc/self/mountinfo", "rb") as file:
        escaped = [line.split(b" ")[4] for line in file]
    points = [os.fsdecode(point.decode("unicode_escape").encode("latin-1")) for point in escaped]
    return [point for point in points if point.startswith(f"{root}/")]


def _make_read_only(libc: _Libc, target: str) -> None:
    try:
        given = os.statvfs(target).f_flag
    except (PermissionError, FileNotFoundError):
        # The program cannot reach it either.
        return
    kept = sum(flag for bit, flag in _KEPT_FLAGS.items() if given & bit)
    libc.mount("none", target, flags=_MS_REMOUNT | _MS_BIND | _MS_RDONLY | kept)


def _is_below(path: str, folders: Iterable[str]) -> bool:
    return any(path == folder or path.startswith(f"{folder.rstrip('/')}/") for folder in folders)


def _run_first_process(libc: _Libc, command: list[str]) -> None:
    """Be the first process of the namespace, which the kernel treats specially; the program is the second."""
    child = os.fork()
    if child == 0:
        for limit, most in (
            (resource.RLIMIT_NPROC, _MAX_PROCESSES),
            (resource.RLIMIT_NOFILE, _MAX_FILES),
            (resource.RLIMIT_FSIZE, _MAX_FILE_BYTES),
        ):
            resource.setrlimit(limit, (most, most))
        libc.filter_calls()
        os.execve(command[0], command, _environment())
    signal.signal(signal.SIGABRT, lambda *_: os.kill(child, signal.SIGABRT))
    for descriptor in (0, 1):
        os.dup2(os.open(os.devnull, os.O_RDWR), descriptor)
    status = _wait_for(child)
    # A signal cannot end this process as it ended the program: tell the launcher its number.
    os._exit(os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else 128 + os.WTERMSIG(status))


def _environment() -> dict[str, str]:
    """The variables that the program sees: others may be passwords."""
    kept = {
        name: value for name, value in os.environ.items() if name in _VARIABLES or name.startswith(_VARIABLE_PREFIXES)
    }
    return kept if os.path.isdir(kept.get("TMPDIR", "")) else {**kept, "TMPDIR": "/tmp"}  # noqa: S108 - in the sandbox


def _call_filter() -> bytes:
    """The filter of system calls as instructions of BPF (`linux/filter.h`, `linux/seccomp.h`)."""
    load, equal, at_least, mask, answer = 0x20, 0x15, 0x35, 0x54, 0x06
    allow, refuse = 0x7FFF0000, 0x00050000
    machine = os.uname().machine
    index = list(_ARCHITECTURES).index(machine)

    def refuse_if(argument: int, bits: int, call: tuple[int, int], error: int) -> list[tuple[int, int, int, int]]:
        start = 16 + 8 * argument
        return [
            *((equal, 0, 4, call[index]), (load, 0, 0, start), (mask, 0, 0, bits), (equal, 0, 1, bits)),
            *((answer, 0, 0, refuse | error), (load, 0, 0, 0)),
        ]

    lines = [(load, 0, 0, 4), (equal, 1, 0, _ARCHITECTURES[machine]), (answer, 0, 0, refuse | errno.EPERM)]
    lines += [(load, 0, 0, 0), (at_least, 0, 1, _FIRST_X32_CALL), (answer, 0, 0, refuse | errno.EPERM)]
    for call in _FORBIDDEN_CALLS:
        lines += [(equal, 0, 1, call[index]), (answer, 0, 0, refuse | errno.EPERM)]
    # The flags of clone3 are in memory; the C library uses clone instead.
    lines += [(equal, 0, 1, _CLONE3[index]), (answer, 0, 0, refuse | errno.ENOSYS)]
    lines += refuse_if(0, _CLONE_NEWUSER, _CLONE, errno.EPERM)
    lines += refuse_if(3, _MAP_SHARED | _MAP_ANONYMOUS, _MMAP, errno.ENOMEM)
    return b"".join(struct.pack("=HBBI", *line) for line in [*lines, (answer, 0, 0, allow)])


def _wait_for(child: int) -> int:
    while True:
        ended, status = os.waitpid(-1, 0)
        if ended == child:
            return status


def _has_ended(parent: int) -> bool:
    """Whether the parent has ended or is about to.

    The kernel closes the files of a process before its children get another parent: the program may read the end of a
    pipe and fail while `getppid` still names the parent. Its flags tell earlier.
    """
    try:
        with open(f"/proc/{parent}/stat", encoding="utf-8", errors="replace") as file:
            flags = int(file.read().rpartition(")")[2].split()[6])
    except OSError:
        return True
    return os.getppid() != parent or bool(flags & _PF_EXITING)


def _end(config: LaunchConfig, code: int) -> None:
    """End everything; the editor, which would remove the files, may be gone.

    A second signal must not interrupt this: it can arrive while a module is being imported.
    """
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    import shutil

    _kill_descendants()
    shutil.rmtree(config["temporary"], ignore_errors=True)
    os._exit(code)


def _kill_descendants() -> None:
    """Kill until no process is left: the children of a killed process become children of this one."""
    while True:
        for child in _iter_descendants(os.getpid()):
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(child, signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            return
        time.sleep(0.001)


def _iter_descendants(parent: int) -> Iterator[int]:
    children: dict[int, list[int]] = {}
    for name in os.listdir("/proc"):
        if name.isdigit():
            with contextlib.suppress(OSError), open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                children.setdefault(int(file.read().rpartition(")")[2].split()[1]), []).append(int(name))
    waiting = [parent]
    while waiting:
        found = children.get(waiting.pop(), [])
        yield from found
        waiting += found


def _exit_like(status: int) -> int:
    """The exit code of the program; if a signal ended it, the same signal ends this process."""
    code = os.waitstatus_to_exitcode(status)
    number = -code if code < 0 else code - 128
    if number in {int(each) for each in signal.Signals} and (code < 0 or number in _FATAL):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if number not in (signal.SIGKILL, signal.SIGSTOP):
            signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    return code


_FATAL = (signal.SIGABRT, signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGKILL, signal.SIGXFSZ)

if __name__ == "__main__":
    sys.exit(main())
