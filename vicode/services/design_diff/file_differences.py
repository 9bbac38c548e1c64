"""The differences of one file in words and as JSON."""

from dataclasses import asdict, dataclass

from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.diff import (
    Change,
    changed_lines,
    describe_change,
    describe_changes,
    diff_designs,
    diff_projects,
    diff_unread,
)
from vicode.model.project import Project
from vicode.services.design_diff.file_pairs import FileVersion, VersionPair
from vicode.store import UnreadMember, is_project_text, list_unread, read_design, read_project_file

_SAME_MEANING = "  only comments or the form of the file differ"


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignVersion:
    """A version of a design or of project.yaml; both are None if it cannot be read.

    `unread` is what was not understood, such as misspelled keys.
    """

    file: FileVersion
    design: Design | None = None
    project: Project | None = None
    findings: tuple[Finding, ...] = ()
    unread: tuple[UnreadMember, ...] = ()

    @property
    def is_readable(self) -> bool:
        return self.design is not None or self.project is not None

    @property
    def title(self) -> str:
        if self.design is None:
            return "project.yaml"
        count = len(self.design.states)
        return f"design {self.design.component}: {count} state{'s' * (count != 1)}"


@dataclass(frozen=True, slots=True, kw_only=True)
class FileDifference:
    """The differences of one file."""

    name: str
    old: DesignVersion | None
    new: DesignVersion | None
    changes: tuple[Change, ...] = ()

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings of versions that cannot be read."""
        versions = (version for version in (self.old, self.new) if version is not None and not version.is_readable)
        return tuple(finding for version in versions for finding in version.findings)

    @property
    def status(self) -> str:
        if self.old is None or self.new is None:
            return "added" if self.old is None else "removed"
        return "changed" if self.old.file.name == self.new.file.name else "renamed"

    @property
    def is_different(self) -> bool:
        return self.old is None or self.new is None or bool(self.changes)

    def lines(self) -> list[str]:
        """The differences in words, after the name of the file."""
        if self.errors:
            return []
        if self.old is None or self.new is None:
            version, sign = (self.new, "+") if self.new is not None else (self.old, "-")
            assert version is not None
            return [f"{self.name}:", f"  {sign} {version.title}"]
        is_renamed = self.old.file.name != self.new.file.name
        head = f"{self.old.file.name} → {self.new.file.name}:" if is_renamed else f"{self.name}:"
        is_copy = self.old.file.content == self.new.file.content
        lines = [f"  {line}" for line in describe_changes(self.changes)]
        return [head, *(lines or ([] if is_copy else [_SAME_MEANING]))]

    def to_json(self) -> dict[str, object]:
        return {
            "path": self.name,
            "old_path": None if self.old is None else self.old.file.name,
            "status": self.status,
            "readable": not self.errors,
            "changes": [_change_to_json(change) for change in self.changes],
        }


def _change_to_json(change: Change) -> dict[str, object]:
    return {**asdict(change), "text": describe_change(change), "lines": changed_lines(change)}


def compare_pair(pair: VersionPair) -> FileDifference:
    """Compare the versions of a file.

    Raises:
        OSError: One version is a design, the other a project.yaml.
    """
    old, new = _read(pair.old), _read(pair.new)
    changes: tuple[Change, ...] = ()
    if old is not None and new is not None:
        if old.design is not None and new.design is not None:
            changes = diff_designs(old.design, new.design)
        elif old.project is not None and new.project is not None:
            changes = diff_projects(old.project, new.project)
        elif old.is_readable and new.is_readable:
            raise OSError(f"{new.file.name}: a design cannot be compared with a project.yaml")
        changes += diff_unread(old.unread, new.unread)
    return FileDifference(name=pair.name, old=old, new=new, changes=changes)


def _read(version: FileVersion | None) -> DesignVersion | None:
    if version is None:
        return None
    if is_project_text(version.name, version.content):
        project = read_project_file(version.content, version.name)
        unread = list_unread(project.source_map)
        return DesignVersion(file=version, project=project.project, findings=project.findings, unread=unread)
    design = read_design(version.content, version.name)
    unread = list_unread(design.source_map)
    return DesignVersion(file=version, design=design.design, findings=design.findings, unread=unread)
