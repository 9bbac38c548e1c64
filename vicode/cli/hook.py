"""Set up git for designs: merge and diff drivers, and checks before a commit."""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from vicode.git import Repository, find_repository
from vicode.services.git_hooks import HOOKS, complete_merge, set_up_git, stage_generated_files
from vicode.services.tracked_projects import TrackedProject, find_tracked_projects


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "action",
        choices=("install", *HOOKS),
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
    """Generate from the merged designs, and stage the result; `post-merge` adds it to the commit."""
    from vicode.cli.entry_point import main

    tracked = [project for project in projects if project.is_generated_tracked]
    if not tracked:
        return 0
    merged = repository.write_tree()
    code = main(["gen", "--", *(project.folder for project in tracked)])
    stage_generated_files(repository, tracked, merged)
    if code:
        print("vicode: the merge is not committed; correct what is reported above, then 'git commit'", file=sys.stderr)
    return code


def _complete_merge(repository: Repository) -> int:
    count = complete_merge(repository)
    if count is not None:
        print(f"vicode: added {count} generated file{'s' * (count != 1)} to the merge commit")
    return 0


def _install(repository: Repository, *, is_removed: bool) -> int:
    steps = []
    for step in set_up_git(repository, is_removed=is_removed):
        steps.append(step)
        print(f"vicode: {step.text}" if step.has_failed else step.text, file=sys.stderr if step.has_failed else None)
    return int(any(step.has_failed for step in steps))
