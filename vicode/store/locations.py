"""Gives findings about things their places in files."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from vicode.findings import Finding, FindingSubject, Note, SourceLocation, sort_findings
from vicode.store.projects import OpenProject
from vicode.store.source_map import SourceMap


def locate_findings(findings: Iterable[Finding], project: OpenProject) -> tuple[Finding, ...]:
    """The findings in the order of their places; a finding or note that has a place keeps it."""
    return sort_findings(_located(finding, project.sources) for finding in findings)


def find_location(thing: FindingSubject, sources: Mapping[str, SourceMap]) -> SourceLocation | None:
    """The place of a thing, or of the nearest thing around it; None when no file is known for it."""
    source = sources.get(thing.component)
    return source.locate(thing.path, thing.span, of_key=thing.is_key) if source else None


def find_faulty_components(errors: Iterable[Finding], project: OpenProject) -> frozenset[str]:
    """Components that nothing can be made of with these errors; mistakes in project.yaml concern all of them."""
    guilty = set(iter_owning_components(errors, project))
    return frozenset(project.files) if "" in guilty else frozenset(guilty)


def iter_owning_components(findings: Iterable[Finding], project: OpenProject) -> Iterator[str]:
    """Of each finding the component whose file it is in: "(broken)" for one that cannot be read, "" for the rest."""
    broken = {path.resolve() for path in project.broken_files}
    owners = {path.resolve(): name for name, path in project.files.items()}
    for each in findings:
        if each.location is None:
            yield each.subject.component if each.subject else ""
        else:
            file = Path(each.location.file).resolve()
            yield "(broken)" if file in broken else owners.get(file, "")


def _located(finding: Finding, sources: Mapping[str, SourceMap]) -> Finding:
    notes = tuple(_located_note(note, sources) for note in finding.notes)
    place = finding.location or (find_location(finding.subject, sources) if finding.subject else None)
    return replace(finding, location=place, notes=notes)


def _located_note(note: Note, sources: Mapping[str, SourceMap]) -> Note:
    if note.location is not None or note.subject is None:
        return note
    return replace(note, location=find_location(note.subject, sources))
