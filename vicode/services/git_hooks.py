"""Sets up git for designs, and adds generated files to the commits of merges.

`vicode hook install` writes merge and diff drivers into the configuration of a repository, attributes that select
them, and lines into hooks, which call `vicode hook`.
"""

import os
import shlex
import stat
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from vicode.git import GitError, Repository
from vicode.output import resolve_below, write_atomically
from vicode.services.tracked_projects import TrackedProject, find_tracked_projects

HOOKS = ("pre-commit", "pre-merge-commit", "post-merge")
_BEGIN, _END = "# vicode hook install: begin", "# vicode hook install: end"
_STAGED = "vicode-generated"
"""The file in the git folder with the commit before a merge, and the tree with the generated files."""
_SHELLS = ("sh", "bash", "dash", "ash", "zsh", "ksh")


@dataclass(frozen=True, slots=True, kw_only=True)
class SetupStep:
    """What was changed in a repository, or why a hook could not be changed."""

    text: str
    has_failed: bool = False


def set_up_git(repository: Repository, *, is_removed: bool) -> Iterator[SetupStep]:
    """Install drivers and hooks, or remove them; nothing is reported if nothing changes.

    Raises:
        GitError: The repository has no designs.
        OSError: A file cannot be written.
    """
    attributes = [] if is_removed else _attribute_lines(find_tracked_projects(repository))
    if not is_removed and not attributes:
        raise GitError(f"no designs in {repository.root}")
    file = resolve_below(repository.root, ".gitattributes")
    yield from _update_block(file, attributes, insert=lambda text, block: text + block)
    for name, value in _config().items():
        if repository.config(name) != (None if is_removed else value):
            repository.set_config(name, None if is_removed else value)
            verb = "removed" if is_removed else "set"
            yield SetupStep(text=f"{verb} {name} in the configuration of the repository")
    folder = repository.git_path("hooks")
    for name in HOOKS:
        yield from _install_hook(folder / name, repository, is_removed=is_removed)


def stage_generated_files(repository: Repository, projects: Sequence[TrackedProject], merged: str) -> None:
    """Stage what was generated from merged designs; `complete_merge` adds it to the commit.

    Args:
        repository: The repository, in the hook `pre-merge-commit`.
        projects: The projects whose files were generated.
        merged: The tree of the merge before that.
    """
    repository.stage(sorted({project.generated for project in projects}))
    tree = repository.write_tree()
    if tree != merged:
        write_atomically(repository.git_path(_STAGED), f"{repository.head}\n{tree}\n")


def complete_merge(repository: Repository) -> int | None:
    """Add the files that `stage_generated_files` staged to the commit of the merge, which git made without them.

    Returns their number; None if there are none.
    """
    record = repository.git_path(_STAGED)
    if not record.is_file():
        return None
    head, tree = record.read_text(encoding="utf-8").split()
    record.unlink()
    parents, staged = repository.parents("HEAD"), repository.list_staged()
    # Otherwise, this is not the merge that staged them, or something else is staged, too.
    if len(parents) > 1 and parents[0] == head and repository.write_tree() == tree:
        repository.replace_tree_of_head()
        return len(staged)
    return None


def _is_inside(file: Path, repository: Repository) -> bool:
    """Whether a file is in the work tree, or in the git folder, which work trees share."""
    owners = (repository.root, repository.git_path("config").parent)
    return any(file.resolve().is_relative_to(owner.resolve()) for owner in owners)


def _attribute_lines(projects: Sequence[TrackedProject]) -> list[str]:
    designs = {project.folder: "merge=vicode diff=vicode" for project in projects}
    generated = {
        project.generated: "merge=vicode-generated" for project in projects if project.generated not in ("", ".")
    }
    return [
        *(f"{_pattern(folder, '**/*.y*ml')} {drivers}" for folder, drivers in designs.items()),
        *(f"{_pattern(folder, '**')} {driver}" for folder, driver in generated.items()),
    ]


def _pattern(folder: str, files: str) -> str:
    pattern = f"/{files}" if folder == "." else f"/{folder}/{files}"
    escaped = pattern.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"' if escaped != pattern or " " in pattern else pattern


def _config() -> dict[str, str]:
    """The drivers: commands that do not depend on the search path, which hooks may not have."""
    command = _command()
    return {
        "merge.vicode.name": "vicode: merge designs by state and transition",
        "merge.vicode.driver": f"{command} merge --path=%P -- %O %A %B",
        # A merge of several common ancestors takes one of them, instead of writing markers into it.
        "merge.vicode.recursive": "binary",
        "merge.vicode-generated.name": "vicode: keep our version of generated files",
        "merge.vicode-generated.driver": f"{command} merge --generated --path=%P -- %O %A %B",
        "merge.vicode-generated.recursive": "binary",
        "diff.vicode.command": f"{command} diff --external --",
    }


def _command() -> str:
    # -P: a folder vicode in the repository must not shadow the package.
    return f"{_python()} -P -m vicode"


def _python() -> str:
    return shlex.quote(Path(sys.executable).as_posix())


def _install_hook(file: Path, repository: Repository, *, is_removed: bool) -> Iterator[SetupStep]:
    """Add our lines to a hook, after the first line of an existing script."""
    lines = [] if is_removed else _hook_lines(file.name)
    if not _is_inside(file, repository):
        # The hooks of core.hooksPath may be those of all repositories of the user.
        yield from _report_outside(file, is_removed=is_removed)
        return
    reason = _why_unusable(file) if file.exists() and not is_removed else ""
    if reason:
        yield SetupStep(text=f"{file} {reason}; call '{_command()} hook {file.name}' in it", has_failed=True)
        return
    yield from _update_block(file, lines, insert=_insert_after_shebang)
    if file.exists() and file.read_text(encoding="utf-8").strip() in ("", "#!/bin/sh"):
        file.unlink()
    elif file.exists() and lines:
        file.chmod(file.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)


def _report_outside(file: Path, *, is_removed: bool) -> Iterator[SetupStep]:
    if is_removed and not (file.exists() and _BEGIN.encode() in file.read_bytes()):
        return
    action = "remove the lines of vicode from it" if is_removed else f"call '{_command()} hook {file.name}' in it"
    yield SetupStep(text=f"{file} is outside of the repository, so it was not changed; {action}", has_failed=True)


def _hook_lines(name: str) -> list[str]:
    """The lines of a hook. An environment that was removed must not stop every commit."""
    python = _python()
    missing = shlex.quote(f"vicode: {sys.executable} does not exist; run 'vicode hook install' again")
    return [
        f"if test -x {python}; then",
        f"  {_command()} hook {name} || exit $?",
        f"else echo {missing} >&2; fi",
    ]


def _why_unusable(file: Path) -> str:
    """Why lines cannot be added to a hook; empty if they can."""
    content = file.read_bytes()
    first = content.split(b"\n", 1)[0].decode(errors="replace")
    interpreter = (
        Path(first.removeprefix("#!").split()[-1]).name if first.startswith("#!") and first.strip("#! ") else ""
    )
    if interpreter not in _SHELLS:
        return "is no shell script"
    return "" if os.access(file, os.X_OK) else "is not executable, so git ignores it"


def _insert_after_shebang(text: str, block: str) -> str:
    first, _line_break, rest = (text or "#!/bin/sh\n").partition("\n")
    return f"{first}\n{block}{rest}"


def _update_block(file: Path, lines: Sequence[str], *, insert: Callable[[str, str], str]) -> Iterator[SetupStep]:
    """Replace our lines in a file, between comments that mark them."""
    old = file.read_text(encoding="utf-8") if file.exists() else ""
    before, begin, rest = old.partition(f"{_BEGIN}\n")
    block = "".join(f"{line}\n" for line in (_BEGIN, *lines, _END)) if lines else ""
    if begin:
        new = before + block + rest.partition(f"{_END}\n")[2]
    else:
        ended = old if not old or old.endswith("\n") else f"{old}\n"
        new = insert(ended, block) if lines else old
    if new == old:
        return
    if new:
        file.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(file, new)
    else:
        file.unlink()
    yield SetupStep(text=f"{'wrote' if new else 'deleted'} {file}")
