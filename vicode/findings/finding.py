"""A finding: a violation of a rule, located by design path and later by line and column."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings.catalogue import Rule, Severity
from vicode.findings.nearest import Suggestion

DesignPath = tuple[str | int, ...]
"""Keys and indices that lead to an item of a design, such as ("states", "Kick", "transitions", 0, "when")."""

Span = tuple[int, int]
"""Start and exclusive end, in characters, within the text at a path."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceLocation:
    """A position in a file; line and column start at 1. `length` characters are underlined."""

    file: str
    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingSubject:
    """The item that a finding is about. An empty `component` means the project file."""

    component: str = ""
    path: DesignPath = ()
    span: Span | None = None
    is_key: bool = False
    """Whether the finding is about the key (such as a state name) instead of its value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Note:
    """An additional location that explains a finding."""

    message: str
    subject: FindingSubject | None = None
    location: SourceLocation | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundRun:
    """A run that shows what a finding says.

    Attributes:
        component: The component that is stepped in each iteration.
        steps: The time of each iteration in ns, and what is set before it: component, input or parameter, value.
    """

    component: str
    steps: tuple[tuple[int, tuple[tuple[str, str, bool | float | str], ...]], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A violation of a rule.

    `message` describes the problem, `fix` how to fix it. A finding with `languages` prevents generation of only those.
    `name` is the name that quick fixes use, `run` one that shows the problem.
    """

    rule: Rule
    message: str
    fix: str = ""
    subject: FindingSubject | None = None
    location: SourceLocation | None = None
    notes: tuple[Note, ...] = ()
    languages: tuple[str, ...] = ()
    name: str = ""
    run: FoundRun | None = field(default=None, compare=False)

    @property
    def suggestion(self) -> str:
        """The known name that the fix proposes, empty if there is none."""
        return self.fix.name if isinstance(self.fix, Suggestion) else ""

    def applies_to(self, language: str) -> bool:
        return not self.languages or language in self.languages

    @property
    def severity(self) -> Severity:
        return self.rule.severity


def sort_findings(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Sort by file, line, column and code, and remove duplicates."""

    def key(finding: Finding) -> tuple[str, int, int, str, str]:
        location = finding.location or SourceLocation(file="", line=0, column=0)
        return (location.file, location.line, location.column, finding.rule.code, finding.message)

    return tuple(sorted(dict.fromkeys(findings), key=key))


def worst_severity(findings: Iterable[Finding]) -> Severity | None:
    """Return the worst severity, None without findings."""
    ranks = list(Severity)
    return min((finding.severity for finding in findings), key=ranks.index, default=None)
