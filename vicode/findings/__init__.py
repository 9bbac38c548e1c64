"""Rules and findings, and their rendering as text and JSON."""

from vicode.findings.catalogue import RULES, Rule, Severity, get_rule
from vicode.findings.finding import (
    DesignPath,
    Finding,
    FindingSubject,
    FoundRun,
    Note,
    SourceLocation,
    Span,
    sort_findings,
    worst_severity,
)
from vicode.findings.nearest import did_you_mean, nearest_name, write_instead
from vicode.findings.render import count_findings, escape_text, render_json, render_text
from vicode.findings.sarif import render_sarif

__all__ = [
    "RULES",
    "DesignPath",
    "Finding",
    "FindingSubject",
    "FoundRun",
    "Note",
    "Rule",
    "Severity",
    "SourceLocation",
    "Span",
    "count_findings",
    "did_you_mean",
    "escape_text",
    "get_rule",
    "nearest_name",
    "render_json",
    "render_sarif",
    "render_text",
    "sort_findings",
    "worst_severity",
    "write_instead",
]
