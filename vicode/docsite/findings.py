"""Findings as rows, each with the thing it is about."""

from vicode.docsite.addresses import Addresses
from vicode.docsite.subject import OwnFinding, Subject
from vicode.docsite.views import FindingRow, Part
from vicode.findings import Severity


def finding_rows(subject: Subject, addresses: Addresses, component: str | None = None) -> tuple[FindingRow, ...]:
    """The findings of a component, or all of them, the worst first."""
    wanted = [each for each in subject.findings if component is None or each.component == component]
    ranks = list(Severity)
    wanted.sort(key=lambda each: ranks.index(each.finding.severity))
    return tuple(_row(each, subject, addresses) for each in wanted)


def _row(own: OwnFinding, subject: Subject, addresses: Addresses) -> FindingRow:
    finding = own.finding
    name = own.component or subject.project.name
    path = finding.thing.path if finding.thing else ()
    href = addresses.thing(own.component, path) if own.component else ""
    place = Part(text="")
    source = subject.sources.get(own.component)
    if source and own.line:
        page = addresses.code(own.component, "source")
        place = Part(text=f"{source.path}:{own.line}", href=f"{page}#L{own.line}")
    return FindingRow(
        severity=str(finding.severity),
        code=finding.rule.code,
        name=finding.rule.name,
        message=finding.message,
        mend=finding.mend,
        component=Part(text=name, href=href),
        place=place,
    )
