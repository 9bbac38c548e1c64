"""Findings as rows with links to their subjects."""

from collections.abc import Iterable

from vicode.docsite.site_input import ComponentFinding, SiteInput
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import FindingGroup, FindingRow, TextSpan
from vicode.findings import Severity


def finding_rows(subject: SiteInput, addresses: SiteUrls, component: str | None = None) -> tuple[FindingRow, ...]:
    """The findings of a component, or of all, ordered by severity."""
    wanted = [each for each in subject.findings if component is None or each.component == component]
    ranks = list(Severity)
    wanted.sort(key=lambda each: ranks.index(each.finding.severity))
    return tuple(finding_row(each, subject, addresses) for each in wanted)


def finding_groups(rows: Iterable[FindingRow]) -> tuple[FindingGroup, ...]:
    """Group findings by rule, in order of first occurrence."""
    groups: dict[tuple[str, str], list[FindingRow]] = {}
    for row in rows:
        groups.setdefault((row.severity, row.code), []).append(row)
    return tuple(
        FindingGroup(severity=found[0].severity, code=found[0].code, name=found[0].name, rows=tuple(found))
        for found in groups.values()
    )


def finding_row(component_finding: ComponentFinding, subject: SiteInput, addresses: SiteUrls) -> FindingRow:
    """The row of a finding; without a line, it gets the line of its subject."""
    finding = component_finding.finding
    name = addresses.names.component(component_finding.component) or subject.name
    path = finding.subject.path if finding.subject else ()
    href = addresses.design_path(component_finding.component, path) if component_finding.component else ""
    place = TextSpan(text="")
    source = subject.sources.get(component_finding.component)
    line = component_finding.line or (source.nearest_line(path) if source else 0)
    if component_finding.file:
        place = TextSpan(text=f"{component_finding.file}:{line}")
    elif source and line:
        page = addresses.code(component_finding.component, "source")
        place = TextSpan(text=f"{source.path}:{line}", href=f"{page}#L{line}")
    return FindingRow(
        severity=str(finding.severity),
        code=finding.rule.code,
        name=finding.rule.name,
        message=finding.message,
        fix=finding.fix,
        component=TextSpan(text=name, href=href),
        location=place,
    )
