"""Sorts, groups, filters and steps through the findings of a design."""

from collections.abc import Collection, Sequence
from itertools import groupby

from vicode.editor.view import ItemRef, item_at_path
from vicode.findings import Finding, Severity

FindingsOfSeverity = tuple[Severity, tuple[Finding, ...]]


def sort_findings(findings: Collection[Finding]) -> tuple[Finding, ...]:
    """Sort by severity, grouping the findings of one item, otherwise stable."""
    firsts: dict[tuple[Severity, ItemRef | None], int] = {}
    for index, finding in enumerate(findings):
        firsts.setdefault(_key(finding), index)
    ranks = list(Severity)
    return tuple(sorted(findings, key=lambda finding: (ranks.index(finding.severity), firsts[_key(finding)])))


def group_by_severity(findings: Collection[Finding]) -> tuple[FindingsOfSeverity, ...]:
    """The sorted findings by severity."""
    groups = groupby(sort_findings(findings), key=lambda finding: finding.severity)
    return tuple((severity, tuple(found)) for severity, found in groups)


def filter_findings(findings: Collection[Finding], text: str, hidden: Collection[Severity]) -> tuple[Finding, ...]:
    """The findings of visible severities that contain every word of `text` in message, fix, code or path."""
    words = text.casefold().split()
    return tuple(
        finding
        for finding in findings
        if finding.severity not in hidden and all(word in _searchable_text(finding) for word in words)
    )


def next_finding(findings: Sequence[Finding], current: Finding | None, step: int) -> Finding | None:
    """The finding `step` (1 or -1) after the current one, wrapping around; None if there are none."""
    listed = sort_findings(findings)
    if not listed:
        return None
    if current not in listed:
        return listed[0 if step > 0 else -1]
    return listed[(listed.index(current) + step) % len(listed)]


def _key(finding: Finding) -> tuple[Severity, ItemRef | None]:
    return (finding.severity, item_at_path(finding.subject.path) if finding.subject else None)


def _searchable_text(finding: Finding) -> str:
    path = finding.subject.path if finding.subject else ()
    parts = (finding.severity, finding.rule.code, finding.rule.name, finding.message, finding.fix, *path)
    return " ".join(map(str, parts)).casefold()
