"""Set up git for designs: merge and diff drivers, and checks before a commit."""

import argparse
import os
import shlex
import stat
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from vicode.git import GitError, Repository, find_repository
from vicode.output import resolve_below, write_atomically
from vicode.services.tracked_projects import TrackedProject, find_tracked_projects

_BEGIN, _END = "# vicode hook install: begin", "# vicode hook install: end"
_STAGED = "vicode-generated"
"""The file in the git folder with the commit before a merge, and the tree with the generated files."""
_HOOKS = ("pre-commit", "pre-merge-commit", "post-merge")
_SHELLS = ("sh", "bash", "dash", "ash", "zsh", "ksh")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "action",
        choices=("install", *_HOOKS),
        help="install: set up the repository; the others are what the hooks of git call",
    )
    parser.add_argument(
        "path", metavar="PATH", nargs="?", default=".", help="a folder of the repository (default: the current folder)"
    )
    parser.add_argument("--uninstall", action="store_true", help="with install: remove what it set up")


def run(args: argparse.Namespace) -> int:
    """Install the hooks, or run one; return 1 if a hook could not be installed or found errors."""
    repository = find_repository(Path(args.path))
    if "GIT_DIR" in os.environ:
        # In additional work trees, git sets it for hooks; git would take any folder below for the work tree then.
        os.environ["GIT_WORK_TREE"] = str(repository.root)
    if args.action == "install":
        return _install(repository, is_removed=args.uninstall)
    if args.action == "post-merge":
        return _complete_merge(repository)
    projects = [
        project for project in find_tracked_projects(repository) if project.has_changed(repository.list_staged())
    ]
    if not projects:
        return 0
    return _check(projects) if args.action == "pre-commit" else _regenerate(repository, projects)


def _check(projects: Sequence[TrackedProject]) -> int:
    """Check the designs and what is generated from them, as in the work tree."""
    from vicode.cli.entry_point import main

    folders = [project.folder for project in projects]
    tracked = [project.folder for project in projects if project.is_generated_tracked]
    codes = [main(["check", "--", *folders])]
    codes += [main(["gen", "--check", "--", *tracked])] if tracked else []
    if any(codes):
        print("vicode: commit refused; 'git commit --no-verify' skips this check", file=sys.stderr)
    return max(codes)


def _regenerate(repository: Repository, projects: Sequence[TrackedProject]) -> int:
    """Generate from the merged designs, and stage the result; `_complete_merge` adds it to the commit."""
    from vicode.cli.entry_point import main

    tracked = [project for project in projects if project.is_generated_tracked]
    if not tracked:
        return 0
    merged = repository.write_tree()
    code = main(["gen", "--", *(project.folder for project in tracked)])
    repository.stage(sorted({project.generated for project in tracked}))
    tree = repository.write_tree()
    if tree != merged:
        write_atomically(repository.git_path(_STAGED), f"{repository.head}\n{tree}\n")
    if code:
        print("vicode: the merge is not committed; correct what is reported above, then 'git commit'", file=sys.stderr)
    return code


def _complete_merge(repository: Repository) -> int:
    """Add the generated files that `_regenerate` staged to the commit of the merge, which git made without them."""
    record = repository.git_path(_STAGED)
    if not record.is_file():
        return 0
    head, tree = record.read_text(encoding="utf-8").split()
    record.unlink()
    parents, staged = repository.parents("HEAD"), repository.list_staged()
    # Otherwise, this is not the merge that staged them, or something else is staged, too.
    if len(parents) > 1 and parents[0] == head and repository.write_tree() == tree:
        repository.replace_tree_of_head()
        print(f"vicode: added {len(staged)} generated file{'s' * (len(staged) != 1)} to the merge commit")
    return 0


def _install(repository: Repository, *, is_removed: bool) -> int:
    attributes = [] if is_removed else _attribute_lines(find_tracked_projects(repository))
    if not is_removed and not attributes:
        raise GitError(f"no designs in {repository.root}")
    _update_block(resolve_below(repository.root, ".gitattributes"), attributes, insert=lambda text, block: text + block)
    for name, value in _config().items():
        if repository.config(name) != (None if is_removed else value):
            repository.set_config(name, None if is_removed else value)
            print(f"{'removed' if is_removed else 'set'} {name} in the configuration of the repository")
    folder = repository.git_path("hooks")
    return max([_install_hook(folder / name, repository, is_removed=is_removed) for name in _HOOKS])


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


def _install_hook(file: Path, repository: Repository, *, is_removed: bool) -> int:
    """Add our lines to a hook, after the first line of an existing script; return 1 if that is not possible."""
    lines = [] if is_removed else _hook_lines(file.name)
    if not _is_inside(file, repository):
        # The hooks of core.hooksPath may be those of all repositories of the user.
        return _report_outside(file, is_removed=is_removed)
    if file.exists() and not is_removed:
        reason = _why_unusable(file)
        if reason:
            print(f"vicode: {file} {reason}; call '{_command()} hook {file.name}' in it", file=sys.stderr)
            return 1
    _update_block(file, lines, insert=_insert_after_shebang)
    if file.exists() and file.read_text(encoding="utf-8").strip() in ("", "#!/bin/sh"):
        file.unlink()
    elif file.exists() and lines:
        file.chmod(file.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
    return 0


def _report_outside(file: Path, *, is_removed: bool) -> int:
    if is_removed and not (file.exists() and _BEGIN.encode() in file.read_bytes()):
        return 0
    action = "remove the lines of vicode from it" if is_removed else f"call '{_command()} hook {file.name}' in it"
    print(f"vicode: {file} is outside of the repository, so it was not changed; {action}", file=sys.stderr)
    return 1


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


def _update_block(file: Path, lines: Sequence[str], *, insert: Callable[[str, str], str]) -> None:
    """Replace our lines in a file, between comments that mark them, and say so."""
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
    print(f"{'wrote' if new else 'deleted'} {file}")
