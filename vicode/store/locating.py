"""Gives findings about things their places in files."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from vicode.findings import Finding, Note, Place, Thing, sort_findings
from vicode.store.projects import OpenProject
from vicode.store.sources import SourceMap


def locate(findings: Iterable[Finding], project: OpenProject) -> tuple[Finding, ...]:
    """The findings in the order of their places; a finding or note that has a place keeps it."""
    return sort_findings(_located(finding, project.sources) for finding in findings)


def place_of(thing: Thing, sources: Mapping[str, SourceMap]) -> Place | None:
    """The place of a thing, or of the nearest thing around it; None when no file is known for it."""
    source = sources.get(thing.component)
    return source.place(thing.path, thing.span, of_key=thing.of_key) if source else None


def faulty_components(errors: Iterable[Finding], project: OpenProject) -> frozenset[str]:
    """Components that nothing can be made of with these errors; mistakes in project.yaml concern all of them."""
    guilty = set(owners_of(errors, project))
    return frozenset(project.files) if "" in guilty else frozenset(guilty)


def owners_of(findings: Iterable[Finding], project: OpenProject) -> Iterator[str]:
    """Of each finding the component whose file it is in: "(broken)" for one that cannot be read, "" for the rest."""
    broken = {path.resolve() for path in project.broken}
    owners = {path.resolve(): name for name, path in project.files.items()}
    for each in findings:
        if each.place is None:
            yield each.thing.component if each.thing else ""
        else:
            file = Path(each.place.file).resolve()
            yield "(broken)" if file in broken else owners.get(file, "")


def _located(finding: Finding, sources: Mapping[str, SourceMap]) -> Finding:
    notes = tuple(_located_note(note, sources) for note in finding.notes)
    place = finding.place or (place_of(finding.thing, sources) if finding.thing else None)
    return replace(finding, place=place, notes=notes)


def _located_note(note: Note, sources: Mapping[str, SourceMap]) -> Note:
    if note.place is not None or note.thing is None:
        return note
    return replace(note, place=place_of(note.thing, sources))
