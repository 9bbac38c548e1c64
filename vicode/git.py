"""Calls the git program: finds repositories, and reads revisions without changing anything."""

import os
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

# A repository may come from anywhere: its configuration must not start programs.
_SAFE_OPTIONS = (
    *("-c", "core.fsmonitor=false", "-c", "core.hooksPath=/dev/null", "-c", "log.showSignature=false"),
    *("-c", "core.quotePath=false", "--no-pager", "--literal-pathspecs"),
)
_REVISION_LENGTH = 40
_MAX_CONFLICTS = 127


class GitError(OSError):
    """git could not do it; the message is one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Commit:
    """A commit; `date` is that of the author in ISO 8601, `path` the path of the file in it, if one was asked for."""

    revision: str
    date: str
    author: str
    subject: str
    path: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedFile:
    """The paths of a file in two revisions, relative to the root; None where it does not exist."""

    old: str | None
    new: str | None


@dataclass(frozen=True)
class Repository:
    """A work tree. Revisions are passed as full hashes (see `resolve`)."""

    root: Path

    def resolve(self, revision: str) -> str:
        """The full hash of a revision such as HEAD~3 or a tag.

        Raises:
            GitError: There is no such revision.
        """
        found = self._try("rev-parse", "--quiet", "--verify", "--end-of-options", f"{revision}^{{commit}}")
        if found is None:
            raise GitError(f"unknown revision '{revision}'; 'git log' lists revisions")
        return found.decode().strip()

    def has_revision(self, revision: str) -> bool:
        return self._try("rev-parse", "--quiet", "--verify", "--end-of-options", f"{revision}^{{commit}}") is not None

    @cached_property
    def head(self) -> str | None:
        """The hash of the current commit; None before the first one."""
        return self.resolve("HEAD") if self.has_revision("HEAD") else None

    def merge_base(self, first: str, second: str) -> str:
        return self._run("merge-base", first, second).decode().strip()

    def relative(self, path: Path) -> str:
        """The path from the root, with slashes; "." for the root.

        Raises:
            GitError: The path is outside of the repository.
        """
        resolved = Path(os.path.realpath(path))
        if not resolved.is_relative_to(self.root):
            raise GitError(f"{path} is outside of the repository {self.root}")
        return resolved.relative_to(self.root).as_posix()

    def read(self, revision: str, path: str) -> bytes | None:
        """The content of a file; None if the revision does not have it."""
        return self._try("cat-file", "blob", f"{revision}:{path}")

    def find_content(self, path: str, content: bytes, *, limit: int) -> tuple[str, ...]:
        """The revisions of all branches that added or removed a content of a file, newest first."""
        blob = self._run("hash-object", "--stdin", "--no-filters", content=content).decode().strip()
        found = self._run("log", "--all", "--format=%H", f"--find-object={blob}", f"--max-count={limit}", "--", path)
        return tuple(found.decode().split())

    def list_changed(self, old: str, new: str | None, paths: Sequence[str] = ()) -> tuple[ChangedFile, ...]:
        """The files that differ between two revisions, or a revision and the work tree (None)."""
        options = ("--name-status", "-z", "-M", "--no-ext-diff", "--no-textconv", "--ignore-submodules=all")
        revisions = (old,) if new is None else (old, new)
        return _parse_name_status(self._run("diff", *options, *revisions, "--", *paths))

    def list_blobs(self, revision: str, paths: Sequence[str] = ()) -> dict[str, str]:
        """The hash of the content of each file of a revision, by path."""
        blobs: dict[str, str] = {}
        for entry in self._run("ls-tree", "-r", "-z", "--full-tree", revision, "--", *paths).split(b"\0"):
            head, _tab, name = entry.partition(b"\t")
            if name:
                blobs[os.fsdecode(name)] = head.split()[2].decode()
        return blobs

    def list_tracked(self, paths: Sequence[str]) -> tuple[str, ...]:
        """The tracked files at or below some paths."""
        return tuple(os.fsdecode(name) for name in self._run("ls-files", "-z", "--", *paths).split(b"\0") if name)

    def list_staged(self) -> tuple[str, ...]:
        """The files whose staged content differs from HEAD."""
        output = self._run("diff", "--cached", "--name-only", "-z", "--no-ext-diff")
        return tuple(os.fsdecode(name) for name in output.split(b"\0") if name)

    def is_modified(self, paths: Sequence[str]) -> bool:
        """Whether files differ from HEAD or are not tracked."""
        return bool(self._run("status", "--porcelain", "--ignore-submodules=all", "--", *paths).strip())

    def log(self, paths: Sequence[str], *, limit: int | None = None, all_branches: bool = False) -> tuple[Commit, ...]:
        """The commits that changed files, newest first."""
        start = ("--all" if all_branches else "HEAD", *(() if limit is None else (f"--max-count={limit}",)))
        return _parse_log(self._run("log", "--format=%x1e%H%x1f%aI%x1f%an%x1f%s%x1f", *start, "--", *paths))

    def log_file(self, path: str, *, limit: int) -> tuple[Commit, ...]:
        """The commits that changed a file, newest first, also those before it was renamed."""
        options = ("--format=%x1e%H%x1f%aI%x1f%an%x1f%s%x1f", "--name-only", "-z", "--follow", "--no-ext-diff")
        return _parse_log(self._run("log", *options, f"--max-count={limit}", "HEAD", "--", path))

    def config(self, name: str) -> str | None:
        """A value of the configuration; None if it is not set."""
        value = self._try("config", "--local", "--get", name)
        return None if value is None else value.decode().strip()

    def set_config(self, name: str, value: str | None) -> None:
        """Set a value of the configuration of this repository; None removes it."""
        if value is not None:
            self._run("config", "--local", name, value)
        elif self.config(name) is not None:
            self._run("config", "--local", "--unset-all", name)

    def git_path(self, name: str) -> Path:
        """A path in the git folder; that of `hooks` can be set by the configuration."""
        plain = _call_git(["-C", str(self.root), "rev-parse", "--git-path", name])
        return self.root / plain.stdout.decode().strip()

    def write_tree(self) -> str:
        """The hash of what is staged."""
        return self._run("write-tree").decode().strip()

    def stage(self, paths: Sequence[str]) -> None:
        self._run("add", "--all", "--", *paths)

    def parents(self, revision: str) -> tuple[str, ...]:
        return tuple(self._run("show", "--no-patch", "--format=%P", revision).decode().split())

    def replace_tree_of_head(self) -> None:
        """Add what is staged to the current commit, without hooks, and also before git has ended its merge."""
        head = self.resolve("HEAD")
        names = ("AUTHOR_NAME", "AUTHOR_EMAIL", "AUTHOR_DATE", "COMMITTER_NAME", "COMMITTER_EMAIL", "COMMITTER_DATE")
        values = self._run("show", "--no-patch", "--format=%an%n%ae%n%ad%n%cn%n%ce%n%cd", "--date=raw", head)
        author = {f"GIT_{name}": value for name, value in zip(names, values.decode().splitlines(), strict=True)}
        message = self._run("show", "--no-patch", "--format=%B", head).rstrip(b"\n") + b"\n"
        sign = (
            ("-S",) if (self._try("config", "--get", "--type=bool", "commit.gpgSign") or b"").strip() == b"true" else ()
        )
        links = [part for parent in self.parents(head) for part in ("-p", parent)]
        command = [*_SAFE_OPTIONS, "-C", str(self.root), "commit-tree", *sign, self.write_tree(), *links, "-F", "-"]
        done = _call_git(command, content=message, environment=author)
        if done.returncode:
            raise GitError(_first_line(done.stderr) or "git commit-tree failed")
        self._run("update-ref", "-m", "merge: generated files", "HEAD", done.stdout.decode().strip(), head)

    def _run(self, *arguments: str, content: bytes = b"") -> bytes:
        done = _call_git([*_SAFE_OPTIONS, "-C", str(self.root), *arguments], content=content)
        if done.returncode:
            raise GitError(_first_line(done.stderr) or f"git {arguments[0]} failed")
        return done.stdout

    def _try(self, *arguments: str) -> bytes | None:
        done = _call_git([*_SAFE_OPTIONS, "-C", str(self.root), *arguments])
        return None if done.returncode else done.stdout


def find_repository(path: Path) -> Repository:
    """The repository that contains a file or folder.

    Raises:
        GitError: There is none, or git is not installed.
    """
    folder = path if path.is_dir() else path.parent
    while not folder.is_dir():
        folder = folder.parent
    done = _call_git([*_SAFE_OPTIONS, "-C", str(folder), "rev-parse", "--show-toplevel"])
    if done.returncode:
        reason = _first_line(done.stderr)
        is_outside = "not a git repository" in reason
        raise GitError(f"{folder} is not in a git repository" if is_outside else reason)
    return Repository(Path(os.path.realpath(os.fsdecode(done.stdout.rstrip(b"\n")))))


def merge_lines(ours: Path, base: Path, theirs: Path) -> tuple[bytes, bool]:
    """Merge files by lines, with markers around conflicts; returns the text and whether there are conflicts.

    Raises:
        GitError: A file is binary or cannot be read.
    """
    labels = ("-L", "ours", "-L", "base", "-L", "theirs")
    done = _call_git(["merge-file", "-p", "-q", *labels, str(ours), str(base), str(theirs)])
    if done.returncode > _MAX_CONFLICTS:
        raise GitError(_first_line(done.stderr) or "git merge-file failed")
    return done.stdout, done.returncode > 0


def _call_git(
    arguments: Sequence[str], *, content: bytes = b"", environment: Mapping[str, str] | None = None
) -> "subprocess.CompletedProcess[bytes]":
    variables = {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0", "GIT_TERMINAL_PROMPT": "0", **(environment or {})}
    command = ["git", *arguments]
    try:
        return subprocess.run(command, capture_output=True, input=content, env={**os.environ, **variables}, check=False)
    except FileNotFoundError:
        raise GitError("the program git is not installed") from None


def _first_line(output: bytes) -> str:
    lines = output.decode(errors="replace").strip().splitlines()
    return lines[0].removeprefix("fatal: ").removeprefix("error: ") if lines else ""


def _parse_name_status(output: bytes) -> tuple[ChangedFile, ...]:
    parts = [os.fsdecode(part) for part in output.split(b"\0")]
    changed: list[ChangedFile] = []
    index = 0
    while index < len(parts) and parts[index]:
        status = parts[index][0]
        count = 2 if status in "RC" else 1
        names = parts[index + 1 : index + 1 + count]
        index += 1 + count
        old = None if status == "A" else names[0]
        new = None if status == "D" else names[-1]
        changed.append(ChangedFile(old=old, new=new))
    return tuple(changed)


def _parse_log(output: bytes) -> tuple[Commit, ...]:
    commits: list[Commit] = []
    for record in output.decode(errors="replace").split("\x1e"):
        fields = record.split("\x1f")
        if len(fields[0]) == _REVISION_LENGTH:
            revision, date, author, subject, rest = fields[:5]
            commits.append(
                Commit(revision=revision, date=date, author=author, subject=subject, path=rest.strip("\0\n"))
            )
    return tuple(commits)
