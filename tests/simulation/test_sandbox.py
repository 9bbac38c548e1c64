"""What the sandbox holds, also if the editor runs as root: each attempt is made by a program in it."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from vicode.simulation.isolation import isolation_problem, launch_command, make_temporary
from vicode.simulation.limits import limit_memory

BEGIN = """
import ctypes, json, mmap, multiprocessing, os, resource, subprocess, sys, threading
def error_of(act):
    try:
        act()
    except (OSError, MemoryError, ValueError) as error:
        return type(error).__name__ if not isinstance(error, OSError) else os.strerror(error.errno)
    return ""
libc = ctypes.CDLL(None, use_errno=True)
def call(name, *arguments):
    if getattr(libc, name)(*arguments) == -1:
        raise OSError(ctypes.get_errno(), "")
"""


def in_sandbox(code: str, folder: Path, *arguments: str, before: str = "", **variables: str) -> Any:
    """The object that a program in a sandbox prints as JSON; `before` runs outside of it, in a mount namespace."""
    assert not isolation_problem()
    temporary = make_temporary()
    program = [sys.executable, "-c", BEGIN + code, str(temporary / "files"), *arguments]
    command = launch_command(program, (str(folder),), temporary, is_isolated=True)
    if before:
        command = ["unshare", "--map-root-user", "--mount", "sh", "-c", f'{before} && exec "$@"', "sh", *command]
    environment = {**os.environ, **variables}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_mount_is_read_only_except_temporary_files(tmp_path: Path) -> None:
    code = """
lines = [line.split() for line in open("/proc/self/mountinfo")]
print(json.dumps([line[4] for line in lines if "ro" not in line[5].split(",") and line[4] not in ("/", sys.argv[1])]))
"""
    assert in_sandbox(code, tmp_path) == []


def test_a_mount_below_a_readable_folder_is_read_only(tmp_path: Path) -> None:
    below = tmp_path / "a folder" / "below"
    below.mkdir(parents=True)
    code = """
names = os.listdir(sys.argv[2])
print(json.dumps([names, error_of(lambda: open(os.path.join(sys.argv[2], "new"), "w"))]))
"""
    mount = f"mount -t tmpfs none '{below}' && touch '{below}/old'"
    assert in_sandbox(code, tmp_path, str(below), before=mount) == [["old"], "Read-only file system"]


def test_settings_of_the_kernel_and_devices_cannot_be_changed(tmp_path: Path) -> None:
    code = """
files = [os.path.join(folder, name) for folder, _, names in os.walk("/proc/sys") for name in names]
print(json.dumps({
    "files": len(files) > 100,
    "writable": [file for file in files if os.access(file, os.W_OK)],
    "own": error_of(lambda: open("/proc/self/oom_score_adj", "r+")),
    "device": error_of(lambda: os.chmod("/dev/null", 0o666)),
    "null": error_of(lambda: open("/dev/null", "w").write("x")),
}))
"""
    assert in_sandbox(code, tmp_path) == {
        "files": True,
        "writable": [],
        "own": "Read-only file system",
        "device": "Read-only file system",
        "null": "",
    }


def test_there_are_no_inner_namespaces(tmp_path: Path) -> None:
    code = """
print(json.dumps([
    error_of(lambda: call("unshare", 0x10000000)),
    error_of(lambda: call("unshare", 0x00020000)),
    error_of(lambda: call("syscall", 56 if os.uname().machine == "x86_64" else 220, 0x10000011, 0, 0, 0, 0)),
    error_of(lambda: call("syscall", 435, None, 0)),
    subprocess.run(["unshare", "--user", "true"], capture_output=True).returncode,
    error_of(lambda: call("mount", b"none", b"/tmp", b"tmpfs", 0, None)),
]))
"""
    refused = "Operation not permitted"
    assert in_sandbox(code, tmp_path) == [refused, refused, refused, "Function not implemented", 1, refused]


def test_memory_that_no_limit_counts_is_refused(tmp_path: Path) -> None:
    code = """
def fill(path):
    for number in range(80):
        with open(f"{path}{number}", "wb") as file:
            file.write(bytes(1 << 20))
print(json.dumps([
    error_of(lambda: mmap.mmap(-1, 4096)),
    error_of(lambda: os.memfd_create("x")),
    error_of(lambda: call("shmget", 0, 4096, 0o1600)),
    error_of(lambda: open("/dev/zero", "r+")),
    error_of(lambda: fill("/dev/shm/")),
    error_of(lambda: mmap.mmap(-1, 4096, flags=mmap.MAP_PRIVATE)),
]))
"""
    assert in_sandbox(code, tmp_path) == [
        "Cannot allocate memory",
        "Operation not permitted",
        "Operation not permitted",
        "No such file or directory",
        "No space left on device",
        "",
    ]


def test_keys_of_the_user_are_out_of_reach(tmp_path: Path) -> None:
    code = """
number = 250 if os.uname().machine == "x86_64" else 219
print(json.dumps(error_of(lambda: call("syscall", number, 0, -3, 0))))
"""
    assert in_sandbox(code, tmp_path) == "Operation not permitted"


def test_the_environment_is_not_visible(tmp_path: Path) -> None:
    code = """
texts = []
for name in filter(str.isdigit, os.listdir("/proc")):
    try:
        texts.append(open(f"/proc/{name}/environ").read())
    except OSError:
        pass
print(json.dumps([sorted(os.environ), any("s3cret" in text for text in texts)]))
"""
    names, is_visible = in_sandbox(
        code, tmp_path, SECRET="s3cret", VICODE_WATCH_TOKEN="s3cret", LC_TIME="C", PYTHONHASHSEED="0", TMPDIR="/nowhere"
    )
    assert not is_visible
    assert {"PATH", "LC_TIME", "PYTHONHASHSEED", "TMPDIR"} <= {*names}
    assert not [name for name in names if "TOKEN" in name or "SECRET" in name]


def test_programs_work(tmp_path: Path) -> None:
    code = """
import tempfile
with multiprocessing.get_context("fork").Pool(2) as pool:
    squares = pool.map(abs, [-1, -2])
shared = multiprocessing.Value("i", 7)
found = []
thread = threading.Thread(target=lambda: found.append(1))
thread.start()
thread.join()
echoed = subprocess.run(["sh", "-c", "echo $((40 + 2)) | cat"], capture_output=True, text=True).stdout
with tempfile.NamedTemporaryFile() as file:
    file.write(b"x")
print(json.dumps([squares, shared.value, found, echoed]))
"""
    assert in_sandbox(code, tmp_path) == [[1, 2], 7, [1], "42\n"]


def test_the_memory_limit_cannot_be_raised() -> None:
    size = 64 << 20
    code = f"""
import json, resource
from {limit_memory.__module__} import limit_memory
limit_memory({size})
def error_of(act):
    try:
        act()
    except (MemoryError, ValueError, OSError) as error:
        return type(error).__name__
def raise_limit():
    resource.setrlimit(resource.RLIMIT_DATA, (2 * {size}, resource.getrlimit(resource.RLIMIT_DATA)[1]))
print(json.dumps([error_of(raise_limit), error_of(lambda: bytearray(2 * {size}))]))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == ["ValueError", "MemoryError"]
