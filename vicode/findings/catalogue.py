"""The catalog of rules, one record for each rule."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """The severity of a finding, worst first."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A rule; its section in docs/rules.md is addressed by the code."""

    code: str
    name: str
    severity: Severity
    summary: str
    """What the rule reports, as a noun phrase."""


def get_rule(code: str) -> Rule:
    """Return a rule.

    Raises:
        KeyError: The code does not exist.
    """
    return RULES[code]


# Code, name, severity, summary. The code does not determine the severity.
_RECORDS = (
    # YAML syntax and schema
    ("Y101", "not-yaml", Severity.ERROR, "invalid YAML"),
    ("Y102", "unknown-key", Severity.ERROR, "unknown key"),
    ("Y103", "wrong-shape", Severity.ERROR, "value of the wrong kind"),
    ("Y104", "missing-key", Severity.ERROR, "missing required key"),
    ("Y105", "duplicate-key", Severity.ERROR, "duplicate key in a mapping"),
    ("Y106", "refused-tag", Severity.ERROR, "YAML tag"),
    ("Y107", "refused-alias", Severity.ERROR, "YAML anchor or alias"),
    ("Y108", "too-large", Severity.ERROR, "file too large or nested too deeply"),
    ("Y109", "wrong-version", Severity.ERROR, "unsupported format version"),
    ("Y110", "not-text", Severity.ERROR, "file that is not valid UTF-8"),
    ("Y111", "conflicting-keys", Severity.ERROR, "mutually exclusive keys"),
    ("Y112", "several-documents", Severity.ERROR, "several YAML documents in a file"),
    ("Y113", "unresolved-conflict", Severity.ERROR, "unresolved merge conflict"),
    # Projects
    ("P201", "duplicate-component", Severity.ERROR, "duplicate component name"),
    ("P202", "unknown-component", Severity.ERROR, "unknown component"),
    ("P203", "bad-implementation", Severity.ERROR, "implementation not in the form module:Class"),
    ("P204", "unknown-language", Severity.ERROR, "unknown target language"),
    ("P205", "unknown-type", Severity.ERROR, "unknown type"),
    ("P206", "bad-range", Severity.ERROR, "invalid range"),
    ("P207", "empty-enumeration", Severity.ERROR, "enumeration without elements"),
    ("P208", "unusable-project-name", Severity.ERROR, "project name unusable as a Python package"),
    ("P209", "not-implemented", Severity.NOTE, "component without an implementation"),
    ("P210", "no-world", Severity.WARNING, "component of the world in a project without a world"),
    ("P211", "unset-output", Severity.ERROR, "output of a component that stores only variables"),
    ("P212", "different-class", Severity.WARNING, "hand-written class that differs from its declaration"),
    (
        "P213",
        "bad-profile",
        Severity.ERROR,
        "profile of an unknown component, class not in the form module:Class, or bad remote component or topic",
    ),
    ("P214", "inactive-component", Severity.NOTE, "design that no agent activates"),
    ("P215", "undecided-team", Severity.NOTE, "team of robots with too many configurations to search"),
    ("P216", "impossible-assumption", Severity.ERROR, "assumption that never holds"),
    # Expressions
    ("E301", "not-an-expression", Severity.ERROR, "invalid expression syntax"),
    ("E302", "outside-grammar", Severity.ERROR, "unsupported expression syntax"),
    ("E303", "unknown-name", Severity.ERROR, "undeclared name"),
    ("E304", "wrong-type", Severity.ERROR, "type mismatch"),
    ("E305", "wrong-arguments", Severity.ERROR, "wrong arguments in a call"),
    ("E306", "unknown-element", Severity.ERROR, "unknown enumeration element"),
    ("E307", "not-settable", Severity.ERROR, "assignment to something that cannot be set"),
    ("E308", "not-constant", Severity.ERROR, "initial value that is not constant"),
    ("E309", "bad-time", Severity.ERROR, "invalid time"),
    # Designs
    ("D401", "no-initial-state", Severity.ERROR, "missing or unknown initial state"),
    ("D402", "unknown-state", Severity.ERROR, "transition to an unknown state"),
    ("D403", "unknown-use", Severity.ERROR, "alias not declared in uses"),
    ("D404", "bad-name", Severity.ERROR, "invalid name"),
    ("D405", "reserved-name", Severity.ERROR, "name reserved by the runtime"),
    ("D406", "keyword-name", Severity.ERROR, "keyword of a target language"),
    ("D407", "duplicate-name", Severity.ERROR, "duplicate name"),
    ("D408", "uses-cycle", Severity.ERROR, "cycle in uses"),
    ("D409", "unknown-parameter", Severity.ERROR, "unknown parameter in a call"),
    ("D410", "misplaced-call", Severity.ERROR, "call outside actions and modulates"),
    ("D411", "no-states", Severity.ERROR, "design without states"),
    ("D412", "code-does-not-parse", Severity.ERROR, "invalid Python code"),
    ("D413", "duplicate-id", Severity.ERROR, "duplicate id"),
    ("D414", "missing-language", Severity.ERROR, "code missing in a target language"),
    ("D415", "empty-code", Severity.ERROR, "predicate without code"),
    ("D416", "bad-frequency", Severity.ERROR, "frequency that is not positive"),
    ("D418", "disabled-initial-state", Severity.ERROR, "disabled initial state"),
    ("D421", "unreachable-state", Severity.WARNING, "unreachable state"),
    ("D422", "dead-end", Severity.WARNING, "state without exit that is not final"),
    ("D423", "shadowed-transition", Severity.WARNING, "transition that is never taken because of earlier ones"),
    ("D424", "unused-declaration", Severity.WARNING, "unused declaration"),
    ("D425", "stepped-twice", Severity.WARNING, "component stepped twice in an iteration"),
    ("D426", "not-stepped", Severity.WARNING, "output read where nothing steps its component"),
    ("D427", "outside-range", Severity.WARNING, "value outside the declared range"),
    ("D428", "unused-use", Severity.WARNING, "unused alias in uses"),
    ("D430", "no-effect", Severity.NOTE, "transition from a state to itself"),
    ("D431", "bad-frame", Severity.WARNING, "frame without states or around an unknown state"),
    ("D432", "hidden-method", Severity.WARNING, "method in class code that hides a generated one"),
    ("D433", "impossible-guard", Severity.WARNING, "guard that never holds"),
    ("D434", "needless-guard", Severity.NOTE, "guard that always holds"),
    ("D435", "alternating-states", Severity.WARNING, "states that alternate while the inputs hold still"),
    ("D436", "waiting-forever", Severity.WARNING, "state in which robots can wait forever for their team"),
    ("D437", "never-together", Severity.WARNING, "synchronized state that robots never enter together"),
    ("D440", "bad-property", Severity.ERROR, "property of an unknown state"),
    ("D441", "broken-property", Severity.ERROR, "property that a run breaks"),
    (
        "D442",
        "open-property",
        Severity.WARNING,
        "property that is neither guaranteed nor broken by a run that was found",
    ),
    ("D443", "division-by-zero", Severity.WARNING, "division by zero for values that the declarations allow"),
    ("D444", "never-assigned", Severity.NOTE, "variable or output that is never set"),
    ("D445", "never-read", Severity.NOTE, "variable that is set but never read"),
    ("D446", "short-time", Severity.WARNING, "time in a state that is shorter than the period of the component"),
    ("D447", "invalid-interrupt", Severity.ERROR, "interrupt without an effect, or without one state that follows"),
    ("D448", "states-twice", Severity.ERROR, "competence or layers beside states"),
    ("D449", "derived-name", Severity.ERROR, "name that a latch, interrupt, competence or layer needs"),
    ("D450", "layer-condition", Severity.ERROR, "layer that always commands, or a lowest layer that does not"),
    ("D451", "failed-not-final", Severity.ERROR, "failed state that is not final"),
    # XABSL as a target language
    ("L701", "not-in-xabsl", Severity.ERROR, "feature that XABSL does not support"),
    ("L702", "other-result-in-xabsl", Severity.ERROR, "expression with a different result in XABSL"),
    ("L703", "bad-xabsl-name", Severity.ERROR, "name invalid or not unique in XABSL"),
    ("L704", "code-is-not-xabsl", Severity.ERROR, "invalid XABSL code"),
    # JavaScript as a target language
    ("L705", "not-in-javascript", Severity.ERROR, "feature that JavaScript does not support"),
    # Generated files
    ("G501", "edited-generated", Severity.ERROR, "an edit of a generated file that is missing from the design"),
    ("G502", "stale-output", Severity.ERROR, "generated file that is out of date"),
    ("G503", "broken-marks", Severity.ERROR, "region marks that do not match"),
    ("G504", "region-conflict", Severity.ERROR, "code that was edited in a generated file and in the design"),
    ("G505", "merge-markers", Severity.ERROR, "unresolved merge conflict in a generated file"),
    ("G506", "kept-patch", Severity.ERROR, "a patch with edits that are missing from the design"),
    # XABSL syntax and files
    ("X601", "illegal-character", Severity.ERROR, "illegal character or unterminated text"),
    ("X602", "open-comment", Severity.ERROR, "unterminated comment"),
    ("X603", "stray-comment-end", Severity.ERROR, "end of a comment without a start"),
    ("X604", "not-xabsl", Severity.ERROR, "syntax error"),
    ("X605", "unexpected-end", Severity.ERROR, "unexpected end of file"),
    ("X606", "missing-file", Severity.ERROR, "included file that cannot be read"),
    ("X607", "wrong-extension", Severity.ERROR, "file name without the extension .xabsl"),
    ("X608", "included-twice", Severity.WARNING, "file included twice"),
    ("X609", "nothing-defined", Severity.ERROR, "file without a definition, or behavior without an agent"),
    ("X610", "several-definitions", Severity.ERROR, "several definitions in a file, or agents in several files"),
    ("X611", "doubtful-encoding", Severity.WARNING, "file that does not look like the encoding in which it is read"),
    ("X612", "wrong-encoding", Severity.ERROR, "file that is not in the specified encoding"),
    # XABSL declarations and semantics
    ("X621", "unknown-symbol", Severity.ERROR, "undeclared name"),
    ("X622", "ambiguous-name", Severity.ERROR, "ambiguous name"),
    ("X623", "declared-twice", Severity.ERROR, "duplicate declaration"),
    ("X624", "invalid-use", Severity.ERROR, "invalid use of a symbol"),
    ("X625", "wrong-value-type", Severity.ERROR, "type mismatch"),
    ("X626", "wrong-enumeration", Severity.ERROR, "value of another enumeration"),
    ("X627", "duplicate-argument", Severity.ERROR, "parameter passed twice"),
    ("X628", "missing-initial-state", Severity.ERROR, "option without an initial state"),
    ("X629", "several-initial-states", Severity.ERROR, "option with several initial states"),
    ("X630", "mixed-namespace", Severity.ERROR, "namespace with symbols and basic behaviors"),
    ("X631", "empty-namespace", Severity.WARNING, "empty namespace"),
    ("X632", "needless-else", Severity.ERROR, "decision that starts with else without a common decision"),
    ("X633", "stay-in-common", Severity.ERROR, "stay in a common decision"),
    ("X634", "needless-range", Severity.WARNING, "range or unit of a value that is not decimal"),
    ("X635", "parameter-without-at", Severity.ERROR, "option parameter without @"),
    ("X636", "option-cycle", Severity.ERROR, "cycle of options"),
    ("X641", "missing-else", Severity.WARNING, "decision without else after a common decision"),
    ("X642", "missing-argument", Severity.NOTE, "parameter without a value in a call"),
    ("X643", "unreachable-option-state", Severity.WARNING, "unreachable state"),
    ("X644", "unused-symbol", Severity.NOTE, "unused declaration"),
    ("X645", "never-set", Severity.WARNING, "internal symbol that is never set"),
    ("X646", "out-of-range", Severity.WARNING, "value outside the declared range"),
    ("X647", "active-twice", Severity.WARNING, "option executed twice in a cycle"),
    ("X651", "nonstandard-spelling", Severity.NOTE, "spelling that the original compiler rejects"),
    ("X652", "bool-choice", Severity.NOTE, "conditional expression with bools"),
    # SCXML
    ("S801", "not-scxml", Severity.ERROR, "file that is not SCXML"),
    ("S802", "not-in-designs", Severity.ERROR, "element of SCXML that designs do not support"),
    ("S803", "bad-scxml", Severity.ERROR, "unknown name or expression outside of the portable subset in SCXML"),
    # C++ sources with state machines
    ("S804", "unbalanced-brackets", Severity.ERROR, "brackets of a C++ file that do not match"),
    # Files of other tools
    ("S805", "unreadable-source", Severity.ERROR, "file of another tool that cannot be imported"),
)

RULES = {
    code: Rule(code=code, name=name, severity=severity, summary=summary) for code, name, severity, summary in _RECORDS
}

RETIRED_CODES = frozenset({"D417", "D429"})
"""Codes of removed rules. A retired code is never used again."""
