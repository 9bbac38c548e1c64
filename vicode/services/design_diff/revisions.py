"""The revisions of a design in git, and how the design differs from one."""

from dataclasses import dataclass
from pathlib import Path

from vicode.diagram.diff_diagram import css_variable_diff, render_diff
from vicode.diagram.svg import write_svg
from vicode.git import Commit, find_repository
from vicode.model.design import Design
from vicode.model.diff import describe_changes, diff_designs, diff_unread
from vicode.store import list_unread, read_design

MAX_REVISIONS = 200


@dataclass(frozen=True, slots=True, kw_only=True)
class RevisionComparison:
    """The changes since a revision in words and as SVG, or why they are not known."""

    lines: tuple[str, ...] = ()
    picture: str = ""
    error: str = ""


def list_revisions(file: Path) -> tuple[Commit, ...]:
    """The latest commits that changed a file, newest first.

    Raises:
        GitError: The file is in no repository, or git is not installed.
    """
    repository = find_repository(file)
    if repository.head is None:
        return ()
    return repository.log_file(repository.relative(file), limit=MAX_REVISIONS)


def compare_with_revision(file: Path, commit: Commit, design: Design) -> RevisionComparison:
    """The changes from a revision of a file to a design.

    Raises:
        GitError: The repository cannot be read.
    """
    content = find_repository(file).read(commit.revision, commit.path)
    before = None if content is None else read_design(content, commit.path)
    if before is None or before.design is None:
        return RevisionComparison(error="The design cannot be read in this revision")
    old = before.design
    now = read_design(file.read_bytes(), file.name) if file.exists() else before
    changes = (*diff_designs(old, design), *diff_unread(list_unread(before.source_map), list_unread(now.source_map)))
    picture = write_svg(render_diff(old, design, css_variable_diff()), is_embedded=True) if changes else ""
    return RevisionComparison(lines=describe_changes(changes), picture=picture)
