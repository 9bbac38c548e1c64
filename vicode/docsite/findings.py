"""Findings as rows, each with the thing it is about."""

from collections.abc import Iterable

from vicode.docsite.addresses import Addresses
from vicode.docsite.subject import OwnFinding, SourceText, Subject
from vicode.docsite.views import FindingGroup, FindingRow, Part
from vicode.findings import Path, Severity


def finding_rows(subject: Subject, addresses: Addresses, component: str | None = None) -> tuple[FindingRow, ...]:
    """The findings of a component, or all of them, the worst first."""
    wanted = [each for each in subject.findings if component is None or each.component == component]
    ranks = list(Severity)
    wanted.sort(key=lambda each: ranks.index(each.finding.severity))
    return tuple(row_of(each, subject, addresses) for each in wanted)


def finding_groups(rows: Iterable[FindingRow]) -> tuple[FindingGroup, ...]:
    """The same by rule, in the order of the first of each."""
    groups: dict[tuple[str, str], list[FindingRow]] = {}
    for row in rows:
        groups.setdefault((row.severity, row.code), []).append(row)
    return tuple(
        FindingGroup(severity=found[0].severity, code=found[0].code, name=found[0].name, rows=tuple(found))
        for found in groups.values()
    )


def row_of(own: OwnFinding, subject: Subject, addresses: Addresses) -> FindingRow:
    """One finding; where it has no line, the one of the thing it is about."""
    finding = own.finding
    name = own.component or subject.name
    path = finding.thing.path if finding.thing else ()
    href = addresses.thing(own.component, path) if own.component else ""
    place = Part(text="")
    source = subject.sources.get(own.component)
    line = own.line or (_line_of(source, path) if source else 0)
    if own.file:
        place = Part(text=f"{own.file}:{line}")
    elif source and line:
        page = addresses.code(own.component, "source")
        place = Part(text=f"{source.path}:{line}", href=f"{page}#L{line}")
    return FindingRow(
        severity=str(finding.severity),
        code=finding.rule.code,
        name=finding.rule.name,
        message=finding.message,
        mend=finding.mend,
        component=Part(text=name, href=href),
        place=place,
    )


def _line_of(source: SourceText, path: Path) -> int:
    """The line of the nearest thing around a path that has one, 0 for none."""
    return next((source.lines[path[:end]] for end in range(len(path), 0, -1) if path[:end] in source.lines), 0)
