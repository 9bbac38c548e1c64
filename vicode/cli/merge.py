"""Merge two versions of a design by state and transition; a merge driver for git."""

import argparse
import sys
from pathlib import Path

from vicode.git import GitError, find_repository, merge_lines
from vicode.output import write_atomically
from vicode.services.tracked_projects import find_tracked_projects

_MAX_REVISIONS = 4


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("base", metavar="BASE", help="the common ancestor; an empty file if there is none")
    parser.add_argument("ours", metavar="OURS", help="our version; the result is written to it")
    parser.add_argument("theirs", metavar="THEIRS", help="their version")
    parser.add_argument("--path", metavar="P", help="the path of the file in messages (default: OURS)")
    parser.add_argument(
        "--generated",
        action="store_true",
        help="the file is generated: on a conflict between versions without edits keep OURS; 'vicode gen' generates it",
    )
    parser.epilog = "Exit codes: 0 merged, 1 conflicts are marked in OURS, 2 the command could not run."


def run(args: argparse.Namespace) -> int:
    """Merge and write the result; return 1 if there are conflicts."""
    files = [Path(each) for each in (args.base, args.ours, args.theirs)]
    path = args.path or args.ours
    base, ours, theirs = (file.read_bytes() for file in files)
    merged = None if args.generated else _merge_designs(path, base, ours, theirs)
    if merged is not None:
        content, conflicts = merged
    else:
        content, has_conflicts = merge_lines(files[1], files[0], files[2])
        if args.generated and has_conflicts and all(_is_generated(path, side) for side in (ours, theirs)):
            print(f"vicode: {path}: kept ours; the hooks or 'vicode gen' generate it again", file=sys.stderr)
            return 0
        conflicts = ("lines",) if has_conflicts else ()
    if content != ours:
        write_atomically(files[1], content)
    for name in conflicts:
        print(f"vicode: {path}: conflict in {name}", file=sys.stderr)
    return int(bool(conflicts))


def _merge_designs(path: str, base: bytes, ours: bytes, theirs: bytes) -> tuple[bytes, tuple[str, ...]] | None:
    """The merged content and its conflicts; None if a version is no sound design."""
    from vicode.store import is_project_text, looks_like_design, merge_file_texts

    if not looks_like_design(ours) or not looks_like_design(theirs):
        return None
    try:
        texts = [content.decode("utf-8") for content in (base, ours, theirs)]
    except UnicodeDecodeError:
        return None
    merged = merge_file_texts(*texts, is_project_file=is_project_text(path, ours))
    return None if merged is None else (merged.text.encode(), merged.conflicts)


def _is_generated(path: str, content: bytes) -> bool:
    """Whether a version of a generated file is what the designs of its revision generate, and nothing else."""
    from vicode.regions import find_regions, get_comment_prefix, has_header, is_edited
    from vicode.sync import generate_revision, is_same_code

    try:
        text = content.decode("utf-8")
        repository = find_repository(Path.cwd())
    except (UnicodeDecodeError, GitError):
        return False
    comment = get_comment_prefix(path)
    parsed = find_regions(text, comment)
    if not has_header(text) or parsed.findings or any(map(is_edited, parsed.regions)):
        return False
    for project in find_tracked_projects(repository):
        name = path.removeprefix(f"{project.generated}/")
        if project.generated and (name != path or project.generated == "."):
            revisions = repository.find_content(path, content, limit=_MAX_REVISIONS)
            generated = (generate_revision(repository, each, project.folder).get(name) for each in revisions)
            return any(each is not None and is_same_code(text, each, comment) for each in generated)
    return False
