"""A finding: a rule broken by one thing, first by name and path, later by line and column."""

from collections.abc import Iterable
from dataclasses import dataclass

from vicode.findings.catalogue import Rule, Severity

DesignPath = tuple[str | int, ...]
"""Way to a thing inside a design in the words of its file: ("states", "Kick", "transitions", 0, "when")."""

Span = tuple[int, int]
"""First and one-past-last character inside the text a path leads to."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceLocation:
    """Where in a file, counted from 1; `length` characters are underlined."""

    file: str
    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingSubject:
    """What is meant: a path inside the design of `component`; an empty component means the project file."""

    component: str = ""
    path: DesignPath = ()
    span: Span | None = None
    is_key: bool = False
    """The name itself is meant (a state's key), not what it holds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Note:
    """A second place that explains a finding."""

    message: str
    subject: FindingSubject | None = None
    location: SourceLocation | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A rule broken by one thing.

    `message` says what is wrong, `fix` how to put it right, both in the user's words. With `languages` it stands in
    the way of generating those alone.
    """

    rule: Rule
    message: str
    fix: str = ""
    subject: FindingSubject | None = None
    location: SourceLocation | None = None
    notes: tuple[Note, ...] = ()
    languages: tuple[str, ...] = ()

    def applies_to(self, language: str) -> bool:
        """Whether it says something of what is generated in a language."""
        return not self.languages or language in self.languages

    @property
    def severity(self) -> Severity:
        """How bad it is, as its rule says."""
        return self.rule.severity


def sort_findings(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Order by file, line, column and code, each finding once."""

    def key(finding: Finding) -> tuple[str, int, int, str, str]:
        place = finding.location or SourceLocation(file="", line=0, column=0)
        return (place.file, place.line, place.column, finding.rule.code, finding.message)

    return tuple(sorted(dict.fromkeys(findings), key=key))


def worst_severity(findings: Iterable[Finding]) -> Severity | None:
    """The worst severity among findings, None when there are none."""
    ranks = list(Severity)
    return min((finding.severity for finding in findings), key=ranks.index, default=None)
