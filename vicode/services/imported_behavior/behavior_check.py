"""What is proved and found about an XABSL behavior, by the rules for designs: it is imported in memory."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from vicode.check.behavior import check_behavior
from vicode.findings import DesignPath, Finding, FindingSubject, SourceLocation, sort_findings
from vicode.importers import import_behavior
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.source_loader import ProgramSource

_CODES = frozenset({"D423", "D433", "D434", "D435", "D436", "D437", "D443", "P214", "P215"})
"""The rules that XABSL files do not have themselves."""


def find_in_behavior(source: ProgramSource, compiled: CompileResult) -> tuple[Finding, ...]:
    """The findings of the rules for designs, located in the XABSL files; none if the behavior has errors."""
    if compiled.program is None:
        return ()
    imported = import_behavior(source, compiled, "behavior")
    found = check_behavior(imported.project, are_names_xabsl=True)
    places = {
        made.component: {path: source.files[made.file].tokens.location(token) for token, path in reversed(made.anchors)}
        for made in imported.designs
    }
    return sort_findings(locate_finding(each, places) for each in found if each.rule.code in _CODES or _is_proved(each))


def _is_proved(finding: Finding) -> bool:
    """Whether no transition to or from a state can be taken; a state without any is reported as X643."""
    return finding.rule.code in ("D421", "D422") and "can be taken" in finding.message


def locate_finding(finding: Finding, places: Mapping[str, Mapping[DesignPath, SourceLocation]]) -> Finding:
    """A finding with its places in the sources of an import, by component."""
    notes = tuple(
        replace(note, location=_find_place(note.subject, places)) if note.subject else note for note in finding.notes
    )
    location = _find_place(finding.subject, places) if finding.subject else None
    return replace(finding, location=location, notes=notes)


def _find_place(
    subject: FindingSubject, places: Mapping[str, Mapping[DesignPath, SourceLocation]]
) -> SourceLocation | None:
    """The place of a part of a design, or of the nearest part around it."""
    known = places.get(subject.component, {})
    return next((known[path] for path in _prefixes(subject.path) if path in known), next(iter(known.values()), None))


def _prefixes(path: DesignPath) -> Iterator[DesignPath]:
    return (path[:length] for length in range(len(path), 0, -1))
