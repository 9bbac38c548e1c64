"""Calls the git program: finds repositories, and reads revisions without changing anything.

A repository may come from anywhere, and its configuration can name programs: filters, text conversions, commands for
remote objects, hooks, signatures. A list of these keys would be outdated with the next version of git. Therefore, git
reads contents with a git folder of our own: links to the entries of the real one, without its configuration and hooks.
It gets the few settings of `_SETTINGS` that change how contents are read.
"""

import os
import re
import shutil
import subprocess
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp

# For the calls that need the real git folder: they find the repository, and read and write its configuration and HEAD.
_OPTIONS = ("-c", "core.fsmonitor=false", "-c", "core.hooksPath=/dev/null", "--no-pager", "--literal-pathspecs")
_PRIVATE_OPTIONS = ("-c", "core.quotePath=false", "-c", "diff.autoRefreshIndex=false", *_OPTIONS)
_ENVIRONMENT = {
    "LC_ALL": "C",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_TERMINAL_PROMPT": "0",
    # Missing objects are not fetched, over no protocol.
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_ALLOW_PROTOCOL": "none",
}
_PRIVATE_ENVIRONMENT = {"GIT_CONFIG_NOSYSTEM": "1", "GIT_CONFIG_GLOBAL": os.devnull, "GIT_ATTR_NOSYSTEM": "1"}
# Hooks get the index and the objects of an unfinished commit in these variables.
_KEPT_VARIABLES = (*("GIT_INDEX_FILE", "GIT_OBJECT_DIRECTORY", "GIT_ALTERNATE_OBJECT_DIRECTORIES", "GIT_EXEC_PATH"),)
_SETTINGS = (
    *("core.autocrlf", "core.checkstat", "core.eol", "core.excludesfile", "core.filemode", "core.ignorecase"),
    *("core.precomposeunicode", "core.sharedrepository", "core.sparsecheckout", "core.sparsecheckoutcone"),
    *("core.symlinks", "core.trustctime", "commit.gpgsign", "gpg.format", "i18n.commitencoding", "user.signingkey"),
)
# Programs of the user's own configuration sign commits.
_USER_SETTINGS = "gpg."
_USER_SCOPES = ("system", "global", "command")
_EXTENSION = re.compile(r"extensions\.(?P<key>objectformat|refstorage)=(?P<value>\w+)")
_NOT_LINKED = ("HEAD", "commondir", "config", "config.worktree", "gitdir", "hooks")
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
    """A work tree. Revisions are passed as full hashes (see `resolve`).

    Attributes:
        root: The top folder of the work tree.
        git_folder: The git folder of this work tree.
        common_folder: The git folder that all work trees share; it contains the configuration.
    """

    root: Path
    git_folder: Path
    common_folder: Path

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
        """The content of a file; None if the revision does not have it.

        Raises:
            GitError: The content is missing, as in a partial clone.
        """
        content = self._try("cat-file", "blob", f"{revision}:{path}")
        if content is None and path in self.list_blobs(revision, [path]):
            command = f"git show {revision[:12]}:{path}"
            raise GitError(f"the content of {path} was not fetched to this repository; fetch it with: {command}")
        return content

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
            if name and head.split()[1] == b"blob" and _is_inside(os.fsdecode(name)):
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
        done = self._call(["config", "--local", "--get", name])
        return None if done.returncode else done.stdout.decode().strip()

    def set_config(self, name: str, value: str | None) -> None:
        """Set a value of the configuration of this repository; None removes it."""
        if value is not None:
            _checked(self._call(["config", "--local", name, value]))
        elif self.config(name) is not None:
            _checked(self._call(["config", "--local", "--unset-all", name]))

    def git_path(self, name: str) -> Path:
        """A path in the git folder; that of `hooks` can be set by the configuration."""
        plain = _call_git(["rev-parse", "--git-path", name], self._environment)
        return self.root / os.fsdecode(plain.stdout.rstrip(b"\n"))

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
        signed = self._try("config", "--get", "--type=bool", "commit.gpgSign") or b""
        sign = ("-S",) if signed.strip() == b"true" else ()
        links = [part for parent in self.parents(head) for part in ("-p", parent)]
        command = ["commit-tree", *sign, self.write_tree(), *links, "-F", "-"]
        new = self._run(*command, content=message, environment=author).decode().strip()
        _checked(self._call(["update-ref", "-m", "merge: generated files", "HEAD", new, head]))

    def _run(self, *arguments: str, content: bytes = b"", environment: Mapping[str, str] | None = None) -> bytes:
        return _checked(self._call_privately(arguments, content, environment or {}))

    def _try(self, *arguments: str) -> bytes | None:
        done = self._call_privately(arguments, b"", {})
        return None if done.returncode else done.stdout

    def _call(self, arguments: Sequence[str]) -> "subprocess.CompletedProcess[bytes]":
        """Call git with the git folder of the repository, for commands that read no contents."""
        return _call_git([*_OPTIONS, "-C", str(self.root), *arguments], self._environment)

    def _call_privately(
        self, arguments: Sequence[str], content: bytes, environment: Mapping[str, str]
    ) -> "subprocess.CompletedProcess[bytes]":
        """Call git with a git folder that has the contents of the repository, but not its configuration."""
        kept = {name: os.environ[name] for name in _KEPT_VARIABLES if name in os.environ}
        variables = {"GIT_INDEX_FILE": str(self.git_folder / "index"), **kept, **_PRIVATE_ENVIRONMENT, **environment}
        variables["GIT_WORK_TREE"] = str(self.root)
        settings = [part for setting in self._settings for part in ("-c", setting)]
        variables["GIT_DIR"] = str(self._update_private_folder())
        command = [*settings, *_PRIVATE_OPTIONS, "-C", str(self.root), *arguments]
        return _call_git(command, variables, content=content, is_private=True)

    @cached_property
    def _private_folder(self) -> Path:
        folder = Path(mkdtemp(prefix="vicode-git-"))
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        (folder / "config").write_text(self._format, encoding="utf-8")
        return folder

    def _update_private_folder(self) -> Path:
        """Link entries that are new, and copy HEAD: git accepts no link in its place."""
        _link(self._private_folder, list(dict.fromkeys((self.common_folder, self.git_folder))))
        head, copy = (self.git_folder / "HEAD").read_bytes(), self._private_folder / "HEAD"
        if not copy.exists() or copy.read_bytes() != head:
            copy.write_bytes(head)
        return self._private_folder

    @property
    def _environment(self) -> dict[str, str]:
        return {"GIT_DIR": str(self.git_folder), "GIT_WORK_TREE": str(self.root)}

    @cached_property
    def _configuration(self) -> tuple[tuple[str, str], ...]:
        """The scope of each setting, and the setting as `name=value`, or `name` for true."""
        output = _checked(self._call(["config", "--list", "--null", "--show-scope"])).decode(errors="replace")
        parts = output.split("\0")
        return tuple(
            (scope, setting.replace("\n", "=", 1)) for scope, setting in zip(parts[:-1:2], parts[1::2], strict=True)
        )

    @cached_property
    def _settings(self) -> tuple[str, ...]:
        named = [(scope, setting.partition("=")[0], setting) for scope, setting in self._configuration]
        return tuple(
            setting
            for scope, name, setting in named
            if name in _SETTINGS or (scope in _USER_SCOPES and name.startswith(_USER_SETTINGS))
        )

    @cached_property
    def _format(self) -> str:
        """The configuration that tells git how the repository is stored."""
        found = [_EXTENSION.fullmatch(setting) for _scope, setting in self._configuration]
        extensions = [f"{match['key']} = {match['value']}\n" for match in found if match is not None]
        return "".join(("[core]\nbare = false\nrepositoryFormatVersion = 1\n[extensions]\n", *extensions))


def find_repository(path: Path) -> Repository:
    """The repository that contains a file or folder.

    Raises:
        GitError: There is none, or git is not installed.
    """
    folder = path if path.is_dir() else path.parent
    while not folder.is_dir():
        folder = folder.parent
    root, git_folder, common_folder = (
        Path(os.path.realpath(folder / _find(folder, option)))
        for option in ("--show-toplevel", "--absolute-git-dir", "--git-common-dir")
    )
    # The configuration of a repository can name any folder as its work tree.
    if not Path(os.path.realpath(folder)).is_relative_to(root):
        raise GitError(f"{folder} is not in a git repository")
    return Repository(root, git_folder, common_folder)


def _find(folder: Path, option: str) -> str:
    done = _call_git([*_OPTIONS, "-C", str(folder), "rev-parse", option], {})
    if done.returncode:
        reason = _first_line(done.stderr)
        is_outside = "not a git repository" in reason
        raise GitError(f"{folder} is not in a git repository" if is_outside else reason)
    return os.fsdecode(done.stdout.rstrip(b"\n"))


def merge_lines(ours: Path, base: Path, theirs: Path) -> tuple[bytes, bool]:
    """Merge files by lines, with markers around conflicts; returns the text and whether there are conflicts.

    Raises:
        GitError: A file is binary or cannot be read.
    """
    labels = ("-L", "ours", "-L", "base", "-L", "theirs")
    done = _call_git([*_OPTIONS, "merge-file", "-p", "-q", *labels, str(ours), str(base), str(theirs)], {})
    if done.returncode > _MAX_CONFLICTS:
        raise GitError(_first_line(done.stderr) or "git merge-file failed")
    return done.stdout, done.returncode > 0


def _call_git(
    arguments: Sequence[str], variables: Mapping[str, str], *, content: bytes = b"", is_private: bool = False
) -> "subprocess.CompletedProcess[bytes]":
    given = {name: value for name, value in os.environ.items() if not (is_private and name.startswith("GIT_"))}
    environment = {**given, **_ENVIRONMENT, **variables}
    try:
        return subprocess.run(["git", *arguments], capture_output=True, input=content, env=environment, check=False)
    except FileNotFoundError:
        raise GitError("the program git is not installed") from None


def _checked(done: "subprocess.CompletedProcess[bytes]") -> bytes:
    if done.returncode:
        raise GitError(_first_line(done.stderr) or "git failed")
    return done.stdout


def _link(target: Path, folders: Sequence[Path]) -> None:
    """Link the entries of folders that have no link yet.

    Folders of the same name are merged; of other entries, the last one counts.
    """
    for name in {entry.name for folder in folders for entry in folder.iterdir()}.difference(_NOT_LINKED):
        found = [folder / name for folder in folders if os.path.lexists(folder / name)]
        if (target / name).is_symlink():
            continue
        if len(found) > 1 and all(map(Path.is_dir, found)):
            (target / name).mkdir(exist_ok=True)
            _link(target / name, found)
        else:
            (target / name).symlink_to(found[-1])


def _is_inside(path: str) -> bool:
    """Whether a path of a tree stays below the root; git checks that only when it writes files."""
    return not path.startswith("/") and ".." not in path.split("/")


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
