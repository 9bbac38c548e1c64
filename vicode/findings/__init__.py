"""What vicode says to its users: rules, findings about things, and their rendering as text and JSON."""

from vicode.findings.catalogue import RULES, Rule, Severity, rule
from vicode.findings.finding import Finding, Note, Path, Place, Span, Thing, sort_findings, worst_severity
from vicode.findings.nearest import did_you_mean, meant_by, nearest
from vicode.findings.render import render_json, render_text

__all__ = [
    "RULES",
    "Finding",
    "Note",
    "Path",
    "Place",
    "Rule",
    "Severity",
    "Span",
    "Thing",
    "did_you_mean",
    "meant_by",
    "nearest",
    "render_json",
    "render_text",
    "rule",
    "sort_findings",
    "worst_severity",
]
