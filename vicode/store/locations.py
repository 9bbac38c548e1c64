"""Adds file locations to findings."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from vicode.findings import Finding, FindingSubject, Note, SourceLocation, sort_findings
from vicode.store.projects import OpenProject
from vicode.store.source_map import SourceMap


def locate_findings(findings: Iterable[Finding], project: OpenProject) -> tuple[Finding, ...]:
    """Add locations to findings and notes that have none, and sort the findings by location."""
    return sort_findings(_located(finding, project.sources) for finding in findings)


def find_location(subject: FindingSubject, sources: Mapping[str, SourceMap]) -> SourceLocation | None:
    """The location of a subject or of its nearest existing ancestor; None if its component has no file."""
    source = sources.get(subject.component)
    return source.locate(subject.path, subject.span, of_key=subject.is_key) if source else None


def find_faulty_components(errors: Iterable[Finding], project: OpenProject) -> frozenset[str]:
    """Components that cannot be generated because of these errors; an error in project.yaml affects all components."""
    faulty = set(iter_owning_components(errors, project))
    return frozenset(project.files) if "" in faulty else frozenset(faulty)


def iter_owning_components(findings: Iterable[Finding], project: OpenProject) -> Iterator[str]:
    """The component of each finding: "(broken)" for an unreadable file, "" for a file that belongs to no component."""
    broken = {path.resolve() for path in project.broken_files}
    owners = {path.resolve(): name for name, path in project.files.items()}
    for finding in findings:
        if finding.location is None:
            yield finding.subject.component if finding.subject else ""
        else:
            file = Path(finding.location.file).resolve()
            yield "(broken)" if file in broken else owners.get(file, "")


def _located(finding: Finding, sources: Mapping[str, SourceMap]) -> Finding:
    notes = tuple(_located_note(note, sources) for note in finding.notes)
    location = finding.location or (find_location(finding.subject, sources) if finding.subject else None)
    return replace(finding, location=location, notes=notes)


def _located_note(note: Note, sources: Mapping[str, SourceMap]) -> Note:
    if note.location is not None or note.subject is None:
        return note
    return replace(note, location=find_location(note.subject, sources))
